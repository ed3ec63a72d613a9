#include "truth/tear.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"

enum { NEAR_PX = 6, PENUMBRA_PX = 8, PIXELS_MIN = 200, KERNEL_MAX = 8 };
static const double sigmas_px[GN_TEAR_SIGMAS] = {2.5, 1};
static const double step_share = .02; /* of the distance */
static const double fold_most = .35;  /* of normals two pixels apart: sum of their differences */
static const float lit_from = .02f;   /* N.L */
static const float soft_from = .02f, soft_to = .98f;

static size_t pixels_of(const struct gn_tear *t) {
    return (size_t)t->width_px * (size_t)t->height_px;
}
static float cut(float value) { return value > 0 ? fminf(value, 1) : 0; }

void gn_tear_face(const float *normal_ws, const float *distance_m, const double to_light[3],
                  size_t pixels, float *facing) {
    const double up = to_light[1] > 0 ? to_light[1]
                                      : sqrt(to_light[0] * to_light[0] + to_light[1] * to_light[1] +
                                             to_light[2] * to_light[2]);
    for (size_t i = 0; i < pixels; i++) {
        double n_l = 0;
        for (size_t c = 0; c < 3; c++) n_l += (double)normal_ws[3 * i + c] * to_light[c];
        facing[i] = distance_m && !isfinite(distance_m[i]) ? 1 : cut((float)(n_l / up));
    }
}

/* ---- edges ---- */

static bool has_surface(const struct gn_tear_view *view, size_t i) {
    return !view->distance_m || isfinite(view->distance_m[i]);
}

/* Between a and b, the two neighbours of i in a row or a column (i itself at the border). The
 * reciprocal of distance is linear over a plane, however steep, so its second difference is a step
 * or a fold. */
static bool is_edge(const struct gn_tear_view *view, size_t a, size_t i, size_t b) {
    const bool surface = has_surface(view, i);
    if (surface != has_surface(view, a) || surface != has_surface(view, b)) return true;
    if (!surface) return false;
    if (view->distance_m && a != i && b != i) {
        const double here = (double)view->distance_m[i];
        const double bend =
            here / (double)view->distance_m[a] + here / (double)view->distance_m[b] - 2;
        if (!(fabs(bend) <= step_share)) return true;
    }
    double turn = 0;
    for (size_t c = 0; view->normal_ws && c < 3; c++)
        turn += fabs((double)view->normal_ws[3 * a + c] - (double)view->normal_ws[3 * b + c]);
    return !(turn <= fold_most);
}

static void mark_flat(struct gn_tear *t, const struct gn_tear_view *view) {
    const int w = t->width_px, h = t->height_px;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const size_t i = (size_t)y * (size_t)w + (size_t)x, row = (size_t)w;
            t->flat[i] = isfinite(view->truth[i]) &&
                         !is_edge(view, x > 0 ? i - 1 : i, i, x + 1 < w ? i + 1 : i) &&
                         !is_edge(view, y > 0 ? i - row : i, i, y + 1 < h ? i + row : i);
        }
    for (int y = 1; y + 1 < h; y++)
        for (int x = 1; x + 1 < w; x++) {
            const size_t i = (size_t)y * (size_t)w + (size_t)x, row = (size_t)w;
            t->inner[i] = t->flat[i] && t->flat[i - 1] && t->flat[i + 1] && t->flat[i - row] &&
                          t->flat[i + row];
        }
}

/* ---- filters along lines, which end at edges ---- */

/* A row or a column. */
struct line {
    const struct gn_tear *tear;
    size_t first, step;
    int length;
};

