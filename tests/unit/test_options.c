#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/help.h"
#include "options/args.h"
#include "options/section.h"
#include "options/value.h"
#include "unit/options_help.h"

/* Splits at spaces: no argument of these tests has one. */
static bool parse(const char *line) {
    char text[1024];
    char *argv[40] = {"gnomon"};
    int argc = 1;
    snprintf(text, sizeof text, "%s", line);
    for (char *word = strtok(text, " "); word; word = strtok(NULL, " ")) argv[argc++] = word;
    gn_options_finish(&options);
    warnings.count = 0;
    err = (struct gn_err){0};
    return gn_args_parse(&options, argc, argv, &warnings, &err);
}

static void assert_wrong(const char *line, const char *says) {
    if (parse(line)) fail_msg("\"%s\" was taken", line);
    if (!strstr(err.text, says)) fail_msg("\"%s\" says \"%s\", not \"%s\"", line, err.text, says);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

/* ---- the command line ---------------------------------------------------------------------- */

static void nothing_gives_the_defaults(void **state) {
    (void)state;
    assert_true(parse(""));
    assert_int_equal(options.settings->run.command, GN_COMMAND_AUTO);
    assert_null(options.settings->scene.path);
    assert_int_equal(options.settings->render.size.width_px, 1280);
    assert_int_equal(options.settings->render.size.height_px, 720);
    assert_int_equal(options.settings->render.map_px, 1024);
    assert_shadow("pcf");
    assert_string_equal(options.settings->display.backend, "auto");
    assert_int_equal(options.settings->render.map_format,
                     GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_NONE));
    assert_true(isnan(options.settings->render.exposure_ev));
    assert_true(options.settings->render.shadow_strength == 1);
    assert_false(gn_settings_given(options.settings, render.shadow));
}

static void values_come_in_three_ways(void **state) {
    (void)state;
    assert_true(parse("render a.glb --size 640x480 --map=256 -oout.png"));
    assert_int_equal(options.settings->run.command, GN_COMMAND_RENDER);
    assert_string_equal(options.settings->scene.path, "a.glb");
    assert_int_equal(options.settings->render.size.height_px, 480);
    assert_int_equal(options.settings->render.map_px, 256);
    assert_string_equal(options.settings->run.out, "out.png");
    assert_true(gn_settings_given(options.settings, render.map_px));
    assert_true(parse("-v render -o x.png a.glb"));
    assert_true(options.settings->run.verbose);
    assert_string_equal(options.settings->scene.path, "a.glb");
    assert_true(parse("render -vo x.png -- -odd.glb"));
    assert_string_equal(options.settings->scene.path, "-odd.glb");
}

static void the_last_of_two_wins(void **state) {
    (void)state;
    assert_true(parse("render --map 64 --map 128"));
    assert_int_equal(options.settings->render.map_px, 128);
}

static void a_value_knows_where_it_comes_from(void **state) {
    (void)state;
    assert_true(parse("render --camera Top --mode hard"));
    assert_string_equal(gn_settings_label(options.settings, scene.camera), "--camera");
    assert_string_equal(gn_settings_label(options.settings, render.shadow), "--mode");
    assert_string_equal(gn_settings_label(options.settings, render.size), "size");
    assert_wrong("render --mode nosuch", "--mode: there is no shadow technique 'nosuch'");
}

static void contradictions_are_not_guessed_at(void **state) {
    (void)state;
    assert_wrong("render --animation a --no-animation", "exclude each other");
    assert_true(parse("render --animation none --no-animation"));
}

