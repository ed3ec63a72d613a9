/* A configuration of 60 lines, each broken in turn in several ways: --check refuses it by one line
 * that names the file, the line, the key and what was expected, and a kiosk runs without that line,
 * or without that section. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/commands.h"
#include "options/args.h"
#include "options/file.h"
#include "unit/options_help.h"

/* clang-format off */
static const char good[] =
    "; a configuration of sixty lines\n"
    "[display]\n"
    "connector = HDMI-A-1\n"
    "mode = 1920x1080@60\n"
    "rotate = 90\n"
    "max_fps = 30\n"
    "legacy = no\n"
    "[scene]\n"
    "file = sundial.glb\n"
    "camera = Garden\n"
    "animation = hoop\n"
    "time = 2.5\n"
    "turntable = 6\n"
    "[render]\n"
    "size = 64x36\n"
    "shadow = pcf\n"
    "map = 512\n"
    "map_format = auto\n"
    "planar = mask\n"
    "taps = 16\n"
    "taps_fixed = no\n"
    "shadow_strength = 0.9\n"
    "show_lights = no\n"
    "show_maps = no\n"
    "exposure = auto\n"
    "limit = nodes=100000\n"
    "[kiosk]\n"
    "socket = ctl\n"
    "captions = yes\n"
    "caption_seconds = 2\n"
    "idle = first\n"
    "idle_after = 90\n"
    "fade = 0.3\n"
    "[mode \"Soft\"]\n"
    "shadow = pcss\n"
    "exposure = -1\n"
    "[mode \"Plan\"]\n"
    "camera = Top\n"
    "shadow = planar\n"
    "show_lights = yes\n"
    "[light \"Sun\"]\n"
    "shadow = hard\n"
    "radius = 0.01\n"
    "[button \"next\"]\n"
    "line = GPIO17\n"
    "keys = space right\n"
    "active_high = no\n"
    "bias = pull-up\n"
    "debounce_ms = 25\n"
    "hold_ms = 900\n"
    "press = next\n"
    "hold = mode Soft\n"
    "[button \"prev\"]\n"
    "line = label:pinctrl-rp1/27\n"
    "double_ms = 300\n"
    "repeat_ms = 250\n"
    "click = prev\n"
    "double = pause\n"
    "repeat = next-camera\n"
    "[button \"both\"]\n"
    "chord = next prev\n"
    "chord_ms = 100\n"
    "press = info\n";
/* clang-format on */
enum {
    LINE_SIZE = 200,
    SECTION_MAX = 12 /* settings in one */,
    BUTTONS = 44 /* their first line */
};

static char folder[] = "/tmp/gnomon-lines-XXXXXX";
static char path[80], scene[80];
static int cases, good_settings, good_sections;

/* Line `number` of the good one; false: there are no more. */
static bool line_of(int number, char *out) {
    const char *at = good;
    while (--number > 0 && at) at = strchr(at, '\n') ? strchr(at, '\n') + 1 : NULL;
    if (!at || !*at) return false;
    snprintf(out, LINE_SIZE, "%.*s", (int)strcspn(at, "\n"), at);
    return true;
}

/* The good one with that line instead. */
static void write_broken(int number, const char *line) {
    char other[LINE_SIZE];
    FILE *file = fopen(path, "we");
    assert_non_null(file);
    for (int i = 1; line_of(i, other); i++) fprintf(file, "%s\n", i == number ? line : other);
    assert_int_equal(fclose(file), 0);
}

static bool parse(const char *option) {
    static char *argv[] = {"gnomon", "show", NULL, path, NULL}; /* options keep it */
    argv[2] = (char *)option;
    gn_options_finish(&options);
    warnings = (struct gn_warnings){0};
    err = (struct gn_err){0};
    return gn_args_parse(&options, 4, argv, &warnings, &err);
}

static bool names_what_was_expected(const char *text) {
    static const char *const words[] = {"expected", "is not ",   "knows",
                                        "takes",    "no action", "ends with ]"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strstr(text, words[i])) return true;
    return false;
}

static void assert_refused(int number, const char *key) {
    char where[120];
    snprintf(where, sizeof where, "%s:%d: ", path, number);
    if (parse("--check") && gn_cli_check(&options, &warnings, &err))
        fail_msg("line %d is taken without %s", number, key);
    assert_int_equal(err.status, GN_EXIT_USAGE);
    if (options.errors && options.errors->count > 0) fail_msg("more than one: %s", err.text);
    if (strncmp(err.text, where, strlen(where)) != 0) fail_msg("line %d: %s", number, err.text);
    if (!strstr(err.text, key)) fail_msg("\"%s\" is not named: %s", key, err.text);
    if (!names_what_was_expected(err.text)) fail_msg("what was expected? %s", err.text);
}

