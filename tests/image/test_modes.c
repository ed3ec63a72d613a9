/* The kiosk's modes and scenes, told what to do from here: what is warm is shown at once and makes
 * nothing, what is not keeps the old picture, and a bad scene changes nothing. */
#include "unit/check.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/text.h"
#include "gl/private.h"
#include "kiosk/private.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

enum { SIDE = 64, PIXELS = SIDE * SIDE };
#define PATIENCE_NS (60 * GN_NS_PER_S)

#define OPEN(...)                                                                                  \
    help_show((const char *const[]){"--size", "64x64", "--limit", "ahead_percent=100000",          \
                                    __VA_ARGS__, NULL})

/* ---- modes ---- */

static uint64_t map_bytes(const struct gn_show *show) {
    uint64_t bytes = 0;
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) bytes += show->screen.stage.gl->targets.maps[i].bytes;
    return bytes;
}

static void one_program_a_frame_is_made_ahead_and_no_more(void **state) {
    (void)state;
    struct gn_show *show = OPEN("--no-animation", "--turntable", "10");
    help_show_all_modes(show);
    help_show_frames(show, 1);
    const uint64_t shown_bytes = map_bytes(show);
    assert_true(shown_bytes > 1000000);
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    unsigned busy = 0;
    while (gn_show_has_work(&show->screen)) {
        const uint64_t made = show->screen.stage.gl->programs.made,
                       proofs = show->screen.stage.gl->probed;
        const uint64_t before = show->counts.frames;
        help_show_step(show);
        assert_true(show->counts.frames - before <= 1);
        if (proofs == show->screen.stage.gl->probed)
            assert_true(show->screen.stage.gl->programs.made - made <= 1);
        busy += show->screen.stage.gl->programs.made > made;
        assert_true(gn_clock_process_cpu_ns() - begun_ns < 3 * PATIENCE_NS);
    }
    assert_true(busy >= 8); /* there was something to do at all */
    /* no maps of other modes; as the camera turns, those shown get pages */
    assert_true(map_bytes(show) <= 2 * shown_bytes);
    assert_int_equal(show->screen.looks.ready, (1u << show->modes.count) - 1);
    gn_show_close(show);
}

static void a_switch_is_seen_in_the_next_frame_and_makes_nothing(void **state) {
    (void)state;
    const bool full = getenv("GN_FULL");
    const int switches = full ? 1000 : 120, ahead = full ? 240 : 120;
    struct gn_show *show = OPEN("--turntable", "240");
    help_show_all_modes(show);
    help_show_until_warm(show);
    size_t most = 0, least = SIZE_MAX;
    for (int i = 0; i < ahead; i++) { /* from all sides: lists have grown, and maps have pages */
        help_show_act(show, GN_ACTION_NEXT);
        help_show_frames(show, 1);
        const size_t now = mallinfo2().uordblks;
        most = now > most ? now : most;
    }
    const uint64_t objects = gn_gl_stats(show->screen.stage.gl).objects_created,
                   made = show->screen.stage.gl->programs.made;
    const unsigned long allocations = gn_alloc_count();
    for (int i = 0; i < switches; i++) {
        const int next = (show->screen.kiosk.shown.mode + 1) % show->modes.count;
        help_show_act(show, GN_ACTION_NEXT);
        help_show_frames(show, 1);
        assert_int_equal(show->screen.drawn.mode, next);
        const struct gn_light_opts *any = &show->screen.stage.shown.opts.shadow.any;
        assert_string_equal(
            show->modes.names[next],
            gn_techniques[GN_LIGHT_HAS(any, technique) ? any->technique : GN_TECHNIQUE_PCF].name);
        const size_t now = mallinfo2().uordblks;
        if (i >= switches / 2 && now < least) least = now;
    }
    assert_int_equal(gn_gl_stats(show->screen.stage.gl).objects_created, objects);
    assert_int_equal(show->screen.stage.gl->programs.made, made);
    assert_int_equal(gn_alloc_count(), allocations);
    /* A software driver's scratch, megabytes of it, comes and goes; what is lost stays. */
    if (least > most) fail_msg("%zu bytes more", least - most);
    gn_show_close(show);
}

