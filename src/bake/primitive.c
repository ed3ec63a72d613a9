/* One primitive: reads its attributes, merges equal vertices, orders triangles and vertices, and
 * writes all of it anew. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bake/private.h"
#include "bake/reorder.h"

enum { SIMPLIFIED_TRIANGLES = 32 }; /* meshes with fewer stay as they are */
#define SIMPLIFY_ERROR .02f         /* of the size of the mesh, at most */

struct primitive {
    struct gn_baker *b;
    json_t *json;
    struct gn_stream *streams; /* attributes, then those of the targets */
    struct gn_stream_bytes *bytes;
    size_t stream_count;
    float *positions;
    uint32_t *corners, *remap;
    size_t corner_count, vertex_count;
    double uv_step; /* of a grid of texture coordinates; 0: they stay as they are */
};

bool gn_bake_has_triangles(const json_t *primitive) {
    const int64_t mode = gn_bake_number(primitive, "mode");
    return mode < 0 || (mode >= GN_MODE_TRIANGLES && mode <= GN_MODE_FAN);
}

/* ---- texture coordinates ---- */

/* Textures of up to 4096 texels are read to a 32nd of one. */
#define UV_STEP (1.0 / 65536)

/* The largest scale of KHR_texture_transform in a material. */
static double find_scale(const json_t *json) {
    const json_t *value, *number;
    const char *key;
    size_t i;
    double most = 1;
    json_array_foreach(json_object_get(gn_bake_extension(json, "KHR_texture_transform"), "scale"),
                       i, number) most = fmax(most, fabs(json_number_value(number)));
    json_object_foreach((json_t *)(uintptr_t)json, key, value) most = fmax(most, find_scale(value));
    return most;
}

/* Whether a clip changes such a scale. */
static bool moves_scale(const struct gn_baker *b) {
    const json_t *animation, *channel;
    size_t i, k;
    json_array_foreach(json_object_get(b->root, "animations"), i, animation)
        json_array_foreach(json_object_get(animation, "channels"), k, channel) {
        const char *pointer = json_string_value(json_object_get(
            gn_bake_extension(json_object_get(channel, "target"), "KHR_animation_pointer"),
            "pointer"));
        if (pointer && strstr(pointer, "KHR_texture_transform/scale")) return true;
    }
    return false;
}

/* A power of two that the materials of the primitive, in any variant, make no larger than UV_STEP.
 */
static double fit_uv_step(const struct primitive *p) {
    const json_t *materials = json_object_get(p->b->root, "materials"), *mapping,
                 *variants = gn_bake_extension(p->json, "KHR_materials_variants");
    const int64_t material = gn_bake_number(p->json, "material");
    double scale = material < 0 ? 1 : find_scale(json_array_get(materials, (size_t)material));
    size_t i;
    json_array_foreach(json_object_get(variants, "mappings"), i, mapping) {
        const int64_t other = gn_bake_number(mapping, "material");
        if (other >= 0) scale = fmax(scale, find_scale(json_array_get(materials, (size_t)other)));
    }
    return scale < 1e9 && !moves_scale(p->b) ? UV_STEP / exp2(ceil(log2(scale))) : 0;
}

/* ---- reading ---- */

static json_t *targets_of(const struct primitive *p) { return json_object_get(p->json, "targets"); }

static size_t count_streams(const struct primitive *p) {
    size_t count = json_object_size(json_object_get(p->json, "attributes")), i;
    const json_t *target;
    json_array_foreach(targets_of(p), i, target) count += json_object_size(target);
    return count;
}

static bool read_set(struct primitive *p, json_t *set, int target, const struct gn_grid *grid) {
    const bool alone = !json_object_get(set, "WEIGHTS_1");
    const char *semantic;
    json_t *value;
    json_object_foreach(set, semantic, value) {
        struct gn_stream *s = &p->streams[p->stream_count];
        const int64_t accessor = gn_bake_number(set, semantic);
        struct gn_elements e;
        if (accessor < 0)
            return gn_bake_fail(p->b, "attribute %.40s is no index of an accessor", semantic);
        if (!gn_document_accessor(p->b->in, (size_t)accessor, &e)) return !(p->b->failed = true);
        if (e.count != p->vertex_count)
            return gn_bake_fail(p->b, "accessors[%lld] (%.40s): %zu elements, but POSITION has %zu",
                                (long long)accessor, semantic, e.count, p->vertex_count);
        *s = (struct gn_stream){.accessor = (size_t)accessor,
                                .target = target,
                                .semantic = semantic,
                                .uv_step = p->uv_step};
        if (!gn_stream_read(p->b, grid, alone, s)) return false;
        p->bytes[p->stream_count++] = (struct gn_stream_bytes){s->data, s->stride};
    }
    return true;
}

