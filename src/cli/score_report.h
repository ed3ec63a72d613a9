/* What `gnomon score` prints: each picture, then the means of each class and kind of light. */
#ifndef GN_CLI_SCORE_REPORT_H
#define GN_CLI_SCORE_REPORT_H

#include <stdio.h>

#include "truth/benchmark.h"

enum { GN_SCORE_NAME = 64 };
struct gn_score_row {
    char scene[GN_SCORE_NAME];
    struct gn_benchmark_name name;
    struct gn_benchmark_score score;
};
struct gn_score_report {
    struct gn_score_row *rows; /* owned by the caller */
    size_t row_count;
    double reach_texels;
};
enum gn_score_form { GN_SCORE_TEXT, GN_SCORE_JSON, GN_SCORE_CSV };
bool gn_score_print(const struct gn_score_report *report, enum gn_score_form form, FILE *to,
                    struct gn_err *err);

#endif
