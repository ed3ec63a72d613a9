/* Words that can reach the screen of gnomon show: no short name of a technique, no path, no text of
 * the system. The constant ones are in tables and in calls of the kiosk's sources; those of wrong
 * lines of kiosk.ini are made of such lines. LIST=1 prints them all. */
#include <ctype.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/text.h"
#include "kiosk/info_page.h"
#include "options/args.h"
#include "options/viewer_keys.h"
#include "shadow/technique.h"
#include "unit/options_help.h"

static int count;
static char folder[] = "/tmp/gnomon-words-XXXXXX", file[80];

/* A kiosk with that file; NULL: with one that is not there. */
static void read_file(const char *text) {
    static char *argv[] = {"gnomon", "show", "-c", file, NULL}; /* options keep it */
    gn_options_finish(&options);
    snprintf(file, sizeof file, "%s/bad.ini", folder);
    if (text && !gn_file_write(file, text, strlen(text), &err)) fail_msg("%s", err.text);
    if (!text) remove(file);
    if (!gn_args_parse(&options, 4, argv, &warnings, &err)) fail_msg("%s", err.text);
    assert_non_null(options.config_error);
}

static int enter(void **state) { return without_home(state) != 0 || !mkdtemp(folder); }

static int leave(void **state) {
    clean(state);
    remove(file);
    return remove(folder);
}

static bool has_word(const char *text, const char *word) {
    const size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++) {
        const bool begins = at == text || !isalnum((unsigned char)at[-1]),
                   ends = !isalnum((unsigned char)at[length]);
        if (begins && ends) return true;
    }
    return false;
}

/* "none" is also a word of its own. */
static void expect_plain(const char *text) {
    count++;
    if (getenv("LIST")) printf("%s\n", text);
    for (int i = 1; i < GN_TECHNIQUE_ALL; i++)
        if (gn_techniques[i].name && i != GN_TECHNIQUE_HARD && i != GN_TECHNIQUE_WHITE &&
            i != GN_TECHNIQUE_FLOOR && has_word(text, gn_techniques[i].name))
            fail_msg("\"%s\" has the short name %s", text, gn_techniques[i].name);
    for (int i = 1; i < 134; i++)
        if (strstr(text, strerror(i))) fail_msg("\"%s\" has a text of the system", text);
    for (const char *at = text; (at = strchr(at, '/')); at++)
        if (at == text || at[-1] == ' ' || at[-1] == '"') fail_msg("\"%s\" has a path", text);
}

static void tables_have_plain_words(void **state) {
    (void)state;
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) {
        assert_non_null(gn_techniques[i].title);
        expect_plain(gn_techniques[i].title);
    }
    for (int i = 0; i < GN_PROBLEM_COUNT; i++) {
        if (!gn_problem_words[i].title || !gn_problem_words[i].advice) fail_msg("kind %d", i);
        expect_plain(gn_problem_words[i].title);
        expect_plain(gn_problem_words[i].advice);
    }
}

static void keys_have_plain_words(void **state) {
    (void)state;
    for (const struct gn_viewer_key *row = gn_viewer_keys; row->name; row++) {
        expect_plain(row->name);
        expect_plain(row->meaning);
    }
}

/* What the kiosk's sources give to the functions that show a text; err.text is given to none. */
static void calls_have_plain_words(void **state) {
    static const char *const shows[] = {"gn_show_note(", "gn_captions_set(", "show_failure(s",
                                        "gn_display_show_message("};
    glob_t files;
    (void)state;
    assert_int_equal(glob("src/kiosk/*.c", 0, NULL, &files), 0);
    for (size_t f = 0; f < files.gl_pathc; f++) {
        struct gn_bytes bytes;
        if (!gn_file_read(files.gl_pathv[f], 1 << 20, &bytes, &err)) fail_msg("%s", err.text);
        char *text = strndup((const char *)bytes.data, bytes.size);
        for (size_t k = 0; k < sizeof shows / sizeof *shows; k++)
            for (const char *at = text; (at = strstr(at, shows[k])); at++) {
                char call[400];
                snprintf(call, sizeof call, "%.*s", (int)strcspn(at, ";{"), at);
                if (strstr(call, "err.text") || strstr(call, "why.text") ||
                    strstr(call, "err->text") || strstr(call, "strerror"))
                    fail_msg("%s: %s", files.gl_pathv[f], call);
                for (char *quote = strchr(call, '"'); quote; quote = strchr(quote + 1, '"')) {
                    char *end = strchr(quote + 1, '"');
                    if (!end) break;
                    *end = 0;
                    expect_plain(quote + 1);
                    quote = end;
                }
            }
        free(text);
        gn_bytes_finish(&bytes);
    }
    globfree(&files);
    assert_true(count > 50);
}

