/* The table of techniques: the kiosk's order of modes has all of them. */
#include "shadow/technique.h"

#include "unit/check.h"

static void test_every_technique_has_a_rank_of_its_own(void **state) {
    (void)state;
    for (int a = 0; a < GN_TECHNIQUE_COUNT; a++) {
        if (gn_techniques[a].rank < 1 || gn_techniques[a].rank > GN_TECHNIQUE_COUNT)
            fail_msg("%s has no rank from 1 to %d", gn_techniques[a].name, GN_TECHNIQUE_COUNT);
        for (int b = 0; b < a; b++)
            if (gn_techniques[a].rank == gn_techniques[b].rank)
                fail_msg("%s and %s have the same rank", gn_techniques[a].name,
                         gn_techniques[b].name);
    }
}

static void test_the_order_has_all_once(void **state) {
    (void)state;
    enum gn_technique order[GN_TECHNIQUE_COUNT];
    gn_techniques_by_rank(order);
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++)
        assert_int_equal(gn_techniques[order[i]].rank, i + 1);
    assert_string_equal(gn_techniques[order[0]].name, "pcf");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_technique_has_a_rank_of_its_own),
        cmocka_unit_test(test_the_order_has_all_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