static bool read_streams(struct primitive *p, size_t position, const struct gn_grid *grid) {
    const size_t most = count_streams(p);
    p->streams = gn_bake_alloc(p->b, most, sizeof *p->streams);
    p->bytes = gn_bake_alloc(p->b, most, sizeof *p->bytes);
    p->positions = gn_bake_alloc(p->b, p->vertex_count, 3 * sizeof *p->positions);
    p->remap = gn_bake_alloc(p->b, p->vertex_count, 2 * sizeof *p->remap);
    if (p->b->failed) return false;
    gn_document_floats(p->b->in, position, 3, p->positions);
    if (!read_set(p, json_object_get(p->json, "attributes"), -1, grid)) return false;
    json_t *target;
    size_t i;
    json_array_foreach(targets_of(p), i,
                       target) if (!read_set(p, target, (int)i, grid)) return false;
    return true;
}

/* Triangles with two equal corners show nothing. */
static size_t drop_flat(uint32_t *corners, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i + 2 < count; i += 3) {
        const uint32_t *v = corners + i;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        memmove(corners + kept, v, 3 * sizeof *v);
        kept += 3;
    }
    return kept;
}

static bool read_corners(struct primitive *p, int64_t mode) {
    struct gn_baker *b = p->b;
    const int64_t index = gn_bake_number(p->json, "indices");
    struct gn_elements e = {.count = p->vertex_count};
    if (index >= 0 && !gn_document_accessor(b->in, (size_t)index, &e)) return !(b->failed = true);
    uint32_t *raw = gn_bake_alloc(b, e.count, sizeof *raw);
    const size_t triangles = mode == GN_MODE_TRIANGLES ? e.count / 3
                             : e.count > 2             ? e.count - 2
                                                       : 0;
    p->corners = gn_bake_alloc(b, triangles, 3 * sizeof *p->corners);
    if (b->failed) return false;
    for (size_t i = 0; i < e.count; i++) raw[i] = (uint32_t)i;
    if (index >= 0 && !gn_document_indices(b->in, (size_t)index, raw)) return !(b->failed = true);
    for (size_t i = 0; i < e.count; i++)
        if (raw[i] >= p->vertex_count)
            return gn_bake_fail(b, "accessors[%lld]: element %zu is vertex %u, but there are %zu",
                                (long long)index, i, raw[i], p->vertex_count);
    for (size_t t = 0; t < triangles; t++) gn_triangle_of(mode, raw, t, p->corners + 3 * t);
    b->report->triangles_before += triangles;
    p->corner_count = drop_flat(p->corners, 3 * triangles);
    return true;
}

/* ---- ordering ---- */

static void move_vertices(struct primitive *p, size_t count) {
    for (size_t i = 0; i < p->stream_count; i++)
        gn_reorder->vertices(&p->bytes[i], p->vertex_count, p->remap);
    const struct gn_stream_bytes positions = {(uint8_t *)p->positions, 3 * sizeof(float)};
    gn_reorder->vertices(&positions, p->vertex_count, p->remap);
    gn_reorder->corners(p->corners, p->corner_count, p->remap);
    p->vertex_count = count;
}

/* Blending shows the triangles of a material in their order. */
static bool is_blended(const struct gn_baker *b, int64_t material) {
    const json_t *list = json_object_get(b->root, "materials");
    const json_t *json = material < 0 ? NULL : json_array_get(list, (size_t)material);
    const char *mode = json_string_value(json_object_get(json, "alphaMode"));
    return mode && strcmp(mode, "BLEND") == 0;
}

static bool keeps_order(const struct primitive *p) {
    const json_t *variants = gn_bake_extension(p->json, "KHR_materials_variants"), *mapping;
    bool blends = is_blended(p->b, gn_bake_number(p->json, "material"));
    size_t i;
    json_array_foreach(json_object_get(variants, "mappings"), i, mapping) blends |=
        is_blended(p->b, gn_bake_number(mapping, "material"));
    return blends;
}

static void simplify(struct primitive *p, bool locks_border) {
    const double share = p->b->opts->share;
    const size_t triangles = p->corner_count / 3;
    if (share >= 1 || triangles < SIMPLIFIED_TRIANGLES) return;
    float error = 0;
    p->corner_count = gn_reorder->simplify(p->corners, p->corner_count, p->positions,
                                           p->vertex_count, 3 * (size_t)((double)triangles * share),
                                           SIMPLIFY_ERROR, locks_border, &error);
    if ((double)error > p->b->report->error) p->b->report->error = (double)error;
}

