/* Plans of many lights, of too many, of slides and of strong and weak ones. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "plan/fixture.h"
#include "unit/check.h"

static void test_many_lights_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[13];
    gn_plan_begin(&f, GN_EVERY_CAP);
    gn_plan_add_lights(&f, lights);
    gn_plan_expect(gn_plan_make(&f), "many");
    gn_plan_end(&f);
}

/* Whatever is asked for, and whatever the technique stores. */
static void test_maps_are_reduced_until_they_fit_the_limit(void **state) {
    (void)state;
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        struct gn_plan_fixture f;
        struct gn_light lights[13];
        gn_plan_begin(&f, GN_EVERY_CAP);
        gn_plan_add_lights(&f, lights);
        GN_LIGHT_SET(&f.opts.shadow.any, technique, (enum gn_technique)t);
        GN_LIGHT_SET(&f.opts.shadow.any, map_px, 1024);
        const uint64_t asked = gn_plan_map_bytes(gn_plan_make(&f));
        for (uint64_t mb = 1; mb <= 64; mb *= 4) {
            struct gn_warnings warnings = {0};
            f.opts.shadow.maps_bytes = mb << 20;
            const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
            assert_null(gn_plan_check(plan));
            assert_true(gn_plan_map_bytes(plan) <= mb << 20);
            uint32_t least = 1024, most = 0;
            for (uint32_t i = 0; i < plan->shadow_count; i++) {
                const uint32_t px = plan->shadows[i].map.tile_px;
                least = px < least ? px : least;
                most = px > most ? px : most;
            }
            assert_true(most <= 2 * least); /* all alike */
            int said = 0;
            for (int i = 0; i < warnings.count; i++)
                said += strstr(warnings.text[i], "exceed the limit maps_mb=") != NULL;
            assert_int_equal(said, asked > mb << 20);
        }
        f.opts.shadow.maps_bytes = 2 * asked; /* with pages that this eye does not need */
        assert_int_equal(gn_plan_map_bytes(gn_plan_make(&f)), asked);
        gn_plan_end(&f);
    }
}

/* Six tiles, three in a row; a map of one tile fits. */
static void test_a_map_that_is_too_large_is_made_smaller_and_said_so(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_warnings warnings = {0};
    gn_plan_begin(&f, GN_EVERY_CAP);
    const struct gn_caps caps = {.has = GN_EVERY_CAP, .max_texture_px = 3000};
    gn_frame_destroy(f.frame);
    f.frame = gn_frame_create(f.scene, &caps);
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 2048);
    f.opts.shadow.cascades = 1;
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        assert_int_equal(plan->shadows[i].map.tile_px,
                         plan->shadows[i].map.tile_count > 1 ? 1000 : 2048);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "tiles of 2048 px"));
    assert_non_null(strstr(warnings.text[0], "using 1000 px"));
    gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(warnings.count, 1); /* once */
    gn_plan_end(&f);
}

/* What shaders read by a name of blocks.glsl is what the view has under it. */
static void expect_constants(const struct gn_shadow_view *view, const float (*c)[4]) {
    const bool cascades = view->map.cascade_count > 0;
    assert_true(c[SHADOW_PLACE][PLACE_CODE_SCALE] == view->code.scale);
    if (view->perspective) {
        assert_true(c[SHADOW_BIAS][BIAS_LEAST] == 1.0f / view->lookup.slope_max);
        assert_true(c[SHADOW_CODE][CODE_OFFSET] ==
                    view->code.offset - view->code.ulp_m * view->code.scale);
    } else {
        assert_true(c[SHADOW_BIAS][BIAS_SLOPE_MAX] == view->lookup.slope_max);
        assert_true(c[SHADOW_BIAS][BIAS_ULP] == view->code.ulp_m);
        assert_true(c[SHADOW_CODE][CODE_OFFSET] == view->code.offset);
    }
    assert_true(c[SHADOW_CODE][CODE_FAR_END] == view->code.far_end);
    assert_true(c[SHADOW_CODE][CODE_REACH] == view->lookup.reach_px);
    assert_true(c[SHADOW_PENUMBRA][PENUMBRA_RADIUS] == view->penumbra.radius);
    assert_true(c[SHADOW_PENUMBRA][PENUMBRA_SCALE] == view->penumbra.scale);
    assert_true(c[SHADOW_PENUMBRA][PENUMBRA_BIAS] == view->penumbra.bias);
    if (cascades) {
        assert_true(c[SHADOW_CODE][CODE_HELD] == view->lookup.held_px);
        assert_true(c[SHADOW_PENUMBRA][PENUMBRA_GROWTH] == view->penumbra.growth);
    } else {
        const float shared = view->lookup.shared;
        assert_true(c[SHADOW_CODE][CODE_SHARED] == 1.0f - shared);
        assert_true(c[SHADOW_PENUMBRA][PENUMBRA_NEAREST] == view->penumbra.nearest);
    }
}

