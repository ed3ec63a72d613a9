#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/help.h"
#include "core/file.h"
#include "options/args.h"
#include "options/change.h"
#include "options/command.h"
#include "options/file.h"
#include "options/value.h"
#include "unit/options_help.h"

static struct gn_changes *changes;

static void drop(void) {
    gn_changes_destroy(changes);
    changes = NULL;
    gn_options_finish(&options);
}

static int drop_all(void **state) {
    (void)state;
    drop();
    return 0;
}

/* Splits at spaces. */
static bool parse(const char *line) {
    char text[1024];
    static char kept[40][200];
    char *argv[41] = {kept[0]};
    int argc = 1;
    snprintf(text, sizeof text, "%s", line);
    for (char *word = strtok(text, " "); word; word = strtok(NULL, " ")) {
        snprintf(kept[argc], sizeof kept[argc], "%s", word);
        argv[argc] = kept[argc];
        argc++;
    }
    drop();
    err = (struct gn_err){0};
    const bool ok = gn_args_parse(&options, argc, argv, &warnings, &err);
    if (ok) changes = gn_changes_create(&options);
    return ok;
}

static bool change(const char *key, const char *text) {
    err = (struct gn_err){0};
    const struct gn_option_row *row = gn_changes_find(key, &err);
    return row && gn_changes_set(changes, row, text, &err);
}

static void assert_no_change(const char *key, const char *text, const char *says) {
    if (change(key, text)) fail_msg("taken: %s %s", key, text);
    if (!strstr(err.text, says)) fail_msg("\"%s\" is not \"%s\"", err.text, says);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

/* ---- set ------------------------------------------------------------------------------------ */

static void a_change_beats_the_command_line_and_every_mode(void **state) {
    (void)state;
    assert_true(parse("show --shadow pcf2 --map 512"));
    assert_true(change("shadow", "pcss"));
    assert_shadow("pcss");
    assert_true(gn_options_choose(&options, "hard", &err));
    assert_shadow("pcss");
    options.settings = &options.all[0];
    assert_shadow("pcss");
    assert_string_equal(gn_settings_label(options.settings, render.shadow), "set shadow");
    assert_true(change("map", "256"));
    assert_int_equal(options.settings->render.map_px, 256);
}

static void a_key_may_be_written_in_several_ways(void **state) {
    static const char *const ways[] = {"shadow_strength", "shadow-strength",
                                       "render.shadow_strength", "render.shadow-strength"};
    (void)state;
    assert_true(parse("show"));
    for (int i = 0; i < 4; i++) {
        char text[8];
        snprintf(text, sizeof text, "0.%d", i + 1);
        assert_true(change(ways[i], text));
        assert_true(fabs(options.settings->render.shadow_strength - (i + 1) / 10.0) < 1e-9);
    }
    assert_no_change("scene.shadow", "pcf", "unknown key");
    assert_no_change("shadwo", "pcf", "unknown key \"shadwo\"; did you mean shadow?");
    assert_no_change("zzzzzzzz", "1", "expected a key of [scene], [render] or [kiosk]");
}

static void what_cannot_change_says_why(void **state) {
    (void)state;
    assert_true(parse("show"));
    assert_no_change("size", "8x8", "size takes a reload");
    assert_no_change("msaa", "4", "msaa takes a reload");
    assert_no_change("backend", "egl", "backend takes a reload");
    assert_no_change("display.mode", "64x64", "display-mode takes a reload");
    assert_no_change("shaders", "/x", "shaders takes a reload");
    assert_no_change("limit", "nodes=1", "limit takes a reload");
    assert_no_change("socket", "/x", "socket takes a restart");
    assert_no_change("aov", "normal", "aov is not an option of the kiosk");
    assert_no_change("file", "/x.glb", "scene takes a reload");
    assert_no_change("shadow", "pcf,hard", "one technique at a time");
    assert_no_change("map", "8", "set map: \"8\" is not a whole number from 16 to 16384");
    assert_no_change("camera", "", "set camera");
    assert_no_change("environment", "/x.hdr", "environment: only a word can be set, no file");
}

/* Each option either can be changed to its default or says why not. */
static void every_option_of_the_file_is_one_or_the_other(void **state) {
    (void)state;
    int can = 0, cannot = 0;
    assert_true(parse("show"));
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (!row->section) continue;
        const char *text = row->fallback ? row->fallback : row->kind == GN_KIND_FLAG ? "yes" : "x";
        err = (struct gn_err){0};
        if (gn_changes_set(changes, row, text, &err)) {
            can++;
            continue;
        }
        cannot++;
        if (row->change == GN_CHANGE_LIVE) fail_msg("%s: %s", row->name, err.text);
        const char *why = row->change == GN_CHANGE_RELOAD    ? "takes a reload"
                          : row->change == GN_CHANGE_RESTART ? "takes a restart"
                                                             : "is not an option";
        if (!strstr(err.text, why)) fail_msg("%s: \"%s\"", row->name, err.text);
    }
    assert_true(can >= 15);
    assert_true(cannot >= 10);
}

