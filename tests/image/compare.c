#include "image/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/arena.h"
#include "image/measure.h"

/* --- colours --- */

bool gn_compare(const struct gn_picture *a, const struct gn_picture *b, double tolerance,
                struct gn_difference *difference) {
    struct gn_measure m;
    *difference = (struct gn_difference){.max = INFINITY, .share = INFINITY};
    if (a->width_px != b->width_px || a->height_px != b->height_px || a->channels != b->channels)
        return false;
    gn_measure(a->data, b->data, (size_t)a->width_px, (size_t)a->height_px, a->channels, tolerance,
               &m);
    *difference = (struct gn_difference){m.max, m.share, (int)m.worst_x, (int)m.worst_y};
    return true;
}

/* --- edges of a mask --- */

/* How far the point of j lies off the plane of i. */
static double off_plane(const struct gn_mask_truth *t, size_t i, size_t j) {
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += (double)t->normal_ws[3 * i + k] * (t->point_ws[3 * j + k] - t->point_ws[3 * i + k]);
    return fabs(sum);
}

static bool differs(const struct gn_mask_truth *t, size_t i, size_t j) {
    if (t->lit[i] != t->lit[j] || t->item[i] != t->item[j]) return true;
    if (t->item[i] < 0) return false;
    const float *a = &t->normal_ws[3 * i], *b = &t->normal_ws[3 * j];
    if (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < .70710678f) return true;
    double step = fmin(off_plane(t, i, j), off_plane(t, j, i));
    return step > .02 * fmin(t->distance_m[i], t->distance_m[j]);
}

static bool is_edge(const struct gn_mask_truth *t, int x, int y) {
    size_t here = (size_t)y * t->width_px + x;
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < t->height_px; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < t->width_px; u++) {
            size_t there = (size_t)v * t->width_px + u;
            if (there != here && differs(t, here, there)) return true;
        }
    return false;
}

/* One row or column: out[i] = min over j of (i - j)^2 + f[j], by the lower envelope of parabolas.
 */
static void envelope(const float *f, int n, float *out, int *at, double *from) {
    int k = -1;
    for (int j = 0; j < n; j++) {
        if (isinf(f[j])) continue;
        double s = -INFINITY;
        while (k >= 0) {
            int i = at[k];
            s = ((f[j] + (double)j * j) - (f[i] + (double)i * i)) / (2.0 * (j - i));
            if (s > from[k]) break;
            k--;
        }
        if (k < 0) s = -INFINITY;
        at[++k] = j;
        from[k] = s;
    }
    int last = k;
    k = 0;
    for (int i = 0; i < n; i++) {
        while (k < last && from[k + 1] < i) k++;
        out[i] = last < 0 ? INFINITY : (float)(i - at[k]) * (float)(i - at[k]) + f[at[k]];
    }
}

void gn_mask_edges(const struct gn_mask_truth *truth, float *out) {
    int w = truth->width_px, h = truth->height_px, n = w > h ? w : h;
    float *line = gn_xalloc(2 * (size_t)n, sizeof *line);
    double *from = gn_xalloc(n, sizeof *from);
    int *at = gn_xalloc(n, sizeof *at);
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) line[x] = is_edge(truth, x, y) ? 0 : INFINITY;
        envelope(line, w, out + (size_t)y * w, at, from);
    }
    for (int x = 0; x < w; x++) {
        for (int y = 0; y < h; y++) line[y] = out[(size_t)y * w + x];
        envelope(line, h, line + n, at, from);
        for (int y = 0; y < h; y++) out[(size_t)y * w + x] = sqrtf(line[n + y]);
    }
    free(line);
    free(from);
    free(at);
}

/* --- masks --- */

static bool is_away(const struct gn_mask_truth *truth, const float *edges, size_t i) {
    return edges[i] > (truth->band_px ? fmaxf(2, truth->band_px[i]) : 2);
}

static bool is_safe(const struct gn_mask_truth *truth, const float *edges, size_t i) {
    return truth->lit[i] && edges[i] >= (truth->safe_px ? truth->safe_px[i] : 5);
}

/* What is no number is dark. */
static double darkness_of(const struct gn_picture *shot, size_t i) {
    double seen = shot->data[i * shot->channels];
    return isnan(seen) ? 1 : fmax(0, fmin(1, 1 - seen));
}

static bool shot_is_lit(const struct gn_picture *shot, size_t i) {
    return shot->data[i * shot->channels] >= .5f;
}

