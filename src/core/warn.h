/* Warnings: problems that stop nothing. They are collected and printed by main() at the end, on
 * success or with -v; by a kiosk, which runs for months, as they come. The size is fixed, so that a
 * hostile file cannot make it grow: of those that are printed the oldest makes room. Equal texts
 * are kept once. */
#ifndef GN_CORE_WARN_H
#define GN_CORE_WARN_H

#include <stdio.h>

#define GN_WARN_MAX 32

struct gn_warnings {
    int count;   /* texts held, at most GN_WARN_MAX */
    int dropped; /* different texts beyond that, before any was printed */
    int printed; /* the first so many texts, by gn_warn_flush() */
    char text[GN_WARN_MAX][256];
};

/* warnings may be NULL: then nothing is kept. One line each; control characters are escaped. */
void gn_warn(struct gn_warnings *warnings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Prints one "gnomon: warning: .." line for each that is not printed yet. */
void gn_warn_flush(struct gn_warnings *warnings, FILE *to);
/* The same at the end, then "and N more". */
void gn_warn_print(struct gn_warnings *warnings, FILE *to);

#endif
