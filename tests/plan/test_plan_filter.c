/* Plans of filtered maps: the passes as a golden, what decides whether they run again, and what
 * comes in the place of what a GPU lacks. */
#include <string.h>

#include "core/hash.h"
#include "plan/fixture.h"
#include "unit/check.h"

static void choose(struct gn_plan_fixture *f, enum gn_technique technique) {
    GN_LIGHT_SET(&f->opts.shadow.any, technique, technique);
}

static void test_msm_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    choose(&f, GN_TECHNIQUE_MSM);
    gn_plan_expect(gn_plan_make(&f), "msm");
    gn_plan_end(&f);
}

static void test_cone_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    choose(&f, GN_TECHNIQUE_CONE);
    gn_plan_expect(gn_plan_make(&f), "cone");
    gn_plan_end(&f);
}

/* A cone map has a texel for two by two: its tiles begin at even texels. */
static void test_cone_maps_have_even_sizes(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    choose(&f, GN_TECHNIQUE_CONE);
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 333);
    assert_int_equal(gn_plan_make(&f)->shadows[0].map.tile_px, 332);
    f.opts.shadow.maps_bytes = 1 << 18;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_true(plan->shadows[0].map.tile_px < 332 && plan->shadows[0].map.tile_px % 2 == 0);
    assert_null(gn_plan_check(plan));
    gn_plan_end(&f);
}

/* Of the first filter pass in the plan. */
static uint64_t hash_of(const struct gn_plan *plan) {
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (plan->passes[i].target.kind == GN_TARGET_MOMENTS) return plan->passes[i].content.hash;
    fail_msg("there is no filter");
    return 0;
}

static uint32_t count_floods(const struct gn_plan *plan, uint32_t slot) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        count += plan->passes[i].target.kind == GN_TARGET_MOMENTS &&
                 plan->passes[i].target.slot == slot && plan->passes[i].content.tile == 0;
    return count - 2;
}

/* Of a directional light, the only one. */
static void begin_one_cone_map(struct gn_plan_fixture *f) {
    gn_plan_begin(f, GN_EVERY_CAP);
    choose(f, GN_TECHNIQUE_CONE);
    f->opts.shadow.cascades = 1;
    f->scene->light_count = 1;
}

static void test_cones_reach_as_far_as_the_light_is_large(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin_one_cone_map(&f);
    f.scene->lights[0].radius = 0.001f;
    assert_int_equal(count_floods(gn_plan_make(&f), 0), 2);
    const uint64_t before = hash_of(gn_plan_make(&f));
    f.scene->lights[0].radius = 0.5f;
    assert_true(count_floods(gn_plan_make(&f), 0) >= 6);
    assert_true(hash_of(gn_plan_make(&f)) != before);
    gn_plan_end(&f);
}

static uint32_t width_of_cones(const struct gn_plan *plan) {
    const struct gn_pass *last = NULL;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (plan->passes[i].target.kind == GN_TARGET_MOMENTS) last = &plan->passes[i];
    assert_non_null(last);
    assert_int_equal(last->target.index, 0); /* the light's own, after any number of steps */
    assert_null(gn_plan_check(plan));
    return last->target.width_px;
}

/* Where things move cones are made in each frame. A point light's have six tiles. */
static void test_cone_maps_are_smaller_where_things_move(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    begin_one_cone_map(&f);
    for (uint32_t px = 256; px <= 2048; px *= 2) {
        GN_LIGHT_SET(&f.opts.shadow.any, map_px, px);
        assert_int_equal(width_of_cones(gn_plan_make(&f)), px < 512 ? px / 2 : 256);
    }
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 1028); /* no block of eight fits */
    assert_int_equal(width_of_cones(gn_plan_make(&f)), 257);
    for (float radius = 0.001f; radius < 1.0f; radius *= 2) {
        f.scene->lights[0].radius = radius;
        width_of_cones(gn_plan_make(&f));
    }
    GN_LIGHT_SET(&f.opts.shadow.any, map_px, 1024);
    for (uint32_t i = 0; i < f.scene->item_count; i++) f.pose.items[i].moves = false;
    assert_int_equal(width_of_cones(gn_plan_make(&f)), 512);
    gn_plan_end(&f);
}

static uint64_t hash_of_all(const struct gn_plan *plan) {
    uint64_t hash = GN_HASH_INIT;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        if (pass->target.kind != GN_TARGET_MOMENTS) continue;
        assert_true(pass->content.hash != 0); /* 0: always drawn */
        hash = gn_hash(hash, &pass->content.hash, sizeof pass->content.hash);
    }
    return hash;
}

/* A pass whose target holds its hash does not run. */
static void test_cones_are_made_again_where_a_caster_moves(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    choose(&f, GN_TECHNIQUE_CONE);
    const uint64_t before = hash_of_all(gn_plan_make(&f));
    assert_int_equal(hash_of_all(gn_plan_make(&f)), before);
    f.scene->environment.sky[0] += 0.1f;
    assert_int_equal(hash_of_all(gn_plan_make(&f)), before);
    gn_pose_step(&f.pose, 1000000000); /* the mover goes 1 m/s */
    assert_true(hash_of_all(gn_plan_make(&f)) != before);
    gn_plan_end(&f);
}

