/* More lights than one pass takes: N lights of an Nth of the strength are one light, whatever
 * passes they fall in; and what many lights cost when nothing, or one of them, changes. */
#include <cglm/cglm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "frame/frame.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 320, HEIGHT = 180, PIXELS = WIDTH * HEIGHT, SUN = 0, SPOT = 1, BULB = 2 };

static struct help_stage stage;
static struct gn_light own[3], lights[GN_ALL_LIGHTS_MAX + 8];
static struct gn_frame_opts opts;
static struct gn_warnings warnings;
static struct gn_gl_stats stats;
static struct gn_err err;
static bool full, main_context; /* GN_FULL; the context that has everything, by EGL */

static void open_with(const char *backend, const char *without) {
    full = getenv("GN_FULL") != NULL;
    main_context = !strcmp(backend, "egl") && !without;
    warnings = (struct gn_warnings){0};
    help_stage_open(&stage, gn_stage_scene_make, backend, without, &warnings);
    memcpy(own, stage.scene->lights, sizeof own);
    stage.scene->lights = lights; /* none of them is made yet */
    stage.pose.lights = lights;
    opts = (struct gn_frame_opts){.output.width_px = WIDTH,
                                  .output.height_px = HEIGHT,
                                  .shadow.any = {.given = GN_LIGHT_GIVEN(map_px), .map_px = 256},
                                  .exposure_given = true};
}

HELP_OPENS(open_egl, "egl", NULL)
HELP_OPENS(open_osmesa, "osmesa", NULL)
HELP_OPENS(open_egl_without_srgb, "egl", "srgb")
HELP_OPENS(open_osmesa_without_srgb, "osmesa", "srgb")
HELP_OPENS(open_egl_poor, "egl", "srgb,rgba16f")

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

/* Every light an equal part of the same. */
static void share(int light, uint32_t count) {
    stage.scene->light_count = count;
    for (uint32_t i = 0; i < count; i++) {
        lights[i] = own[light];
        glm_vec3_scale(own[light].color, 1.0f / (float)count, lights[i].color);
    }
}

static const struct gn_plan *draw(uint8_t *rgba) {
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, &warnings);
    stats = gn_gl_stats(stage.gl);
    if (rgba && !gn_gl_read_rgba8(stage.gl, rgba, &err)) fail_msg("%s", err.text);
    return plan;
}

/* The share of the pixels that differ by more than `codes`, in thousandths. */
static double apart(const uint8_t *a, const uint8_t *b, int codes) {
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        bool alike = true;
        for (int k = 0; k < 3; k++) alike = alike && abs(a[4 * i + k] - b[4 * i + k]) <= codes;
        count += !alike;
    }
    return 1000.0 * count / PIXELS;
}

static uint8_t one[4 * PIXELS], many[4 * PIXELS];

static uint32_t passes_that_add(const struct gn_plan *plan) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        count += plan->passes[i].kind == GN_PASS_PICTURE &&
                 plan->passes[i].picture.blend == GN_BLEND_ADD &&
                 strncmp(plan->passes[i].label, "lights", 6) == 0;
    return count;
}

/* Each pass rounds to bytes: with more than two, or what is blended, a code more is lost. */
static void expect_one(int light, const uint32_t counts[4], uint32_t each_pass, int codes) {
    share(light, 1);
    draw(one);
    /* a program each: quickly, only four */
    for (uint32_t k = 0, count; k < (full ? 11 : 4) && (count = full ? k + 2 : counts[k]); k++) {
        share(light, count);
        const struct gn_plan *plan = draw(many);
        assert_int_equal(passes_that_add(plan), (count - 1) / each_pass);
        double thousandths = apart(one, many, passes_that_add(plan) > 1 ? 2 : codes);
        if (thousandths <= 1.0) continue;
        fail_msg("light %d x %u: %.2f thousandths of the pixels differ", light, count, thousandths);
    }
}

/* Where shaders encode, one pass blends in bytes: then it is not comparable with light that is
 * added. */
static void close_the_pane(void) { stage.scene->materials[4].alpha = GN_ALPHA_OPAQUE; }

/* Drivers take most of the time to compile. Quickly, all that is shown is of one kind, so that it
 * shares its programs, but for where a test asks about kinds. */
static void one_kind(void) {
    for (uint32_t i = 0; i < stage.scene->material_count && !full; i++) {
        struct gn_material *m = &stage.scene->materials[i];
        m->alpha = GN_ALPHA_OPAQUE;
        m->roughness = 1;
        m->metalness = 0;
        m->unlit = m->double_sided = false;
    }
}

/* All kinds of things under the spot of one context. */
static void expect_each(const uint32_t counts[3][4], uint32_t each_pass) {
    static const int order[] = {SPOT, SUN, BULB};
    close_the_pane();
    for (int i = 0; i < 3; i++) {
        if (i > 0 || !main_context) one_kind();
        expect_one(order[i], counts[order[i]], each_pass, 1);
    }
}

