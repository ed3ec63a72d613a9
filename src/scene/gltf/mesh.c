/* Maps the primitives of the used meshes to geometries. Primitives with the same accessors share a
 * geometry, and geometries with the same vertex accessors share their vertices. Reads only the
 * headers of accessors, and makes sparse ones dense. */
#include "scene/private.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "scene/gltf/table.h"

struct reader {
    struct gn_gltf *g;
    struct gn_table shapes, vertices;
    uint32_t shape_count;
};

/* Joints are read where a node has a skin for them, and with their weights only; the second four
 * with the first. */
static void choose_joints(struct gn_gltf *g, const struct gn_at *primitive, bool with_skin,
                          int32_t *out) {
    bool use = with_skin;
    for (int set = 0; set < 2; set++) {
        int32_t *joints = &out[GN_ATTRIBUTE_JOINTS0 + 2 * set];
        int32_t *weights = &out[GN_ATTRIBUTE_WEIGHTS0 + 2 * set];
        use &= *joints >= 0 && *weights >= 0;
        if (!use) *joints = *weights = -1;
        if (with_skin && !use && set == 0)
            gn_gltf_warn(g, primitive, "has no JOINTS_0 and WEIGHTS_0; shown without its skin");
    }
}

int32_t gn_gltf_attribute(struct gn_gltf *g, const struct gn_at *of, const char *semantic,
                          const struct gn_attribute_row *row, size_t count) {
    const int32_t index = gn_at_ref(g, of, semantic, g->file.accessor_count, "accessors");
    const struct gn_accessor *a = gn_gltf_accessor(g, index);
    struct gn_at at = gn_at_any(of, semantic);
    if (a && (a->components < row->components_min || a->components > row->components))
        gn_gltf_fail(g, &at, "accessor %d has %d components, must be VEC%d", index, a->components,
                     row->components_min);
    else if (a && !(row->types >> (a->component - GN_I8) & 1))
        gn_gltf_fail(g, &at, "accessor %d has component type %d, which is not allowed for it",
                     index, a->component);
    else if (a && a->count < count)
        gn_gltf_fail(g, &at, "%zu elements, but POSITION has %zu", a->count, count);
    else if (a && a->count > count && count > 0)
        gn_gltf_warn(g, &at, "%zu elements, but POSITION has %zu; the others are ignored", a->count,
                     count);
    if (count > 0 && gn_gltf_spare(g, "shown without it")) return -1;
    return g->failed ? -1 : index;
}

/* The number of vertices, or 0: failed, or nothing to show (with a warning, or a note of what is
 * missing). Tangents are read
 * where there are normals and a normal map needs them. */
static size_t read_attributes(struct gn_gltf *g, const struct gn_at *primitive, bool with_tangents,
                              bool with_skin, const uint64_t uv_sets[GN_UV_SETS], int32_t *out) {
    struct gn_at attributes = gn_at_object(g, primitive, "attributes");
    const char *semantics[GN_ATTRIBUTE_COUNT];
    char uv_names[GN_UV_SETS][32];
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++) semantics[i] = gn_attributes[i].semantic;
    for (int i = 0; i < GN_UV_SETS; i++) {
        snprintf(uv_names[i], sizeof uv_names[i], "TEXCOORD_%" PRIu64, uv_sets[i]);
        semantics[GN_ATTRIBUTE_UV0 + i] = uv_names[i];
    }
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++) out[i] = -1;
    out[GN_ATTRIBUTE_POSITION] =
        gn_at_ref(g, &attributes, "POSITION", g->file.accessor_count, "accessors");
    struct gn_at draco = gn_at_object(g, primitive, "extensions.KHR_draco_mesh_compression");
    const struct gn_accessor *positions = gn_gltf_accessor(g, out[GN_ATTRIBUTE_POSITION]);
    if (g->failed) return 0;
    if (draco.json && positions && !positions->backed) {
        g->is_missing[GN_MISSING_DRACO] = true;
        return 0;
    }
    if (!positions) {
        gn_gltf_warn(g, primitive, "has no POSITION; not shown");
        return 0;
    }
    if ((uint64_t)positions->count > UINT32_MAX) {
        gn_gltf_fail(g, primitive, "%zu vertices are more than can be drawn", positions->count);
        return 0;
    }
    for (int i = 0; i < GN_ATTRIBUTE_COUNT && !g->failed; i++) {
        const bool unused =
            i >= GN_ATTRIBUTE_JOINTS0 && i <= GN_ATTRIBUTE_WEIGHTS1
                ? !with_skin
                : i == GN_ATTRIBUTE_TANGENT && (!with_tangents || out[GN_ATTRIBUTE_NORMAL] < 0);
        if (!unused)
            out[i] = gn_gltf_attribute(g, &attributes, semantics[i], &gn_attributes[i],
                                       i == GN_ATTRIBUTE_POSITION ? 0 : positions->count);
    }
    if (!g->failed) choose_joints(g, primitive, with_skin, out);
    return g->failed ? 0 : positions->count;
}