static void what_is_not_ready_keeps_the_old_picture(void **state) {
    (void)state;
    struct gn_show *show = OPEN("--turntable", "10");
    help_show_frames(show, 1);
    help_show_act(show, GN_ACTION_PREV); /* the last of the list: not made yet */
    const int wanted = show->screen.kiosk.wanted.mode;
    assert_int_equal(show->screen.looks.ready >> wanted & 1, 0);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (show->screen.drawn.mode != wanted) {
        const uint64_t made = show->screen.stage.gl->programs.made;
        /* while frames are slow, work takes turns with them */
        const bool was_ready = show->screen.looks.ready >> wanted & 1 && !show->screen.ahead.alone;
        help_show_step(show);
        if (was_ready) assert_int_equal(show->screen.drawn.mode, wanted);
        if (show->screen.drawn.mode == wanted) /* nothing of it was left to be made for its frame */
            assert_true(show->screen.stage.gl->programs.made - made <= 1);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    gn_show_close(show);
}

/* The loop sleeps while nothing moves: it must not sleep over what it was waiting for. */
static void a_still_picture_changes_when_the_mode_is_ready(void **state) {
    (void)state;
    struct gn_show *show = OPEN("--no-animation");
    help_show_frames(show, 1);
    help_show_act(show, GN_ACTION_PREV);
    const int wanted = show->screen.kiosk.wanted.mode;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (show->screen.drawn.mode != wanted) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    gn_show_close(show);
}

/* The names on the screen of what a kiosk without modes goes through, until it is back. */
static void list_round(struct gn_show *show, char *out, size_t size) {
    const int first = show->screen.kiosk.shown.mode;
    *out = 0;
    do {
        help_show_act(show, GN_ACTION_NEXT);
        const int mode = show->screen.kiosk.wanted.mode;
        gn_text_add(out, size, "%s%s", *out ? ", " : "", show->modes.titles[mode]);
    } while (show->screen.kiosk.wanted.mode != first);
}

/* All others are there for ctl, and their programs are made when they are wanted. */
static void visitors_go_through_three_modes(void **state) {
    (void)state;
    char round[400];
    struct gn_show *show = OPEN("--no-animation");
    list_round(show, round, sizeof round);
    assert_string_equal(round, "Soft shadows, No shadows, Sharp shadows");
    help_show_until_warm(show);
    assert_int_equal(show->screen.looks.ready,
                     ~show->modes.passed_by & ((1u << show->modes.count) - 1));
    const int msm = gn_show_find_mode(&show->modes, "msm");
    assert_true(msm >= 0 && show->modes.passed_by >> msm & 1);
    struct gn_action to = {.kind = GN_ACTION_MODE, .name = "msm"};
    gn_show_act(&show->screen, &to, 0);
    for (int i = 0; i < 1000 && show->screen.kiosk.shown.mode != msm; i++) help_show_step(show);
    assert_int_equal(show->screen.kiosk.shown.mode, msm);
    gn_show_close(show);
    show = OPEN("--mode", "pcss"); /* who knows one may want others */
    list_round(show, round, sizeof round);
    assert_non_null(strstr(round, "Smooth shadows"));
    gn_show_close(show);
}

static void flags_leave_one_technique(void **state) {
    (void)state;
    struct gn_show *show = OPEN("--shadow", "hard");
    assert_int_equal(show->modes.count, 1);
    help_show_act(show, GN_ACTION_NEXT);
    help_show_frames(show, 2);
    assert_int_equal(show->screen.kiosk.shown.mode, 0);
    gn_show_close(show);
}

static void the_page_names_the_scene_inside_the_program(void **state) {
    (void)state;
    struct gn_show *show = OPEN("--shadow", "hard");
    help_show_frames(show, 1);
    help_show_act(show, GN_ACTION_INFO);
    help_show_frames(show, 1);
    if (!strstr(show->screen.text.page.text, "\nScene\tSundial\n"))
        fail_msg("%s", show->screen.text.page.text);
    gn_show_close(show);
}

/* ---- pause, blank, fade ---- */

static void pause_stands_and_blank_is_dark(void **state) {
    (void)state;
    uint8_t before[4 * PIXELS], after[4 * PIXELS];
    struct gn_show *show = OPEN("--shadow", "pcf", "--turntable", "90");
    help_show_until_warm(show);
    help_show_frames(show, 2);
    help_show_act(show, GN_ACTION_PAUSE);
    help_show_step(show);
    const int64_t stood_ns = show->screen.drawn.time_ns;
    while (help_show_changes(show)) help_show_step(show);
    assert_int_equal(show->screen.drawn.time_ns, stood_ns);
    help_show_picture(show, before);
    help_show_act(show, GN_ACTION_BLANK);
    help_show_step(show);
    assert_true(show->screen.stage.display.screen.blank);
    assert_false(gn_show_wants_frame(&show->screen));
    const uint64_t dark = show->counts.frames;
    help_show_act(show, GN_ACTION_NEXT_CAMERA); /* lights it, and no more */
    help_show_step(show);
    assert_false(show->screen.stage.display.screen.blank);
    assert_int_equal(show->screen.kiosk.camera, 0);
    assert_true(show->counts.frames - dark <= 1);
    help_show_picture(show, after);
    assert_memory_equal(before, after, sizeof before);
    gn_show_close(show);
}

static void a_fade_begins_with_the_old_picture(void **state) {
    (void)state;
    static uint8_t old[4 * PIXELS], first[4 * PIXELS], none[4 * PIXELS];
    const char *folder = help_folder();
    char path[200];
    help_write(folder, "x/kiosk.ini",
               "[mode \"With\"]\nshadow = pcf\n[mode \"Without\"]\nshadow = none\n"
               "[kiosk]\ncaptions = no\n");
    snprintf(path, sizeof path, "%s/x/kiosk.ini", folder);
    struct gn_show *show = OPEN("--no-animation", "--fade", "10", "-c", path);
    assert_int_equal(show->modes.count, 2);
    help_show_until_warm(show);
    help_show_picture(show, old);
    help_show_act(show, GN_ACTION_NEXT); /* no shadows at all */
    while (show->screen.drawn.mode == show->modes.first) help_show_step(show);
    help_show_picture(show, first);
    unsigned worst = 0, all = 0;
    show->screen.rules.fade_ns = 0; /* over */
    show->screen.kiosk.fade_begun_ns = 0;
    show->screen.changed = true;
    help_show_frames(show, 1);
    help_show_picture(show, none);
    for (int i = 0; i < 4 * PIXELS; i++) {
        const unsigned d = (unsigned)abs(first[i] - old[i]), e = (unsigned)abs(none[i] - old[i]);
        worst = d > worst ? d : worst;
        all = e > all ? e : all;
    }
    if (worst > 8) fail_msg("a fade's first frame differs by %u", worst);
    assert_true(all > 40); /* they do differ */
    gn_show_close(show);
    help_remove(folder);
}

/* ---- scenes ---- */

static void the_next_scene_comes_when_it_is_whole(void **state) {
    (void)state;
    struct gn_show *show =
        OPEN("assets/bench/s1.glb", "assets/sundial.glb", "--shadow", "pcf", "--turntable", "10");
    help_show_until_warm(show);
    const char *name = show->screen.stage.scene->name;
    help_show_act(show, GN_ACTION_NEXT_SCENE);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (show->screen.drawn.scene == 0) {
        const uint64_t made = show->screen.stage.gl->programs.made;
        help_show_step(show);
        if (show->screen.drawn.scene != 0) /* nothing of it was left to be made for its frame */
            assert_true(show->screen.stage.gl->programs.made - made <= 1);
        if (show->screen.scene == 0) assert_ptr_equal(show->screen.stage.scene->name, name);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_null(show->screen.staged.loaded);
    assert_int_equal(show->screen.stage.scene->triangle_count > 0, 1);
    help_show_until_warm(show);
    help_show_act(show, GN_ACTION_NEXT_SCENE); /* and back */
    while (show->screen.drawn.scene == 1) help_show_step(show);
    gn_show_close(show);
}

static void a_bad_scene_changes_nothing(void **state) {
    (void)state;
    const char *folder = help_folder();
    char path[200];
    help_write(folder, "x/bad.glb", "this is no scene");
    snprintf(path, sizeof path, "%s/x/bad.glb", folder);
    struct gn_show *show =
        OPEN("assets/bench/s1.glb", path, "--shadow", "pcf", "--turntable", "10");
    help_show_frames(show, 2);
    help_show_act(show, GN_ACTION_NEXT_SCENE);
    assert_true(gn_kiosk_waits(&show->screen.kiosk));
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (gn_kiosk_waits(&show->screen.kiosk)) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
    }
    assert_int_equal(show->screen.drawn.scene, 0);
    assert_non_null(strstr(gn_problem_last(&show->problems), "bad.glb"));
    /* one that is dropped is no error of the settings */
    gn_show_load_file(show, path);
    while (!show->problems.of[GN_PROBLEM_FIRST][0]) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < 2 * PATIENCE_NS);
    }
    assert_string_equal(show->problems.of[GN_PROBLEM_CONFIG], "");
    /* what is asked for again is named, and not what went wrong meanwhile */
    gn_problem_report(&show->problems, GN_PROBLEM_THROTTLED, "throttled");
    assert_int_equal(gn_problem_last_kind(&show->problems), GN_PROBLEM_THROTTLED);
    help_show_act(show, GN_ACTION_NEXT_SCENE);
    assert_true(gn_kiosk_waits(&show->screen.kiosk));
    while (gn_kiosk_waits(&show->screen.kiosk)) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < 3 * PATIENCE_NS);
    }
    assert_int_equal(gn_problem_last_kind(&show->problems), GN_PROBLEM_SCENE);
    gn_show_load_file(show, path);
    while (gn_problem_last_kind(&show->problems) != GN_PROBLEM_FIRST) {
        help_show_step(show);
        assert_true(gn_clock_monotonic_ns() - begun_ns < 4 * PATIENCE_NS);
    }
    help_show_frames(show, 2);
    gn_show_close(show);
    help_remove(folder);
}

