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
#include "image/shot.h"
#include "image/xserver.h"

enum { PATIENCE_S = 60, WIDTH = 640, HEIGHT = 480 };

static struct gn_xserver *server;
static const char scene[] = "assets/sundial.glb";

/* ---- a program in a window ---- */

struct shown {
    pid_t pid;
    gn_xwindow window;
    char said[400]; /* the file with what it says */
};
static pid_t running; /* what a test that fails leaves behind */

static int clear_up(void **state) {
    (void)state;
    if (running > 0 && kill(running, SIGKILL) == 0) waitpid(running, NULL, 0);
    running = 0;
    return 0;
}

static void start(struct shown *s, const char *const args[]) {
    const char *argv[24] = {gn_shot_program()};
    int count = 1;
    snprintf(s->said, sizeof s->said, "%s/window-%d.txt", gn_shot_build(), (int)getpid());
    for (int i = 0; args[i]; i++) argv[count++] = args[i];
    argv[count++] = "--environment"; /* as in gn_shot() */
    argv[count] = "none";
    s->window = 0;
    running = s->pid = fork();
    if (s->pid != 0) return;
    const int said = open(s->said, O_RDWR | O_CREAT | O_TRUNC, 0600);
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(said, 1);
    dup2(said, 2);
    execv(argv[0], (char *const *)argv);
    _exit(127);
}

static void read_said(const struct shown *s, char *out, size_t size) {
    FILE *file = fopen(s->said, "r");
    const size_t length = file ? fread(out, 1, size - 1, file) : 0;
    out[length] = 0;
    if (file) fclose(file);
}

static void find(struct shown *s) {
    char said[1000];
    s->window = gn_xserver_find(server, "gnomon", PATIENCE_S);
    if (s->window) return;
    read_said(s, said, sizeof said);
    fail_msg("no window: %s", said);
}

static void show(struct shown *s, const char *size) {
    const char *args[] = {"show",   scene, "--backend",      "window",
                          "--size", size,  "--no-animation", NULL};
    start(s, args);
    find(s);
}

/* Its exit status; 124 when it did not end by itself. */
static int end_of(struct shown *s) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    int status = 0;
    while (waitpid(s->pid, &status, WNOHANG) == 0) {
        if (gn_clock_monotonic_ns() > until_ns) return 124;
        usleep(10000);
    }
    running = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* With status 0 and without a word. */
static void assert_ends_well(struct shown *s) {
    char said[1000];
    const int status = end_of(s);
    read_said(s, said, sizeof said);
    unlink(s->said);
    if (status != 0 || said[0]) fail_msg("status %d: %s", status, said);
}

static void stop(struct shown *s) {
    kill(s->pid, SIGTERM);
    assert_ends_well(s);
}

/* ---- pictures ---- */

/* Not more than 1/255 apart in 99.9 % of the pixels. */
static bool is_like(const struct gn_picture *a, const struct gn_picture *b,
                    struct gn_difference *d) {
    return gn_compare(a, b, 1.001 / 255, d) && d->share <= .001;
}

/* Becomes such a picture before patience ends; with differ, any other one. */
static void assert_becomes(struct shown *s, const struct gn_picture *expected, bool differ,
                           const char *name) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    struct gn_picture now = {0};
    struct gn_difference d = {0};
    bool right = false;
    while (!right && gn_clock_monotonic_ns() < until_ns) {
        gn_picture_finish(&now);
        now = (struct gn_picture){0};
        usleep(30000);
        if (!gn_xserver_grab(server, s->window, &now)) continue;
        right = now.width_px == expected->width_px && is_like(&now, expected, &d) != differ;
    }
    if (right)
        printf("%s: %.4f %% of the pixels apart, at most %.4f\n", name, 100 * d.share, d.max);
    else if (now.data && !differ)
        gn_compare_save(NULL, name, &now, expected);
    gn_picture_finish(&now);
    if (!right) fail_msg("%s: %.3f %% of the pixels apart", name, 100 * d.share);
}

static void render(struct gn_picture *picture, const char *size, const char *option,
                   const char *value) {
    const char *args[] = {"--size", size, "--no-animation", option, value, NULL};
    struct gn_err err = {0};
    if (!gn_shot(picture, NULL, &err, "png", scene, args)) fail_msg("%s", err.text);
}

static void assert_becomes_render(struct shown *s, const char *size, const char *name) {
    struct gn_picture expected = {0};
    render(&expected, size, NULL, NULL);
    assert_becomes(s, &expected, false, name);
    gn_picture_finish(&expected);
}

