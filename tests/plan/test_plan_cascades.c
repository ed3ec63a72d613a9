/* Plans of a scene that one map is too coarse for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/frame.h"
#include "plan/field_scene.h"
#include "plan/fixture.h"
#include "unit/check.h"

static void begin(struct gn_plan_fixture *f, struct gn_scene *scene, int32_t max_texture_px) {
    const struct gn_caps caps = {
        .has = GN_EVERY_CAP, .max_texture_px = max_texture_px, .max_texture_units = 16};
    f->scene = scene;
    gn_pose_init(&f->pose, f->scene, GN_POSE_DEFAULT);
    gn_pose_step(&f->pose, 0);
    f->frame = gn_frame_create(f->scene, &caps);
    f->opts = (struct gn_frame_opts){0};
}

static const struct gn_shadow_view *view_of(struct gn_plan_fixture *f) {
    const struct gn_plan *plan = gn_plan_make(f);
    const char *broken = gn_plan_check(plan);
    if (broken) fail_msg("%s", broken);
    return &plan->shadows[0];
}

static void test_field_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    gn_plan_expect(gn_plan_make(&f), "field");
    gn_plan_end(&f);
}

/* What they hold of the field does not depend on how large a metre is. */
static void expect_same_at(float scale) {
    struct gn_plan_fixture one, other;
    begin(&one, gn_field_scene_make(), 4096);
    begin(&other, gn_field_scene_make_scaled(scale), 4096);
    const struct gn_shadow_view *a = view_of(&one), *b = view_of(&other);
    assert_int_equal(a->map.cascade_count, 4);
    assert_int_equal(b->map.cascade_count, 4);
    for (int i = 0; i < 4; i++) {
        assert_false(b->raster.tiles[i].empty);
        const float ratio = b->cascades[i].texel / (scale * a->cascades[i].texel);
        assert_true(ratio > 0.66f && ratio < 1.5f); /* steps of distances and texels */
    }
    gn_plan_end(&one);
    gn_plan_end(&other);
}

static void test_small_and_huge_scenes_have_them_too(void **state) {
    (void)state;
    expect_same_at(1e-3f);
    expect_same_at(1e3f);
}

static void test_each_serves_what_the_last_does_not(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    const struct gn_shadow_view *view = view_of(&f);
    assert_true(view->cascades[0].begin_m == 0.0f);
    assert_true(isinf(view->cascades[view->map.cascade_count - 1].end_m));
    for (uint32_t i = 1; i < view->map.cascade_count; i++) {
        const struct gn_shadow_cascade *last = &view->cascades[i - 1], *c = &view->cascades[i];
        assert_true(c->begin_m < last->end_m && c->begin_m > last->begin_m);
        assert_true(c->begin_m >
                    (i > 1 ? view->cascades[i - 2].end_m : 0.0f)); /* zones are apart */
        assert_true(c->texel >= last->texel);
    }
    gn_plan_end(&f);
}

static void test_a_moving_eye_changes_neither_number_nor_program(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    const uint32_t width_px = view_of(&f)->map.width_px;
    for (int i = 0; i < 40; i++) {
        f.opts.view.orbit.zoom = 1.0f + 0.1f * (float)i;
        f.opts.view.orbit.shift_m[2] = -3.0f * (float)i;
        f.opts.view.turntable_rad = 0.16f * (float)i;
        const struct gn_shadow_view *view = view_of(&f);
        assert_int_equal(view->map.cascade_count, 4);
        assert_int_equal(view->map.width_px, width_px);
        const struct gn_plan *plan = gn_plan_make(&f);
        for (uint32_t p = 0; p < plan->program_count; p++)
            if (plan->programs[p].kind == GN_PROGRAM_LIT)
                assert_int_equal(plan->programs[p].lights[0].cascades, 1);
    }
    gn_plan_end(&f);
}