static void every_kind_is_read(void **state) {
    (void)state;
    assert_true(parse(
        "render --aov map --output linear --exposure -1.5 --time 1.25 --msaa 4 --no-animation"));
    assert_int_equal(options.settings->render.output, GN_PICTURE_LINEAR);
    assert_true(options.settings->render.exposure_ev == -1.5);
    assert_true(options.settings->scene.time_ns == 1250000000);
    assert_int_equal(options.settings->render.msaa, 4);
    assert_true(options.settings->scene.no_animation);
    assert_true(parse("render --limit nodes=5 --limit texels=7"));
    assert_int_equal(options.settings->render.limits.count, 2);
    assert_string_equal(options.settings->render.limits.items[0].name, "nodes");
    assert_int_equal(options.settings->render.limits.items[1].value, 7);
    assert_true(parse("show --display-mode 1920x1080@59.94 --rotate 90"));
    assert_int_equal(options.settings->display.mode.width_px, 1920);
    assert_true(options.settings->display.mode.hz == 59.94);
    assert_int_equal(options.settings->display.rotate_deg, 90);
}

static void a_wrong_value_names_option_value_and_range(void **state) {
    (void)state;
    assert_wrong("render --size 0x10",
                 "--size: \"0x10\" is not a size WxH, each side from 1 to 16384");
    assert_wrong("render --size 100000x10", "100000x10");
    assert_wrong("render --size 10x", "--size");
    assert_wrong("render --size 10x-5", "--size");
    assert_wrong("render --size 10x5x", "--size");
    assert_wrong("render --size +10x5", "--size");
    assert_wrong("render --size 4294967297x1", "--size");
    assert_wrong("render --map 15", "--map: \"15\" is not a whole number from 16 to 16384");
    assert_wrong("render --map 16385", "16384");
    assert_wrong("render --map 0x40", "whole number");
    assert_wrong("render --map 64.0", "whole number");
    assert_wrong("render --map=", "--map: \"\"");
    assert_wrong("render --map 99999999999999999999", "whole number");
    assert_wrong("render --shadow-strength 1.01",
                 "--shadow-strength: \"1.01\" is not a number from 0 to 1");
    assert_wrong("render --shadow-strength 0,5", "0,5");
    assert_wrong("render --shadow-strength nan", "nan");
    assert_wrong("render --exposure inf", "auto or a number");
    assert_wrong("render --time -1", "--time");
    assert_wrong("render --aov colour",
                 "one of color, visibility, distance, normal, occlusion, map");
    assert_wrong("render --msaa 3", "one of auto, 0, 2, 4");
    assert_wrong("render --background #12345", "not #rrggbb or one of auto, transparent, sky");
    assert_wrong("render --background #1234567", "#rrggbb");
    assert_wrong("render --background #12345g", "#rrggbb");
    assert_wrong("render --background 123456", "#rrggbb");
    assert_wrong("render --tone filmic", "one of auto, neutral, aces, agx, none");
    assert_wrong("render --backend EGL", "one of auto, egl, osmesa, kms, window");
    assert_wrong("render --shadow=", "--shadow");
    assert_wrong("render --shadow nosuch", "--shadow: \"nosuch\" is not one of none, hard, pcf,");
    assert_wrong("bench --shadow pcf,,hard", "--shadow: \"pcf,,hard\" is not");
    assert_wrong("bench --shadow pcf,", "--shadow: \"pcf,\" is not");
    assert_wrong("show --shadow pcf,hard", "only bench takes a list");
    assert_wrong("bench --shadow pcf,hard,pcf", "--shadow: pcf is there twice");
    assert_wrong("bench --shadow "
                 "pcf,hard,hard,hard,hard,hard,hard,hard,hard,hard,hard,hard,hard,hard,hard,hard,"
                 "hard,hard,hard",
                 "--shadow: hard is there twice");
    assert_wrong("render --limit nodes", "NAME=VALUE");
    assert_wrong("render --limit =5", "NAME=VALUE");
    assert_wrong("render --limit nodes=0", "NAME=VALUE");
    assert_wrong("render --limit verts=1", "--limit: unknown limit 'verts'; limits are: file_mb");
    assert_wrong("render --limit nodes=1099511627776", "--limit: limit nodes: 1099511627776");
    assert_wrong("show --modeline 65", "--modeline: \"65\" is no mode: MHz, four rising widths");
    assert_wrong("render --without wings", "--without: unknown capability \"wings\"; expected");
    assert_wrong("show --display-mode 1920x1080@", "WxH@HZ");
    assert_wrong("show --rotate 45", "one of 0, 90, 180, 270");
}

