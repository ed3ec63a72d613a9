/* The window as a viewer: title, icon, dropped files, and its keys. What a key does is seen in the
 * window, and compared with what render draws with the option that says the same. */
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
#include "unit/gl_help.h"

enum { PATIENCE_S = 60, CLIPS = 2 /* of the sundial */ };

static const char size[] = "320x240";
static char config_file[400]; /* read again by a reload */

static char *absolute(const char *path) {
    char *real = realpath(path, NULL);
    if (!real) fail_msg("no %s", path);
    return real;
}

static void render_scene(struct gn_picture *out, const char *scene, const char *const options[]) {
    const char *args[12] = {"--size", size, "--no-animation"};
    struct gn_err err = {0};
    for (int i = 0; options && options[i]; i++) args[3 + i] = options[i];
    if (!gn_shot(out, NULL, &err, "png", scene, args)) fail_msg("%s", err.text);
}

static void assert_shows(struct window_shown *s, const char *scene, const char *const options[],
                         const char *name) {
    struct gn_picture expected = {0};
    render_scene(&expected, scene, options);
    window_assert_becomes(s, &expected, false, name);
    gn_picture_finish(&expected);
}

static void press(const struct window_shown *s, unsigned long keysym) {
    gn_xserver_key(window_server, s->window, keysym);
}

static void assert_title(const struct window_shown *s, const char *expected) {
    char title[300] = "";
    for (int i = 0; i < 600 && strcmp(title, expected) != 0; i++) {
        usleep(20000);
        gn_xserver_title(window_server, s->window, title, sizeof title);
    }
    assert_string_equal(title, expected);
}

/* A kiosk without captions, which would lie over the picture. */
static void show_quietly(struct window_shown *s, const char *scene, const char *config) {
    snprintf(config_file, sizeof config_file, "%s/viewer-%d.ini", gn_shot_build(), (int)getpid());
    FILE *file = fopen(config_file, "w");
    assert_non_null(file);
    fprintf(file, "[kiosk]\ncaptions = no\n%s", config);
    assert_int_equal(fclose(file), 0);
    char *config_path = absolute(config_file), *scene_path = absolute(scene);
    const char *args[] = {"show",   scene_path, "-c", config_path,      "--backend",
                          "window", "--size",   size, "--no-animation", NULL};
    window_start(s, args);
    window_find(s);
    free(config_path);
    free(scene_path);
}

/* ---- title, icon, dropped files ---- */

static void test_the_title_is_the_files_name(void **state) {
    (void)state;
    struct window_shown s;
    window_show(&s, size);
    assert_title(&s, "sundial.glb - gnomon");
    window_stop(&s);
}

static void test_the_window_has_an_icon(void **state) {
    (void)state;
    struct window_shown s;
    unsigned long *icon;
    window_show(&s, size);
    const size_t count = gn_xserver_icon(window_server, s.window, &icon);
    assert_int_equal(count, 2 + 32 * 32 + 2 + 64 * 64);
    assert_true(icon[0] == 32 && icon[1] == 32);
    assert_int_equal(icon[2] >> 24 & 255, 0);                  /* a corner: transparent */
    assert_int_equal(icon[2 + 16 * 32 + 3] >> 24 & 255, 0xff); /* on the dial */
    free(icon);
    window_stop(&s);
}

static void test_a_dropped_file_is_shown(void **state) {
    (void)state;
    struct window_shown s;
    char *other = absolute("assets/bench/s1.glb");
    show_quietly(&s, window_scene, "");
    assert_shows(&s, window_scene, NULL, "viewer-before");
    assert_true(gn_xserver_drop(window_server, s.window, other));
    assert_title(&s, "s1.glb - gnomon");
    assert_shows(&s, other, NULL, "viewer-dropped");
    press(&s, XK_F5); /* loads what was dropped again */
    sleep(1);
    assert_title(&s, "s1.glb - gnomon");
    assert_shows(&s, other, NULL, "viewer-reloaded");
    free(other);
    window_stop(&s);
}

