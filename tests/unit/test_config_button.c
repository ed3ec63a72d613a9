#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "options/buttons.h"
#include "options/file.h"

static char path[] = "/tmp/gnomon-button-XXXXXX";
static struct gn_options options;
static struct gn_err err;

static bool load(const char *text) {
    gn_options_finish(&options);
    gn_options_init(&options, GN_COMMAND_SHOW);
    err = (struct gn_err){0};
    assert_true(gn_file_write(path, text, strlen(text), &err));
    return gn_config_load(&options, path, NULL, &err);
}

static const struct gn_button_config *button(int i) {
    assert_true(options.buttons && i < options.buttons->count);
    return &options.buttons->items[i];
}

static void assert_refused(const char *text, int line, const char *says) {
    char where[80];
    if (load(text)) fail_msg("taken: %s", text);
    snprintf(where, sizeof where, "%s:%d: ", path, line);
    if (strncmp(err.text, where, strlen(where)) != 0 || !strstr(err.text, says))
        fail_msg("\"%s\" is not \"%s%s\"", err.text, where, says);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

/* ---- what is read --------------------------------------------------------------------------- */

static void a_file_without_buttons_has_none(void **state) {
    (void)state;
    assert_true(load("[render]\nmap = 64\n"));
    assert_null(options.buttons);
}

static void every_key_arrives_where_it_belongs(void **state) {
    (void)state;
    assert_true(load("[mode \"Soft\"]\nshadow = pcss\n"
                     "[button \"next\"]\nline = GPIO17\nkeys = space F1 btn_0\nactive_high = yes\n"
                     "bias = none\ndebounce_ms = 30\nhold_ms = 900\ndouble_ms = 300\n"
                     "repeat_ms = 250\npress = next\nclick = prev\ndouble = pause\n"
                     "hold = mode Soft\nrepeat = none\n"
                     "[button \"other\"]\nline = label:pinctrl-rp1/27\nclick = blank\n"
                     "[button \"both\"]\nchord = next other\nchord_ms = 100\npress = info\n"));
    assert_int_equal(options.buttons->count, 3);
    const struct gn_button_opts *o = &button(0)->opts;
    assert_string_equal(o->name, "next");
    assert_string_equal(o->line, "GPIO17");
    assert_string_equal(o->keys, "space F1 btn_0");
    assert_true(o->active_high);
    assert_int_equal(o->bias, GN_BIAS_NONE);
    assert_int_equal(o->debounce_ns, 30000000);
    assert_int_equal(o->hold_ns, 900000000);
    assert_int_equal(o->double_ns, 300000000);
    assert_int_equal(o->repeat_ns, 250000000);
    const enum gn_action_kind wanted[] = {GN_ACTION_NEXT, GN_ACTION_PREV, GN_ACTION_PAUSE,
                                          GN_ACTION_MODE, GN_ACTION_NONE};
    for (int g = GN_GESTURE_PRESS; g <= GN_GESTURE_REPEAT; g++) {
        assert_true(button(0)->on[g].bound);
        assert_int_equal(button(0)->on[g].action.kind, wanted[g]);
    }
    assert_string_equal(button(0)->on[GN_GESTURE_HOLD].action.name, "Soft");
    assert_false(button(0)->on[GN_GESTURE_CHORD].bound);
    assert_string_equal(button(1)->opts.line, "label:pinctrl-rp1/27");
    assert_int_equal(button(1)->opts.bias, GN_BIAS_PULL_UP);
    assert_int_equal(button(1)->opts.debounce_ns, 0);
}

static void what_a_chord_does_is_said_under_press(void **state) {
    (void)state;
    assert_true(load("[button \"a\"]\nkeys = a\n[button \"b\"]\nkeys = b\n"
                     "[button \"ab\"]\nchord = a b\npress = info\nchord_ms = 100\n"));
    assert_false(button(2)->on[GN_GESTURE_PRESS].bound);
    assert_true(button(2)->on[GN_GESTURE_CHORD].bound);
    assert_int_equal(button(2)->on[GN_GESTURE_CHORD].action.kind, GN_ACTION_INFO);
    assert_int_equal(button(2)->opts.chord_ns, 100000000);
}

static void a_line_that_is_high_when_pressed_is_pulled_down(void **state) {
    (void)state;
    assert_true(load("[button \"a\"]\nline = X\nactive_high = yes\npress = next\n"));
    assert_int_equal(button(0)->opts.bias, GN_BIAS_PULL_DOWN);
    assert_true(
        load("[button \"a\"]\nline = X\nactive_high = yes\nbias = pull-up\npress = next\n"));
    assert_int_equal(button(0)->opts.bias, GN_BIAS_PULL_UP);
}

static void without_modes_the_techniques_are_modes(void **state) {
    (void)state;
    assert_true(load("[button \"a\"]\nkeys = a\npress = mode pcss\n"));
    assert_refused("[button \"a\"]\nkeys = a\npress = mode Soft\n", 3, "no mode \"Soft\"");
}

static void a_mode_may_stand_below_the_button_that_names_it(void **state) {
    (void)state;
    assert_true(load("[button \"a\"]\nkeys = a\npress = mode Big Top\n[mode \"Big Top\"]\n"));
}

/* ---- what is refused ------------------------------------------------------------------------ */

static void values_that_are_none(void **state) {
    (void)state;
    assert_refused("[button]\n", 1, "a button has a name");
    assert_refused("[button \"a b\"]\n", 1, "has no spaces");
    assert_refused("[button \"a\"]\nline = 17\n", 2, "line: \"17\" is not a line's name");
    assert_refused("[button \"a\"]\nline = gpiochip0\n", 2, "numbers of chips change");
    assert_refused("[button \"a\"]\nline = label:rp1\n", 2, "label:LABEL/OFFSET");
    assert_refused("[button \"a\"]\nline = label:rp1/x\n", 2, "label:LABEL/OFFSET");
    assert_refused("[button \"a\"]\nline =\n", 2, "line: \"\"");
    assert_refused("[button \"a\"]\nkeys = spcae\n", 2, "keys: \"spcae\" is not a key; expected");
    assert_refused("[button \"a\"]\nkeys = space a SPACE\n", 2, "keys: \"SPACE\" is there twice");
    assert_refused("[button \"a\"]\nkeys =\n", 2, "keys: \"\" is not one to 32 names");
    assert_refused("[button \"a\"]\nactive_high = very\n", 2, "active_high: \"very\" is not yes");
    assert_refused("[button \"a\"]\nbias = up\n", 2,
                   "bias: \"up\" is not one of pull-up, pull-down");
    assert_refused("[button \"a\"]\nhold_ms = 10\n", 2,
                   "hold_ms: \"10\" is not a whole number from 50 to 60000");
    assert_refused("[button \"a\"]\ndebounce_ms = 1.5\n", 2, "debounce_ms: \"1.5\"");
    assert_refused("[button \"a\"]\npress = nxt\n", 2,
                   "press: unknown action \"nxt\"; expected none");
    assert_refused("[button \"a\"]\nhold = mode\n", 2, "hold: expected \"mode NAME\"");
    assert_refused("[button \"a\"]\nhold = next now\n", 2, "next takes no argument");
    assert_refused("[button \"a\"]\nchord = b\n", 2, "chord: \"b\" is not two or more");
}

static void keys_that_are_none_or_there_already(void **state) {
    (void)state;
    assert_refused("[button \"a\"]\nlien = X\n", 2,
                   "unknown key \"lien\" in [button]; expected line");
    assert_refused("[button \"a\"]\nshadow = pcf\n", 2,
                   "unknown key \"shadow\" in [button]; it is a key of [render], [mode \"NAME\"], "
                   "[light \"NAME\"]");
    assert_refused("[button \"a\"]\nline = X\n\nline = Y\n", 4, "line is set already, in line 2");
    assert_refused("[button \"a\"]\n[button \"b\"]\n[button \"a\"]\n", 3,
                   "button \"a\" is there already, in line 1");
}

static void what_two_buttons_cannot_share(void **state) {
    (void)state;
    assert_refused("[button \"a\"]\nline = X\npress = next\n[button \"b\"]\nline = X\n", 5,
                   "line: \"X\" is button \"a\"'s already, in line 2");
    assert_refused("[button \"a\"]\nkeys = a space\npress = next\n[button \"b\"]\nkeys = b A\n", 5,
                   "keys: \"A\" is button \"a\"'s already, in line 2");
}

static void buttons_that_are_nowhere_or_do_nothing(void **state) {
    (void)state;
    assert_refused("\n[button \"a\"]\npress = next\n", 2,
                   "button \"a\" has no source: set line, keys or chord");
    assert_refused("[button \"a\"]\nline = X\n", 1, "button \"a\" has no action: set press");
    assert_refused("[button \"a\"]\nkeys = a\nbias = none\npress = next\n", 3,
                   "bias: only a button with a line has one");
    assert_refused("[button \"a\"]\nkeys = a\nchord_ms = 50\npress = next\n", 3,
                   "chord_ms: only a chord has one");
}

static void chords_of_nothing(void **state) {
    (void)state;
    static const char two[] =
        "[button \"a\"]\nkeys = a\n[button \"b\"]\nkeys = b\n[button \"c\"]\n";
    char text[300];
    const struct {
        const char *rest, *says;
        int line;
    } wrong[] = {
        {"chord = a d\npress = next\n[button \"e\"]\nchord = a b\npress = next\n",
         "chord: there is no button \"d\"", 6},
        {"chord = a a\npress = next\n[button \"e\"]\nchord = a b\npress = next\n",
         "chord: \"a\" is there twice", 6},
        {"chord = a b\nhold = next\n", "hold: a chord has none", 7},
        {"chord = a b\nline = X\npress = next\n", "line: a chord has none", 7},
        {"chord = a b\n", "button \"c\" has no action", 5},
        {"chord = a b\npress = next\n[button \"d\"]\nchord = a c\npress = next\n",
         "chord: button \"c\" is a chord itself", 9},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        snprintf(text, sizeof text, "%s%s", two, wrong[i].rest);
        assert_refused(text, wrong[i].line, wrong[i].says);
    }
}

static void more_buttons_than_there_may_be(void **state) {
    (void)state;
    char text[4096] = "";
    size_t used = 0;
    for (int i = 0; i <= GN_BUTTONS_MAX; i++)
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "[button \"b%d\"]\nline = L%d\npress = next\n", i, i);
    assert_refused(text, 3 * GN_BUTTONS_MAX + 1, "more than 32 buttons");
}

