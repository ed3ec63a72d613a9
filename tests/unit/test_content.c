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
static bool read_with(const char *more) {
    static struct gn_warnings warnings;
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
        cmocka_unit_test_setup(test_an_empty_folder_changes_nothing, make_folders),
        cmocka_unit_test_setup(test_the_flag_beats_the_file, make_folders),
        cmocka_unit_test_setup(test_a_bad_one_leaves_the_machines_and_says_why, make_folders),
        cmocka_unit_test_setup(test_a_button_of_the_machine_goes_to_a_mode_that_is_there,
                               make_folders),
    };
    return cmocka_run_group_tests(tests, make_top, remove_top);
}
