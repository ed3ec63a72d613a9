/* Filtered maps when more of them change than one frame may make again: they take turns, nobody is
 * forgotten, and what stands still is soon as if there were no budget. */
#include <string.h>

#include "plan/fixture.h"
#include "unit/check.h"

enum { SLOTS = 3, FRAME_NS = 16666667 };
struct hashes {
    uint64_t of[SLOTS];
};

/* Of the slots' first tiles and filters, all mixed. */
static struct hashes hashes_of(const struct gn_plan *plan) {
    struct hashes h = {{0}};
    assert_int_equal(plan->shadow_count, SLOTS);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        if (pass->target.kind == GN_TARGET_MOMENTS)
            h.of[pass->target.slot] = 31 * h.of[pass->target.slot] + pass->content.hash;
    }
    return h;
}

static void begin(struct gn_plan_fixture *f, enum gn_technique technique, uint64_t texels) {
    gn_plan_begin(f, GN_EVERY_CAP);
    GN_LIGHT_SET(&f->opts.shadow.any, technique, technique);
    GN_LIGHT_SET(&f->opts.shadow.any, map_px, 128);
    f->opts.shadow.cascades = 1; /* else as many as suit the pose that a builder sees first */
    f->opts.shadow.filter_texels = texels;
}

static struct hashes at(struct gn_plan_fixture *f, int frame, bool *is_behind) {
    gn_pose_step(&f->pose, (int64_t)frame * 10 * FRAME_NS);
    const struct gn_plan *plan = gn_plan_make(f);
    assert_null(gn_plan_check(plan));
    *is_behind = plan->is_behind;
    return hashes_of(plan);
}

/* What a builder without a past and a budget makes of it. */
static struct hashes fresh_at(enum gn_technique technique, int frame) {
    struct gn_plan_fixture f;
    bool is_behind;
    begin(&f, technique, 0);
    const struct hashes h = at(&f, frame, &is_behind);
    assert_false(is_behind);
    gn_plan_end(&f);
    return h;
}

static void test_maps_take_turns(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    bool is_behind;
    int made[SLOTS] = {0};
    begin(&f, GN_TECHNIQUE_VSM, 1); /* less than a map: one a frame */
    struct hashes before = at(&f, 0, &is_behind);
    assert_false(is_behind); /* at first there is nothing to go on with */
    for (int frame = 1; frame <= 4 * SLOTS; frame++) {
        const struct hashes now = at(&f, frame, &is_behind),
                            fresh = fresh_at(GN_TECHNIQUE_VSM, frame);
        int changed = 0;
        assert_true(is_behind);
        for (int slot = 0; slot < SLOTS; slot++) {
            if (now.of[slot] == before.of[slot]) continue;
            assert_true(now.of[slot] == fresh.of[slot]); /* and what is made is of today */
            made[slot]++;
            changed++;
        }
        assert_int_equal(changed, 1);
        before = now;
    }
    for (int slot = 0; slot < SLOTS; slot++) assert_int_equal(made[slot], 4);
    gn_plan_end(&f);
}

static void test_what_stands_still_is_soon_up_to_date(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    bool is_behind;
    int more = 0;
    begin(&f, GN_TECHNIQUE_SMSM, 1);
    at(&f, 0, &is_behind);
    struct hashes now = at(&f, 1, &is_behind);
    for (; is_behind; more++) now = at(&f, 1, &is_behind);
    assert_int_equal(more, SLOTS - 1);
    const struct hashes fresh = fresh_at(GN_TECHNIQUE_SMSM, 1);
    assert_memory_equal(&now, &fresh, sizeof now);
    gn_plan_end(&f);
}

static void test_a_budget_for_all_holds_nothing(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    bool is_behind;
    begin(&f, GN_TECHNIQUE_EVSM, 8 * 128 * 128); /* a sun, a spot, a point light's six tiles */
    for (int frame = 0; frame < 5; frame++) {
        const struct hashes now = at(&f, frame, &is_behind),
                            fresh = fresh_at(GN_TECHNIQUE_EVSM, frame);
        assert_false(is_behind);
        assert_memory_equal(&now, &fresh, sizeof now);
    }
    gn_plan_end(&f);
}

/* Another technique reads another map: there is no old one. */
static void test_a_switch_waits_for_nothing(void **state) {
    (void)state;
    struct gn_plan_fixture f;
    bool is_behind;
    begin(&f, GN_TECHNIQUE_VSM, 1);
    at(&f, 0, &is_behind);
    GN_LIGHT_SET(&f.opts.shadow.any, technique, GN_TECHNIQUE_MSM);
    const struct hashes now = at(&f, 1, &is_behind), fresh = fresh_at(GN_TECHNIQUE_MSM, 1);
    assert_false(is_behind);
    assert_memory_equal(&now, &fresh, sizeof now);
    GN_LIGHT_SET(&f.opts.shadow.any, technique,
                 GN_TECHNIQUE_PCF); /* reads the map itself: always of today */
    gn_pose_step(&f.pose, 20 * FRAME_NS);
    assert_false(gn_plan_make(&f)->is_behind);
    gn_plan_end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_maps_take_turns),
        cmocka_unit_test(test_what_stands_still_is_soon_up_to_date),
        cmocka_unit_test(test_a_budget_for_all_holds_nothing),
        cmocka_unit_test(test_a_switch_waits_for_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