/* And never fewer: the eye goes back again. */
static void test_an_eye_that_a_hand_brings_near_gets_more(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    f.opts.view.orbit.zoom = -5.0f;
    const uint32_t first = view_of(&f)->map.tile_count;
    uint32_t last = first;
    int changes = 0;
    for (int i = 0; i <= 200; i++) {
        f.opts.view.orbit.zoom = -0.05f * (float)abs(100 - i);
        const uint32_t count = view_of(&f)->map.tile_count;
        assert_true(count >= last);
        changes += count != last;
        last = count;
    }
    printf("from %u to %u cascades, %d changes\n", first, last, changes);
    assert_true(first < 3 && last >= 3 && changes <= 3);
    gn_plan_end(&f);
}

/* To one that looks along the light a shadow is as fine as what throws it: one map does. */
static void test_every_camera_has_a_plan(void **state) {
    (void)state;
    for (int camera = GN_FIELD_STANDING; camera <= GN_FIELD_ORTHOGRAPHIC; camera++)
        for (unsigned turn = 0; turn < 360; turn += 90) {
            struct gn_plan_fixture f;
            begin(&f, gn_field_scene_make(), 4096);
            f.opts.view.camera = camera;
            f.opts.output.turn_deg = turn;
            const struct gn_shadow_view *view = view_of(&f);
            const bool some = camera == GN_FIELD_STANDING || camera == GN_FIELD_INSIDE;
            assert_int_equal(view->map.cascade_count, some ? 4 : 0);
            for (uint32_t i = 0; i < view->map.cascade_count; i++)
                assert_true(view->raster.tiles[i].empty || isfinite(view->cascades[i].texel));
            gn_plan_end(&f);
        }
}

static void test_an_atlas_is_no_larger_than_a_texture(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 2048);
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 2048);
    const struct gn_shadow_view *view = view_of(&f);
    assert_int_equal(view->map.width_px, 2048);
    assert_int_equal(view->map.height_px, 2048);
    assert_int_equal(view->map.tile_px, 1024);
    f.opts.shadow.cascades = 1;
    assert_int_equal(view_of(&f)->map.tile_px, 2048);
    gn_plan_end(&f);
}

static void test_as_many_as_asked_for_at_most(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    for (uint32_t most = 1; most <= 4; most++) {
        f.opts.shadow.cascades = most;
        const struct gn_shadow_view *view = view_of(&f);
        assert_int_equal(view->map.cascade_count, most == 1 ? 0 : most);
        assert_false(view->empty);
        assert_int_equal(view->map.height_px, most > 2 ? 2048 : 1024);
        for (uint32_t i = 0; i < view->map.tile_count; i++) {
            assert_true(view->raster.tiles[i].x_px + view->map.tile_px <= view->map.width_px);
            assert_true(view->raster.tiles[i].y_px + view->map.tile_px <= view->map.height_px);
        }
    }
    gn_plan_end(&f);
}

/* Texels in the light of a tiny map are few pixels of a tiny picture. */
static void test_so_many_as_are_set(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    f.opts.output.width_px = 64; /* one would be enough */
    f.opts.output.height_px = 36;
    for (uint32_t count = 1; count <= 4; count++) {
        GN_LIGHT_SET(&f.opts.shadow.any, cascades, count);
        assert_int_equal(view_of(&f)->map.cascade_count, count == 1 ? 0 : count);
        f.opts.shadow.lights[0] = (struct gn_light_opts){
            .light = 0, .given = GN_LIGHT_GIVEN(cascades), .cascades = 5 - count};
        f.opts.shadow.light_count = 1;
        assert_int_equal(view_of(&f)->map.cascade_count, count == 4 ? 0 : 5 - count);
        f.opts.shadow.light_count = 0;
    }
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 32); /* no room for their gutters */
    assert_int_equal(view_of(&f)->map.cascade_count, 0);
    gn_plan_end(&f);
}