/* ---- the tests ---- */

static void test_a_window_shows_what_render_draws(void **state) {
    (void)state;
    struct shown s;
    show(&s, "640x480");
    assert_becomes_render(&s, "640x480", "window");
    stop(&s);
}

static void test_without_srgb_shaders_encode(void **state) {
    (void)state;
    struct shown s;
    struct gn_picture expected = {0};
    const char *args[] = {"show",           scene,       "--backend", "window", "--size", "320x200",
                          "--no-animation", "--without", "srgb",      NULL};
    start(&s, args);
    find(&s);
    render(&expected, "320x200", "--without", "srgb");
    assert_becomes(&s, &expected, false, "window-encoded");
    gn_picture_finish(&expected);
    stop(&s);
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
    struct shown s;
    struct gn_picture expected = {0}, now = {0};
    const char *args[] = {"show",    file,     "--backend", "window",  "--size",
                          "320x200", "--msaa", "4",         "--floor", "none",
                          "--tone",  "none",   "--without", without,   NULL};
    const char *alike[] = {"--size", "320x200",   "--msaa", "4", "--backend",
                           "egl",    "--without", without,  NULL};
    struct gn_err err = {0};
    if (!gn_shot(&expected, NULL, &err, "png", file, alike)) fail_msg("%s", err.text);
    assert_edges_are_light(&expected, "egl");
    start(&s, args);
    find(&s);
    assert_becomes(&s, &expected, false, name);
    assert_true(gn_xserver_grab(server, s.window, &now));
    assert_edges_are_light(&now, name);
    gn_picture_finish(&expected);
    gn_picture_finish(&now);
    stop(&s);
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
    struct shown s;
    struct gn_picture smooth = {0};
    const char *args[] = {"show",           scene,    "--backend", "window", "--size", "320x200",
                          "--no-animation", "--msaa", "4",         NULL};
    start(&s, args);
    find(&s);
    render(&smooth, "320x200", "--msaa", "4");
    assert_becomes(&s, &smooth, false, "window-smooth");
    gn_picture_finish(&smooth);
    stop(&s);
}

static void test_the_picture_follows_the_windows_size(void **state) {
    (void)state;
    struct shown s;
    show(&s, "640x480");
    gn_xserver_resize(server, s.window, 500, 300);
    assert_becomes_render(&s, "500x300", "window-smaller");
    gn_xserver_resize(server, s.window, 300, 700);
    assert_becomes_render(&s, "300x700", "window-higher");
    stop(&s);
}

static void test_what_was_covered_is_drawn_again(void **state) {
    (void)state;
    struct shown s;
    show(&s, "320x200");
    assert_becomes_render(&s, "320x200", "window-before");
    gn_xserver_cover(server);
    assert_becomes_render(&s, "320x200", "window-uncovered");
    stop(&s);
}

/* In the same context, where another picture was drawn before. */
static void test_a_reload_changes_nothing_that_did_not_change(void **state) {
    (void)state;
    struct shown s;
    show(&s, "320x200");
    assert_becomes_render(&s, "320x200", "window-loaded");
    kill(s.pid, SIGHUP);
    sleep(1);
    gn_xserver_resize(server, s.window, 300, 200);
    assert_becomes_render(&s, "300x200", "window-reloaded");
    stop(&s);
}

static void test_full_screen_and_back(void **state) {
    (void)state;
    struct shown s;
    show(&s, "320x200");
    gn_xserver_key(server, s.window, XK_F11);
    assert_becomes_render(&s, "1024x768", "window-full");
    gn_xserver_key(server, s.window, XK_F11);
    assert_becomes_render(&s, "320x200", "window-back");
    stop(&s);
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
    struct shown s;
    struct gn_picture home = {0};
    show(&s, "320x200");
    render(&home, "320x200", NULL, NULL);
    for (size_t i = 0; i < sizeof hands / sizeof *hands; i++) {
        assert_becomes(&s, &home, false, "window-home");
        gn_xserver_drag(server, s.window, hands[i].button, hands[i].right_px, hands[i].down_px);
        assert_becomes(&s, &home, true, hands[i].name);
        gn_xserver_key(server, s.window, XK_Home);
    }
    assert_becomes(&s, &home, false, "window-home");
    gn_picture_finish(&home);
    stop(&s);
}

