#include "unit/check.h"

#include <string.h>

#include "core/err.h"

static void failing_returns_false_and_tells(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_false(gn_fail(&err, "%s: line %d", "a.gltf", 3));
    assert_string_equal(err.text, "a.gltf: line 3");
    assert_int_equal(err.status, GN_EXIT_RUNTIME);
    assert_false(gn_fail_usage(&err, "--size"));
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

static void nobody_needs_to_listen(void **state) {
    (void)state;
    assert_false(gn_fail(NULL, "x"));
    assert_false(gn_fail_usage(NULL, "x"));
    assert_false(gn_fail_prefix(NULL, "x"));
}

static void a_prefix_keeps_the_status(void **state) {
    (void)state;
    struct gn_err err = {0};
    gn_fail_usage(&err, "not a number");
    assert_false(gn_fail_prefix(&err, "%s:%d", "kiosk.ini", 7));
    assert_string_equal(err.text, "kiosk.ini:7: not a number");
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

static void control_characters_are_escaped(void **state) {
    (void)state;
    struct gn_err err = {0};
    gn_fail(&err, "a\nb\x1b[31mc\x7f"
                  "d\xc2\x9b"
                  "e\t\xc3\xa9\r\n");
    assert_string_equal(err.text, "a b\\u001b[31mc\\u007fd\\u009be \xc3\xa9");

    /* a name that becomes six times as long does not push the reason out */
    char name[300];
    memset(name, '\x1b', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    gn_fail(&err, "%s: no such file", name);
    assert_memory_equal(err.text, "\\u001b\\u001b", 12);
    assert_non_null(strstr(err.text, "..."));
    assert_string_equal(err.text + strlen(err.text) - 14, ": no such file");
    for (const char *c = err.text; *c; c++) assert_true(*c >= ' ');
}

static void a_long_text_is_cut_at_a_whole_character(void **state) {
    (void)state;
    struct gn_err err = {0};
    char text[2000];
    for (size_t lead = 0; lead < 4; lead++) {
        memset(text, 'x', lead);
        for (size_t i = lead; i + 4 < sizeof text; i += 3) memcpy(text + i, "\xe2\x82\xac", 4);
        gn_fail(&err, "%s", text);
        assert_int_equal((strlen(err.text) - lead) % 3, 0);
        assert_in_range(strlen(err.text), sizeof err.text - 4, sizeof err.text - 1);
    }
}

static void a_long_name_does_not_push_the_reason_out(void **state) {
    (void)state;
    struct gn_err err = {0};
    char name[4096];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    gn_fail(&err, "first/%s: cannot write: disk full", name);
    assert_memory_equal(err.text, "first/xxx", 9);
    assert_non_null(strstr(err.text, "x...x"));
    assert_string_equal(err.text + strlen(err.text) - 26, "x: cannot write: disk full");
    gn_fail_prefix(&err, "%s", name);
    assert_string_equal(err.text + strlen(err.text) - 26, "x: cannot write: disk full");
}

static void a_text_that_just_fits_is_whole(void **state) {
    (void)state;
    struct gn_err err = {0};
    char text[sizeof err.text];
    memset(text, 'x', sizeof text);
    memcpy(text + sizeof text - 4, "\xe2\x82\xac", 4);
    gn_fail(&err, "%s", text);
    assert_string_equal(err.text, text);
}

static void a_prefix_on_a_full_text_cuts_the_end(void **state) {
    (void)state;
    struct gn_err err = {0};
    char text[sizeof err.text];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    gn_fail(&err, "%s", text);
    gn_fail_prefix(&err, "p");
    assert_int_equal(strlen(err.text), sizeof err.text - 1);
    assert_memory_equal(err.text, "p: xxx", 6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failing_returns_false_and_tells),
        cmocka_unit_test(nobody_needs_to_listen),
        cmocka_unit_test(a_prefix_keeps_the_status),
        cmocka_unit_test(control_characters_are_escaped),
        cmocka_unit_test(a_long_text_is_cut_at_a_whole_character),
        cmocka_unit_test(a_long_name_does_not_push_the_reason_out),
        cmocka_unit_test(a_text_that_just_fits_is_whole),
        cmocka_unit_test(a_prefix_on_a_full_text_cuts_the_end),
    };
    return RUN(tests);
}
