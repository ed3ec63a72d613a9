/* Tangents as MikkTSpace defines them, which is what normal maps are baked for and what glTF asks
 * for where a file has none: Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), and
 * the rules of mikktspace.h, for triangles and the angular threshold of 180 degrees.
 *
 * Vertices with equal position, normal and coordinates are one. Around a vertex, faces that share
 * edges and map their pictures with the same orientation are a group; its tangent is the mean of
 * the faces' du directions in the vertex's plane, weighted by the angle of the corner. A face whose
 * coordinates span no area joins any group but adds nothing; a face with equal positions takes what
 * others have at its vertices. A vertex in several groups becomes several. */
#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/private.h"

#define NONE UINT32_MAX

struct face {
    float along[3];        /* unit: dP/du; 0 if there is none */
    uint32_t neighbors[3]; /* corner of another face: the edge from there is this one, reversed */
    uint32_t groups[3];
    bool preserves; /* v grows counter-clockwise from u */
    bool any;       /* spans no area of the picture: of either orientation */
    bool degenerate;
};
struct group {
    float tangent[3]; /* a sum, then of unit length */
    bool preserves;
};
struct work {
    const struct gn_tangent_mesh *mesh;
    const uint32_t *welded; /* by corner */
    struct face *faces;
    struct group *groups;
    uint32_t group_count;
};

static bool is_not_zero(double x) { return fabs(x) > FLT_MIN; }
static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static void normalize3(double v[3]) {
    const double length = sqrt(dot3(v, v));
    for (int k = 0; k < 3 && is_not_zero(length); k++) v[k] /= length;
}
/* Into the plane with normal n, of unit length. */
static void project3(double v[3], const float *n) {
    const double normal[3] = {(double)n[0], (double)n[1], (double)n[2]}, off = dot3(v, normal);
    for (int k = 0; k < 3; k++) v[k] -= off * normal[k];
    normalize3(v);
}

/* ---- what is one vertex ---- */

static struct gn_table make_table(struct gn_gltf *g, size_t most, const void *keys,
                                  size_t key_size) {
    size_t size = 16;
    while (size < 2 * most) size *= 2;
    return (struct gn_table){
        .slots = gn_gltf_alloc(g, &g->memory.step, size, sizeof(uint32_t)),
        .mask = size - 1,
        .stride = key_size,
        .key_size = key_size,
        .keys = keys,
        .hash_key = &g->hash_key,
    };
}

/* By corner: the first vertex that equals its own. */
static uint32_t *weld_corners(struct gn_gltf *g, const struct gn_tangent_mesh *mesh) {
    enum { FLOATS = 8 };
    const size_t count = mesh->vertex_count;
    float(*keys)[FLOATS] = gn_gltf_alloc(g, &g->memory.step, count, sizeof *keys);
    uint32_t *first = gn_gltf_alloc(g, &g->memory.step, count, sizeof *first);
    uint32_t *welded = gn_gltf_alloc(g, &g->memory.step, mesh->corner_count, sizeof *welded);
    const struct gn_table table = make_table(g, count, keys, sizeof *keys);
    if (g->failed) return NULL;
    for (size_t i = 0; i < count; i++) {
        memcpy(keys[i], mesh->positions + 3 * i, 3 * sizeof(float));
        memcpy(keys[i] + 3, mesh->normals + 3 * i, 3 * sizeof(float));
        memcpy(keys[i] + 6, mesh->uv + 2 * i, 2 * sizeof(float));
        for (int k = 0; k < FLOATS; k++) keys[i][k] += 0.0f; /* no -0 */
        uint32_t *slot = gn_table_find(&table, keys[i]);
        if (*slot == 0) *slot = (uint32_t)i + 1;
        first[i] = *slot - 1;
    }
    for (size_t i = 0; i < mesh->corner_count; i++) welded[i] = first[mesh->corners[i]];
    return welded;
}

/* ---- faces ---- */

static void measure_face(const struct gn_tangent_mesh *mesh, const uint32_t *welded,
                         struct face *face) {
    const float *p[3], *t[3];
    for (int k = 0; k < 3; k++) {
        p[k] = mesh->positions + 3 * (size_t)welded[k];
        t[k] = mesh->uv + 2 * (size_t)welded[k];
        face->neighbors[k] = face->groups[k] = NONE;
    }
    for (int k = 0; k < 3; k++) {
        const float *a = p[k], *b = p[(k + 1) % 3];
        face->degenerate |= a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
    }
    /* In float, as elsewhere: whether this is 0 decides. v grows downwards in glTF. */
    const float u1 = t[1][0] - t[0][0], v1 = t[0][1] - t[1][1];
    const float u2 = t[2][0] - t[0][0], v2 = t[0][1] - t[2][1];
    const float area = u1 * v2 - v1 * u2;
    face->preserves = area > 0.0f;
    face->any = true;
    if (!is_not_zero((double)area)) return;
    double s[3], r[3]; /* dP/du and dP/dv, times the area */
    for (int k = 0; k < 3; k++) {
        const double d1 = (double)p[1][k] - (double)p[0][k];
        const double d2 = (double)p[2][k] - (double)p[0][k];
        s[k] = d1 * (double)v2 - d2 * (double)v1;
        r[k] = d2 * (double)u1 - d1 * (double)u2;
    }
    const double length = sqrt(dot3(s, s)), other = sqrt(dot3(r, r)), most = fabs((double)area);
    for (int k = 0; k < 3 && is_not_zero(length); k++)
        face->along[k] = (float)(face->preserves ? s[k] / length : -s[k] / length);
    face->any = !(is_not_zero(length / most) && is_not_zero(other / most));
}

