/* Plans as text against goldens, and what must hold between plans: what is drawn again, and when. A
 * change of rendering is reviewed as the difference of a golden: GN_UPDATE=1 writes them anew. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "plan/fixture.h"
#include "unit/check.h"

static void test_default_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    gn_plan_expect(gn_plan_make(&f), "default");
    gn_plan_end(&f);
}

static void test_hard_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_HARD);
    gn_plan_expect(gn_plan_make(&f), "hard");
    gn_plan_end(&f);
}

static void test_planar_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PLANAR);
    gn_plan_expect(gn_plan_make(&f), "planar");
    gn_plan_end(&f);
}

/* Four frames until all points are there; a step of the clock begins again. */
static void test_plan_of_a_soft_planar_light(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PLANAR);
    f.opts.shadow.planar_points = 64;
    f.opts.shadow.gather_points = 16;
    f.scene->lights[1].radius = 0.3f;
    f.scene->lights[0].radius = 1e-4f; /* one point */
    for (uint32_t drawn = 16; drawn <= 64; drawn += 16) {
        const struct gn_plan *plan = gn_plan_make(&f);
        assert_int_equal(plan->shadows[1].lamp.drawn, drawn);
        assert_int_equal(plan->shadows[0].lamp.drawn, 1);
        assert_int_equal(plan->is_behind, drawn < 64);
    }
    assert_false(gn_plan_make(&f)->is_behind);
    gn_pose_step(&f.pose, 100000000);
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_true(plan->is_behind);
    gn_plan_expect(plan, "soft-planar");
    f.opts.shadow.gather_points = 0;
    assert_int_equal(gn_plan_make(&f)->shadows[1].lamp.drawn, 64);
    gn_plan_end(&f);
}

static void test_planar_plan_in_stencil(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.shadow.planar_in_stencil = true;
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PLANAR);
    gn_plan_expect(gn_plan_make(&f), "stencil");
    gn_plan_end(&f);
}

/* Only a plan with such a light has a stencil; and that whatever is in view. */
static void test_a_stencil_is_there_where_a_light_needs_it(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.shadow.planar_in_stencil = true;
    assert_false(gn_plan_make(&f)->stencil);
    gn_plan_end(&f);
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.shadow.planar_in_stencil = true;
    f.scene->lights[1].technique = "planar"; /* the spot */
    assert_true(gn_plan_make(&f)->stencil);
    f.opts.view.camera = 1;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_true(plan->stencil);
    for (uint32_t i = 0; i < plan->pass_count; i++)
        assert_false(plan->passes[i].kind == GN_PASS_PICTURE &&
                     plan->passes[i].picture.only_stencil);
    gn_plan_end(&f);
}

static void test_a_transparent_plane_has_a_mask(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_warnings warnings = {0};
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (uint32_t i = 0; i < f.scene->item_count; i++)
        if (f.scene->items[i].plane)
            f.scene->materials[f.scene->items[i].material].alpha = GN_ALPHA_BLEND;
    f.opts.shadow.planar_in_stencil = true;
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PLANAR);
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_false(plan->stencil);
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        assert_int_equal(plan->shadows[i].encoding, GN_ENCODING_MASK);
    assert_int_equal(warnings.count, 1);
    gn_plan_end(&f);
}

/* Beside others: what is not on the plane does not ask about it. */
static void test_planar_light_among_others(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.scene->lights[0].technique = "planar"; /* the sun */
    f.scene->lights[2].technique = "none";   /* the bulb */
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_int_equal(plan->shadow_count, 2);
    assert_int_equal(plan->shadows[0].encoding, GN_ENCODING_DEPTH); /* the spot goes first */
    assert_int_equal(plan->shadows[1].encoding, GN_ENCODING_MASK);
    int on_plane = 0;
    for (uint32_t i = 0; i < plan->program_count; i++) {
        const struct gn_program_key *key = &plan->programs[i];
        if (key->kind != GN_PROGRAM_LIT || key->features & GN_FEATURE(UNLIT)) continue;
        assert_int_equal(key->light_count, 3);
        on_plane += key->shadow_count == 2;
    }
    assert_int_equal(on_plane, 1);
    gn_plan_end(&f);
}

static void test_planar_needs_a_plane(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_warnings warnings = {0};
    gn_plan_begin(&f, GN_EVERY_CAP);
    for (uint32_t i = 0; i < f.scene->item_count; i++) f.scene->items[i].plane = false;
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PLANAR);
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->shadow_count, 0);
    assert_int_equal(warnings.count, 3); /* each light */
    assert_non_null(strstr(warnings.text[0], "gnomon_plane"));
    gn_plan_end(&f);
}

