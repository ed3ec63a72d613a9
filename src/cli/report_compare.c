/* Reports beside each other: a row each, and of two what differs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/report.h"
#include "core/text.h"

enum { CELL = 200, DEPTH = 12, PATH = 160, COLUMN = 34 };

#define BUSY_LOAD 0.5  /* runnable processes per CPU, beside which milliseconds mean little */
#define PERCENT   0.1  /* of the pixels, which two drivers may draw otherwise */
#define SLOWER    1.25 /* that a change of the driver may do, and other load on a machine rarely */

/* ---- fields, of any type -------------------------------------------------------------------- */

static const json_t *field(const json_t *at, const char *key) { return json_object_get(at, key); }

/* A text for a cell of a table; "" of what is none. */
static void copy_cell(const json_t *at, const char *key, char *out, size_t size) {
    const char *text = json_string_value(field(at, key));
    gn_text_format(out, size, "%s", text ? text : "");
    for (char *bar = out; (bar = strchr(bar, '|'));) *bar = '/';
}

/* 0 to 1,000,000, whatever a file says. */
static int count_of(const json_t *at, const char *key) {
    const json_int_t count = json_integer_value(field(at, key));
    return (int)(count < 0 ? 0 : count > 1000000 ? 1000000 : count);
}

static bool is_busy(const json_t *report) {
    return json_number_value(field(field(report, "bench"), "load")) > BUSY_LOAD;
}

static const json_t *find_run(const json_t *scene, const char *technique) {
    size_t i;
    json_t *run;
    json_array_foreach(field(scene, "runs"), i, run) {
        const char *name = json_string_value(field(run, "technique"));
        if (name && strcmp(name, technique) == 0) return run;
    }
    return NULL;
}

static double ms_of(const json_t *run) { return json_number_value(field(run, "ms_median")); }

/* ---- a row ---------------------------------------------------------------------------------- */

void gn_report_print_head(FILE *to) {
    fputs("| GPU | driver | machine | gnomon | self-test | not proved | default scene, `pcf` | key "
          "light, `cone` |\n|---|---|---|---|---|---|---|---|\n",
          to);
}

static void print_machine(const json_t *report, FILE *to) {
    char model[CELL], cpu[CELL];
    const json_t *machine = field(report, "machine");
    copy_cell(machine, "model", model, sizeof model);
    copy_cell(machine, "cpu", cpu, sizeof cpu);
    if (!model[0] && !cpu[0]) copy_cell(machine, "arch", model, sizeof model);
    const int cpus = count_of(machine, "cpus");
    fprintf(to, " %s%s%s, %d CPU%s%s |", model, model[0] && cpu[0] ? ", " : "", cpu, cpus,
            cpus == 1 ? "" : "s", is_busy(report) ? ", busy" : "");
}

static void print_proved(const json_t *report, FILE *to) {
    size_t i;
    json_t *cap;
    char name[CELL];
    const json_t *test = field(report, "self_test"),
                 *lacks = field(field(report, "gpu"), "not_proved");
    const int passed = count_of(test, "passed"), failed = count_of(test, "failed");
    fprintf(to, passed + failed ? " %d of %d |" : " - |", passed, passed + failed);
    json_array_foreach(lacks, i, cap) {
        copy_cell(cap, "name", name, sizeof name);
        fprintf(to, " %s", name);
    }
    fprintf(to, json_array_size(lacks) ? " |" : " - |");
}

/* Milliseconds, and how often those of the same frame without shadows, in the same run. */
static void print_times(const json_t *report, size_t scene, const char *technique, FILE *to) {
    const json_t *of = json_array_get(field(field(report, "bench"), "scenes"), scene);
    const double ms = ms_of(find_run(of, technique)), none = ms_of(find_run(of, "none"));
    if (ms > 0 && none > 0)
        fprintf(to, " %.*f ms (%.2f) |", ms < 10 ? 2 : 1, ms, ms / none);
    else
        fputs(" - |", to);
}

void gn_report_print_row(const json_t *report, FILE *to) {
    char renderer[CELL], gles[CELL], egl[CELL], version[CELL];
    const json_t *gpu = field(report, "gpu");
    copy_cell(gpu, "renderer", renderer, sizeof renderer);
    copy_cell(gpu, "gles", gles, sizeof gles);
    copy_cell(gpu, "egl", egl, sizeof egl);
    copy_cell(report, "version", version, sizeof version);
    fprintf(to, "| %s | %s%s%s |", renderer[0] ? renderer : "none draws", gles,
            egl[0] ? ", EGL " : "", egl);
    print_machine(report, to);
    fprintf(to, " %s |", version);
    print_proved(report, to);
    print_times(report, 0, "pcf", to);
    print_times(report, 1, "cone", to);
    fputc('\n', to);
}

