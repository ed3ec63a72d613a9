/* A kiosk whose scene stands: its soft shadows converge to truth, unseen, and go back when
 * something moves. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "core/memory.h"
#include "gl/private.h"
#include "image/fine.h"
#include "kiosk/private.h"
#include "unit/check.h"
#include "unit/show_help.h"

#define PATIENCE_NS (240 * GN_NS_PER_S)
enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static char *paths[GN_FINE_SCENES];
static const char *names[GN_FINE_SCENES];

static const char *path_of(int scene) {
    struct gn_err err = {0};
    if (!paths[scene]) paths[scene] = gn_fine_write(scene, &names[scene], &err);
    if (!paths[scene]) fail_msg("%s", err.text);
    return paths[scene];
}

/* What is brighter than a screen shows is cut after the mean: here nothing is. */
static const char *const exposures[GN_FINE_SCENES] = {"-1", "-2", "-3"};

static struct gn_show *open_kiosk(int scene, const char *technique, const char *gather) {
    struct gn_show *show = help_show((const char *const[]){"--size",        "96x72",
                                                           "--tone",        "none",
                                                           "--floor",       "none",
                                                           "--environment", "none",
                                                           "--turntable",   "0",
                                                           "--msaa",        "4",
                                                           "--exposure",    exposures[scene],
                                                           "--shadow",      technique,
                                                           "--gather",      gather,
                                                           path_of(scene),  NULL});
    while (show->counts.frames == 0) help_show_step(show);
    return show;
}

/* The largest difference between two pictures. */
static int step_of(const uint8_t *a, const uint8_t *b) {
    int most = 0;
    for (int i = 0; i < 4 * PIXELS; i++)
        if (abs(a[i] - b[i]) > most) most = abs(a[i] - b[i]);
    return most;
}

/* Until the mean has that share; *step: the largest between frames, all of which are read. */
static void wait_for(struct gn_show *show, float share, uint8_t *picture, int *step) {
    const struct gn_show_still *still = &show->screen.still;
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_NS;
    static uint8_t next[4 * PIXELS];
    uint64_t frames = show->counts.frames;
    *step = 0;
    while (still->share != share || !show->screen.stage.display.screen.may_draw ||
           gn_show_wants_frame(&show->screen)) {
        help_show_step(show);
        if (gn_clock_monotonic_ns() > until_ns)
            fail_msg("%u points, share %.2f", still->points, (double)still->share);
        if (show->counts.frames == frames) continue;
        frames = show->counts.frames;
        help_show_picture(show, next);
        const int changed = step_of(picture, next);
        if (changed > *step) *step = changed;
        memcpy(picture, next, sizeof next);
    }
}

/* So many milliseconds, however many steps those are. */
static void wait_ms(struct gn_show *show, int ms) {
    const int64_t until_ns = gn_clock_monotonic_ns() + (int64_t)ms * 1000000;
    const struct timespec little = {.tv_nsec = 5000000};
    while (gn_clock_monotonic_ns() < until_ns) {
        if (gn_show_screen_due_ns(&show->screen) <= gn_clock_monotonic_ns()) help_show_step(show);
        nanosleep(&little, NULL);
    }
}

/* Root of the mean square to rays, as encoded. */
static double error_of(const uint8_t *picture, const float *truth) {
    double sum = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double d = (double)picture[4 * i + 1] / 255 - (double)truth[i];
        sum += d * d;
    }
    return sqrt(sum / PIXELS);
}

static void soft_shadows_converge_to_truth(void **state) {
    static const struct {
        int scene;
        const char *technique;
    } rows[] = {
        {GN_FINE_SUN, "cone"},
        {GN_FINE_SPOT, "cone"},
        {GN_FINE_POINT, "cone"},
        {GN_FINE_SPOT, "pcss"},
    };
    static uint8_t picture[4 * PIXELS];
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        static float truth[PIXELS];
        struct gn_err err = {0};
        int step;
        if (!gn_fine_truth(path_of(rows[i].scene), exposures[rows[i].scene], WIDTH, HEIGHT, truth,
                           &err))
            fail_msg("%s", err.text);
        struct gn_show *show = open_kiosk(rows[i].scene, rows[i].technique, "auto");
        help_show_picture(show, picture);
        const double before = error_of(picture, truth);
        wait_for(show, 1, picture, &step);
        const double after = error_of(picture, truth);
        printf("%s, %s: %.4f -> %.4f of rays, largest step between frames %d of 255\n",
               names[rows[i].scene], rows[i].technique, before, after, step);
        assert_true(after < 0.65 * before && after < .005);
        assert_true(step <= 2);

        assert_int_equal(show->counts.objects, 0);
        assert_int_equal(show->counts.allocations, 0);
        gn_show_close(show);
    }
}

