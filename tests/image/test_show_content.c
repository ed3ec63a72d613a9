/* What gnomon take keeps, in a kiosk that runs: a turn of its link is seen at any time, and content
 * that is refused is not tried over and over. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "unit/folder.h"
#include "unit/show_help.h"

static const int64_t PATIENCE_NS = 60 * GN_NS_PER_S;

static char top[32], flag[48];

static void write_config(const char *path, const char *config) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(config, file);
    assert_int_equal(fclose(file), 0);
}

static void add_version(const char *name, const char *config) {
    char path[64];
    snprintf(path, sizeof path, "%s/%s", top, name);
    assert_int_equal(mkdir(path, 0700), 0);
    snprintf(path, sizeof path, "%s/%s/kiosk.ini", top, name);
    write_config(path, config);
}

static void turn(const char *name) {
    char fresh[64], link[64];
    snprintf(fresh, sizeof fresh, "%s/fresh", top);
    snprintf(link, sizeof link, "%s/current", top);
    assert_int_equal(symlink(name, fresh), 0);
    assert_int_equal(rename(fresh, link), 0);
}

static int setup(void **state) {
    (void)state;
    snprintf(top, sizeof top, "/tmp/gn-show-content.XXXXXX");
    if (!mkdtemp(top)) return -1;
    snprintf(flag, sizeof flag, "--content=%s", top);
    add_version("a", "[kiosk]\ncaptions = no\n[mode \"A\"]\nshadow = none\n");
    add_version("b", "[kiosk]\ncaptions = no\n[mode \"B\"]\nshadow = none\n");
    add_version("bad", "[kiosk]\ncaptions = what\n");
    turn("a");
    return 0;
}

static int teardown(void **state) {
    (void)state;
    return gn_test_remove_folder(top);
}

#define ARGUMENTS ((const char *const[]){"--size", "64x64", flag, NULL})

static void until_mode_is(struct gn_show *show, const char *name) {
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (strcmp(show->modes.names[show->screen.drawn.mode], name) != 0) {
        if (gn_clock_monotonic_ns() - begun_ns > PATIENCE_NS)
            fail_msg("the mode is %s", show->modes.names[show->screen.drawn.mode]);
        help_show_step(show);
    }
}

static void a_turn_is_seen(void **state) {
    (void)state;
    struct gn_show *show = help_show(ARGUMENTS);
    until_mode_is(show, "A");
    turn("b");
    until_mode_is(show, "B");
    turn("a");
    until_mode_is(show, "A");
    gn_show_close(show);
}

/* While the reload loads that brings `content`, the link is not watched yet. */
static void a_turn_before_it_is_watched_is_seen(void **state) {
    (void)state;
    char path[64], config[128];
    snprintf(path, sizeof path, "%s/own.ini", top);
    write_config(path, "[kiosk]\ncaptions = no\n[mode \"Own\"]\nshadow = none\n");
    struct gn_show *show = help_show((const char *const[]){"--size", "64x64", "-c", path, NULL});
    until_mode_is(show, "Own");
    snprintf(config, sizeof config, "[kiosk]\ncontent = %s\n", top);
    write_config(path, config);
    show->wants_reload = true;
    while (!show->reload.options) help_show_step(show);
    turn("b");
    until_mode_is(show, "B");
    gn_show_close(show);
}

static void what_is_refused_is_tried_again_when_it_changes(void **state) {
    (void)state;
    struct gn_show *show = help_show(ARGUMENTS);
    until_mode_is(show, "A");
    turn("bad");
    const int64_t begun_ns = gn_clock_monotonic_ns();
    while (!gn_problem_last(&show->problems)) {
        assert_true(gn_clock_monotonic_ns() - begun_ns < PATIENCE_NS);
        help_show_step(show);
    }
    assert_non_null(strstr(gn_problem_last(&show->problems), "captions"));
    gn_parts_loaded(&show->parts, GN_PART_LOAD_SCENE);
    gn_parts_look(&show->parts);
    assert_null(show->reload.options); /* none has begun */
    assert_string_equal(show->modes.names[show->screen.drawn.mode], "A");
    turn("b");
    until_mode_is(show, "B");
    assert_null(gn_problem_last(&show->problems));
    gn_show_close(show);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(a_turn_is_seen),
        TEST(a_turn_before_it_is_watched_is_seen),
        TEST(what_is_refused_is_tried_again_when_it_changes),
    };
    return RUN(tests);
}