void gn_mask_compare(const struct gn_mask_truth *truth, const struct gn_picture *shot,
                     struct gn_mask_score *score) {
    size_t pixels = (size_t)truth->width_px * truth->height_px;
    float *edges = gn_xalloc(pixels, sizeof *edges);
    gn_mask_edges(truth, edges);
    *score = (struct gn_mask_score){.pixels = pixels};
    for (size_t i = 0; i < pixels; i++) {
        bool away = is_away(truth, edges, i), lit = truth->lit[i], shown = shot_is_lit(shot, i);
        score->lit += lit;
        score->dark += !lit;
        score->away_lit += away && lit;
        score->away_dark += away && !lit;
        score->acne += away && lit && !shown;
        score->leak += away && !lit && shown;
        score->gap += !lit && shown;
        score->wrong += lit != shown;
        if (!is_safe(truth, edges, i)) continue;
        double darkness = darkness_of(shot, i);
        score->safe++;
        score->darkness += darkness;
        score->darkened += darkness > .05;
    }
    free(edges);
}

static double percent(uint64_t part, uint64_t of) {
    return of ? 100.0 * (double)part / (double)of : 0;
}
double gn_mask_acne(const struct gn_mask_score *s) { return percent(s->acne, s->away_lit); }
double gn_mask_darkening(const struct gn_mask_score *s) {
    return s->safe ? 100 * s->darkness / (double)s->safe : 0;
}
double gn_mask_darkened(const struct gn_mask_score *s) { return percent(s->darkened, s->safe); }
double gn_mask_leak(const struct gn_mask_score *s) { return percent(s->leak, s->away_dark); }
double gn_mask_gap(const struct gn_mask_score *s) { return percent(s->gap, s->dark); }
double gn_mask_wrong(const struct gn_mask_score *s) { return percent(s->wrong, s->pixels); }

/* --- failures as pictures --- */

static void make_folder(const char *path) {
    char part[512];
    snprintf(part, sizeof part, "%s", path);
    for (char *p = part + 1; *p; p++) {
        if (*p != '/') continue;
        *p = 0;
        mkdir(part, 0777);
        *p = '/';
    }
    mkdir(part, 0777);
}

static void save(const char *folder, const char *name, const char *kind,
                 const struct gn_picture *picture) {
    char path[1024];
    struct gn_err err = {{0}, GN_EXIT_RUNTIME};
    bool failed = !folder;
    if (failed) folder = "build/failures";
    make_folder(folder);
    snprintf(path, sizeof path, "%s/%s-%s.png", folder, name, kind);
    if (!gn_picture_write_png(picture, path, &err))
        printf("  %s\n", err.text);
    else if (failed)
        printf("  %s\n", path);
}

static void mask_diff(const struct gn_mask_truth *truth, const struct gn_picture *shot,
                      const float *edges, struct gn_picture *out) {
    gn_picture_init(out, truth->width_px, truth->height_px, 3);
    for (size_t i = 0; i < (size_t)truth->width_px * truth->height_px; i++) {
        float *rgb = out->data + 3 * i;
        bool lit = truth->lit[i], shown = shot_is_lit(shot, i);
        rgb[0] = rgb[1] = rgb[2] = lit ? .9f : .25f;
        if (lit == shown) continue;
        float rest = is_away(truth, edges, i) ? 0 : .6f;
        rgb[0] = lit ? 1 : rest;
        rgb[1] = rest;
        rgb[2] = lit ? rest : 1;
    }
}

void gn_mask_save(const char *folder, const char *name, const struct gn_mask_truth *truth,
                  const struct gn_picture *shot) {
    size_t pixels = (size_t)truth->width_px * truth->height_px;
    struct gn_picture lit, diff;
    gn_picture_init(&lit, truth->width_px, truth->height_px, 1);
    for (size_t i = 0; i < pixels; i++) lit.data[i] = truth->lit[i];
    float *edges = gn_xalloc(pixels, sizeof *edges);
    gn_mask_edges(truth, edges);
    mask_diff(truth, shot, edges, &diff);
    save(folder, name, "shot", shot);
    save(folder, name, "truth", &lit);
    save(folder, name, "diff", &diff);
    free(edges);
    gn_picture_finish(&lit);
    gn_picture_finish(&diff);
}

void gn_compare_save(const char *folder, const char *name, const struct gn_picture *shot,
                     const struct gn_picture *expected) {
    save(folder, name, "shot", shot);
    save(folder, name, "truth", expected);
    if (shot->width_px != expected->width_px || shot->height_px != expected->height_px ||
        shot->channels != expected->channels)
        return;
    struct gn_picture diff;
    gn_picture_init(&diff, shot->width_px, shot->height_px, shot->channels);
    size_t count = (size_t)shot->width_px * shot->height_px * shot->channels;
    for (size_t i = 0; i < count; i++)
        diff.data[i] = (shot->channels == 4 || shot->channels == 2) &&
                               (int)(i % shot->channels) == shot->channels - 1
                           ? 1
                           : (float)(8 * gn_measure_channel(shot->data[i], expected->data[i]));
    save(folder, name, "diff", &diff);
    gn_picture_finish(&diff);
}
