#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "gl/private.h"
#include "unit/gl_hand.h"

/* ---- the output ---- */

static void test_depth_and_srgb(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_SRGB8);
    add_draw(HELP_NEAR, instance(0.5f, 0, 0, 1)); /* first, so the far one must lose by depth */
    add_draw(HELP_FAR, instance(0, 0.5f, 0, 1));
    show();
    expect(8, 8, 188, 0, 0);
    expect(0, 8, 0, 188, 0);
    begin_plan(GN_OUTPUT_LINEAR8);
    add_draw(HELP_FAR, instance(0.5f, 0, 0, 1));
    show();
    expect(8, 8, 128, 0, 0);
}

static void test_clear_and_constants(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_SRGB8);
    s.passes[0].clear.color[2] = 0.5f;
    add_draw(HELP_NEAR, instance(0, 0, 0, 1));
    s.constants[0][0][1] = 0.5f;
    show();
    expect(8, 8, 0, 188, 0);
    expect(0, 8, 0, 0, 188);
    s.constants[0][0][1] = 1;
    show();
    expect(8, 8, 0, 255, 0);
}

static void test_cull_and_mirror(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_LINEAR8);
    struct gn_draw *d = add_draw(HELP_FAR, instance(1, 1, 1, 1));
    static const struct {
        uint8_t cull;
        bool mirrored;
        int seen;
    } cases[] = {{GN_CULL_NONE, false, 255}, {GN_CULL_NONE, true, 255}, {GN_CULL_BACK, false, 255},
                 {GN_CULL_BACK, true, 0},    {GN_CULL_FRONT, false, 0}, {GN_CULL_FRONT, true, 255}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        d->cull = cases[i].cull;
        d->mirrored = cases[i].mirrored;
        show();
        expect(8, 8, cases[i].seen, cases[i].seen, cases[i].seen);
    }
}

static void test_blend(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_LINEAR8);
    s.passes[0].clear.color[0] = 1;
    s.passes[0].picture.blend = GN_BLEND_ALPHA;
    s.passes[0].depth_write = false;
    add_draw(HELP_FAR, instance(0, 0.25f, 0, 0.25f)); /* premultiplied */
    show();
    expect(8, 8, 191, 64, 0);
}

/* Row 0 of a picture is its top; v = 0 is at the bottom of the square, and it is image row 0. */
static void test_texture_and_rows(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_SRGB8);
    s.programs[0].features = GN_FEATURE(BASE_TEXTURE);
    add_draw(HELP_FAR, instance(1, 1, 1, 1))->material = 1;
    show();
    expect(0, 0, 0, 0, 255);
    expect(SIDE - 1, 0, 255, 255, 255);
    expect(0, SIDE - 1, 255, 0, 0);
    expect(SIDE - 1, SIDE - 1, 0, 255, 0);
}

static void test_instances(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_LINEAR8);
    add_draw(HELP_NEAR, instance(1, 0, 0, 1));
    s.instances[1] = instance(0, 1, 0, 1);
    s.instances[0].world[0][3] = -0.5f;
    s.instances[1].world[0][3] = 0.5f;
    s.plan.instance_count = 2;
    s.draws[0].instance_count = 2;
    show();
    expect(2, 8, 255, 0, 0);
    expect(13, 8, 0, 255, 0);
    s.draws[0].first_instance = 1; /* pointers move */
    s.draws[0].instance_count = 1;
    show();
    expect(2, 8, 0, 0, 0);
    expect(13, 8, 0, 255, 0);
}

static void test_msaa(void **state) {
    (void)state;
    if (!(gn_gl_caps(gl)->has & 1u << GN_CAP_MSAA4)) skip();
    begin_plan(GN_OUTPUT_SRGB8);
    s.plan.msaa = 4;
    add_draw(HELP_NEAR, instance(0.5f, 0, 0, 1));
    s.instances[0].world[0][3] = 0.0625f; /* half a pixel */
    show();
    expect(8, 8, 188, 0, 0);
    assert_in_range(picture[8][4][0], 90, 160);
    s.plan.msaa = 0;
    show();
    assert_true(picture[8][4][0] == 0 || abs(picture[8][4][0] - 188) < 2);
}

