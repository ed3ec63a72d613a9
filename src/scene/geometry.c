/* Fills the scene's vertices and indices from the accessors of each geometry. */
#include "scene/private.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CLOSED_CORNERS = 2 }; /* tested for being closed, for each vertex of the limit */

/* The square of a larger number overflows a float. */
static bool position_is_usable(const float *p) {
    return fabsf(p[0]) < 1e18f && fabsf(p[1]) < 1e18f && fabsf(p[2]) < 1e18f;
}

/* ---- vertices ---- */

/* Maps vertices of the scene to elements of an accessor: source[i], or i if source is NULL. */
struct gather {
    const struct gn_accessor *accessor;
    const uint32_t *source;
    size_t first, count; /* first: of the scene's vertices, for who calls */
};

/* Copies elements as floats; missing components stay as they are. */
static void put_floats(const struct gather *gather, size_t components, float *out) {
    gn_accessor_gather(gather->accessor, components, gather->source, gather->count, out);
}

/* The same in work memory; missing components are 1 (an alpha, for one). */
static float *read_floats(struct gn_gltf *g, const struct gather *gather, size_t components) {
    const size_t count = gather->count * components;
    float *floats =
        gn_gltf_alloc(g, &g->memory.step, (uint64_t)gather->count * components, sizeof *floats);
    if (!floats) return NULL;
    for (size_t i = 0; gather->accessor->components < components && i < count; i++) floats[i] = 1;
    put_floats(gather, components, floats);
    return floats;
}

/* What is taken off the positions of an accessor that lie far off (gltf/far.c), or NULL. */
static const double *origin_of(const struct gn_gltf *g, const struct gn_shape *shape) {
    const bool of_skin = shape->attribute[GN_ATTRIBUTE_JOINTS0] >= 0;
    return of_skin ? NULL : g->file.origins[shape->attribute[GN_ATTRIBUTE_POSITION]];
}

static void take_origin(const double *origin, float *positions, size_t count) {
    for (size_t i = 0; origin && i < 3 * count; i++)
        positions[i] = (float)((double)positions[i] - origin[i % 3]);
}

/* All attributes but positions and normals, of the vertices first .. first + count; huge and
 * infinite values become 0. */
static bool put_other_attributes(struct gn_gltf *g, const int32_t *attribute,
                                 struct gather gather) {
    for (int i = GN_ATTRIBUTE_NORMAL + 1; i < GN_ATTRIBUTE_COUNT; i++) {
        const struct gn_attribute_row *row = &gn_attributes[i];
        uint8_t *array = g->scene->buffers.attributes[i];
        gather.accessor = gn_gltf_accessor(g, attribute[i]);
        if (!array || row->format >= GN_ATTRIBUTE_UINT16) continue; /* of skins: at the end */
        uint8_t *bytes = array + gather.first * row->bytes;
        float *floats = (float *)(void *)bytes;
        const size_t count = gather.count * row->components;
        if (!gather.accessor) { /* the array is zeroed */
            if (row->missing_is_1 && row->format == GN_ATTRIBUTE_UNORM8)
                memset(bytes, 255, gather.count * row->bytes);
            else if (row->missing_is_1)
                for (size_t k = 0; k < count; k++) floats[k] = 1;
        } else if (row->format == GN_ATTRIBUTE_UNORM8) {
            struct gn_accessor normalized = *gather.accessor;
            struct gather from = gather;
            normalized.normalized = true;
            from.accessor = &normalized;
            const float *values = read_floats(g, &from, row->components);
            if (!values) return false;
            for (size_t k = 0; k < count; k++)
                bytes[k] = (uint8_t)(fminf(fmaxf(values[k], 0), 1) * 255 + .5f);
        } else {
            put_floats(&gather, row->components, floats);
            for (size_t k = 0; k < count; k++)
                if (!(fabsf(floats[k]) < 1e18f)) floats[k] = 0;
        }
    }
    return gn_skin_put_vertices(g, attribute, gather.source, gather.first, gather.count);
}

/* ---- corners ---- */

