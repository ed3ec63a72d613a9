/* The truth right of the line of a window's split screen, beside what render draws of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after what it needs */
#include <X11/keysym.h>
#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/compare.h"
#include "image/in_window.h"
#include "image/shot.h"

enum { LINE = 80, PATIENCE_S = 60 };

static char config_file[400];

static void show(struct window_shown *s, const char *size) {
    snprintf(config_file, sizeof config_file, "%s/truth-%d.ini", gn_shot_build(), (int)getpid());
    FILE *file = fopen(config_file, "w");
    assert_non_null(file);
    fprintf(file, "[kiosk]\ncaptions = no\n[mode \"A\"]\nshadow = pcf\n[mode \"B\"]\n"
                  "shadow = none\n");
    assert_int_equal(fclose(file), 0);
    const char *args[] = {"show",   window_scene, "-c", config_file,      "--backend",
                          "window", "--size",     size, "--no-animation", NULL};
    window_start(s, args);
    window_find(s);
}

static void render(struct gn_picture *out, const char *shadow) {
    const char *args[] = {"--size", "160x120",  "--no-animation", "--msaa",
                          "0",      "--shadow", shadow,           NULL};
    struct gn_err err = {0};
    if (!gn_shot(out, NULL, &err, "png", window_scene, args)) fail_msg("%s", err.text);
}

/* Within 1/255 each side of the line; of outlines .2 % may differ. */
static bool is_split(const struct gn_picture *p, const struct gn_picture *left,
                     const struct gn_picture *right) {
    int wrong = 0;
    for (int y = 0; y < p->height_px; y++)
        for (int x = 0; x < p->width_px; x++) {
            if (x >= LINE - 2 && x < LINE + 2) continue;
            const float *now = gn_picture_at(p, x, y),
                        *wanted = gn_picture_at(x < LINE ? left : right, x, y);
            for (int k = 0; k < 3; k++)
                if (now[k] - wanted[k] > 1.001f / 255 || wanted[k] - now[k] > 1.001f / 255) {
                    wrong++;
                    break;
                }
        }
    return wrong <= p->width_px * p->height_px / 500;
}

static void assert_splits(struct window_shown *s, const struct gn_picture *left,
                          const struct gn_picture *right, const char *name) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    struct gn_picture now = {0};
    bool same = false;
    while (!same && gn_clock_monotonic_ns() < until_ns) {
        gn_picture_finish(&now);
        now = (struct gn_picture){0};
        usleep(20000);
        same = gn_xserver_grab(window_server, s->window, &now) && now.width_px == left->width_px &&
               is_split(&now, left, right);
    }
    if (!same && now.data) gn_compare_save(NULL, name, &now, right);
    gn_picture_finish(&now);
    if (!same) fail_msg("%s: no such split", name);
}

static void press(const struct window_shown *s, unsigned long keysym) {
    gn_xserver_key(window_server, s->window, keysym);
}

static void test_t_shows_the_truth_right_of_the_line(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture mode = {0}, other = {0}, truth = {0};
    render(&mode, "pcf");
    render(&other, "none");
    render(&truth, "truth");
    assert_false(is_split(&mode, &mode, &truth)); /* they do differ there */
    show(&s, "160x120");
    window_assert_becomes(&s, &mode, false, "truth-before");
    press(&s, XK_t);
    assert_splits(&s, &mode, &truth, "truth-right");
    press(&s, XK_Left); /* the view turns, and the truth comes after it */
    sleep(1);
    press(&s, XK_Home);
    assert_splits(&s, &mode, &truth, "truth-again");
    press(&s, XK_t);
    window_assert_becomes(&s, &mode, false, "truth-left");
    press(&s, XK_x); /* two modes, then the truth in place of the right one */
    assert_splits(&s, &mode, &other, "truth-two-modes");
    press(&s, XK_t);
    assert_splits(&s, &mode, &truth, "truth-of-right");
    press(&s, XK_t);
    assert_splits(&s, &mode, &other, "truth-two-again");
    gn_picture_finish(&mode);
    gn_picture_finish(&other);
    gn_picture_finish(&truth);
    window_stop(&s);
}

/* A large window: the rays take seconds. A frame by software takes tenths of one, and more while
 * other tests run. */
static void test_the_end_does_not_wait_for_the_rays(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct window_shown s;
        show(&s, "1000x740");
        sleep(1);
        press(&s, XK_t);
        usleep(1500000);
        if (i == 1) press(&s, XK_r); /* the scene goes meanwhile */
        if (i == 2) press(&s, XK_x); /* leaves the split */
        if (i > 0) sleep(1);
        const int64_t begun_ns = gn_clock_monotonic_ns();
        window_stop(&s);
        const int64_t took_ns = gn_clock_monotonic_ns() - begun_ns;
        if (took_ns >= 2 * GN_NS_PER_S) fail_msg("%d: %.2f s", i, (double)took_ns * 1e-9);
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_t_shows_the_truth_right_of_the_line, window_clear_up),
        cmocka_unit_test_teardown(test_the_end_does_not_wait_for_the_rays, window_clear_up),
    };
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    window_server = gn_xserver_start();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(config_file);
    gn_xserver_stop(window_server);
    return failures;
}