static void reorder(struct primitive *p, bool locks_border) {
    uint32_t *work = p->remap + p->vertex_count;
    const size_t merged = gn_reorder->merge(p->bytes, p->stream_count, p->corners, p->corner_count,
                                            p->vertex_count, p->remap, work);
    move_vertices(p, merged);
    p->corner_count = drop_flat(p->corners, p->corner_count);
    simplify(p, locks_border);
    if (!keeps_order(p))
        gn_reorder->triangles(p->corners, p->corner_count, p->positions, p->vertex_count);
    const size_t used = gn_reorder->fetch(p->remap, p->corners, p->corner_count, p->vertex_count);
    move_vertices(p, used);
}

/* ---- writing ---- */

/* {"attributes": .., "indices": .., "targets": ..} */
static json_t *write_primitive(struct primitive *p) {
    json_t *out = json_object(), *attributes = json_object(), *targets = json_array();
    for (size_t i = 0; i < json_array_size(targets_of(p)); i++)
        json_array_append_new(targets, json_object());
    for (size_t i = 0; i < p->stream_count; i++) {
        const struct gn_stream *s = &p->streams[i];
        json_t *set = s->target < 0 ? attributes : json_array_get(targets, (size_t)s->target);
        json_object_set_new(set, s->semantic,
                            json_integer((json_int_t)gn_stream_write(p->b, s, p->vertex_count)));
    }
    const bool wide = p->vertex_count > 65535; /* 65535 restarts strips */
    const struct gn_block block = {GN_BLOCK_TRIANGLES, p->corners, p->corner_count, wide ? 4 : 2};
    json_t *indices = json_pack(
        "{s:I,s:i,s:I,s:s}", "bufferView", (json_int_t)gn_bake_view(p->b, &block), "componentType",
        wide ? 5125 : GN_COMPONENT_U16, "count", (json_int_t)p->corner_count, "type", "SCALAR");
    json_object_set_new(out, "indices",
                        json_integer((json_int_t)gn_bake_add(p->b, "accessors", indices)));
    json_object_set_new(out, "attributes", attributes);
    if (targets_of(p))
        json_object_set_new(out, "targets", targets);
    else
        json_decref(targets);
    return out;
}

/* What the primitive reads, and how it is written, as a text; to be freed. */
static char *name_source(const struct primitive *p, const struct gn_grid *grid, bool locks_border) {
    json_t *source = json_pack(
        "{s:O*,s:O*,s:O*,s:O*,s:[iiiffIII]}", "attributes", json_object_get(p->json, "attributes"),
        "indices", json_object_get(p->json, "indices"), "targets", targets_of(p), "mode",
        json_object_get(p->json, "mode"), "grid", (int)grid->kind, (int)keeps_order(p),
        (int)locks_border, p->uv_step, grid->step, (json_int_t)grid->origin[0],
        (json_int_t)grid->origin[1], (json_int_t)grid->origin[2]);
    char *text = source ? json_dumps(source, JSON_SORT_KEYS | JSON_COMPACT) : NULL;
    json_decref(source);
    return text;
}

static json_t *bake_shape(struct primitive *p, const struct gn_grid *grid, int64_t mode,
                          size_t position, bool locks_border) {
    if (!read_streams(p, position, grid) || !read_corners(p, mode)) return NULL;
    p->b->report->vertices_before += p->vertex_count;
    if (p->corner_count == 0) return NULL;
    reorder(p, locks_border);
    if (p->corner_count == 0) return NULL;
    p->b->report->vertices_after += p->vertex_count;
    p->b->report->triangles_after += p->corner_count / 3;
    return write_primitive(p);
}

bool gn_bake_primitive(struct gn_baker *b, json_t *json, const struct gn_grid *grid,
                       bool locks_border, bool *baked) {
    struct primitive p = {.b = b, .json = json};
    const int64_t number = gn_bake_number(json, "mode"),
                  mode = number < 0 ? GN_MODE_TRIANGLES : number;
    const int64_t position = gn_bake_number(json_object_get(json, "attributes"), "POSITION");
    struct gn_elements e;
    *baked = false;
    if (!gn_bake_has_triangles(json) || position < 0) return true;
    if (!gn_document_accessor(b->in, (size_t)position, &e)) return !(b->failed = true);
    if (e.components != 3 || e.count > UINT32_MAX) return true;
    p.vertex_count = e.count;
    p.uv_step = fit_uv_step(&p);
    char *source = name_source(&p, grid, locks_border);
    if (!source) return gn_bake_fail(b, "out of memory");
    json_t *shape = json_incref(json_object_get(b->known, source));
    if (!shape) shape = bake_shape(&p, grid, mode, (size_t)position, locks_border);
    if (shape) {
        json_object_set(b->known, source, shape);
        json_t *copy = json_deep_copy(shape);
        json_object_update(json, copy);
        json_object_del(json, "mode");
        json_object_del(json_object_get(json, "extensions"), "KHR_draco_mesh_compression");
        json_decref(copy);
        json_decref(shape);
        *baked = true;
    }
    free(source);
    gn_arena_reset(&b->step);
    return !b->failed;
}
