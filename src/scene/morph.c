/* Targets of a geometry: what each adds to positions, normals and tangents of its vertices. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "scene/pose.h"

enum { PARTS = 3 };
static const char *const semantics[PARTS] = {"POSITION", "NORMAL", "TANGENT"};

/* The accessor of one part of a target; -1: none. */
static int32_t find_part(struct gn_gltf *g, const struct gn_at *target, int part, size_t count) {
    const struct gn_attribute_row shape = {
        .components_min = 3, .components = 3, .types = ~(1U << (GN_U32 - GN_I8))};
    return gn_gltf_attribute(g, target, semantics[part], &shape, count);
}

/* 3 floats of each vertex, into vec4. */
static void put_deltas(const struct gn_accessor *a, const uint32_t *source, size_t count,
                       vec4 *out) {
    gn_accessor_gather(a, 4, source, count, out[0]);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            if (!(fabsf(out[i][k]) < 1e9f)) out[i][k] = 0;
}

static void measure_deltas(vec4 *deltas, size_t count, struct gn_box *box) {
    for (size_t i = 0; i < count; i++) {
        glm_vec3_minv(box->min, deltas[i], box->min); /* begins as zeros: of other vertices */
        glm_vec3_maxv(box->max, deltas[i], box->max);
    }
}

/* Of a geometry whose normals are those of its faces: what these become with the whole target. */
static void make_face_deltas(const struct gn_scene *scene, const struct gn_geometry *geometry,
                             vec4 *positions, vec4 *normals) {
    const uint32_t *index = scene->buffers.indices + geometry->first_index;
    for (uint32_t t = 0; t + 2 < geometry->index_count; t += 3) {
        vec3 corner[3], u, v, n;
        for (int k = 0; k < 3; k++)
            glm_vec3_add(scene->buffers.positions + 3 * (size_t)index[t + (uint32_t)k],
                         positions[index[t + (uint32_t)k] - geometry->first_vertex], corner[k]);
        glm_vec3_sub(corner[1], corner[0], u);
        glm_vec3_sub(corner[2], corner[0], v);
        glm_vec3_cross(u, v, n);
        gn_unit(n);
        if (!(glm_vec3_norm(n) > 0)) continue;
        for (int k = 0; k < 3; k++) {
            const uint32_t vertex = index[t + (uint32_t)k];
            glm_vec3_sub(n, scene->buffers.normals + 3 * (size_t)vertex,
                         normals[vertex - geometry->first_vertex]);
        }
    }
}

static bool has_room(struct gn_gltf *g, const struct gn_at *at, const struct gn_targets *targets,
                     const struct gn_geometry *geometry) {
    const uint64_t most = (uint64_t)GN_DELTAS_WIDTH * GN_DELTAS_ROWS_MAX;
    const uint64_t texels = (uint64_t)targets->count * targets->parts * geometry->vertex_count;
    const uint64_t vertices = (uint64_t)geometry->first_vertex + geometry->vertex_count;
    if (texels <= most - g->scene->deformation.delta_texels && vertices <= 1 << 24) return true;
    gn_gltf_warn(
        g, at, "shown without its morph targets: with them there are more than %" PRIu64 " deltas",
        most);
    return false;
}

bool gn_morph_build(struct gn_gltf *g, const struct gn_at *primitive, const struct gn_shape *shape,
                    const uint32_t *source, struct gn_geometry *geometry) {
    struct gn_at list = gn_at_array(g, primitive, "targets");
    const size_t n = geometry->vertex_count,
                 elements = gn_gltf_accessor(g, shape->attribute[GN_ATTRIBUTE_POSITION])->count;
    const bool by_faces = shape->attribute[GN_ATTRIBUTE_NORMAL] < 0;
    struct gn_targets made = {.count = (uint32_t)gn_at_size(&list), .parts = by_faces ? 2 : 1};
    int32_t(*parts)[PARTS] = gn_gltf_alloc(g, &g->memory.step, made.count, sizeof *parts);
    for (uint32_t t = 0; t < made.count && !g->failed; t++) {
        struct gn_at target = gn_at_item(g, &list, t);
        gn_gltf_spare(g, "shown without it");
        for (int part = 0; part < PARTS && !g->failed; part++) {
            const bool read = part == 0 || (part == 1 && !by_faces) ||
                              (part == 2 && gn_geometry_has(geometry, GN_ATTRIBUTE_TANGENT));
            parts[t][part] = read ? find_part(g, &target, part, elements) : -1;
            if (parts[t][part] >= 0 && made.parts <= part) made.parts = (uint8_t)(part + 1);
        }
    }
    if (g->failed) return false;
    if (n == 0 || !has_room(g, primitive, &made, geometry)) return true;
    made.first_texel = (uint32_t)g->scene->deformation.delta_texels;
    const uint64_t texels = (uint64_t)made.count * made.parts * n;
    GN_NEW(g, g->memory.scene, made.deltas, texels);
    GN_NEW(g, g->memory.scene, made.boxes, made.count);
    GN_NEW(g, g->memory.scene, geometry->targets, 1);
    if (g->failed || !gn_gltf_count(g, texels * sizeof *made.deltas)) return false; /* the GPU's */
    g->scene->deformation.delta_texels += texels;
    for (uint32_t t = 0; t < made.count; t++) {
        vec4 *of_target = made.deltas + (uint64_t)t * made.parts * n;
        for (int part = 0; part < made.parts; part++)
            if (parts[t][part] >= 0)
                put_deltas(gn_gltf_accessor(g, parts[t][part]), source, n,
                           of_target + (size_t)part * n);
        measure_deltas(of_target, n, &made.boxes[t]);
        if (by_faces) make_face_deltas(g->scene, geometry, of_target, of_target + n);
        if (!gn_gltf_check_time(g)) return false;
    }
    *geometry->targets = made;
    return true;
}
