/* `gnomon bench` as a user runs it: the fields of its JSON and their types, what must hold between
 * them, and what it refuses. Nothing here depends on how fast the machine is. */

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "unit/check.h"

#define SCENE "assets/bench/s1.glb"

static struct gn_run result;

static int bench(const char *const args[]) {
    const char *argv[32] = {gn_shot_program(), "bench"};
    struct gn_err err = {0};
    for (int i = 0; args[i]; i++) argv[2 + i] = args[i];
    if (!gn_run(&result, argv, 0, &err)) fail_msg("%s", err.text);
    return result.status;
}
#define BENCH(...) bench((const char *const[]){__VA_ARGS__, NULL})

static json_t *bench_json(void) {
    json_error_t error;
    json_t *json = json_loads(result.out, JSON_REJECT_DUPLICATES, &error);
    if (!json) fail_msg("line %d: %s in: %s", error.line, error.text, result.out);
    return json;
}

struct field {
    const char *name;
    char type; /* s text, r number >= 0, i integer >= 0, b bool, a list */
};

static bool is(const json_t *value, char type) {
    switch (type) {
    case 's': return json_string_length(value) > 0;
    case 'r': return json_is_number(value) && json_number_value(value) >= 0;
    case 'i': return json_is_integer(value) && json_integer_value(value) >= 0;
    case 'b': return json_is_boolean(value);
    default: return json_is_array(value);
    }
}

static void check_fields(const json_t *object, const struct field *fields, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!is(json_object_get(object, fields[i].name), fields[i].type))
            fail_msg("\"%s\" is missing or of another type", fields[i].name);
    assert_int_equal(json_object_size(object), count);
}
#define CHECK_FIELDS(object, fields) check_fields(object, fields, sizeof fields / sizeof *fields)

static const struct field top_fields[] = {
    {"gl_renderer", 's'},
    {"scene", 's'},
    {"size", 's'},
    {"start_to_first_picture_ms", 'r'},
    {"cache", 's'},
    {"private_dirty_mb", 'r'},
    {"private_dirty_empty_context_mb", 'r'},
    {"runs", 'a'},
};
static const struct field run_fields[] = {
    {"technique", 's'}, {"map_format", 's'},   {"output", 's'},    {"frames", 'i'},
    {"ms_median", 'r'}, {"ms_p95", 'r'},       {"cpu_ms", 'r'},    {"passes", 'a'},
    {"draws", 'i'},     {"gl_calls", 'i'},     {"triangles", 'i'}, {"shadow_draws", 'i'},
    {"idle", 'b'},      {"target_bytes", 'i'},
};
static const struct field pass_fields[] = {{"label", 's'}, {"ms", 'r'}};

static const char *text_of(const json_t *object, const char *name) {
    return json_string_value(json_object_get(object, name));
}
static double number_of(const json_t *object, const char *name) {
    return json_number_value(json_object_get(object, name));
}

static void check_run(const json_t *run) {
    size_t i;
    json_t *pass;
    CHECK_FIELDS(run, run_fields);
    json_array_foreach(json_object_get(run, "passes"), i, pass) CHECK_FIELDS(pass, pass_fields);
    assert_true(number_of(run, "ms_median") > 0 && number_of(run, "cpu_ms") > 0);
    assert_true(number_of(run, "ms_median") <= number_of(run, "ms_p95"));
    assert_true(number_of(run, "draws") > 0 && number_of(run, "triangles") >= 10000);
    assert_true(number_of(run, "gl_calls") > number_of(run, "draws"));
    assert_true(number_of(run, "target_bytes") >= 160 * 90 * 4);
}

static void test_the_json_has_every_field_and_no_other(void **state) {
    (void)state;
    assert_int_equal(
        BENCH(SCENE, "--json", "--size", "160x90", "--frames", "4", "--shadow", "none,hard,pcf3"),
        0);
    json_t *json = bench_json(), *runs = json_object_get(json, "runs"), *run;
    static const char *const names[] = {"none", "hard", "pcf3"};
    size_t i;
    CHECK_FIELDS(json, top_fields);
    assert_string_equal(text_of(json, "size"), "160x90");
    assert_string_equal(text_of(json, "scene"), SCENE);
    assert_true(!strcmp(text_of(json, "cache"), "warm") || !strcmp(text_of(json, "cache"), "cold"));
    assert_true(number_of(json, "private_dirty_mb") >
                number_of(json, "private_dirty_empty_context_mb"));
    assert_int_equal(json_array_size(runs), 3);
    json_array_foreach(runs, i, run) {
        check_run(run);
        assert_string_equal(text_of(run, "technique"), names[i]);
        assert_string_equal(text_of(run, "output"), "srgb");
        assert_int_equal(number_of(run, "frames"), 4);
    }
    json_decref(json);
}

