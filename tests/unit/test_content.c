/* What gnomon take keeps, laid over a configuration file. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "options/args.h"
#include "unit/cut_disk.h"

static char top[] = "/tmp/gn-test-content-XXXXXX", base[64], folder[64], flag[80];
static struct gn_options options;
static struct gn_err err;

static void write_file(const char *name, const char *text) {
    char path[80];
    snprintf(path, sizeof path, "%s/%s", top, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* `gnomon show -c base.ini`, and what else */
static struct gn_warnings warnings;
static bool read_with(const char *more) {
    warnings = (struct gn_warnings){0};
    char *argv[] = {(char *)"gnomon", (char *)"show", (char *)"-c", base, (char *)more, NULL};
    err = (struct gn_err){0};
    return gn_args_parse(&options, more ? 5 : 4, argv, &warnings, &err);
}

static void check_path(const char *path, const char *name) {
    char whole[80];
    snprintf(whole, sizeof whole, "%s/%s", top, name);
    assert_non_null(path);
    assert_string_equal(path, whole);
}

static const char machine[] = "[display]\nrotate = 90\nbackend = egl\n"
                              "[scene]\nfile = old.glb\nfile = older.glb\ncamera = Old\n"
                              "turntable = 4\n"
                              "[camera]\ntheta = 12\n[light]\nazimuth = 30\n"
                              "[render]\nshadow = pcss\n"
                              "[kiosk]\ncontent = content\nsocket = own/ctl\nstate = own/state\n"
                              "fade = 1\n"
                              "[mode \"Old\"]\nshadow = hard\n[light \"Lamp\"]\nshadow = none\n"
                              "[button \"b\"]\nkeys = space\npress = next\n";

static void test_a_kiosk_ini_is_laid_over_the_machines(void **state) {
    (void)state;
    write_file("base.ini", machine);
    write_file("content/kiosk.ini", "[scene]\nfile = new.glb\n[render]\nmsaa = 2\n"
                                    "[kiosk]\nsocket = theirs\nstate = theirs\ncontent = no\n"
                                    "screenshots = theirs\nfade = 2\n"
                                    "[mode \"New\"]\nshadow = pcf\n");
    assert_true(read_with(NULL));
    const struct gn_settings *s = options.settings;
    check_path(s->scene.path, "content/new.glb");
    assert_int_equal(s->scene.list.count, 1);
    assert_null(s->scene.camera);
    assert_true(s->scene.turntable_deg_s == 0);
    assert_false(gn_settings_given(s, camera.theta_deg));
    assert_false(gn_settings_given(s, light.azimuth_deg));
    assert_int_equal(s->light_count, 0);
    assert_int_equal(options.mode_count, 1);
    assert_string_equal(options.modes[0].name, "New");
    assert_int_equal(s->display.rotate_deg, 90);
    assert_int_equal(s->render.msaa, 2);
    assert_true(gn_settings_given(s, render.shadow));
    assert_true(s->kiosk.fade_ns == INT64_C(2000000000));
    check_path(s->kiosk.socket, "own/ctl");
    check_path(s->kiosk.state, "own/state");
    check_path(s->kiosk.content, "content");
    assert_null(s->kiosk.screenshots);
    assert_int_equal(options.buttons->count, 1);
    check_path(options.config_path, "content/kiosk.ini");
    check_path(options.base_path, "base.ini");
    check_path(options.content, "content");
    gn_options_finish(&options);
}

static void test_one_scene_takes_the_place_of_the_files(void **state) {
    (void)state;
    write_file("base.ini", machine);
    write_file("content/b.glb", "x");
    assert_true(read_with(NULL));
    const struct gn_settings *s = options.settings;
    check_path(s->scene.path, "content/b.glb");
    assert_int_equal(s->scene.list.count, 1);
    assert_null(s->scene.camera); /* of the old scene */
    assert_true(s->scene.turntable_deg_s == 4);
    assert_int_equal(options.mode_count, 1);
    assert_string_equal(options.modes[0].name, "Old");
    check_path(options.config_path, "base.ini");
    assert_null(options.base_path);
    gn_options_finish(&options);
}