static void test_many_open_lights_are_one(void **state) {
    (void)state;
    static const uint32_t counts[3][4] = {{9}, {2, 8, 9, 12}, {12}};
    GN_LIGHT_SET(&opts.shadow.any, technique, GN_TECHNIQUE_NONE);
    expect_each(counts, GN_LIGHTS_MAX);
}

static void test_many_casting_lights_are_one(void **state) {
    (void)state;
    static const uint32_t counts[3][4] = {{8}, {4, 5, 8, 12}, {5}};
    expect_each(counts, GN_SHADOWS_MAX);
}

static void test_strength_holds_in_every_pass(void **state) {
    (void)state;
    close_the_pane();
    one_kind();
    share(SPOT, 1);
    draw(many);
    GN_LIGHT_SET(&opts.shadow.any, strength, 0.7f);
    draw(one);
    assert_true(apart(one, many, 1) > 2.0); /* shadows are paler */
    expect_one(SPOT, (const uint32_t[4]){8}, GN_SHADOWS_MAX, 1);
}

static void test_a_short_range_is_one_too(void **state) {
    (void)state;
    close_the_pane();
    one_kind();
    own[BULB].range_m = 3.0f;
    own[SPOT].range_m = 6.5f;
    own[SPOT].outer_rad = 0.3f;
    own[SPOT].inner_rad = 0.1f;
    expect_one(BULB, (const uint32_t[4]){8}, GN_SHADOWS_MAX, 1);
    expect_one(SPOT, (const uint32_t[4]){5}, GN_SHADOWS_MAX, 1);
    const struct gn_plan *plan = draw(NULL);
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (plan->passes[i].kind == GN_PASS_PICTURE &&
            plan->passes[i].picture.blend == GN_BLEND_ADD)
            assert_in_range(plan->passes[i].rect.width * plan->passes[i].rect.height, 1,
                            PIXELS * 3 / 4);
}

static void test_blended_things_in_a_row(void **state) {
    (void)state;
    for (int i = 1; i <= 2; i++) { /* the boxes, red and blue */
        stage.scene->materials[i].alpha = GN_ALPHA_BLEND;
        stage.scene->materials[i].base_color[3] = 0.4f;
    }
    GN_LIGHT_SET(&opts.shadow.any, technique, GN_TECHNIQUE_NONE);
    opts.view.turntable_rad = 1.4f; /* one behind the other */
    expect_one(SPOT, (const uint32_t[4]){9, 12}, GN_LIGHTS_MAX, 2);
}

static void test_antialiased(void **state) {
    (void)state;
    if (!(gn_gl_caps(stage.gl)->has & 1u << GN_CAP_MSAA4)) skip();
    opts.output.msaa = 4;
    close_the_pane();
    one_kind();
    expect_one(SPOT, (const uint32_t[4]){8}, GN_SHADOWS_MAX, 1);
}

/* The samples of linear light are resolved, then encoded. */
static void test_antialiased_without_srgb(void **state) {
    (void)state;
    if (!(gn_gl_caps(stage.gl)->has & 1u << GN_CAP_MSAA4)) skip();
    opts.output.msaa = 4;
    one_kind();
    share(SPOT, 5);
    assert_int_equal(draw(one)->output, GN_OUTPUT_FLOAT);
    share(SPOT, 8);
    draw(many);
    assert_true(apart(one, many, 1) <= 1.0);
    opts.output.msaa = 0;
    draw(many);
    assert_true(apart(one, many, 1) > 2.0);
}

static void test_light_adds_up_in_linear_bytes_too(void **state) {
    (void)state;
    one_kind();
    opts.output.linear = true;
    expect_one(SUN, (const uint32_t[4]){8}, GN_SHADOWS_MAX, 2);
}

/* ---- too many ---- */

static void test_the_weakest_are_left_out_by_name(void **state) {
    (void)state;
    one_kind();
    share(BULB, GN_ALL_LIGHTS_MAX + 2);
    lights[5].name = "Faint";
    glm_vec3_scale(lights[5].color, 0.5f, lights[5].color);
    GN_LIGHT_SET(&opts.shadow.any, technique, GN_TECHNIQUE_NONE);
    const struct gn_plan *plan = draw(NULL);
    assert_int_equal(plan->light_count, GN_ALL_LIGHTS_MAX);
    assert_true(warnings.count > 0);
    assert_non_null(strstr(warnings.text[0], "'Faint' is left out: at most 32 lights"));
    for (uint32_t i = 0; i < plan->light_count; i++) assert_true(plan->lights[i] != 5);
}

