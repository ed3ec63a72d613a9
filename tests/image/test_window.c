/* The window, on an X server that nobody sees: what stands in it is what `gnomon render` draws. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after what it needs */
#include <X11/keysym.h>
#include <cmocka.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/compare.h"
#include "image/in_window.h"
#include "image/shot.h"

enum { PATIENCE_S = 60 };

/* ---- the tests ---- */

static void test_a_window_shows_what_render_draws(void **state) {
    (void)state;
    struct window_shown s;
    window_show(&s, "640x480");
    window_assert_becomes_render(&s, "640x480", "window");
    window_stop(&s);
}

static void test_without_srgb_shaders_encode(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture expected = {0};
    const char *args[] = {"show",    window_scene,     "--backend", "window", "--size",
                          "320x200", "--no-animation", "--without", "srgb",   NULL};
    window_start(&s, args);
    window_find(&s);
    window_render(&expected, "320x200", "--without", "srgb");
    window_assert_becomes(&s, &expected, false, "window-encoded");
    gn_picture_finish(&expected);
    window_stop(&s);
}

/* ---- antialiasing ---- */

/* White on black, nothing else. */
static const char edges[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"extensionsUsed\":[\"KHR_materials_unlit\"],"
    "\"scenes\":[{\"nodes\":[0],\"extras\":{\"gnomon_background\":[0,0,0]}}],"
    "\"nodes\":[{\"mesh\":0}],"
    "\"materials\":[{\"doubleSided\":true,\"extensions\":{\"KHR_materials_unlit\":{}}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "%s\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,1,0]}]}\n";