static void test_constants_are_those_of_the_view(void **state) {
    (void)state;
    for (uint32_t cascades = 1; cascades <= GN_CASCADES_MAX; cascades += 2) {
        struct gn_plan_fixture f;
        gn_plan_begin(&f, GN_EVERY_CAP);
        GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCSS);
        f.opts.shadow.cascades = cascades;
        const struct gn_plan *plan = gn_plan_make(&f);
        const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
        assert_true(last->picture.shadow_count > 0);
        for (uint32_t i = 0; i < last->picture.shadow_count; i++)
            expect_constants(&plan->shadows[last->picture.first_shadow + i],
                             last->constants + PASS_SHADOWS + i * SHADOW_SIZE);
        gn_plan_end(&f);
    }
}

/* Passes of maps and those of a planar light in the stencil keep constants of their own: what one
 * light is drawn with is not overwritten for another. The point light's map has six tiles, slot 0;
 * the planar light has slot 2. */
static void test_no_pass_overwrites_constants_of_another(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    struct gn_light lights[3] = {f.scene->lights[2], f.scene->lights[1], f.scene->lights[0]};
    lights[0].technique = lights[1].technique = "pcf";
    lights[2].technique = "planar";
    f.scene->lights = lights;
    f.pose.lights = lights;
    f.opts.shadow.planar_in_stencil = true;
    const struct gn_plan *plan = gn_plan_make(&f);
    bool in_stencil = false;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *a = &plan->passes[i];
        in_stencil |= a->kind == GN_PASS_PICTURE && a->picture.only_stencil;
        for (uint32_t k = i + 1; k < plan->pass_count; k++) {
            const struct gn_pass *b = &plan->passes[k];
            const bool shared = a->constants == b->constants && a->kind == b->kind &&
                                a->constant_count == b->constant_count;
            assert_true(shared || a->constants + a->constant_count <= b->constants ||
                        b->constants + b->constant_count <= a->constants);
        }
    }
    assert_true(in_stencil);
    gn_plan_end(&f);
}

/* A table per light: five passes a tile; a map of 512 unless it is given. */
static void test_tables_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_SMSM);
    gn_plan_expect(gn_plan_make(&f), "tables");
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 100); /* no whole number of blocks */
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_null(gn_plan_check(plan));
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_target *target = &plan->passes[i].target;
        if (target->kind != GN_TARGET_MOMENTS || target->index != 2) continue;
        const struct gn_shadow_view *view = &plan->shadows[target->slot];
        assert_int_equal(target->width_px, 7 * view->map.tile_count);
        assert_int_equal(target->height_px, 100);
    }
    gn_plan_end(&f);
}

/* Encoding shaders cannot add: the picture is linear, and bytes are made of it at the end. */
static void test_many_lights_without_srgb_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[13];
    gn_plan_begin(&f, GN_EVERY_CAP & ~(1u << GN_CAP_SRGB));
    gn_plan_add_lights(&f, lights);
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_int_equal(plan->output, GN_OUTPUT_FLOAT);
    const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
    assert_int_equal(last->target.kind, GN_TARGET_ENCODED);
    for (uint32_t i = 0; i < plan->program_count; i++)
        assert_int_equal((plan->programs[i].features & GN_FEATURE(ENCODE_SRGB)) != 0,
                         plan->programs[i].kind == GN_PROGRAM_ENCODE);
    gn_plan_end(&f);
}