/* Each line has a value or a name that is wrong, and a value may be a path or nearly a technique.
 */
static void wrong_lines_are_named_without_values_of_that_kind(void **state) {
    static const struct {
        const char *line, *shown;
    } lines[] = {
        {"[render]\nshdow = none\n", "there is no key \"shdow\" in [render]. Did you mean shadow"},
        {"[render]\nshadow = pcff\n", "\"shadow\" is set to a value that is not allowed."},
        {"[render]\nshadow = smsn\n", "\"shadow\" is set to a value that is not allowed."},
        {"[render]\nmsaa = /etc/passwd\n", "\"msaa\" is set to a value that is not allowed."},
        {"[render]\naov = colour\n", "\"aov\" cannot be \"colour\". Did you mean color?"},
        {"[rendr]\nmap = 64\n", "the section [rendr] cannot be used. Did you mean render"},
        {"[kiosk]\nidle = frist\n", "\"idle\" cannot be \"frist\". Did you mean first?"},
        {"[mode \"a name of more than forty-eight characters, by far\"]\n",
         "a name of more than 48"},
        {"[mode A]\n", "expected [section] or [section \"NAME\"]"},
        {"[render]\nplanr = 1\n", "there is no key \"planr\" in [render]."},
        {"[render]\nidle = 3\n", "there is no key \"idle\" in [render]. It belongs in [kiosk]."},
        {"[render]\nmsaa = 4\nmsaa = 4\n", "\"msaa\" cannot be set here."},
        {"[mode]\nmap = 64\n", "[mode] cannot be used. It needs a name: [mode \"NAME\"]."},
        {"[button \"b\"]\nkeys = x\n", "the button \"b\" cannot be used."},
        {"[button \"b\"]\nkeys = x\npress = mode pcfx\n", "the button \"b\" cannot be used."},
    };
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        read_file(lines[i].line);
        expect_plain(options.config_shown);
        if (!strstr(options.config_shown, lines[i].shown)) fail_msg("%s", options.config_shown);
        assert_int_equal(strncmp(options.config_shown, "Line ", 5), 0);
    }
    read_file(NULL);
    assert_string_equal(options.config_shown, ""); /* the words of the kind are left */
}

static void at_most_three_are_suggested_the_nearest_first(void **state) {
    (void)state;
    read_file("[light]\nazimut = 3\n[camera]\nphi_mix = 3\n");
    assert_non_null(strstr(options.config_shown, "Did you mean azimuth?"));
    read_file("[camera]\nphi_mix = 3\n");
    const char *first = strstr(options.config_shown, "phi_min");
    assert_non_null(first);
    assert_non_null(strstr(first, "phi_max"));
    read_file("[display]\nrotate = 18\n");
    int named = 0;
    for (const char *at = strstr(options.config_shown, "mean"); at && *at; at++)
        named += *at == ',' || strncmp(at, " or ", 4) == 0;
    assert_true(named < 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_have_plain_words),
        cmocka_unit_test(keys_have_plain_words),
        cmocka_unit_test(calls_have_plain_words),
        cmocka_unit_test(wrong_lines_are_named_without_values_of_that_kind),
        cmocka_unit_test(at_most_three_are_suggested_the_nearest_first),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