struct edge {
    uint32_t low, high, corner; /* vertices, and where it starts in its face */
};

static int compare_edges(const void *a, const void *b) {
    const struct edge *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    if (x->high != y->high) return x->high < y->high ? -1 : 1;
    return (x->corner > y->corner) - (x->corner < y->corner);
}

/* Of the faces at one edge, each in turn is paired with the first later one that runs through it
 * the other way. */
static bool link_faces(struct gn_gltf *g, struct work *w) {
    const size_t corners = w->mesh->corner_count;
    struct edge *edges = gn_gltf_alloc(g, &g->memory.step, corners, sizeof *edges);
    uint32_t *waiting = gn_gltf_alloc(g, &g->memory.step, corners, sizeof *waiting);
    if (g->failed) return false;
    size_t count = 0;
    for (size_t i = 0; i < corners; i++) {
        const uint32_t a = w->welded[i], b = w->welded[i % 3 == 2 ? i - 2 : i + 1];
        if (w->faces[i / 3].degenerate) continue;
        edges[count++] = (struct edge){a < b ? a : b, a < b ? b : a, (uint32_t)i};
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 0, first = 0, last = 0; i < count; i++) { /* a queue: waiting[first .. last) */
        const struct edge *e = &edges[i];
        if (i == 0 || e->low != edges[i - 1].low || e->high != edges[i - 1].high) first = last = 0;
        const bool up = w->welded[e->corner] == e->low;
        const bool paired = first < last && (w->welded[waiting[first]] == e->low) != up;
        if (!paired) {
            waiting[last++] = e->corner;
            continue;
        }
        const uint32_t other = waiting[first++];
        w->faces[e->corner / 3].neighbors[e->corner % 3] = other;
        w->faces[other / 3].neighbors[other % 3] = e->corner;
    }
    return true;
}

/* ---- groups ---- */

/* Puts a corner into the group unless it is in one or mapped the other way round. */
static bool join_group(struct work *w, uint32_t corner, uint32_t group) {
    struct face *face = &w->faces[corner / 3];
    if (face->groups[corner % 3] != NONE) return false;
    if (face->any && face->groups[0] == NONE && face->groups[1] == NONE && face->groups[2] == NONE)
        face->preserves = w->groups[group].preserves;
    if (face->preserves != w->groups[group].preserves) return false;
    face->groups[corner % 3] = group;
    return true;
}

/* All that can be reached around the vertex: over the edges that start in it, then over those that
 * end in it. */
static void fill_group(struct work *w, uint32_t corner, uint32_t group) {
    uint32_t at = corner;
    join_group(w, corner, group);
    for (;;) {
        const uint32_t edge = w->faces[at / 3].neighbors[at % 3];
        if (edge == NONE) break;
        at = edge % 3 == 2 ? edge - 2 : edge + 1; /* the reversed edge ends in the vertex */
        if (!join_group(w, at, group)) break;
    }
    for (at = corner;;) {
        const uint32_t ends = at % 3 == 0 ? at + 2 : at - 1;
        const uint32_t edge = w->faces[ends / 3].neighbors[ends % 3];
        if (edge == NONE) break;
        at = edge; /* the reversed edge starts in it */
        if (!join_group(w, at, group)) break;
    }
}

/* A corner's share of the tangent of its group: its face's, by its angle in the vertex's plane. */
static void add_corner(struct work *w, uint32_t corner) {
    const struct face *face = &w->faces[corner / 3];
    const uint32_t base = corner - corner % 3;
    if (face->any) return;
    const uint32_t here = w->welded[corner];
    const float *n = w->mesh->normals + 3 * (size_t)here;
    const float *p = w->mesh->positions + 3 * (size_t)here;
    const float *before =
        w->mesh->positions + 3 * (size_t)w->welded[base + (corner - base + 2) % 3];
    const float *after = w->mesh->positions + 3 * (size_t)w->welded[base + (corner - base + 1) % 3];
    double along[3], v1[3], v2[3];
    for (int k = 0; k < 3; k++) {
        along[k] = (double)face->along[k];
        v1[k] = (double)before[k] - (double)p[k];
        v2[k] = (double)after[k] - (double)p[k];
    }
    project3(along, n);
    project3(v1, n);
    project3(v2, n);
    const double angle = acos(fmax(-1, fmin(1, dot3(v1, v2))));
    float *sum = w->groups[face->groups[corner - base]].tangent;
    for (int k = 0; k < 3; k++) sum[k] += (float)(angle * along[k]);
}