/* What a light comes near is known before: no program is made while things move. */
static void test_programs_do_not_change_with_what_is_reached(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[13];
    gn_plan_begin(&f, GN_EVERY_CAP);
    gn_plan_add_lights(&f, lights);
    const struct gn_plan *plan = gn_plan_make(&f);
    uint32_t programs = plan->program_count, passes = plan->pass_count;
    for (int i = 0; i < 13; i++)
        if (lights[i].range_m > 0.0f) lights[i].range_m = 0.001f;
    plan = gn_plan_make(&f);
    assert_true(plan->pass_count < passes);
    assert_int_equal(plan->program_count, programs);
    gn_plan_end(&f);
}

/* ---- too many lights ---- */

/* The bulb of the stage, `count` times, each stronger than those before it. */
static void make_bulbs(struct gn_plan_fixture *f, struct gn_light *lights, uint32_t count) {
    static char names[64][8];
    for (uint32_t i = 0; i < count; i++) {
        lights[i] = f->scene->lights[2];
        lights[i].name = names[i];
        snprintf(names[i], sizeof names[i], "Bulb %u", i);
        glm_vec3_scale(f->scene->lights[2].color, (float)(i + 1), lights[i].color);
    }
    f->scene->lights = lights;
    f->pose.lights = lights;
    f->scene->light_count = count;
}

static void test_a_warning_is_given_once(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[36];
    struct gn_warnings first = {0}, second = {0}, third = {0};
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_bulbs(&f, lights, 36);
    lights[35].technique = "fog";
    gn_plan_make(&f); /* nobody listens */
    gn_frame_build(f.frame, &f.pose, &f.opts, &first);
    assert_int_equal(first.count, 4 + 16 + 1); /* left out, without a map, fog */
    assert_non_null(strstr(first.text[0], "'Bulb 0' is left out: at most 32 lights"));
    gn_frame_build(f.frame, &f.pose, &f.opts, &second);
    assert_int_equal(second.count, 0);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_HARD);
    gn_frame_build(f.frame, &f.pose, &f.opts, &third);
    assert_int_equal(third.count, first.count);
    gn_plan_end(&f);
}

static void test_the_strongest_that_are_shown_have_the_maps(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[40];
    struct gn_warnings warnings = {0};
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_bulbs(&f, lights, 40);
    for (int i = 20; i < 40; i++) lights[i].technique = "none";
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->light_count, 32);
    assert_int_equal(plan->shadow_count, 12); /* 8 to 19 */
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        assert_in_range(plan->shadows[i].light, 8, 19);
    assert_int_equal(warnings.count, 8); /* who is left out is not said to cast no shadow as well */
    gn_plan_end(&f);
}

/* ---- slides ---- */

static struct gn_image slide_image = {.width_px = 300, .height_px = 200};
static struct gn_texture slide_texture;

/* The spot of the stage, `count` times, each with a slide. */
static void make_spots(struct gn_plan_fixture *f, struct gn_light *lights, uint32_t count) {
    static char names[8][8];
    for (uint32_t i = 0; i < count; i++) {
        lights[i] = f->scene->lights[1];
        lights[i].name = names[i];
        snprintf(names[i], sizeof names[i], "Spot %u", i);
        lights[i].slide = 0;
        lights[i].slide_lit_outside = i == 1;
    }
    f->scene->lights = lights;
    f->pose.lights = lights;
    f->scene->light_count = count;
    f->scene->pictures.images = &slide_image;
    f->scene->pictures.textures = &slide_texture;
    f->scene->pictures.image_count = f->scene->pictures.texture_count = 1;
}

static void test_slide_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[2];
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_spots(&f, lights, 2);
    lights[1].technique = "none";
    gn_plan_expect(gn_plan_make(&f), "slide");
    gn_plan_end(&f);
}

static void test_visibility_has_no_slide(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[1];
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_spots(&f, lights, 1);
    f.opts.debug.aov = GN_AOV_VISIBILITY;
    const struct gn_plan *plan = gn_plan_make(&f);
    for (uint32_t i = 0; i < plan->program_count; i++)
        assert_int_equal(plan->programs[i].lights[0].slide, GN_SLIDE_NONE);
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (plan->passes[i].kind == GN_PASS_PICTURE)
            assert_int_equal(plan->passes[i].picture.slide_count, 0);
    gn_plan_end(&f);
}