static void test_a_bad_file_that_is_dropped_leaves_the_scene_and_says_why(void **state) {
    (void)state;
    struct window_shown s;
    char path[300], said[1000] = "";
    snprintf(path, sizeof path, "%s/viewer-bad.glb", gn_shot_build());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("this is no scene", file);
    assert_int_equal(fclose(file), 0);
    char *bad = absolute(path);
    show_quietly(&s, window_scene, "");
    assert_shows(&s, window_scene, NULL, "viewer-before-bad");
    assert_true(gn_xserver_drop(window_server, s.window, bad));
    for (int i = 0; i < 500 && !strstr(said, "viewer-bad.glb"); i++) {
        usleep(20000);
        window_read_said(&s, said, sizeof said);
    }
    assert_non_null(strstr(said, "viewer-bad.glb"));
    assert_title(&s, "sundial.glb - gnomon");
    assert_shows(&s, window_scene, NULL, "viewer-after-bad");
    kill(s.pid, SIGTERM);
    assert_int_equal(window_end_of(&s), 0);
    unlink(s.said);
    unlink(path);
    free(bad);
}

/* ---- keys ---- */

static void test_help_lies_over_the_picture_until_a_key(void **state) {
    (void)state;
    static const unsigned long on[] = {XK_h, XK_F1}, off[] = {XK_h, XK_n};
    struct window_shown s;
    struct gn_picture plain = {0};
    show_quietly(&s, window_scene, "");
    render_scene(&plain, window_scene, NULL);
    for (int i = 0; i < 2; i++) {
        window_assert_becomes(&s, &plain, false, "viewer-plain");
        press(&s, on[i]);
        window_assert_becomes(&s, &plain, true, "viewer-help");
        press(&s, off[i]); /* only that: n is not the next mode here */
    }
    window_assert_becomes(&s, &plain, false, "viewer-plain");
    gn_picture_finish(&plain);
    window_stop(&s);
}

static void test_numbers_choose_cameras(void **state) {
    (void)state;
    struct window_shown s;
    char *scene = absolute("assets/sundial.glb");
    show_quietly(&s, scene, "");
    assert_shows(&s, scene, NULL, "viewer-camera-1");
    press(&s, XK_2);
    assert_shows(&s, scene, (const char *const[]){"--camera", "1", NULL}, "viewer-camera-2");
    press(&s, XK_1);
    assert_shows(&s, scene, (const char *const[]){"--camera", "0", NULL}, "viewer-camera-1");
    press(&s, XK_9); /* none of that number */
    press(&s, XK_2);
    assert_shows(&s, scene, (const char *const[]){"--camera", "1", NULL}, "viewer-camera-2");
    free(scene);
    window_stop(&s);
}

static void test_arrows_turn_the_view_as_the_mouse_does(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture home = {0};
    show_quietly(&s, window_scene, "");
    render_scene(&home, window_scene, NULL);
    window_assert_becomes(&s, &home, false, "viewer-home");
    press(&s, XK_Right);
    window_assert_becomes(&s, &home, true, "viewer-right");
    press(&s, XK_Left);
    window_assert_becomes(&s, &home, false, "viewer-left");
    press(&s, XK_Up);
    window_assert_becomes(&s, &home, true, "viewer-up");
    press(&s, XK_Home);
    window_assert_becomes(&s, &home, false, "viewer-home");
    gn_picture_finish(&home);
    window_stop(&s);
}

static void test_arrows_that_the_configuration_gives_to_a_button_are_its(void **state) {
    (void)state;
    struct window_shown s;
    show_quietly(&s, window_scene,
                 "[mode \"A\"]\nshadow = pcf\n[mode \"B\"]\nshadow = none\n"
                 "[button \"x\"]\nkeys = right\npress = next\n");
    assert_shows(&s, window_scene, (const char *const[]){"--shadow", "pcf", NULL}, "viewer-mode");
    press(&s, XK_Right);
    assert_shows(&s, window_scene, (const char *const[]){"--shadow", "none", NULL},
                 "viewer-button");
    window_stop(&s);
}

static void test_e_switches_the_environment(void **state) {
    (void)state;
    struct window_shown s;
    /* occlusion comes later, and fades in: test_stage_occlusion */
    show_quietly(&s, window_scene, "[render]\ntone = none\nocclusion = none\n");
    assert_shows(&s, window_scene, NULL, "viewer-environment");
    press(&s, XK_e);
    assert_shows(&s, window_scene,
                 (const char *const[]){"--environment", "studio", "--environment-strength", "0.35",
                                       "--occlusion", "none", NULL},
                 "viewer-studio");
    press(&s, XK_e);
    assert_shows(&s, window_scene, (const char *const[]){"--environment", "none", NULL},
                 "viewer-no-environment");
    window_stop(&s);
}