static void what_moves_is_the_techniques(void **state) {
    static uint8_t first[4 * PIXELS], picture[4 * PIXELS], again[4 * PIXELS];
    int step;
    (void)state;
    struct gn_show *show = open_kiosk(GN_FINE_SPOT, "cone", "auto");
    struct gn_show_screen *s = &show->screen;
    help_show_picture(show, first);
    memcpy(picture, first, sizeof first);
    wait_for(show, 1, picture, &step);
    assert_true(step_of(picture, first) > 3);
    const uint64_t frames = show->counts.frames;
    wait_ms(show, 500); /* converged: nothing is drawn, and nothing gathered */
    assert_int_equal(show->counts.frames, frames);

    s->stage.shown.opts.view.orbit.yaw_rad = 1e-4f; /* a motion that changes no pixel by itself */
    s->changed = true;
    wait_for(show, 0, picture, &step);
    assert_true(step <= 8); /* it goes in fewer frames than it came */
    assert_true(step_of(picture, first) <= 1);
    assert_null(s->still.view.builder); /* its maps are freed */
    wait_for(show, 1, picture, &step);
    memcpy(again, picture, sizeof again);

    s->stage.display.screen.generation++; /* a lost context */
    while (s->still.share > 0) help_show_step(show);
    wait_for(show, 1, picture, &step);
    assert_true(step_of(picture, again) <= 1);
    gn_show_close(show);
}

static void hard_shadows_stay(void **state) {
    static const char *const rows[][2] = {{"hard", "auto"}, {"pcf", "auto"}, {"cone", "none"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct gn_show *show = open_kiosk(GN_FINE_SPOT, rows[i][0], rows[i][1]);
        wait_ms(show, 1500);
        assert_int_equal(show->screen.still.points, 0);
        assert_true(gn_still_due_ns(&show->screen) == INT64_MAX);
        gn_show_close(show);
    }
    const uint64_t whole_mb = gn_memory_total_mb();
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_NS;
    struct gn_show *show = open_kiosk(GN_FINE_SPOT, "cone", "auto");
    gn_memory_pretend_mb(2); /* no room for means */
    while (!show->screen.still.never && gn_clock_monotonic_ns() < until_ns) wait_ms(show, 100);
    assert_true(show->screen.still.never);
    assert_int_equal(show->screen.still.points, 0);
    gn_show_close(show);
    gn_memory_pretend_mb(whole_mb);
}

/* Likewise at once, in a file. */
static void pictures_of_files_are_gathered(void **state) {
    static const struct {
        int scene;
        const char *technique;
    } rows[] = {{GN_FINE_SUN, "cone"}, {GN_FINE_POINT, "cone"}, {GN_FINE_SPOT, "pcss"}};
    static float truth[PIXELS], shot[PIXELS];
    static const char *const gathers[] = {"auto", "always"};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *path = path_of(rows[i].scene), *exposure = exposures[rows[i].scene];
        double error[2] = {0};
        struct gn_err err = {0};
        if (!gn_fine_truth(path, exposure, WIDTH, HEIGHT, truth, &err)) fail_msg("%s", err.text);
        for (int k = 0; k < 2; k++) {
            const char *const args[] = {"--size",     "96x72",  "--backend", "egl",
                                        "--msaa",     "4",      "--shadow",  rows[i].technique,
                                        "--exposure", exposure, "--gather",  gathers[k],
                                        NULL};
            if (!gn_fine_shot(path, args, shot, &err)) fail_msg("%s", err.text);
            for (int p = 0; p < PIXELS; p++)
                error[k] += pow((double)shot[p] - (double)truth[p], 2) / PIXELS;
        }
        printf("%s, %s in a file: %.4f -> %.4f of rays\n", names[rows[i].scene], rows[i].technique,
               sqrt(error[0]), sqrt(error[1]));
        assert_true(sqrt(error[1]) < 0.65 * sqrt(error[0]) && sqrt(error[1]) < .005);
    }
}

/* A mean has no alpha: the technique's picture stays. */
static void a_transparent_picture_is_not_gathered(void **state) {
    static float shots[2][PIXELS];
    static const char *const gathers[] = {"none", "always"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct gn_err err = {0};
        const char *const args[] = {"--size",       "96x72",       "--backend", "egl",
                                    "--background", "transparent", "--shadow",  "cone",
                                    "--gather",     gathers[k],    NULL};
        if (!gn_fine_shot(path_of(GN_FINE_SUN), args, shots[k], &err)) fail_msg("%s", err.text);
    }
    assert_memory_equal(shots[0], shots[1], sizeof *shots);
}

static int end(void **state) {
    (void)state;
    for (int i = 0; i < GN_FINE_SCENES; i++) free(paths[i]);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soft_shadows_converge_to_truth),
        cmocka_unit_test(what_moves_is_the_techniques),
        cmocka_unit_test(hard_shadows_stay),
        cmocka_unit_test(pictures_of_files_are_gathered),
        cmocka_unit_test(a_transparent_picture_is_not_gathered),
    };
    return cmocka_run_group_tests(tests, NULL, end);
}