static void test_slides_over_four_are_left_out_by_order(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[6];
    struct gn_warnings warnings = {0};
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_spots(&f, lights, 6);
    lights[0].technique = lights[1].technique = "none"; /* they go last, and keep theirs */
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->passes[plan->pass_count - 1].picture.slide_count, 4);
    assert_int_equal(warnings.count, 2);
    assert_non_null(strstr(warnings.text[0], "light 'Spot 4' has no slide"));
    assert_non_null(strstr(warnings.text[1], "light 'Spot 5' has no slide"));
    gn_plan_end(&f);
}

static void test_a_slide_goes_with_its_light_into_an_added_pass(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[5];
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_spots(&f, lights, 5);
    for (int i = 0; i < 4; i++) lights[i].slide = -1;
    const struct gn_plan *plan = gn_plan_make(&f);
    int added = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        if (pass->kind != GN_PASS_PICTURE) continue;
        bool adds = pass->picture.blend == GN_BLEND_ADD;
        assert_int_equal(pass->picture.slide_count, adds);
        assert_int_equal(pass->constant_count, adds ? PASS_CASCADES : PASS_SLIDES);
        if (adds) assert_true(pass->constants[PASS_SLIDES + SLIDE_PLACE][0] == 300);
        added += adds;
    }
    assert_true(added > 0);
    gn_plan_end(&f);
}

/* The shader weighs a pixel in texels: of the picture that this GPU can hold. */
static void test_a_large_slide_counts_the_texels_that_the_gpu_holds(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[1];
    gn_plan_begin(&f, GN_EVERY_CAP);
    gn_frame_destroy(f.frame);
    struct gn_caps small = {.has = GN_EVERY_CAP, .max_texture_px = 128};
    f.frame = gn_frame_create(f.scene, &small);
    make_spots(&f, lights, 1);
    const struct gn_plan *plan = gn_plan_make(&f);
    const float *size = plan->passes[plan->pass_count - 1].constants[PASS_SLIDES + SLIDE_PLACE];
    assert_true(size[0] == 75 && size[1] == 50);
    gn_plan_end(&f);
}

/* 300 x 200: as wide as the cone, and two thirds as high. */
static void test_a_slide_may_have_the_shape_of_its_picture(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_light lights[1];
    gn_plan_begin(&f, GN_EVERY_CAP);
    make_spots(&f, lights, 1);
    float square[3][4], shaped[3][4];
    const struct gn_plan *plan = gn_plan_make(&f);
    memcpy(square, plan->passes[plan->pass_count - 1].constants[PASS_SLIDES], sizeof square);
    GN_LIGHT_SET(&f.opts.shadow.any, slide_as_picture, true);
    plan = gn_plan_make(&f);
    memcpy(shaped, plan->passes[plan->pass_count - 1].constants[PASS_SLIDES], sizeof shaped);
    assert_memory_equal(shaped[SLIDE_U], square[SLIDE_U], sizeof square[0]);
    for (int c = 0; c < 4; c++) {
        const float middle = 0.5f * square[SLIDE_W][c];
        const float by = (shaped[SLIDE_V][c] - middle) - 1.5f * (square[SLIDE_V][c] - middle);
        assert_true(fabsf(by) < 1e-4f);
    }
    lights[0].slide_size_m[0] = lights[0].slide_size_m[1] = 0.1f; /* as given */
    plan = gn_plan_make(&f);
    memcpy(shaped, plan->passes[plan->pass_count - 1].constants[PASS_SLIDES], sizeof shaped);
    for (int c = 0; c < 4; c++) assert_true(fabsf(shaped[SLIDE_V][c] - square[SLIDE_V][c]) < 1e-4f);
    gn_plan_end(&f);
}

