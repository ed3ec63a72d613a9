/* Triangulation by ear clipping (G. H. Meisters, "Polygons have ears", 1975); a hole is first
 * joined to the outline by a cut of zero width. */
#include "shape/outline.h"

#include "shape/shapes.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#define CREASE_COS 0.819f /* of 35 degrees */

/* Outward normal of an edge; the outside is to its right. */
static void edge_normal(const float a[2], const float b[2], float out[2]) {
    float dx = b[0] - a[0], dy = b[1] - a[1], length = hypotf(dx, dy);
    out[0] = dy / length;
    out[1] = -dx / length;
}

static float doubled_area(const float a[2], const float b[2], const float c[2]) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool inside(const float a[2], const float b[2], const float c[2], const float p[2]) {
    bool corner = !memcmp(p, a, 8) || !memcmp(p, b, 8) || !memcmp(p, c, 8);
    return !corner && doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 &&
           doubled_area(c, a, p) >= 0;
}

static bool is_ear(const float (*p)[2], const int *ring, int count, int i) {
    const float *a = p[ring[(i + count - 1) % count]], *b = p[ring[i]],
                *c = p[ring[(i + 1) % count]];
    if (doubled_area(a, b, c) <= 0) return false;
    for (int k = 0; k < count; k++)
        if (inside(a, b, c, p[ring[k]])) return false;
    return true;
}

enum { OUTLINE_MAX = 256, BEVEL_MAX = 6 };

/* Triangulates the polygon p[0..count) by ear clipping; returns the number of indices written. */
static int cut_ears(const float (*p)[2], int count, int *corners) {
    int ring[OUTLINE_MAX], written = 0;
    for (int i = 0; i < count; i++) ring[i] = i;
    for (int left = count, i = 0, tries = 0; left > 2 && tries < left;
         i = (i + 1) % left, tries++) {
        if (!is_ear(p, ring, left, i)) continue;
        corners[written++] = ring[(i + left - 1) % left];
        corners[written++] = ring[i];
        corners[written++] = ring[(i + 1) % left];
        memmove(ring + i, ring + i + 1, (size_t)(left - i - 1) * sizeof *ring);
        left--;
        i = (i + left - 1) % left;
        tries = -1;
    }
    return written;
}

static void nearest_pair(const struct gn_outline *o, int *outer, int *inner) {
    float best = INFINITY;
    for (int i = 0; i < o->count; i++)
        for (int k = 0; k < o->hole_count; k++) {
            float d = hypotf(o->points[i][0] - o->hole[k][0], o->points[i][1] - o->hole[k][1]);
            if (d < best) best = d, *outer = i, *inner = k;
        }
}

/* Joins outline and reversed hole into one polygon by a cut of zero width; returns its size. */
static int join_hole(const struct gn_outline *o, float (*joined)[2]) {
    int outer = 0, inner = 0, count = 0;
    if (o->hole) nearest_pair(o, &outer, &inner);
    for (int i = 0; i < o->count; i++)
        memcpy(joined[count++], o->points[(outer + i) % o->count], 8);
    if (!o->hole) return count;
    memcpy(joined[count++], o->points[outer], 8);
    for (int i = 0; i <= o->hole_count; i++)
        memcpy(joined[count++], o->hole[(inner + o->hole_count * 2 - i) % o->hole_count], 8);
    return count;
}

static void outline_face(struct gn_shape *shape, const struct gn_outline *o, float z, float side) {
    float joined[OUTLINE_MAX][2];
    int corners[3 * OUTLINE_MAX];
    assert(o->count + o->hole_count + 2 <= OUTLINE_MAX);
    int count = join_hole(o, joined);
    int written = cut_ears((const float(*)[2])joined, count, corners);
    uint32_t first = (uint32_t)shape->vertex_count;
    for (int i = 0; i < count; i++)
        gn_shape_vertex(shape, (float[3]){joined[i][0], joined[i][1], z}, (float[3]){0, 0, side},
                        joined[i]);
    for (int i = 0; i < written; i += 3)
        gn_shape_triangle(shape, first + (uint32_t)corners[i],
                          first + (uint32_t)corners[side > 0 ? i + 1 : i + 2],
                          first + (uint32_t)corners[side > 0 ? i + 2 : i + 1]);
}

/* Normal at the end `at` of an edge: averaged with the adjacent edge where the corner is blunt. */
static void rim_normal(const float edge[2], const float neighbour[2], float out[3]) {
    bool smooth = edge[0] * neighbour[0] + edge[1] * neighbour[1] > CREASE_COS;
    out[0] = edge[0] + (smooth ? neighbour[0] : 0);
    out[1] = edge[1] + (smooth ? neighbour[1] : 0);
    out[2] = 0;
}

/* One row of the wall: its height, how far it lies within the outline, and how far its normals are
 * turned from the side to the top. */
struct rim_row {
    float z, inset, turn;
};

/* Point of a row at a corner between two edges. */
static void rim_point(const float p[2], const float before[2], const float after[2],
                      const struct rim_row *row, float out[3]) {
    float along = 1 + before[0] * after[0] + before[1] * after[1];
    for (int k = 0; k < 2; k++)
        out[k] = p[k] - (row->inset != 0 ? row->inset * (before[k] + after[k]) / along : 0);
    out[2] = row->z;
}

static void rim_tilt(const struct rim_row *row, const float normal[3], float out[3]) {
    float c = cosf(row->turn), s = sinf(row->turn), length = hypotf(normal[0], normal[1]);
    memcpy(out, normal, 3 * sizeof *out);
    if (row->turn == 0) return;
    for (int k = 0; k < 2; k++) out[k] = c * normal[k] / length;
    out[2] = s;
}

