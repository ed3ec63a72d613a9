#include "cli/bench_report.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/units.h"
#include "core/arena.h"
#include "core/json.h"
#include "shadow/moments.h"

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

static void print_times(const struct gn_bench_report *report, FILE *to) {
    fprintf(to,
            "technique  map format     output  median ms    p95 ms    CPU ms  CPU ratio  idle\n");
    for (uint32_t i = 0; i < report->run_count; i++) {
        const struct gn_bench_run *run = &report->runs[i];
        fprintf(to, "%-10s %-14s %-6s %10.2f %9.2f %9.2f %10.2f  %s\n", run->technique,
                run->map_format, run->output, run->ms_median, run->ms_p95, run->cpu_ms,
                run->cpu_ms / report->runs[0].cpu_ms, run->idle ? "yes" : "no");
    }
}

static void print_counts(const struct gn_bench_report *report, FILE *to) {
    fprintf(to, "\ntechnique   draws  shadow draws  GL calls  triangles  targets MB\n");
    for (uint32_t i = 0; i < report->run_count; i++) {
        const struct gn_bench_run *run = &report->runs[i];
        const struct gn_gl_stats *s = &run->stats;
        fprintf(to, "%-10s %6u %13u %9u %10" PRIu64 " %11.1f\n", run->technique, s->draws,
                s->shadow_draws, s->gl_calls, s->triangles, GN_MB(s->target_bytes));
    }
}

/* A pass's label in words: steps of one kind and light have the same. */
static void write_words(const char *label, char *out, size_t size) {
    unsigned slot;
    int from = 0, end = (int)strlen(label);
    if (sscanf(label, "shadow %u %n", &slot, &from) != 1 || from == 0) {
        snprintf(out, size, "%s",
                 strcmp(label, "opaque") == 0  ? "solid surfaces"
                 : strcmp(label, "blend") == 0 ? "transparent surfaces"
                                               : label);
        return;
    }
    const char *what = "map";
    while (end > from && strchr(" 0123456789", label[end - 1])) end--; /* how far a step reads */
    for (int i = 0; i < GN_STEP_COUNT; i++) {
        const int length = (int)strlen(gn_filter_steps[i].name), at = end - length;
        if (at <= from || label[at - 1] != ' ' ||
            strncmp(label + at, gn_filter_steps[i].name, (size_t)length) != 0)
            continue;
        what = gn_filter_steps[i].words;
        end = at - 1;
        break;
    }
    snprintf(out, size, "shadow of %.*s: %s", end - from, label + from, what);
}

static int by_cost(const void *a, const void *b) {
    const struct gn_bench_pass *x = a, *y = b;
    return (x->ms < y->ms) - (x->ms > y->ms);
}

/* The dearest first; those below .005 ms are left out. */
static void print_passes(const struct gn_bench_run *run, FILE *to) {
    struct gn_bench_run sums = {0};
    const char *technique = run->technique;
    for (uint32_t k = 0; k < run->pass_count; k++) {
        char words[sizeof run->passes[k].label];
        write_words(run->passes[k].label, words, sizeof words);
        gn_bench_add_pass(&sums, words, run->passes[k].ms);
    }
    if (sums.pass_count) qsort(sums.passes, sums.pass_count, sizeof *sums.passes, by_cost);
    for (uint32_t k = 0; k < sums.pass_count && sums.passes[k].ms >= .005; k++, technique = "")
        fprintf(to, "%-10s %11.2f  %s\n", technique, sums.passes[k].ms, sums.passes[k].label);
    free(sums.passes);
}

void gn_bench_print(const struct gn_bench_report *report, FILE *to) {
    fprintf(to, "%s, %ux%u, %s\n", report->scene, report->width_px, report->height_px,
            report->renderer);
    if (!isnan(report->start_ms)) {
        fprintf(to, "first picture %.0f ms after the start, the driver's cache %s; ",
                report->start_ms, report->cache_warm ? "warm" : "cold");
        print_mb(to, "private dirty", report->private_dirty_mb);
        print_mb(to, ", an empty context", report->private_dirty_empty_context_mb);
        fprintf(to, "\n");
    }
    fprintf(to, "\n");
    print_times(report, to);
    print_counts(report, to);
    fprintf(to, "\npass                ms  (in a run of its own, with a read-back after each)\n");
    for (uint32_t i = 0; i < report->run_count; i++) print_passes(&report->runs[i], to);
    for (uint32_t i = 0; i < report->run_count; i++)
        if (report->runs[i].time)
            fprintf(to, "\n%s%s", report->runs[i].technique, report->runs[i].time);
}

/* ---- for programs ---- */

/* To the microsecond. */
static json_t *number_json(double value) {
    return gn_json_make_number(round(value * 1000.0) / 1000.0);
}

