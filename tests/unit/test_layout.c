#include <stdio.h>
#include <string.h>

#include "caption/layout.h"
#include "image/dice.h"
#include "unit/check.h"

enum { LINES = 16 };

static struct gn_layout_line lines[LINES];
static int32_t asked; /* how often for a width */

/* A character is 10 pixels wide, an M 20. */
static int32_t advance(void *data, uint32_t code) {
    (void)data;
    asked++;
    return code == 'M' ? 20 : 10;
}

static uint32_t build(const char *text, int32_t width_px, uint32_t most, bool wraps) {
    const struct gn_layout_opts opts = {
        .width_px = width_px, .most_lines = most, .wraps = wraps, .advance_px = advance};
    return gn_layout_build(&opts, text, text + strlen(text), lines);
}

static void expect(uint32_t i, const char *text, bool cut) {
    char line[100];
    snprintf(line, sizeof line, "%.*s", (int)(lines[i].end - lines[i].begin), lines[i].begin);
    assert_string_equal(line, text);
    assert_true(lines[i].cut == cut);
    int32_t width = cut ? 30 : 0;
    for (const char *c = text; *c; c++) width += *c == 'M' ? 20 : 10;
    assert_int_equal(lines[i].width_px, width);
}

static void expect_bytes(uint32_t i, const char *text) {
    assert_int_equal(lines[i].end - lines[i].begin, strlen(text));
    assert_memory_equal(lines[i].begin, text, strlen(text));
}

/* ---- characters ---- */

static void expect_codes(const char *text, const uint32_t *codes) {
    const char *end = text + strlen(text);
    for (; *codes; codes++) assert_int_equal(gn_layout_next(&text, end), *codes);
    assert_int_equal(gn_layout_next(&text, end), 0);
}
#define EXPECT_CODES(text, ...) expect_codes(text, (const uint32_t[]){__VA_ARGS__, 0})

static void test_utf8_is_read(void **state) {
    (void)state;
    EXPECT_CODES("a\xc3\xa4\xe2\x82\xac\xf0\x9f\x8c\x9e!", 'a', 0xe4, 0x20ac, 0x1f31e, '!');
    EXPECT_CODES("\xc2\xa0\xed\x9f\xbf\xee\x80\x80\xf0\x90\x80\x80", 0xa0, 0xd7ff, 0xe000, 0x10000);
}

/* Unicode 15, 3.9: as many as there are parts that could have begun a character. */
static void test_what_is_no_character_is_replaced(void **state) {
    (void)state;
    EXPECT_CODES("\xff", 0xfffd);
    EXPECT_CODES("\x80z", 0xfffd, 'z');
    EXPECT_CODES("\xc3z", 0xfffd, 'z');
    EXPECT_CODES("\xe2\x82", 0xfffd);
    EXPECT_CODES("\xe2\x82z", 0xfffd, 'z');
    EXPECT_CODES("\xc0\xaf", 0xfffd, 0xfffd); /* overlong */
    EXPECT_CODES("\xe0\x9f\x80", 0xfffd, 0xfffd, 0xfffd);
    EXPECT_CODES("\xed\xa0\x80", 0xfffd, 0xfffd, 0xfffd);             /* a surrogate */
    EXPECT_CODES("\xf4\x90\x80\x80", 0xfffd, 0xfffd, 0xfffd, 0xfffd); /* over 10ffff */
    EXPECT_CODES("\xf0\x80\x80\xaf", 0xfffd, 0xfffd, 0xfffd, 0xfffd);
}

static void test_what_is_not_seen_is_left_out(void **state) {
    (void)state;
    EXPECT_CODES("a\x1b[31mb", 'a', '[', '3', '1', 'm', 'b');
    EXPECT_CODES("a\x07\x7f\xc2\x85"
                 "b\r\n",
                 'a', 'b', '\n');
    EXPECT_CODES("a\xe2\x80\xae"
                 "b\xef\xbb\xbf\xe2\x80\x8b",
                 'a', 'b'); /* right to left, mark, 0 wide */
    EXPECT_CODES("a\tb", 'a', ' ', 'b');
}

