#include "truth/bvh.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

/* From DEEP on nodes are halved: each of the first levels may part one triangle from the others,
 * and the stack has to hold all levels. */
enum { BINS = 16, LEAF = 4, DEEP = 64, STACK = 128 };
#define PAD 1e-9 /* of the scene's diagonal, around boxes: room for the rounding of their tests */

/* Inner: children at `first` and `first + 1`, count 0. Leaf: triangles first .. first + count - 1.
 */
struct gn_bvh_node {
    double min[3], max[3];
    uint32_t first, count;
};

struct bounds {
    double min[3], max[3];
};

static const struct bounds nothing = {{INFINITY, INFINITY, INFINITY},
                                      {-INFINITY, -INFINITY, -INFINITY}};

static void bounds_point(struct bounds *b, const double p[3]) {
    for (int k = 0; k < 3; k++) {
        b->min[k] = fmin(b->min[k], p[k]);
        b->max[k] = fmax(b->max[k], p[k]);
    }
}

static void bounds_triangle(struct bounds *b, const struct gn_bvh_triangle *t) {
    for (int i = 0; i < 3; i++) bounds_point(b, t->p[i]);
}

static void bounds_merge(struct bounds *b, const struct bounds *c) {
    for (int k = 0; k < 3; k++) {
        b->min[k] = fmin(b->min[k], c->min[k]);
        b->max[k] = fmax(b->max[k], c->max[k]);
    }
}

