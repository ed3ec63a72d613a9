#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/warn.h"

static char *printed(struct gn_warnings *warnings) {
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    gn_warn_print(warnings, to);
    fclose(to);
    return text;
}

static void equal_texts_count_once(void **state) {
    (void)state;
    struct gn_warnings warnings = {0};
    gn_warn(&warnings, "node %d", 1);
    gn_warn(&warnings, "node %d", 2);
    gn_warn(&warnings, "node\n%d", 1);
    char *text = printed(&warnings);
    assert_int_equal(warnings.count, 2);
    assert_string_equal(text, "gnomon: warning: node 1\ngnomon: warning: node 2\n");
    free(text);
}

static void more_than_fit_are_counted(void **state) {
    (void)state;
    struct gn_warnings warnings = {0};
    for (int i = 0; i < GN_WARN_MAX + 5; i++) gn_warn(&warnings, "w%d", i);
    gn_warn(&warnings, "w0");
    assert_int_equal(warnings.count, GN_WARN_MAX);
    assert_int_equal(warnings.dropped, 5);
    char *text = printed(&warnings);
    assert_non_null(strstr(text, "gnomon: warning: and 5 more\n"));
    free(text);
}

static void none_print_nothing(void **state) {
    (void)state;
    struct gn_warnings warnings = {0};
    gn_warn(NULL, "nobody listens");
    char *text = printed(&warnings);
    assert_string_equal(text, "");
    free(text);
}

static void each_is_printed_once(void **state) {
    (void)state;
    struct gn_warnings warnings = {0};
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    for (int i = 0; i < 3; i++) {
        gn_warn(&warnings, "w%d", i);
        gn_warn(&warnings, "w0");
        if (i < 2) gn_warn_flush(&warnings, to);
        fflush(to);
        assert_int_equal(size, i == 0 ? 20 : 40);
    }
    gn_warn_print(&warnings, to);
    fclose(to);
    assert_string_equal(text, "gnomon: warning: w0\ngnomon: warning: w1\ngnomon: warning: w2\n");
    free(text);
}

/* A kiosk that runs for months. */
static void a_printed_one_makes_room(void **state) {
    (void)state;
    struct gn_warnings warnings = {0};
    for (int i = 0; i < 3 * GN_WARN_MAX; i++) {
        char *text = NULL, wanted[40];
        size_t size;
        gn_warn(&warnings, "w%d", i);
        if (i > 0) gn_warn(&warnings, "w%d", i - 1);
        snprintf(wanted, sizeof wanted, "gnomon: warning: w%d\n", i);
        FILE *to = open_memstream(&text, &size);
        gn_warn_flush(&warnings, to);
        fclose(to);
        assert_string_equal(text, wanted);
        free(text);
    }
    assert_int_equal(warnings.count, GN_WARN_MAX);
    assert_int_equal(warnings.dropped, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_texts_count_once),   cmocka_unit_test(more_than_fit_are_counted),
        cmocka_unit_test(a_printed_one_makes_room), cmocka_unit_test(each_is_printed_once),
        cmocka_unit_test(none_print_nothing),
    };
    return RUN(tests);
}
