/* Reports of doctor: what is in them, what is not, and what two of them say beside each other. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/report.h"
#include "unit/folder.h"

static char folder[64];
static char *printed; /* by the last comparison */

static int setup(void **state) {
    (void)state;
    strcpy(folder, "/tmp/gnomon-report-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    free(printed);
    printed = NULL;
    return gn_test_remove_folder(folder);
}

/* ---- what is in it ---- */

static struct gn_doctor_report doctor;
static struct gn_input_line lines[1];

/* A machine on which each text that comes from outside has a secret in it. */
static void fill_doctor(void) {
    struct gn_machine *m = &doctor.machine;
    doctor = (struct gn_doctor_report){.backend_count = 1};
    strcpy(m->model, "Board of s3cret-host");
    strcpy(m->kernel, "Linux 6.1.0-s3cret-host");
    strcpy(m->user, "s3cret-user");
    strcpy(m->groups[m->group_count++], "s3cret-group");
    m->cpus = 4;
    m->devices[m->device_count++] = (struct gn_device){.kind = GN_DEVICE_CARD,
                                                       .path = "/dev/dri/s3cret-path",
                                                       .driver = "vc4-drm",
                                                       .group = "s3cret-group",
                                                       .holder = "s3cret-program (pid 612)"};
    m->devices[m->device_count++] = (struct gn_device){
        .kind = GN_DEVICE_GPIO, .path = "/dev/gpiochip0", .driver = "fe200000.gpio"};
    m->connectors[m->connector_count++] =
        (struct gn_connector){"card0-HDMI-A-1", "connected", "1920x1080", "1920x1080", "DEL 40f1"};
    doctor.backends[0] =
        (struct gn_doctor_backend){.name = "egl",
                                   .built = true,
                                   .opens = true,
                                   .why = "/home/s3cret-user/x: 10.1.2.3 dc:a6:32:aa:bb:cc"};
    strcpy(doctor.backends[0].caps.renderer, "V3D 4.2");
    strcpy(doctor.backends[0].caps.version, "OpenGL ES 3.1 Mesa 23.2");
    doctor.backends[0].caps.has = 1u << GN_CAP_R16F | 1u << GN_CAP_SRGB;
    gn_problem_add(&doctor.problems, "usermod s3cret-user",
                   "s3cret-user may not open /dev/dri/card0");
    lines[0] =
        (struct gn_input_line){.name = "GPIO17", .used = true, .consumer = "s3cret-consumer"};
    doctor.input.chips[0] = (struct gn_input_chip){
        .path = "/dev/gpiochip0", .label = "pinctrl", .line_count = 1, .lines = lines};
    doctor.input.chip_count = 1;
}

static json_t *make_bench(double none_ms, double pcf_ms) {
    return json_pack("{sf s[{ss s[{ss sf} {ss sf}]}]}", "load", 0.1, "scenes", "scene",
                     "(default scene)", "runs", "technique", "none", "ms_median", none_ms,
                     "technique", "pcf", "ms_median", pcf_ms);
}

static json_t *make_report(void) {
    struct gn_redact redact = {0};
    gn_redact_add(&redact, "s3cret-host");
    gn_redact_add(&redact, "s3cret-user");
    fill_doctor();
    return gn_report_make(gn_doctor_json(&doctor), make_bench(4, 6), &redact);
}

static void test_a_report_names_neither_machine_nor_user(void **state) {
    (void)state;
    static const char *const secrets[] = {"s3cret", "/home", "/dev", "10.1.2.3", "dc:a6", "612"};
    json_t *report = make_report();
    char *text = json_dumps(report, JSON_ENCODE_ANY);
    for (size_t i = 0; i < sizeof secrets / sizeof *secrets; i++)
        if (strstr(text, secrets[i])) fail_msg("%s is in %s", secrets[i], text);
    free(text);
    json_decref(report);
}

static void test_a_report_has_what_helps(void **state) {
    (void)state;
    static const char *const wanted[] = {"\"gnomon_report\":1",
                                         "Linux 6.1.0-(name)",
                                         "vc4-drm",
                                         "card0-HDMI-A-1",
                                         "DEL 40f1",
                                         "fe200000.gpio",
                                         "GPIO17",
                                         "\"used\":true",
                                         "V3D 4.2",
                                         "OpenGL ES 3.1",
                                         "(name) may not open card0",
                                         "\"proved\":[\"r16f\",\"srgb\"]",
                                         "ms_median",
                                         "\"built\":"};
    json_t *report = make_report();
    char *text = json_dumps(report, JSON_COMPACT);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!strstr(text, wanted[i])) fail_msg("%s is not in %s", wanted[i], text);
    free(text);
    json_decref(report);
}

/* ---- beside each other ---- */

static const char *put(const char *name, const char *bytes, size_t size) {
    static char paths[4][100];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    return path;
}

static const char *put_report(const char *name, json_t *report) {
    char *text = json_dumps(report, JSON_INDENT(2));
    const char *path = put(name, text, strlen(text));
    free(text);
    json_decref(report);
    return path;
}

static bool compare(const char *a, const char *b, struct gn_err *err) {
    const char *const paths[] = {a, b};
    size_t size;
    free(printed);
    FILE *to = open_memstream(&printed, &size);
    *err = (struct gn_err){0};
    const bool ok = gn_report_compare(paths, b ? 2 : 1, to, err);
    fclose(to);
    return ok;
}

static void assert_printed(const char *text) {
    if (!strstr(printed, text)) fail_msg("no '%s' in\n%s", text, printed);
}

