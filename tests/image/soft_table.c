#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "image/soft.h"

enum column { SUN, SPOT, POINT, FLOOR, MODEL, COLUMNS };
static const char *const heads[COLUMNS] = {"sun", "spot", "point", "default: floor",
                                           "default: model"};

/* Sums of a technique; of each column its own count, since not every picture has such pixels. */
struct row {
    struct gn_tear_score sum[COLUMNS];
    int count[COLUMNS];
};

static void add_score(struct row *row, enum column column, const struct gn_tear_score *score) {
    if (isnan(score->tear)) return;
    row->sum[column].tear += score->tear;
    row->sum[column].grain += score->grain;
    row->sum[column].rmse += score->rmse;
    row->count[column]++;
}

static enum column column_of(int scene) {
    switch (gn_penumbra_light(scene)) {
    case GN_LIGHT_DIRECTIONAL: return SUN;
    case GN_LIGHT_SPOT: return SPOT;
    default: return POINT;
    }
}

/* Returns how many pictures failed. */
static int measure_scene(int scene, const char *const techniques[], int count, int width_px,
                         int height_px, struct row *rows, FILE *to) {
    struct gn_err err = {0};
    struct gn_soft soft;
    int failures = 0;
    if (!gn_soft_init(&soft, scene, width_px, height_px, &err)) {
        fprintf(to, "%s\n", err.text);
        return count;
    }
    for (int t = 0; t < count; t++) {
        struct gn_tear_score score[GN_TEAR_PARTS];
        struct gn_picture shot;
        if (!gn_soft_shoot(&soft, techniques[t], &shot, &err)) {
            fprintf(to, "%s\n", err.text);
            failures++;
            continue;
        }
        gn_soft_compare(&soft, &shot, score);
        if (scene == GN_SOFT_DEFAULT) {
            add_score(&rows[t], FLOOR, &score[GN_TEAR_FLOOR]);
            add_score(&rows[t], MODEL, &score[GN_TEAR_SURFACE]);
        } else {
            add_score(&rows[t], column_of(scene), &score[GN_TEAR_ALL]);
        }
        gn_picture_finish(&shot);
    }
    gn_soft_finish(&soft);
    return failures;
}

static void print_row(const char *technique, const struct row *row, FILE *to, FILE *csv) {
    fprintf(to, "%-8s", technique);
    for (int c = 0; c < COLUMNS; c++) {
        const double n = row->count[c] ? row->count[c] : (double)NAN;
        const struct gn_tear_score *sum = &row->sum[c];
        if (!row->count[c])
            fprintf(to, " | %6s %6s %5s", "-", "-", "-");
        else
            fprintf(to, " | %6.4f %6.4f %5.3f", sum->tear / n, sum->grain / n, sum->rmse / n);
        if (!csv || !row->count[c]) continue;
        fprintf(csv, "\"soft: %s\",%s,auto,,tear,%.6f,,,no\n", heads[c], technique, sum->tear / n);
        fprintf(csv, "\"soft: %s\",%s,auto,,grain,%.6f,,,no\n", heads[c], technique,
                sum->grain / n);
    }
    fprintf(to, "\n");
}

int gn_soft_table(const char *const techniques[], int count, int width_px, int height_px, FILE *to,
                  FILE *csv) {
    struct row *rows = gn_xalloc((size_t)count, sizeof *rows);
    int failures = 0;
    for (int scene = 0; scene < GN_SOFT_SCENES; scene++)
        failures += measure_scene(scene, techniques, count, width_px, height_px, rows, to);
    fprintf(to,
            "soft shadows: means over the scenes of tear and grain, per cent per pixel, and of "
            "the RMSE there; -: too few pixels\n%-8s",
            "");
    for (int c = 0; c < COLUMNS; c++) fprintf(to, " | %-19s", heads[c]);
    fprintf(to, "\n");
    for (int t = 0; t < count; t++) print_row(techniques[t], &rows[t], to, csv);
    free(rows);
    return failures;
}