static void test_float_and_aov(void **state) {
    (void)state;
    float out[SIDE][SIDE][4];
    begin_plan(GN_OUTPUT_FLOAT);
    add_draw(HELP_NEAR, instance(100, -0.5f, 0.25f, 1));
    prepare();
    run();
    assert_true(gn_gl_read_f32(gl, &out[0][0][0], &err));
    assert_true(out[8][8][0] == 100 && out[8][8][1] == -0.5f && out[8][8][2] == 0.25f);
    begin_plan(GN_OUTPUT_AOV);
    s.passes[0].clear.color[0] = INFINITY;
    add_draw(HELP_NEAR, instance(12345.678f, -1, 0, 1));
    prepare();
    run();
    assert_true(gn_gl_read_f32(gl, &out[0][0][0], &err));
    assert_true(out[8][8][0] == 12345.678f && out[8][8][1] == -1);
    assert_true(isinf(out[0][0][0]));
    assert_false(gn_gl_read_rgba8(gl, &picture[0][0][0], &err));
}

static void test_an_error_before_reading_is_told(void **state) {
    (void)state;
    static const enum gn_output_format formats[] = {GN_OUTPUT_FLOAT, GN_OUTPUT_AOV};
    float out[SIDE][SIDE][4];
    for (int i = 0; i < 2; i++) {
        begin_plan(formats[i]);
        add_draw(HELP_NEAR, instance(2, 0.5f, 0.25f, 1));
        prepare();
        run();
        if (gl->caps.has & 1u << GN_CAP_DEBUG) GL(gl, Disable)(GL_DEBUG_OUTPUT_KHR);
        GL(gl, Enable)(0); /* no capability */
        assert_false(gn_gl_read_f32(gl, &out[0][0][0], &err));
        assert_string_equal(err.text, "reading the picture: invalid enum");
        assert_true(out[8][8][0] == 2 && out[8][8][1] == 0.5f);
        assert_true(gn_gl_read_f32(gl, &out[0][0][0], &err));
    }
}

/* Of a screen without GL: blue first in memory, the first row at the top. */
static void test_a_copy_for_a_screen_is_xrgb_in_rows_of_its_stride(void **state) {
    (void)state;
    enum { STRIDE = 4 * SIDE + 8 };
    uint8_t out[SIDE][STRIDE];
    memset(out, 77, sizeof out);
    begin_plan(GN_OUTPUT_SRGB8);
    s.programs[0].features = GN_FEATURE(BASE_TEXTURE);
    add_draw(HELP_FAR, instance(1, 1, 1, 1))->material = 1;
    prepare();
    run();
    assert_true(gn_gl_read_xrgb8888(gl, &out[0][0], STRIDE, &err));
    assert_memory_equal(&out[0][0], ((uint8_t[]){255, 0, 0, 255}), 4);
    assert_memory_equal(&out[SIDE - 1][0], ((uint8_t[]){0, 0, 255, 255}), 4);
    assert_memory_equal(&out[SIDE - 1][4 * SIDE - 4], ((uint8_t[]){0, 255, 0, 255}), 4);
    for (int i = 4 * SIDE; i < STRIDE; i++) assert_int_equal(out[0][i], 77);
}

/* ---- the stencil ---- */

/* The far square in red, and 80 marks it; the near one, which is half as wide, adds 1 and leaves no
 * colour; then the far one in green where there are both, and in blue where 1 has gone again. */
static void plan_stencil(enum gn_output_format output) {
    begin_plan(output);
    add_draw(HELP_FAR, instance(1, 0, 0, 1));
    add_draw(HELP_NEAR, instance(1, 1, 1, 1))->program = 1;
    add_draw(HELP_FAR, instance(0, 1, 0, 1));
    add_draw(HELP_FAR, instance(0, 0, 1, 1));
    s.plan.stencil = true;
    s.plan.pass_count = 4, s.plan.program_count = 2;
    s.programs[1].kind = GN_PROGRAM_FLAT;
    s.passes[0].picture.stencil = (struct gn_stencil){.value = 0x80, .writes = 0xff};
    s.passes[0].discard_depth = s.passes[0].picture.resolves = false;
    for (uint32_t i = 1; i < 4; i++) {
        s.passes[i] = s.passes[0];
        s.passes[i].clear.area = GN_CLEAR_NOTHING;
        s.passes[i].depth_write = false;
        s.passes[i].first_draw = i;
    }
    for (int i = 0; i < 4; i++) s.passes[i].draw_count = 1;
    s.passes[1].picture.only_stencil = true;
    s.passes[1].picture.stencil = (struct gn_stencil){.value = 0x81, .reads = 0x80, .writes = 0x01};
    s.passes[2].picture.stencil = (struct gn_stencil){.value = 0x81, .reads = 0x8f};
    s.passes[3].picture.stencil = (struct gn_stencil){.value = 0x80, .reads = 0x81};
    s.passes[3].clear.stencil_bits = 0x01;
    s.passes[3].rect = (struct gn_rect){8, 0, 2, SIDE};
    s.passes[3].discard_depth = s.passes[3].picture.resolves = true;
}

