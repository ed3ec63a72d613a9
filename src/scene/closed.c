/* Whether a geometry is the boundary of solid bodies with front faces outward. Then the first
 * surface that a light outside reaches is a front face, and back faces can be left out of its
 * shadow map.
 *
 * Vertices are welded by position. A surface is closed when every directed edge meets its opposite,
 * which is tested without a table of edges: each adds or takes away a 64-bit hash of its undirected
 * edge, and what is left must be zero. A body is outward when its signed volume is positive; bodies
 * are separated by union-find over the welded vertices. */
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "scene/private.h"

struct welder {
    const struct gn_scene *scene;
    const struct gn_hash_key *key;
    const struct gn_geometry *geometry;
    uint32_t *slots; /* hash table of vertex + 1 */
    uint32_t mask;
    uint32_t *vertex; /* per vertex of the geometry: the first one in the same place */
    uint32_t *body;   /* per welded vertex: parent in its body's tree */
    double *volume;   /* per root: six times the signed volume */
};

static const float *position_of(const struct welder *w, uint32_t vertex) {
    return w->scene->buffers.positions + 3 * ((size_t)w->geometry->first_vertex + vertex);
}

static uint32_t body_root(struct welder *w, uint32_t vertex) {
    while (w->body[vertex] != vertex) vertex = w->body[vertex] = w->body[w->body[vertex]];
    return vertex;
}

static uint64_t edge_hash(uint32_t a, uint32_t b) {
    uint32_t ends[2] = {a < b ? a : b, a < b ? b : a};
    uint64_t h = gn_hash(GN_HASH_INIT, ends, sizeof ends);
    return a < b ? h : -h;
}

static bool edges_meet(struct welder *w) {
    uint64_t sum = 0;
    const uint32_t *index = w->scene->buffers.indices + w->geometry->first_index;
    for (uint32_t i = 0; i < w->geometry->index_count; i += 3) {
        uint32_t t[3];
        for (int k = 0; k < 3; k++)
            t[k] = w->vertex[index[i + (uint32_t)k] - w->geometry->first_vertex];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        sum += edge_hash(t[0], t[1]) + edge_hash(t[1], t[2]) + edge_hash(t[2], t[0]);
        w->body[body_root(w, t[1])] = body_root(w, t[0]);
        w->body[body_root(w, t[2])] = body_root(w, t[0]);
    }
    return sum == 0;
}

static bool bodies_are_outward(struct welder *w) {
    const uint32_t *index = w->scene->buffers.indices + w->geometry->first_index;
    uint32_t first = w->geometry->first_vertex;
    for (uint32_t i = 0; i < w->geometry->index_count; i += 3) {
        uint32_t body = body_root(w, w->vertex[index[i] - first]);
        const float *from = position_of(w, body);
        double e[3][3]; /* from a vertex of the body to those of the triangle */
        for (uint32_t k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                e[k][axis] =
                    (double)position_of(w, index[i + k] - first)[axis] - (double)from[axis];
        w->volume[body] += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                           e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }
    for (uint32_t v = 0; v < w->geometry->vertex_count; v++)
        if (w->volume[v] < 0.0) return false;
    return true;
}

void gn_geometry_test_closed(const struct gn_gltf *g, struct gn_geometry *geometry) {
    if (geometry->index_count < 12 || geometry->flat) return;
    size_t room = gn_gltf_room(g);
    struct gn_arena arena = {.limit = room ? room : 1};
    uint32_t count = geometry->vertex_count, size = 16;
    while (size < 2 * (uint64_t)count && size < 1u << 31) size *= 2;
    struct welder w = {
        .scene = g->scene,
        .key = &g->hash_key,
        .geometry = geometry,
        .slots = gn_arena_alloc(&arena, size, sizeof *w.slots),
        .mask = size - 1,
        .vertex = gn_arena_alloc(&arena, count, sizeof *w.vertex),
        .body = gn_arena_alloc(&arena, count, sizeof *w.body),
        .volume = gn_arena_alloc(&arena, count, sizeof *w.volume),
    };
    const bool has_memory = w.slots && w.vertex && w.body && w.volume;

    /* vertices in the same place become one */
    for (uint32_t v = 0; has_memory && v < count; v++) {
        float p[3];
        for (int k = 0; k < 3; k++) p[k] = position_of(&w, v)[k] + 0.0f; /* -0 is 0 */
        uint32_t at = (uint32_t)gn_hash_keyed(w.key, p, sizeof p) & w.mask;
        for (; w.slots[at]; at = (at + 1) & w.mask) {
            const float *q = position_of(&w, w.slots[at] - 1);
            if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) break;
        }
        if (!w.slots[at]) w.slots[at] = v + 1;
        w.vertex[v] = w.slots[at] - 1;
        w.body[v] = v;
    }

    geometry->watertight = has_memory && edges_meet(&w);
    geometry->closed = geometry->watertight && bodies_are_outward(&w);
    gn_arena_finish(&arena);
}