/* In work memory. */
static uint32_t *read_raw_indices(struct gn_gltf *g, const struct gn_at *at,
                                  const struct gn_shape *shape, size_t *count) {
    size_t vertex_count = gn_gltf_accessor(g, shape->attribute[GN_ATTRIBUTE_POSITION])->count;
    const struct gn_accessor *indices = gn_gltf_accessor(g, shape->indices);
    *count = indices ? indices->count : vertex_count;
    uint32_t *raw = gn_gltf_alloc(g, &g->memory.step, *count, sizeof *raw);
    if (!raw) return NULL;
    for (size_t i = 0; !indices && i < *count; i++) raw[i] = (uint32_t)i;
    if (indices) gn_accessor_indices(indices, raw);
    struct gn_at place = gn_at_any(at, "indices");
    for (size_t i = 0; i < *count; i++) {
        if (raw[i] < vertex_count) continue;
        gn_gltf_fail(g, &place, "element %zu is vertex %" PRIu32 ", but there are %zu vertices", i,
                     raw[i], vertex_count);
        return NULL;
    }
    return raw;
}

int gn_compare_indices(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Numbers the vertices that the corners use from 0 on, as the elements of *used, in work memory:
 * what a primitive costs depends on its own size, not on that of the accessors that it shares. */
static bool number_used_vertices(struct gn_gltf *g, uint32_t *corners, size_t count,
                                 uint32_t **used, size_t *used_count) {
    uint32_t *list = *used = gn_gltf_alloc(g, &g->memory.step, count, sizeof *list);
    if (!list) return false;
    size_t n = 0;
    memcpy(list, corners, count * sizeof *list);
    qsort(list, count, sizeof *list, gn_compare_indices);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || list[i] != list[n - 1]) list[n++] = list[i];
    for (size_t i = 0; i < count; i++) {
        const uint32_t *at = bsearch(&corners[i], list, n, sizeof *list, gn_compare_indices);
        corners[i] = (uint32_t)(at - list);
    }
    *used_count = n;
    return true;
}

void gn_triangle_of(int64_t mode, const uint32_t *raw, size_t t, uint32_t out[3]) {
    const size_t odd = t % 2;
    if (mode == GN_MODE_TRIANGLES)
        memcpy(out, raw + 3 * t, 3 * sizeof *out);
    else if (mode == GN_MODE_STRIP)
        memcpy(out, (uint32_t[]){raw[t], raw[t + 1 + odd], raw[t + 2 - odd]}, 3 * sizeof *out);
    else
        memcpy(out, (uint32_t[]){raw[t + 1], raw[t + 2], raw[0]}, 3 * sizeof *out);
}

/* Unrolls strips and fans into out, dropping triangles with equal indices or with a
 * position that is not finite; returns the number of corners. */
static size_t unroll_triangles(struct gn_gltf *g, const struct gn_at *at,
                               const struct gn_shape *shape, const uint32_t *raw,
                               const float *positions, uint32_t *out) {
    size_t count = 0, dropped = 0;
    for (size_t t = 0; t < shape->corner_count / 3; t++) {
        uint32_t v[3];
        gn_triangle_of(shape->mode, raw, t, v);
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        if (position_is_usable(positions + 3 * (size_t)v[0]) &&
            position_is_usable(positions + 3 * (size_t)v[1]) &&
            position_is_usable(positions + 3 * (size_t)v[2])) {
            memcpy(out + count, v, sizeof v);
            count += 3;
        } else
            dropped++;
    }
    g->misplaced += dropped;
    if (dropped > 0)
        gn_gltf_warn(g, at, "%zu triangles with positions that are not finite are not shown",
                     dropped);
    return count;
}

/* ---- geometries ---- */

/* The file's, of unit length; 0 where one has none: true. */
static bool normalize_normals(float *normals, size_t count) {
    bool lacks = false;
    for (size_t i = 0; i < count; i++) {
        float *n = normals + 3 * i;
        const float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        const bool right = length > 1e-12f && length < 1e18f;
        lacks |= !right;
        for (int k = 0; k < 3; k++) n[k] = right ? n[k] / length : 0;
    }
    return lacks;
}

/* A geometry with vertices of its own while it is made: its positions and normals are where they
 * stay, behind those of the scene. Each vertex is one of the file's accessors: source. */
struct own {
    uint32_t *corners, *source; /* source: in work memory */
    float *positions, *normals;
    size_t corner_count, count;
};