static void expect_stencil(void) {
    expect(6, 8, 0, 255, 0);
    expect(8, 8, 0, 0, 255);
    expect(9, 0, 0, 0, 255);
    expect(1, 8, 255, 0, 0);
    expect(14, 14, 255, 0, 0);
}

static void test_stencil(void **state) {
    (void)state;
    float out[SIDE][SIDE][4];
    for (int frame = 0; frame < 2; frame++) {
        plan_stencil(GN_OUTPUT_LINEAR8);
        if (frame == 1 && gn_gl_caps(gl)->has & 1u << GN_CAP_MSAA4) s.plan.msaa = 4;
        show();
        expect_stencil();
        run(); /* nothing is left over from the frame before */
        if (!gn_gl_read_rgba8(gl, &picture[0][0][0], &err)) fail_msg("%s", err.text);
        expect_stencil();
    }
    begin_plan(GN_OUTPUT_LINEAR8); /* nor for a picture without */
    add_draw(HELP_FAR, instance(0, 1, 0, 1));
    show();
    expect(1, 8, 0, 255, 0);
    plan_stencil(GN_OUTPUT_AOV);
    prepare();
    run();
    assert_true(gn_gl_read_f32(gl, &out[0][0][0], &err));
    assert_true(out[8][6][1] == 1 && out[8][8][2] == 1 && out[8][1][0] == 1);
}

/* ---- maps ---- */

/* Pass 0 draws a map with its rim left clear, pass 1 shows what the middle of it says. */
static void plan_map(enum gn_encoding encoding, float code, float far_code) {
    begin_plan(GN_OUTPUT_LINEAR8);
    add_draw(HELP_NEAR, instance(0, 0, 0, 1));
    add_draw(HELP_FAR, instance(1, 1, 1, 1))->program = 1;
    s.passes[1] = s.passes[0];
    s.passes[1].first_draw = 1, s.passes[1].draw_count = 1;
    s.passes[0].draw_count = 1;
    s.passes[0].target = (struct gn_target){
        .kind = GN_TARGET_SHADOW, .width_px = MAP, .height_px = MAP, .encoding = encoding};
    s.passes[0].kind = GN_PASS_MAP;
    s.passes[0].map = (struct gn_pass_map){.border_px = 1};
    s.passes[0].discard_depth = encoding != GN_ENCODING_DEPTH;
    s.passes[0].clear.color[0] = far_code;
    s.passes[0].content = (struct gn_content){.hash = 77, .completes = true};
    s.constants[1][0][0] = code;
    s.passes[0].constants = (const float(*)[4])s.constants[1];
    s.passes[1].picture.shadow_count = 1;
    s.plan.pass_count = 2, s.plan.program_count = 2, s.plan.shadow_count = 1;
    s.shadows[0] = (struct gn_shadow_view){.technique = GN_TECHNIQUE_HARD,
                                           .encoding = encoding,
                                           .map = {.width_px = MAP, .height_px = MAP}};
    s.programs[0].kind = encoding == GN_ENCODING_DEPTH ? GN_PROGRAM_DEPTH : GN_PROGRAM_DISTANCE;
    s.programs[0].encoding = encoding == GN_ENCODING_DEPTH ? 0 : (uint8_t)encoding;
    s.programs[1].kind = GN_PROGRAM_LIT;
    s.programs[1].light_count = s.programs[1].shadow_count = 1;
    s.programs[1].lights[0] = (struct gn_program_light){.type = GN_LIGHT_DIRECTIONAL,
                                                        .technique = GN_TECHNIQUE_HARD,
                                                        .encoding = (uint8_t)encoding};
}

static void check_map(enum gn_encoding encoding, float code, float far_code, int seen) {
    float map[MAP][MAP];
    if (!(gn_caps_encodings(gn_gl_caps(gl)) >> encoding & 1)) return;
    plan_map(encoding, code, far_code);
    show();
    expect(8, 8, seen, seen, seen);
    if (!gn_gl_read_map(gl, 0, &map[0][0], &err)) fail_msg("%s", err.text);
    assert_true(fabsf(map[0][4] - far_code) < 1e-6f); /* the rim, though the square covers it */
    assert_true(fabsf(map[4][0] - far_code) < 1e-6f);
    assert_true(fabsf(map[4][4] - code) < 1e-6f);
}

static void test_maps(void **state) {
    (void)state;
    check_map(GN_ENCODING_DEPTH, 0.25f, 1, 0); /* the reference is .5 */
    check_map(GN_ENCODING_R32UI, 0.75f, 123.4567f, 191);
    check_map(GN_ENCODING_R16F, 0.5f, 1, 128);
    check_map(GN_ENCODING_R16F_RAW, 0.5f, 400, 128);
    check_map(GN_ENCODING_RGBA8, 0.5f, 1, 128);
}