static double bounds_area(const struct bounds *b) {
    double x = b->max[0] - b->min[0], y = b->max[1] - b->min[1], z = b->max[2] - b->min[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

static double centroid(const struct gn_bvh_triangle *t, int axis) {
    return (t->p[0][axis] + t->p[1][axis] + t->p[2][axis]) / 3;
}

struct split {
    int axis;
    double low, scale; /* bin = (centroid - low) * scale */
    int bin;           /* the last one on the left */
};

static int bin_of(const struct split *s, const struct gn_bvh_triangle *t) {
    int bin = (int)((centroid(t, s->axis) - s->low) * s->scale);
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

/* Finds the cheapest of the 15 planes between the bins; false if all centroids coincide or no plane
 * parts them. */
static bool find_split(const struct gn_bvh_triangle *t, uint32_t count, struct split *split) {
    struct bounds centres = nothing;
    for (uint32_t i = 0; i < count; i++)
        bounds_point(&centres,
                     (double[3]){centroid(&t[i], 0), centroid(&t[i], 1), centroid(&t[i], 2)});
    double extent = -1;
    for (int k = 0; k < 3; k++)
        if (centres.max[k] - centres.min[k] > extent)
            extent = centres.max[k] - centres.min[k], split->axis = k;
    if (!(extent > 0)) return false;
    split->low = centres.min[split->axis];
    split->scale = BINS / extent;

    struct bounds bins[BINS];
    uint32_t counts[BINS] = {0};
    for (int b = 0; b < BINS; b++) bins[b] = nothing;
    for (uint32_t i = 0; i < count; i++) {
        int b = bin_of(split, &t[i]);
        bounds_triangle(&bins[b], &t[i]);
        counts[b]++;
    }
    double right_cost[BINS], best = INFINITY;
    struct bounds side = nothing;
    uint32_t n = 0;
    for (int b = BINS - 1; b > 0; b--) {
        bounds_merge(&side, &bins[b]);
        n += counts[b];
        right_cost[b] = bounds_area(&side) * n;
    }
    side = nothing, n = 0;
    for (int b = 0; b < BINS - 1; b++) {
        bounds_merge(&side, &bins[b]);
        n += counts[b];
        double cost = bounds_area(&side) * n + right_cost[b + 1];
        if (n > 0 && n < count && cost < best) best = cost, split->bin = b;
    }
    return best < INFINITY;
}

static uint32_t partition(struct gn_bvh_triangle *t, uint32_t count, const struct split *split) {
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (bin_of(split, &t[i]) > split->bin) continue;
        struct gn_bvh_triangle moved = t[i];
        t[i] = t[left];
        t[left++] = moved;
    }
    return left;
}

/* A box with room for the rounding of the slab test: flat ones would otherwise have no inside. */
static void set_box(struct gn_bvh_node *node, const struct gn_bvh_triangle *t, uint32_t count,
                    double pad) {
    struct bounds b = nothing;
    for (uint32_t i = 0; i < count; i++) bounds_triangle(&b, &t[i]);
    for (int k = 0; k < 3; k++) {
        node->min[k] = b.min[k] - pad;
        node->max[k] = b.max[k] + pad;
    }
}

void gn_bvh_build(struct gn_bvh *bvh, struct gn_bvh_triangle *triangles, uint32_t count,
                  const atomic_bool *cancel) {
    *bvh = (struct gn_bvh){.triangles = triangles, .triangle_count = count};
    if (!count) return;
    struct bounds all = nothing;
    for (uint32_t i = 0; i < count; i++) bounds_triangle(&all, &triangles[i]);
    bvh->diagonal =
        hypot(hypot(all.max[0] - all.min[0], all.max[1] - all.min[1]), all.max[2] - all.min[2]);
    double pad = PAD * bvh->diagonal;

    bvh->nodes = gn_xalloc(2 * (size_t)count, sizeof *bvh->nodes);
    uint8_t *level = gn_xalloc(2 * (size_t)count, 1);
    bvh->nodes[0] = (struct gn_bvh_node){.first = 0, .count = count};
    bvh->node_count = 1;
    /* Nodes are made in the order in which they are numbered, so the list itself is the queue. */
    for (uint32_t i = 0; i < bvh->node_count; i++) {
        struct gn_bvh_node *node = &bvh->nodes[i];
        uint32_t first = node->first, n = node->count;
        if (cancel && atomic_load_explicit(cancel, memory_order_relaxed)) break;
        set_box(node, triangles + first, n, pad);
        if (n <= LEAF) continue;
        struct split split = {0};
        uint32_t left = level[i] < DEEP && find_split(triangles + first, n, &split)
                            ? partition(triangles + first, n, &split)
                            : n / 2;
        node->first = bvh->node_count;
        node->count = 0;
        level[node->first] = level[node->first + 1] = level[i] + 1;
        bvh->nodes[bvh->node_count++] = (struct gn_bvh_node){.first = first, .count = left};
        bvh->nodes[bvh->node_count++] =
            (struct gn_bvh_node){.first = first + left, .count = n - left};
    }
    free(level);
}

uint64_t gn_bvh_bytes(uint64_t triangles) {
    return triangles * (sizeof(struct gn_bvh_triangle) + 2 * sizeof(struct gn_bvh_node) + 2);
}

void gn_bvh_finish(struct gn_bvh *bvh) {
    free(bvh->triangles);
    free(bvh->nodes);
    *bvh = (struct gn_bvh){0};
}

/* The ray in the frame of Woop's test: its longest component is z, and x and y are sheared so that
 * it runs along z. */
struct sheared {
    const struct gn_ray *ray;
    int kx, ky, kz;
    double sx, sy, sz;
};

static struct sheared shear(const struct gn_ray *ray) {
    const double *d = ray->direction;
    struct sheared s = {.ray = ray};
    s.kz = fabs(d[0]) > fabs(d[1]) ? 0 : 1;
    if (fabs(d[2]) > fabs(d[s.kz])) s.kz = 2;
    s.kx = (s.kz + 1) % 3;
    s.ky = (s.kz + 2) % 3;
    if (d[s.kz] < 0) { /* keeps the winding */
        int k = s.kx;
        s.kx = s.ky;
        s.ky = k;
    }
    s.sx = d[s.kx] / d[s.kz];
    s.sy = d[s.ky] / d[s.kz];
    s.sz = 1 / d[s.kz];
    return s;
}

static bool hit_triangle(const struct sheared *s, const struct gn_bvh_triangle *t, double t_max,
                         struct gn_bvh_hit *hit) {
    const double *o = s->ray->origin;
    double x[3], y[3], z[3];
    for (int i = 0; i < 3; i++) {
        double depth = t->p[i][s->kz] - o[s->kz];
        x[i] = t->p[i][s->kx] - o[s->kx] - s->sx * depth;
        y[i] = t->p[i][s->ky] - o[s->ky] - s->sy * depth;
        z[i] = s->sz * depth;
    }
    double u = x[2] * y[1] - y[2] * x[1];
    double v = x[0] * y[2] - y[0] * x[2];
    double w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    double det = u + v + w;
    if (det == 0) return false;
    double distance = (u * z[0] + v * z[1] + w * z[2]) / det;
    if (!(distance > s->ray->t_min && distance <= t_max)) return false;
    *hit = (struct gn_bvh_hit){.t = distance, .u = v / det, .v = w / det, .facing = det};
    return true;
}

static bool hit_box(const struct gn_ray *ray, const double inverse[3],
                    const struct gn_bvh_node *node, double t_max, double *enter) {
    double from = ray->t_min, to = t_max;
    for (int k = 0; k < 3; k++) {
        double a = (node->min[k] - ray->origin[k]) * inverse[k];
        double b = (node->max[k] - ray->origin[k]) * inverse[k];
        double low = a < b ? a : b, high = a < b ? b : a;
        if (low > from) from = low;
        if (high < to) to = high;
    }
    *enter = from;
    return from <= to;
}

/* Tests triangles first .. first + count - 1 and keeps the nearest in *best (best->t is the limit).
 */
static bool hit_range(const struct gn_bvh *bvh, const struct sheared *s, uint32_t first,
                      uint32_t count, gn_bvh_accept accept, const void *context,
                      struct gn_bvh_hit *best) {
    bool found = false;
    for (uint32_t i = first; i < first + count; i++) {
        const struct gn_bvh_triangle *t = &bvh->triangles[i];
        struct gn_bvh_hit hit;
        if (!hit_triangle(s, t, best->t, &hit)) continue;
        hit.triangle = i;
        if (accept && !accept(context, t, &hit)) continue;
        *best = hit;
        found = true;
    }
    return found;
}

bool gn_bvh_hit(const struct gn_bvh *bvh, const struct gn_ray *ray, bool any, gn_bvh_accept accept,
                const void *context, struct gn_bvh_hit *hit) {
    if (!bvh->node_count) return false;
    struct sheared s = shear(ray);
    double inverse[3];
    /* A component of 0 would give 0 x infinity on a slab's own plane. */
    for (int k = 0; k < 3; k++)
        inverse[k] = 1 / (ray->direction[k] != 0 ? ray->direction[k] : 1e-200);
    struct {
        uint32_t node;
        double enter;
    } stack[STACK];
    int depth = 0;
    bool found = false;
    *hit = (struct gn_bvh_hit){.t = ray->t_max};
    double enter;
    if (!hit_box(ray, inverse, &bvh->nodes[0], hit->t, &enter)) return false;
    stack[depth].node = 0;
    stack[depth++].enter = enter;
    while (depth) {
        depth--;
        if (stack[depth].enter > hit->t) continue;
        const struct gn_bvh_node *node = &bvh->nodes[stack[depth].node];
        if (node->count) {
            found |= hit_range(bvh, &s, node->first, node->count, accept, context, hit);
            if (found && any) return true;
            continue;
        }
        double e[2];
        bool in[2];
        for (int c = 0; c < 2; c++)
            in[c] = hit_box(ray, inverse, &bvh->nodes[node->first + c], hit->t, &e[c]);
        int near = in[0] && (!in[1] || e[0] <= e[1]) ? 0 : 1;
        assert(depth + 2 <= STACK);
        for (int c = 0; c < 2; c++) { /* the far one first, so that the near one is on top */
            int child = c == 0 ? 1 - near : near;
            if (!in[child]) continue;
            stack[depth].node = node->first + child;
            stack[depth++].enter = e[child];
        }
    }
    return found;
}

bool gn_bvh_hit_slow(const struct gn_bvh *bvh, const struct gn_ray *ray, gn_bvh_accept accept,
                     const void *context, struct gn_bvh_hit *hit) {
    struct sheared s = shear(ray);
    *hit = (struct gn_bvh_hit){.t = ray->t_max};
    return hit_range(bvh, &s, 0, bvh->triangle_count, accept, context, hit);
}

/* ---- many rays from one point ---- */

/* Keeps the part of from..to where t * slope >= least. */
static void cut_span(double slope, double least, double *from, double *to) {
    if (slope > 0)
        *from = fmax(*from, least / slope);
    else if (slope < 0)
        *to = fmin(*to, least / slope);
    else if (least > 0)
        *to = -1;
}

/* Along each axis the beam covers origin + t low .. origin + t high: a box is out of it unless some
 * t has all three meet the box. */
static bool beam_meets(const struct gn_beam *beam, const double min[3], const double max[3]) {
    double from = 0, to = beam->t_max;
    for (int k = 0; k < 3; k++) {
        cut_span(beam->high[k], min[k] - beam->origin[k], &from, &to);
        cut_span(-beam->low[k], beam->origin[k] - max[k], &from, &to);
    }
    return from <= to;
}

static bool beam_meets_triangle(const struct gn_bvh *bvh, const struct gn_beam *beam,
                                const struct gn_bvh_triangle *t) {
    const double pad = PAD * bvh->diagonal;
    struct bounds b = nothing;
    bounds_triangle(&b, t);
    for (int k = 0; k < 3; k++) {
        b.min[k] -= pad;
        b.max[k] += pad;
    }
    return beam_meets(beam, b.min, b.max);
}

uint32_t gn_bvh_gather(const struct gn_bvh *bvh, const struct gn_beam *beam, uint32_t *out,
                       uint32_t most) {
    uint32_t stack[STACK], depth = 0, count = 0;
    if (bvh->node_count) stack[depth++] = 0;
    while (depth) {
        const struct gn_bvh_node *node = &bvh->nodes[stack[--depth]];
        if (!beam_meets(beam, node->min, node->max)) continue;
        if (!node->count) {
            assert(depth + 2 <= STACK);
            stack[depth++] = node->first;
            stack[depth++] = node->first + 1;
            continue;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            if (!beam_meets_triangle(bvh, beam, &bvh->triangles[i])) continue;
            if (count == most) return most + 1;
            out[count++] = i;
        }
    }
    return count;
}

bool gn_bvh_hit_some(const struct gn_bvh *bvh, const struct gn_ray *ray, const uint32_t *list,
                     uint32_t count, gn_bvh_accept accept, const void *context, uint32_t *which) {
    if (!count) return false;
    const struct sheared s = shear(ray);
    struct gn_bvh_hit hit = {.t = ray->t_max};
    for (uint32_t i = 0; i < count; i++) {
        if (!hit_range(bvh, &s, list[i], 1, accept, context, &hit)) continue;
        *which = i;
        return true;
    }
    return false;
}