static bool make_groups(struct gn_gltf *g, struct work *w) {
    const size_t corners = w->mesh->corner_count;
    GN_NEW(g, &g->memory.step, w->groups, corners);
    if (g->failed) return false;
    for (uint32_t i = 0; i < corners; i++) {
        const struct face *face = &w->faces[i / 3];
        if (face->degenerate || face->any || face->groups[i % 3] != NONE) continue;
        w->groups[w->group_count].preserves = face->preserves;
        fill_group(w, i, w->group_count++);
    }
    for (uint32_t i = 0; i < corners; i++)
        if (w->faces[i / 3].groups[i % 3] != NONE) add_corner(w, i);
    for (uint32_t i = 0; i < w->group_count; i++) {
        float *t = w->groups[i].tangent;
        double v[3] = {(double)t[0], (double)t[1], (double)t[2]};
        normalize3(v);
        for (int k = 0; k < 3; k++) t[k] = (float)v[k];
    }
    return true;
}

/* The corners of degenerate faces take the group of the first good corner at their vertex. */
static bool lend_groups(struct gn_gltf *g, struct work *w) {
    uint32_t *first = gn_gltf_alloc(g, &g->memory.step, w->mesh->vertex_count, sizeof *first);
    if (g->failed) return false;
    for (uint32_t i = 0; i < w->mesh->corner_count; i++)
        if (!w->faces[i / 3].degenerate && first[w->welded[i]] == 0) first[w->welded[i]] = i + 1;
    for (uint32_t i = 0; i < w->mesh->corner_count; i++) {
        const uint32_t lender = first[w->welded[i]];
        if (w->faces[i / 3].degenerate && lender)
            w->faces[i / 3].groups[i % 3] = w->faces[(lender - 1) / 3].groups[(lender - 1) % 3];
    }
    return true;
}

/* ---- vertices ---- */

/* A vertex for each pair of a vertex and a group; the first keeps its number. */
static bool split_vertices(struct gn_gltf *g, const struct work *w, struct gn_tangents *out) {
    struct copy {
        uint32_t vertex, group;
    } * copies;
    const struct gn_tangent_mesh *mesh = w->mesh;
    const size_t most = mesh->vertex_count + mesh->corner_count;
    uint32_t *numbers = gn_gltf_alloc(g, &g->memory.step, mesh->corner_count, sizeof *numbers);
    bool *taken = gn_gltf_alloc(g, &g->memory.step, mesh->vertex_count, sizeof *taken);
    copies = gn_gltf_alloc(g, &g->memory.step, mesh->corner_count, sizeof *copies);
    GN_NEW(g, &g->memory.step, out->source, most);
    GN_NEW(g, &g->memory.step, out->tangents, most);
    const struct gn_table table = make_table(g, mesh->corner_count, copies, sizeof *copies);
    if (g->failed) return false;
    out->count = mesh->vertex_count;
    for (uint32_t i = 0; i < out->count; i++) {
        out->source[i] = i;
        glm_vec4_copy((vec4){1, 0, 0, 1}, out->tangents[i]);
    }
    uint32_t copy_count = 0;
    for (size_t i = 0; i < mesh->corner_count; i++) {
        const struct copy copy = {mesh->corners[i], w->faces[i / 3].groups[i % 3]};
        uint32_t *slot = gn_table_find(&table, &copy);
        if (*slot == 0) {
            const uint32_t number = taken[copy.vertex] ? (uint32_t)out->count++ : copy.vertex;
            const struct group *group = copy.group == NONE ? NULL : &w->groups[copy.group];
            taken[copy.vertex] = true;
            copies[copy_count] = copy;
            numbers[copy_count++] = number;
            *slot = copy_count;
            out->source[number] = copy.vertex;
            out->tangents[number][0] = 1; /* of what is in no group: (1, 0, 0, 1) */
            out->tangents[number][3] = group && !group->preserves ? -1 : 1;
            if (group) memcpy(out->tangents[number], group->tangent, sizeof group->tangent);
        }
        mesh->corners[i] = numbers[*slot - 1];
    }
    return true;
}

size_t gn_tangents_bytes(size_t corner_count, size_t vertex_count) {
    const size_t corner = sizeof(struct face) / 3 + sizeof(struct group) + sizeof(struct edge) +
                          9 * sizeof(uint32_t) + sizeof(vec4);
    return corner_count * corner + vertex_count * (17 * sizeof(uint32_t) + sizeof(vec4));
}

bool gn_tangents_make(struct gn_gltf *g, const struct gn_tangent_mesh *mesh,
                      struct gn_tangents *out) {
    struct work w = {.mesh = mesh, .welded = weld_corners(g, mesh)};
    GN_NEW(g, &g->memory.step, w.faces, mesh->corner_count / 3);
    if (!w.welded || !w.faces) return false;
    for (size_t i = 0; i < mesh->corner_count / 3; i++)
        measure_face(mesh, w.welded + 3 * i, &w.faces[i]);
    return link_faces(g, &w) && make_groups(g, &w) && lend_groups(g, &w) &&
           split_vertices(g, &w, out);
}