static void help_and_version_are_commands_too(void **state) {
    (void)state;
    assert_true(parse("help"));
    assert_true(options.settings->run.help);
    assert_int_equal(options.settings->run.command, GN_COMMAND_AUTO);
    assert_true(parse("help render"));
    assert_true(options.settings->run.help);
    assert_int_equal(options.settings->run.command, GN_COMMAND_RENDER);
    assert_true(parse("version"));
    assert_true(options.settings->run.version);
    assert_true(parse("-V"));
    assert_true(options.settings->run.version);
    assert_wrong("help rendr", "did you mean render?");
    assert_wrong("version now", "unexpected argument \"now\"");
}

static void a_letter_takes_no_equals_sign(void **state) {
    (void)state;
    assert_wrong("render -o=q.png", "-o: write -o VALUE or --out=VALUE, not -o=q.png");
    assert_true(parse("render -oq.png"));
    assert_string_equal(options.settings->run.out, "q.png");
}

static void wrong_words_are_explained(void **state) {
    (void)state;
    assert_wrong("rendr", "did you mean render?");
    assert_wrong("xyzzyxyzzy", "the commands are");
    assert_wrong("render --sise 1x1", "did you mean --size?");
    assert_wrong("render --siz", "did you mean --size?");
    assert_wrong("render --quaternion", "unknown option --quaternion");
    assert_wrong("--quux", "unknown option --quux; --help lists the options");
    assert_wrong("hlep", "did you mean help?");
    assert_wrong("render --shadow pfc", "; did you mean pcf?");
    assert_wrong("bench --shadow hard,msn", "; did you mean msm?");
    assert_wrong("render --aov colour", "; did you mean color?");
    assert_wrong("render --shadow banana", "planar"); /* the last of the names */
    assert_wrong("render -q", "unknown option -q");
    assert_wrong("render --size", "--size needs a value: WxH");
    assert_wrong("show --check --here", "--check needs a value: FILE");
    assert_wrong("render --out --size=64x64", "--out needs a value: FILE");
    assert_wrong("render --plan=yes", "--plan takes no value");
    assert_wrong("inspect --cascades 2",
                 "--cascades is not valid for inspect; it is valid for show, render, bench");
    assert_wrong("--json", "it is valid for bench, inspect, fit, doctor");
    assert_wrong("render a.glb b.glb", "b.glb");
    assert_wrong("a.glb b.glb", "b.glb");
    assert_wrong("doctor a.glb", "no scene");
}

static void a_missing_file_is_not_a_wrong_command(void **state) {
    (void)state;
    assert_true(parse("missing.glb"));
    assert_string_equal(options.settings->scene.path, "missing.glb");
    assert_int_equal(options.settings->run.command, GN_COMMAND_AUTO);
}

static void help_and_version_need_nothing_else(void **state) {
    (void)state;
    assert_true(parse("render --help -c /nonexistent.ini"));
    assert_true(options.settings->run.help);
    assert_int_equal(options.settings->run.command, GN_COMMAND_RENDER);
    assert_true(parse("rendr --version"));
    assert_true(options.settings->run.version);
    assert_true(parse("-h"));
    assert_true(options.settings->run.help);
}

/* ---- modes --------------------------------------------------------------------------------- */

static void without_a_file_the_techniques_are_modes(void **state) {
    (void)state;
    assert_true(parse("render --mode hard"));
    assert_shadow("hard");
    assert_int_equal(
        gn_settings_source(options.settings, offsetof(struct gn_settings, render.shadow)),
        GN_SOURCE_MODE);
    assert_true(parse("render --mode hard --shadow pcf3"));
    assert_shadow("pcf3");
}

/* ---- the table ----------------------------------------------------------------------------- */

static void every_default_is_in_its_range(void **state) {
    (void)state;
    struct gn_arena arena = {0};
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        _Alignas(16) char field[sizeof(struct gn_limits)] = {0};
        if (row->fallback && !gn_value_parse(row, row->fallback, field, &arena, row->name, &err))
            fail_msg("%s", err.text);
    }
    gn_arena_finish(&arena);
}

