/* Warnings: problems that stop nothing. They are collected and printed by main() at the end, on
 * success or with -v. The size is fixed, so that a hostile file cannot make it grow; equal texts
 * are kept once. */
#ifndef GN_CORE_WARN_H
#define GN_CORE_WARN_H

#include <stdio.h>

#define GN_WARN_MAX 32

struct gn_warnings {
    int count;   /* texts held, at most GN_WARN_MAX */
    int dropped; /* different texts beyond that */
    char text[GN_WARN_MAX][256];
};

/* warnings may be NULL: then nothing is kept. One line each; control characters are escaped. */
void gn_warn(struct gn_warnings *warnings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* One "gnomon: warning: .." line each, then "and N more". */
void gn_warn_print(const struct gn_warnings *warnings, FILE *to);

#endif
