#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "cost/private.h"

/* Of the ridge: a word costs nothing unless programs say so. It holds where words occur together
 * only. */
#define RIDGE 0.3

/* ---- words ---- */

static int find_word(struct gn_cost_vocabulary *v, const char *word, bool fixed) {
    for (int i = 0; i < v->count; i++)
        if (strcmp(v->words[i], word) == 0) return i;
    if (fixed || v->count == GN_COST_FIT_MAX) return -1;
    if (v->count == v->room) {
        v->room = v->room ? 2 * v->room : 32;
        v->words = gn_xrealloc(v->words, (size_t)v->room, sizeof *v->words);
    }
    snprintf(v->words[v->count], sizeof v->words[0], "%s", word);
    return v->count++;
}

static void add_word(struct gn_cost_vocabulary *v, const char *word, bool fixed,
                     struct gn_cost_words *out) {
    const int i = find_word(v, word, fixed);
    if (i >= 0 && out->count < GN_COST_WORDS_MAX) out->at[out->count++] = i;
}

/* "pcf depth" is a word, too, so that a technique whose encoding is new has what is known of it. */
static void add_part(struct gn_cost_vocabulary *v, char *part, bool fixed,
                     struct gn_cost_words *out) {
    char *rest = NULL, before[24] = "", pair[48];
    for (char *word = strtok_r(part, " |", &rest); word; word = strtok_r(NULL, " |", &rest)) {
        add_word(v, word, fixed, out);
        const bool both = before[0] >= 'a' && before[0] <= 'z' && word[0] >= 'a' && word[0] <= 'z';
        snprintf(pair, sizeof pair, "%s %.20s", before, word);
        if (both) add_word(v, pair, fixed, out);
        snprintf(before, sizeof before, "%.20s", word);
    }
}

struct gn_cost_words gn_cost_words_of(struct gn_cost_vocabulary *v, const char *name, bool fixed) {
    struct gn_cost_words out = {.count = 0};
    char text[GN_PROGRAM_NAME], *rest = NULL;
    snprintf(text, sizeof text, "%s", name);
    for (char *part = strtok_r(text, ",", &rest); part; part = strtok_r(NULL, ",", &rest))
        add_part(v, part, fixed, &out);
    return out;
}

/* ---- least squares ---- */

/* row[i] -= factor * other[i]: most words never occur together, so that many factors are 0. */
static void subtract_row(double *restrict row, const double *restrict other, double factor,
                         int count) {
    if (factor == 0) return;
    for (int i = 0; i < count; i++) row[i] -= factor * other[i];
}

/* Solves m x = b by Cholesky's decomposition; m: symmetric, positive, its upper half, overwritten;
 * b becomes x. */
static void solve(double *m, double *b, int n) {
    for (int j = 0; j < n; j++) {
        double *row = m + (size_t)j * (size_t)n;
        for (int k = 0; k < j; k++) {
            const double *other = m + (size_t)k * (size_t)n;
            subtract_row(row + j, other + j, other[j], n - j);
        }
        row[j] = sqrt(row[j]);
        for (int i = j + 1; i < n; i++) row[i] /= row[j];
    }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) b[i] -= m[k * n + i] * b[k];
        b[i] /= m[i * n + i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) b[i] -= m[i * n + k] * b[k];
        b[i] /= m[i * n + i];
    }
}

void gn_cost_fit(const struct gn_cost_words *rows, const double *y, int count, int words,
                 double *weights) {
    const int n = words + 1;
    double *m = gn_xalloc((size_t)n * (size_t)n, sizeof *m), *x = gn_xalloc((size_t)n, sizeof *x);
    memset(weights, 0, (size_t)n * sizeof *weights);
    for (int row = 0; row < count; row++) {
        memset(x, 0, (size_t)n * sizeof *x);
        for (int i = 0; i < rows[row].count; i++) x[rows[row].at[i]] += 1;
        x[words] = 1;
        for (int i = 0; i < n; i++) {
            for (int k = i; k < n && x[i] != 0; k++) m[i * n + k] += x[i] * x[k];
            weights[i] += x[i] * y[row];
        }
    }
    for (int i = 0; i < n; i++) m[i * n + i] += i < words ? RIDGE : 1e-6;
    solve(m, weights, n);
    free(x);
    free(m);
}
