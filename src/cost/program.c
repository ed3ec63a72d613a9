#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "cost/private.h"

enum { FRAGMENT, VERTEX, FETCHES, FIGURES };

struct row {
    char *name;
    double figures[FIGURES]; /* -1: not known */
    struct gn_cost_words words;
    int kind_length; /* of the name's first word */
};
struct kind;
struct gn_cost_table {
    struct row *rows;
    struct kind **kinds; /* by the first row of a kind and by figure, made when first wanted */
    int count, room;
    struct gn_cost_vocabulary vocabulary;
};

/* ---- reading ---- */

/* The number of the column, from 0, that a GPU has in the first line; -1: none. */
static int column_of(const char *line, const char *gpu) {
    const size_t length = strlen(gpu), all = strcspn(line, "\n");
    int column = -2;
    for (const char *at = line; at < line + all; at += strcspn(at, "\t\n") + 1, column++)
        if (column >= 0 && strcspn(at, "\t\n") == length && strncmp(at, gpu, length) == 0)
            return column;
    return -1;
}

/* The field after so many tabs. */
static double number_at(const char *line, int tabs) {
    for (; tabs > 0; tabs--) line += strcspn(line, "\t\n") + 1;
    return strtod(line, NULL);
}

static void add_row(struct gn_cost_table *table, const char *line, int column) {
    struct row row = {.figures = {number_at(line, 2 + 2 * column), number_at(line, 3 + 2 * column),
                                  number_at(line, 1)}};
    if (row.figures[FRAGMENT] < 0) return;
    const size_t length = strcspn(line, "\t");
    row.name = gn_xalloc(length + 1, 1);
    memcpy(row.name, line, length);
    row.kind_length = (int)strcspn(row.name, " ,");
    row.words = gn_cost_words_of(&table->vocabulary, row.name, false);
    if (table->count == table->room) {
        table->room = table->room ? 2 * table->room : 64;
        table->rows = gn_xrealloc(table->rows, (size_t)table->room, sizeof *table->rows);
    }
    table->rows[table->count++] = row;
}

struct gn_cost_table *gn_cost_table_create(const char *text, const char *gpu) {
    const int column = column_of(text, gpu);
    if (column < 0) return NULL;
    struct gn_cost_table *table = gn_xalloc(1, sizeof *table);
    for (const char *line = strchr(text, '\n'); line && line[1]; line = strchr(line + 1, '\n'))
        add_row(table, line + 1, column);
    table->kinds = gn_xalloc((size_t)FIGURES * ((size_t)table->count + 1), sizeof(struct kind *));
    return table;
}

int gn_cost_table_count(const struct gn_cost_table *table) { return table->count; }
const char *gn_cost_table_name(const struct gn_cost_table *table, int i) {
    return table->rows[i].name;
}

/* ---- estimating ---- */

static bool is_of_kind(const struct row *row, const char *name) {
    return strncmp(row->name, name, (size_t)row->kind_length) == 0 &&
           strcspn(name, " ,") == (size_t)row->kind_length;
}

/* How often the first has each word more than the second. */
static void subtract_words(const struct gn_cost_words *a, const struct gn_cost_words *b,
                           double *difference, int words) {
    memset(difference, 0, (size_t)words * sizeof *difference);
    for (int i = 0; i < a->count; i++) difference[a->at[i]] += 1;
    for (int i = 0; i < b->count; i++) difference[b->at[i]] -= 1;
}

/* What a word costs unless programs say otherwise: a texture is one fetch. */
static double usual_cost(const char *word, int figure) {
    static const char suffix[] = "_TEXTURE";
    const size_t length = strlen(word), of_suffix = sizeof suffix - 1;
    const bool texture = length > of_suffix && strcmp(word + length - of_suffix, suffix) == 0;
    return figure == FETCHES &&
                   (texture || strcmp(word, "ENVIRONMENT") == 0 || strcmp(word, "OCCLUDED") == 0)
               ? 1
               : 0;
}

/* What is fitted: all words, but of fetches only those of techniques, maps and steps, which are
 * written small. A feature reads what usual_cost() says. */
static struct gn_cost_words words_to_fit(const struct gn_cost_table *table,
                                         const struct gn_cost_words *all, int figure) {
    struct gn_cost_words words = {.count = 0};
    for (int i = 0; i < all->count; i++) {
        const char first = table->vocabulary.words[all->at[i]][0];
        if (figure != FETCHES || (first >= 'a' && first <= 'z'))
            words.at[words.count++] = all->at[i];
    }
    return words;
}

struct kind { /* the rows of a program's kind that know a figure */
    const struct row **rows;
    double weights[GN_COST_FIT_MAX + 1];
    int count;
};