static void test_small_pictures_need_fewer(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    uint32_t last = 4;
    for (uint32_t width_px = 1280; width_px >= 4; width_px /= 2) {
        f.opts.output.width_px = width_px;
        f.opts.output.height_px = width_px * 9 / 16;
        const uint32_t count = view_of(&f)->map.tile_count;
        assert_true(count <= last);
        last = count;
    }
    assert_int_equal(last, 1);
    gn_plan_end(&f);
}

/* A camera that comes down from on high: its first eye alone would need fewer. */
static void test_a_camera_that_flies_has_as_many_all_along(void **state) {
    (void)state;
    for (uint32_t width_px = 80; width_px <= 1280; width_px *= 2) {
        uint32_t counts[3];
        for (int i = 0; i < 3; i++) {
            struct gn_plan_fixture f;
            begin(&f, gn_field_scene_make_flown(30.0f), 4096);
            f.opts.output.width_px = width_px;
            f.opts.output.height_px = width_px * 9 / 16;
            gn_pose_step(&f.pose, (int64_t)i * 1999000000);
            counts[i] = view_of(&f)->map.tile_count;
            gn_plan_end(&f);
        }
        assert_int_equal(counts[1], counts[0]);
        assert_int_equal(counts[2], counts[0]);
    }
}

/* The same flight as a clip that plays over others, in which the camera stands on high. */
static void test_a_clip_over_others_flies_as_well(void **state) {
    (void)state;
    int differ = 0;
    for (uint32_t width_px = 80; width_px <= 1280; width_px *= 2) {
        uint32_t counts[2];
        for (int i = 0; i < 2; i++) {
            struct gn_plan_fixture f;
            begin(&f, gn_field_scene_make_flown(30.0f), 4096);
            f.opts.output.width_px = width_px;
            f.opts.output.height_px = width_px * 9 / 16;
            if (i == 1) {
                f.scene->nodes[f.scene->cameras[0].node].translation[1] = 30.0f;
                gn_pose_choose(&f.pose, GN_POSE_NONE);
                differ += view_of(&f)->map.tile_count != counts[0];
                gn_pose_choose_over(&f.pose, GN_POSE_NONE, 0);
            }
            counts[i] = view_of(&f)->map.tile_count;
            gn_plan_end(&f);
        }
        assert_int_equal(counts[1], counts[0]);
    }
    assert_true(differ > 0);
}

/* Four maps of 1024 leave the sundial's texels over two pixels, and hardly smaller than two do. One
 * of 2048 has as small ones, where the size is left open. */
static void test_more_that_help_little_are_not_taken(void **state) {
    (void)state;
    const uint32_t widths_px[] = {640, 1280, 1920};
    for (int i = 0; i < 3; i++) {
        struct gn_err err = {0};
        struct gn_plan_fixture f;
        struct gn_scene *scene = gn_scene_load("assets/bench/yard.glb", NULL, NULL, &err);
        if (!scene) fail_msg("%s", err.text);
        begin(&f, scene, 4096);
        assert_int_equal(view_of(&f)->map.cascade_count, 0);
        assert_int_equal(view_of(&f)->map.tile_px, 2048);
        GN_LIGHT_SET(&f.opts.shadow.any, map_px, 1024);
        f.opts.output.width_px = widths_px[i];
        f.opts.output.height_px = widths_px[i] * 9 / 16;
        assert_int_equal(view_of(&f)->map.cascade_count, 2);
        gn_plan_end(&f);
    }
}

/* Whichever mode comes first: techniques read more or less far round a place. */
static void test_all_techniques_agree_on_it(void **state) {
    (void)state;
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_PCF, GN_TECHNIQUE_HARD,
                                                   GN_TECHNIQUE_PCF5, GN_TECHNIQUE_PCSS,
                                                   GN_TECHNIQUE_MSM};
    uint32_t counts[5];
    for (uint32_t height_px = 64; height_px <= 1024; height_px += 64) {
        for (int i = 0; i < 5; i++) {
            struct gn_plan_fixture f;
            begin(&f, gn_field_scene_make(), 4096);
            GN_LIGHT_SET(&f.opts.shadow.any, technique, techniques[i]);
            f.opts.output.width_px = 2 * height_px;
            f.opts.output.height_px = height_px;
            counts[i] = view_of(&f)->map.cascade_count;
            gn_plan_end(&f);
        }
        for (int i = 1; i < 5; i++) assert_int_equal(counts[i], counts[0]);
    }
}

