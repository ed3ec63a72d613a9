#include "truth/mask.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"

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

/* --- scores --- */

bool gn_mask_is_away(const struct gn_mask_truth *truth, const float *edges, size_t i) {
    return edges[i] > (truth->band_px ? fmaxf(2, truth->band_px[i]) : 2);
}

static bool is_safe(const struct gn_mask_truth *truth, const float *edges, size_t i) {
    return truth->lit[i] && edges[i] >= (truth->safe_px ? truth->safe_px[i] : 5);
}

/* What is no number is dark. */
static double darkness_of(float seen) {
    return isnan(seen) ? 1 : fmax(0, fmin(1, 1 - (double)seen));
}

void gn_mask_count(struct gn_mask_score *score, const struct gn_mask_pixel *pixel) {
    const bool lit = pixel->lit, away = pixel->away, shown = pixel->shown >= .5f;
    score->lit += lit;
    score->dark += !lit;
    score->away_lit += away && lit;
    score->away_dark += away && !lit;
    score->acne += away && lit && !shown;
    score->leak += away && !lit && shown;
    score->gap += !lit && shown;
    score->wrong += lit != shown;
    if (!pixel->safe) return;
    const double darkness = darkness_of(pixel->shown);
    score->safe++;
    score->darkness += darkness;
    score->darkened += darkness > .05;
}

void gn_mask_compare_by(const struct gn_mask_truth *truth, const float *edges, const float *shot,
                        int channels, struct gn_mask_score *score) {
    size_t pixels = (size_t)truth->width_px * truth->height_px;
    *score = (struct gn_mask_score){.pixels = pixels};
    for (size_t i = 0; i < pixels; i++)
        gn_mask_count(score, &(struct gn_mask_pixel){.lit = truth->lit[i],
                                                     .away = gn_mask_is_away(truth, edges, i),
                                                     .safe = is_safe(truth, edges, i),
                                                     .shown = shot[i * channels]});
}

void gn_mask_compare(const struct gn_mask_truth *truth, const float *shot, int channels,
                     struct gn_mask_score *score) {
    float *edges = gn_xalloc((size_t)truth->width_px * truth->height_px, sizeof *edges);
    gn_mask_edges(truth, edges);
    gn_mask_compare_by(truth, edges, shot, channels, score);
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
