/* Levels of detail in plans: which pictures have them, which passes, and what shadows are told. */
#include <math.h>
#include <string.h>

#include "plan/fixture.h"
#include "unit/check.h"

enum { COARSE = 2 }; /* levels that are given, of a box's geometry */

static struct gn_plan_fixture f;
static struct gn_levels levels[64];
static struct gn_detail detail;
static uint32_t boxes; /* the geometry of most items */

/* The stage, with two levels of its boxes that are 1 and 20 mm off, of a triangle each. */
static int begin(void **state) {
    (void)state;
    static uint32_t counts[64];
    gn_plan_begin(&f, GN_EVERY_CAP);
    memset(levels, 0, sizeof levels);
    memset(counts, 0, sizeof counts);
    for (uint32_t i = 0; i < f.scene->item_count; i++)
        if (++counts[f.scene->items[i].geometry] > counts[boxes])
            boxes = f.scene->items[i].geometry;
    levels[boxes] = (struct gn_levels){.at = {{0, 6, 4, .001f}, {0, 3, 3, .02f}}, .count = COARSE};
    detail = (struct gn_detail){
        .geometries = levels, .indices = f.scene->buffers.indices, .index_count = 6, .id = 1};
    f.opts.detail.of = &detail;
    f.opts.output.width_px = 64;
    f.opts.output.height_px = 36;
    return 0;
}

static int end(void **state) {
    (void)state;
    gn_plan_end(&f);
    return 0;
}

/* The least and the greatest level of what passes of a kind draw of the boxes. */
static void find_levels(const struct gn_plan *plan, bool maps, uint8_t out[2]) {
    out[0] = UINT8_MAX;
    out[1] = 0;
    for (uint32_t p = 0; p < plan->pass_count; p++)
        for (uint32_t i = 0; i < plan->passes[p].draw_count; i++) {
            const struct gn_draw *draw = &plan->draws[plan->passes[p].first_draw + i];
            if ((plan->passes[p].kind == GN_PASS_MAP) != maps || draw->geometry != boxes) continue;
            out[0] = draw->level < out[0] ? draw->level : out[0];
            out[1] = draw->level > out[1] ? draw->level : out[1];
        }
}

static void expect_levels(bool maps, uint8_t least, uint8_t most) {
    uint8_t found[2];
    find_levels(gn_plan_make(&f), maps, found);
    if (found[0] != least || found[1] != most)
        fail_msg("levels %u to %u, not %u to %u", found[0], found[1], least, most);
}

static void without_levels_meshes_are_whole(void **state) {
    (void)state;
    f.opts.detail.of = NULL;
    expect_levels(false, 0, 0);
}

static void more_pixels_take_a_finer_level(void **state) {
    (void)state;
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_NONE);
    expect_levels(false, 2, 2);
    f.opts.detail.px = .02f;
    expect_levels(false, 1, 1);
    f.opts.detail.px = .0001f;
    expect_levels(false, 0, 0);
}

static void large_triangles_are_whole(void **state) {
    (void)state;
    f.opts.output.width_px = 1280;
    f.opts.output.height_px = 720;
    f.opts.detail.px = 16;
    expect_levels(false, 0, 0);
}

static void maps_have_whole_meshes(void **state) {
    (void)state;
    expect_levels(true, 0, 0);
}

/* A surface that lies below what the map has of it would be in its own shadow. */
static void the_bias_of_maps_grows_by_what_surfaces_are_off(void **state) {
    (void)state;
    float whole[GN_ALL_SHADOWS_MAX];
    f.opts.detail.of = NULL;
    const struct gn_plan *plan = gn_plan_make(&f);
    for (uint32_t i = 0; i < plan->shadow_count; i++) whole[i] = plan->shadows[i].code.ulp_m;
    assert_true(plan->shadow_count > 0);
    f.opts.detail.of = &detail;
    uint8_t found[2];
    plan = gn_plan_make(&f);
    find_levels(plan, false, found);
    assert_true(found[1] > 0);
    const float off_m = levels[boxes].at[found[1] - 1].error_m;
    for (uint32_t i = 0; i < plan->shadow_count; i++)
        assert_true(plan->shadows[i].code.ulp_m - whole[i] > .99f * off_m);
}

/* Of half a texel at most: else contacts would lose their shadows. */
static void fine_maps_take_a_finer_level(void **state) {
    (void)state;
    levels[boxes].at[0].error_m = .3f; /* .1 pixel */
    levels[boxes].at[1].error_m = .4f;
    f.opts.detail.px = 16;
    expect_levels(false, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(without_levels_meshes_are_whole, begin, end),
        cmocka_unit_test_setup_teardown(more_pixels_take_a_finer_level, begin, end),
        cmocka_unit_test_setup_teardown(large_triangles_are_whole, begin, end),
        cmocka_unit_test_setup_teardown(maps_have_whole_meshes, begin, end),
        cmocka_unit_test_setup_teardown(the_bias_of_maps_grows_by_what_surfaces_are_off, begin,
                                        end),
        cmocka_unit_test_setup_teardown(fine_maps_take_a_finer_level, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