/* Its filters still run, though no instance is drawn. */
static void test_a_camera_that_sees_nothing_gets_a_valid_plan(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    choose(&f, GN_TECHNIQUE_MSM);
    f.opts.view.camera = 1; /* looks away */
    f.scene->light_count = 1;
    const struct gn_plan *plan = gn_plan_make(&f);
    assert_int_equal(plan->instance_count, 0);
    assert_true(plan->draw_count > 0);
    const char *broken = gn_plan_check(plan);
    if (broken) fail_msg("%s", broken);
    gn_plan_end(&f);
}

static void test_filters_change_with_their_map_and_technique_alone(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    gn_plan_begin(&f, GN_EVERY_CAP);
    choose(&f, GN_TECHNIQUE_EVSM);
    const uint64_t before = hash_of(gn_plan_make(&f));
    assert_int_equal(hash_of(gn_plan_make(&f)), before);
    choose(&f, GN_TECHNIQUE_MSM); /* it may be kept in the same kind of texture */
    GN_LIGHT_SET(&f.opts.shadow.any, map_format,
                 GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_RGBA32F_BITS));
    assert_true(hash_of(gn_plan_make(&f)) != before);
    choose(&f, GN_TECHNIQUE_EVSM);
    assert_int_equal(hash_of(gn_plan_make(&f)), before);
    f.scene->lights[0].radius = 0.3f; /* a wider blur of the same map */
    assert_true(hash_of(gn_plan_make(&f)) != before);
    gn_plan_end(&f);
}

static enum gn_moments moments_with(uint32_t caps, enum gn_technique technique,
                                    enum gn_moments wanted, const char *says) {
    struct gn_plan_fixture f;
    gn_plan_begin(&f, caps);
    choose(&f, technique);
    GN_LIGHT_SET(&f.opts.shadow.any, map_format, GN_MAP_FORMAT(GN_ENCODING_AUTO, wanted));
    struct gn_warnings warnings = {0};
    const struct gn_plan *plan = gn_frame_build(f.frame, &f.pose, &f.opts, &warnings);
    const enum gn_moments moments = plan->shadows[0].moments;
    assert_null(gn_plan_check(plan));
    assert_int_equal(warnings.count > 0, says != NULL);
    if (says && !strstr(warnings.text[0], says)) fail_msg("%s", warnings.text[0]);
    gn_plan_end(&f);
    return moments;
}

static void test_what_a_gpu_lacks_is_replaced(void **state) {
    (void)state;
    const uint32_t no_bits = GN_EVERY_CAP & ~(1u << GN_CAP_RG32UI | 1u << GN_CAP_RGBA32UI);
    assert_int_equal(moments_with(GN_EVERY_CAP, GN_TECHNIQUE_VSM, GN_MOMENTS_NONE, NULL),
                     GN_MOMENTS_RG32UI);
    assert_int_equal(moments_with(no_bits, GN_TECHNIQUE_VSM, GN_MOMENTS_NONE, NULL),
                     GN_MOMENTS_RGBA16UI);
    assert_int_equal(moments_with(no_bits, GN_TECHNIQUE_EVSM, GN_MOMENTS_NONE, "falls back to pcf"),
                     GN_MOMENTS_NONE);
    assert_int_equal(moments_with(GN_EVERY_CAP, GN_TECHNIQUE_MSM, GN_MOMENTS_RGBA16F, NULL),
                     GN_MOMENTS_RGBA16F);
    assert_int_equal(moments_with(GN_EVERY_CAP, GN_TECHNIQUE_MSM, GN_MOMENTS_RG32UI,
                                  "msm does not support map format rg32ui"),
                     GN_MOMENTS_RGBA16UI);
    assert_int_equal(moments_with(GN_EVERY_CAP, GN_TECHNIQUE_PCF, GN_MOMENTS_RG32UI,
                                  "pcf does not support map format rg32ui; using depth"),
                     GN_MOMENTS_NONE);
    const uint32_t no_cones = GN_EVERY_CAP & ~(1u << GN_CAP_RG16F),
                   no_compare = GN_EVERY_CAP & ~(1u << GN_CAP_DEPTH_COMPARE);
    assert_int_equal(moments_with(GN_EVERY_CAP, GN_TECHNIQUE_CONE, GN_MOMENTS_NONE, NULL),
                     GN_MOMENTS_CONE_RG16F);
    assert_int_equal(moments_with(no_cones, GN_TECHNIQUE_CONE, GN_MOMENTS_NONE, NULL),
                     GN_MOMENTS_CONE_BITS);
    assert_int_equal(
        moments_with(no_cones & ~(1u << GN_CAP_R32UI), GN_TECHNIQUE_CONE, GN_MOMENTS_NONE, NULL),
        GN_MOMENTS_CONE_BYTES);
    assert_int_equal(
        moments_with(no_compare, GN_TECHNIQUE_CONE, GN_MOMENTS_NONE, "falls back to pcss"),
        GN_MOMENTS_NONE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_msm_plan),
        cmocka_unit_test(test_cone_plan),
        cmocka_unit_test(test_cone_maps_have_even_sizes),
        cmocka_unit_test(test_cones_reach_as_far_as_the_light_is_large),
        cmocka_unit_test(test_cone_maps_are_smaller_where_things_move),
        cmocka_unit_test(test_cones_are_made_again_where_a_caster_moves),
        cmocka_unit_test(test_a_camera_that_sees_nothing_gets_a_valid_plan),
        cmocka_unit_test(test_filters_change_with_their_map_and_technique_alone),
        cmocka_unit_test(test_what_a_gpu_lacks_is_replaced),
    };
    return RUN(tests);
}