/* What they measure is what they get: four of 2048 are finer than two. */
static void test_a_larger_map_is_never_coarser(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    float last = INFINITY;
    for (uint32_t px = 256; px <= 4096; px *= 2) {
        GN_LIGHT_SET(&f.opts.shadow.any, map_px, px);
        const struct gn_shadow_view *view = view_of(&f);
        assert_true(view->map.cascade_count > 0 && view->cascades[0].texel <= last);
        last = view->cascades[0].texel;
    }
    gn_plan_end(&f);
}

/* Under any sun no tile is blurred wider than the finest can be, but for what all are. */
static void test_blurs_are_as_wide_on_both_sides_of_a_split(void **state) {
    (void)state;
    for (float radius = 1e-3f; radius < 0.2f; radius *= 3) {
        struct gn_plan_fixture f;
        begin(&f, gn_field_scene_make(), 4096);
        f.scene->lights[0].radius = radius;
        GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_EVSM);
        const struct gn_shadow_view *view = view_of(&f);
        assert_int_equal(view->map.cascade_count, 4);
        const float most_m = GN_BLUR_MOST_PX * view->cascades[0].texel;
        for (int i = 0; i < 4; i++) {
            const struct gn_shadow_cascade *c = &view->cascades[i];
            assert_true(c->blur_px * c->texel <=
                        fmaxf(most_m, GN_BLUR_LEAST_PX * c->texel) * 1.001f);
        }
        gn_plan_end(&f);
    }
}

/* A caster far off does not change what is near. */
static void test_tiles_are_drawn_again_one_by_one(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    uint64_t before[4];
    const struct gn_shadow_view *view = view_of(&f);
    for (int i = 0; i < 4; i++) before[i] = view->raster.tiles[i].content_hash;
    view = view_of(&f);
    for (int i = 0; i < 4; i++) assert_true(view->raster.tiles[i].content_hash == before[i]);
    f.pose.items[1 + 4 * 12].hash++; /* a block of the 13th ring, 167 m away */
    view = view_of(&f);
    assert_true(view->raster.tiles[0].content_hash == before[0]);
    assert_true(view->raster.tiles[1].content_hash == before[1]);
    assert_true(view->raster.tiles[3].content_hash != before[3]);
    gn_plan_end(&f);
}

/* So it is where a tile between the eye and all shadows is empty. */
static void test_tiles_behind_an_empty_one_are_drawn_again(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    const uint32_t count = view_of(&f)->map.tile_count, far_block = 1 + 4 * 13;
    for (uint32_t i = 1; i < f.scene->item_count; i++) f.pose.items[i].visible = i == far_block;
    const struct gn_shadow_view *view = view_of(&f);
    uint64_t before[4];
    for (uint32_t i = 0; i < count; i++) before[i] = view->raster.tiles[i].content_hash;
    assert_true(view->map.tile_count == count && view->raster.tiles[0].empty && !view->empty);
    f.pose.items[far_block].hash++;
    view = view_of(&f);
    for (uint32_t i = 0; i < count; i++)
        assert_true(view->raster.tiles[i].empty ==
                    (view->raster.tiles[i].content_hash == before[i]));
    gn_plan_end(&f);
}

/* Where no gutter has room: the widest at a split is what either of its tiles has room for, so that
 * neither is narrower there than the other. */