/* The wall along a closed outline; `step` is 1 for the outline, -1 for a hole. */
static void outline_rim(struct gn_shape *shape, const float (*p)[2], int count,
                        const struct rim_row *rows, int row_count, int step) {
    for (int i = 0; i < count; i++) {
        const float *before = p[(i - step + count) % count], *a = p[i],
                    *b = p[(i + step + count) % count];
        const float *after = p[(i + 2 * step + 2 * count) % count];
        float edge[2], last[2], next[2], na[3], nb[3], length = hypotf(b[0] - a[0], b[1] - a[1]);
        edge_normal(before, a, last);
        edge_normal(a, b, edge);
        edge_normal(b, after, next);
        rim_normal(edge, last, na);
        rim_normal(edge, next, nb);
        uint32_t first = (uint32_t)shape->vertex_count;
        for (int r = 0; r < row_count; r++) {
            float pa[3], pb[3], ta[3], tb[3];
            rim_point(a, last, edge, &rows[r], pa);
            rim_point(b, edge, next, &rows[r], pb);
            rim_tilt(&rows[r], na, ta);
            rim_tilt(&rows[r], nb, tb);
            gn_shape_vertex(shape, pa, ta, (float[2]){0, rows[r].z});
            gn_shape_vertex(shape, pb, tb, (float[2]){length, rows[r].z});
        }
        for (uint32_t k = first; k + 2 < first + 2 * (uint32_t)row_count; k += 2) {
            gn_shape_triangle(shape, k, k + 1, k + 3);
            gn_shape_triangle(shape, k, k + 3, k + 2);
        }
    }
}

void gn_shape_extrude(struct gn_shape *shape, const struct gn_outline *outline, float depth) {
    const struct rim_row rows[] = {{-depth / 2, 0, 0}, {depth / 2, 0, 0}};
    outline_face(shape, outline, depth / 2, 1);
    outline_face(shape, outline, -depth / 2, -1);
    outline_rim(shape, outline->points, outline->count, rows, 2, 1);
    if (outline->hole) outline_rim(shape, outline->hole, outline->hole_count, rows, 2, -1);
}

/* The outline, or its hole (side -1), as it is at `inset`. */
static void inset_outline(const float (*p)[2], int count, float inset, float side,
                          float (*out)[2]) {
    for (int i = 0; i < count; i++) {
        float last[2], next[2], at[3];
        edge_normal(p[(i + count - 1) % count], p[i], last);
        edge_normal(p[i], p[(i + 1) % count], next);
        rim_point(p[i], last, next, &(struct rim_row){0, side * inset, 0}, at);
        memcpy(out[i], at, sizeof *out);
    }
}

void gn_shape_bevel(struct gn_shape *shape, const struct gn_outline *outline, float depth,
                    float bevel, int steps) {
    struct rim_row rows[2 * BEVEL_MAX + 2];
    float points[OUTLINE_MAX][2], hole[OUTLINE_MAX][2];
    assert(steps > 0 && steps <= BEVEL_MAX);
    for (int i = 0; i <= steps; i++) {
        const float turn = (float)M_PI / 2 * (float)i / (float)steps;
        rows[steps + 1 + i] =
            (struct rim_row){depth / 2 - bevel * (1 - sinf(turn)), bevel * (1 - cosf(turn)), turn};
        rows[steps - i] =
            (struct rim_row){-rows[steps + 1 + i].z, rows[steps + 1 + i].inset, -turn};
    }
    inset_outline(outline->points, outline->count, bevel, 1, points);
    inset_outline(outline->hole, outline->hole_count, bevel, -1, hole);
    const struct gn_outline face = {(const float(*)[2])points, outline->count,
                                    outline->hole ? (const float(*)[2])hole : NULL,
                                    outline->hole_count};
    outline_face(shape, &face, depth / 2, 1);
    outline_face(shape, &face, -depth / 2, -1);
    outline_rim(shape, outline->points, outline->count, rows, 2 * steps + 2, 1);
    if (outline->hole)
        outline_rim(shape, outline->hole, outline->hole_count, rows, 2 * steps + 2, -1);
}

static void pale(struct gn_shape *shape, const struct gn_fence *f, float x) {
    float w = f->pale / 2, shoulder = f->height - (f->pointed ? f->pale * 0.8f : 0);
    const float points[][2] = {
        {x - w, 0}, {x + w, 0}, {x + w, shoulder}, {x, f->height}, {x - w, shoulder}};
    if (f->pointed) {
        gn_shape_extrude(shape, &(struct gn_outline){.points = points, .count = 5}, f->depth);
        return;
    }
    gn_shape_move(shape, x, 0, 0);
    gn_shape_block(shape, f->pale, f->height, f->depth);
    gn_shape_move(shape, -x, 0, 0);
}

void gn_shape_fence(struct gn_shape *shape, const struct gn_fence *fence) {
    int pales = (int)floorf((fence->length - fence->pale) / fence->pitch + 0.001f) + 1;
    float span = (float)(pales - 1) * fence->pitch, back = -0.9f * fence->depth;
    for (int i = 0; i < pales; i++) pale(shape, fence, fence->pale / 2 + (float)i * fence->pitch);
    for (int rail = 0; rail < 2; rail++) {
        float x = fence->pale / 2 + span / 2, y = fence->height * (rail ? 0.75f : 0.25f);
        gn_shape_move(shape, x, y, back);
        gn_shape_box(shape, span + 0.8f * fence->pale, fence->height * 0.07f, fence->depth);
        gn_shape_move(shape, -x, -y, -back);
    }
}