/* Whoever may use the socket would choose files that the kiosk opens with its rights. */
static void no_file_can_be_named_by_ctl(void **state) {
    (void)state;
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (row->kind == GN_KIND_PATH || row->kind == GN_KIND_SCENES)
            assert_true(row->change != GN_CHANGE_LIVE || row->choices);
    }
}

static void a_change_can_be_taken_back(void **state) {
    (void)state;
    assert_true(parse("show --camera Top"));
    const struct gn_option_row *row = gn_changes_find("camera", &err);
    assert_true(gn_changes_set(changes, row, "Garden", &err));
    gn_changes_undo(changes);
    assert_string_equal(options.settings->scene.camera, "Top");
    assert_string_equal(gn_settings_label(options.settings, scene.camera), "--camera");
    assert_true(gn_changes_set(changes, row, "Garden", &err));
    assert_true(gn_changes_set(changes, row, "Dial", &err));
    gn_changes_undo(changes);
    assert_string_equal(options.settings->scene.camera, "Garden");
    assert_true(gn_changes_set(changes, row, "Top", &err));
    assert_string_equal(options.settings->scene.camera, "Top");
}

static void years_of_changes_take_no_more_memory(void **state) {
    char text[300];
    (void)state;
    assert_true(parse("show"));
    memset(text, 'c', sizeof text);
    for (int i = 0; i < 10; i++) { /* both places have been as large as they will be */
        text[200 + i] = '\0';
        assert_true(change("camera", text));
        text[200 + i] = 'c';
        assert_true(change("shadow", i % 2 ? "pcf" : "pcss"));
    }
    const unsigned long before = gn_alloc_count();
    const size_t used = options.arena.used;
    for (int i = 0; i < 100000; i++) {
        const int length = 1 + i % 200;
        text[length] = '\0';
        assert_true(change("camera", text));
        assert_int_equal(strlen(options.settings->scene.camera), length);
        text[length] = 'c';
        assert_true(change("shadow", i % 2 ? "pcf" : "pcss"));
    }
    assert_int_equal(gn_alloc_count(), before);
    assert_int_equal(options.arena.used, used);
}

/* ---- values as words ------------------------------------------------------------------------ */

static void a_value_reads_as_it_was_written(void **state) {
    static const char *const pairs[][2] = {
        {"turntable", "6.5"},      {"map", "512"},        {"shadow", "pcss"},
        {"map-format", "r16f"},    {"exposure", "auto"},  {"exposure", "-2.25"},
        {"show-lights", "yes"},    {"show-lights", "no"}, {"time", "2.5"},
        {"size", "640x480"},       {"rotate", "270"},     {"display-mode", "1920x1080@59.94"},
        {"display-mode", "64x64"}, {"limit", "nodes=9"},  {"scene", "/a b.glb"},
        {"camera", "Top"},         {"planar", "stencil"},
    };
    char text[100];
    (void)state;
    assert_true(parse("show"));
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        _Alignas(16) char value[sizeof(struct gn_limits)] = {0};
        const struct gn_option_row *row = NULL;
        for (int k = 0; k < GN_OPTION_COUNT; k++)
            if (strcmp(gn_option_rows[k].name, pairs[i][0]) == 0) row = &gn_option_rows[k];
        assert_non_null(row);
        assert_true(gn_value_parse(row, pairs[i][1], value, &options.arena, "x", &err));
        gn_value_text(row, value, text, sizeof text);
        assert_string_equal(text, pairs[i][1]);
    }
}

/* ---- ctl on the command line ---------------------------------------------------------------- */