static void test_a_goes_through_the_clips_and_ends_with_none(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture still = {0};
    show_quietly(&s, window_scene, "");
    render_scene(&still, window_scene, NULL);
    window_assert_becomes(&s, &still, false, "viewer-still");
    press(&s, XK_a);
    window_assert_becomes(&s, &still, true, "viewer-clip");
    for (int i = 1; i < CLIPS; i++) press(&s, XK_a);
    window_assert_becomes(&s, &still, true, "viewer-last-clip");
    press(&s, XK_a);
    window_assert_becomes(&s, &still, false, "viewer-no-clip");
    gn_picture_finish(&still);
    window_stop(&s);
}

static void test_what_the_speed_is_now_is_told_for_a_while(void **state) {
    (void)state;
    static const unsigned long keys[] = {XK_bracketright, XK_plus, XK_minus, XK_bracketleft};
    struct window_shown s;
    struct gn_picture home = {0};
    window_show(&s, size);
    render_scene(&home, window_scene, NULL);
    for (int i = 0; i < 4; i++) {
        window_assert_becomes(&s, &home, false, "viewer-speed-gone");
        press(&s, keys[i]);
        window_assert_becomes(&s, &home, true, "viewer-speed");
    }
    gn_picture_finish(&home);
    window_stop(&s);
}

static void test_f12_writes_the_picture_without_texts_beside_earlier_ones(void **state) {
    (void)state;
    struct window_shown s;
    const char *folder = help_folder();
    char path[600];
    struct gn_picture expected = {0};
    struct gn_difference d = {0};
    render_scene(&expected, window_scene, NULL);
    window_folder = folder;
    show_quietly(&s, window_scene, "");
    window_folder = NULL;
    window_assert_becomes(&s, &expected, false, "viewer-to-write");
    for (int i = 1; i <= 2; i++) {
        struct gn_picture written = {0};
        struct gn_err err = {0};
        press(&s, i == 1 ? XK_F12 : XK_Print);
        snprintf(path, sizeof path, "%s/gnomon-sundial-%03d.png", folder, i);
        for (int k = 0; k < 500 && access(path, R_OK) != 0; k++) usleep(20000);
        if (!gn_picture_read(&written, path, &err)) fail_msg("%s", err.text);
        assert_true(gn_compare(&written, &expected, 1.001 / 255, &d) && d.share <= .001);
        gn_picture_finish(&written);
        usleep(200000); /* until it is taken */
    }
    gn_picture_finish(&expected);
    window_stop(&s);
    help_remove(folder);
}

/* ---- the split screen ---- */

static void grab_still(struct window_shown *s, struct gn_picture *out) {
    for (int i = 0; i < 500 && !gn_xserver_grab(window_server, s->window, out); i++) usleep(20000);
    assert_non_null(out->data);
}

/* Left of the line one, right of it the other, to the byte; the line is black and white. */
static bool is_split(const struct gn_picture *p, const struct gn_picture *left,
                     const struct gn_picture *right, int line) {
    for (int y = 0; y < p->height_px; y++)
        for (int x = 0; x < p->width_px; x++) {
            const float *now = gn_picture_at(p, x, y);
            if (x >= line - 2 && x < line + 2) {
                if (now[1] != (x == line - 2 || x == line + 1 ? 0.0f : 1.0f)) return false;
                continue;
            }
            const struct gn_picture *side = x < line ? left : right;
            if (memcmp(now, gn_picture_at(side, x, y), 3 * sizeof *now) != 0) return false;
        }
    return true;
}

static void assert_splits(struct window_shown *s, const struct gn_picture *left,
                          const struct gn_picture *right, int line, const char *name) {
    struct gn_picture now = {0};
    bool right_one = false;
    for (int i = 0; i < 1000 && !right_one; i++) {
        gn_picture_finish(&now);
        now = (struct gn_picture){0};
        usleep(20000);
        right_one =
            gn_xserver_grab(window_server, s->window, &now) && is_split(&now, left, right, line);
    }
    if (!right_one && now.data) gn_compare_save(NULL, name, &now, right);
    gn_picture_finish(&now);
    if (!right_one) fail_msg("%s: not split at %d", name, line);
}