/* Calls `run` for each stretch of a line without an edge: pixels from to end - 1. */
static void for_runs(const struct gn_tear *t, void (*run)(const struct line *, int, int, void *),
                     bool columns, void *user) {
    const int lines = columns ? t->width_px : t->height_px;
    const size_t w = (size_t)t->width_px;
    for (int l = 0; l < lines; l++) {
        const struct line line = {t, (size_t)l * (columns ? 1 : w), columns ? w : 1,
                                  columns ? t->height_px : t->width_px};
        for (int end = 0; end < line.length; end++) {
            const int from = end;
            while (end < line.length && t->flat[line.first + (size_t)end * line.step]) end++;
            if (end > from) run(&line, from, end, user);
        }
    }
}

struct blur {
    float *sum, *weight, *sum_out, *weight_out;
    float kernel[KERNEL_MAX + 1];
    int radius;
};

static void blur_run(const struct line *line, int from, int end, void *user) {
    struct blur *b = user;
    for (int i = from; i < end; i++) {
        const int first = i - b->radius > from ? i - b->radius : from;
        const int last = i + b->radius < end - 1 ? i + b->radius : end - 1;
        float sum = 0, weight = 0;
        for (int j = first; j <= last; j++) {
            const size_t at = line->first + (size_t)j * line->step;
            sum += b->kernel[abs(j - i)] * b->sum[at];
            weight += b->kernel[abs(j - i)] * b->weight[at];
        }
        b->sum_out[line->first + (size_t)i * line->step] = sum;
        b->weight_out[line->first + (size_t)i * line->step] = weight;
    }
}

struct spread {
    float *values, *kept; /* kept: of one line */
    int radius;
};

static void spread_run(const struct line *line, int from, int end, void *user) {
    struct spread *s = user;
    for (int i = from; i < end; i++) s->kept[i] = s->values[line->first + (size_t)i * line->step];
    for (int i = from; i < end; i++) {
        const int first = i - s->radius > from ? i - s->radius : from;
        const int last = i + s->radius < end - 1 ? i + s->radius : end - 1;
        float most = s->kept[i];
        for (int j = first; j <= last; j++) most = fmaxf(most, s->kept[j]);
        s->values[line->first + (size_t)i * line->step] = most;
    }
}

/* The largest within so many pixels, in place. */
static void spread(const struct gn_tear *t, float *values, int radius) {
    const int longest = t->width_px > t->height_px ? t->width_px : t->height_px;
    struct spread s = {values, gn_xalloc((size_t)longest, sizeof(float)), radius};
    for_runs(t, spread_run, false, &s);
    for_runs(t, spread_run, true, &s);
    free(s.kept);
}

/* Length of the gradient after a Gaussian; 0 where a neighbour lies on an edge. */
static void slope(const struct gn_tear *t, const float *values, double sigma_px, float *out) {
    const size_t pixels = pixels_of(t), w = (size_t)t->width_px;
    float *memory = gn_xalloc(4 * pixels, sizeof *memory);
    struct blur b = {memory, memory + pixels, memory + 2 * pixels, memory + 3 * pixels,
                     .radius = (int)ceil(3 * sigma_px)};
    for (int k = 0; k <= b.radius; k++)
        b.kernel[k] = (float)exp(-k * k / (2 * sigma_px * sigma_px));
    for (size_t i = 0; i < pixels; i++) {
        b.sum[i] = t->flat[i] ? values[i] : 0;
        b.weight[i] = 1;
    }
    for_runs(t, blur_run, false, &b);
    struct blur down = b;
    down.sum = b.sum_out;
    down.weight = b.weight_out;
    down.sum_out = b.sum;
    down.weight_out = b.weight;
    for_runs(t, blur_run, true, &down);
    for (size_t i = 0; i < pixels; i++) b.sum[i] /= b.weight[i];
    for (size_t i = 0; i < pixels; i++)
        out[i] = t->inner[i]
                     ? .5f * hypotf(b.sum[i + 1] - b.sum[i - 1], b.sum[i + w] - b.sum[i - w])
                     : 0;
    free(memory);
}

/* ---- truth ---- */