/* What the file sets: options of plain sections, modes, lights, buttons, and settings in those. */
static int count_settings(int *sections) {
    int count = 0;
    for (int i = 0; i < GN_OPTION_COUNT; i++) count += options.all[0].source[i] == GN_SOURCE_INI;
    for (int i = 0; i < options.mode_count; i++)
        for (const struct gn_override *o = options.modes[i].first; o; o = o->next) count++;
    for (int i = 0; i < options.all[0].light_count; i++)
        for (const struct gn_override *o = options.all[0].lights[i].first; o; o = o->next) count++;
    *sections = options.mode_count + options.all[0].light_count +
                (options.buttons ? options.buttons->count : 0);
    return count;
}

/* lost: settings that the line may cost, lost_sections: buttons that it may. */
static void assert_runs_without(int number, int lost, int lost_sections) {
    char where[120];
    int sections;
    snprintf(where, sizeof where, "%s:%d: ", path, number);
    if (!parse("-c")) fail_msg("line %d ends the kiosk: %s", number, err.text);
    assert_int_equal(warnings.count, 1);
    if (strncmp(warnings.text[0], where, strlen(where)) != 0 ||
        !strstr(warnings.text[0], "(running without it)"))
        fail_msg("line %d: %s", number, warnings.text[0]);
    assert_non_null(options.config_error);
    const int count = count_settings(&sections);
    if (count < good_settings - lost || sections < good_sections - lost_sections)
        fail_msg("line %d costs %d settings and %d sections", number, good_settings - count,
                 good_sections - sections);
}

/* A section costs its settings, a key of a button that button and a chord of it. */
static void break_line(int number, const char *line, const char *key, bool is_section) {
    write_broken(number, line);
    assert_refused(number, key);
    assert_runs_without(number, is_section ? SECTION_MAX : 1,
                        is_section || number > BUTTONS ? 2 : 0);
    cases++;
}

static bool takes_any_text(const char *key) {
    static const char *const keys[] = {"connector", "file",   "camera",
                                       "animation", "socket", "line"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (strcmp(key, keys[i]) == 0) return true;
    return false;
}

static void break_section(int number, const char *line) {
    char broken[LINE_SIZE + 1];
    snprintf(broken, sizeof broken, "%.*s", (int)strcspn(line, "]"), line);
    break_line(number, broken, "]", true);
    snprintf(broken, sizeof broken, "[x%s", line + 1);
    break_line(number, broken, "[x", true);
}

static void break_setting(int number, const char *line) {
    char key[LINE_SIZE], broken[2 * LINE_SIZE], wrong[LINE_SIZE + 1];
    snprintf(key, sizeof key, "%.*s", (int)strcspn(line, " "), line);
    snprintf(wrong, sizeof wrong, "%sx", key);
    snprintf(broken, sizeof broken, "%s%s", wrong, line + strlen(key));
    break_line(number, broken, wrong, false);
    break_line(number, key, key, false);
    snprintf(broken, sizeof broken, "%s =", key);
    break_line(number, broken, key, false);
    snprintf(broken, sizeof broken, "%s = @", key);
    if (!takes_any_text(key)) break_line(number, broken, key, false);
}

static void each_line_that_is_broken_is_named(void **state) {
    char line[LINE_SIZE];
    int number = 0;
    (void)state;
    write_broken(0, "");
    gn_options_finish(&options);
    gn_options_init(&options, GN_COMMAND_SHOW);
    if (!gn_config_load(&options, path, NULL, &err)) fail_msg("the good one: %s", err.text);
    good_settings = count_settings(&good_sections);
    assert_true(good_settings > 30 && good_sections == 6);
    while (line_of(++number, line))
        if (line[0] == ';')
            break_line(number, "no comment", "no comment", false);
        else if (line[0] == '[')
            break_section(number, line);
        else
            break_setting(number, line);
    printf("%d lines, %d ways to break them\n", number - 1, cases);
    assert_true(number > 60);
}

static int enter(void **state) {
    if (without_home(state) != 0 || !mkdtemp(folder)) return -1;
    snprintf(path, sizeof path, "%s/bad.ini", folder);
    snprintf(scene, sizeof scene, "%s/sundial.glb", folder);
    char *whole = realpath("assets/sundial.glb", NULL);
    const int failed = whole ? symlink(whole, scene) : -1;
    free(whole);
    return failed;
}

static int leave(void **state) {
    clean(state);
    unlink(path);
    unlink(scene);
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_line_that_is_broken_is_named)};
    return cmocka_run_group_tests(tests, enter, leave);
}
