/* The report of `gnomon doctor --report`: one file that a user sends, and that others compare. It
 * has what of doctor's JSON names neither a machine nor a person, the self-test, and benches of the
 * default scene and of a model without lights of its own, as gnomon shows it by itself: at
 * 1280x720, where the CPU draws at 640x360.
 *
 * One object: gnomon_report (GN_REPORT_VERSION), version, built, can_draw; machine, backends, gpu,
 * cards, connectors, gpio, input, problems and self_test with those fields of
 * gn_doctor_print_json() that report.c lists; bench {load (runnable processes per CPU, before),
 * scenes
 * [{scene, ..} as of gn_bench_json(), or {scene, failure}]}. All texts have gone through
 * gn_redact_text(). */
#ifndef GN_CLI_REPORT_H
#define GN_CLI_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "cli/doctor_report.h"
#include "core/redact.h"

enum { GN_REPORT_VERSION = 1, GN_REPORT_BYTES = 1 << 20 /* at most, of a file that is read */ };

/* The report's object: of doctor's JSON what is allowed, with the benches (both references are
 * taken). A new reference. */
json_t *gn_report_make(json_t *doctor, json_t *bench, const struct gn_redact *redact);

/* report_bench.c: measures on the backend that doctor chose, each scene in a process of its own. */
json_t *gn_report_bench(const struct gn_doctor_report *report, const struct gn_settings *settings);

/* Measures, writes the file of -o, and prints its row of the table. */
bool gn_report_write(const struct gn_doctor_report *report, const struct gn_settings *settings,
                     struct gn_err *err);

/* report_read.c: reads a report; NULL with one line where the file is none, is cut, too large or of
 * another version. */
json_t *gn_report_read(const char *path, struct gn_err *err);

/* report_compare.c: the rows of a table, in Markdown; of two reports also what differs, times with
 * their ratio, and a verdict. Fails with GN_EXIT_DIFFER where the second is worse: it draws no
 * longer, fails more of the self-test, proves less, or takes over a quarter longer for a frame. */
bool gn_report_compare(const char *const *paths, int count, FILE *to, struct gn_err *err);
void gn_report_print_head(FILE *to);
void gn_report_print_row(const json_t *report, FILE *to);

#endif