static void test_a_gpu_without_linear_targets_has_one_pass(void **state) {
    (void)state;
    one_kind();
    share(SPOT, 9);
    const struct gn_plan *plan = draw(NULL);
    assert_int_equal(plan->light_count, GN_LIGHTS_MAX);
    assert_int_equal(plan->shadow_count, GN_SHADOWS_MAX);
    assert_int_equal(plan->output, GN_OUTPUT_LINEAR8);
    assert_non_null(strstr(warnings.text[0], "on a GPU without srgb and rgba16f targets"));
}

/* ---- what is drawn again ---- */

/* Eight lights, each with a map, at three nodes. */
static void mix(void) {
    one_kind();
    stage.scene->light_count = 8;
    for (uint32_t i = 0; i < 8; i++) {
        lights[i] = own[i % 2 ? SPOT : SUN];
        glm_vec3_scale(lights[i].color, 0.125f, lights[i].color);
        lights[i].outer_rad = 0.4f + 0.05f * (float)i;
    }
}

static void test_a_still_scene_draws_no_map(void **state) {
    (void)state;
    mix();
    draw(NULL);
    assert_int_equal(stats.shadow_passes_skipped, 0);
    const uint64_t objects = stats.objects_created;
    draw(NULL);
    assert_int_equal(stats.shadow_passes_skipped, 8);
    assert_int_equal(stats.shadow_draws, 0);
    assert_int_equal(stats.objects_created, objects);
}

static void test_a_light_that_moves_draws_its_own_map(void **state) {
    (void)state;
    mix();
    draw(NULL);
    lights[5].node = own[BULB].node;
    draw(NULL);
    assert_int_equal(stats.shadow_passes_skipped, 7);
}

static void test_a_caster_moved_a_millimetre_draws_again(void **state) {
    (void)state;
    mix();
    draw(NULL);
    gn_pose_step(&stage.pose, 1000000); /* the mover goes 1 m/s */
    draw(NULL);
    assert_int_equal(stats.shadow_passes_skipped, 0);
    const unsigned long allocated = gn_alloc_count();
    const uint64_t objects = stats.objects_created;
    for (int i = 2; i < 8; i++) {
        gn_pose_step(&stage.pose, i * 1000000);
        draw(NULL);
    }
    assert_int_equal(gn_alloc_count(), allocated);
    assert_int_equal(stats.objects_created, objects);
}

/* Mixed types, techniques and encodings, as many as there may be: nothing that the driver minds. */
static void test_everything_at_once(void **state) {
    (void)state;
    const char *techniques[GN_TECHNIQUE_COUNT];
    uint32_t count = 0;
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
        if (gn_techniques[t].file && !gn_techniques[t].on_plane && !gn_techniques[t].filter)
            techniques[count++] = gn_techniques[t].name;
    stage.scene->light_count = GN_ALL_LIGHTS_MAX;
    for (uint32_t i = 0; i < GN_ALL_LIGHTS_MAX; i++) {
        lights[i] = own[i % 3];
        lights[i].technique = techniques[i % count];
    }
    one_kind();
    if (full) opts.output.width_px = 1280, opts.output.height_px = 720;
    const int step = full || main_context ? 1 : 3;
    for (int encoding = 0; encoding <= GN_ENCODING_AUTO; encoding += step) {
        GN_LIGHT_SET(&opts.shadow.any, map_format,
                     GN_MAP_FORMAT((enum gn_encoding)encoding, GN_MOMENTS_NONE));
        const struct gn_plan *plan = draw(NULL);
        assert_int_equal(plan->shadow_count, GN_ALL_SHADOWS_MAX);
        assert_int_equal(plan->light_count, GN_ALL_LIGHTS_MAX);
    }
}

#define ON(name, open)                                                                             \
    { #name " " #open, name, open, close_all, NULL }
#define TEST(name) ON(name, open_egl), ON(name, open_osmesa)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_many_open_lights_are_one),
        ON(test_many_open_lights_are_one, open_egl_without_srgb),
        ON(test_many_open_lights_are_one, open_osmesa_without_srgb),
        TEST(test_many_casting_lights_are_one),
        ON(test_many_casting_lights_are_one, open_egl_without_srgb),
        ON(test_many_casting_lights_are_one, open_osmesa_without_srgb),
        TEST(test_strength_holds_in_every_pass),
        TEST(test_a_short_range_is_one_too),
        TEST(test_blended_things_in_a_row),
        TEST(test_antialiased),
        ON(test_antialiased_without_srgb, open_egl_without_srgb),
        TEST(test_light_adds_up_in_linear_bytes_too),
        TEST(test_the_weakest_are_left_out_by_name),
        ON(test_a_gpu_without_linear_targets_has_one_pass, open_egl_poor),
        TEST(test_a_still_scene_draws_no_map),
        TEST(test_a_light_that_moves_draws_its_own_map),
        TEST(test_a_caster_moved_a_millimetre_draws_again),
        TEST(test_everything_at_once),
    };
    return RUN(tests);
}