static void want_of_memory_is_said(void **state) {
    (void)state;
    static const char text[] =
        "[button \"a\"]\nline = X\nkeys = a\npress = next\n"
        "[button \"b\"]\nkeys = b\n[button \"ab\"]\nchord = a b\npress = info\n";
    for (unsigned long n = 1; n < 100; n++) {
        gn_options_finish(&options);
        gn_options_init(&options, GN_COMMAND_SHOW);
        err = (struct gn_err){0};
        assert_true(gn_file_write(path, text, strlen(text), &err));
        gn_alloc_fail_at(n);
        const bool ok = gn_config_load(&options, path, NULL, &err);
        gn_alloc_fail_at(0);
        if (ok) return;
        assert_non_null(strstr(err.text, "memory"));
    }
    fail_msg("it never succeeds");
}

static int enter(void **state) {
    (void)state;
    const int fd = mkstemp(path);
    return fd >= 0 ? close(fd) : -1;
}

static int leave(void **state) {
    (void)state;
    gn_options_finish(&options);
    return unlink(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_without_buttons_has_none),
        cmocka_unit_test(every_key_arrives_where_it_belongs),
        cmocka_unit_test(what_a_chord_does_is_said_under_press),
        cmocka_unit_test(a_line_that_is_high_when_pressed_is_pulled_down),
        cmocka_unit_test(without_modes_the_techniques_are_modes),
        cmocka_unit_test(a_mode_may_stand_below_the_button_that_names_it),
        cmocka_unit_test(values_that_are_none),
        cmocka_unit_test(keys_that_are_none_or_there_already),
        cmocka_unit_test(what_two_buttons_cannot_share),
        cmocka_unit_test(buttons_that_are_nowhere_or_do_nothing),
        cmocka_unit_test(chords_of_nothing),
        cmocka_unit_test(more_buttons_than_there_may_be),
        cmocka_unit_test(want_of_memory_is_said),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
