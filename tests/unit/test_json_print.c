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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_no_number_is_null),
        cmocka_unit_test(test_what_is_no_text_is_null_or_a_question),
        cmocka_unit_test(test_a_count_is_whole),
    };
    return RUN(tests);
}