static const char *edges_file(void) {
    static char path[300];
    snprintf(path, sizeof path, "%s/window-edges-%d.gltf", gn_shot_build(), (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, edges, "AAAAAAAAAAAAAAAAAACAP7geBT4AAAAAzcxMPgAAgD8AAAAA");
    assert_int_equal(fclose(file), 0);
    return path;
}

/* Every pixel is black, white, or some quarters of white light as sRGB encodes them; all three are
 * there. Averages of encoded values would be 64, 128, 191. */
static void assert_edges_are_light(const struct gn_picture *p, const char *name) {
    static const int quarters[] = {0, 137, 188, 225, 255};
    long found[5] = {0};
    for (int y = 0; y < p->height_px; y++)
        for (int x = 0; x < p->width_px; x++) {
            const float v = 255 * gn_picture_at(p, x, y)[0];
            int i = 0;
            while (i < 5 && (v < (float)quarters[i] - 1.01f || v > (float)quarters[i] + 1.01f)) i++;
            if (i == 5) fail_msg("%s: %.1f at %d, %d", name, (double)v, x, y);
            found[i]++;
        }
    printf("%s: %ld, %ld, %ld pixels of 1, 2, 3 quarters\n", name, found[1], found[2], found[3]);
    for (int i = 0; i < 5; i++) assert_true(found[i] > 10);
}

static void check_edges(const char *file, const char *without, const char *name) {
    struct window_shown s;
    struct gn_picture expected = {0}, now = {0};
    const char *args[] = {"show",     file,   "--backend", "window", "--size", "320x200",
                          "--msaa",   "4",    "--floor",   "none",   "--tone", "none",
                          "--gather", "none", "--without", without,  NULL};
    const char *alike[] = {"--size", "320x200",   "--msaa", "4", "--backend",
                           "egl",    "--without", without,  NULL};
    struct gn_err err = {0};
    if (!gn_shot(&expected, NULL, &err, "png", file, alike)) fail_msg("%s", err.text);
    assert_edges_are_light(&expected, "egl");
    window_start(&s, args);
    window_find(&s);
    window_assert_becomes(&s, &expected, false, name);
    assert_true(gn_xserver_grab(window_server, s.window, &now));
    assert_edges_are_light(&now, name);
    gn_picture_finish(&expected);
    gn_picture_finish(&now);
    window_stop(&s);
}

/* Light is averaged, not what stands for it in bytes; also where shaders encode. */
static void test_edges_in_a_window_are_those_of_render(void **state) {
    (void)state;
    const char *file = edges_file();
    check_edges(file, "timer", "window-edges");
    check_edges(file, "srgb", "window-edges-encoded");
    unlink(file);
}

static void test_a_window_is_antialiased_if_asked(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture smooth = {0};
    const char *args[] = {"show",    window_scene,     "--backend", "window", "--size",
                          "320x200", "--no-animation", "--msaa",    "4",      NULL};
    window_start(&s, args);
    window_find(&s);
    window_render(&smooth, "320x200", "--msaa", "4");
    window_assert_becomes(&s, &smooth, false, "window-smooth");
    gn_picture_finish(&smooth);
    window_stop(&s);
}

static void test_the_picture_follows_the_windows_size(void **state) {
    (void)state;
    struct window_shown s;
    window_show(&s, "640x480");
    gn_xserver_resize(window_server, s.window, 500, 300);
    window_assert_becomes_render(&s, "500x300", "window-smaller");
    gn_xserver_resize(window_server, s.window, 300, 700);
    window_assert_becomes_render(&s, "300x700", "window-higher");
    window_stop(&s);
}

static void test_what_was_covered_is_drawn_again(void **state) {
    (void)state;
    struct window_shown s;
    window_show(&s, "320x200");
    window_assert_becomes_render(&s, "320x200", "window-before");
    gn_xserver_cover(window_server);
    window_assert_becomes_render(&s, "320x200", "window-uncovered");
    window_stop(&s);
}

/* In the same context, where another picture was drawn before. */
static void test_a_reload_changes_nothing_that_did_not_change(void **state) {
    (void)state;
    struct window_shown s;
    window_show(&s, "320x200");
    window_assert_becomes_render(&s, "320x200", "window-loaded");
    kill(s.pid, SIGHUP);
    sleep(1);
    gn_xserver_resize(window_server, s.window, 300, 200);
    window_assert_becomes_render(&s, "300x200", "window-reloaded");
    window_stop(&s);
}

static void test_full_screen_and_back(void **state) {
    (void)state;
    struct window_shown s;
    window_show(&s, "320x200");
    gn_xserver_key(window_server, s.window, XK_F11);
    window_assert_becomes_render(&s, "1024x768", "window-full");
    gn_xserver_key(window_server, s.window, XK_F11);
    window_assert_becomes_render(&s, "320x200", "window-back");
    window_stop(&s);
}

static void test_a_hand_moves_the_view_and_home_puts_it_back(void **state) {
    (void)state;
    static const struct {
        const char *name;
        unsigned button;
        int right_px, down_px;
    } hands[] = {{"turn", 1, 60, 20},
                 {"pan by the middle", 2, 60, 0},
                 {"pan by the right", 3, 0, 50},
                 {"nearer", 4, 0, 0},
                 {"farther", 5, 0, 0}};
    struct window_shown s;
    struct gn_picture home = {0};
    window_show(&s, "320x200");
    window_render(&home, "320x200", NULL, NULL);
    for (size_t i = 0; i < sizeof hands / sizeof *hands; i++) {
        window_assert_becomes(&s, &home, false, "window-home");
        gn_xserver_drag(window_server, s.window, hands[i].button, hands[i].right_px,
                        hands[i].down_px);
        window_assert_becomes(&s, &home, true, hands[i].name);
        gn_xserver_key(window_server, s.window, XK_Home);
    }
    window_assert_becomes(&s, &home, false, "window-home");
    gn_picture_finish(&home);
    window_stop(&s);
}

static void test_a_pan_moves_the_picture_with_the_pointer(void **state) {
    (void)state;
    struct window_shown s;
    struct gn_picture home = {0};
    window_show(&s, "320x200");
    window_render(&home, "320x200", NULL, NULL);
    gn_xserver_drag(window_server, s.window, 3, 40, 30);
    window_assert_becomes(&s, &home, true, "panned");
    gn_xserver_drag(window_server, s.window, 3, -40, -30);
    window_assert_becomes(&s, &home, false, "panned back");
    gn_picture_finish(&home);
    window_stop(&s);
}

static void test_every_way_to_close_it_ends_with_0(void **state) {
    (void)state;
    static const unsigned long keys[] = {XK_Escape, XK_q};
    struct window_shown s;
    window_show(&s, "100x100");
    gn_xserver_close(window_server, s.window);
    window_assert_ends_well(&s);
    for (int i = 0; i < 2; i++) {
        window_show(&s, "100x100");
        gn_xserver_key(window_server, s.window, keys[i]);
        window_assert_ends_well(&s);
    }
    window_show(&s, "100x100");
    kill(s.pid, SIGINT);
    window_assert_ends_well(&s);
}

static int64_t cpu_ms_of(pid_t pid) {
    char path[64];
    unsigned long user = 0, system = 0;
    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    FILE *file = fopen(path, "r");
    if (!file) return 0;
    const int got = fscanf(file, "%*d (%*[^)]) %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu",
                           &user, &system);
    fclose(file);
    return got == 2 ? (int64_t)(user + system) * 1000 / sysconf(_SC_CLK_TCK) : 0;
}

/* The programs of other modes are made once the first picture is seen. */
static void await_rest(pid_t pid) {
    int64_t before_ms = -1000, now_ms = cpu_ms_of(pid);
    for (int i = 0; i < 600 && now_ms - before_ms > 10; i++) {
        sleep(1);
        before_ms = now_ms;
        now_ms = cpu_ms_of(pid);
    }
}

/* By the last line of --stats; 0: there is none yet. */
static int count_drawn(struct window_shown *s) {
    char said[4000];
    const char *last = "";
    int drawn = 0;
    window_read_said(s, said, sizeof said);
    for (const char *line = said; (line = strstr(line, " fps, ")); line++) last = line;
    sscanf(last, " fps, %d drawn", &drawn);
    return drawn;
}

static void test_a_still_picture_is_drawn_once(void **state) {
    (void)state;
    struct window_shown s;
    const char *args[] = {"show",    window_scene,     "--backend", "window", "--size",
                          "320x200", "--no-animation", "--stats",   NULL};
    const int seconds = gn_shot_full() ? 60 : 3;
    window_start(&s, args);
    window_find(&s);
    window_assert_becomes_render(&s, "320x200", "window-still");
    await_rest(s.pid);
    const int64_t before_ms = cpu_ms_of(s.pid);
    const int loaded = count_drawn(&s); /* on a slow machine those of the bar among them */
    sleep((unsigned)seconds);
    const int64_t spent_ms = cpu_ms_of(s.pid) - before_ms;
    kill(s.pid, SIGTERM);
    assert_int_equal(window_end_of(&s), 0);
    const int drawn = count_drawn(&s);
    unlink(s.said);
    printf("%d frames drawn, %d of them at first, and %d ms of CPU time in %d s\n", drawn, loaded,
           (int)spent_ms, seconds);
    assert_true(drawn >= 1);
    assert_in_range(drawn - loaded, 0, 4); /* what the server asked for */
    assert_true(spent_ms <= seconds * 10);
}

static void assert_says(const char *const args[], int status, const char *words) {
    struct gn_run *run = calloc(1, sizeof *run);
    const char *argv[20] = {gn_shot_program()};
    struct gn_err err = {0};
    for (int i = 0; args[i]; i++) argv[1 + i] = args[i];
    assert_true(gn_run(run, argv, PATIENCE_S, &err));
    if (run->status != status || !strstr(run->err, words))
        fail_msg("%d: %s", run->status, run->err);
    assert_ptr_equal(strchr(run->err, '\n'), run->err + strlen(run->err) - 1); /* one line */
    free(run);
}

static void test_without_a_desktop_there_is_one_line(void **state) {
    (void)state;
    const char *args[] = {"show", "--backend", "window", NULL};
    char *name = strdup(getenv("DISPLAY"));
    setenv("DISPLAY", ":no-such-display", 1);
    assert_says(args, 1, "no display server found");
    unsetenv("DISPLAY");
    assert_says(args, 1, "no display server found");
    setenv("DISPLAY", name, 1);
    free(name);
}

static void test_bare_gnomon_opens_a_window(void **state) {
    (void)state;
    struct window_shown s;
    const char *args[] = {window_scene, "--size", "320x200", "--no-animation", NULL};
    window_start(&s, args);
    window_find(&s);
    window_assert_becomes_render(&s, "320x200", "window-bare");
    gn_xserver_close(window_server, s.window);
    window_assert_ends_well(&s);
}

/* The last one: there is no server after it. */
static void test_a_server_that_ends_is_a_display_given_up(void **state) {
    (void)state;
    struct window_shown s;
    char said[1000];
    window_show(&s, "100x100");
    window_assert_becomes_render(&s, "100x100", "window-last");
    kill(gn_xserver_pid(window_server), SIGKILL);
    assert_int_equal(window_end_of(&s), GN_EXIT_DISPLAY);
    window_read_said(&s, said, sizeof said);
    unlink(s.said);
    assert_string_equal(said, "gnomon: the X server has ended\n");
}

/* An argument is a pattern of tests. */
int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_a_window_shows_what_render_draws, window_clear_up),
        cmocka_unit_test_teardown(test_without_srgb_shaders_encode, window_clear_up),
        cmocka_unit_test_teardown(test_a_window_is_antialiased_if_asked, window_clear_up),
        cmocka_unit_test_teardown(test_edges_in_a_window_are_those_of_render, window_clear_up),
        cmocka_unit_test_teardown(test_the_picture_follows_the_windows_size, window_clear_up),
        cmocka_unit_test_teardown(test_what_was_covered_is_drawn_again, window_clear_up),
        cmocka_unit_test_teardown(test_a_reload_changes_nothing_that_did_not_change,
                                  window_clear_up),
        cmocka_unit_test_teardown(test_full_screen_and_back, window_clear_up),
        cmocka_unit_test_teardown(test_a_hand_moves_the_view_and_home_puts_it_back,
                                  window_clear_up),
        cmocka_unit_test_teardown(test_a_pan_moves_the_picture_with_the_pointer, window_clear_up),
        cmocka_unit_test_teardown(test_every_way_to_close_it_ends_with_0, window_clear_up),
        cmocka_unit_test_teardown(test_a_still_picture_is_drawn_once, window_clear_up),
        cmocka_unit_test_teardown(test_without_a_desktop_there_is_one_line, window_clear_up),
        cmocka_unit_test_teardown(test_bare_gnomon_opens_a_window, window_clear_up),
        cmocka_unit_test_teardown(test_a_server_that_ends_is_a_display_given_up, window_clear_up),
    };
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    window_server = gn_xserver_start();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    gn_xserver_stop(window_server);
    return failures;
}
