#include "unit/check.h"

#include "core/embedded.h"
#include "core/err.h"
#include "core/library.h"
#include "core/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static void distance_counts_edits(void **state) {
    (void)state;
    assert_int_equal(gn_text_distance("", ""), 0);
    assert_int_equal(gn_text_distance("", "abc"), 3);
    assert_int_equal(gn_text_distance("render", "rendr"), 1);
    assert_int_equal(gn_text_distance("kitten", "sitting"), 3);
    assert_int_equal(gn_text_distance("sitting", "kitten"), 3);
}

static void two_neighbours_that_changed_places_are_one_edit(void **state) {
    (void)state;
    assert_int_equal(gn_text_distance("pfc", "pcf"), 1);
    assert_int_equal(gn_text_distance("stauts", "status"), 1);
    assert_int_equal(gn_text_distance("ca", "abc"), 3); /* an edited pair is not edited again */
}

static const char *guess_of(const char *word) {
    static const char *const names[] = {"aov", "ctl", "show", "shadow", "pcf", "pcf2", "caption"};
    struct gn_text_guess guess = {0};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) gn_text_guess(&guess, word, names[i]);
    return guess.name ? guess.name : "";
}

static void a_guess_is_near(void **state) {
    (void)state;
    assert_string_equal(guess_of("pfc"), "pcf");
    assert_string_equal(guess_of("pcf"), "pcf");
    assert_string_equal(guess_of("shdaow"), "shadow");
    assert_string_equal(guess_of("captain"), "caption");
    assert_string_equal(guess_of("foo"), "");
    assert_string_equal(guess_of("help"), "");
    assert_string_equal(guess_of(""), "");
}

/* Of a process that may open nothing more. */
static void a_library_that_does_not_load_is_told_from_a_missing_one(void **state) {
    (void)state;
    struct gn_err err = {0};
    struct rlimit old;
    assert_null(gn_library_open("libgnomon-none.so.1", "libnone", &err));
    assert_string_equal(err.text, "libgnomon-none.so.1 is missing; install libnone");
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &old), 0);
    struct rlimit none = {.rlim_cur = 0, .rlim_max = old.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    void *library = gn_library_open("libanl.so.1", "libc6", &err);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &old), 0);
    if (library) skip();
    if (!strstr(err.text, "libanl.so.1 cannot be loaded (") || !strstr(err.text, "open files"))
        fail_msg("%s", err.text);
}

static void long_texts_are_safe(void **state) {
    (void)state;
    char a[4000], b[4000];
    memset(a, 'a', sizeof a);
    memset(b, 'b', sizeof b);
    a[sizeof a - 1] = b[sizeof b - 1] = '\0';
    assert_int_equal(gn_text_distance(a, b), 31);
}

static void expect_printed(const char *text, const char *wanted) {
    char *printed = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&printed, &size);
    gn_text_print(text, to);
    fclose(to);
    assert_string_equal(printed, wanted);
    free(printed);
}

static void what_moves_the_cursor_or_turns_a_line_is_escaped(void **state) {
    (void)state;
    expect_printed("a\x1b[31m\n\x7f \xc2\x9b \xe2\x80\xae \xd8\x9c \xc3\xa9 \\",
                   "a\\u001b[31m\\u000a\\u007f \\u009b \\u202e \\u061c \xc3\xa9 \\");
    expect_printed("a\xc2\x80"
                   "b\xc2\x9f"
                   "c\xc2\xa0",
                   "a\\u0080b\\u009fc\xc2\xa0");
    expect_printed("a\u200e\u200f"
                   "b\u2028\u202a\u202e"
                   "c\u2066\u2069\u061c",
                   "a\\u200e\\u200fb\\u2028\\u202a\\u202ec\\u2066\\u2069\\u061c");
    static const char others[] = "\u200d\u2010\u2027\u202f\u2065\u206a\u05d0";
    expect_printed(others, others);
    expect_printed("a\xe2", "a\xe2");
    expect_printed("a\xe2\x80", "a\xe2\x80");
    struct gn_err err = {0};
    gn_fail(&err, "%s: no", "a\u202egpj.exe");
    assert_string_equal(err.text, "a\\u202egpj.exe: no");
}

static void a_line_is_added_whole_or_not_at_all(void **state) {
    (void)state;
    char text[12] = "";
    gn_text_add_line(text, sizeof text, "\r\n", "%d", 1234567);
    assert_string_equal(text, "1234567\r\n");
    gn_text_add_line(text, sizeof text, "\r\n", "x");
    assert_string_equal(text, "1234567\r\n"); /* the zero has no room beside the end */
    gn_text_add_line(text, sizeof text, "\n", "x");
    assert_string_equal(text, "1234567\r\nx\n");
}

static void embedded_files_are_found_and_end_with_zero(void **state) {
    (void)state;
    assert_null(gn_embedded_find("no such file"));
    int count = 0;
    for (const struct gn_embedded *e = gn_embedded_table; e->name; e++, count++) {
        assert_ptr_equal(gn_embedded_find(e->name), e);
        assert_int_equal(e->data[e->size], 0);
    }
    assert_true(count > 0);
    const struct gn_embedded *sundial = gn_embedded_find("sundial.glb");
    assert_non_null(sundial);
    assert_memory_equal(sundial->data, "glTF", 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_counts_edits),
        cmocka_unit_test(two_neighbours_that_changed_places_are_one_edit),
        cmocka_unit_test(a_guess_is_near),
        cmocka_unit_test(what_moves_the_cursor_or_turns_a_line_is_escaped),
        cmocka_unit_test(a_library_that_does_not_load_is_told_from_a_missing_one),
        cmocka_unit_test(long_texts_are_safe),
        cmocka_unit_test(a_line_is_added_whole_or_not_at_all),
        cmocka_unit_test(embedded_files_are_found_and_end_with_zero),
    };
    return RUN(tests);
}
