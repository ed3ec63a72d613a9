#include "input/terminal_keys.h"

#include <stdio.h>
#include <string.h>

#include "check.h"
#include "core/key.h"

#define MS INT64_C(1000000)

/* The names of the keys that these bytes are, a space between two; the time stands still. */
static const char *read_all(const char *bytes, size_t size) {
    static char names[400];
    struct gn_terminal_keys keys = {0};
    size_t used = 0;
    names[0] = '\0';
    for (size_t i = 0; i <= size; i++) {
        char buffer[16];
        const unsigned key = i < size ? gn_terminal_keys_step(&keys, (uint8_t)bytes[i], 0)
                                      : gn_terminal_keys_wait(&keys, 50 * MS);
        if (key)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? " " : "",
                                     gn_key_name(key, buffer, sizeof buffer));
    }
    return names;
}
#define READ(bytes) read_all(bytes, sizeof(bytes) - 1)

static void test_what_is_typed_are_keys(void **state) {
    (void)state;
    assert_string_equal(READ("nP q1!0\r\n\t\x7f\b"),
                        "n p space q 1 1 0 enter enter tab backspace backspace");
    assert_string_equal(READ("-=[];'`\\,./"), "minus equal leftbrace rightbrace semicolon "
                                              "apostrophe grave backslash comma dot slash");
    assert_string_equal(READ("_+{}:\"~|<>?"), "minus equal leftbrace rightbrace semicolon "
                                              "apostrophe grave backslash comma dot slash");
}

static void test_every_letter_is_its_key(void **state) {
    (void)state;
    for (char letter = 'a'; letter <= 'z'; letter++) {
        const char text[] = {letter, '\0'};
        assert_string_equal(read_all(text, 1), text);
    }
}

static void test_sequences_are_one_key(void **state) {
    (void)state;
    assert_string_equal(READ("\33[A\33[B\33[C\33[D\33[H\33[F"), "up down right left home end");
    assert_string_equal(READ("\33OA\33OB\33OC\33OD\33OH\33OF"), "up down right left home end");
    assert_string_equal(READ("\33[1~\33[4~\33[5~\33[6~\33[7~\33[8~"),
                        "home end pageup pagedown home end");
    assert_string_equal(READ("\33[2~\33[3~"), "insert delete");
    assert_string_equal(READ("\33OP\33OQ\33OR\33OS"), "f1 f2 f3 f4");
    assert_string_equal(READ("\33[11~\33[15~\33[17~\33[21~\33[23~\33[24~\33[34~"),
                        "f1 f5 f6 f10 f11 f12 f20");
    assert_string_equal(READ("\33[[A\33[[E"), "f1 f5"); /* the Linux console */
}

static void test_modifiers_change_nothing(void **state) {
    (void)state;
    assert_string_equal(READ("\33[1;5A\33[5;2~\33[1;2P\33[Z"), "up pageup f1 tab");
    assert_string_equal(READ("\33n"), "n"); /* with alt */
}

static void test_a_lone_escape_is_a_key_when_nothing_follows(void **state) {
    (void)state;
    struct gn_terminal_keys keys = {0};
    assert_true(gn_terminal_keys_deadline(&keys) == INT64_MAX);
    assert_int_equal(gn_terminal_keys_step(&keys, 27, 10 * MS), GN_KEY_NONE);
    assert_true(gn_terminal_keys_deadline(&keys) == 60 * MS);
    assert_int_equal(gn_terminal_keys_wait(&keys, 59 * MS), GN_KEY_NONE);
    assert_int_equal(gn_terminal_keys_wait(&keys, 60 * MS), GN_KEY_ESC);
    assert_int_equal(gn_terminal_keys_wait(&keys, 200 * MS), GN_KEY_NONE);
    assert_string_equal(READ("\33\33"), "esc esc");
    assert_string_equal(READ("\33\33[A"), "esc up");
}

static void test_what_means_nothing_is_swallowed_whole(void **state) {
    (void)state;
    assert_string_equal(READ("\33[200~a\33[201~"), "a");            /* a paste */
    assert_string_equal(READ("\33[?1;2c\33[<0;10;20Mx\33[I"), "x"); /* reports, a mouse */
    assert_string_equal(READ("\xc3\xa4z"), "z");                    /* an umlaut */
    assert_string_equal(READ("\33[99999999999999999~b"), "b");
    assert_string_equal(READ("\33[5"), ""); /* cut */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_typed_are_keys),
        cmocka_unit_test(test_every_letter_is_its_key),
        cmocka_unit_test(test_sequences_are_one_key),
        cmocka_unit_test(test_modifiers_change_nothing),
        cmocka_unit_test(test_a_lone_escape_is_a_key_when_nothing_follows),
        cmocka_unit_test(test_what_means_nothing_is_swallowed_whole),
    };
    return RUN(tests);
}
