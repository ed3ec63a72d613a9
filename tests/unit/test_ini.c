#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"
#include "options/args.h"
#include "options/file.h"
#include "options/ini.h"
#include "options/section.h"
#include "stage/lights.h"
#include "unit/folder.h"

static char folder[] = "/tmp/gnomon-ini-XXXXXX";
static struct gn_err err;

/* ---- lines --------------------------------------------------------------------------------- */

static char seen[4096];

static bool note(void *user, const struct gn_ini_line *line, struct gn_err *e) {
    size_t used = strlen(seen);
    (void)user, (void)e;
    snprintf(seen + used, sizeof seen - used, "%s [%s|%s] %s=%s\n", strrchr(line->where, ':') + 1,
             line->section, line->name ? line->name : "", line->key ? line->key : "",
             line->value ? line->value : "");
    return !line->value || strcmp(line->value, "fail") != 0 || gn_fail(e, "told to");
}

static bool read_text(const char *text) {
    seen[0] = '\0';
    err = (struct gn_err){0};
    return gn_ini_parse("f.ini", text, strlen(text), note, NULL, NULL, &err);
}

/* The settings of a section that failed are skipped. */
static void errors_are_collected(void **state) {
    static const char text[] = "[a]\nx = 1\nbad\ny = fail\n[b\nz = 2\n[c]\nw = 3\n";
    struct gn_errors *errors = calloc(1, sizeof *errors);
    (void)state;
    seen[0] = '\0';
    err = (struct gn_err){0};
    assert_true(gn_ini_parse("f.ini", text, strlen(text), note, NULL, errors, &err));
    assert_int_equal(errors->count, 3);
    assert_non_null(strstr(errors->items[0].text, "f.ini:3: expected KEY"));
    assert_string_equal(errors->items[1].text, "told to");
    assert_non_null(strstr(errors->items[2].text, "f.ini:5: a section ends with ]"));
    assert_string_equal(err.text, "");
    assert_non_null(strstr(seen, "2 [a|] x=1\n"));
    assert_null(strstr(seen, "z=2"));
    assert_non_null(strstr(seen, "8 [c|] w=3\n"));
    free(errors);
}

