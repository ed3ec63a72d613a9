/* Plans as text against goldens, and what must hold between plans: what is drawn again, and when. A
 * change of rendering is reviewed as the difference of a golden: GN_UPDATE=1 writes them anew. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "core/file.h"
#include "frame/plan.h"
#include "plan/stage_scene.h"
#include "unit/check.h"

struct fixture {
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_frame *frame;
    struct gn_frame_opts opts;
};

static void begin(struct fixture *f, uint32_t caps) {
    f->scene = gn_stage_scene_make();
    gn_pose_init(&f->pose, f->scene, GN_POSE_DEFAULT);
    gn_pose_step(&f->pose, 0);
    struct gn_caps all = {.has = caps, .max_texture_px = 4096, .max_texture_units = 16};
    f->frame = gn_frame_create(f->scene, &all);
    f->opts = (struct gn_frame_opts){.encoding = GN_ENCODING_AUTO};
}

static void end(struct fixture *f) {
    gn_frame_destroy(f->frame);
    gn_pose_finish(&f->pose);
    gn_scene_destroy(f->scene);
}

static const struct gn_plan *build(struct fixture *f) {
    return gn_frame_build(f->frame, &f->pose, &f->opts, NULL);
}

static const uint32_t everything = (1u << GN_CAP_COUNT) - 1;

static char *print(const struct gn_plan *plan, size_t *size) {
    char *text = NULL;
    FILE *to = open_memstream(&text, size);
    gn_plan_print(plan, to);
    fclose(to);
    return text;
}

static void expect_golden(const struct gn_plan *plan, const char *name) {
    char path[256];
    snprintf(path, sizeof path, "tests/plan/golden/%s.txt", name);
    size_t size;
    char *text = print(plan, &size);
    struct gn_err err = {0};
    struct gn_bytes golden = {0};
    if (getenv("GN_UPDATE")) assert_true(gn_file_write(path, text, size, &err));
    if (!gn_file_read(path, 0, &golden, &err)) fail_msg("%s", err.text);
    bool same = golden.size == size && memcmp(golden.data, text, size) == 0;
    gn_bytes_finish(&golden);
    if (!same) print_message("%s differs from this plan (GN_UPDATE=1 accepts it):\n%s", path, text);
    free(text);
    assert_true(same);
}

static void test_default_plan(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    expect_golden(build(&f), "default");
    end(&f);
}

static void test_hard_plan(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    f.opts.technique_given = true;
    f.opts.technique = GN_TECHNIQUE_HARD;
    expect_golden(build(&f), "hard");
    end(&f);
}

static void test_planar_plan(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    f.opts.technique_given = true;
    f.opts.technique = GN_TECHNIQUE_PLANAR;
    expect_golden(build(&f), "planar");
    end(&f);
}

/* Beside others: what is not on the plane does not ask about it. */
static void test_planar_light_among_others(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    f.scene->lights[0].technique = "planar"; /* the sun */
    f.scene->lights[2].technique = "none";   /* the bulb */
    const struct gn_plan *plan = build(&f);
    assert_int_equal(plan->shadow_count, 2);
    assert_int_equal(plan->shadows[0].encoding, GN_ENCODING_DEPTH); /* the spot goes first */
    assert_int_equal(plan->shadows[1].encoding, GN_ENCODING_MASK);
    int on_plane = 0;
    for (uint32_t i = 0; i < plan->program_count; i++) {
        const struct gn_program_key *key = &plan->programs[i];
        if (key->kind != GN_PROGRAM_LIT || key->features & GN_FEATURE_UNLIT) continue;
        assert_int_equal(key->light_count, 3);
        on_plane += key->shadow_count == 2;
    }
    assert_int_equal(on_plane, 1);
    end(&f);
}

static void test_planar_needs_a_plane(void **state) {
    (void)state;
    struct fixture f;
    struct gn_warnings warnings = {0};
    begin(&f, everything);
    for (uint32_t i = 0; i < f.scene->item_count; i++) f.scene->items[i].plane = false;
    f.opts.technique_given = true;
    f.opts.technique = GN_TECHNIQUE_PLANAR;
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->shadow_count, 0);
    assert_int_equal(warnings.count, 3); /* each light */
    assert_non_null(strstr(warnings.text[0], "gnomon_plane"));
    end(&f);
}

static void test_visibility_plan(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    f.opts.aov = GN_AOV_VISIBILITY;
    f.opts.light = 1;
    expect_golden(build(&f), "visibility");
    end(&f);
}

