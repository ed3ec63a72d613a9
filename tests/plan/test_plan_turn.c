/* Only the camera moves: no map is drawn again, and none is filtered. */
#include <cglm/cglm.h>
#include <stdio.h>
#include <string.h>

#include "plan/field_scene.h"
#include "plan/fixture.h"
#include "plan/redrawn.h"
#include "plan/stage_scene.h"
#include "unit/check.h"

enum { STEPS = 12 };

/* clips: as gn_pose_init() wants them. */
static void begin(struct gn_plan_fixture *f, struct gn_scene *scene, int clips) {
    const struct gn_caps caps = {
        .has = GN_EVERY_CAP, .max_texture_px = 4096, .max_texture_units = 16};
    *f = (struct gn_plan_fixture){.scene = scene};
    gn_pose_init(&f->pose, scene, clips);
    gn_pose_step(&f->pose, 0);
    f->frame = gn_frame_create(scene, &caps);
}

static struct gn_scene *load(const char *path) {
    struct gn_err err = {0};
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

enum way { TURNTABLE, FINGER, FLIGHT, WAYS };

static void move(struct gn_plan_fixture *f, enum way way, int step) {
    struct gn_orbit *orbit = &f->opts.view.orbit;
    const float at = (float)step / STEPS;
    if (way == TURNTABLE) f->opts.view.turntable_rad = 2 * GLM_PIf * at;
    if (way == FINGER)
        orbit->yaw_rad = .5f * at, orbit->pitch_rad = -.1f * at, orbit->zoom = .1f * at;
    if (way == FLIGHT) orbit->shift_m[0] = at, orbit->shift_m[2] = -at;
}

/* All that is drawn again of maps while the camera goes that way. */
static struct gn_redrawn redrawn_on(struct gn_plan_fixture *f, enum way way) {
    struct gn_kept kept[GN_ALL_SHADOWS_MAX] = {0};
    struct gn_redrawn first[GN_ALL_SHADOWS_MAX] = {0}, next[GN_ALL_SHADOWS_MAX] = {0}, all = {0};
    for (int step = 0; step < STEPS; step++) {
        move(f, way, step);
        const struct gn_plan *plan = gn_plan_make(f);
        const char *broken = gn_plan_check(plan);
        if (broken) fail_msg("%s", broken);
        gn_redrawn_add(plan, kept, step == 0 ? first : next);
    }
    for (int slot = 0; slot < GN_ALL_SHADOWS_MAX; slot++) {
        all.passes += next[slot].passes;
        all.draws += next[slot].draws;
        all.filters += next[slot].filters;
    }
    return all;
}

static void expect_kept(struct gn_plan_fixture *f, const char *what) {
    for (int t = GN_TECHNIQUE_HARD; t < GN_TECHNIQUE_COUNT; t++)
        for (enum way way = 0; way < WAYS; way++) {
            f->opts.view = (struct gn_frame_view_opts){.camera = f->opts.view.camera};
            GN_LIGHT_SET(&f->opts.shadow.any, technique, (enum gn_technique)t);
            const struct gn_redrawn all = redrawn_on(f, way);
            if (all.passes || all.filters)
                fail_msg("%s, %s, way %d: %u passes, %u draws, %u of filters", what,
                         gn_techniques[t].name, way, all.passes, all.draws, all.filters);
        }
}

/* A sun, a spot and a point light; suns that cascades were for; sundials with lanterns. */
static void test_still_scenes_are_drawn_once(void **state) {
    (void)state;
    static const char *const paths[] = {"assets/bench/yard.glb", "assets/bench/s1.glb",
                                        "assets/bench/s2.glb", "assets/lessons/lights.glb",
                                        "assets/lessons/lattice.glb"};
    struct gn_plan_fixture f;
    begin(&f, gn_stage_scene_make(), GN_POSE_NONE);
    expect_kept(&f, "stage");
    gn_plan_end(&f);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        begin(&f, load(paths[i]), GN_POSE_NONE);
        expect_kept(&f, paths[i]);
        gn_plan_end(&f);
    }
}

/* What moves is drawn anyhow: only what this eye sees of it. */
static void test_spots_of_moving_casters_follow_the_eye(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_stage_scene_make(), GN_POSE_DEFAULT);
    const struct gn_plan *plan = gn_plan_make(&f);
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        if (plan->shadows[i].perspective) assert_false(plan->shadows[i].fixed);
    gn_plan_end(&f);
}

/* No map of 2048 comes near to what cascades are for there. */
static void test_a_field_keeps_its_cascades(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), GN_POSE_NONE);
    assert_int_equal(gn_plan_make(&f)->shadows[0].map.cascade_count, 4);
    assert_true(redrawn_on(&f, TURNTABLE).passes > 0);
    gn_plan_end(&f);
}

/* At most half as large again; a size that is asked for stays. */
static void test_a_fixed_map_is_fine_enough(void **state) {
    (void)state;
    for (uint32_t px = 0; px <= 2048; px += 1024) {
        struct gn_plan_fixture f;
        begin(&f, load("assets/bench/yard.glb"), GN_POSE_NONE);
        if (px) GN_LIGHT_SET(&f.opts.shadow.any, map_px, px);
        GN_LIGHT_SET(&f.opts.shadow.any, cascades, px ? 1 : 0);
        const struct gn_shadow_view fixed = gn_plan_make(&f)->shadows[0];
        assert_true(fixed.fixed && fixed.map.cascade_count == 0);
        assert_int_equal(fixed.map.tile_px, px ? px : 2048);
        GN_LIGHT_SET(&f.opts.shadow.any, cascades, 2);
        const struct gn_shadow_view two = gn_plan_make(&f)->shadows[0];
        assert_true(!two.fixed && two.map.cascade_count == 2);
        if (px == 0) assert_true(fixed.lookup.texel <= two.cascades[1].texel * 1.5f);
        gn_plan_end(&f);
    }
}

/* A hand that brings the eye to a detail gets the fine map that follows; back home the other one.
 */
static void test_a_detail_has_a_map_of_its_own(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, load("assets/bench/s1.glb"), GN_POSE_NONE);
    const float texel = gn_plan_make(&f)->shadows[0].lookup.texel;
    assert_true(gn_plan_make(&f)->shadows[0].fixed);
    f.opts.view.orbit.zoom = 3.0f;
    const struct gn_shadow_view near = gn_plan_make(&f)->shadows[0];
    assert_false(near.fixed);
    assert_true((near.map.cascade_count ? near.cascades[0].texel : near.lookup.texel) < texel);
    f.opts.view.orbit = (struct gn_orbit){0};
    assert_true(gn_plan_make(&f)->shadows[0].fixed);
    assert_true(gn_plan_make(&f)->shadows[0].lookup.texel == texel);
    gn_plan_end(&f);
}

/* Maps of 2048 are not for a limit that would halve them. */
static void test_a_limit_keeps_maps_narrow(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, load("assets/bench/yard.glb"), GN_POSE_NONE);
    f.opts.shadow.maps_bytes = 30 << 20;
    assert_int_equal(gn_plan_make(&f)->shadows[0].map.cascade_count, 2);
    gn_plan_end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_still_scenes_are_drawn_once),
        cmocka_unit_test(test_spots_of_moving_casters_follow_the_eye),
        cmocka_unit_test(test_a_field_keeps_its_cascades),
        cmocka_unit_test(test_a_fixed_map_is_fine_enough),
        cmocka_unit_test(test_a_detail_has_a_map_of_its_own),
        cmocka_unit_test(test_a_limit_keeps_maps_narrow),
    };
    return RUN(tests);
}
