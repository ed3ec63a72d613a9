/* What programs take on the compilers of seven GPUs: from the budgets of tests/gpus, which the
 * build joins into one text and embeds. A program that is not among them is estimated. No GL. */
#ifndef GN_COST_PROGRAM_H
#define GN_COST_PROGRAM_H

#include <stdbool.h>

#include "cost/gpu.h"

enum {
    GN_PROGRAM_NAME = 400,     /* bytes for a program's name */
    GN_PROGRAM_NAME_CUT = 199, /* longer ones are cut in the table */
};
struct gn_cost_table; /* of one GPU */
/* text: as board/programs.awk writes it: a line for each program, a column for each GPU. NULL: it
 * has no such GPU. The text must outlive it. */
struct gn_cost_table *gn_cost_table_create(const char *text, const char *gpu);
void gn_cost_table_destroy(struct gn_cost_table *table);
int gn_cost_table_count(const struct gn_cost_table *table);
const char *gn_cost_table_name(const struct gn_cost_table *table, int i);

struct gn_program_cost {
    double fragment;                   /* instructions of a lane */
    double vertex;                     /* instructions of a vertex, in all stages */
    double fetches;                    /* of a lane, in the fragment stage */
    bool estimated, fetches_estimated; /* the instructions, the fetches */
    const char *nearest; /* estimated: the program of the table that it was reckoned from */
};
/* name: as gn_gl_key_text() writes it. What is not in the table costs as much as the nearest one of
 * its kind that is, and what words of the name cost that only one of them has: a least-squares fit
 * of all programs of the kind. False: the table has no program of the kind. `without`: a row that
 * is taken as if it were not there, for tests; or -1. Fits are kept in the table: not for two
 * threads at a time. */
bool gn_cost_table_find(const struct gn_cost_table *table, const char *name, int without,
                        struct gn_program_cost *out);

#endif