static void ctl_takes_words_and_values_that_look_like_flags(void **state) {
    (void)state;
    assert_true(parse("ctl status"));
    assert_int_equal(options.settings->run.command, GN_COMMAND_CTL);
    assert_int_equal(options.word_count, 1);
    assert_true(parse("ctl --json set exposure -2 --socket /s"));
    assert_int_equal(options.word_count, 3);
    assert_string_equal(options.words[0], "set");
    assert_string_equal(options.words[2], "-2");
    assert_string_equal(options.settings->kiosk.socket, "/s");
    assert_true(options.settings->run.json);
    assert_true(parse("ctl set turntable -.5"));
    assert_string_equal(options.words[2], "-.5");
    assert_true(parse("ctl mode -- -odd"));
    assert_string_equal(options.words[1], "-odd");
    assert_null(options.settings->scene.path);
    assert_true(parse("ctl"));
    assert_int_equal(options.word_count, 0);
    assert_false(parse("ctl set a b c d"));
    assert_false(parse("ctl --size 8x8 status"));
    assert_non_null(strstr(err.text, "--size is not valid for ctl"));
    assert_false(parse("ctl set camera -x"));
    assert_false(parse("stl")); /* a file's name would have a dot */
    assert_non_null(strstr(err.text, "did you mean ctl?"));
}

static void ctl_looks_where_the_file_says(void **state) {
    char path[] = "/tmp/gnomon-change-XXXXXX", line[100];
    (void)state;
    close(mkstemp(path));
    static const char good[] = "[kiosk]\nsocket = own/ctl\n", bad[] = "[kiosk]\nsokcet = x\n";
    assert_true(gn_file_write(path, good, strlen(good), &err));
    snprintf(line, sizeof line, "ctl -c %s status", path);
    assert_true(parse(line));
    assert_string_equal(options.settings->kiosk.socket, "/tmp/own/ctl");
    /* with a bad file a kiosk runs with its defaults, so that is where it is looked for */
    warnings.count = 0;
    assert_true(gn_file_write(path, bad, strlen(bad), &err));
    assert_true(parse(line));
    assert_null(options.settings->kiosk.socket);
    assert_int_equal(options.word_count, 1);
    assert_int_equal(warnings.count, 0);
    unlink(path);
    assert_false(parse(line));
}

static void a_file_that_is_only_checked_is_read_strictly(void **state) {
    char path[] = "/tmp/gnomon-change-XXXXXX", line[100];
    (void)state;
    close(mkstemp(path));
    static const char bad[] = "[render]\nmap = 8\n";
    assert_true(gn_file_write(path, bad, strlen(bad), &err));
    snprintf(line, sizeof line, "show --check %s", path);
    assert_true(parse(line)); /* to its end: the errors are in a list */
    assert_int_equal(options.errors->count, 1);
    assert_int_equal(options.errors->items[0].status, GN_EXIT_USAGE);
    snprintf(line, sizeof line, "show -c %s", path);
    assert_true(parse(line));
    assert_non_null(options.config_error);
    unlink(path);
}

static void help_lists_every_command(void **state) {
    char *text = NULL;
    size_t size;
    (void)state;
    FILE *to = open_memstream(&text, &size);
    gn_help_print(to, GN_COMMAND_CTL, false);
    fclose(to);
    for (int i = 0; i < GN_CTL_COUNT; i++) {
        char line[80];
        const struct gn_ctl_row *row = &gn_ctl_rows[i];
        snprintf(line, sizeof line, "\n  %s%s%s ", row->name, row->words[0] ? " " : "", row->words);
        if (!strstr(text, line)) fail_msg("no \"%s\" in --help", line + 1);
    }
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_file_can_be_named_by_ctl),
        cmocka_unit_test_teardown(a_change_beats_the_command_line_and_every_mode, drop_all),
        cmocka_unit_test_teardown(a_key_may_be_written_in_several_ways, drop_all),
        cmocka_unit_test_teardown(what_cannot_change_says_why, drop_all),
        cmocka_unit_test_teardown(every_option_of_the_file_is_one_or_the_other, drop_all),
        cmocka_unit_test_teardown(a_change_can_be_taken_back, drop_all),
        cmocka_unit_test_teardown(years_of_changes_take_no_more_memory, drop_all),
        cmocka_unit_test_teardown(a_value_reads_as_it_was_written, drop_all),
        cmocka_unit_test_teardown(ctl_takes_words_and_values_that_look_like_flags, drop_all),
        cmocka_unit_test_teardown(ctl_looks_where_the_file_says, drop_all),
        cmocka_unit_test_teardown(a_file_that_is_only_checked_is_read_strictly, drop_all),
        cmocka_unit_test(help_lists_every_command),
    };
    return cmocka_run_group_tests(tests, without_home, NULL);
}