static void test_a_pan_moves_the_picture_with_the_pointer(void **state) {
    (void)state;
    struct shown s;
    struct gn_picture home = {0};
    show(&s, "320x200");
    render(&home, "320x200", NULL, NULL);
    gn_xserver_drag(server, s.window, 3, 40, 30);
    assert_becomes(&s, &home, true, "panned");
    gn_xserver_drag(server, s.window, 3, -40, -30);
    assert_becomes(&s, &home, false, "panned back");
    gn_picture_finish(&home);
    stop(&s);
}

static void test_every_way_to_close_it_ends_with_0(void **state) {
    (void)state;
    static const unsigned long keys[] = {XK_Escape, XK_q};
    struct shown s;
    show(&s, "100x100");
    gn_xserver_close(server, s.window);
    assert_ends_well(&s);
    for (int i = 0; i < 2; i++) {
        show(&s, "100x100");
        gn_xserver_key(server, s.window, keys[i]);
        assert_ends_well(&s);
    }
    show(&s, "100x100");
    kill(s.pid, SIGINT);
    assert_ends_well(&s);
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

static void test_a_still_picture_is_drawn_once(void **state) {
    (void)state;
    struct shown s;
    char said[4000];
    const char *args[] = {"show",           scene,     "--backend", "window", "--size", "320x200",
                          "--no-animation", "--stats", NULL};
    const int seconds = gn_shot_full() ? 60 : 3;
    start(&s, args);
    find(&s);
    assert_becomes_render(&s, "320x200", "window-still");
    await_rest(s.pid);
    const int64_t before_ms = cpu_ms_of(s.pid);
    sleep((unsigned)seconds);
    const int64_t spent_ms = cpu_ms_of(s.pid) - before_ms;
    kill(s.pid, SIGTERM);
    assert_int_equal(end_of(&s), 0);
    read_said(&s, said, sizeof said);
    unlink(s.said);
    const char *last = said;
    for (const char *line = said; (line = strstr(line, " fps, ")); line++) last = line;
    int drawn = 0;
    assert_int_equal(sscanf(last, " fps, %d drawn", &drawn), 1);
    printf("%d frames drawn and %d ms of CPU time in %d s\n", drawn, (int)spent_ms, seconds);
    assert_in_range(drawn, 1, 5); /* the first, and what the server asked for */
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
    struct shown s;
    const char *args[] = {scene, "--size", "320x200", "--no-animation", NULL};
    start(&s, args);
    find(&s);
    assert_becomes_render(&s, "320x200", "window-bare");
    gn_xserver_close(server, s.window);
    assert_ends_well(&s);
}

/* The last one: there is no server after it. */
static void test_a_server_that_ends_is_a_display_given_up(void **state) {
    (void)state;
    struct shown s;
    char said[1000];
    show(&s, "100x100");
    assert_becomes_render(&s, "100x100", "window-last");
    kill(gn_xserver_pid(server), SIGKILL);
    assert_int_equal(end_of(&s), GN_EXIT_DISPLAY);
    read_said(&s, said, sizeof said);
    unlink(s.said);
    assert_string_equal(said, "gnomon: the X server has ended\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_a_window_shows_what_render_draws, clear_up),
        cmocka_unit_test_teardown(test_without_srgb_shaders_encode, clear_up),
        cmocka_unit_test_teardown(test_a_window_is_antialiased_if_asked, clear_up),
        cmocka_unit_test_teardown(test_edges_in_a_window_are_those_of_render, clear_up),
        cmocka_unit_test_teardown(test_the_picture_follows_the_windows_size, clear_up),
        cmocka_unit_test_teardown(test_what_was_covered_is_drawn_again, clear_up),
        cmocka_unit_test_teardown(test_a_reload_changes_nothing_that_did_not_change, clear_up),
        cmocka_unit_test_teardown(test_full_screen_and_back, clear_up),
        cmocka_unit_test_teardown(test_a_hand_moves_the_view_and_home_puts_it_back, clear_up),
        cmocka_unit_test_teardown(test_a_pan_moves_the_picture_with_the_pointer, clear_up),
        cmocka_unit_test_teardown(test_every_way_to_close_it_ends_with_0, clear_up),
        cmocka_unit_test_teardown(test_a_still_picture_is_drawn_once, clear_up),
        cmocka_unit_test_teardown(test_without_a_desktop_there_is_one_line, clear_up),
        cmocka_unit_test_teardown(test_bare_gnomon_opens_a_window, clear_up),
        cmocka_unit_test_teardown(test_a_server_that_ends_is_a_display_given_up, clear_up),
    };
    setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
    server = gn_xserver_start();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    gn_xserver_stop(server);
    return failures;
}
