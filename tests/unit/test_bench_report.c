/* Quantiles, the sum of passes, and that the JSON has the contract's fields with their types. */

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/bench_report.h"
#include "unit/check.h"

static void test_the_median_of_an_odd_count_is_the_middle(void **state) {
    (void)state;
    double values[] = {9, 1, 5, 3, 7};
    assert_true(gn_bench_quantile(values, 5, .5) == 5);
}

static void test_one_value_is_every_quantile(void **state) {
    (void)state;
    double value = 4;
    assert_true(gn_bench_quantile(&value, 1, 0) == 4);
    assert_true(gn_bench_quantile(&value, 1, .5) == 4);
    assert_true(gn_bench_quantile(&value, 1, 1) == 4);
}

static void test_five_of_a_hundred_lie_above_p95(void **state) {
    (void)state;
    double values[100];
    for (int i = 0; i < 100; i++) values[i] = 100 - i;
    assert_true(gn_bench_quantile(values, 100, .95) == 95);
}

static void test_passes_of_one_label_are_one(void **state) {
    (void)state;
    struct gn_bench_run run = {0};
    gn_bench_add_pass(&run, "shadow 0 sun", 1);
    gn_bench_add_pass(&run, "opaque", 2);
    gn_bench_add_pass(&run, "shadow 0 sun", 3);
    assert_int_equal(run.pass_count, 2);
    assert_string_equal(run.passes[0].label, "shadow 0 sun");
    assert_true(run.passes[0].ms == 4 && run.passes[1].ms == 2);
    free(run.passes);
}

static void test_names_are_joined_whole_and_once(void **state) {
    (void)state;
    char list[GN_BENCH_NAMES] = "", whole[512] = "";
    for (int again = 0; again < 2; again++)
        for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) gn_bench_add_name(list, gn_techniques[i].name);
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) {
        if (i) strcat(whole, "+");
        strcat(whole, gn_techniques[i].name);
    }
    assert_string_equal(list, whole);
    char full[GN_BENCH_NAMES] = "";
    memset(full, 'x', GN_BENCH_NAMES - 5);
    gn_bench_add_name(full, "pcss");
    assert_int_equal(strlen(full), GN_BENCH_NAMES - 5);
    gn_bench_add_name(full, "pcf");
    assert_string_equal(full + GN_BENCH_NAMES - 5, "+pcf");
}

static struct gn_bench_report sample(struct gn_bench_run *run) {
    *run = (struct gn_bench_run){
        .technique = "pcf3",
        .map_format = "depth",
        .output = "linear",
        .frames = 60,
        .ms_median = 12.34567,
        .ms_p95 = 15,
        .cpu_ms = 11,
        .stats = {.draws = 3, .gl_calls = 20, .triangles = 1234, .shadow_draws = 3},
        .idle = false,
    };
    gn_bench_add_pass(run, "opaque", 5);
    return (struct gn_bench_report){
        .renderer = "llvmpipe \xff",
        .scene = "a \"scene\".glb",
        .width_px = 1280,
        .height_px = 720,
        .start_ms = 100,
        .private_dirty_mb = 30,
        .private_dirty_empty_context_mb = NAN,
        .runs = run,
        .run_count = 1,
    };
}

static json_t *json_of(const struct gn_bench_report *report) {
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    assert_true(gn_bench_print_json(report, 1, to, NULL));
    fclose(to);
    json_t *json = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    free(text);
    assert_non_null(json);
    return json;
}

static void test_the_json_has_the_fields_of_the_contract(void **state) {
    (void)state;
    struct gn_bench_run run;
    struct gn_bench_report report = sample(&run);
    json_t *json = json_of(&report), *one = json_array_get(json_object_get(json, "runs"), 0);
    static const char *const top[] = {
        "gl_renderer", "scene",
        "size",        "start_to_first_picture_ms",
        "cache",       "private_dirty_mb",
        "runs",        "private_dirty_empty_context_mb",
    };
    static const char *const inner[] = {
        "technique", "map_format",   "output", "frames",       "ms_median",
        "ms_p95",    "cpu_ms",       "passes", "draws",        "gl_calls",
        "triangles", "shadow_draws", "idle",   "target_bytes",
    };
    for (size_t i = 0; i < sizeof top / sizeof *top; i++)
        assert_non_null(json_object_get(json, top[i]));
    for (size_t i = 0; i < sizeof inner / sizeof *inner; i++)
        assert_non_null(json_object_get(one, inner[i]));
    assert_int_equal(json_object_size(json), sizeof top / sizeof *top);
    assert_int_equal(json_object_size(one), sizeof inner / sizeof *inner);
    json_decref(json);
    free(run.passes);
}