static void the_end_does_not_wait_for_a_scene(void **state) {
    (void)state;
    struct gn_show *show = OPEN("assets/bench/s1.glb", "assets/bench/s2.glb", "--shadow", "pcf");
    help_show_frames(show, 1);
    help_show_act(show, GN_ACTION_NEXT_SCENE);
    help_show_step(show);
    assert_true(gn_loader_is_busy(show->scenes.loader) || show->screen.staged.loaded);
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    gn_show_close(show);
    assert_true(gn_clock_process_cpu_ns() - begun_ns < 2 * GN_NS_PER_S);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_program_a_frame_is_made_ahead_and_no_more),
        cmocka_unit_test(a_switch_is_seen_in_the_next_frame_and_makes_nothing),
        cmocka_unit_test(what_is_not_ready_keeps_the_old_picture),
        cmocka_unit_test(a_still_picture_changes_when_the_mode_is_ready),
        cmocka_unit_test(visitors_go_through_three_modes),
        cmocka_unit_test(flags_leave_one_technique),
        cmocka_unit_test(the_page_names_the_scene_inside_the_program),
        cmocka_unit_test(pause_stands_and_blank_is_dark),
        cmocka_unit_test(a_fade_begins_with_the_old_picture),
        cmocka_unit_test(the_next_scene_comes_when_it_is_whole),
        cmocka_unit_test(a_bad_scene_changes_nothing),
        cmocka_unit_test(the_end_does_not_wait_for_a_scene),
    };
    return RUN(tests);
}
