#include "cli/bench_report.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/units.h"
#include "core/arena.h"
#include "core/json.h"

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double gn_bench_quantile(double *values, uint32_t count, double share) {
    qsort(values, count, sizeof *values, by_value);
    double rank = ceil(share * (double)count);
    return values[rank < 1 ? 0 : (uint32_t)rank - 1];
}

void gn_bench_add_pass(struct gn_bench_run *run, const char *label, double ms) {
    for (uint32_t i = 0; i < run->pass_count; i++)
        if (strcmp(run->passes[i].label, label) == 0) {
            run->passes[i].ms += ms;
            return;
        }
    run->passes = gn_xrealloc(run->passes, run->pass_count + 1, sizeof *run->passes);
    struct gn_bench_pass *pass = &run->passes[run->pass_count++];
    *pass = (struct gn_bench_pass){.ms = ms};
    snprintf(pass->label, sizeof pass->label, "%s", label);
}

void gn_bench_add_name(char *list, const char *name) {
    size_t length = strlen(name), used = strlen(list);
    for (const char *at = list; *at; at += strcspn(at, "+"), at += *at == '+')
        if (strncmp(at, name, length) == 0 && (at[length] == '+' || !at[length])) return;
    if (used + length + 2 > GN_BENCH_NAMES) return;
    snprintf(list + used, GN_BENCH_NAMES - used, "%s%s", used ? "+" : "", name);
}

/* ---- for people ---- */

static void print_mb(FILE *to, const char *what, double mb) {
    if (isnan(mb))
        fprintf(to, "%s unknown", what);
    else
        fprintf(to, "%s %.1f MB", what, mb);
}

static void print_heading(const struct gn_bench_report *r, FILE *to) {
    fprintf(to, "%s, %ux%u, %s\n", r->scene, r->width_px, r->height_px, r->renderer);
    fprintf(to, "first picture %.0f ms after the start, the driver's cache %s; ", r->start_ms,
            r->cache_warm ? "warm" : "cold");
    print_mb(to, "private dirty", r->private_dirty_mb);
    print_mb(to, ", an empty context", r->private_dirty_empty_context_mb);
    fprintf(to, "\n\n");
}

static void print_run(const struct gn_bench_report *r, const struct gn_bench_run *run, FILE *to) {
    const struct gn_gl_stats *s = &run->stats;
    fprintf(to, "%-9s %-8s %-6s %7.2f %7.2f %7.2f ", run->technique, run->map_format, run->output,
            run->ms_median, run->ms_p95, run->cpu_ms);
    fprintf(to, "%6.2f %6u %7u %6u %9" PRIu64 " %7.1f %s\n", run->cpu_ms / r->runs[0].cpu_ms,
            s->draws, s->shadow_draws, s->gl_calls, s->triangles, GN_MB(s->target_bytes),
            run->idle ? "yes" : "no");
}

static void print_passes(const struct gn_bench_run *run, FILE *to) {
    for (uint32_t i = 0; i < run->pass_count; i++)
        fprintf(to, "%-9s %7.2f  %s\n", i ? "" : run->technique, run->passes[i].ms,
                run->passes[i].label);
}

void gn_bench_print(const struct gn_bench_report *report, FILE *to) {
    print_heading(report, to);
    fprintf(to, "technique map      output  median     p95  cpu ms  ratio  draws shadows  calls "
                "triangles targets idle\n");
    for (uint32_t i = 0; i < report->run_count; i++) print_run(report, &report->runs[i], to);
    fprintf(to, "\npass           ms  (in a run of its own, with a read-back after each)\n");
    for (uint32_t i = 0; i < report->run_count; i++) print_passes(&report->runs[i], to);
}

/* ---- for programs ---- */

/* To the microsecond. */
static json_t *number(double value) { return gn_json_make_number(round(value * 1000.0) / 1000.0); }

static json_t *passes_json(const struct gn_bench_run *run) {
    json_t *list = json_array();
    for (uint32_t i = 0; i < run->pass_count; i++)
        json_array_append_new(list, json_pack("{s:o, s:o}", "label",
                                              gn_json_make_text(run->passes[i].label), "ms",
                                              number(run->passes[i].ms)));
    return list;
}

static json_t *run_json(const struct gn_bench_run *run) {
    const struct gn_gl_stats *s = &run->stats;
    json_t *object = json_object();
    json_object_set_new(object, "technique", gn_json_make_text(run->technique));
    json_object_set_new(object, "map_format", gn_json_make_text(run->map_format));
    json_object_set_new(object, "output", gn_json_make_text(run->output));
    json_object_set_new(object, "frames", gn_json_make_count(run->frames));
    json_object_set_new(object, "ms_median", number(run->ms_median));
    json_object_set_new(object, "ms_p95", number(run->ms_p95));
    json_object_set_new(object, "cpu_ms", number(run->cpu_ms));
    json_object_set_new(object, "passes", passes_json(run));
    json_object_set_new(object, "draws", gn_json_make_count(s->draws));
    json_object_set_new(object, "gl_calls", gn_json_make_count(s->gl_calls));
    json_object_set_new(object, "triangles", gn_json_make_count(s->triangles));
    json_object_set_new(object, "shadow_draws", gn_json_make_count(s->shadow_draws));
    json_object_set_new(object, "target_bytes", gn_json_make_count(s->target_bytes));
    json_object_set_new(object, "idle", json_boolean(run->idle));
    return object;
}

static json_t *report_json(const struct gn_bench_report *r) {
    char size[32];
    snprintf(size, sizeof size, "%ux%u", r->width_px, r->height_px);
    json_t *object = json_object(), *runs = json_array();
    json_object_set_new(object, "gl_renderer", gn_json_make_text(r->renderer));
    json_object_set_new(object, "scene", gn_json_make_text(r->scene));
    json_object_set_new(object, "size", gn_json_make_text(size));
    json_object_set_new(object, "start_to_first_picture_ms", number(r->start_ms));
    json_object_set_new(object, "cache", gn_json_make_text(r->cache_warm ? "warm" : "cold"));
    json_object_set_new(object, "private_dirty_mb", number(r->private_dirty_mb));
    json_object_set_new(object, "private_dirty_empty_context_mb",
                        number(r->private_dirty_empty_context_mb));
    for (uint32_t i = 0; i < r->run_count; i++) json_array_append_new(runs, run_json(&r->runs[i]));
    json_object_set_new(object, "runs", runs);
    return object;
}

bool gn_bench_print_json(const struct gn_bench_report *report, FILE *to, struct gn_err *err) {
    return gn_json_print(report_json(report), 9, to, err);
}