static void test_shadows_are_drawn_only_where_there_are_some(void **state) {
    (void)state;
    assert_int_equal(BENCH(SCENE, "--json", "--size", "160x90", "--frames", "2", "--shadow",
                           "none,hard", "--map-format", "depth", "--output", "linear"),
                     0);
    json_t *json = bench_json(), *none = json_array_get(json_object_get(json, "runs"), 0),
           *hard = json_array_get(json_object_get(json, "runs"), 1);
    assert_int_equal(number_of(none, "shadow_draws"), 0);
    assert_true(number_of(hard, "shadow_draws") > 0);
    assert_string_equal(text_of(none, "map_format"), "none");
    assert_string_equal(text_of(hard, "map_format"), "depth");
    assert_string_equal(text_of(hard, "output"), "linear");
    assert_int_equal(json_array_size(json_object_get(none, "passes")), 1);
    assert_int_equal(json_array_size(json_object_get(hard, "passes")), 2);
    json_decref(json);
}

static void test_a_still_scene_is_idle_and_draws_no_map_again(void **state) {
    (void)state;
    assert_int_equal(BENCH(SCENE, "--json", "--size", "160x90", "--frames", "3", "--no-animation"),
                     0);
    json_t *json = bench_json(), *run = json_array_get(json_object_get(json, "runs"), 0);
    assert_string_equal(text_of(run, "technique"), "pcf");
    assert_true(json_is_true(json_object_get(run, "idle")));
    assert_int_equal(number_of(run, "shadow_draws"), 0);
    json_decref(json);
}

static void test_a_turntable_is_not_idle(void **state) {
    (void)state;
    assert_int_equal(BENCH(SCENE, "--json", "--size", "160x90", "--frames", "2", "--no-animation",
                           "--turntable", "20"),
                     0);
    json_t *json = bench_json(), *run = json_array_get(json_object_get(json, "runs"), 0);
    assert_true(json_is_false(json_object_get(run, "idle")));
    json_decref(json);
}

static void test_timed_frames_allocate_nothing(void **state) {
    (void)state;
    assert_int_equal(BENCH(SCENE, "--size", "160x90", "--frames", "20", "--shadow", "pcf,hard"), 0);
    assert_null(strstr(result.err, "timed frames asked"));
}

static void test_the_table_names_what_was_measured(void **state) {
    (void)state;
    assert_int_equal(BENCH(SCENE, "--size", "160x90", "--frames", "2", "--shadow", "hard,pcf5"), 0);
    assert_non_null(strstr(result.out, "160x90"));
    assert_non_null(strstr(result.out, "\nhard "));
    assert_non_null(strstr(result.out, "\npcf5 "));
    assert_non_null(strstr(result.out, "an empty context"));
}

static void test_bad_lists_are_usage_errors_of_one_line(void **state) {
    (void)state;
    static const char *const lists[] = {"hard,hard", "soft",      "hard,",
                                        ",",         "none,soft", "pcf ,hard"};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        assert_int_equal(BENCH(SCENE, "--shadow", lists[i]), 2);
        assert_string_equal(result.out, "");
        assert_int_equal(strcspn(result.err, "\n") + 1, strlen(result.err));
    }
}

static void test_a_missing_scene_is_the_world_saying_no(void **state) {
    (void)state;
    assert_int_equal(BENCH("no-such-scene.glb", "--json"), 1);
    assert_string_equal(result.out, "");
    assert_non_null(strstr(result.err, "no-such-scene.glb"));
}

static uint64_t shadow_draws(json_t *json) {
    const json_t *run = json_array_get(json_object_get(json, "runs"), 0);
    return (uint64_t)json_integer_value(json_object_get(run, "shadow_draws"));
}

static void test_what_moves_is_drawn_into_maps_again(void **state) {
    (void)state;
    static const char *const moves[] = {"--move-lights", "--move-casters"};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(
            BENCH(SCENE, "--json", "--size", "160x90", "--frames", "7", "--no-animation", moves[i]),
            0);
        assert_null(strstr(result.err, "timed frames asked"));
        json_t *json = bench_json(), *run = json_array_get(json_object_get(json, "runs"), 0);
        assert_true(shadow_draws(json) > 0);
        assert_true(json_is_false(json_object_get(run, "idle")));
        json_decref(json);
    }
}