static void test_visibility_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.debug.aov = GN_AOV_VISIBILITY;
    f.opts.debug.light = 1;
    gn_plan_expect(gn_plan_make(&f), "visibility");
    gn_plan_end(&f);
}

static void test_plan_without_float_and_srgb_targets(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, 1u << GN_CAP_R32UI);
    struct gn_warnings warnings = {0};
    GN_LIGHT_SET(&f.opts.shadow.any, map_format, GN_MAP_FORMAT(GN_ENCODING_R16F, GN_MOMENTS_NONE));
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    assert_int_equal(plan->output, GN_OUTPUT_LINEAR8);
    assert_true(plan->encode_srgb);
    assert_int_equal(plan->shadows[0].encoding, GN_ENCODING_R32UI);
    assert_true(warnings.count > 0);
    assert_non_null(strstr(warnings.text[0], "r16f"));
    gn_plan_expect(plan, "poor");
    gn_plan_end(&f);
}

static uint64_t hash_of(struct gn_plan_fixture *f, uint32_t slot) {
    return gn_plan_make(f)->shadows[slot].raster.tiles[0].content_hash;
}

static void test_still_scene_keeps_its_maps(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    uint64_t sun = hash_of(&f, 0), spot = hash_of(&f, 1);
    gn_pose_step(&f.pose, 0);
    assert_true(sun == hash_of(&f, 0));
    assert_true(spot == hash_of(&f, 1));
    gn_plan_end(&f);
}

static void test_a_millimetre_draws_again(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    uint64_t sun = hash_of(&f, 0);
    gn_pose_step(&f.pose, 1000000); /* the mover goes 1 m/s */
    assert_false(sun == hash_of(&f, 0));
    gn_plan_end(&f);
}

static void test_no_allocation_once_grown(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    gn_plan_make(&f);
    unsigned long before = gn_alloc_count();
    for (int i = 1; i < 100; i++) {
        gn_pose_step(&f.pose, i * 16666667);
        gn_plan_make(&f);
    }
    assert_int_equal(gn_alloc_count(), before);
    gn_plan_end(&f);
}

/* The window's corner in texels from the world's origin, which must be whole, and its texel. */
static void corner_in_texels(const struct gn_shadow_view *view, double out[2]) {
    mat4 map_from_light, light_inverse;
    glm_mat4_inv_precise((vec4 *)view->raster.tiles[0].light_from_world, light_inverse);
    glm_mat4_mul((vec4 *)view->lookup.map_from_world, light_inverse, map_from_light);
    for (int k = 0; k < 2; k++) out[k] = -(double)map_from_light[3][k] * view->map.tile_px;
}

static void expect_whole_texels(enum gn_technique technique) {
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.output.width_px = 100; /* a narrow view limits the window */
    GN_LIGHT_SET(&f.opts.shadow.any, technique, technique);
    struct gn_shadow_view still = gn_plan_make(&f)->shadows[0];
    int moved = 0;
    for (int step = 1; step <= 40; step++) {
        f.opts.view.turntable_rad = 0.0005f * (float)step;
        const struct gn_shadow_view *view = &gn_plan_make(&f)->shadows[0];
        double corner[2];
        corner_in_texels(view, corner);
        for (int k = 0; k < 2; k++) assert_true(fabs(corner[k] - round(corner[k])) < 0.02);
        if (view->lookup.texel != still.lookup.texel) continue;
        moved += memcmp(view->raster.tiles[0].clip_from_world,
                        still.raster.tiles[0].clip_from_world, sizeof(mat4)) != 0;
        assert_true(view->code.near_m == still.code.near_m && view->code.far_m == still.code.far_m);
        for (int c = 0; c < 4; c++)
            assert_true(view->raster.tiles[0].clip_from_world[c][2] ==
                        still.raster.tiles[0].clip_from_world[c][2]);
    }
    assert_true(moved > 0);
    gn_plan_end(&f);
}

static void test_map_moves_by_whole_texels(void **state) {
    (void)state;
    expect_whole_texels(GN_TECHNIQUE_PCF);
    expect_whole_texels(GN_TECHNIQUE_PLANAR);
}

/* Then its map does not go with the eye: it is kept. */
static void test_a_sun_over_all_that_is_seen_is_one_page(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.view.orbit = (struct gn_orbit){.pitch_rad = 0.4f, .zoom = -1.5f};
    uint64_t kept = 0;
    for (int step = 0; step < 8; step++) {
        f.opts.view.orbit.yaw_rad = 0.8f * (float)step;
        const struct gn_plan *plan = gn_plan_make(&f);
        const struct gn_shadow_view *sun = &plan->shadows[0];
        assert_int_equal(plan->culled, 0);
        assert_true(!sun->raster.drawn.paged && sun->raster.drawn.page_count == 1);
        assert_int_equal(plan->passes[0].target.kind, GN_TARGET_SHADOW);
        assert_int_equal(plan->passes[0].kind, GN_PASS_MAP);
        if (step > 0) assert_true(sun->raster.tiles[0].content_hash == kept);
        kept = sun->raster.tiles[0].content_hash;
    }
    gn_plan_end(&f);
}

