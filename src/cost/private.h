/* What files of this room share. */
#ifndef GN_COST_PRIVATE_H
#define GN_COST_PRIVATE_H

#include "cost/program.h"

/* fit.c: the words of a program's name, and what each costs. */
enum { GN_COST_WORDS_MAX = 64, GN_COST_FIT_MAX = 320 };
struct gn_cost_words { /* of a name: indices into a vocabulary, each as often as it occurs */
    int at[GN_COST_WORDS_MAX], count;
};
struct gn_cost_vocabulary {
    char (*words)[48];
    int count, room;
};
/* Adds words that are new, unless `fixed`: then those are left out. A light is a word for its kind,
 * one for its technique, one for the technique with its encoding, and one for each of the rest. */
struct gn_cost_words gn_cost_words_of(struct gn_cost_vocabulary *v, const char *name, bool fixed);

/* Ridge regression: weights of `words` (and last of a constant) so that for each row the sum of its
 * words' is nearest y. weights: words + 1. */
void gn_cost_fit(const struct gn_cost_words *rows, const double *y, int count, int words,
                 double *weights);

#endif
