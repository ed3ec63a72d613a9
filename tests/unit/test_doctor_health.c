/* What doctor says of a board that suffers. */
#include "cli/doctor_report.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "unit/check.h"

static struct gn_doctor_report report;

static void fill(struct gn_health health) {
    memset(&report, 0, sizeof report);
    report.chosen = -1;
    report.health = health;
}

static void has_line(const char *line) {
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    gn_doctor_print(&report, to);
    fclose(to);
    const bool found = line ? strstr(text, line) != NULL : !strstr(text, "  health ");
    if (!found) fail_msg("%s", text);
    free(text);
}

static void list_is(const char *expected) {
    char *text = NULL;
    size_t size = 0;
    struct gn_err err = {0};
    FILE *to = open_memstream(&text, &size);
    assert_true(gn_doctor_print_json(&report, to, &err));
    fclose(to);
    json_t *all = json_loads(text, 0, NULL);
    char *list =
        json_dumps(json_object_get(json_object_get(all, "machine"), "health"), JSON_COMPACT);
    assert_string_equal(list, expected);
    free(list);
    free(text);
    json_decref(all);
}

static void a_weak_supply_and_heat_are_problems_with_their_cures(void **state) {
    (void)state;
    fill((struct gn_health){.undervoltage = 1, .firmware = 0xc, .cooled = -1, .hottest_mc = 84600});
    gn_doctor_diagnose_health(&report);
    assert_int_equal(report.problems.count, 2);
    assert_string_equal(report.problems.items[0].what,
                        "undervoltage: the board's supply is too weak");
    assert_non_null(strstr(report.problems.items[0].cure, "power supply"));
    assert_non_null(strstr(report.problems.items[1].what, "(85 C)"));
    assert_non_null(strstr(report.problems.items[1].cure, "cool the board"));
    has_line("\n  health      supply too weak; clock lowered; 85 C\n");
    list_is("[\"undervoltage\",\"throttled\"]");
}

static void what_the_kernel_does_not_say_is_unknown_or_not_there(void **state) {
    (void)state;
    fill((struct gn_health){.undervoltage = 0, .firmware = -1, .cooled = -1});
    gn_doctor_diagnose_health(&report);
    assert_int_equal(report.problems.count, 0);
    has_line("\n  health      supply sufficient; clock unknown\n");
    list_is("[]");
    fill((struct gn_health){.undervoltage = -1, .firmware = -1, .cooled = 0});
    has_line("\n  health      supply unknown; clock not lowered\n");
    fill((struct gn_health){.undervoltage = -1, .firmware = -1, .cooled = -1});
    has_line(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_weak_supply_and_heat_are_problems_with_their_cures),
        cmocka_unit_test(what_the_kernel_does_not_say_is_unknown_or_not_there),
    };
    return RUN(tests);
}