static void test_equal_reports_differ_in_nothing(void **state) {
    (void)state;
    struct gn_err err;
    const char *a = put_report("a", make_report());
    assert_true(compare(a, a, &err));
    assert_printed("nothing differs");
    assert_printed("verdict: neither is worse.\n");
    assert_printed("| V3D 4.2 | OpenGL ES 3.1 Mesa 23.2 |");
    assert_printed("| 6.00 ms (1.50) |");
    assert_true(compare(a, NULL, &err));
    assert_null(strstr(printed, "verdict"));
}

static void test_a_slower_driver_that_proves_less_is_worse(void **state) {
    (void)state;
    struct gn_err err;
    json_t *worse = make_report();
    const char *a = put_report("a", make_report());
    json_array_remove(json_object_get(json_object_get(worse, "gpu"), "proved"), 0);
    json_object_set_new(worse, "bench", make_bench(8, 12));
    json_object_set_new(worse, "self_test", json_pack("{si si}", "passed", 70, "failed", 2));
    const char *b = put_report("b", worse);
    assert_false(compare(a, b, &err));
    assert_int_equal(err.status, GN_EXIT_DIFFER);
    assert_printed("gpu.proved");
    assert_printed("bench.scenes.(default scene).runs.pcf.ms_median");
    assert_printed("2.00 times");
    assert_printed("B is worse than A: 2 more rows of the self-test fail; not proved: r16f; a "
                   "frame takes 2.00 times as long");
    assert_true(compare(b, a, &err));
    assert_printed("A is worse than B: 2 more rows");
    assert_printed("Frames of B take 0.50 times those of A");
}

static void test_pictures_of_two_sizes_are_not_compared(void **state) {
    (void)state;
    struct gn_err err;
    json_t *larger = make_report();
    json_object_set_new(larger, "bench", make_bench(40, 60));
    json_t *scenes = json_object_get(json_object_get(larger, "bench"), "scenes");
    json_object_set_new(json_array_get(scenes, 0), "size", json_string("1280x720"));
    const char *a = put_report("a", make_report()), *b = put_report("b", larger);
    assert_true(compare(a, b, &err));
    assert_printed("verdict: neither is worse.\n");
    assert_printed("10.00 times");
}

static void test_a_busy_machine_is_named(void **state) {
    (void)state;
    struct gn_err err;
    json_t *busy = make_report();
    json_object_set_new(json_object_get(busy, "bench"), "load", json_real(3));
    const char *a = put_report("a", make_report()), *b = put_report("b", busy);
    assert_true(compare(a, b, &err));
    assert_printed("4 CPUs, busy |");
    assert_printed("while other programs ran");
}

/* ---- files from anywhere ---- */

static void assert_refused(const char *text, size_t size, const char *why) {
    struct gn_err err;
    assert_false(compare(put("x", text, size), NULL, &err));
    assert_int_equal(err.status, GN_EXIT_RUNTIME);
    assert_null(strchr(err.text, '\n'));
    if (!strstr(err.text, why)) fail_msg("%s", err.text);
}

static void test_what_is_no_report_is_refused_in_one_line(void **state) {
    (void)state;
    struct gn_err err;
    json_t *report = make_report();
    char *text = json_dumps(report, 0), *large = calloc(1, GN_REPORT_BYTES + 1);
    for (size_t size = 0; size < strlen(text); size += 7)
        assert_refused(text, size, "not a whole report");
    assert_refused("[1]", 3, "not a file of");
    assert_refused("{\"gnomon_report\":2}", 19, "version 2");
    assert_refused("{\"gnomon_report\":1,\"bench\":[],\"machine\":{}}", 43, "without");
    assert_refused(large, GN_REPORT_BYTES + 1, "larger than the limit");
    memset(large, '[', GN_REPORT_BYTES);
    assert_refused(large, GN_REPORT_BYTES, "not a whole report");
    assert_false(compare("/dev/null", NULL, &err));
    assert_false(compare(folder, NULL, &err));
    assert_false(gn_report_compare(NULL, 0, stdout, &err));
    free(large);
    free(text);
    json_decref(report);
}

/* Every value of a report is replaced by one of another type; what is printed stays on its lines.
 */
static void spoil(json_t *value, json_t *report, json_t *other, int *tried) {
    const char *key;
    void *next;
    json_t *member;
    struct gn_err err;
    json_object_foreach_safe(value, next, key, member) {
        json_incref(member);
        json_object_set(value, key, other);
        char *text = json_dumps(report, 0);
        const char *path = put("spoilt", text, strlen(text)),
                   *whole = put_report("a", make_report());
        (void)compare(path, whole, &err);
        assert_null(strchr(printed, 0x1b));
        (void)compare(whole, path, &err);
        ++*tried;
        free(text);
        json_object_set_new(value, key, member);
        spoil(member, report, other, tried);
    }
    for (size_t i = 0; i < json_array_size(value); i++)
        spoil(json_array_get(value, i), report, other, tried);
}

static void test_values_of_wrong_types_are_harmless(void **state) {
    (void)state;
    static const char *const others[] = {"null", "\"\\u001b[2J\\n|\"", "[[[{}]],\"x\"]", "-1e308",
                                         "{\"name\":{}}"};
    int tried = 0;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        json_t *report = make_report(), *other = json_loads(others[i], JSON_DECODE_ANY, NULL);
        assert_non_null(other);
        spoil(report, report, other, &tried);
        json_decref(other);
        json_decref(report);
    }
    assert_true(tried > 300);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_a_report_names_neither_machine_nor_user),
        TEST(test_a_report_has_what_helps),
        TEST(test_equal_reports_differ_in_nothing),
        TEST(test_a_slower_driver_that_proves_less_is_worse),
        TEST(test_pictures_of_two_sizes_are_not_compared),
        TEST(test_a_busy_machine_is_named),
        TEST(test_what_is_no_report_is_refused_in_one_line),
        TEST(test_values_of_wrong_types_are_harmless),
    };
    return RUN(tests);
}
