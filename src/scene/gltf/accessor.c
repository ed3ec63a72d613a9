/* Accessors: gn_gltf_accessor() checks each one at its first use against the data behind it; after
 * that it can be read without further checks. */
#include "scene/private.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const uint8_t ZEROS[64]; /* one element of an accessor without data */

static size_t component_size(enum gn_component component) {
    switch (component) {
    case GN_I8:
    case GN_U8: return 1;
    case GN_I16:
    case GN_U16: return 2;
    default: return 4;
    }
}

static const struct shape {
    const char *name;
    uint8_t components, columns;
} SHAPES[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
              {"MAT2", 4, 2},   {"MAT3", 9, 3}, {"MAT4", 16, 4}};

static bool read_component(struct gn_gltf *g, const struct gn_at *up, enum gn_component *out) {
    uint64_t value = gn_at_uint(g, up, "componentType", 0);
    struct gn_at at = gn_at_any(up, "componentType");
    if (g->failed) return false;
    if (value < GN_I8 || value > GN_F32 || value == 5124)
        return gn_gltf_fail(g, &at, "%" PRIu64 " is none of 5120-5123, 5125, 5126", value);
    *out = (enum gn_component)value;
    return true;
}

/* The part of a bufferView that an accessor, or an array of its sparse part, reads. */
struct span {
    int32_t view;
    uint64_t offset, count;
    size_t element, stride; /* stride 0: tight */
};

/* Checks that all elements lie inside the view. */
static const uint8_t *span_data(struct gn_gltf *g, const struct gn_at *at, struct span *span) {
    const struct gn_buffer_view *view = &g->file.views[span->view];
    if (span->stride == 0) span->stride = span->element;
    uint64_t end = 0;
    bool fits = !__builtin_mul_overflow(span->count - 1, span->stride, &end) &&
                !__builtin_add_overflow(end, span->element, &end) &&
                !__builtin_add_overflow(end, span->offset, &end);
    if (!view->data)
        gn_gltf_fail(g, at,
                     "bufferView %d, of buffer %d, holds no data; if the file is compressed, "
                     "decompress it first (gltf-transform can)",
                     span->view, view->buffer);
    else if (span->stride < span->element)
        gn_gltf_fail(g, at, "byteStride %zu of bufferView %d is less than an element of %zu bytes",
                     span->stride, span->view, span->element);
    else if (!fits || end > view->size)
        gn_gltf_fail(g, at,
                     "%" PRIu64 " elements from byte %" PRIu64
                     " pass the end of bufferView %d (%zu bytes)",
                     span->count, span->offset, span->view, view->size);
    return g->failed ? NULL : view->data + span->offset;
}

/* ---- sparse ---- */

/* Makes a dense copy of the elements and overwrites those that index names. */
static bool set_sparse_values(struct gn_gltf *g, const struct gn_at *at,
                              const struct gn_accessor *index, const uint8_t *values,
                              struct gn_accessor *a, size_t element) {
    uint8_t *copy = gn_gltf_alloc(g, &g->memory.load, a->count, element);
    if (!copy) return false;
    for (size_t i = 0; a->stride > 0 && i < a->count; i++)
        memcpy(copy + i * element, a->data + i * a->stride, element);
    a->data = copy;
    a->stride = element;
    uint32_t *at_index = gn_gltf_alloc(g, &g->memory.load, index->count, sizeof *at_index);
    if (!at_index) return false;
    gn_accessor_indices(index, at_index);
    for (size_t i = 0; i < index->count; i++) {
        if (at_index[i] >= a->count)
            return gn_gltf_fail(g, at, "element %zu: index %" PRIu32 ", but there are %zu elements",
                                i, at_index[i], a->count);
        memcpy(copy + at_index[i] * element, values + i * element, element);
    }
    return true;
}

static bool apply_sparse(struct gn_gltf *g, const struct gn_at *sparse, struct gn_accessor *a,
                         size_t element) {
    uint64_t count = gn_at_uint(g, sparse, "count", 0);
    if (g->failed || count == 0) return !g->failed;
    struct gn_at at = gn_at_any(sparse, "count");
    if (count > a->count)
        return gn_gltf_fail(g, &at, "%" PRIu64 " is more than the accessor's %zu", count, a->count);
    struct gn_at indices = gn_at_object(g, sparse, "indices"),
                 values = gn_at_object(g, sparse, "values");
    struct gn_accessor index = {.count = (size_t)count, .components = 1, .backed = true};
    if (!read_component(g, &indices, &index.component)) return false;
    index.stride = component_size(index.component);
    struct span index_span = {
        .view = gn_at_ref(g, &indices, "bufferView", g->file.view_count, "bufferViews"),
        .offset = gn_at_uint(g, &indices, "byteOffset", 0),
        .count = count,
        .element = index.stride};
    struct span value_span = {
        .view = gn_at_ref(g, &values, "bufferView", g->file.view_count, "bufferViews"),
        .offset = gn_at_uint(g, &values, "byteOffset", 0),
        .count = count,
        .element = element};
    if (g->failed || index_span.view < 0 || value_span.view < 0)
        return gn_gltf_fail(g, sparse, "indices.bufferView and values.bufferView are needed");
    if (index.component != GN_U8 && index.component != GN_U16 && index.component != GN_U32)
        return gn_gltf_fail(g, &indices, "componentType must be an unsigned integer");
    index.data = span_data(g, &indices, &index_span);
    const uint8_t *data = index.data ? span_data(g, &values, &value_span) : NULL;
    a->backed = true;
    return data && set_sparse_values(g, &indices, &index, data, a, element);
}