static void test_plan_without_float_and_srgb_targets(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, 1u << GN_CAP_R32UI);
    struct gn_warnings warnings = {0};
    f.opts.encoding = GN_ENCODING_R16F;
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->output, GN_OUTPUT_LINEAR8);
    assert_true(plan->encode_srgb);
    assert_int_equal(plan->shadows[0].encoding, GN_ENCODING_R32UI);
    assert_true(warnings.count > 0);
    assert_non_null(strstr(warnings.text[0], "r16f"));
    expect_golden(plan, "poor");
    end(&f);
}

/* ---- too many lights ---- */

/* The bulb of the stage, `count` times, each stronger than those before it. */
static void make_bulbs(struct fixture *f, struct gn_light *lights, uint32_t count) {
    static char names[64][8];
    for (uint32_t i = 0; i < count; i++) {
        lights[i] = f->scene->lights[2];
        lights[i].name = names[i];
        snprintf(names[i], sizeof names[i], "Bulb %u", i);
        glm_vec3_scale(f->scene->lights[2].color, (float)(i + 1), lights[i].color);
    }
    f->scene->lights = lights;
    f->scene->light_count = count;
}

static void test_a_warning_is_given_once(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[36];
    struct gn_warnings first = {0}, second = {0}, third = {0};
    begin(&f, everything);
    make_bulbs(&f, lights, 36);
    lights[35].technique = "fog";
    build(&f); /* nobody listens */
    gn_frame_build(f.frame, &f.pose, &f.opts, &first);
    assert_int_equal(first.count, 4 + 16 + 1); /* left out, without a map, fog */
    assert_non_null(strstr(first.text[0], "'Bulb 0' is left out: 32 lights are the most"));
    gn_frame_build(f.frame, &f.pose, &f.opts, &second);
    assert_int_equal(second.count, 0);
    f.opts.technique_given = true;
    f.opts.technique = GN_TECHNIQUE_HARD;
    gn_frame_build(f.frame, &f.pose, &f.opts, &third);
    assert_int_equal(third.count, first.count);
    end(&f);
}

static void test_the_strongest_that_are_shown_have_the_maps(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[40];
    struct gn_warnings warnings = {0};
    begin(&f, everything);
    make_bulbs(&f, lights, 40);
    for (int i = 20; i < 40; i++) lights[i].technique = "none";
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->light_count, 32);
    assert_int_equal(plan->shadow_count, 12); /* 8 to 19 */
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        assert_in_range(plan->shadows[i].light, 8, 19);
    assert_int_equal(warnings.count, 8); /* who is left out is not said to cast no shadow as well */
    end(&f);
}

/* ---- slides ---- */

static struct gn_image slide_image = {.width_px = 300, .height_px = 200};
static struct gn_texture slide_texture;

/* The spot of the stage, `count` times, each with a slide. */
static void make_spots(struct fixture *f, struct gn_light *lights, uint32_t count) {
    static char names[8][8];
    for (uint32_t i = 0; i < count; i++) {
        lights[i] = f->scene->lights[1];
        lights[i].name = names[i];
        snprintf(names[i], sizeof names[i], "Spot %u", i);
        lights[i].slide = 0;
        lights[i].slide_lit_outside = i == 1;
    }
    f->scene->lights = lights;
    f->scene->light_count = count;
    f->scene->images = &slide_image;
    f->scene->textures = &slide_texture;
    f->scene->image_count = f->scene->texture_count = 1;
}

static void test_slide_plan(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[2];
    begin(&f, everything);
    make_spots(&f, lights, 2);
    lights[1].technique = "none";
    expect_golden(build(&f), "slide");
    end(&f);
}

static void test_visibility_has_no_slide(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[1];
    begin(&f, everything);
    make_spots(&f, lights, 1);
    f.opts.aov = GN_AOV_VISIBILITY;
    const struct gn_plan *plan = build(&f);
    for (uint32_t i = 0; i < plan->program_count; i++)
        assert_int_equal(plan->programs[i].lights[0].slide, GN_SLIDE_NONE);
    for (uint32_t i = 0; i < plan->pass_count; i++)
        assert_int_equal(plan->passes[i].slide_count, 0);
    end(&f);
}