static void mark_measured(struct gn_tear *t, const struct gn_tear_view *view) {
    const size_t pixels = pixels_of(t);
    float *soft = gn_xalloc(pixels, sizeof *soft);
    for (size_t i = 0; i < pixels; i++)
        soft[i] = view->truth[i] > soft_from && view->truth[i] < soft_to;
    spread(t, soft, PENUMBRA_PX);
    for (size_t i = 0; i < pixels; i++)
        if (t->inner[i] && soft[i] > 0 && t->facing[i] > lit_from)
            t->measured_part[i] = has_surface(view, i) ? GN_TEAR_SURFACE : GN_TEAR_FLOOR;
    free(soft);
}

void gn_tear_init(struct gn_tear *tear, const struct gn_tear_view *view) {
    *tear = (struct gn_tear){.width_px = view->width_px, .height_px = view->height_px};
    const size_t pixels = pixels_of(tear);
    tear->facing = gn_xalloc((2 + GN_TEAR_SIGMAS) * pixels, sizeof *tear->facing);
    tear->truth = tear->facing + pixels;
    tear->flat = gn_xalloc(3 * pixels, sizeof *tear->flat);
    tear->inner = tear->flat + pixels;
    tear->measured_part = tear->inner + pixels;
    mark_flat(tear, view);
    for (size_t i = 0; i < pixels; i++) {
        tear->facing[i] = view->facing ? cut(view->facing[i]) : 1;
        tear->truth[i] = cut(view->truth[i]) * tear->facing[i];
    }
    mark_measured(tear, view);
    for (int s = 0; s < GN_TEAR_SIGMAS; s++) {
        tear->limit[s] = tear->facing + (2 + (size_t)s) * pixels;
        slope(tear, tear->truth, sigmas_px[s], tear->limit[s]);
        spread(tear, tear->limit[s], NEAR_PX);
    }
}

void gn_tear_finish(struct gn_tear *tear) {
    free(tear->facing);
    free(tear->flat);
    *tear = (struct gn_tear){0};
}

/* ---- a picture ---- */

static void add_pixel(struct gn_tear_score *score, const double excess[GN_TEAR_SIGMAS],
                      double square) {
    score->tear += excess[0];
    score->grain += excess[1];
    score->rmse += square;
    score->pixels++;
}

void gn_tear_compare(const struct gn_tear *tear, const float *shot, int channels,
                     struct gn_tear_score score[GN_TEAR_PARTS]) {
    const size_t pixels = pixels_of(tear);
    float *values = gn_xalloc((1 + GN_TEAR_SIGMAS) * pixels, sizeof *values);
    for (size_t i = 0; i < pixels; i++)
        values[i] = cut(shot[i * (size_t)channels]) * tear->facing[i];
    for (size_t s = 0; s < GN_TEAR_SIGMAS; s++)
        slope(tear, values, sigmas_px[s], values + (1 + s) * pixels);
    for (int p = 0; p < GN_TEAR_PARTS; p++) score[p] = (struct gn_tear_score){0};
    for (size_t i = 0; i < pixels; i++) {
        if (!tear->measured_part[i]) continue;
        double excess[GN_TEAR_SIGMAS];
        const double d = (double)values[i] - (double)tear->truth[i];
        for (size_t s = 0; s < GN_TEAR_SIGMAS; s++)
            excess[s] = fmax((double)values[(1 + s) * pixels + i] - (double)tear->limit[s][i], 0);
        add_pixel(&score[GN_TEAR_ALL], excess, d * d);
        add_pixel(&score[tear->measured_part[i]], excess, d * d);
    }
    for (int p = 0; p < GN_TEAR_PARTS; p++) {
        const double n = score[p].pixels < PIXELS_MIN ? (double)NAN : (double)score[p].pixels;
        score[p].tear *= 100 / n;
        score[p].grain *= 100 / n;
        score[p].rmse = sqrt(score[p].rmse / n);
    }
    free(values);
}