/* Renumbers the vertices in the order in which corners use them. */
static bool compact_vertices(struct gn_gltf *g, size_t vertex_count, struct own *own) {
    uint32_t *numbers = gn_gltf_alloc(g, &g->memory.step, vertex_count, sizeof *numbers);
    GN_NEW(g, &g->memory.step, own->source, own->corner_count);
    if (g->failed) return false;
    for (size_t i = 0; i < own->corner_count; i++) {
        uint32_t *number = &numbers[own->corners[i]];
        if (*number == 0) {
            own->source[own->count++] = own->corners[i];
            *number = (uint32_t)own->count;
        }
        own->corners[i] = *number - 1;
    }
    return true;
}

static void repair_normals(struct gn_gltf *g, const struct gn_at *at, const float *positions,
                           float *normals, const uint32_t *corners, size_t corner_count) {
    if (gn_normals_repair(positions, normals, corners, corner_count) > 0)
        gn_gltf_warn(g, at, "normals without length; those of the faces are used");
}

/* Those of the file's vertices that the triangles use, with their normals, or with flat ones. */
static bool make_own(struct gn_gltf *g, const struct gn_at *at, const struct gn_shape *shape,
                     struct own *own) {
    const struct gn_accessor *a = gn_gltf_accessor(g, shape->attribute[GN_ATTRIBUTE_POSITION]);
    const struct gn_accessor *n = gn_gltf_accessor(g, shape->attribute[GN_ATTRIBUTE_NORMAL]);
    struct gather vertices = {.accessor = a, .count = a->count};
    size_t count = 0;
    uint32_t *raw = read_raw_indices(g, at, shape, &count), *used = NULL;
    if (!raw) return false;
    if (count < a->count && !number_used_vertices(g, raw, count, &used, &vertices.count))
        return false;
    vertices.source = used;
    float *positions = read_floats(g, &vertices, 3);
    if (!positions) return false;
    take_origin(origin_of(g, shape), positions, vertices.count);
    own->corner_count = unroll_triangles(g, at, shape, raw, positions, own->corners);
    if (n ? !compact_vertices(g, vertices.count, own)
          : !gn_geometry_flat_normals(g, positions, own->corners, own->corner_count, vertices.count,
                                      &own->source, own->normals, &own->count))
        return false;
    for (size_t i = 0; i < own->count; i++) {
        memcpy(own->positions + 3 * i, positions + 3 * (size_t)own->source[i],
               3 * sizeof *positions);
        if (used) own->source[i] = used[own->source[i]];
    }
    if (!n) return true;
    const struct gather normals = {.accessor = n, .source = own->source, .count = own->count};
    put_floats(&normals, 3, own->normals);
    if (normalize_normals(own->normals, own->count))
        repair_normals(g, at, own->positions, own->normals, own->corners, own->corner_count);
    return true;
}

/* Makes tangents, for which vertices may become several. NULL: without them, where memory_mb leaves
 * too little, or the load failed. */
static vec4 *add_tangents(struct gn_gltf *g, const struct gn_at *at, const struct gn_shape *shape,
                          struct own *own) {
    const struct gn_texture_ref ref = gn_gltf_tangents_uv(g, shape->tangents);
    const struct gather from = {
        .accessor = gn_gltf_accessor(g, shape->attribute[GN_ATTRIBUTE_UV0 + ref.uv_set]),
        .source = own->source,
        .count = own->count};
    if (gn_tangents_bytes(own->corner_count, own->count) > gn_gltf_room(g)) {
        gn_gltf_warn(g, at,
                     "no memory for tangents within memory_mb; shown without its normal map");
        return NULL;
    }
    float *uv = read_floats(g, &from, 2);
    if (!uv) return NULL;
    for (size_t i = 0; i < own->count; i++) {
        const float *m = ref.uv_from_uv, u = uv[2 * i], v = uv[2 * i + 1];
        uv[2 * i] = m[0] * u + m[2] * v;
        uv[2 * i + 1] = m[1] * u + m[3] * v;
        for (int k = 0; k < 2; k++)
            if (!(fabsf(uv[2 * i + k]) < 1e18f)) uv[2 * i + k] = 0;
    }
    const struct gn_tangent_mesh mesh = {own->positions, own->normals,      uv,
                                         own->corners,   own->corner_count, own->count};
    struct gn_tangents made;
    if (!gn_tangents_make(g, &mesh, &made)) return NULL;
    assert(made.count <= own->corner_count);           /* as allocated */
    for (size_t i = own->count; i < made.count; i++) { /* those that there were stay */
        memcpy(own->positions + 3 * i, own->positions + 3 * (size_t)made.source[i],
               3 * sizeof *own->positions);
        memcpy(own->normals + 3 * i, own->normals + 3 * (size_t)made.source[i],
               3 * sizeof *own->normals);
    }
    for (size_t i = 0; i < made.count; i++) made.source[i] = own->source[made.source[i]];
    own->source = made.source;
    own->count = made.count;
    return made.tangents;
}

