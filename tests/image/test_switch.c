/* What a change of the mode costs: time, and the memory of the programs that are made ahead of it.
 * A process of its own, since what a driver's compiler keeps of others counts as ours. */
#include "unit/check.h"

#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/memory.h"
#include "gl/private.h"
#include "kiosk/private.h"
#include "unit/show_help.h"

enum { SIDE = 64, PIXELS = SIDE * SIDE };
#define PATIENCE_NS (60 * GN_NS_PER_S)

/* What programs of other modes take, by dropping them, of all that is taken without. */
static double share_of_idle(struct gn_show *show) {
    const double with = (double)gn_memory_allocated();
    gn_gl_drop_programs(show->screen.stage.gl, &(struct gn_gl_idle){0});
    return with / (double)gn_memory_allocated() - 1;
}

static void programs_of_other_modes_are_within_their_share(void **state) {
    (void)state;
    static uint8_t before[4 * PIXELS], after[4 * PIXELS];
    struct gn_show *show = help_show((const char *const[]){
        "--size", "64x64", "--limit", "ahead_percent=10", "--no-animation", NULL});
    gn_memory_pretend_mb(1024); /* a board */
    help_show_all_modes(show);
    help_show_until_warm(show);
    assert_int_equal(show->screen.looks.made, (1u << show->modes.count) - 1);
    assert_int_equal(show->screen.looks.ready, 1u << show->screen.kiosk.shown.mode);
    help_show_picture(show, before);
    const double ahead = share_of_idle(show);
    if (ahead > 0.1) fail_msg("%.1f %%", 100 * ahead);
    uint64_t rounds[3] = {0};
    for (int i = 0; i < 3 * show->modes.count; i++) {
        uint64_t *most = &rounds[i / show->modes.count];
        const int next = (show->screen.kiosk.shown.mode + 1) % show->modes.count;
        const int64_t begun_ns = gn_clock_process_cpu_ns();
        help_show_act(show, GN_ACTION_NEXT);
        while (show->screen.drawn.mode != next) {
            help_show_step(show);
            assert_true(gn_clock_process_cpu_ns() - begun_ns < PATIENCE_NS);
        }
        while (gn_show_has_work(&show->screen)) help_show_step(show);
        const uint64_t all = gn_memory_allocated(),
                       idle = gn_gl_idle_programs(show->screen.stage.gl).bytes,
                       share = (gn_memory_total_mb() << 20) / 16;
        assert_true(idle <= all - idle || idle <= share);
        if (all > *most) *most = all;
    }
    assert_true(rounds[2] < rounds[1] + rounds[1] / 10);
    show->screen.changed = true; /* without the caption of the last change */
    gn_captions_set(show->screen.text.captions, GN_CAPTION_MODE, NULL, 0); /* it need not fall */
    while (help_show_changes(show)) help_show_step(show);
    help_show_picture(show, after);
    assert_memory_equal(before, after, sizeof before);
    gn_memory_pretend_mb(0);
    gn_show_close(show);
}

static int by_size(const void *a, const void *b) {
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return x < y ? -1 : x > y;
}

/* CPU time of a frame, with that of the threads that draw for us. */
static int64_t frame_ns(struct gn_show *show) {
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    help_show_frames(show, 1);
    gn_gl_wait(show->screen.stage.gl);
    return gn_clock_process_cpu_ns() - begun_ns;
}

/* Of all pairs of neighbours: a switch draws its frame and, at most, its maps. Of
 * six rounds the quickest switch counts, since whatever else the machine does only adds. */
static void a_switch_takes_no_more_than_two_frames(void **state) {
    (void)state;
    enum { ROUNDS = 6 };
    struct gn_show *show = help_show((const char *const[]){
        "--size", "640x360", "--limit", "ahead_percent=100000", "--turntable", "10", NULL});
    int64_t switch_ns[GN_KIOSK_MODES_MAX], steady_ns[GN_KIOSK_MODES_MAX][ROUNDS] = {{0}};
    for (int m = 0; m < show->modes.count; m++) switch_ns[m] = INT64_MAX;
    help_show_all_modes(show);
    help_show_until_warm(show);
    for (int i = 0; i < ROUNDS * show->modes.count; i++) {
        const int round = i / show->modes.count;
        help_show_act(show, GN_ACTION_NEXT);
        const int64_t now_ns = frame_ns(show);
        const int mode = show->screen.drawn.mode;
        if (now_ns < switch_ns[mode]) switch_ns[mode] = now_ns;
        steady_ns[mode][round] = frame_ns(show);
    }
    int wrong = 0;
    for (int m = 0; m < show->modes.count; m++) {
        qsort(steady_ns[m], ROUNDS, sizeof steady_ns[m][0], by_size);
        const int64_t median_ns = steady_ns[m][ROUNDS / 2];
        print_message("%-8s %6.2f ms, then %6.2f ms\n", show->modes.names[m],
                      (double)switch_ns[m] * 1e-6, (double)median_ns * 1e-6);
        wrong += switch_ns[m] > 2 * median_ns;
    }
    assert_int_equal(wrong, 0);
    gn_show_close(show);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_of_other_modes_are_within_their_share),
        cmocka_unit_test(a_switch_takes_no_more_than_two_frames),
    };
    return RUN(tests);
}