/* ---- what differs --------------------------------------------------------------------------- */

struct difference {
    FILE *to;
    int rows, runs;
    double log_ratio; /* summed over the runs: of a frame of B to one of A */
};

/* What differs between two runs on one machine: all times but the medians; small errors. */
static bool is_noise(const char *key) {
    static const char *const keys[] = {"passes", "ms_p95",      "cpu_ms", "load",
                                       "limits", "gl_renderer", "mean"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(keys[i], key) == 0) return true;
    return false;
}

static bool is_small(const char *path, const json_t *a, const json_t *b) {
    return strncmp(path, "self_test.rows.", 15) == 0 && json_is_number(a) && json_is_number(b) &&
           fabs(json_number_value(a) - json_number_value(b)) < PERCENT;
}

/* What an element of an array is called: by its fields that name it; else by its number. */
static void name_element(const json_t *element, size_t index, char *out, size_t size) {
    static const char *const keys[] = {"scene", "technique", "map_format", "kind",
                                       "name",  "device",    "what"};
    out[0] = 0;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        const char *text = json_string_value(field(element, keys[i]));
        if (text) gn_text_add(out, size, "%s%s", out[0] ? "/" : "", text);
    }
    if (!out[0]) snprintf(out, size, "%zu", index);
}

static const json_t *find_element(const json_t *array, const char *name) {
    size_t i;
    json_t *element;
    char own[PATH];
    json_array_foreach(array, i, element) {
        name_element(element, i, own, sizeof own);
        if (strcmp(own, name) == 0) return element;
    }
    return NULL;
}

/* As a cell: a list of texts with spaces between; "-" for what is not there. */
static void describe_value(const json_t *value, char *out, size_t size) {
    size_t i;
    json_t *item;
    if (json_is_string(value))
        gn_text_format(out, size, "%s", json_string_value(value));
    else if (json_is_number(value))
        snprintf(out, size, "%.6g", json_number_value(value));
    else if (json_is_boolean(value))
        snprintf(out, size, json_is_true(value) ? "yes" : "no");
    else
        snprintf(out, size, json_is_object(value) ? "(there)" : "-");
    if (!json_array_size(value)) return;
    out[0] = 0;
    json_array_foreach(value, i, item) {
        const char *text = json_string_value(item);
        gn_text_add(out, size, "%s%s", out[0] ? " " : "", text ? text : "..");
    }
}

static void print_difference(struct difference *d, const char *path, const json_t *a,
                             const json_t *b) {
    char texts[2][CELL], name[PATH];
    const double before = json_number_value(a), after = json_number_value(b);
    describe_value(a, texts[0], sizeof texts[0]);
    describe_value(b, texts[1], sizeof texts[1]);
    gn_text_format(name, sizeof name, "%s", path);
    if (!d->rows++)
        fprintf(d->to, "\n%-*s %-*s %-*s\n", COLUMN, "what differs", COLUMN, "A", COLUMN, "B");
    fprintf(d->to, "%-*s %-*s %-*s", COLUMN, name, COLUMN, texts[0], COLUMN, texts[1]);
    if (before > 0 && after > 0 && strstr(path, "bench."))
        fprintf(d->to, " %.2f times", after / before);
    fputc('\n', d->to);
    if (!(before > 0 && after > 0) || !strstr(path, ".ms_median")) return;
    d->log_ratio += log(after / before);
    d->runs++;
}

static void walk(struct difference *d, const char *path, const json_t *a, const json_t *b,
                 int depth);

static void walk_member(struct difference *d, const char *path, const char *key, const json_t *a,
                        const json_t *b, int depth) {
    char below[PATH];
    snprintf(below, sizeof below, "%s%s%.80s", path, path[0] ? "." : "", key);
    walk(d, below, a, b, depth + 1);
}

static void walk_array(struct difference *d, const char *path, const json_t *a, const json_t *b,
                       int depth) {
    size_t i;
    json_t *element;
    char name[PATH];
    json_array_foreach(a, i, element) {
        name_element(element, i, name, sizeof name);
        walk_member(d, path, name, element, find_element(b, name), depth);
    }
    json_array_foreach(b, i, element) {
        name_element(element, i, name, sizeof name);
        if (!find_element(a, name)) walk_member(d, path, name, NULL, element, depth);
    }
}

static void walk_object(struct difference *d, const char *path, const json_t *a, const json_t *b,
                        int depth) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)a, key, value) if (!is_noise(key) || !path[0])
        walk_member(d, path, key, value, field(b, key), depth);
    json_object_foreach((json_t *)b, key, value) if (!field(a, key))
        walk_member(d, path, key, NULL, value, depth);
}

