/* What a report says of values that JSON has no word for. */
#include <math.h>
#include <stdlib.h>

#include "core/json.h"
#include "unit/check.h"

static void assert_is(json_t *value, const char *expected) {
    char *text = json_dumps(value, JSON_ENCODE_ANY);
    assert_string_equal(text, expected);
    free(text);
    json_decref(value);
}

static void test_what_is_no_number_is_null(void **state) {
    (void)state;
    assert_is(gn_json_make_number(0.5), "0.5");
    assert_is(gn_json_make_number(NAN), "null");
    assert_is(gn_json_make_number(-INFINITY), "null");
}

static void test_what_is_no_text_is_null_or_a_question(void **state) {
    (void)state;
    assert_is(gn_json_make_text("sun"), "\"sun\"");
    assert_is(gn_json_make_text(""), "\"\"");
    assert_is(gn_json_make_text(NULL), "null");
    assert_is(gn_json_make_text("s\xfcn"), "\"?\"");
}

static void test_a_count_is_whole(void **state) {
    (void)state;
    assert_is(gn_json_make_count(1ull << 53), "9007199254740992");
}

static void test_a_report_has_no_control_characters(void **state) {
    (void)state;
    /* ESC, DEL, U+009B (a terminal's CSI), U+202E (right to left) and a name that is right */
    static const char text[] = "\x1b[1m\x7f \xc2\x9b \xe2\x80\xae M\xc3\xbcller";
    char *printed = NULL;
    size_t size;
    FILE *to = open_memstream(&printed, &size);
    assert_true(gn_json_print(json_pack("{s:s, s:[f]}", text, text, "n", 0.5), 9, to, NULL));
    fclose(to);
    assert_string_equal(printed, "{\n"
                                 "  \"\\u001B[1m\\u007f \\u009b \\u202e M\xc3\xbcller\": "
                                 "\"\\u001B[1m\\u007f \\u009b \\u202e M\xc3\xbcller\",\n"
                                 "  \"n\": [\n    0.5\n  ]\n}\n");
    json_t *back = json_loads(printed, 0, NULL);
    assert_string_equal(json_string_value(json_object_get(back, text)), text);
    json_decref(back);
    free(printed);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_no_number_is_null),
        cmocka_unit_test(test_what_is_no_text_is_null_or_a_question),
        cmocka_unit_test(test_a_count_is_whole),
        cmocka_unit_test(test_a_report_has_no_control_characters),
    };
    return RUN(tests);
}
