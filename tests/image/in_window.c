#include "image/in_window.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after what it needs */
#include <cmocka.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/compare.h"
#include "image/shot.h"

enum { PATIENCE_S = 60 };

struct gn_xserver *window_server;
const char window_scene[] = "assets/sundial.glb";
const char *window_folder;

/* ---- a program in a window ---- */

static pid_t running; /* what a test that fails leaves behind */

int window_clear_up(void **state) {
    (void)state;
    if (running > 0 && kill(running, SIGKILL) == 0) waitpid(running, NULL, 0);
    running = 0;
    return 0;
}

void window_start(struct window_shown *s, const char *const args[]) {
    const char *argv[24] = {gn_shot_program()};
    int count = 1;
    snprintf(s->said, sizeof s->said, "%s/window-%d.txt", gn_shot_build(), (int)getpid());
    for (int i = 0; args[i]; i++) argv[count++] = args[i];
    argv[count++] = "--environment"; /* as in gn_shot() */
    argv[count] = "none";
    if (window_folder) argv[0] = realpath(argv[0], NULL);
    s->window = 0;
    running = s->pid = fork();
    if (s->pid != 0) return;
    const int said = open(s->said, O_RDWR | O_CREAT | O_TRUNC, 0600);
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(said, 1);
    dup2(said, 2);
    if (window_folder && chdir(window_folder) != 0) _exit(126);
    execv(argv[0], (char *const *)argv);
    _exit(127);
}

void window_read_said(const struct window_shown *s, char *out, size_t size) {
    FILE *file = fopen(s->said, "r");
    const size_t length = file ? fread(out, 1, size - 1, file) : 0;
    out[length] = 0;
    if (file) fclose(file);
}

void window_find(struct window_shown *s) {
    char said[1000];
    s->window = gn_xserver_find(window_server, "gnomon", PATIENCE_S);
    if (s->window) return;
    window_read_said(s, said, sizeof said);
    fail_msg("no window: %s", said);
}

void window_show(struct window_shown *s, const char *size) {
    const char *args[] = {"show",   window_scene, "--backend",      "window",
                          "--size", size,         "--no-animation", NULL};
    window_start(s, args);
    window_find(s);
}

int window_end_of(struct window_shown *s) {
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
void window_assert_ends_well(struct window_shown *s) {
    char said[1000];
    const int status = window_end_of(s);
    window_read_said(s, said, sizeof said);
    unlink(s->said);
    if (status != 0 || said[0]) fail_msg("status %d: %s", status, said);
}

void window_stop(struct window_shown *s) {
    kill(s->pid, SIGTERM);
    window_assert_ends_well(s);
}

/* ---- pictures ---- */

/* Not more than 1/255 apart in 99.9 % of the pixels. */
static bool is_like(const struct gn_picture *a, const struct gn_picture *b,
                    struct gn_difference *d) {
    return gn_compare(a, b, 1.001 / 255, d) && d->share <= .001;
}

/* Becomes such a picture before patience ends; with differ, any other one. */
void window_assert_becomes(struct window_shown *s, const struct gn_picture *expected, bool differ,
                           const char *name) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    struct gn_picture now = {0};
    struct gn_difference d = {0};
    bool right = false;
    while (!right && gn_clock_monotonic_ns() < until_ns) {
        gn_picture_finish(&now);
        now = (struct gn_picture){0};
        usleep(30000);
        if (!gn_xserver_grab(window_server, s->window, &now)) continue;
        right = now.width_px == expected->width_px && is_like(&now, expected, &d) != differ;
    }
    if (right)
        printf("%s: %.4f %% of the pixels apart, at most %.4f\n", name, 100 * d.share, d.max);
    else if (now.data && !differ)
        gn_compare_save(NULL, name, &now, expected);
    gn_picture_finish(&now);
    if (!right) fail_msg("%s: %.3f %% of the pixels apart", name, 100 * d.share);
}

void window_render(struct gn_picture *picture, const char *size, const char *option,
                   const char *value) {
    const char *args[] = {"--size", size, "--no-animation", option, value, NULL};
    struct gn_err err = {0};
    if (!gn_shot(picture, NULL, &err, "png", window_scene, args)) fail_msg("%s", err.text);
}

void window_assert_becomes_render(struct window_shown *s, const char *size, const char *name) {
    struct gn_picture expected = {0};
    window_render(&expected, size, NULL, NULL);
    window_assert_becomes(s, &expected, false, name);
    gn_picture_finish(&expected);
}