json_t *gn_bench_json(const struct gn_bench_report *report) {
    char size[32];
    snprintf(size, sizeof size, "%ux%u", report->width_px, report->height_px);
    json_t *object = json_object(), *runs = json_array();
    json_object_set_new(object, "gl_renderer", gn_json_make_text(report->renderer));
    json_object_set_new(object, "scene", gn_json_make_text(report->scene));
    json_object_set_new(object, "size", gn_json_make_text(size));
    json_object_set_new(object, "start_to_first_picture_ms", number_json(report->start_ms));
    json_object_set_new(object, "cache", gn_json_make_text(report->cache_warm ? "warm" : "cold"));
    json_object_set_new(object, "private_dirty_mb", number_json(report->private_dirty_mb));
    json_object_set_new(object, "private_dirty_empty_context_mb",
                        number_json(report->private_dirty_empty_context_mb));
    for (uint32_t i = 0; i < report->run_count; i++) {
        const struct gn_bench_run *r = &report->runs[i];
        json_t *run = json_object(), *passes = json_array();
        for (uint32_t k = 0; k < r->pass_count; k++)
            json_array_append_new(passes, json_pack("{s:o, s:o}", "label",
                                                    gn_json_make_text(r->passes[k].label), "ms",
                                                    number_json(r->passes[k].ms)));
        json_object_set_new(run, "technique", gn_json_make_text(r->technique));
        json_object_set_new(run, "map_format", gn_json_make_text(r->map_format));
        json_object_set_new(run, "output", gn_json_make_text(r->output));
        json_object_set_new(run, "frames", gn_json_make_count(r->frames));
        json_object_set_new(run, "ms_median", number_json(r->ms_median));
        json_object_set_new(run, "ms_p95", number_json(r->ms_p95));
        json_object_set_new(run, "cpu_ms", number_json(r->cpu_ms));
        json_object_set_new(run, "passes", passes);
        json_object_set_new(run, "draws", gn_json_make_count(r->stats.draws));
        json_object_set_new(run, "gl_calls", gn_json_make_count(r->stats.gl_calls));
        json_object_set_new(run, "triangles", gn_json_make_count(r->stats.triangles));
        json_object_set_new(run, "shadow_draws", gn_json_make_count(r->stats.shadow_draws));
        json_object_set_new(run, "target_bytes", gn_json_make_count(r->stats.target_bytes));
        json_object_set_new(run, "idle", json_boolean(r->idle));
        if (r->time_json) json_object_set(run, "time", r->time_json);
        json_array_append_new(runs, run);
    }
    json_object_set_new(object, "runs", runs);
    return object;
}

bool gn_bench_print_json(const struct gn_bench_report *reports, uint32_t count, FILE *to,
                         struct gn_err *err) {
    if (count == 1) return gn_json_print(gn_bench_json(reports), 9, to, err);
    json_t *scenes = json_array();
    for (uint32_t i = 0; i < count; i++) json_array_append_new(scenes, gn_bench_json(&reports[i]));
    return gn_json_print(json_pack("{so}", "scenes", scenes), 9, to, err);
}

static void print_csv_text(const char *text, FILE *to) {
    fputc('"', to);
    for (; *text; text++) {
        if (*text == '"') fputc('"', to);
        if ((unsigned char)*text >= ' ') fputc(*text, to);
    }
    fputs("\",", to);
}

static void print_csv_number(double value, FILE *to) {
    if (!isnan(value)) fprintf(to, "%.3f", value);
    fputc(',', to);
}

void gn_bench_print_csv(const struct gn_bench_report *reports, uint32_t count, FILE *to) {
    fputs("scene,gl_renderer,technique,map_format,width_px,height_px,output,"
          "start_to_first_picture_ms,ms_median,ms_p95,cpu_ms,frames,draws,gl_calls,triangles,"
          "shadow_draws,target_bytes,idle\n",
          to);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < reports[i].run_count; k++) {
            const struct gn_bench_run *run = &reports[i].runs[k];
            const struct gn_gl_stats *s = &run->stats;
            print_csv_text(reports[i].scene, to);
            print_csv_text(reports[i].renderer, to);
            print_csv_text(run->technique, to);
            print_csv_text(run->map_format, to);
            fprintf(to, "%u,%u,%s,", reports[i].width_px, reports[i].height_px, run->output);
            const double times[] = {reports[i].start_ms, run->ms_median, run->ms_p95, run->cpu_ms};
            for (int t = 0; t < 4; t++) print_csv_number(times[t], to);
            fprintf(to, "%u,%u,%u,%" PRIu64 ",%u,%" PRIu64 ",%s\n", run->frames, s->draws,
                    s->gl_calls, s->triangles, s->shadow_draws, s->target_bytes,
                    run->idle ? "yes" : "no");
        }
}