static void assert_refused(const char *text, const char *says) {
    if (read_text(text)) fail_msg("taken: %s", text);
    if (!strstr(err.text, says)) fail_msg("\"%s\" is not \"%s\"", err.text, says);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

static void settings_come_with_section_and_line(void **state) {
    (void)state;
    assert_true(read_text("\xef\xbb\xbf; comment\n\n[a]\r\nk = v w ; comment\n# c\n  ; c\n[mode "
                          "\"So ft\"] ; c\nx=1"));
    assert_string_equal(seen, "3 [a|] =\n4 [a|] k=v w\n7 [mode|So ft] =\n8 [mode|So ft] x=1\n");
}

static void nothing_is_fine(void **state) {
    (void)state;
    assert_true(read_text(""));
    assert_true(read_text("\n\n"));
    assert_string_equal(seen, "");
}

static void wrong_lines_are_named(void **state) {
    (void)state;
    assert_refused("[a]\nk = 1\n  more\n", "f.ini:3: begins with a space");
    assert_refused("[a]\n  k = 1\n", "f.ini:2: begins with a space");
    assert_refused("k = 1\n", "f.ini:1: a setting before the first [section]");
    assert_refused("[a]\nk\n", "f.ini:2: expected KEY = VALUE");
    assert_refused("[a]\nk: v\n", "f.ini:2: expected KEY = VALUE");
    assert_refused("[a]\nk ; = v\n", "f.ini:2: expected KEY = VALUE");
    assert_refused("[a]\n= v\n", "f.ini:2: expected a key");
    assert_refused("[a\n", "f.ini:1: a section ends with ]");
    assert_refused("[a] b\n", "f.ini:1: nothing may follow");
    assert_refused("[mode \"x]\n", "f.ini:1: expected [section]");
    assert_refused("[mode x]\n", "f.ini:1: expected [section]");
    assert_refused("[mode \"\"]\n", "f.ini:1: expected [section]");
    assert_refused("[mode \"x\" y]\n", "f.ini:1: expected [section]");
    assert_refused("[a]\nk = \x01\n", "f.ini:2: control characters");
}

static void long_lines_and_names_are_refused_not_cut(void **state) {
    (void)state;
    char text[400], name[64];
    for (int length = 180; length < 250; length++) {
        snprintf(text, sizeof text, "[a]\nk=%0*d\n", length - 2, 0);
        if (length <= GN_INI_LINE_MAX) {
            assert_true(read_text(text));
            assert_int_equal(strlen(strstr(seen, "k=")), length + 1);
        } else
            assert_refused(text, "f.ini:2: a line of more than 190 characters");
    }
    memset(name, 'n', sizeof name);
    name[GN_INI_NAME_MAX] = '\0';
    snprintf(text, sizeof text, "[%s]\n%s = 1\n[mode \"%s\"]\n", name, name, name);
    assert_true(read_text(text));
    snprintf(text, sizeof text, "[a]\n%sx = 1\n", name);
    assert_refused(text, "f.ini:2: a key of more than 48");
    snprintf(text, sizeof text, "[%sx]\n", name);
    assert_refused(text, "f.ini:1: a name of more than 48");
    snprintf(text, sizeof text, "[mode \"%sx\"]\n", name);
    assert_refused(text, "f.ini:1: a name of more than 48");
}

static void a_zero_byte_is_refused(void **state) {
    (void)state;
    assert_false(gn_ini_parse("f.ini", "[a]\nk=\0v\n", 9, note, NULL, NULL, &err));
    assert_non_null(strstr(err.text, "f.ini:2: control"));
}

static void the_first_failure_stops(void **state) {
    (void)state;
    assert_false(read_text("[a]\nk = fail\nl = 1\n[b]\n"));
    assert_string_equal(err.text, "told to");
    assert_null(strstr(seen, "l="));
}

/* ---- meaning ------------------------------------------------------------------------------- */

static struct gn_options options;
static struct gn_warnings warnings;

static void assert_shadow(const char *name) {
    const struct gn_technique_list *list = &options.settings->render.shadow;
    assert_int_equal(list->count, 1);
    assert_string_equal(gn_techniques[list->items[0]].name, name);
}

static const char *in_folder(const char *name) {
    static char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *text) {
    assert_true(gn_file_write(in_folder(name), text, strlen(text), &err));
}

static bool parse(int argc, char **argv) {
    gn_options_finish(&options);
    warnings = (struct gn_warnings){0};
    err = (struct gn_err){0};
    return gn_args_parse(&options, argc, argv, &warnings, &err);
}
#define PARSE(...)                                                                                 \
    parse((int)(sizeof((char *[]){__VA_ARGS__}) / sizeof(char *)), (char *[]){__VA_ARGS__, NULL})

static const char full[] =
    "[display]\nconnector = HDMI-A-1\nmode = 1920x1080@60\nrotate = 90\nmax_fps = 30\n"
    "[scene]\nfile = sundial.glb\nturntable = 6\n"
    "[render]\nshadow = hard\nmap = 512\nshow_lights = yes\nlimit = nodes=9\nlimit = keys=8\n"
    "[mode \"Soft\"]\nshadow = pcf5\n"
    "[mode \"Plan\"]\ncamera = Top\nmap = 256\nfile = plan.glb\n";

static void the_file_of_the_manual_is_read(void **state) {
    (void)state;
    write_file("k.ini", full);
    char *path = (char *)in_folder("k.ini"), scene[200];
    snprintf(scene, sizeof scene, "%s/sundial.glb", folder);
    assert_true(PARSE("gnomon", "show", "-c", path));
    assert_string_equal(options.settings->display.connector, "HDMI-A-1");
    assert_int_equal(options.settings->display.mode.height_px, 1080);
    assert_int_equal(options.settings->display.rotate_deg, 90);
    assert_int_equal(options.settings->display.max_fps, 30);
    assert_string_equal(options.settings->scene.path, scene);
    assert_true(options.settings->scene.turntable_deg_s == 6);
    assert_true(options.settings->render.show_lights);
    assert_int_equal(options.settings->render.limits.count, 2);
    assert_int_equal(options.mode_count, 2);
    assert_null(options.settings->mode);
    assert_true(gn_settings_given(options.settings, render.shadow));
}

static void a_flag_beats_a_mode_beats_the_file(void **state) {
    (void)state;
    write_file("k.ini", full);
    char *path = (char *)in_folder("k.ini");
    assert_true(PARSE("gnomon", "render", "-c", path));
    assert_shadow("hard");
    assert_true(PARSE("gnomon", "render", "-c", path, "--mode", "Soft"));
    assert_shadow("pcf5");
    assert_int_equal(options.settings->render.map_px, 512);
    assert_true(
        PARSE("gnomon", "render", "-c", path, "--mode", "Soft", "--shadow", "pcf2", "x.glb"));
    assert_shadow("pcf2");
    assert_string_equal(options.settings->scene.path, "x.glb");
}

static void a_mode_may_show_the_maps(void **state) {
    (void)state;
    write_file("k.ini", "[mode \"Plain\"]\nshadow = pcf\n[mode \"Maps\"]\nshow_maps = yes\n");
    char *path = (char *)in_folder("k.ini");
    assert_true(PARSE("gnomon", "show", "-c", path));
    assert_false(options.settings->render.show_maps);
    assert_true(gn_options_choose(&options, "Maps", &err));
    assert_true(options.settings->render.show_maps);
    assert_true(gn_options_choose(&options, "Plain", &err));
    assert_false(options.settings->render.show_maps);
}

static void a_mode_is_undone_by_the_next(void **state) {
    (void)state;
    write_file("k.ini", full);
    char plan[200];
    snprintf(plan, sizeof plan, "%s/plan.glb", folder);
    assert_true(PARSE("gnomon", "show", "-c", (char *)in_folder("k.ini")));
    assert_true(gn_options_choose(&options, "Plan", &err));
    assert_string_equal(options.settings->scene.camera, "Top");
    assert_string_equal(options.settings->scene.path, plan);
    assert_int_equal(options.settings->render.map_px, 256);
    size_t used = options.arena.used;
    for (int i = 0; i < 100; i++) {
        assert_true(gn_options_choose(&options, "Soft", &err));
        assert_null(options.settings->scene.camera);
        assert_int_equal(options.settings->render.map_px, 512);
        assert_shadow("pcf5");
        assert_true(gn_options_choose(&options, "Plan", &err));
        assert_shadow("hard");
    }
    assert_int_equal(options.arena.used, used);
    assert_false(gn_options_choose(&options, "Pla", &err));
    assert_non_null(strstr(err.text, "\"Soft\", \"Plan\""));
    assert_string_equal(options.settings->mode, "Plan");
    assert_int_equal(options.settings->render.map_px, 256);
}

static const char lights[] = "[render]\nshadow = hard\nmap = 512\n"
                             "[light \"Sun\"]\nshadow = pcss\nmap = 2048\n"
                             "[light \"Lamp 2\"]\nshadow = none\n[light \"Empty\"]\n"
                             "[mode \"Plain\"]\n[mode \"Soft\"]\nshadow = pcf5\n";

/* What holds of a section, in a mode. */
static void assert_light(const char *mode, int light, const char *holds) {
    char text[200];
    if (mode) assert_true(gn_options_choose(&options, mode, &err));
    gn_stage_print_light(options.settings, &options.settings->lights[light], text, sizeof text);
    assert_string_equal(text, holds);
}

static void a_light_beats_the_file_and_not_a_mode(void **state) {
    (void)state;
    write_file("k.ini", lights);
    char *path = (char *)in_folder("k.ini");
    assert_true(PARSE("gnomon", "show", "-c", path));
    assert_shadow("hard");
    assert_int_equal(options.settings->light_count, 3);
    assert_string_equal(options.settings->lights[1].name, "Lamp 2");
    assert_light(NULL, 0, "shadow = pcss, map = 2048");
    assert_light("Plain", 0, "shadow = pcss, map = 2048");
    assert_light("Soft", 0, "map = 2048");
    assert_light("Soft", 1, "shadow = none"); /* it never casts any */
    assert_light("Soft", 2, "");
    assert_true(PARSE("gnomon", "render", "-c", path, "--map", "64"));
    assert_light(NULL, 0, "shadow = pcss");
}

static void assert_file_refused(const char *text, const char *says) {
    write_file("bad.ini", text);
    if (PARSE("gnomon", "render", "-c", (char *)in_folder("bad.ini"))) fail_msg("taken: %s", text);
    if (!strstr(err.text, says)) fail_msg("\"%s\" is not \"%s\"", err.text, says);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

static void what_a_file_may_not_say(void **state) {
    (void)state;
    assert_file_refused("[rendr]\n",
                        "bad.ini:1: unknown section [rendr]; expected [display], [scene]");
    assert_file_refused("[render \"x\"]\n", "bad.ini:1: [render] has no name");
    assert_file_refused("[mode]\n", "bad.ini:1: a mode has a name");
    assert_file_refused("[render]\nshadw = pcf\n",
                        "bad.ini:2: unknown key \"shadw\" in [render]; expected shadow");
    assert_file_refused("[render]\nzzzzzzz = 1\n",
                        "bad.ini:2: unknown key \"zzzzzzz\"; keys of [render]: detail, size,");
    assert_file_refused("[render]\nmap-format = auto\n", "expected map_format");
    assert_file_refused("[render]\nout = x\n", "bad.ini:2: unknown key \"out\"");
    assert_file_refused("[render]\nturntable = 1\n", "bad.ini:2: unknown key \"turntable\"");
    assert_file_refused("[render]\n\nmap = 8\n",
                        "bad.ini:3: map: \"8\" is not a whole number from 16 to 16384");
    assert_file_refused("[render]\nmap =\n", "bad.ini:2: map: \"\"");
    assert_file_refused("[render]\nshadow = nosuch\n",
                        "bad.ini:2: shadow: \"nosuch\" is not one of none, hard,");
    assert_file_refused("[render]\nshow_lights = maybe\n", "is not yes or no");
    assert_file_refused("[display]\nmode = big\n", "bad.ini:2: mode: \"big\" is not WxH");
    assert_file_refused("[render]\nmap = 64\nmap = 64\n",
                        "bad.ini:3: map is set already, in line 2");
    assert_file_refused("[mode \"a\"]\nmap = 64\nmap = 64\n",
                        "bad.ini:3: map is set already, in line 2");
    assert_file_refused("[mode \"a\"]\nmap = 8\n", "bad.ini:2: map: \"8\"");
    assert_file_refused("[mode \"a\"]\nconnector = x\n", "bad.ini:2: unknown key \"connector\"");
    assert_file_refused("[mode \"a\"]\n[mode \"b\"]\n[mode \"a\"]\n",
                        "bad.ini:3: mode \"a\" is there already, in line 1");
    assert_file_refused("[light]\nshadow = pcf\n", "bad.ini:2: unknown key \"shadow\"");
    assert_file_refused("[render]\nfade = 1\n",
                        "bad.ini:2: unknown key \"fade\" in [render]; it is a key of [kiosk]");
    assert_file_refused("[light]\non = no\n", "bad.ini:2: unknown key \"on\"");
    assert_file_refused("[light]\ncolor = red\n",
                        "bad.ini:2: color: \"red\" is not #rrggbb or one of auto");
    assert_file_refused("[light]\ncolor = #12345g\n", "bad.ini:2: color: \"#12345g\" is not");
    assert_file_refused("[camera]\ntarget = 1,2\n",
                        "bad.ini:2: target: \"1,2\" is not auto or three numbers X,Y,Z");
    assert_file_refused("[camera]\ntarget = 1,2,3,4\n", "bad.ini:2: target: \"1,2,3,4\" is not");
    assert_file_refused("[mode \"a\"]\ntheta = 1\n", "bad.ini:2: unknown key \"theta\"");
    assert_file_refused("[light]\nelevation = 91\n",
                        "bad.ini:2: elevation: \"91\" is not auto or a number from -90 to 90");
    assert_file_refused("[light \"a\"]\nazimuth = 0\n", "bad.ini:2: unknown key \"azimuth\"");
    assert_file_refused("[mode \"a\"]\nazimuth = 0\n", "bad.ini:2: unknown key \"azimuth\"");
    assert_file_refused("[mode \"a\"]\nlight_azimut = 0\n",
                        "bad.ini:2: unknown key \"light_azimut\"");
    assert_file_refused("[light \"a\"]\n[light \"a\"]\n",
                        "bad.ini:2: light \"a\" is there already, in line 1");
    assert_file_refused("[light \"a\"]\nmap = 64\nmap = 64\n",
                        "bad.ini:3: map is set already, in line 2");
    assert_file_refused("[light \"a\"]\nmap = 8\n", "bad.ini:2: map: \"8\"");
    assert_file_refused("[light \"a\"]\nshadw = pcf\n",
                        "bad.ini:2: unknown key \"shadw\" in [light]; expected shadow");
    assert_file_refused("[light \"a\"]\nmsaa = 4\n",
                        "bad.ini:2: unknown key \"msaa\" in [light]; it is a key of [render]");
}

static void there_are_so_many_lights(void **state) {
    (void)state;
    char text[2000] = "";
    size_t used = 0;
    for (int i = 0; i <= GN_SECTIONS_MAX; i++) {
        used += (size_t)snprintf(text + used, sizeof text - used, "[light \"%d\"]\n", i);
        if (i + 1 < GN_SECTIONS_MAX) continue;
        write_file("k.ini", text);
        assert_int_equal(PARSE("gnomon", "render", "-c", (char *)in_folder("k.ini")),
                         i < GN_SECTIONS_MAX);
    }
    assert_non_null(strstr(err.text, "k.ini:33: more than 32 lights"));
}

/* Each line of a good file is replaced by a wrong one: always refused, by its own line. */
static void every_line_broken_in_turn_is_found(void **state) {
    (void)state;
    int line = 1;
    for (const char *at = full; *at; at = strchr(at, '\n') + 1, line++) {
        char text[1024], says[40];
        snprintf(text, sizeof text, "%.*s!%s", (int)(at - full), full, at);
        snprintf(says, sizeof says, "bad.ini:%d: ", line);
        assert_file_refused(text, says);
    }
    assert_int_equal(line, 21);
}

static void a_missing_file_is_a_runtime_error(void **state) {
    (void)state;
    char *path = (char *)in_folder("missing.ini");
    assert_false(PARSE("gnomon", "render", "-c", path));
    assert_int_equal(err.status, GN_EXIT_RUNTIME);
    assert_non_null(strstr(err.text, "missing.ini"));
    assert_false(PARSE("gnomon", "show", "--check", path));
    assert_int_equal(err.status, GN_EXIT_RUNTIME);
}

static void a_kiosk_runs_on_without_its_bad_file(void **state) {
    (void)state;
    assert_true(PARSE("gnomon", "show", "-c", (char *)in_folder("missing.ini")));
    assert_non_null(strstr(options.config_error, "missing.ini: cannot open"));
    write_file("bad.ini", "[render]\nmap = 64\nmap = 8\n");
    assert_true(PARSE("gnomon", "show", "--size", "8x8", "-c", (char *)in_folder("bad.ini")));
    assert_non_null(strstr(options.config_error, "bad.ini:3"));
    assert_int_equal(options.settings->render.map_px, 64); /* the line alone */
    assert_int_equal(options.settings->render.size.width_px, 8);
    assert_int_equal(warnings.count, 1);
    assert_false(PARSE("gnomon", "-c", (char *)in_folder("bad.ini")));
    write_file("bad.ini", "[mode \"A\"]\nlimit = verts=1\n[mode \"B\"]\nwithout = wings\n");
    assert_true(PARSE("gnomon", "show", "-c", (char *)in_folder("bad.ini")));
    assert_non_null(strstr(options.config_error, "bad.ini:2: limit: unknown limit 'verts'"));
    write_file("bad.ini", "[mode \"A\"]\nlimit = nodes=1\n[mode \"B\"]\nwithout = wings\n");
    assert_true(PARSE("gnomon", "show", "-c", (char *)in_folder("bad.ini")));
    assert_non_null(strstr(options.config_error, "bad.ini:4: without: unknown capability"));
}

/* A name that is too long costs its mode, and a button that goes there keeps its other gestures. */
static void a_wrong_mode_costs_that_mode(void **state) {
    (void)state;
    write_file("bad.ini",
               "[render]\nmap = 64\n[mode \"a name of more than forty-eight characters, by far\"]\n"
               "shadow = hard\n[mode \"B\"]\nshadow = none\nmpa = 1\n[mode \"C\"]\nshadow = hard\n"
               "[button \"b\"]\nkeys = space\npress = next\nhold = mode A\n"
               "[button \"c\"]\nkeys = x\n[button \"d\"]\nkeys = y\nclick = prev\n");
    assert_true(PARSE("gnomon", "show", "-c", (char *)in_folder("bad.ini")));
    assert_non_null(strstr(options.config_error, "bad.ini:3: a name of more than 48"));
    assert_non_null(strstr(options.config_error, " (and 1 more)"));
    assert_int_equal(options.settings->render.map_px, 64);
    assert_int_equal(options.mode_count, 2);
    assert_string_equal(options.modes[0].name, "B");
    assert_int_equal(options.all[1].render.shadow.items[0], GN_TECHNIQUE_NONE);
    assert_int_equal(options.buttons->count, 2); /* one does nothing */
    assert_string_equal(options.buttons->items[1].opts.name, "d");
    assert_int_equal(options.buttons->items[0].on[GN_GESTURE_PRESS].action.kind, GN_ACTION_NEXT);
    assert_int_equal(warnings.count, 2);
    write_file("bad.ini", "[button \"b\"]\nkeys = space\n"); /* none is left: those of a start */
    assert_true(PARSE("gnomon", "show", "-c", (char *)in_folder("bad.ini")));
    assert_null(options.buttons);
    assert_non_null(options.config_error);
    assert_false(PARSE("gnomon", "-c", (char *)in_folder("bad.ini"))); /* a desktop's command */
}

static void only_show_and_the_bare_command_search(void **state) {
    (void)state;
    assert_int_equal(mkdir(in_folder("gnomon"), 0700), 0);
    write_file("gnomon/kiosk.ini", "[render]\nmap = 64\n");
    setenv("XDG_CONFIG_HOME", folder, 1);
    assert_true(PARSE("gnomon", "show"));
    assert_int_equal(options.settings->render.map_px, 64);
    assert_string_equal(options.config_path, in_folder("gnomon/kiosk.ini"));
    assert_true(PARSE("gnomon"));
    assert_int_equal(options.settings->render.map_px, 64);
    assert_true(PARSE("gnomon", "render"));
    assert_int_equal(options.settings->render.map_px, 1024);
    setenv("XDG_CONFIG_HOME", "relative", 1);
    assert_true(PARSE("gnomon", "show"));
    assert_int_equal(options.settings->render.map_px, 1024);
    assert_int_equal(mkdir(in_folder(".config"), 0700), 0);
    assert_int_equal(mkdir(in_folder(".config/gnomon"), 0700), 0);
    write_file(".config/gnomon/kiosk.ini", "[render]\nmap = 32\n");
    setenv("HOME", folder, 1);
    assert_true(PARSE("gnomon", "show"));
    assert_int_equal(options.settings->render.map_px, 32);
}

static int enter(void **state) {
    (void)state;
    unsetenv("HOME");
    unsetenv("XDG_CONFIG_HOME");
    return mkdtemp(folder) ? 0 : -1;
}

static int leave(void **state) {
    (void)state;
    gn_options_finish(&options);
    return gn_test_remove_folder(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_come_with_section_and_line),
        cmocka_unit_test(nothing_is_fine),
        cmocka_unit_test(wrong_lines_are_named),
        cmocka_unit_test(long_lines_and_names_are_refused_not_cut),
        cmocka_unit_test(a_zero_byte_is_refused),
        cmocka_unit_test(the_first_failure_stops),
        cmocka_unit_test(errors_are_collected),
        cmocka_unit_test(the_file_of_the_manual_is_read),
        cmocka_unit_test(a_flag_beats_a_mode_beats_the_file),
        cmocka_unit_test(a_mode_may_show_the_maps),
        cmocka_unit_test(a_mode_is_undone_by_the_next),
        cmocka_unit_test(what_a_file_may_not_say),
        cmocka_unit_test(every_line_broken_in_turn_is_found),
        cmocka_unit_test(a_light_beats_the_file_and_not_a_mode),
        cmocka_unit_test(there_are_so_many_lights),
        cmocka_unit_test(a_missing_file_is_a_runtime_error),
        cmocka_unit_test(a_kiosk_runs_on_without_its_bad_file),
        cmocka_unit_test(a_wrong_mode_costs_that_mode),
        cmocka_unit_test(only_show_and_the_bare_command_search),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
