#include "unit/check.h"

#include <stdio.h>
#include <string.h>

#include "kiosk/control/request.h"

static struct gn_request request;
static struct gn_err err;

static bool parse(const char *line) {
    err = (struct gn_err){0};
    return gn_request_parse(line, strlen(line), &request, &err);
}

static void assert_wrong(const char *line, const char *says) {
    if (parse(line)) fail_msg("taken: %s", line);
    if (!strstr(err.text, says)) fail_msg("%s: \"%s\" is not \"%s\"", line, err.text, says);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

static void every_command_is_read(void **state) {
    (void)state;
    for (int i = 0; i < GN_CTL_COUNT; i++) {
        char line[200];
        size_t used = (size_t)snprintf(line, sizeof line, "{\"cmd\":\"%s\"", gn_ctl_rows[i].name);
        const int words = gn_ctl_words((enum gn_ctl)i);
        for (int w = 0; w < words; w++)
            used += (size_t)snprintf(line + used, sizeof line - used, ",\"%s\":\"w%d\"",
                                     gn_ctl_rows[i].members[w], w);
        snprintf(line + used, sizeof line - used, "}");
        if (!parse(line)) fail_msg("%s: %s", line, err.text);
        assert_int_equal(request.command, i);
        for (int w = 0; w < GN_CTL_WORDS_MAX; w++)
            if (w >= words)
                assert_null(request.words[w]);
            else
                assert_int_equal(request.words[w][1], '0' + w);
    }
}

static void a_value_may_be_a_number_or_a_boolean(void **state) {
    (void)state;
    assert_true(parse("{\"cmd\":\"set\",\"key\":\"a\",\"value\":-2}"));
    assert_string_equal(request.words[1], "-2");
    assert_true(parse("{\"cmd\":\"set\",\"key\":\"a\",\"value\":0.25}"));
    assert_string_equal(request.words[1], "0.25");
    assert_true(parse("{\"cmd\":\"set\",\"key\":\"a\",\"value\":true}"));
    assert_string_equal(request.words[1], "yes");
    assert_true(parse(" {\"value\":false , \"key\":\"a\",\"cmd\":\"set\"}\r"));
    assert_string_equal(request.words[1], "no");
    assert_wrong("{\"cmd\":\"set\",\"key\":1,\"value\":1}", "set: expected a string as \"key\"");
    assert_wrong("{\"cmd\":\"set\",\"key\":\"a\",\"value\":[1]}", "or a number, true or false");
    assert_wrong("{\"cmd\":\"set\",\"key\":\"a\",\"value\":null}", "\"value\"");
}

static void what_is_no_request_is_explained(void **state) {
    (void)state;
    assert_wrong("", "not JSON");
    assert_wrong("next", "not JSON");
    assert_wrong("{\"cmd\":\"next\"", "not JSON");
    assert_wrong("{\"cmd\":\"next\"}x", "not JSON");
    assert_wrong("{\"cmd\":\"next\",\"cmd\":\"prev\"}", "duplicate");
    assert_wrong("{\"cmd\":\"\\u0000\"}", "not JSON");
    assert_wrong("{\"cmd\":\"\xff\"}", "not JSON");
    assert_wrong("[]", "expected an object");
    assert_wrong("\"next\"", "not JSON");
    assert_wrong("{}", "expected {\"cmd\":\"..\"}");
    assert_wrong("{\"cmd\":1}", "expected {\"cmd\":\"..\"}");
    assert_wrong("{\"cmd\":\"nxt\"}", "unknown command \"nxt\"; did you mean next?");
    assert_wrong("{\"cmd\":\"frobnicate\"}", "expected one of next, prev, mode NAME,");
    assert_wrong("{\"cmd\":\"mode\"}", "mode: expected a string as \"name\"");
    assert_wrong("{\"cmd\":\"next\",\"name\":\"x\"}", "next: unknown member \"name\"");
}

static void brackets_in_brackets_end_early(void **state) {
    (void)state;
    char line[GN_REQUEST_LINE_MAX + 1];
    memset(line, '[', sizeof line - 1);
    line[sizeof line - 1] = '\0';
    assert_wrong(line, "nested deeper than 4");
    assert_wrong("{\"cmd\":[[[[1]]]]}", "nested deeper than 4");
    assert_wrong("{\"cmd\":[[[1]]]}", "expected {\"cmd\"");
    assert_true(parse("{\"cmd\":\"mode\",\"name\":\"[[[[[[\\\"[[[\"}"));
    assert_string_equal(request.words[0], "[[[[[[\"[[[");
}

static void the_longest_line_fits_and_one_byte_more_does_not(void **state) {
    (void)state;
    char line[GN_REQUEST_LINE_MAX + 2];
    const size_t head = (size_t)snprintf(line, sizeof line, "{\"cmd\":\"mode\",\"name\":\"");
    memset(line + head, 'x', sizeof line - head);
    memcpy(line + GN_REQUEST_LINE_MAX - 2, "\"}", 2);
    assert_true(gn_request_parse(line, GN_REQUEST_LINE_MAX, &request, &err));
    assert_int_equal(strlen(request.words[0]), GN_REQUEST_LINE_MAX - 2 - head);
    memcpy(line + GN_REQUEST_LINE_MAX - 2, "x\"}", 3);
    assert_false(gn_request_parse(line, GN_REQUEST_LINE_MAX + 1, &request, &err));
    assert_non_null(strstr(err.text, "longer than 4096 bytes"));
}

static void a_zero_byte_is_no_end(void **state) {
    (void)state;
    assert_false(gn_request_parse("{\"cmd\":\"next\"}\0", 15, &request, &err));
    assert_false(gn_request_parse("\0", 1, &request, &err));
}

static void a_failure_is_one_line_of_utf_8(void **state) {
    (void)state;
    gn_fail(&err, "no file \"\xff\xfe\" here\n");
    json_t *reply = gn_reply_failure(&err);
    char *text = json_dumps(reply, JSON_COMPACT);
    assert_non_null(text);
    assert_string_equal(text, "{\"ok\":false,\"error\":\"no file \\\"??\\\" here\",\"status\":1}");
    free(text);
    json_decref(reply);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_command_is_read),
        cmocka_unit_test(a_value_may_be_a_number_or_a_boolean),
        cmocka_unit_test(what_is_no_request_is_explained),
        cmocka_unit_test(brackets_in_brackets_end_early),
        cmocka_unit_test(the_longest_line_fits_and_one_byte_more_does_not),
        cmocka_unit_test(a_zero_byte_is_no_end),
        cmocka_unit_test(a_failure_is_one_line_of_utf_8),
    };
    return RUN(tests);
}