static void test_map_skipped(void **state) {
    (void)state;
    plan_map(GN_ENCODING_R32UI, 0.75f, 1);
    show();
    assert_int_equal(gn_gl_stats(gl).shadow_draws, 1);
    s.constants[1][0][0] = 0.25f; /* not seen: the hash says that nothing has changed */
    show();
    expect(8, 8, 191, 191, 191);
    assert_int_equal(gn_gl_stats(gl).shadow_passes_skipped, 1);
    assert_int_equal(gn_gl_stats(gl).shadow_draws, 0);
    s.passes[0].content.hash = 78;
    show();
    expect(8, 8, 64, 64, 64);
    assert_true(gn_gl_load(gl, &help_scene, &err)); /* another scene: all is drawn again */
    show();
    assert_int_equal(gn_gl_stats(gl).shadow_draws, 1);
    s.passes[0].content.hash = 0;
    show();
    assert_int_equal(gn_gl_stats(gl).shadow_draws, 1);
}

/* Plans that take turns find their maps again, up to a number of them. */
static void test_maps_take_turns(void **state) {
    (void)state;
    for (int round = 0; round < 2; round++) {
        plan_map(GN_ENCODING_R32UI, 0.75f, 1);
        show();
        plan_map(GN_ENCODING_RGBA8, 0.5f, 1);
        show();
        assert_int_equal(gn_gl_stats(gl).shadow_passes_skipped, round);
    }
    const uint64_t bytes = gn_gl_stats(gl).target_bytes;
    for (uint32_t side = 1; side < 3 * GN_GL_MAPS_MAX; side++) {
        s.passes[0].target.width_px = s.passes[0].target.height_px = side;
        s.shadows[0].map.width_px = s.shadows[0].map.height_px = side;
        s.passes[0].map.border_px = 0;
        show();
    }
    plan_map(GN_ENCODING_RGBA8, 0.5f, 1);
    show();
    assert_int_equal(gn_gl_stats(gl).shadow_draws, 1);
    assert_int_equal(gn_gl_stats(gl).target_bytes, bytes);
}

/* ---- the frame loop ---- */

static void test_steady(void **state) {
    (void)state;
    plan_map(GN_ENCODING_DEPTH, 0.25f, 1);
    show();
    run();
    const uint32_t still = gn_gl_stats(gl).gl_calls;
    const uint64_t objects = gn_gl_stats(gl).objects_created;
    const unsigned long allocated = gn_alloc_count();
    for (uint64_t i = 0; i < 5; i++) {
        s.instances[1].base_color[0] = 0.1f * (float)i;
        s.constants[0][0][0] = 0.01f * (float)i;
        s.passes[0].content.hash = 100 + i;
        prepare();
        run();
    }
    assert_int_equal(gn_gl_stats(gl).objects_created, objects);
    assert_int_equal(gn_alloc_count(), allocated);
    run();
    run();
    assert_int_equal(gn_gl_stats(gl).gl_calls, still); /* nothing is uploaded twice */
    double ms[2];
    assert_true(gn_gl_run(gl, &s.plan, ms, &err));
    assert_true(ms[0] >= 0 && ms[1] > 0);
}

static void test_not_prepared(void **state) {
    (void)state;
    begin_plan(GN_OUTPUT_LINEAR8);
    add_draw(HELP_FAR, instance(1, 1, 1, 1));
    show();
    assert_true(gn_gl_load(gl, &help_scene, &err)); /* its vertices are new */
    assert_false(gn_gl_run(gl, &s.plan, NULL, &err));
    show();
    s.programs[0].features = GN_FEATURE(UNLIT);
    assert_false(gn_gl_run(gl, &s.plan, NULL, &err));
    s.plan.scene = NULL;
    assert_false(gn_gl_prepare(gl, &s.plan, &err));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_depth_and_srgb),
        TEST(test_clear_and_constants),
        TEST(test_cull_and_mirror),
        TEST(test_blend),
        TEST(test_texture_and_rows),
        TEST(test_instances),
        TEST(test_msaa),
        TEST(test_float_and_aov),
        TEST(test_an_error_before_reading_is_told),
        TEST(test_a_copy_for_a_screen_is_xrgb_in_rows_of_its_stride),
        TEST(test_stencil),
        TEST(test_maps),
        TEST(test_map_skipped),
        TEST(test_maps_take_turns),
        TEST(test_steady),
        TEST(test_not_prepared),
    };
    return RUN(tests);
}