static void test_values_are_said_as_they_are(void **state) {
    (void)state;
    struct gn_bench_run run;
    struct gn_bench_report report = sample(&run);
    json_t *json = json_of(&report), *one = json_array_get(json_object_get(json, "runs"), 0);
    assert_string_equal(json_string_value(json_object_get(json, "size")), "1280x720");
    assert_string_equal(json_string_value(json_object_get(json, "cache")), "cold");
    assert_string_equal(json_string_value(json_object_get(json, "scene")), "a \"scene\".glb");
    assert_true(json_is_null(json_object_get(json, "private_dirty_empty_context_mb")));
    assert_true(fabs(json_real_value(json_object_get(one, "ms_median")) - 12.346) < 1e-9);
    assert_int_equal(json_integer_value(json_object_get(one, "triangles")), 1234);
    assert_true(json_is_false(json_object_get(one, "idle")));
    json_decref(json);
    free(run.passes);
}

static void test_a_name_that_is_not_utf8_still_makes_json(void **state) {
    (void)state;
    struct gn_bench_run run;
    struct gn_bench_report report = sample(&run);
    json_t *json = json_of(&report);
    assert_true(json_is_string(json_object_get(json, "gl_renderer")));
    json_decref(json);
    free(run.passes);
}

static void test_the_table_has_a_row_a_technique(void **state) {
    (void)state;
    struct gn_bench_run run;
    struct gn_bench_report report = sample(&run);
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    gn_bench_print(&report, to);
    fclose(to);
    assert_non_null(strstr(text, "\npcf3 "));
    assert_non_null(strstr(text, "an empty context unknown"));
    free(text);
    free(run.passes);
}

static void test_the_csv_has_a_line_a_scene_and_technique(void **state) {
    (void)state;
    struct gn_bench_run run;
    const struct gn_bench_report report = sample(&run);
    struct gn_bench_report reports[2] = {report, report};
    reports[1].scene = "b.glb";
    reports[1].start_ms = NAN;
    char text[2000];
    FILE *to = fmemopen(text, sizeof text, "w");
    gn_bench_print_csv(reports, 2, to);
    fclose(to);
    const char *first = strchr(text, '\n') + 1, *second = strchr(first, '\n') + 1;
    int commas[3] = {0};
    const char *lines[3] = {text, first, second};
    for (int i = 0; i < 3; i++)
        for (const char *at = lines[i]; *at != '\n'; at++) commas[i] += *at == ',';
    assert_true(commas[0] > 10 && commas[0] == commas[1] && commas[0] == commas[2]);
    assert_ptr_equal(strstr(first, "\"a \"\"scene\"\".glb\",\"llvmpipe"), first);
    assert_non_null(
        strstr(first, ",\"pcf3\",\"depth\",1280,720,linear,100.000,12.346,15.000,11.000,"));
    assert_non_null(strstr(second, "\"b.glb\","));
    assert_non_null(strstr(second, ",linear,,12.346,"));
    assert_string_equal(strchr(second, '\n'), "\n");
    free(run.passes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_median_of_an_odd_count_is_the_middle),
        cmocka_unit_test(test_one_value_is_every_quantile),
        cmocka_unit_test(test_five_of_a_hundred_lie_above_p95),
        cmocka_unit_test(test_passes_of_one_label_are_one),
        cmocka_unit_test(test_names_are_joined_whole_and_once),
        cmocka_unit_test(test_the_json_has_the_fields_of_the_contract),
        cmocka_unit_test(test_values_are_said_as_they_are),
        cmocka_unit_test(test_a_name_that_is_not_utf8_still_makes_json),
        cmocka_unit_test(test_the_table_has_a_row_a_technique),
        cmocka_unit_test(test_the_csv_has_a_line_a_scene_and_technique),
    };
    return RUN(tests);
}