static void test_folders_with_such_names_are_neither(void **state) {
    char path[80];
    (void)state;
    write_file("base.ini", machine);
    snprintf(path, sizeof path, "%s/a.glb", folder);
    assert_int_equal(mkdir(path, 0755), 0);
    snprintf(path, sizeof path, "%s/kiosk.ini", folder);
    assert_int_equal(mkdir(path, 0755), 0);
    assert_true(read_with(NULL));
    assert_null(options.content);
    gn_options_finish(&options);
    write_file("content/b.glb", "x");
    assert_true(read_with(NULL));
    check_path(options.settings->scene.path, "content/b.glb");
    gn_options_finish(&options);
}

static void test_an_empty_folder_changes_nothing(void **state) {
    (void)state;
    write_file("base.ini", machine);
    assert_true(read_with(NULL));
    check_path(options.settings->scene.path, "old.glb");
    assert_int_equal(options.settings->scene.list.count, 2);
    assert_null(options.content);
    gn_options_finish(&options);
}

static void test_the_flag_beats_the_file(void **state) {
    (void)state;
    write_file("base.ini", "[scene]\nfile = old.glb\n[kiosk]\ncontent = no\n");
    write_file("content/b.glb", "x");
    assert_true(read_with(NULL));
    check_path(options.settings->scene.path, "old.glb");
    gn_options_finish(&options);
    assert_true(read_with(flag));
    check_path(options.settings->scene.path, "content/b.glb");
    gn_options_finish(&options);
    write_file("base.ini", machine);
    assert_true(read_with("--content=no"));
    check_path(options.settings->scene.path, "old.glb");
    gn_options_finish(&options);
}

static void test_a_bad_one_leaves_the_machines_and_says_why(void **state) {
    (void)state;
    write_file("base.ini", machine);
    write_file("content/kiosk.ini", "[scene]\nfile = new.glb\n[mode \"A\"]\nshadow = nope\n");
    assert_true(read_with(NULL));
    assert_non_null(options.config_error);
    assert_non_null(strstr(options.config_error, "content/kiosk.ini:4: shadow"));
    check_path(options.settings->scene.path, "old.glb");
    assert_string_equal(options.modes[0].name, "Old");
    assert_int_equal(options.settings->display.rotate_deg, 90);
    gn_options_finish(&options);
}

static void test_a_button_of_the_machine_goes_to_a_mode_that_is_there(void **state) {
    static const char with_button[] = "[kiosk]\ncontent = content\n[mode \"Old\"]\nshadow = hard\n"
                                      "[button \"b\"]\nkeys = space\npress = mode Old\n";
    (void)state;
    write_file("base.ini", with_button);
    write_file("content/kiosk.ini", "[mode \"New\"]\nshadow = hard\n");
    assert_true(read_with(NULL));
    assert_non_null(options.config_error);
    assert_non_null(strstr(options.config_error, "\"b\" goes to the mode \"Old\""));
    gn_options_finish(&options);
    write_file("content/kiosk.ini", "[mode \"New\"]\nshadow = hard\n"
                                    "[button \"b\"]\nkeys = space\npress = mode New\n");
    assert_true(read_with(NULL));
    assert_null(options.config_error);
    gn_options_finish(&options);
}

/* Whether a warning names that line of the content's kiosk.ini, and its key. */
static bool is_left_out(int line, const char *key) {
    char text[100];
    snprintf(text, sizeof text, "content/kiosk.ini:%d: %s is left out: ", line, key);
    for (int i = 0; i < warnings.count; i++)
        if (strstr(warnings.text[i], text)) return true;
    return false;
}

/* Every key of the file, one at a time, with a value that it cannot have where it is the
 * machine's. */
static void test_the_screen_the_gpu_and_the_hours_are_the_machines(void **state) {
    static const char *const both[] = {"rotate", "pixel-shift"};
    static const char *const others[] = {"content", "socket",  "state",  "screenshots",
                                         "size",    "without", "shaders"};
    int found = 0;
    (void)state;
    write_file("base.ini", machine);
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (!row->section || row->kind == GN_KIND_LIMIT) continue;
        bool is_machines =
            strcmp(row->section, "display") == 0 || strcmp(row->section, "schedule") == 0;
        for (size_t k = 0; k < sizeof both / sizeof *both; k++)
            is_machines &= strcmp(row->name, both[k]) != 0;
        for (size_t k = 0; k < sizeof others / sizeof *others; k++)
            is_machines |= strcmp(row->name, others[k]) == 0;
        char key[64], text[200];
        gn_option_key(row, key, sizeof key);
        snprintf(text, sizeof text, "[%s]\n%s = not for it\n", row->section, key);
        write_file("content/kiosk.ini", text);
        assert_true(read_with(NULL));
        if (is_left_out(2, key) != is_machines) fail_msg("[%s] %s", row->section, key);
        if (is_machines) assert_null(options.config_error);
        if (is_machines) assert_string_equal(options.settings->display.backend, "egl");
        found += is_machines;
        gn_options_finish(&options);
    }
    assert_true(found > 20);
}

