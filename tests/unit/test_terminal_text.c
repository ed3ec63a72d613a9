/* Reports on a terminal: lines that are too long go on below their last column, nothing is lost,
 * and what goes elsewhere stays as it is. */
#include "unit/check.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/terminal.h"

static char *formatted;
static size_t formatted_size;

static const char *format(const char *text, int columns, bool colours) {
    free(formatted);
    formatted = NULL;
    FILE *to = open_memstream(&formatted, &formatted_size);
    gn_terminal_format(text, columns, colours, to);
    fclose(to);
    return formatted;
}

static int finish(void **state) {
    (void)state;
    free(formatted);
    return 0;
}

static void lines_go_on_below_their_last_column(void **state) {
    (void)state;
    assert_string_equal(format("  board       a board of a long name, 8 GB\n", 40, false),
                        "  board       a board of a long name, 8\n              GB\n");
    assert_string_equal(
        format("  version     one\n  map formats depth r32ui r16f r16f-raw rgba8\n", 40, false),
        "  version     one\n  map formats depth r32ui r16f r16f-raw\n              rgba8\n");
    assert_string_equal(format("  1. a fault with a text that is longer than that\n", 40, false),
                        "  1. a fault with a text that is longer\n     than that\n");
    assert_string_equal(format("     cure: load the kernel driver of the display\n", 40, false),
                        "     cure: load the kernel driver of the\n     display\n");
    assert_string_equal(format("a long line without any indentation at all\n", 40, false),
                        "a long line without any indentation at\nall\n");
}

static void a_word_is_never_broken(void **state) {
    (void)state;
    static const char path[] = "  file        /a/path/that/is/longer/than/any/terminal/is/wide\n";
    assert_string_equal(format(path, 40, false), path);
}

static void characters_count_and_not_bytes(void **state) {
    (void)state;
    static const char line[] = "  name        \xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6\xc3\xbc "
                               "\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6\xc3\xbc end-of-it!!\n";
    assert_string_equal(format(line, 40, false), line);
}

static void what_is_not_a_terminals_stays(void **state) {
    (void)state;
    static const char text[] =
        "Machine\n  limits      a=1, b=2, c=3, d=4, e=5, f=6, g=7, h=8, i=9, "
        "j=10, k=11, l=12, m=13, n=14, o=15, p=16, q=17\n\nProblems\n  none";
    assert_string_equal(format(text, 0, false), text);
    FILE *file = tmpfile();
    struct gn_terminal terminal;
    assert_ptr_equal(gn_terminal_begin(&terminal, file), file);
    gn_terminal_end(&terminal);
    assert_int_equal(gn_terminal_columns(file), 0);
    assert_string_equal(gn_terminal_tint(file, GN_TINT_RED), "");
    fclose(file);
}

static void headings_are_bold_and_problems_red(void **state) {
    (void)state;
    assert_string_equal(
        format("A sentence.\n\nKeys\n  1. no problem\n\nProblems\n  1. a\n     cure: b\n", 0, true),
        "A sentence.\n\n\33[1mKeys\33[m\n  1. no problem\n\n\33[1mProblems\33[m\n\33[31m  1. "
        "a\33[m\n     cure: b\n");
    assert_string_equal(format("Problems\n  none\n", 0, true),
                        "\33[1mProblems\33[m\n\33[32m  none\33[m\n");
}

static void a_bar_has_what_is_left(void **state) {
    (void)state;
    char bar[100];
    gn_terminal_write_bar(bar, sizeof bar, 5, 10, 3);
    assert_string_equal(bar, "[##########..........] 5 of 10, 3 s left");
    gn_terminal_write_bar(bar, sizeof bar, 0, 10, 3);
    assert_string_equal(bar, "[....................] 0 of 10");
    gn_terminal_write_bar(bar, sizeof bar, 1, 30, 2);
    assert_string_equal(bar, "[....................] 1 of 30, 58 s left");
    gn_terminal_write_bar(bar, sizeof bar, 30, 30, 2);
    assert_string_equal(bar, "[####################] 30 of 30, 0 s left");
}

/* Random lines of words, with and without labels. */
static void nothing_is_lost_and_no_line_is_longer(void **state) {
    (void)state;
    srand(36);
    for (int i = 0; i < 2000; i++) {
        char text[400] = "", got[800], *at = text;
        const int columns = 40 + rand() % 100, words = rand() % 40;
        at += sprintf(at, "%*s", rand() % 7, "");
        for (int w = 0; w < words && at - text < 380; w++)
            at += sprintf(at, "%.*s%s", 1 + rand() % 9, "abcdefghi", rand() % 8 ? " " : "   ");
        strcpy(got, format(text, columns, false));
        for (char *line = strtok(got, "\n"); line; line = strtok(NULL, "\n"))
            if ((int)strlen(line) > columns + 1)
                fail_msg("%d: \"%s\" of \"%s\"", columns, line, text);
        const char *a = text, *b = formatted;
        for (;; a++, b++) {
            while (isspace((unsigned char)*a)) a++;
            while (isspace((unsigned char)*b)) b++;
            assert_int_equal(*a, *b);
            if (!*a) break;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_go_on_below_their_last_column),
        cmocka_unit_test(a_word_is_never_broken),
        cmocka_unit_test(characters_count_and_not_bytes),
        cmocka_unit_test(what_is_not_a_terminals_stays),
        cmocka_unit_test(headings_are_bold_and_problems_red),
        cmocka_unit_test(a_bar_has_what_is_left),
        cmocka_unit_test(nothing_is_lost_and_no_line_is_longer),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