/* Fills the shape's key and size; false: failed or nothing to show. */
static bool read_shape(struct gn_gltf *g, const struct gn_at *primitive,
                       const uint64_t uv_sets[GN_UV_SETS], struct gn_shape *shape) {
    uint64_t mode = gn_at_uint(g, primitive, "mode", GN_MODE_TRIANGLES);
    struct gn_at mode_at = gn_at_any(primitive, "mode"),
                 indices_at = gn_at_any(primitive, "indices");
    if (mode > GN_MODE_FAN) return gn_gltf_fail(g, &mode_at, "%" PRIu64 " is not in 0..6", mode);
    if (mode < GN_MODE_TRIANGLES) {
        gn_gltf_warn(g, primitive, "points and lines are not shown");
        return false;
    }
    shape->mode = (int32_t)mode;
    shape->indices = gn_at_ref(g, primitive, "indices", g->file.accessor_count, "accessors");
    uint64_t count =
        read_attributes(g, primitive, shape->tangents != GN_TANGENTS_NONE,
                        g->file.meshes[shape->mesh].skinned, uv_sets, shape->attribute);
    if (count == 0) return false;
    const struct gn_accessor *indices = gn_gltf_accessor(g, shape->indices);
    if (g->failed) return false;
    if (indices &&
        (indices->components != 1 || (indices->component != GN_U8 && indices->component != GN_U16 &&
                                      indices->component != GN_U32)))
        return gn_gltf_fail(g, &indices_at, "must be SCALAR of unsigned bytes, shorts or ints");
    if (indices) count = indices->count;
    if (mode == GN_MODE_TRIANGLES && count % 3 != 0)
        gn_gltf_warn(g, primitive,
                     "%" PRIu64 " indices are not a multiple of 3; the last "
                     "%d ignored",
                     count, (int)(count % 3));
    shape->corner_count = mode == GN_MODE_TRIANGLES ? count - count % 3
                          : count < 3               ? 0
                                                    : 3 * (count - 2);
    if (shape->corner_count == 0) gn_gltf_warn(g, primitive, "has no triangle");
    return shape->corner_count > 0;
}

/* Which tangents are made: none where the file has them. */
static void choose_tangents(struct gn_gltf *g, const struct gn_at *primitive,
                            const uint64_t uv_sets[GN_UV_SETS], struct gn_shape *shape) {
    if (shape->tangents == GN_TANGENTS_NONE) return;
    const int uv_set = gn_gltf_tangents_uv(g, shape->tangents).uv_set;
    const bool has_uv = shape->attribute[GN_ATTRIBUTE_UV0 + uv_set] >= 0;
    if (!has_uv)
        gn_gltf_warn(g, primitive, "has no TEXCOORD_%" PRIu64 "; shown without its normal map",
                     uv_sets[uv_set]);
    if (!has_uv) shape->attribute[GN_ATTRIBUTE_TANGENT] = -1;
    if (!has_uv || shape->attribute[GN_ATTRIBUTE_TANGENT] >= 0) shape->tangents = GN_TANGENTS_NONE;
}

/* ---- primitives ---- */

/* Counts the targets of a primitive: all of a mesh that have any have the same number. */
static void read_targets(const struct reader *reader, const struct gn_at *primitive,
                         struct gn_shape *shape) {
    struct gn_gltf *g = reader->g;
    struct gn_at targets = gn_at_array(g, primitive, "targets");
    const size_t count = gn_at_size(&targets);
    struct gn_mesh *mesh = &g->file.meshes[shape->mesh];
    if (count > GN_JOINTS_MAX)
        gn_gltf_fail(g, &targets, "%zu are more than %d morph targets", count, GN_JOINTS_MAX);
    else if (mesh->target_count > 0 && mesh->target_count != count)
        gn_gltf_fail(g, &targets, "%zu, but another primitive has %" PRIu32, count,
                     mesh->target_count);
    if (g->failed || count == 0) return;
    for (size_t i = 0; i < count; i++) {
        const char *name;
        json_t *accessor;
        json_object_foreach(json_array_get(targets.json, i), name, accessor) {
            if (strncmp(name, "TEXCOORD_", 9) == 0 || strncmp(name, "COLOR_", 6) == 0)
                g->is_missing[GN_MISSING_MORPHED_COLORS] = true;
        }
    }
    mesh->target_count = (uint32_t)count;
    shape->targets = (int32_t)reader->shape_count + 1;
}

