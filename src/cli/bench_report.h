/* What `gnomon bench` has measured, as text and as JSON. */
#ifndef GN_CLI_BENCH_REPORT_H
#define GN_CLI_BENCH_REPORT_H

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>

#include "core/err.h"
#include "core/warn.h"
#include "gl/gl.h"
#include "options/settings.h"

struct gn_bench_pass {
    char label[48]; /* of the plan; passes with the same label are added up */
    double ms; /* per frame: wall clock around the pass and a read-back, from a run of its own */
};

enum { GN_BENCH_NAMES = 128 }; /* bytes for all names, joined */
struct gn_bench_run {          /* one technique */
    char technique[GN_BENCH_NAMES];
    char map_format[GN_BENCH_NAMES]; /* of its maps: "depth+r16f" if they differ, "none" without
                                        any */
    const char *output;              /* "srgb", "linear" */
    uint32_t frames;
    double ms_median, ms_p95;     /* wall clock of a frame, read-back included */
    double cpu_ms;                /* CPU time of the process, all threads, per frame */
    struct gn_bench_pass *passes; /* in the order of the plan */
    uint32_t pass_count;
    struct gn_gl_stats stats; /* of the last timed frame. target_bytes: of all techniques so far */
    bool idle;                /* the kiosk would draw nothing: no clip, no turntable */
    char *time;               /* of --for: the report of cli/inspect_time.h, as text or as JSON; */
    json_t *time_json;        /* else NULL. Both are freed by the owner */
};

struct gn_bench_report {
    const char *renderer, *scene;
    uint32_t width_px, height_px;
    double start_ms; /* from the start of the process until the first picture is read back; NAN:
                        other scenes came before */
    bool cache_warm; /* all shaders of that picture were in the driver's cache */
    double private_dirty_mb, private_dirty_empty_context_mb; /* 2^20 bytes; NAN: unknown */
    struct gn_bench_run *runs;
    uint32_t run_count;
};

/* The value below which a share 0..1 of the values lies (nearest rank); sorts them. count > 0. */
double gn_bench_quantile(double *values, uint32_t count, double share);
/* Adds ms to the pass with that label; adds the pass if there is none. */
void gn_bench_add_pass(struct gn_bench_run *run, const char *label, double ms);
/* Adds a name to a list joined by '+', of GN_BENCH_NAMES bytes, unless it is in it or does not
 * fit. */
void gn_bench_add_name(char *list, const char *name);

/* Aligned, for people: one row a technique; the ratio is that of cpu_ms to the first row's. */
void gn_bench_print(const struct gn_bench_report *report, FILE *to);
/* What `gnomon bench` measures of the one scene of these settings, as an object of
 * gn_bench_print_json(); start and memory, which are those of the process, are null. NULL with the
 * reason. */
json_t *gn_bench_measure(const struct gn_settings *settings, struct gn_warnings *warnings,
                         struct gn_err *err);
json_t *gn_bench_json(const struct gn_bench_report *report);
/* One JSON object, the fields in the order of the contract; unknown values are null. Of several
 * scenes {"scenes": [..]}, such an object each. */
bool gn_bench_print_json(const struct gn_bench_report *reports, uint32_t count, FILE *to,
                         struct gn_err *err);
/* A head line, and one for each technique of each scene (RFC 4180, but lines end in a newline);
 * unknown values are empty. */
void gn_bench_print_csv(const struct gn_bench_report *reports, uint32_t count, FILE *to);

#endif
