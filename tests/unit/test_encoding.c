/* URIs and what stands in them. */
#include "unit/check.h"

#include <string.h>

#include "core/encoding.h"

static void test_a_uri_names_files_in_the_order_of_likelihood(void **state) {
    (void)state;
    static const char *const names[] = {"50% off.bin?v=3", "50%25 off.bin?v=3", "50% off.bin",
                                        "50%25 off.bin"};
    char out[40];
    for (int i = 0; i < 4; i++) {
        assert_int_equal(gn_uri_name("50%25 off.bin?v=3", i, out), strlen(names[i]));
        assert_string_equal(out, names[i]);
    }
    assert_int_equal(gn_uri_name("50%25 off.bin?v=3", 4, out), 0);
    assert_int_equal(gn_uri_name("a\\b", 0, out), 3);
    assert_string_equal(out, "a/b");
    assert_int_equal(gn_uri_name("a\\b", 2, out), 0);
    assert_int_equal(gn_uri_name("a%00b", 0, out), 3);
    assert_int_equal(gn_uri_name("", 0, out), 0);
}

static void test_base64_may_be_percent_encoded_and_broken_into_lines(void **state) {
    (void)state;
    static const char *const uris[] = {"data:;base64,Z25vbW9uIQ==",
                                       "data:;base64,Z25vbW9uIQ",
                                       "data:;base64,Z25v\r\nbW9u\nIQ==",
                                       "data:;base64,Z25vbW9uIQ%3D%3D",
                                       "data:;base64,%5a25vbW9uIQ%3d%3d",
                                       "data:text/plain,gnomon!",
                                       "data:,gnomon%21"};
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        uint8_t out[40];
        size_t size = 0;
        const char *why = "";
        if (!gn_data_uri_decode(uris[i], out, &size, &why)) fail_msg("%s: %s", uris[i], why);
        assert_int_equal(size, 7);
        assert_memory_equal(out, "gnomon!", 7);
    }
}

static void test_other_base64_is_refused(void **state) {
    (void)state;
    static const char *const uris[] = {"data:;base64", "data:;base64,Z", "data:;base64,Z2=v",
                                       "data:;base64,%Z25v", "data:;base64,Z25_"};
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        uint8_t out[40];
        size_t size;
        const char *why = "";
        if (gn_data_uri_decode(uris[i], out, &size, &why)) fail_msg("%s", uris[i]);
        assert_true(why[0]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_uri_names_files_in_the_order_of_likelihood),
        cmocka_unit_test(test_base64_may_be_percent_encoded_and_broken_into_lines),
        cmocka_unit_test(test_other_base64_is_refused),
    };
    return RUN(tests);
}
