/* Hours of the kiosk on a fake clock: idle timeouts, captions and the information page come at
 * their time, and nothing is drawn in between. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>

#include "caption/fade.h"
#include "core/clock.h"
#include "kiosk/private.h"
#include "kiosk/shift.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

#define SECONDS(n) ((n)*GN_NS_PER_S)
#define FRAME_NS   (GN_NS_PER_S / 30) /* two of the headless screen's: when a time is seen */

static int64_t clock_ns;

static struct gn_show *open_show(const char *config) {
    struct gn_show *show = help_show_of(config, (const char *const[]){"--no-animation", NULL});
    clock_ns = gn_clock_monotonic_ns();
    gn_loop_fake_clock(show->loop, &clock_ns);
    return show;
}

/* Returns the number of steps. */
static int run_until(struct gn_show *show, int64_t until_ns) {
    struct gn_timer end = {.due_ns = until_ns};
    struct gn_err err = {0};
    int steps = 0;
    gn_loop_add_timer(show->loop, &end);
    for (; clock_ns < until_ns; steps++) {
        if (!gn_show_step(show, &err)) fail_msg("%s", err.text);
        assert_true(steps < 10000); /* or time stands still */
    }
    gn_loop_remove_timer(&end);
    return steps;
}

static void act(struct gn_show *show, enum gn_action_kind kind) {
    gn_show_act(&show->screen, &(struct gn_action){.kind = kind}, clock_ns);
}

static void idle_ends_the_page_at_its_time_and_then_nothing_is_drawn(void **state) {
    (void)state;
    struct gn_show *show = open_show("[kiosk]\nidle = first\nidle_after = 60\n"
                                     "[mode \"a\"]\nshadow = hard\n");
    run_until(show, clock_ns + SECONDS(20)); /* all programs are made */
    const int64_t begun_ns = clock_ns;
    uint64_t before = show->counts.frames;
    act(show, GN_ACTION_INFO);
    run_until(show, begun_ns + SECONDS(60) - FRAME_NS);
    assert_true(show->screen.drawn.info);
    /* the page is updated once a second, after it has risen */
    const int rise = 2 * GN_CAPTION_RISE_NS / FRAME_NS, fall = 2 * GN_CAPTION_FALL_NS / FRAME_NS;
    assert_in_range(show->counts.frames - before, 59 + rise - 1, 62 + rise);
    before = show->counts.frames;
    run_until(show, begun_ns + SECONDS(60) + FRAME_NS);
    assert_false(show->screen.drawn.info);
    run_until(show, begun_ns + SECONDS(60) + GN_CAPTION_FALL_NS + 2 * FRAME_NS);
    assert_in_range(show->counts.frames - before, fall - 1, fall + 3);
    before = show->counts.frames;
    const int steps = run_until(show, begun_ns + SECONDS(8 * 3600));
    assert_int_equal(show->counts.frames, before);
    assert_in_range(steps, 8 * 60 - 1, 2 * 8 * 60); /* one at each idle timeout, at most two */

    /* the next action is seen at once */
    const int64_t acted_ns = clock_ns;
    act(show, GN_ACTION_INFO);
    run_until(show, acted_ns + FRAME_NS);
    assert_true(show->screen.drawn.info);
    gn_show_close(show);
}

static void a_kiosk_of_two_modes_keeps_its_times_for_hours(void **state) {
    (void)state;
    enum { CHANGES = 8 * 60 };
    struct gn_show *show = open_show("[kiosk]\nidle = next\nidle_after = 60\ncaptions = "
                                     "no\n[render]\nlimit = ahead_percent=100000\n"
                                     "[mode \"a\"]\nshadow = hard\n[mode \"b\"]\nshadow = none\n");
    run_until(show, clock_ns + SECONDS(20));
    const int64_t begun_ns = show->screen.kiosk.used_ns;
    const uint64_t before = show->counts.frames;
    const unsigned long allocations = show->counts.allocations;
    assert_int_equal(show->screen.drawn.mode, 0);
    for (int i = 1; i <= CHANGES; i++) {
        run_until(show, begun_ns + i * SECONDS(60) - 1);
        assert_int_equal(show->screen.drawn.mode, (i - 1) % 2);
        run_until(show, begun_ns + i * SECONDS(60) + FRAME_NS);
        assert_int_equal(show->screen.drawn.mode, i % 2);
    }
    assert_int_equal(show->counts.frames - before, CHANGES);
    assert_int_equal(show->counts.allocations, allocations);
    gn_show_close(show);
}

static void read_picture(struct gn_show *show, uint8_t out[4 * 64 * 64]) {
    struct gn_err err = {0};
    if (!gn_gl_read_rgba8(show->screen.stage.gl, out, &err)) fail_msg("%s", err.text);
}

/* How many of the pixels differ where the second picture is the first one moved to the right and
 * up; rows are from the top. Each is rasterized anew, so by two codes they may. */
static int moved_wrongly(const uint8_t *first, const uint8_t *second, const int by_px[2]) {
    int wrong = 0;
    for (int y = 8; y < 56; y++)
        for (int x = 8; x < 56; x++)
            for (int k = 0, is_wrong = 0; k < 3; k++) {
                const int was = first[4 * (64 * (y + by_px[1]) + x - by_px[0]) + k];
                is_wrong |= abs(was - second[4 * (64 * y + x) + k]) > 2;
                wrong += k == 2 && is_wrong;
            }
    return wrong;
}

static void against_burn_in_the_picture_wanders(void **state) {
    (void)state;
    static uint8_t first[4 * 64 * 64], now[4 * 64 * 64];
    /* the field of the default scene is seen at a grazing angle, where a moved picture has other
     * mipmaps */
    char *yard = realpath("assets/bench/yard.glb", NULL), config[4200];
    assert_non_null(yard);
    snprintf(config, sizeof config,
             "[scene]\nfile = %s\n[display]\npixel_shift = 2\n[kiosk]\ncaptions = no\n"
             "[render]\nshadow = none\n",
             yard);
    free(yard);
    struct gn_show *show = open_show(config);
    show->counts.begun_ns = clock_ns;
    run_until(show, clock_ns + SECONDS(50)); /* all programs are made */
    read_picture(show, first);
    const int64_t begun_ns = show->counts.begun_ns;
    const uint64_t before = show->counts.frames;
    for (int minute = 1; minute <= 20; minute++) {
        int by_px[2];
        run_until(show, begun_ns + SECONDS(60 * minute + 30));
        assert_int_equal(show->counts.frames - before, minute); /* and nothing else is drawn */
        gn_shift_at(minute, 2, by_px);
        read_picture(show, now);
        const int wrong = moved_wrongly(first, now, by_px);
        if (wrong > 40) fail_msg("minute %d: %d pixels are not as they were", minute, wrong);
    }
    gn_show_close(show);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(idle_ends_the_page_at_its_time_and_then_nothing_is_drawn),
        cmocka_unit_test(a_kiosk_of_two_modes_keeps_its_times_for_hours),
        cmocka_unit_test(against_burn_in_the_picture_wanders),
    };
    return RUN(tests);
}