/* ---- whole accessors ---- */

/* The columns of a matrix start at multiples of four bytes. */
size_t gn_accessor_element_size(const struct gn_accessor *a) {
    size_t column = (size_t)a->components / a->columns * component_size(a->component);
    if (a->columns > 1) column = (column + 3) / 4 * 4;
    return column * a->columns;
}

static bool resolve_accessor(struct gn_gltf *g, const struct gn_at *at, struct gn_accessor *a) {
    const struct shape *shape = NULL;
    const char *name = gn_at_text(g, at, "type");
    for (size_t i = 0; name && i < sizeof SHAPES / sizeof SHAPES[0]; i++)
        if (strcmp(SHAPES[i].name, name) == 0) shape = &SHAPES[i];
    struct gn_at type = gn_at_any(at, "type"), count = gn_at_any(at, "count");
    if (!shape)
        return gn_gltf_fail(g, &type, "'%.20s' is none of SCALAR, VEC2-4, MAT2-4",
                            name ? name : "");
    if (!read_component(g, at, &a->component)) return false;
    a->components = shape->components;
    a->columns = shape->columns;
    struct span span = {.view = gn_at_ref(g, at, "bufferView", g->file.view_count, "bufferViews"),
                        .offset = gn_at_uint(g, at, "byteOffset", 0),
                        .count = gn_at_uint(g, at, "count", 0),
                        .element = gn_accessor_element_size(a)};
    a->normalized = gn_at_flag(g, at, "normalized", false);
    a->backed = span.view >= 0;
    if (g->failed) return false;
    if (span.count == 0) return gn_gltf_fail(g, &count, "must be at least 1");
    if (!a->backed && span.count > g->limits.vertices)
        return gn_gltf_fail(g, &count, "%" PRIu64 " is more than the limit vertices=%" PRIu64,
                            span.count, g->limits.vertices);
    if (a->backed) span.stride = g->file.views[span.view].stride;
    a->data = a->backed ? span_data(g, at, &span) : ZEROS;
    a->stride = span.stride;
    a->count = (size_t)span.count;
    if (g->failed) return false;
    struct gn_at sparse = gn_at_object(g, at, "sparse");
    if (sparse.json) apply_sparse(g, &sparse, a, span.element);
    return !g->failed;
}

const struct gn_accessor *gn_gltf_accessor(struct gn_gltf *g, int32_t index) {
    if (index < 0 || g->failed) return NULL;
    struct gn_accessor *a = &g->file.accessors[index];
    if (a->resolved) return a;
    struct gn_at root = gn_at_root(g), array = gn_at_array(g, &root, "accessors");
    struct gn_at at = gn_at_item(g, &array, (size_t)index);
    a->resolved = !g->failed && resolve_accessor(g, &at, a);
    return a->resolved ? a : NULL;
}

bool gn_gltf_list_accessors(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), array = gn_at_array(g, &root, "accessors");
    g->file.accessor_count = gn_at_size(&array);
    GN_NEW(g, &g->memory.load, g->file.accessors, g->file.accessor_count);
    GN_NEW(g, &g->memory.load, g->file.key_times, g->file.accessor_count);
    return !g->failed;
}

/* ---- reading ---- */

static float component_float(const uint8_t *p, enum gn_component component, bool normalized) {
    int16_t i16;
    uint16_t u16;
    uint32_t u32;
    float f32;
    switch (component) {
    case GN_I8: return normalized ? fmaxf((float)(int8_t)*p / 127.0f, -1) : (float)(int8_t)*p;
    case GN_U8: return normalized ? (float)*p / 255.0f : (float)*p;
    case GN_I16:
        memcpy(&i16, p, sizeof i16);
        return normalized ? fmaxf((float)i16 / 32767.0f, -1) : (float)i16;
    case GN_U16:
        memcpy(&u16, p, sizeof u16);
        return normalized ? (float)u16 / 65535.0f : (float)u16;
    case GN_U32:
        memcpy(&u32, p, sizeof u32);
        return normalized ? (float)((double)u32 / 4294967295.0) : (float)u32;
    default: memcpy(&f32, p, sizeof f32); return f32;
    }
}

/* n components of an element as floats; those past it stay as they are. */
static void read_element(const struct gn_accessor *a, size_t index, size_t n, float *out) {
    const uint8_t *element = a->data + index * a->stride;
    const size_t size = component_size(a->component);
    if (a->component == GN_F32)
        memcpy(out, element, n * sizeof *out);
    else
        for (size_t k = 0; k < n; k++)
            out[k] = component_float(element + k * size, a->component, a->normalized);
}

void gn_accessor_floats(const struct gn_accessor *a, size_t components, float *out) {
    gn_accessor_gather(a, components, NULL, a->count, out);
}

void gn_accessor_gather(const struct gn_accessor *a, size_t components, const uint32_t *source,
                        size_t count, float *out) {
    const size_t n = a->components < components ? a->components : components;
    for (size_t i = 0; i < count; i++)
        read_element(a, source ? source[i] : i, n, out + i * components);
}

void gn_accessor_indices(const struct gn_accessor *a, uint32_t *out) {
    for (size_t i = 0; i < a->count; i++) {
        const uint8_t *element = a->data + i * a->stride;
        uint16_t u16;
        switch (a->component) {
        case GN_U8: out[i] = *element; break;
        case GN_U16:
            memcpy(&u16, element, sizeof u16);
            out[i] = u16;
            break;
        default: memcpy(&out[i], element, sizeof out[i]); break;
        }
    }
}
