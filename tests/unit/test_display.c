#include <string.h>

#include "display/display.h"
#include "unit/check.h"

static void test_names(void **state) {
    (void)state;
    assert_string_equal(gn_displays[0]->name, "egl");
    assert_string_equal(gn_displays[1]->name, "osmesa");
    assert_null(gn_displays[2]);
}

static void test_unknown_name(void **state) {
    (void)state;
    struct gn_display display;
    struct gn_err err = {0};
    assert_false(gn_display_open(&display, "teletype", NULL, &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    assert_non_null(strstr(err.text, "auto, egl, osmesa"));
    assert_false(gn_display_open(&display, "kms", NULL, &err));
    assert_int_equal(err.status, GN_EXIT_WORLD);
    assert_non_null(strstr(err.text, "not in this build"));
    gn_display_close(&display);
}

static void test_close_zeroed(void **state) {
    (void)state;
    struct gn_display display = {0};
    gn_display_close(&display);
}

/* Each one opens, twice in a row, or says why not in one line that begins with its name. */
static void test_open(void **state) {
    (void)state;
    for (int i = 0; gn_displays[i]; i++)
        for (int round = 0; round < 2; round++) {
            struct gn_display display;
            struct gn_err err = {0};
            if (!gn_display_open(&display, gn_displays[i]->name, NULL, &err)) {
                assert_non_null(strstr(err.text, gn_displays[i]->name));
                assert_null(display.ops);
                continue;
            }
            assert_ptr_equal(display.ops, gn_displays[i]);
            assert_non_null(gn_display_get_proc(&display, "glClear"));
            gn_display_close(&display);
            assert_null(display.ops);
        }
}

static void test_auto(void **state) {
    (void)state;
    struct gn_display display;
    struct gn_err err = {0};
    if (!gn_display_open(&display, "auto", NULL, &err)) {
        assert_non_null(strstr(err.text, "egl: "));
        assert_non_null(strstr(err.text, "osmesa: "));
    }
    gn_display_close(&display);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),        cmocka_unit_test(test_unknown_name),
        cmocka_unit_test(test_close_zeroed), cmocka_unit_test(test_open),
        cmocka_unit_test(test_auto),
    };
    return RUN(tests);
}
