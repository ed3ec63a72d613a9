#include <math.h>

#include "shadow/grey.h"
#include "unit/check.h"

static bool near_to(float a, float b) { return fabsf(a - b) < 1e-5f; }

static void test_distances_are_linear(void **state) {
    (void)state;
    struct gn_shadow_view view = {.encoding = GN_ENCODING_R32UI,
                                  .code = {.near_m = 2, .far_m = 10, .scale = 1}};
    struct gn_shadow_grey grey = gn_shadow_grey_of(&view); /* metres */
    assert_true(near_to(gn_shadow_grey_at(&grey, 2), 0));
    assert_true(near_to(gn_shadow_grey_at(&grey, 6), 0.5f));
    assert_true(near_to(gn_shadow_grey_at(&grey, 10), 1));
    assert_true(near_to(gn_shadow_grey_at(&grey, 99), 1));
    view.code.scale = 0.25f, view.code.offset = -1.5f; /* -1 .. 1 */
    view.encoding = GN_ENCODING_R16F;
    grey = gn_shadow_grey_of(&view);
    assert_true(near_to(gn_shadow_grey_at(&grey, -1), 0));
    assert_true(near_to(gn_shadow_grey_at(&grey, 0), 0.5f));
    assert_true(near_to(gn_shadow_grey_at(&grey, 1), 1));
}

static void test_depth_has_more_contrast(void **state) {
    (void)state;
    struct gn_shadow_view view = {.encoding = GN_ENCODING_DEPTH,
                                  .code = {.near_m = 2, .far_m = 10}};
    struct gn_shadow_grey grey = gn_shadow_grey_of(&view);
    assert_true(near_to(gn_shadow_grey_at(&grey, 0.5f), 0.0625f));
    assert_true(near_to(gn_shadow_grey_at(&grey, 1), 1));
}

static void test_an_empty_map_is_white(void **state) {
    (void)state;
    struct gn_shadow_view view = {.encoding = GN_ENCODING_R16F, .empty = true};
    struct gn_shadow_grey grey = gn_shadow_grey_of(&view);
    assert_true(gn_shadow_grey_at(&grey, 0.3f) == 1.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distances_are_linear),
        cmocka_unit_test(test_depth_has_more_contrast),
        cmocka_unit_test(test_an_empty_map_is_white),
    };
    return RUN(tests);
}