static void test_several_scenes_are_measured_one_after_the_other(void **state) {
    (void)state;
    assert_int_equal(BENCH(SCENE, "assets/bench/s2.glb", "--json", "--size", "64x36", "--frames",
                           "1", "--shadow", "none"),
                     0);
    json_t *json = bench_json(), *scenes = json_object_get(json, "scenes");
    assert_int_equal(json_array_size(scenes), 2);
    for (size_t i = 0; i < 2; i++) {
        json_t *one = json_array_get(scenes, i);
        assert_string_equal(text_of(one, "scene"), i ? "assets/bench/s2.glb" : SCENE);
        assert_true(json_is_null(json_object_get(one, "start_to_first_picture_ms")) == (i == 1));
        assert_int_equal(json_array_size(json_object_get(one, "runs")), 1);
    }
    json_decref(json);
    assert_int_equal(
        BENCH(SCENE, SCENE, "--csv", "--size", "64x36", "--frames", "1", "--shadow", "none,hard"),
        0);
    int lines = 0;
    for (const char *at = result.out; *at; at++) lines += *at == '\n';
    assert_int_equal(lines, 5);
    assert_int_equal(BENCH(SCENE, "--csv", "--json"), 2);
}

/* What inspect prints for the same technique at the same size, in each run; and as a text. */
static void test_each_run_has_its_time_on_a_board(void **state) {
    (void)state;
    static const char *const techniques[] = {"pcf", "none"}, *const numbers[] = {
                                                                 "each_frame_ms", "all_ms",
                                                                 "width_px", "msaa"};
    assert_int_equal(BENCH(SCENE, "--json", "--size", "160x90", "--frames", "1", "--shadow",
                           "pcf,none", "--for", "g52"),
                     0);
    json_t *json = bench_json();
    double ms[2];
    for (size_t i = 0; i < 2; i++) {
        struct gn_err err = {0};
        const char *const argv[] = {gn_shot_program(), "inspect",     SCENE,   "--json",
                                    "--size",          "160x90",      "--for", "g52",
                                    "--shadow",        techniques[i], NULL};
        json_t *run = json_array_get(json_object_get(json, "runs"), i);
        if (!gn_run(&result, argv, 0, &err)) fail_msg("%s", err.text);
        json_t *inspected = bench_json(), *time = json_object_get(run, "time"),
               *same = json_object_get(inspected, "time");
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) { /* of 9 and 7 digits */
            const double here = json_number_value(json_object_get(time, numbers[k])),
                         there = json_number_value(json_object_get(same, numbers[k]));
            assert_true(here > 0 && fabs(here - there) <= 1e-5 * there);
        }
        assert_string_equal(text_of(time, "board"), text_of(same, "board"));
        assert_int_equal(json_array_size(json_object_get(time, "passes")),
                         json_array_size(json_object_get(same, "passes")));
        ms[i] = json_number_value(json_object_get(time, "each_frame_ms"));
        json_decref(inspected);
    }
    assert_true(ms[0] > ms[1] && ms[1] > 0);
    json_decref(json);
    assert_int_equal(BENCH(SCENE, "--size", "160x90", "--frames", "1", "--for", "g52"), 0);
    assert_non_null(
        strstr(result.out, "Time on RK3566 and RK3568, Mali-G52 of one core at 160x90"));
    assert_int_equal(BENCH(SCENE, "--csv", "--for", "g52"), 2);
    assert_int_equal(BENCH(SCENE, "--move-lights", "--for", "g52"), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_json_has_every_field_and_no_other),
        cmocka_unit_test(test_shadows_are_drawn_only_where_there_are_some),
        cmocka_unit_test(test_a_still_scene_is_idle_and_draws_no_map_again),
        cmocka_unit_test(test_a_turntable_is_not_idle),
        cmocka_unit_test(test_timed_frames_allocate_nothing),
        cmocka_unit_test(test_the_table_names_what_was_measured),
        cmocka_unit_test(test_bad_lists_are_usage_errors_of_one_line),
        cmocka_unit_test(test_a_missing_scene_is_the_world_saying_no),
        cmocka_unit_test(test_what_moves_is_drawn_into_maps_again),
        cmocka_unit_test(test_several_scenes_are_measured_one_after_the_other),
        cmocka_unit_test(test_each_run_has_its_time_on_a_board),
    };
    return RUN(tests);
}