static bool fill_own_geometry(struct gn_gltf *g, const struct gn_at *at,
                              const struct gn_shape *shape, struct gn_geometry *geometry) {
    struct gn_scene_buffers *buffers = &g->scene->buffers;
    const size_t first = buffers->vertex_count;
    struct own own = {.corners = buffers->indices + geometry->first_index,
                      .positions = buffers->positions + 3 * first,
                      .normals = buffers->normals + 3 * first};
    if (!make_own(g, at, shape, &own)) return false;
    const bool tangents = shape->tangents != GN_TANGENTS_NONE;
    const vec4 *made = tangents ? add_tangents(g, at, shape, &own) : NULL;
    if (g->failed) return false;
    geometry->first_vertex = (uint32_t)first;
    geometry->vertex_count = (uint32_t)own.count;
    geometry->index_count = (uint32_t)own.corner_count;
    for (size_t i = 0; i < own.corner_count; i++) own.corners[i] += geometry->first_vertex;
    buffers->vertex_count += geometry->vertex_count;
    if (!put_other_attributes(
            g, shape->attribute,
            (struct gather){.source = own.source, .first = first, .count = own.count}))
        return false;
    if (made) {
        memcpy(buffers->tangents + 4 * first, made, own.count * sizeof *made);
        gn_geometry_repair_tangents(g->scene, first, own.count);
        geometry->attributes |= 1u << GN_ATTRIBUTE_TANGENT;
    }
    return !shape->targets || gn_morph_build(g, at, shape, own.source, geometry);
}

static bool fill_shared_geometry(struct gn_gltf *g, const struct gn_at *at,
                                 const struct gn_shape *shape, struct gn_geometry *geometry) {
    struct gn_scene_buffers *buffers = &g->scene->buffers;
    struct gn_vertices *vertices = &g->primitives.vertices[shape->vertices];
    if (!vertices->filled) {
        vertices->filled = true;
        vertices->first = buffers->vertex_count;
        buffers->vertex_count += vertices->count;
        struct gather gather = {.first = vertices->first, .count = vertices->count};
        gather.accessor = gn_gltf_accessor(g, vertices->attribute[GN_ATTRIBUTE_POSITION]);
        put_floats(&gather, 3, buffers->positions + 3 * gather.first);
        take_origin(origin_of(g, shape), buffers->positions + 3 * gather.first, gather.count);
        gather.accessor = gn_gltf_accessor(g, vertices->attribute[GN_ATTRIBUTE_NORMAL]);
        put_floats(&gather, 3, buffers->normals + 3 * gather.first);
        vertices->lacks_normals =
            normalize_normals(buffers->normals + 3 * gather.first, gather.count);
        if (!put_other_attributes(g, vertices->attribute, gather)) return false;
        if (vertices->attribute[GN_ATTRIBUTE_TANGENT] >= 0)
            gn_geometry_repair_tangents(g->scene, gather.first, gather.count);
    }
    size_t count = 0;
    const uint32_t *raw = read_raw_indices(g, at, shape, &count);
    if (!raw) return false;
    uint32_t *corners = buffers->indices + geometry->first_index;
    count = unroll_triangles(g, at, shape, raw, buffers->positions + 3 * (size_t)vertices->first,
                             corners);
    for (size_t i = 0; i < count; i++) corners[i] += vertices->first;
    geometry->first_vertex = vertices->first;
    geometry->vertex_count = vertices->count;
    geometry->index_count = (uint32_t)count;
    if (vertices->lacks_normals)
        repair_normals(g, at, buffers->positions, buffers->normals, corners, count);
    return !shape->targets || gn_morph_build(g, at, shape, NULL, geometry);
}

