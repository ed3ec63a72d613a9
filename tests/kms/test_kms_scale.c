/* Frames that fill a part of the framebuffer, which the primary plane scales to the mode: where it
 * can, and what is drawn where it cannot. The picture is right in each state: the plane reads what
 * was painted. */
#include <errno.h>
#include <string.h>

#include "client.h"
#include "unit/check.h"

static struct client c;

static void begin(const struct client_kind *kind, float share) {
    client_draws(share);
    client_begin(&c, kind, SIM_FULL_HD);
}

static void end(const struct client_kind *kind) {
    client_end(&c, kind);
    client_draws(1);
}

static void expect_right(void) {
    int64_t took_ns;
    assert_true(client_settle(&c, SIM_S, &took_ns));
    c.moves = true;
}

/* So many more frames, all of them scaled by the plane, or none. */
static void expect_frames(long count, bool scaled) {
    const long frames = c.frames, before = c.scaled;
    client_frames(&c, count);
    assert_int_equal(c.frames - frames, count);
    assert_int_equal(c.scaled - before, scaled ? count : 0);
}

static const struct client_kind good = {.name = "enlarges",
                                        .traits = {.console = true, .enlarges = 250}};

static void test_all_frames_but_the_first_are_scaled(void **state) {
    (void)state;
    begin(&good, 0.75f);
    assert_int_equal(c.scaled, c.frames - 1);
    expect_right();
    expect_frames(20, true);
    assert_int_equal(client_screen(&c)->width_px, 96); /* the screen is as large as before */
    assert_int_equal(sim_counts.blinks, 1);
    end(&good);
}

static void test_one_test_finds_out(void **state) {
    (void)state;
    begin(&good, 0.75f);
    const long commits = sim_counts.calls[SIM_ModeAtomicCommit];
    expect_frames(50, true);
    assert_int_equal(sim_counts.calls[SIM_ModeAtomicCommit] - commits, 50);
    end(&good);
}

/* Texts come and go: from frame to frame, without a modeset. */
static void test_share_may_change_in_each_frame(void **state) {
    (void)state;
    begin(&good, 0.75f);
    for (int i = 0; i < 5; i++) {
        client_draws(1);
        expect_frames(2, false);
        expect_right();
        client_draws(i % 2 ? 0.5f : 0.75f);
        expect_frames(2, true);
        expect_right();
    }
    assert_int_equal(sim_counts.blinks, 1);
    end(&good);
}

static void expect_full_size(const struct client_kind *kind, float share) {
    begin(kind, share);
    expect_frames(5, false);
    assert_int_equal(c.scaled, 0);
    expect_right();
    assert_int_equal(sim_counts.blinks, 1);
    end(kind);
}

static void test_what_cannot_scale_gets_all_of_it(void **state) {
    (void)state;
    static const struct client_kind kinds[] = {
        {.name = "no scaling"},
        {.name = "legacy", .traits = {.legacy = true, .enlarges = 200}},
        {.name = "legacy by option", .traits = {.enlarges = 200}, .opts = {.legacy = true}},
        {.name = "copies", .traits = {.enlarges = 200}, .gpu = {.no_surface = {true, true, true}}},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) expect_full_size(&kinds[i], 0.75f);
}

static void test_up_to_its_factor(void **state) {
    (void)state;
    static const struct client_kind some = {.name = "by 140 %", .traits = {.enlarges = 140}};
    expect_full_size(&some, 0.5f);
    begin(&some, 0.75f);
    expect_frames(5, true);
    client_draws(0.5f);
    expect_frames(5, false);
    expect_right();
    client_draws(0.75f);
    expect_frames(5, true);
    expect_right();
    end(&some);
}

/* A test that fails for another reason is made again. */
static void test_busy_is_no_refusal(void **state) {
    (void)state;
    client_draws(1);
    client_begin(&c, &good, SIM_FULL_HD);
    client_draws(0.75f);
    sim_fail(SIM_ModeAtomicCommit, 1, 1, ENOMEM);
    client_frames(&c, 1);
    assert_int_equal(sim_counts.failed, 1);
    expect_frames(5, true);
    expect_right();
    end(&good);
}

/* One frame is lost, and drawn again; modes and buffers are not to blame. */
static void test_refused_after_the_test(void **state) {
    (void)state;
    static const struct client_kind liar = {.name = "liar",
                                            .traits = {.enlarges = 200, .enlarges_never = true}};
    begin(&liar, 0.75f);
    expect_right();
    assert_int_equal(c.scaled, 1);
    assert_int_equal(client_screen(&c)->counts.relit, 1);
    assert_int_equal(client_screen(&c)->width_px, 96);
    expect_frames(10, false);
    client_leave_console(&c); /* what refused may have been of that moment */
    client_run(&c, SIM_S);
    client_enter_console(&c);
    client_frames(&c, 3);
    assert_int_equal(c.scaled, 2);
    expect_right();
    expect_frames(10, false);
    end(&liar);
}

static void test_still_picture_stays_scaled(void **state) {
    (void)state;
    begin(&good, 0.75f);
    expect_right(); /* 12 s: it is flipped again */
    const long frames = c.frames;
    c.moves = false;
    client_run(&c, 25 * SIM_S);
    assert_int_equal(c.frames, frames);
    assert_true(sim_shows(c.colour));
    end(&good);
}

static void test_last_frame_comes_back_scaled(void **state) {
    (void)state;
    begin(&good, 0.75f);
    c.moves = false;
    client_run(&c, SIM_S);
    const uint32_t last = c.colour;
    client_blank(&c, true);
    client_run(&c, SIM_S);
    assert_true(sim_is_dark());
    client_blank(&c, false);
    assert_true(sim_shows(last));
    c.moves = true;
    expect_frames(5, true);
    end(&good);
}

static void test_console_and_monitor(void **state) {
    (void)state;
    begin(&good, 0.75f);
    client_leave_console(&c);
    client_run(&c, SIM_S);
    assert_true(sim_shows_console(0));
    client_enter_console(&c);
    client_frames(&c, 2);
    expect_frames(5, true);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_LARGE); /* of another mode */
    client_frames(&c, 2);
    expect_frames(5, true);
    assert_int_equal(client_screen(&c)->width_px, 120);
    expect_right();
    end(&good);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_frames_but_the_first_are_scaled),
        cmocka_unit_test(test_one_test_finds_out),
        cmocka_unit_test(test_share_may_change_in_each_frame),
        cmocka_unit_test(test_what_cannot_scale_gets_all_of_it),
        cmocka_unit_test(test_up_to_its_factor),
        cmocka_unit_test(test_busy_is_no_refusal),
        cmocka_unit_test(test_refused_after_the_test),
        cmocka_unit_test(test_still_picture_stays_scaled),
        cmocka_unit_test(test_last_frame_comes_back_scaled),
        cmocka_unit_test(test_console_and_monitor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