static void test_nothing_behind_the_end_is_read(void **state) {
    (void)state;
    const char *text = "\xe2\x82\xac";
    const char *at = text;
    assert_int_equal(gn_layout_next(&at, text + 2), 0xfffd);
    assert_ptr_equal(at, text + 2);
    assert_int_equal(gn_layout_next(&at, text + 2), 0);
}

/* ---- lines ---- */

static void test_a_text_that_fits_is_a_line(void **state) {
    (void)state;
    assert_int_equal(build("seven", 50, 4, true), 1);
    expect(0, "seven", false);
    assert_int_equal(build("seven", 50, 1, false), 1);
    expect(0, "seven", false);
    assert_int_equal(build("", 50, 4, true), 0);
}

static void test_lines_break_between_words(void **state) {
    (void)state;
    assert_int_equal(build("one two three four", 100, 4, true), 2);
    expect(0, "one two", false);
    expect(1, "three four", false);
}

static void test_a_space_at_the_end_takes_no_room(void **state) {
    (void)state;
    assert_int_equal(build("four four", 40, 4, true), 2);
    expect(0, "four", false);
    expect(1, "four", false);
    assert_int_equal(build("four   four  ", 40, 4, true), 2);
    expect(1, "four", false);
}

static void test_long_words_break_within(void **state) {
    (void)state;
    assert_int_equal(build("a/very/long/path", 50, 8, true), 4);
    expect(0, "a/ver", false);
    expect(1, "y/lon", false);
    expect(2, "g/pat", false);
    expect(3, "h", false);
}

/* Thai vowels stay with their consonant; Chinese needs no space. */
static void test_marks_stay_and_chinese_breaks(void **state) {
    (void)state;
    assert_int_equal(build("ที่นี่", 40, 8, true), 2);
    expect_bytes(0, "ที่");
    expect_bytes(1, "นี่");
    assert_int_equal(build("go 日晷的影子", 70, 8, true), 2);
    expect_bytes(0, "go 日晷的影");
    expect_bytes(1, "子");
}

/* What is wider together than apart still fits. */
static int32_t wider(void *data, const char *begin, const char *end) {
    (void)data;
    int32_t width = 0;
    while (gn_layout_next(&begin, end)) width += 13;
    return width;
}

static void test_lines_fit_by_their_own_width(void **state) {
    (void)state;
    const struct gn_layout_opts opts = {.width_px = 100,
                                        .most_lines = LINES,
                                        .wraps = true,
                                        .advance_px = advance,
                                        .line_px = wider};
    const char *text = "four words that wrap";
    const uint32_t n = gn_layout_build(&opts, text, text + strlen(text), lines);
    assert_int_equal(n, 4);
    for (uint32_t i = 0; i < n; i++) {
        assert_true(lines[i].width_px <= 100);
        assert_int_equal(lines[i].width_px, 13 * (lines[i].end - lines[i].begin));
    }
}

static void test_newlines_break(void **state) {
    (void)state;
    assert_int_equal(build("one\n\ntwo\n", 90, 8, true), 3);
    expect(0, "one", false);
    expect(1, "", false);
    expect(2, "two", false);
}

static void test_wide_characters_count_as_wide(void **state) {
    (void)state;
    assert_int_equal(build("MMM MM", 70, 8, true), 2);
    expect(0, "MMM", false);
    expect(1, "MM", false);
}

static void test_lines_are_cut_where_they_do_not_wrap(void **state) {
    (void)state;
    assert_int_equal(build("a name that is long\nshort", 100, 8, false), 2);
    expect(0, "a name", true); /* the space before the gap is spared */
    expect(1, "short", false);
}