static void destroy_kind(struct kind *kind) {
    if (kind) free(kind->rows);
    free(kind);
}

void gn_cost_table_destroy(struct gn_cost_table *table) {
    for (int i = 0; table && i < table->count; i++) free(table->rows[i].name);
    if (!table) return;
    for (int i = 0; i < FIGURES * (table->count + 1); i++) destroy_kind(table->kinds[i]);
    free(table->kinds);
    free(table->rows);
    free(table->vocabulary.words);
    free(table);
}

static struct kind *fit_kind(const struct gn_cost_table *table, const char *name, int without,
                             int figure) {
    struct kind *kind = gn_xalloc(1, sizeof *kind);
    const size_t room = (size_t)table->count + 1;
    struct gn_cost_words *words = gn_xalloc(room, sizeof *words);
    double *y = gn_xalloc(room, sizeof *y);
    kind->rows = gn_xalloc(room, sizeof(const struct row *));
    for (int i = 0; i < table->count; i++) {
        const struct row *row = &table->rows[i];
        if (i == without || !is_of_kind(row, name) || row->figures[figure] < 0) continue;
        words[kind->count] = words_to_fit(table, &row->words, figure);
        y[kind->count] = row->figures[figure];
        for (int w = 0; w < row->words.count; w++)
            y[kind->count] -= usual_cost(table->vocabulary.words[row->words.at[w]], figure);
        kind->rows[kind->count++] = row;
    }
    if (kind->count > 0) gn_cost_fit(words, y, kind->count, table->vocabulary.count, kind->weights);
    for (int w = 0; w < table->vocabulary.count; w++)
        kind->weights[w] += usual_cost(table->vocabulary.words[w], figure);
    free(words);
    free(y);
    return kind;
}

/* The kind of all its rows, which is fitted once. The table owns it. */
static const struct kind *find_kind(const struct gn_cost_table *table, const char *name,
                                    int figure) {
    int first = 0;
    while (first < table->count && !is_of_kind(&table->rows[first], name)) first++;
    struct kind **kind = &table->kinds[FIGURES * first + figure];
    if (!*kind) *kind = fit_kind(table, name, -1, figure);
    return *kind;
}

/* The figure of the row that differs least from the words, and what the difference costs. */
static double estimate(const struct kind *kind, const struct gn_cost_words *words, int vocabulary,
                       int figure, const char **nearest) {
    double least = INFINITY, value = -1, difference[GN_COST_FIT_MAX + 1];
    for (int i = 0; i < kind->count; i++) {
        double distance = 0, sum = kind->rows[i]->figures[figure];
        subtract_words(words, &kind->rows[i]->words, difference, vocabulary);
        for (int w = 0; w < vocabulary; w++) {
            distance += fabs(difference[w]) * (0.01 + fabs(kind->weights[w]));
            sum += difference[w] * kind->weights[w];
        }
        if (distance >= least) continue;
        least = distance;
        value = fmax(sum, 1);
        *nearest = kind->rows[i]->name;
    }
    return value;
}

static bool is_called(const struct row *row, const char *name) {
    return strcmp(row->name, name) == 0 || (strlen(row->name) == GN_PROGRAM_NAME_CUT &&
                                            strncmp(row->name, name, GN_PROGRAM_NAME_CUT) == 0);
}

bool gn_cost_table_find(const struct gn_cost_table *table, const char *name, int without,
                        struct gn_program_cost *out) {
    double values[FIGURES] = {-1, -1, -1};
    const char *nearest[FIGURES] = {NULL};
    const struct gn_cost_words words =
        gn_cost_words_of((struct gn_cost_vocabulary *)&table->vocabulary, name, true);
    for (int i = 0; i < table->count; i++)
        if (i != without && is_called(&table->rows[i], name))
            memcpy(values, table->rows[i].figures, sizeof values);
    *out = (struct gn_program_cost){.estimated = values[FRAGMENT] < 0,
                                    .fetches_estimated = values[FETCHES] < 0};
    for (int figure = 0; figure < FIGURES; figure++) {
        if (values[figure] >= 0) continue;
        struct kind *rest = without < 0 ? NULL : fit_kind(table, name, without, figure);
        values[figure] = estimate(rest ? rest : find_kind(table, name, figure), &words,
                                  table->vocabulary.count, figure, &nearest[figure]);
        destroy_kind(rest);
    }
    out->fragment = values[FRAGMENT];
    out->vertex = values[VERTEX];
    out->fetches = fmax(values[FETCHES], 0);
    out->nearest = nearest[FRAGMENT];
    return values[FRAGMENT] >= 0;
}
