#include "input/script.h"

#include <string.h>

#include "check.h"

static struct gn_arena arena;
static struct gn_script script;

static int teardown(void **state) {
    (void)state;
    gn_arena_finish(&arena);
    return 0;
}

static bool parse(const char *text, struct gn_err *err) {
    return gn_script_parse(text, strlen(text), "a.script", &arena, &script, err);
}

static void assert_line(int i, int64_t time_ns, enum gn_script_what what, const char *name,
                        int number) {
    assert_true(i < script.count);
    assert_true(script.lines[i].time_ns == time_ns);
    assert_int_equal(script.lines[i].what, what);
    assert_string_equal(script.lines[i].name, name);
    assert_int_equal(script.lines[i].number, number);
}

static void test_lines_are_times_deeds_and_names(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_true(parse("# as if somebody pressed\n\n0 down next\r\n"
                      "  .25\tup  next  \n1.000000001 click the left one\n60. click f1",
                      &err));
    assert_int_equal(script.count, 4);
    assert_line(0, 0, GN_SCRIPT_DOWN, "next", 3);
    assert_line(1, 250000000, GN_SCRIPT_UP, "next", 4);
    assert_line(2, 1000000001, GN_SCRIPT_CLICK, "the left one", 5);
    assert_line(3, INT64_C(60000000000), GN_SCRIPT_CLICK, "f1", 6);
}

static void test_nothing_is_a_script(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_true(gn_script_parse(NULL, 0, "a", &arena, &script, &err));
    assert_int_equal(script.count, 0);
    assert_true(parse("\n\n# no more\n", &err));
    assert_int_equal(script.count, 0);
}

static void test_what_is_wrong_is_named_with_its_line(void **state) {
    (void)state;
    static const struct {
        const char *text, *says;
    } rows[] = {
        {"0 down a\nnow up a", "a.script:2: missing time"},
        {"-1 down a", "a.script:1: missing time"},
        {"1e3 down a", "missing time"},
        {". down a", "missing time"},
        {"1.5.2 down a", "missing time"},
        {"99999999999999999999 down a", "missing time"},
        {"1 press a", "unknown action"},
        {"1", "unknown action"},
        {"1 down", "missing button or key"},
        {"1 down  \t ", "missing button or key"},
        {"2 down a\n1.999 up a", "a.script:2: time is earlier than that of the line before"},
        {"1 down aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
         "missing button or key"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct gn_err err = {0};
        assert_false(parse(rows[i].text, &err));
        assert_int_equal(err.status, GN_EXIT_USAGE);
        if (!strstr(err.text, rows[i].says)) fail_msg("%s: not %s", err.text, rows[i].says);
    }
}

static void test_a_zero_inside_is_no_name(void **state) {
    (void)state;
    struct gn_err err = {0};
    assert_false(gn_script_parse("1 down a\0b", 10, "a", &arena, &script, &err));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_lines_are_times_deeds_and_names, teardown),
        cmocka_unit_test_teardown(test_nothing_is_a_script, teardown),
        cmocka_unit_test_teardown(test_what_is_wrong_is_named_with_its_line, teardown),
        cmocka_unit_test_teardown(test_a_zero_inside_is_no_name, teardown),
    };
    return RUN(tests);
}