static void test_a_mode_of_content_sets_nothing_of_the_machines_either(void **state) {
    (void)state;
    write_file("base.ini", machine);
    write_file("content/kiosk.ini", "[display]\nrotate = 180\npixel_shift = 3\n[mode \"A\"]\n"
                                    "shaders = none\nwithout = msaa\nsize = 16384x16384\n"
                                    "limit = memory_mb=9\nshadow = hard\n");
    assert_true(read_with(NULL));
    const struct gn_settings *s = &options.all[1];
    assert_null(options.config_error);
    assert_true(is_left_out(5, "shaders") && is_left_out(6, "without") && is_left_out(7, "size") &&
                is_left_out(8, "limit"));
    assert_int_equal(warnings.count, 4);
    assert_null(s->render.shaders);
    assert_null(s->render.without);
    assert_int_equal(s->render.size.width_px, 1280);
    assert_int_equal(s->render.limits.count, 0);
    assert_int_equal(s->display.rotate_deg, 180);
    assert_int_equal(s->display.pixel_shift_px, 3);
    gn_options_finish(&options);
}

static void test_content_lowers_limits_and_raises_none(void **state) {
    (void)state;
    write_file("base.ini", "[kiosk]\ncontent = content\n"
                           "[render]\nlimit = nodes=50\nlimit = texels=1000\n");
    write_file("content/kiosk.ini",
               "[render]\nlimit = nodes=51\nlimit = texels=999\nlimit = seconds=61\n"
               "limit = keys=4000000\nlimit = vertices=20000001\nlimit = texels=1000\n");
    assert_true(read_with(NULL));
    const struct gn_scene_limits *limits = &options.settings->render.limits.all;
    assert_null(options.config_error);
    assert_int_equal(limits->nodes, 50);
    assert_int_equal(limits->texels, 999);
    assert_int_equal(limits->seconds, 0); /* its default */
    assert_int_equal(limits->keys, 4000000);
    assert_int_equal(limits->vertices, 0);
    assert_true(is_left_out(2, "limit") && is_left_out(4, "limit") && is_left_out(6, "limit") &&
                is_left_out(7, "limit"));
    assert_int_equal(warnings.count, 4);
    gn_options_finish(&options);
    write_file("content/kiosk.ini", "[render]\nlimit = nodse=1\n");
    assert_true(read_with(NULL));
    assert_non_null(options.config_error);
    gn_options_finish(&options);
}

static int make_folders(void **state) {
    (void)state;
    gn_cut_remove(folder);
    return mkdir(folder, 0755);
}

static int make_top(void **state) {
    (void)state;
    if (!mkdtemp(top)) return -1;
    snprintf(base, sizeof base, "%s/base.ini", top);
    snprintf(folder, sizeof folder, "%s/content", top);
    snprintf(flag, sizeof flag, "--content=%s", folder);
    return 0;
}

static int remove_top(void **state) {
    (void)state;
    gn_cut_remove(top);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_a_kiosk_ini_is_laid_over_the_machines, make_folders),
        cmocka_unit_test_setup(test_one_scene_takes_the_place_of_the_files, make_folders),
        cmocka_unit_test_setup(test_folders_with_such_names_are_neither, make_folders),
        cmocka_unit_test_setup(test_an_empty_folder_changes_nothing, make_folders),
        cmocka_unit_test_setup(test_the_flag_beats_the_file, make_folders),
        cmocka_unit_test_setup(test_a_bad_one_leaves_the_machines_and_says_why, make_folders),
        cmocka_unit_test_setup(test_a_button_of_the_machine_goes_to_a_mode_that_is_there,
                               make_folders),
        cmocka_unit_test_setup(test_the_screen_the_gpu_and_the_hours_are_the_machines,
                               make_folders),
        cmocka_unit_test_setup(test_a_mode_of_content_sets_nothing_of_the_machines_either,
                               make_folders),
        cmocka_unit_test_setup(test_content_lowers_limits_and_raises_none, make_folders),
    };
    return cmocka_run_group_tests(tests, make_top, remove_top);
}
