#include <string.h>

#include "display/display.h"
#include "display/kms/scanout.h"
#include "unit/check.h"

static void test_names(void **state) {
    (void)state;
    static const char *const names[] = {
#define X(file, name) name,
        GN_DISPLAY_TABLE(X)
#undef X
    };
    const size_t count = sizeof names / sizeof *names;
    for (size_t i = 0; i < count; i++) assert_string_equal(gn_displays[i]->name, names[i]);
    assert_null(gn_displays[count]);
}

static void test_unknown_name(void **state) {
    (void)state;
    struct gn_display display;
    struct gn_err err = {0};
    assert_false(gn_display_open(&display, "teletype", NULL, &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    assert_non_null(strstr(err.text, "auto, egl, osmesa, kms, window"));
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

/* A frame at a time, at the pace of a timer. */
static void test_headless_screen(void **state) {
    (void)state;
    struct gn_display d;
    struct gn_err err = {0};
    int64_t clock_ns = 1000;
    static struct gn_loop *loop; /* static: where there is no EGL it stays */
    loop = gn_loop_open(NULL);
    gn_loop_fake_clock(loop, &clock_ns);
    const struct gn_screen_opts opts = {
        .loop = loop, .width_px = 64, .height_px = 32, .max_fps = 50};
    if (!gn_display_open_screen(&d, "egl", &opts, 1000, NULL, &err)) skip();
    assert_true(d.screen.lit && d.screen.may_draw && d.screen.has_context);
    assert_int_equal(d.screen.width_px, 64);
    assert_true(gn_display_begin(&d, 2000, &err));
    assert_true(gn_display_present(&d, 3000, &err));
    assert_false(d.screen.may_draw);
    assert_false(gn_display_begin(&d, 4000, &err));
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
    assert_true(clock_ns == 2000 + 20000000);
    assert_true(gn_display_dispatch(&d, clock_ns, &err));
    assert_true(d.screen.may_draw);
    assert_int_equal(d.screen.counts.shown, 1);
    gn_display_blank(&d, true, 40000000);
    assert_true(d.screen.blank);
    assert_false(d.screen.lit || d.screen.may_draw || d.screen.black);
    assert_true(gn_display_dispatch(&d, 90000000, &err));
    assert_false(d.screen.may_draw);
    gn_display_blank(&d, false, 95000000);
    assert_true(d.screen.lit && d.screen.may_draw);
    gn_display_close(&d);
    gn_display_close(&d);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 0);
    gn_loop_close(loop);
}

/* Without a card it waits, and says so; with one, it does whatever the machine lets it. */
static void test_kms_screen_opens_without_a_card(void **state) {
    (void)state;
    struct gn_display d;
    struct gn_err err = {0};
    struct gn_loop *loop = gn_loop_open(&err);
    const struct gn_screen_opts opts = {.loop = loop, .card = "no such card"};
    if (!gn_display_open_screen(&d, "kms", &opts, 1000, NULL, &err)) fail_msg("%s", err.text);
    assert_false(d.screen.has_context || d.screen.lost || d.screen.may_draw || d.screen.lit);
    assert_non_null(strstr(d.screen.status, "waiting for a card"));
    for (int64_t s = 0; s < 10; s++) assert_true(gn_display_dispatch(&d, s * 1000000000, &err));
    gn_display_close(&d);
    gn_loop_close(loop);
}

/* Asked for before anything of the GPU's is. */
static void test_a_render_node_that_does_not_open(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_null(gn_scanout_gbm.open(-1, "/nowhere/renderD128", &err));
    assert_string_equal(err.text, "render node /nowhere/renderD128: No such file or directory");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_unknown_name),
        cmocka_unit_test(test_close_zeroed),
        cmocka_unit_test(test_open),
        cmocka_unit_test(test_auto),
        cmocka_unit_test(test_headless_screen),
        cmocka_unit_test(test_kms_screen_opens_without_a_card),
        cmocka_unit_test(test_a_render_node_that_does_not_open),
    };
    return RUN(tests);
}