static void test_slides_over_four_are_left_out_by_order(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[6];
    struct gn_warnings warnings = {0};
    begin(&f, everything);
    make_spots(&f, lights, 6);
    lights[0].technique = lights[1].technique = "none"; /* they go last, and keep theirs */
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->passes[plan->pass_count - 1].slide_count, 4);
    assert_int_equal(warnings.count, 2);
    assert_non_null(strstr(warnings.text[0], "light 'Spot 4' shines without its slide"));
    assert_non_null(strstr(warnings.text[1], "light 'Spot 5' shines without its slide"));
    end(&f);
}

static void test_a_slide_goes_with_its_light_into_an_added_pass(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[5];
    begin(&f, everything);
    make_spots(&f, lights, 5);
    for (int i = 0; i < 4; i++) lights[i].slide = -1;
    const struct gn_plan *plan = build(&f);
    int added = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        bool adds = pass->blend == GN_BLEND_ADD;
        assert_int_equal(pass->slide_count, adds);
        assert_int_equal(pass->constant_count, adds ? PASS_SIZE : PASS_SLIDES);
        if (adds) assert_true(pass->constants[PASS_SLIDES + SLIDE_PLACE][0] == 300);
        added += adds;
    }
    assert_true(added > 0);
    end(&f);
}

/* The shader weighs a pixel in texels: of the picture that this GPU can hold. */
static void test_a_large_slide_counts_the_texels_that_the_gpu_holds(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[1];
    begin(&f, everything);
    gn_frame_destroy(f.frame);
    struct gn_caps small = {.has = everything, .max_texture_px = 128};
    f.frame = gn_frame_create(f.scene, &small);
    make_spots(&f, lights, 1);
    const struct gn_plan *plan = build(&f);
    const float *size = plan->passes[plan->pass_count - 1].constants[PASS_SLIDES + SLIDE_PLACE];
    assert_true(size[0] == 75 && size[1] == 50);
    end(&f);
}

static uint64_t hash_of(struct fixture *f, uint32_t slot) {
    return build(f)->shadows[slot].tiles[0].content_hash;
}

static void test_still_scene_keeps_its_maps(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    uint64_t sun = hash_of(&f, 0), spot = hash_of(&f, 1);
    gn_pose_step(&f.pose, 0);
    assert_true(sun == hash_of(&f, 0));
    assert_true(spot == hash_of(&f, 1));
    end(&f);
}

static void test_a_millimetre_draws_again(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    uint64_t sun = hash_of(&f, 0);
    gn_pose_step(&f.pose, 1000000); /* the mover goes 1 m/s */
    assert_false(sun == hash_of(&f, 0));
    end(&f);
}

static void test_no_allocation_once_grown(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    build(&f);
    unsigned long before = gn_alloc_count();
    for (int i = 1; i < 100; i++) {
        gn_pose_step(&f.pose, i * 16666667);
        build(&f);
    }
    assert_int_equal(gn_alloc_count(), before);
    end(&f);
}

/* The window's corner in texels from the world's origin, which must be whole, and its texel. */
static void corner_in_texels(const struct gn_shadow_view *view, double out[2]) {
    mat4 map_from_light, light_inverse;
    glm_mat4_inv_precise((vec4 *)view->tiles[0].light_from_world, light_inverse);
    glm_mat4_mul((vec4 *)view->map_from_world, light_inverse, map_from_light);
    for (int k = 0; k < 2; k++) out[k] = -(double)map_from_light[3][k] * view->map_px;
}

static void expect_whole_texels(enum gn_technique technique) {
    struct fixture f;
    begin(&f, everything);
    f.opts.width_px = 100; /* a narrow view limits the window */
    f.opts.technique_given = true;
    f.opts.technique = technique;
    struct gn_shadow_view still = build(&f)->shadows[0];
    int moved = 0;
    for (int step = 1; step <= 40; step++) {
        f.opts.turntable_rad = 0.0005f * (float)step;
        const struct gn_shadow_view *view = &build(&f)->shadows[0];
        double corner[2];
        corner_in_texels(view, corner);
        for (int k = 0; k < 2; k++) assert_true(fabs(corner[k] - round(corner[k])) < 0.02);
        if (view->texel != still.texel) continue;
        moved += memcmp(view->tiles[0].clip_from_world, still.tiles[0].clip_from_world,
                        sizeof(mat4)) != 0;
        assert_true(view->near_m == still.near_m && view->far_m == still.far_m);
        for (int c = 0; c < 4; c++)
            assert_true(view->tiles[0].clip_from_world[c][2] ==
                        still.tiles[0].clip_from_world[c][2]);
    }
    assert_true(moved > 0);
    end(&f);
}