static bool has_objects(const json_t *array) { return json_is_object(json_array_get(array, 0)); }

static void walk(struct difference *d, const char *path, const json_t *a, const json_t *b,
                 int depth) {
    if (depth > DEPTH || json_equal(a, b) || is_small(path, a, b)) return;
    if (json_is_object(a) && json_is_object(b))
        walk_object(d, path, a, b, depth);
    else if (json_is_array(a) && json_is_array(b) && (has_objects(a) || has_objects(b)))
        walk_array(d, path, a, b, depth);
    else
        print_difference(d, path, a, b);
}

/* ---- the verdict ---------------------------------------------------------------------------- */

static bool draws(const json_t *report) { return json_is_true(field(report, "can_draw")); }
static int failed_of(const json_t *report) {
    return count_of(field(report, "self_test"), "failed");
}

/* What `proves` proves and `lacks` does not, after spaces; "": nothing. */
static void list_lost(const json_t *proves, const json_t *lacks, char *out, size_t size) {
    size_t i, k;
    json_t *cap, *other;
    out[0] = 0;
    char name[CELL];
    json_array_foreach(field(field(proves, "gpu"), "proved"), i, cap) {
        bool found = !json_is_string(cap);
        json_array_foreach(field(field(lacks, "gpu"), "proved"), k, other) found |=
            json_equal(cap, other);
        if (found) continue;
        gn_text_format(name, sizeof name, "%s", json_string_value(cap)); /* no control characters */
        gn_text_add(out, size, " %s", name);
    }
}

/* Why `b` is worse than `a`, a phrase after another; "": it is not. ratio: of frame times; 0:
 * unknown. */
static void list_worse(const json_t *a, const json_t *b, double ratio, char *out, size_t size) {
    char lost[CELL];
    out[0] = 0;
    list_lost(a, b, lost, sizeof lost);
    if (draws(a) && !draws(b)) gn_text_add(out, size, "; it does not draw");
    if (failed_of(b) > failed_of(a))
        gn_text_add(out, size, "; %d more rows of the self-test fail", failed_of(b) - failed_of(a));
    if (draws(b) && lost[0]) gn_text_add(out, size, "; not proved:%s", lost);
    if (ratio > SLOWER) gn_text_add(out, size, "; a frame takes %.2f times as long", ratio);
}

static bool have_one_size(const json_t *const reports[2]) {
    const json_t *sizes[2];
    for (int i = 0; i < 2; i++)
        sizes[i] = field(json_array_get(field(field(reports[i], "bench"), "scenes"), 0), "size");
    return (!sizes[0] && !sizes[1]) || json_equal(sizes[0], sizes[1]);
}

/* Whether B is worse. */
static bool print_verdict(const struct difference *d, const json_t *const reports[2]) {
    char worse[2 * CELL], better[2 * CELL];
    const double ratio = d->runs && have_one_size(reports) ? exp(d->log_ratio / d->runs) : 0;
    list_worse(reports[0], reports[1], ratio, worse, sizeof worse);
    list_worse(reports[1], reports[0], ratio > 0 ? 1 / ratio : 0, better, sizeof better);
    fputs("\nverdict: ", d->to);
    if (worse[0]) fprintf(d->to, "B is worse than A: %s", worse + 2);
    if (better[0]) fprintf(d->to, "%sA is worse than B: %s", worse[0] ? ". " : "", better + 2);
    if (!worse[0] && !better[0]) fputs("neither is worse", d->to);
    if (ratio > 0) fprintf(d->to, ". Frames of B take %.2f times those of A", ratio);
    if (is_busy(reports[0]) || is_busy(reports[1]))
        fputs(", while other programs ran: measure again with a machine at rest", d->to);
    fputs(".\n", d->to);
    return worse[0];
}

bool gn_report_compare(const char *const *paths, int count, FILE *to, struct gn_err *err) {
    json_t *reports[GN_SCENES_MAX] = {0};
    bool ok = count > 0 || gn_fail_usage(err, "doctor --compare: name one report or more");
    for (int i = 0; ok && i < count; i++) ok = (reports[i] = gn_report_read(paths[i], err)) != NULL;
    if (ok) gn_report_print_head(to);
    for (int i = 0; ok && i < count; i++) gn_report_print_row(reports[i], to);
    if (ok && count == 2) {
        struct difference d = {.to = to};
        walk(&d, "", reports[0], reports[1], 0);
        if (!d.rows) fputs("\nnothing differs\n", to);
        if (print_verdict(&d, (const json_t *const *)reports)) {
            ok = gn_fail(err, "%.200s is worse than %.200s", paths[1], paths[0]);
            err->status = GN_EXIT_DIFFER;
        }
    }
    for (int i = 0; i < count; i++) json_decref(reports[i]);
    return ok;
}