/* Adds the primitive with that material; base: its mesh, number and targets. */
static bool add_primitive(struct reader *reader, const struct gn_at *primitive,
                          const struct gn_shape *base, int32_t material, uint64_t hidden_in) {
    struct gn_gltf *g = reader->g;
    struct gn_shape shape = *base;
    shape.tangents = gn_gltf_tangents(g, material); /* choose_tangents() leaves those to make */
    uint64_t uv_sets[GN_UV_SETS];
    gn_gltf_uv_sets(g, material, uv_sets);
    if (g->failed || !read_shape(g, primitive, uv_sets, &shape)) return false;
    choose_tangents(g, primitive, uv_sets, &shape);
    uint32_t *known = gn_table_find(&reader->shapes, shape.attribute); /* and what follows it */
    if (*known == 0) {
        /* only vertices with all in the file are shared: flat normals and tangents depend on the
         * triangles */
        if (shape.attribute[GN_ATTRIBUTE_NORMAL] >= 0 && shape.tangents == GN_TANGENTS_NONE) {
            uint32_t *set = gn_table_find(&reader->vertices, shape.attribute);
            if (*set == 0) {
                struct gn_vertices *vertices =
                    &g->primitives.vertices[g->primitives.vertices_count++];
                memcpy(vertices->attribute, shape.attribute, sizeof vertices->attribute);
                vertices->count =
                    (uint32_t)g->file.accessors[shape.attribute[GN_ATTRIBUTE_POSITION]].count;
                *set = (uint32_t)g->primitives.vertices_count;
            }
            shape.vertices = *set - 1;
        }
        g->primitives.shapes[reader->shape_count++] = shape;
        *known = reader->shape_count;
    }
    g->primitives.list[g->primitives.count++] =
        (struct gn_primitive){*known - 1, material, hidden_in};
    g->file.meshes[shape.mesh].primitive_count++;
    return true;
}

static void read_primitive(struct reader *reader, const struct gn_at *primitive, uint32_t mesh,
                           uint32_t index) {
    struct gn_gltf *g = reader->g;
    struct gn_shape shape = {.mesh = mesh, .primitive = index, .vertices = UINT32_MAX};
    struct gn_variant_material own[GN_VARIANTS_MAX + 1];
    const size_t count = gn_gltf_variant_materials(g, primitive, own);
    read_targets(reader, primitive, &shape);
    gn_gltf_spare(g, "shown without its morph targets");
    const uint64_t all = count > 1 ? UINT64_MAX >> (GN_VARIANTS_MAX - g->scene->variants.count) : 0;
    for (size_t i = 0; i < count; i++)
        if (!add_primitive(reader, primitive, &shape, own[i].material, all & ~own[i].in)) break;
    gn_gltf_spare(g, "not shown");
}

bool gn_gltf_meshes(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), meshes = gn_at_array(g, &root, "meshes");
    struct gn_at materials = gn_at_array(g, &root, "materials");
    struct reader reader = {.g = g};
    g->file.material_count = gn_at_size(&materials);
    size_t primitives = 0;
    for (size_t i = 0; i < g->file.mesh_count && !g->failed; i++) {
        struct gn_at mesh = gn_at_element(&meshes, i), list = gn_at_array(g, &mesh, "primitives");
        gn_gltf_spare(g, "not shown");
        for (size_t k = 0; g->file.meshes[i].used && k < gn_at_size(&list) && !g->failed; k++) {
            struct gn_at primitive = gn_at_item(g, &list, k);
            gn_gltf_spare(g, "not shown");
            primitives += gn_gltf_variant_most(g, &primitive);
        }
    }
    GN_NEW(g, &g->memory.load, g->primitives.list, primitives);
    GN_NEW(g, &g->memory.load, g->primitives.shapes, primitives);
    GN_NEW(g, &g->memory.load, g->primitives.vertices, primitives);
    if (g->failed) return false;
    reader.shapes = (struct gn_table){.stride = sizeof *g->primitives.shapes,
                                      .key_size = (GN_ATTRIBUTE_COUNT + 4) * sizeof(int32_t),
                                      .keys = (const char *)g->primitives.shapes};
    reader.vertices = (struct gn_table){.stride = sizeof *g->primitives.vertices,
                                        .key_size = GN_ATTRIBUTE_COUNT * sizeof(int32_t),
                                        .keys = (const char *)g->primitives.vertices};
    _Static_assert(offsetof(struct gn_shape, targets) == (GN_ATTRIBUTE_COUNT + 3) * sizeof(int32_t),
                   "key");
    if (!gn_table_init(g, &reader.shapes, primitives) ||
        !gn_table_init(g, &reader.vertices, primitives))
        return false;
    for (size_t i = 0; i < g->file.mesh_count && !g->failed; i++) {
        if (!g->file.meshes[i].used) continue;
        g->file.meshes[i].first_primitive = (uint32_t)g->primitives.count;
        struct gn_at mesh = gn_at_element(&meshes, i), list = gn_at_any(&mesh, "primitives");
        for (size_t k = 0; k < gn_at_size(&list) && !g->failed; k++) {
            struct gn_at primitive = gn_at_element(&list, k);
            if (json_is_object(primitive.json))
                read_primitive(&reader, &primitive, (uint32_t)i, (uint32_t)k);
        }
    }
    g->scene->geometry_count = reader.shape_count;
    return !g->failed;
}