/* Allocates for the largest possible number of vertices and indices. */
static bool allocate_vertices(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    uint64_t vertices = 0, corners = 0;
    bool any[GN_ATTRIBUTE_COUNT] = {[GN_ATTRIBUTE_POSITION] = true, [GN_ATTRIBUTE_NORMAL] = true};
    struct gn_at root = gn_at_root(g), meshes = gn_at_any(&root, "meshes");
    for (size_t i = 0; i < g->primitives.vertices_count; i++)
        vertices += g->primitives.vertices[i].count;
    for (size_t i = 0; i < scene->geometry_count; i++) {
        const struct gn_shape *shape = &g->primitives.shapes[i];
        corners += shape->corner_count;
        if (shape->vertices == UINT32_MAX) vertices += shape->corner_count;
        for (int k = 0; k < GN_ATTRIBUTE_COUNT; k++) any[k] |= shape->attribute[k] >= 0;
        any[GN_ATTRIBUTE_TANGENT] |= shape->tangents != GN_TANGENTS_NONE;
    }
    const uint64_t added = g->limits.floor.kind != GN_FLOOR_NONE; /* the floor's quad (floor.c) */
    if (vertices > g->limits.vertices)
        return gn_gltf_fail(g, &meshes,
                            "%" PRIu64 " vertices are more than the limit vertices=%" PRIu64,
                            vertices, g->limits.vertices);
    if (corners + 6 * added > UINT32_MAX)
        return gn_gltf_fail(g, &meshes, "%" PRIu64 " indices are more than can be drawn", corners);
    vertices += 4 * added;
    GN_NEW(g, g->memory.scene, scene->geometries, scene->geometry_count + added);
    GN_NEW(g, g->memory.scene, scene->buffers.indices, corners + 6 * added);
    GN_NEW(g, g->memory.scene, scene->buffers.spreads, vertices);
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++)
        if (any[i])
            scene->buffers.attributes[i] =
                gn_gltf_alloc(g, g->memory.scene, vertices, gn_attributes[i].bytes);
    return !g->failed;
}

bool gn_gltf_geometries(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct gn_at root = gn_at_root(g), meshes = gn_at_array(g, &root, "meshes");
    if (!allocate_vertices(g)) return false;
    for (uint32_t i = 0; i < scene->geometry_count; i++) {
        struct gn_shape *shape = &g->primitives.shapes[i];
        struct gn_geometry *geometry = &scene->geometries[i];
        gn_gltf_progress(g, i, scene->geometry_count);
        struct gn_at mesh = gn_at_element(&meshes, shape->mesh);
        struct gn_at list = gn_at_array(g, &mesh, "primitives");
        struct gn_at at = gn_at_element(&list, shape->primitive);
        gn_arena_reset(&g->memory.step);
        geometry->first_index = scene->buffers.index_count;
        geometry->origin = origin_of(g, shape);
        for (int k = 0; k < GN_ATTRIBUTE_COUNT; k++)
            geometry->attributes |= (uint32_t)(shape->attribute[k] >= 0) << k;
        bool filled = shape->vertices == UINT32_MAX ? fill_own_geometry(g, &at, shape, geometry)
                                                    : fill_shared_geometry(g, &at, shape, geometry);
        if ((!filled && !gn_gltf_spare(g, "not shown")) || !gn_gltf_check_time(g)) return false;
        scene->buffers.index_count += geometry->index_count;
        gn_geometry_measure(scene, geometry, &shape->area);
        if (gn_geometry_has(geometry, GN_ATTRIBUTE_JOINTS0) && !gn_skin_measure(g, &at, geometry))
            return false;
        if (shape->attribute[GN_ATTRIBUTE_NORMAL] >=
            0) /* else its normals are those of the faces */
            gn_geometry_add_spreads(scene, geometry);
        /* The test visits all vertices, which many geometries may share: it runs only where this
         * one may use half of them. Many geometries may read the same indices, too: its work is
         * bounded by the limit on vertices. */
        const bool may_use_half = geometry->vertex_count <= 2 * (uint64_t)geometry->index_count;
        if (may_use_half && g->closed_corners <= CLOSED_CORNERS * g->limits.vertices)
            gn_geometry_test_closed(g, geometry);
        g->closed_corners += geometry->index_count;
    }
    /* makes vertices that no triangle uses finite, too */
    for (size_t i = 0; i < scene->buffers.vertex_count; i++) {
        float *p = scene->buffers.positions + 3 * i, *n = scene->buffers.normals + 3 * i;
        if (!position_is_usable(p)) memset(p, 0, 3 * sizeof *p);
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) n[1] = 1;
    }
    return true;
}