static void test_x_splits_the_screen_and_the_mouse_drags_the_line(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture a = {0}, b = {0};
    show_quietly(&s, window_scene,
                 "[mode \"A\"]\nshadow = pcf\n[mode \"B\"]\nshadow = none\n"
                 "[mode \"C\"]\nshadow = hard\n");
    assert_shows(&s, window_scene, (const char *const[]){"--shadow", "pcf", NULL}, "viewer-a");
    grab_still(&s, &a);
    press(&s, XK_x); /* A left, B right */
    sleep(1);
    press(&s, XK_x); /* B alone */
    assert_shows(&s, window_scene, (const char *const[]){"--shadow", "none", NULL}, "viewer-b");
    grab_still(&s, &b);
    assert_memory_not_equal(a.data, b.data, sizeof(float) * 3 * 320 * 240);
    press(&s, XK_p);
    assert_shows(&s, window_scene, (const char *const[]){"--shadow", "pcf", NULL}, "viewer-a");
    press(&s, XK_Tab);
    assert_splits(&s, &a, &b, 160, "viewer-split");
    gn_xserver_drag(window_server, s.window, 1, 60, 10);
    assert_splits(&s, &a, &b, 220, "viewer-split-dragged");
    press(&s, XK_p); /* the right side changes modes */
    assert_splits(&s, &a, &a, 220, "viewer-split-same");
    press(&s, XK_n);
    assert_splits(&s, &a, &b, 220, "viewer-split-again");
    gn_xserver_drag(window_server, s.window, 1, 40, 0); /* not on the line: turns both */
    sleep(1);
    press(&s, XK_Home);
    assert_splits(&s, &a, &b, 220, "viewer-split-home");
    gn_picture_finish(&a);
    gn_picture_finish(&b);
    window_stop(&s);
}

/* ---- no window ---- */

static void test_without_an_x_server_it_says_what_is_missing_and_writes_a_file(void **state) {
    (void)state;
    const char *folder = help_folder();
    char *program = absolute(gn_shot_program()), *scene = absolute(window_scene), command[1200];
    struct gn_run *run = calloc(1, sizeof *run);
    struct gn_err err = {0};
    snprintf(command, sizeof command,
             "cd '%s' && env -u DISPLAY WAYLAND_DISPLAY=none-such '%s' '%s' --size 32x32", folder,
             program, scene);
    const char *argv[] = {"/bin/sh", "-c", command, NULL};
    assert_true(gn_run(run, argv, PATIENCE_S, &err));
    assert_int_equal(run->status, 0);
    if (!strstr(run->err, "no window: backend window: this libglfw.so.3 is for X11 alone") &&
        !strstr(run->err,
                "no window: backend window: no display server found")) /* a GLFW that has both */
        fail_msg("%s", run->err);
    assert_ptr_equal(strchr(run->err, '\n'), run->err + strlen(run->err) - 1); /* one line */
    assert_non_null(strstr(run->out, "/gnomon.png\n"));
    free(run);
    free(program);
    free(scene);
    help_remove(folder);
}

/* An argument is a pattern of tests: "*drop*". */
int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_the_title_is_the_files_name, window_clear_up),
        cmocka_unit_test_teardown(test_the_window_has_an_icon, window_clear_up),
        cmocka_unit_test_teardown(test_a_dropped_file_is_shown, window_clear_up),
        cmocka_unit_test_teardown(test_a_bad_file_that_is_dropped_leaves_the_scene_and_says_why,
                                  window_clear_up),
        cmocka_unit_test_teardown(test_help_lies_over_the_picture_until_a_key, window_clear_up),
        cmocka_unit_test_teardown(test_numbers_choose_cameras, window_clear_up),
        cmocka_unit_test_teardown(test_arrows_turn_the_view_as_the_mouse_does, window_clear_up),
        cmocka_unit_test_teardown(test_arrows_that_the_configuration_gives_to_a_button_are_its,
                                  window_clear_up),
        cmocka_unit_test_teardown(test_e_switches_the_environment, window_clear_up),
        cmocka_unit_test_teardown(test_a_goes_through_the_clips_and_ends_with_none,
                                  window_clear_up),
        cmocka_unit_test_teardown(test_what_the_speed_is_now_is_told_for_a_while, window_clear_up),
        cmocka_unit_test_teardown(test_f12_writes_the_picture_without_texts_beside_earlier_ones,
                                  window_clear_up),
        cmocka_unit_test_teardown(test_x_splits_the_screen_and_the_mouse_drags_the_line,
                                  window_clear_up),
        cmocka_unit_test_teardown(
            test_without_an_x_server_it_says_what_is_missing_and_writes_a_file, window_clear_up),
    };
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    window_server = gn_xserver_start();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(config_file);
    gn_xserver_stop(window_server);
    return failures;
}