static void rows_are_complete_and_different(void **state) {
    (void)state;
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *a = &gn_option_rows[i];
        assert_non_null(a->name);
        assert_non_null(a->help);
        assert_true(a->commands || a->section || a->of_light);
        const bool of_show = !a->commands || a->commands & 1u << GN_COMMAND_SHOW;
        assert_int_equal(a->change != GN_CHANGE_NEVER, a->section && of_show);
        assert_true(!a->reopens || a->change == GN_CHANGE_RELOAD);
        assert_true(!a->value == (a->kind == GN_KIND_FLAG));
        assert_true(a->offset + gn_value_size(a->kind) <= sizeof(struct gn_settings));
        for (int k = 0; k < i; k++) {
            const struct gn_option_row *b = &gn_option_rows[k];
            assert_string_not_equal(a->name, b->name);
            assert_true(!a->letter || a->letter != b->letter);
            assert_true(a->offset + gn_value_size(a->kind) <= b->offset ||
                        b->offset + gn_value_size(b->kind) <= a->offset);
        }
    }
}

/* The names of --map-format are those of two tables, and each stands for its own row. */
static void a_map_format_is_named_as_its_row(void **state) {
    (void)state;
    int encodings = 0, moments = 0;
    const struct gn_option_row *row = gn_option_find_key("render", "map_format");
    for (const struct gn_choice *c = row->choices; c->name; c++) {
        const enum gn_encoding encoding = GN_MAP_FORMAT_ENCODING(c->value);
        const enum gn_moments kept = GN_MAP_FORMAT_MOMENTS(c->value);
        if (kept != GN_MOMENTS_NONE)
            assert_string_equal(c->name, gn_moments[kept].name), moments++;
        else if (encoding != GN_ENCODING_AUTO)
            assert_string_equal(c->name, gn_encodings[encoding].name), encodings++;
        else
            assert_string_equal(c->name, "auto");
    }
    assert_int_equal(moments, GN_MOMENTS_COUNT - 1);
    assert_int_equal(encodings, GN_ENCODING_MASK); /* those before it have names for people */
}

static void every_key_finds_its_row(void **state) {
    (void)state;
    char key[64];
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (row->section)
            assert_ptr_equal(gn_option_find_key(row->section, gn_option_key(row, key, sizeof key)),
                             row);
        if (row->commands) assert_ptr_equal(gn_option_find(row->name, strlen(row->name)), row);
    }
    assert_null(gn_section_find_key(gn_section_find("mode", true), "connector"));
    assert_null(gn_option_find_key("render", "turntable"));
    assert_null(gn_option_find("siz", 3));
}

static void options_of_the_display_are_taken(void **state) {
    (void)state;
    assert_true(parse("show --rotate 90 --connector HDMI-A-2 --card platform-gpu-card --legacy "
                      "--display-mode 1280x720@50"));
    assert_int_equal(warnings.count, 0);
    assert_int_equal(options.settings->display.rotate_deg, 90);
    assert_string_equal(options.settings->display.connector, "HDMI-A-2");
    assert_string_equal(options.settings->display.card, "platform-gpu-card");
    assert_true(options.settings->display.legacy);
    assert_int_equal(options.settings->display.mode.height_px, 720);
    assert_int_equal(options.settings->display.max_fps, 0);
    gn_options_finish(&options);
}

/* ---- --help ---------------------------------------------------------------------------- */

static char *help_of(enum gn_command command, bool all) {
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    gn_help_print(to, command, all);
    fclose(to);
    return text;
}

/* As a word: --plan is not in --planar. */
static bool has_flag(const char *text, const char *flag) {
    for (const char *at = text; (at = strstr(at, flag)); at++)
        if (strchr(" \n", at[strlen(flag)])) return true;
    return false;
}

