#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/info_page.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static struct gn_screen screen;
static struct gn_caps caps;
static struct gn_info info;
static struct gn_info_page page;

static int setup(void **state) {
    (void)state;
    screen = (struct gn_screen){.what = "HDMI-A-1 1920x1080@60.00 atomic"};
    caps = (struct gn_caps){.renderer = "V3D 4.2", .version = "OpenGL ES 3.1 Mesa 22.3.6"};
    info = (struct gn_info){.scene = "sundial.glb",
                            .mode = "Soft",
                            .missing = "skins, sheen",
                            .screen = &screen,
                            .caps = &caps,
                            .root = "/nowhere"};
    page = (struct gn_info_page){0};
    return 0;
}

static bool says(const char *line) {
    char with[200], text[sizeof page.text + 1];
    snprintf(with, sizeof with, "\n%s\n", line);
    snprintf(text, sizeof text, "\n%s", page.text);
    return strstr(text, with) != NULL;
}

static void test_a_page_says_what_is_known(void **state) {
    (void)state;
    assert_true(gn_info_page_step(&page, &info, 5));
    assert_true(says("Mode\tSoft"));
    assert_true(says("Scene\tsundial.glb"));
    assert_true(says("Shown without\tskins, sheen"));
    assert_true(says("Screen\tHDMI-A-1 1920x1080@60.00 atomic"));
    assert_true(says("GPU\tV3D 4.2"));
    assert_true(says("Driver\tOpenGL ES 3.1 Mesa 22.3.6"));
    assert_non_null(strstr(page.text, "\nAddress\t"));
    assert_non_null(strstr(page.text, "\nSystem\tLinux "));
    assert_int_equal(strncmp(page.text, "Running well\nScene\t", 19), 0);
    assert_null(strstr(page.text, "Temperature"));
    assert_null(strstr(page.text, "Running for"));
}

static void test_what_the_board_suffers_from_has_a_line(void **state) {
    (void)state;
    info.board = "";
    gn_info_page_step(&page, &info, 0);
    assert_null(strstr(page.text, "Board"));
    info.board = "undervoltage now and 2 times before";
    gn_info_page_step(&page, &info, GN_NS_PER_S);
    assert_true(says("Board\tundervoltage now and 2 times before"));
}

static void test_what_is_wrong_comes_first(void **state) {
    (void)state;
    info.problem = &gn_problem_words[GN_PROBLEM_CONFIG];
    info.shown = "Line 3 of kiosk.ini: nothing.";
    gn_info_page_step(&page, &info, 0);
    assert_int_equal(strncmp(page.text, "The settings have an error\nProblem\tLine 3", 41), 0);
    assert_null(strstr(page.text, "Running well"));
    assert_non_null(strstr(page.text, "\nWhat to do\tCorrect the file; "));
}

static void test_what_is_not_known_has_no_line(void **state) {
    (void)state;
    const struct gn_info nothing = {.root = "/nowhere"};
    assert_true(gn_info_page_step(&page, &nothing, 5));
    assert_null(strstr(page.text, "Mode"));
    assert_null(strstr(page.text, "GPU"));
    assert_null(strstr(page.text, "Speed"));
}

static void test_it_is_made_once_a_second(void **state) {
    (void)state;
    assert_true(gn_info_page_step(&page, &info, 5 * GN_NS_PER_S));
    assert_false(gn_info_page_step(&page, &info, 6 * GN_NS_PER_S - 1));
    assert_true(gn_info_page_step(&page, &info, 6 * GN_NS_PER_S));
}

static void test_frames_are_those_since_the_last_time(void **state) {
    (void)state;
    screen.counts = (struct gn_screen_counts){.shown = 1000, .missed = 3};
    gn_info_page_step(&page, &info, 10 * GN_NS_PER_S);
    assert_true(says("Speed\t0.3 % late"));
    screen.counts.shown += 90;
    gn_info_page_step(&page, &info, 12 * GN_NS_PER_S);
    assert_true(says("Speed\t45 frames/s, 0.3 % late"));
    screen.counts = (struct gn_screen_counts){.shown = 7}; /* opened again */
    gn_info_page_step(&page, &info, 13 * GN_NS_PER_S);
    assert_true(says("Speed\t0.0 % late"));
}

static void test_time_goes_to_days(void **state) {
    (void)state;
    info.uptime_ns = (3 * 3600 + 25 * 60 + 7) * GN_NS_PER_S;
    gn_info_page_step(&page, &info, 0);
    assert_true(says("Running for\t03:25:07"));
    info.uptime_ns += 86400 * GN_NS_PER_S;
    page.made = false;
    gn_info_page_step(&page, &info, 0);
    assert_true(says("Running for\t1 day 03:25:07"));
    info.uptime_ns += INT64_C(399) * 86400 * GN_NS_PER_S;
    gn_info_page_step(&page, &info, GN_NS_PER_S);
    assert_true(says("Running for\t400 days 03:25:07"));
}

static void test_the_hottest_zone_counts(void **state) {
    (void)state;
    const char *root = help_folder();
    char command[300];
    snprintf(command, sizeof command,
             "cd %s && for i in 0 1 2; do mkdir -p sys/class/thermal/thermal_zone$i; done; cd "
             "sys/class/thermal; echo 41200 > thermal_zone0/temp; echo 61800 > thermal_zone1/temp; "
             "echo nonsense > thermal_zone2/temp",
             root);
    assert_int_equal(system(command), 0);
    info.root = root;
    gn_info_page_step(&page, &info, 0);
    assert_true(says("Temperature\t62 C"));
    snprintf(command, sizeof command, "rm -rf %s/sys", root);
    assert_int_equal(system(command), 0);
    help_remove(root);
}

static void test_long_texts_are_cut(void **state) {
    (void)state;
    char name[4000];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    info.scene = info.mode = name;
    gn_info_page_step(&page, &info, 0);
    assert_true(strlen(page.text) < sizeof page.text);
    assert_true(says("GPU\tV3D 4.2"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_a_page_says_what_is_known, setup),
        cmocka_unit_test_setup(test_what_the_board_suffers_from_has_a_line, setup),
        cmocka_unit_test_setup(test_what_is_wrong_comes_first, setup),
        cmocka_unit_test_setup(test_what_is_not_known_has_no_line, setup),
        cmocka_unit_test_setup(test_it_is_made_once_a_second, setup),
        cmocka_unit_test_setup(test_frames_are_those_since_the_last_time, setup),
        cmocka_unit_test_setup(test_time_goes_to_days, setup),
        cmocka_unit_test_setup(test_the_hottest_zone_counts, setup),
        cmocka_unit_test_setup(test_long_texts_are_cut, setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