/* As the scene says of the light, or options of all, or of it alone; a bit of the program's key. */
static void test_a_slide_may_have_a_far_plane(void **state) {
    (void)state;
    static const struct {
        float scene_m, all_m, own_m; /* below 0: not given */
        float far_m;
    } rows[] = {{0, -1, -1, 0}, {6, -1, -1, 6}, {6, 4, -1, 4}, {6, 0, -1, 0}, {6, 4, 3, 3}};
    for (int i = 0; i < 5; i++) {
        struct gn_plan_fixture f;
        struct gn_light lights[1];
        gn_plan_begin(&f, GN_EVERY_CAP);
        make_spots(&f, lights, 1);
        lights[0].slide_far_m = rows[i].scene_m;
        if (rows[i].all_m >= 0) GN_LIGHT_SET(&f.opts.shadow.any, slide_far_m, rows[i].all_m);
        f.opts.shadow.lights[0] =
            (struct gn_light_opts){.given = rows[i].own_m >= 0 ? GN_LIGHT_GIVEN(slide_far_m) : 0,
                                   .slide_far_m = rows[i].own_m};
        f.opts.shadow.light_count = 1;
        const struct gn_plan *plan = gn_plan_make(&f);
        const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
        assert_true(last->constants[PASS_SLIDES + SLIDE_PLACE][3] == rows[i].far_m);
        for (uint32_t p = 0; p < plan->program_count; p++)
            if (plan->programs[p].lights[0].slide)
                assert_int_equal(plan->programs[p].lights[0].slide_ends, rows[i].far_m > 0);
        gn_plan_end(&f);
    }
}

/* ---- exposure ---- */

static void test_exposure(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    assert_true(gn_plan_make(&f)->exposure == 1.0f); /* 2.5 lux and a little */
    f.opts.exposure_given = true;
    f.opts.exposure_ev = -2.0f;
    assert_true(gn_plan_make(&f)->exposure == 0.25f);
    gn_plan_end(&f);
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (uint32_t i = 0; i < f.scene->light_count; i++)
        glm_vec3_scale(f.scene->lights[i].color, 40000.0f, f.scene->lights[i].color);
    float exposure = gn_plan_make(&f)->exposure;
    assert_true(exposure == exp2f(roundf(log2f(exposure)))); /* a power of two */
    float white = 2.5f * 40000.0f / GLM_PIf * exposure;
    assert_true(white > 0.5f && white < 1.2f);
    gn_plan_end(&f);
}

static void test_no_light_is_too_weak_for_an_exposure(void **state) {
    (void)state;
    for (float scale = 1e-36f; scale > 0.0f; scale *= 1e-2f) {
        struct gn_plan_fixture f;
        gn_plan_begin(&f, GN_EVERY_CAP);
        for (uint32_t i = 0; i < f.scene->light_count; i++)
            glm_vec3_scale(f.scene->lights[i].color, scale, f.scene->lights[i].color);
        assert_null(gn_plan_check(gn_plan_make(&f)));
        gn_plan_end(&f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_many_lights_plan),
        cmocka_unit_test(test_maps_are_reduced_until_they_fit_the_limit),
        cmocka_unit_test(test_constants_are_those_of_the_view),
        cmocka_unit_test(test_no_pass_overwrites_constants_of_another),
        cmocka_unit_test(test_tables_plan),
        cmocka_unit_test(test_a_map_that_is_too_large_is_made_smaller_and_said_so),
        cmocka_unit_test(test_many_lights_without_srgb_plan),
        cmocka_unit_test(test_programs_do_not_change_with_what_is_reached),
        cmocka_unit_test(test_a_warning_is_given_once),
        cmocka_unit_test(test_the_strongest_that_are_shown_have_the_maps),
        cmocka_unit_test(test_slide_plan),
        cmocka_unit_test(test_a_slide_may_have_the_shape_of_its_picture),
        cmocka_unit_test(test_a_slide_may_have_a_far_plane),
        cmocka_unit_test(test_visibility_has_no_slide),
        cmocka_unit_test(test_slides_over_four_are_left_out_by_order),
        cmocka_unit_test(test_a_slide_goes_with_its_light_into_an_added_pass),
        cmocka_unit_test(test_a_large_slide_counts_the_texels_that_the_gpu_holds),
        cmocka_unit_test(test_exposure),
        cmocka_unit_test(test_no_light_is_too_weak_for_an_exposure),
    };
    return RUN(tests);
}