static void help_lists_what_the_parser_takes_and_nothing_else(void **state) {
    (void)state;
    for (int command = 0; command < GN_COMMAND_COUNT; command++) {
        char *text = help_of(command, true);
        for (int i = 0; i < GN_OPTION_COUNT; i++) {
            const struct gn_option_row *row = &gn_option_rows[i];
            const unsigned wanted = 1u << command;
            char flag[80];
            snprintf(flag, sizeof flag, "    --%s%s%s", row->name, row->value ? " " : "",
                     row->value ? row->value : "");
            bool listed = has_flag(text, row->letter ? flag + 4 : flag);
            assert_int_equal(listed, (row->commands & wanted) != 0);
        }
        free(text);
    }
}

static void the_examples_of_the_help_are_right(void **state) {
    (void)state;
    for (int command = 0; command < GN_COMMAND_COUNT; command++)
        for (int i = 0; i < GN_COMMAND_EXAMPLES; i++) {
            const char *line = gn_commands[command].examples[i];
            if (strstr(line, ".ini")) continue; /* there is no such file */
            assert_memory_equal(line, "gnomon", 6);
            if (!parse(line + 6)) fail_msg("%s: %s", line, err.text);
            assert_int_equal(options.settings->run.command, command);
        }
}

static void a_default_is_printed_with_its_unit(void **state) {
    static const struct {
        const char *option, *phrase;
    } rows[] = {{"size", " (default 1280x720 pixels)"},
                {"shadow", " (default pcf)"},
                {"output", ". One of: srgb, "},
                {"light-color", "does not count. Or: auto (default auto)"},
                {"content", ". Or: no (default no)"},
                {"exposure", " (in stops; default auto)"},
                {"max-fps", " (in frames per second)"},
                {"limit", ". Limits: file_mb=512, memory_mb=1024 or 1/2 of the memory, "}};
    char text[500];
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        gn_help_phrase(gn_option_find(rows[i].option, strlen(rows[i].option)), text, sizeof text);
        if (!strstr(text, rows[i].phrase)) fail_msg("--%s: %s", rows[i].option, text);
    }
}

static void help_fits_a_hundred_columns(void **state) {
    (void)state;
    for (int command = 0; command < GN_COMMAND_COUNT; command++) {
        char *text = help_of(command, true);
        for (const char *at = text; *at; at += strcspn(at, "\n") + 1)
            assert_in_range(strcspn(at, "\n"), 0, 100);
        free(text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(nothing_gives_the_defaults, clean),
        cmocka_unit_test_teardown(values_come_in_three_ways, clean),
        cmocka_unit_test_teardown(the_last_of_two_wins, clean),
        cmocka_unit_test_teardown(every_kind_is_read, clean),
        cmocka_unit_test_teardown(a_value_knows_where_it_comes_from, clean),
        cmocka_unit_test_teardown(contradictions_are_not_guessed_at, clean),
        cmocka_unit_test_teardown(a_wrong_value_names_option_value_and_range, clean),
        cmocka_unit_test_teardown(help_and_version_are_commands_too, clean),
        cmocka_unit_test_teardown(a_letter_takes_no_equals_sign, clean),
        cmocka_unit_test_teardown(wrong_words_are_explained, clean),
        cmocka_unit_test_teardown(a_missing_file_is_not_a_wrong_command, clean),
        cmocka_unit_test_teardown(help_and_version_need_nothing_else, clean),
        cmocka_unit_test_teardown(without_a_file_the_techniques_are_modes, clean),
        cmocka_unit_test(every_default_is_in_its_range),
        cmocka_unit_test(rows_are_complete_and_different),
        cmocka_unit_test(a_map_format_is_named_as_its_row),
        cmocka_unit_test(every_key_finds_its_row),
        cmocka_unit_test(help_lists_what_the_parser_takes_and_nothing_else),
        cmocka_unit_test(options_of_the_display_are_taken),
        cmocka_unit_test_teardown(the_examples_of_the_help_are_right, clean),
        cmocka_unit_test(a_default_is_printed_with_its_unit),
        cmocka_unit_test(help_fits_a_hundred_columns),
    };
    return cmocka_run_group_tests(tests, without_home, NULL);
}