static void test_what_has_no_line_is_cut_off_the_last(void **state) {
    (void)state;
    assert_int_equal(build("one two three four five six", 90, 2, true), 2);
    expect(0, "one two", false);
    expect(1, "three", true); /* "three four" and a gap would be 130 */
    assert_int_equal(build("one\ntwo\nthree", 90, 2, false), 2);
    expect(1, "two", true);
    assert_int_equal(build("one two", 30, 1, true), 1);
    expect(0, "", true);
}

static void test_not_even_one_character_fits(void **state) {
    (void)state;
    assert_int_equal(build("abc", 5, 8, true), 3);
    assert_int_equal(build("abc", -100, 8, true), 3);
    assert_int_equal(build("abc", -100, 8, false), 1);
    assert_int_equal(build("abc", 0, 2, true), 2);
}

/* Any bytes, any room: lines in order and within the text, as wide as they say, and within the room
 * where that has room for a character and a gap. */
static void test_any_bytes(void **state) {
    (void)state;
    struct gn_dice dice = {7};
    static const char *const pieces[] = {" ",        "  ", "word", "\n", "\xc3\xa4",        "\xff",
                                         "\xe2\x82", "\t", "MM",   ".",  "\xf0\x9f\x8c\x9e"};
    for (int round = 0; round < 20000; round++) {
        char text[200] = "";
        const int count = (int)gn_dice_between(&dice, 0, 25);
        for (int i = 0; i < count; i++)
            if (gn_dice_between(&dice, 0, 4) < 1)
                strcat(text, (char[]){(char)gn_dice_between(&dice, 1, 256), 0});
            else
                strcat(text, pieces[(size_t)gn_dice_between(&dice, 0, 11)]);
        const int32_t room = (int32_t)gn_dice_between(&dice, 50, 300);
        const uint32_t most = (uint32_t)gn_dice_between(&dice, 1, LINES + 1);
        const uint32_t n = build(text, room, most, gn_dice_between(&dice, 0, 1) < 0.5);
        assert_true(n <= most);
        for (uint32_t i = 0; i < n; i++) {
            int32_t width = lines[i].cut ? 30 : 0;
            const char *at = lines[i].begin;
            assert_true(at >= text && lines[i].end >= at && lines[i].end <= text + strlen(text));
            if (i > 0) assert_true(at >= lines[i - 1].end);
            for (uint32_t code; (code = gn_layout_next(&at, lines[i].end)) != 0;) {
                assert_true(code != '\n' && code >= ' ');
                width += advance(NULL, code);
            }
            assert_int_equal(lines[i].width_px, width);
            assert_true(width <= room);
        }
    }
}

/* Work grows with the text, not with its square. */
static void test_a_long_text_is_quick(void **state) {
    (void)state;
    char text[2048];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    asked = 0;
    assert_int_equal(build(text, 300, LINES, true), LINES);
    assert_true(asked < 40 * (int32_t)sizeof text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_utf8_is_read),
        cmocka_unit_test(test_what_is_no_character_is_replaced),
        cmocka_unit_test(test_what_is_not_seen_is_left_out),
        cmocka_unit_test(test_nothing_behind_the_end_is_read),
        cmocka_unit_test(test_a_text_that_fits_is_a_line),
        cmocka_unit_test(test_lines_break_between_words),
        cmocka_unit_test(test_a_space_at_the_end_takes_no_room),
        cmocka_unit_test(test_long_words_break_within),
        cmocka_unit_test(test_marks_stay_and_chinese_breaks),
        cmocka_unit_test(test_lines_fit_by_their_own_width),
        cmocka_unit_test(test_newlines_break),
        cmocka_unit_test(test_wide_characters_count_as_wide),
        cmocka_unit_test(test_lines_are_cut_where_they_do_not_wrap),
        cmocka_unit_test(test_what_has_no_line_is_cut_off_the_last),
        cmocka_unit_test(test_not_even_one_character_fits),
        cmocka_unit_test(test_any_bytes),
        cmocka_unit_test(test_a_long_text_is_quick),
    };
    return RUN(tests);
}
