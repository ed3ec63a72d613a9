/* Keys by name, and what they may be told to do. */
#include "unit/check.h"

#include "core/key.h"
#include "options/action.h"

#include <string.h>

static void keys_are_found_by_their_names(void **state) {
    (void)state;
    char buffer[16];
    for (unsigned key = 1; key < GN_KEY_COUNT; key++)
        assert_int_equal(gn_key_find(gn_key_name(key, buffer, sizeof buffer)), key);
    assert_int_equal(gn_key_find("KEY_SPACE"), GN_KEY_SPACE);
    assert_int_equal(gn_key_find("PageDown"), GN_KEY_PAGEDOWN);
    assert_int_equal(gn_key_find("key_5"), 5);
    static const char *const none[] = {"", "spaces", "key_", "key_768", "key_5x", "key_-1", "57"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        assert_int_equal(gn_key_find(none[i]), GN_KEY_NONE);
}

static void actions_are_read(void **state) {
    (void)state;
    struct gn_action action;
    struct gn_err err = {0};
    assert_true(gn_action_parse("next", &action, &err));
    assert_int_equal(action.kind, GN_ACTION_NEXT);
    assert_null(action.name);
    assert_true(gn_action_parse("mode  Soft shadows", &action, &err));
    assert_int_equal(action.kind, GN_ACTION_MODE);
    assert_string_equal(action.name, "Soft shadows");
    assert_true(gn_action_parse("play Wave hello", &action, &err));
    assert_int_equal(action.kind, GN_ACTION_PLAY);
    assert_string_equal(action.name, "Wave hello");
    assert_true(gn_action_parse("pause on", &action, &err));
    assert_int_equal(action.kind, GN_ACTION_PAUSE);
    assert_int_equal(action.turn, GN_TURN_ON);
    assert_true(gn_action_parse("blank  off", &action, &err));
    assert_int_equal(action.turn, GN_TURN_OFF);
    assert_true(gn_action_parse("info", &action, &err));
    assert_int_equal(action.turn, GN_TURN_OTHER);
    for (int k = GN_ACTION_NONE; k < GN_ACTION_KIND_COUNT; k++) {
        if (k == GN_ACTION_MODE || k == GN_ACTION_PLAY || k == GN_ACTION_SUN) continue;
        assert_true(gn_action_parse(gn_action_name((enum gn_action_kind)k), &action, &err));
        assert_int_equal(action.kind, k);
    }
}

static void steps_of_the_sun_are_read(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int64_t seconds;
    } good[] = {{"sun now", 0},        {"sun +1h", 3600},
                {"sun -15m", -900},    {"sun  +1d", 86400},
                {"sun -2w", -1209600}, {"sun +36525d", 3155760000},
                {"sun +024h", 86400},  {"sun -876600h", -3155760000}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct gn_action action;
        struct gn_err err = {0};
        int64_t step_s;
        if (!gn_action_parse(good[i].text, &action, &err)) fail_msg("%s", err.text);
        assert_int_equal(action.kind, GN_ACTION_SUN);
        assert_true(gn_sun_step_parse(action.name, &step_s, &err));
        assert_int_equal(step_s, good[i].seconds);
    }
}

static void what_is_no_action_is_refused(void **state) {
    (void)state;
    static const char *const bad[] = {
        "",        "nex",      "nextt",     "mode",        "mode ",
        "play",    "next 1",   "Next",      "blank o",     "pause off on",
        "sun",     "sun 1h",   "sun +1",    "sun +h",      "sun +1.5h",
        "sun +0h", "sun + 1h", "sun +1h x", "sun +36526d", "sun +99999999999999999999h",
        "sun on",  "sun +1y",  "sun +-1h"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct gn_action action = {0};
        struct gn_err err = {0};
        assert_false(gn_action_parse(bad[i], &action, &err));
        assert_int_equal(err.status, GN_EXIT_USAGE);
        assert_string_not_equal(err.text, "");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_found_by_their_names),
        cmocka_unit_test(actions_are_read),
        cmocka_unit_test(steps_of_the_sun_are_read),
        cmocka_unit_test(what_is_no_action_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