/* What is in a page is drawn there and in no other: nothing is drawn twice for want of culling. */
static void test_a_page_draws_what_is_in_it(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    const struct gn_plan *plan = gn_plan_make(&f);
    const struct gn_shadow_view *sun = &plan->shadows[0];
    uint32_t drawn[GN_SHADOW_PAGES_MAX] = {0}, all = 0;
    assert_true(sun->raster.drawn.paged && sun->raster.drawn.page_count == 4);
    for (uint32_t p = 0; p < sun->raster.drawn.page_count; p++) {
        const struct gn_pass *pass = &plan->passes[p];
        assert_int_equal(pass->target.kind, GN_TARGET_PAGES);
        for (uint32_t i = 0; i < pass->draw_count; i++)
            drawn[p] += plan->draws[pass->first_draw + i].instance_count;
        all += drawn[p];
    }
    assert_int_equal(plan->passes[4].target.kind, GN_TARGET_SHADOW);
    assert_int_equal(plan->passes[4].kind, GN_PASS_COPY);
    assert_int_equal(plan->passes[4].copy.count, 4);
    assert_true(drawn[2] > drawn[1] && drawn[2] > drawn[3]); /* the largest part */
    assert_true(all < 2 * drawn[2]);
    gn_plan_end(&f);
}

static void test_an_eye_that_sees_no_shadow_needs_no_caster(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.view.camera = 1;
    const struct gn_plan *plan = gn_plan_make(&f);
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
    gn_plan_end(&f);
}

static void test_flat_ground_is_not_in_the_map(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    const struct gn_plan *plan = gn_plan_make(&f);
    for (uint32_t i = 0; i < plan->passes[0].draw_count; i++) {
        const struct gn_draw *draw = &plan->draws[plan->passes[0].first_draw + i];
        assert_false(f.scene->geometries[draw->geometry].flat);
    }
    gn_plan_end(&f);
}

static void test_a_far_plane_may_be_as_far_as_numbers_go(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    uint32_t culled = gn_plan_make(&f)->culled;
    f.scene->cameras[0].near_m = 1; /* twice their product would be no float */
    for (float far_m = 3e3f; isfinite(far_m); far_m *= 1e5f) {
        f.scene->cameras[0].far_m = far_m;
        assert_int_equal(gn_plan_make(&f)->culled, culled);
    }
    f.scene->cameras[0].orthographic = true;
    f.scene->cameras[0].xmag_m = f.scene->cameras[0].ymag_m = 5;
    culled = gn_plan_make(&f)->culled;
    f.scene->cameras[0].far_m = 50;
    assert_int_equal(gn_plan_make(&f)->culled, culled);
    gn_plan_end(&f);
}

static void test_overlay_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.debug.show_lights = f.opts.debug.show_maps = true;
    gn_plan_expect(gn_plan_make(&f), "overlay");
    gn_plan_end(&f);
}

/* Then makes it anew. */
static void assert_broken(struct gn_plan *plan, struct gn_plan_fixture *f) {
    assert_non_null(gn_plan_check(plan));
    *plan = *gn_plan_make(f);
}

static void test_check_finds_what_is_broken(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    struct gn_plan plan = *gn_plan_make(&f);
    assert_null(gn_plan_check(&plan));
    plan.program_count = 0;
    assert_broken(&plan, &f);
    plan.instance_count--;
    assert_broken(&plan, &f);
    plan.passes[0].clear.area = GN_CLEAR_NOTHING;
    assert_broken(&plan, &f);
    plan.passes[plan.pass_count - 1].picture.blend =
        GN_BLEND_ADD; /* with programs that do not add */
    assert_broken(&plan, &f);
    plan.passes[plan.pass_count - 1].rect = (struct gn_rect){1, 0, plan.width_px, 1};
    assert_broken(&plan, &f);
    plan.passes[plan.pass_count - 1].picture.shadow_count = 1; /* its programs read two */
    assert_broken(&plan, &f);
    plan.draws[0].geometry = GN_NO_GEOMETRY;
    assert_non_null(gn_plan_check(&plan));
    /* passes 0-3 are pages, 4 puts them together */
    plan.passes[3].content.hash++;
    assert_broken(&plan, &f);
    plan.passes[1].clear.area = GN_CLEAR_ALL;
    assert_broken(&plan, &f);
    plan.passes[4].copy.copies[0].to_x = plan.passes[4].target.width_px;
    assert_broken(&plan, &f);
    plan.passes[4].copy.count = 0;
    assert_non_null(gn_plan_check(&plan));
    f.opts.shadow.planar_in_stencil = true;
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PLANAR);
    plan = *gn_plan_make(&f);
    assert_null(gn_plan_check(&plan));
    plan.stencil = false;
    assert_broken(&plan, &f);
    plan.passes[2].picture.only_stencil = false; /* its programs write nothing else */
    assert_broken(&plan, &f);
    plan.passes[1].picture.stencil.value = 0x80, plan.passes[1].picture.stencil.writes = 0x7f;
    assert_broken(&plan, &f);
    plan.passes[1].picture.reads_atlas = true;
    assert_broken(&plan, &f);
    plan.passes[plan.pass_count - 1].picture.resolves = false;
    assert_broken(&plan, &f);
    plan.passes[0].kind = GN_PASS_COPY; /* with a target and draws of a picture */
    assert_non_null(gn_plan_check(&plan));
    gn_plan_end(&f);
}