static void test_map_moves_by_whole_texels(void **state) {
    (void)state;
    expect_whole_texels(GN_TECHNIQUE_PCF);
    expect_whole_texels(GN_TECHNIQUE_PLANAR);
}

static void test_an_eye_that_sees_no_shadow_needs_no_caster(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    f.opts.camera = 1;
    const struct gn_plan *plan = build(&f);
    assert_int_equal(plan->shadow_count,
                     3); /* the slots stay: programs do not change with the view */
    uint32_t empty = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (plan->passes[i].target.kind == GN_TARGET_SHADOW &&
            plan->shadows[plan->passes[i].target.slot].empty) {
            assert_int_equal(plan->passes[i].draw_count, 0);
            empty++;
        }
    assert_int_not_equal(empty, 0);
    end(&f);
}

static void test_flat_ground_is_not_in_the_map(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    const struct gn_plan *plan = build(&f);
    for (uint32_t i = 0; i < plan->passes[0].draw_count; i++) {
        const struct gn_draw *draw = &plan->draws[plan->passes[0].first_draw + i];
        assert_false(f.scene->geometries[draw->geometry].flat);
    }
    end(&f);
}

static void test_a_far_plane_may_be_as_far_as_numbers_go(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    uint32_t culled = build(&f)->culled;
    f.scene->cameras[0].near_m = 1; /* twice their product would be no float */
    for (float far_m = 3e3f; isfinite(far_m); far_m *= 1e5f) {
        f.scene->cameras[0].far_m = far_m;
        assert_int_equal(build(&f)->culled, culled);
    }
    f.scene->cameras[0].orthographic = true;
    f.scene->cameras[0].xmag_m = f.scene->cameras[0].ymag_m = 5;
    culled = build(&f)->culled;
    f.scene->cameras[0].far_m = 50;
    assert_int_equal(build(&f)->culled, culled);
    end(&f);
}

/* Ten more spots and bulbs along a row, most of them of short range; the bulbs cast nothing. */
static void add_lights(struct fixture *f, struct gn_light lights[13]) {
    static const char *const names[] = {"Lamp 1", "Lamp 2", "Lamp 3", "Lamp 4", "Lamp 5",
                                        "Lamp 6", "Lamp 7", "Lamp 8", "Lamp 9", "Lamp 10"};
    memcpy(lights, f->scene->lights, 3 * sizeof *lights);
    lights[2].technique = "none";
    for (int i = 0; i < 10; i++) {
        lights[3 + i] = lights[i % 2 ? 1 : 2];
        lights[3 + i].name = names[i];
        lights[3 + i].range_m = i < 2 ? 0.0f : i % 2 ? 5.5f : 0.8f + 0.1f * (float)i;
    }
    for (int i = 5; i < 13; i++) lights[i].outer_rad = 0.25f, lights[i].inner_rad = 0.2f;
    f->scene->lights = lights;
    f->scene->light_count = 13;
}

static void test_many_lights_plan(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[13];
    begin(&f, everything);
    add_lights(&f, lights);
    expect_golden(build(&f), "many");
    end(&f);
}

/* Encoding shaders cannot add: the picture is linear, and bytes are made of it at the end. */
static void test_many_lights_without_srgb_plan(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[13];
    begin(&f, everything & ~(1u << GN_CAP_SRGB));
    add_lights(&f, lights);
    const struct gn_plan *plan = build(&f);
    assert_int_equal(plan->output, GN_OUTPUT_FLOAT);
    const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
    assert_int_equal(last->target.kind, GN_TARGET_ENCODED);
    for (uint32_t i = 0; i < plan->program_count; i++)
        assert_false(plan->programs[i].features & GN_FEATURE_ENCODE_SRGB);
    end(&f);
}

static void test_overlay_plan(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    f.opts.show_lights = f.opts.show_maps = true;
    expect_golden(build(&f), "overlay");
    end(&f);
}

/* What a light comes near is known before: no program is made while things move. */
static void test_programs_do_not_change_with_what_is_reached(void **state) {
    (void)state;
    struct fixture f;
    struct gn_light lights[13];
    begin(&f, everything);
    add_lights(&f, lights);
    const struct gn_plan *plan = build(&f);
    uint32_t programs = plan->program_count, passes = plan->pass_count;
    for (int i = 0; i < 13; i++)
        if (lights[i].range_m > 0.0f) lights[i].range_m = 0.001f;
    plan = build(&f);
    assert_true(plan->pass_count < passes);
    assert_int_equal(plan->program_count, programs);
    end(&f);
}