static void test_penumbrae_are_bound_alike_on_both_sides_of_a_split(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin(&f, gn_field_scene_make(), 4096);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_PCSS);
    assert_true(view_of(&f)->penumbra.growth >= 1e9f); /* the sun's have room */
    f.scene->lights[0].radius = 0.5f;
    const struct gn_shadow_view *view = view_of(&f);
    assert_true(view->penumbra.growth > 0.0f && view->penumbra.growth < 1e9f);
    for (uint32_t i = 0; i + 1 < view->map.cascade_count; i++) {
        const float widest_m = view->penumbra.growth * 0.5f * view->cascades[i].end_m;
        for (uint32_t side = i; side <= i + 1; side++)
            assert_true(widest_m <= 1.001f * view->lookup.reach_px * view->cascades[side].texel);
    }
    gn_plan_end(&f);
}

/* Sixteen suns in one or two megabytes: tiles of 16 or 32 px would be less than some gutters. */
static void test_they_end_before_tiles_are_too_small(void **state) {
    (void)state;
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
        for (uint64_t mb = 1; mb <= 16; mb *= 2) {
            struct gn_plan_fixture f;
            struct gn_light suns[GN_ALL_SHADOWS_MAX];
            begin(&f, gn_field_scene_make(), 4096);
            for (int i = 0; i < GN_ALL_SHADOWS_MAX; i++) suns[i] = f.scene->lights[0];
            f.scene->lights = suns;
            f.pose.lights = suns;
            f.scene->light_count = GN_ALL_SHADOWS_MAX;
            GN_LIGHT_SET(&f.opts.shadow.any, technique, (enum gn_technique)t);
            f.opts.shadow.maps_bytes = mb << 20;
            const struct gn_plan *plan = gn_plan_make(&f);
            const char *broken = gn_plan_check(plan);
            if (broken) fail_msg("%s", broken);
            assert_int_equal(plan->shadow_count, t == GN_TECHNIQUE_NONE ? 0 : GN_ALL_SHADOWS_MAX);
            assert_true(gn_plan_map_bytes(plan) <= mb << 20);
            for (uint32_t i = 0; i < plan->shadow_count; i++) {
                const struct gn_shadow_view *view = &plan->shadows[i];
                assert_true(2 * view->map.gutter_px < view->map.tile_px);
                assert_true(view->map.cascade_count == 0 || view->map.tile_px >= 64);
                for (uint32_t k = 0; k < 16 * view->map.tile_count; k++)
                    assert_true(
                        isfinite(view->raster.tiles[k / 16].clip_from_world[k / 4 % 4][k % 4]));
            }
            gn_plan_end(&f);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_field_plan),
        cmocka_unit_test(test_small_and_huge_scenes_have_them_too),
        cmocka_unit_test(test_each_serves_what_the_last_does_not),
        cmocka_unit_test(test_a_moving_eye_changes_neither_number_nor_program),
        cmocka_unit_test(test_an_eye_that_a_hand_brings_near_gets_more),
        cmocka_unit_test(test_every_camera_has_a_plan),
        cmocka_unit_test(test_an_atlas_is_no_larger_than_a_texture),
        cmocka_unit_test(test_as_many_as_asked_for_at_most),
        cmocka_unit_test(test_so_many_as_are_set),
        cmocka_unit_test(test_small_pictures_need_fewer),
        cmocka_unit_test(test_a_camera_that_flies_has_as_many_all_along),
        cmocka_unit_test(test_a_clip_over_others_flies_as_well),
        cmocka_unit_test(test_more_that_help_little_are_not_taken),
        cmocka_unit_test(test_all_techniques_agree_on_it),
        cmocka_unit_test(test_a_larger_map_is_never_coarser),
        cmocka_unit_test(test_blurs_are_as_wide_on_both_sides_of_a_split),
        cmocka_unit_test(test_tiles_are_drawn_again_one_by_one),
        cmocka_unit_test(test_tiles_behind_an_empty_one_are_drawn_again),
        cmocka_unit_test(test_penumbrae_are_bound_alike_on_both_sides_of_a_split),
        cmocka_unit_test(test_they_end_before_tiles_are_too_small),
    };
    return RUN(tests);
}