/* ---- captions ---- */

static const uint8_t glyphs[4 * 8];
static const struct gn_caption_atlas atlas = {4, 8, glyphs, 1};
static const struct gn_caption_quad quads[] = {
    {.x = 30, .y = 600, .width = 200, .height = 45, .caption = GN_CAPTION_MODE, .ground = true},
    {.x = 45, .y = 610, .width = 4, .height = 8, .caption = GN_CAPTION_MODE},
    {.x = 30, .y = 655, .width = 900, .height = 45, .caption = GN_CAPTION_TEXT, .ground = true},
};
static const struct gn_caption_run captions = {1280, 720, quads, 3, {0, 0.5f, 1}, &atlas};

static void test_caption_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    f.opts.cover.captions = &captions;
    gn_plan_expect(gn_plan_make(&f), "caption");
    gn_plan_end(&f);
}

/* One that is gone is no instance, and leaves no bounds; on its side the picture is of another
 * size than this run. */
static void test_captions_that_are_not_seen(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    struct gn_caption_run run = captions;
    gn_plan_begin(&f, GN_EVERY_CAP);
    const uint32_t passes = gn_plan_make(&f)->pass_count;
    run.alpha[GN_CAPTION_TEXT] = 0;
    f.opts.cover.captions = &run;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_int_equal(plan->pass_count, passes + 1);
    assert_int_equal(plan->draws[plan->draw_count - 1].instance_count, 2);
    assert_int_equal(plan->passes[passes].rect.width, 200);
    f.opts.output.turn_deg = 90;
    assert_int_equal(gn_plan_make(&f)->pass_count, passes);
    run.width_px = 720, run.height_px = 1280;
    plan = gn_plan_make(&f);
    assert_int_equal(plan->pass_count, passes + 1);
    assert_int_equal(plan->passes[passes].rect.width, 45);
    assert_int_equal(plan->passes[passes].rect.height, 200);
    f.opts.debug.aov = GN_AOV_NORMAL;
    assert_null(gn_plan_make(&f)->atlas);
    gn_plan_end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_default_plan),
        cmocka_unit_test(test_hard_plan),
        cmocka_unit_test(test_planar_plan),
        cmocka_unit_test(test_plan_of_a_soft_planar_light),
        cmocka_unit_test(test_planar_plan_in_stencil),
        cmocka_unit_test(test_a_stencil_is_there_where_a_light_needs_it),
        cmocka_unit_test(test_a_transparent_plane_has_a_mask),
        cmocka_unit_test(test_planar_light_among_others),
        cmocka_unit_test(test_planar_needs_a_plane),
        cmocka_unit_test(test_visibility_plan),
        cmocka_unit_test(test_plan_without_float_and_srgb_targets),
        cmocka_unit_test(test_still_scene_keeps_its_maps),
        cmocka_unit_test(test_a_millimetre_draws_again),
        cmocka_unit_test(test_no_allocation_once_grown),
        cmocka_unit_test(test_map_moves_by_whole_texels),
        cmocka_unit_test(test_a_sun_over_all_that_is_seen_is_one_page),
        cmocka_unit_test(test_a_page_draws_what_is_in_it),
        cmocka_unit_test(test_an_eye_that_sees_no_shadow_needs_no_caster),
        cmocka_unit_test(test_flat_ground_is_not_in_the_map),
        cmocka_unit_test(test_a_far_plane_may_be_as_far_as_numbers_go),
        cmocka_unit_test(test_overlay_plan),
        cmocka_unit_test(test_caption_plan),
        cmocka_unit_test(test_captions_that_are_not_seen),
        cmocka_unit_test(test_check_finds_what_is_broken),
    };
    return RUN(tests);
}