static void test_check_finds_what_is_broken(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    struct gn_plan plan = *build(&f);
    assert_null(gn_plan_check(&plan));
    plan.program_count = 0;
    assert_non_null(gn_plan_check(&plan));
    plan = *build(&f);
    plan.instance_count--;
    assert_non_null(gn_plan_check(&plan));
    plan = *build(&f);
    plan.passes[0].clear = false;
    assert_non_null(gn_plan_check(&plan));
    plan = *build(&f);
    plan.passes[plan.pass_count - 1].blend = GN_BLEND_ADD; /* with programs that do not add */
    assert_non_null(gn_plan_check(&plan));
    plan = *build(&f);
    plan.passes[plan.pass_count - 1].rect = (struct gn_rect){1, 0, plan.width_px, 1};
    assert_non_null(gn_plan_check(&plan));
    plan = *build(&f);
    plan.passes[plan.pass_count - 1].shadow_count = 1; /* its programs read two */
    assert_non_null(gn_plan_check(&plan));
    plan = *build(&f);
    plan.draws[0].geometry = GN_NO_GEOMETRY;
    assert_non_null(gn_plan_check(&plan));
    end(&f);
}

static void test_exposure(void **state) {
    (void)state;
    struct fixture f;
    begin(&f, everything);
    assert_true(build(&f)->exposure == 1.0f); /* 2.5 lux and a little */
    f.opts.exposure_given = true;
    f.opts.exposure_ev = -2.0f;
    assert_true(build(&f)->exposure == 0.25f);
    end(&f);
    begin(&f, everything);
    for (uint32_t i = 0; i < f.scene->light_count; i++)
        glm_vec3_scale(f.scene->lights[i].color, 40000.0f, f.scene->lights[i].color);
    float exposure = build(&f)->exposure;
    assert_true(exposure == exp2f(roundf(log2f(exposure)))); /* a power of two */
    float white = 2.5f * 40000.0f / GLM_PIf * exposure;
    assert_true(white > 0.5f && white < 1.2f);
    end(&f);
}

static void test_no_light_is_too_weak_for_an_exposure(void **state) {
    (void)state;
    for (float scale = 1e-36f; scale > 0.0f; scale *= 1e-2f) {
        struct fixture f;
        begin(&f, everything);
        for (uint32_t i = 0; i < f.scene->light_count; i++)
            glm_vec3_scale(f.scene->lights[i].color, scale, f.scene->lights[i].color);
        assert_null(gn_plan_check(build(&f)));
        end(&f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_default_plan),
        cmocka_unit_test(test_hard_plan),
        cmocka_unit_test(test_planar_plan),
        cmocka_unit_test(test_planar_light_among_others),
        cmocka_unit_test(test_planar_needs_a_plane),
        cmocka_unit_test(test_visibility_plan),
        cmocka_unit_test(test_plan_without_float_and_srgb_targets),
        cmocka_unit_test(test_a_warning_is_given_once),
        cmocka_unit_test(test_the_strongest_that_are_shown_have_the_maps),
        cmocka_unit_test(test_slide_plan),
        cmocka_unit_test(test_visibility_has_no_slide),
        cmocka_unit_test(test_slides_over_four_are_left_out_by_order),
        cmocka_unit_test(test_a_slide_goes_with_its_light_into_an_added_pass),
        cmocka_unit_test(test_a_large_slide_counts_the_texels_that_the_gpu_holds),
        cmocka_unit_test(test_still_scene_keeps_its_maps),
        cmocka_unit_test(test_a_millimetre_draws_again),
        cmocka_unit_test(test_no_allocation_once_grown),
        cmocka_unit_test(test_map_moves_by_whole_texels),
        cmocka_unit_test(test_an_eye_that_sees_no_shadow_needs_no_caster),
        cmocka_unit_test(test_flat_ground_is_not_in_the_map),
        cmocka_unit_test(test_a_far_plane_may_be_as_far_as_numbers_go),
        cmocka_unit_test(test_many_lights_plan),
        cmocka_unit_test(test_many_lights_without_srgb_plan),
        cmocka_unit_test(test_overlay_plan),
        cmocka_unit_test(test_programs_do_not_change_with_what_is_reached),
        cmocka_unit_test(test_check_finds_what_is_broken),
        cmocka_unit_test(test_exposure),
        cmocka_unit_test(test_no_light_is_too_weak_for_an_exposure),
    };
    return RUN(tests);
}
