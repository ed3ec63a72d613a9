/* Attributes of vertices, from what a file has to what is written. */
#include <math.h>
#include <string.h>

#include "bake/private.h"

#define DIRECTION_STEP (1.0 / 1024) /* of targets: .05 degrees */

static bool starts_with(const char *text, const char *start) {
    return strncmp(text, start, strlen(start)) == 0;
}

static size_t component_bytes(int component) {
    return component < GN_COMPONENT_U8 + 1 ? 1 : component < GN_COMPONENT_U16 + 1 ? 2 : 4;
}

/* Data of the stream for elements of so many components, at a stride that is a multiple of 4. */
static bool make_data(struct gn_baker *b, struct gn_stream *s, size_t count, int component,
                      size_t components) {
    s->component = component;
    s->stride = (components * component_bytes(component) + 3) / 4 * 4;
    s->data = gn_bake_alloc(b, count, s->stride);
    return s->data;
}

/* ---- as it is ---- */

static bool copy_elements(struct gn_baker *b, const struct gn_elements *e, struct gn_stream *s) {
    s->component = e->component;
    s->normalized = e->normalized;
    s->stride = (e->element + 3) / 4 * 4;
    s->data = gn_bake_alloc(b, e->count, s->stride);
    for (size_t i = 0; s->data && i < e->count; i++)
        memcpy(s->data + i * s->stride, e->data + i * e->stride, e->element);
    return s->data;
}

/* ---- positions ---- */

static bool put_positions(struct gn_baker *b, const struct gn_grid *grid, const float *values,
                          size_t count, struct gn_stream *s) {
    const bool shorts = grid->kind == GN_GRID_SHORTS;
    if (!make_data(b, s, count, shorts ? GN_COMPONENT_U16 : GN_COMPONENT_F32, 3)) return false;
    s->is_quantized = shorts;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++) {
            const int64_t steps = llrint((double)values[3 * i + k] / grid->step);
            uint8_t *at = s->data + i * s->stride + k * component_bytes(s->component);
            if (shorts)
                memcpy(at, &(uint16_t){(uint16_t)(steps - grid->origin[k])}, 2);
            else
                memcpy(at, &(float){(float)((double)steps * grid->step)}, 4);
        }
    return true;
}

/* ---- floats on a grid, bytes, shorts ---- */

static bool put_rounded(struct gn_baker *b, const float *values, size_t count, size_t components,
                        double step, struct gn_stream *s) {
    if (!make_data(b, s, count, GN_COMPONENT_F32, components)) return false;
    float *out = (float *)(void *)s->data;
    for (size_t i = 0; i < count * components; i++) {
        const double steps = rint((double)values[i] / step);
        out[i] = isfinite(steps) ? (float)(steps * step + 0.0) : values[i];
    }
    return true;
}

static bool put_unorm(struct gn_baker *b, const float *values, size_t count, size_t components,
                      int component, struct gn_stream *s) {
    if (!make_data(b, s, count, component, components)) return false;
    s->normalized = true;
    const double most = component == GN_COMPONENT_U8 ? 255 : 65535;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < components; k++) {
            const uint16_t value = (uint16_t)lrint((double)values[i * components + k] * most);
            uint8_t *at = s->data + i * s->stride;
            if (component == GN_COMPONENT_U8)
                at[k] = (uint8_t)value;
            else
                memcpy(at + 2 * k, &value, 2);
        }
    return true;
}

/* Directions as signed bytes, the first three components of length 1. */
static bool put_directions(struct gn_baker *b, const float *values, size_t count, size_t components,
                           struct gn_stream *s) {
    enum { I8 = 5120, MOST = 127 };
    if (!make_data(b, s, count, I8, components)) return false;
    s->normalized = s->is_quantized = true;
    for (size_t i = 0; i < count; i++) {
        const float *v = values + i * components;
        const double length = sqrt((double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] +
                                   (double)v[2] * (double)v[2]);
        for (size_t k = 0; k < components; k++) {
            double part = (double)v[k];
            if (k < 3) part = length > 1e-12 && length < 1e18 ? part / length : 0;
            part = part < -1 ? -1 : part > 1 ? 1 : part;
            s->data[i * s->stride + k] = (uint8_t)(int8_t)lrint(part * MOST);
        }
    }
    return true;
}

/* Weights that are 1 together, as the numbers that are written are. */
static bool put_weights(struct gn_baker *b, float *values, size_t count, struct gn_stream *s) {
    for (size_t i = 0; i < count; i++) {
        float *w = values + 4 * i;
        const float sum = w[0] + w[1] + w[2] + w[3];
        for (int k = 0; k < 4 && sum > 0; k++) w[k] /= sum;
    }
    if (!put_unorm(b, values, count, 4, GN_COMPONENT_U16, s)) return false;
    for (size_t i = 0; i < count; i++) {
        uint16_t w[4];
        int sum = 0, largest = 0;
        memcpy(w, s->data + i * s->stride, sizeof w);
        for (int k = 0; k < 4; k++) {
            sum += w[k];
            if (w[k] > w[largest]) largest = k;
        }
        if (sum > 0) w[largest] = (uint16_t)(w[largest] + 65535 - sum);
        memcpy(s->data + i * s->stride, w, sizeof w);
    }
    return true;
}

/* Numbers of joints, as bytes where none is larger. */
static bool put_joints(struct gn_baker *b, const struct gn_elements *e, struct gn_stream *s) {
    bool small = e->component == GN_COMPONENT_U16;
    for (size_t i = 0; small && i < e->count; i++) {
        uint16_t joints[4];
        memcpy(joints, e->data + i * e->stride, sizeof joints);
        for (int k = 0; k < 4; k++) small &= joints[k] < 256;
    }
    if (!small) return copy_elements(b, e, s);
    if (!make_data(b, s, e->count, GN_COMPONENT_U8, 4)) return false;
    for (size_t i = 0; i < e->count; i++) {
        uint16_t joints[4];
        memcpy(joints, e->data + i * e->stride, sizeof joints);
        for (int k = 0; k < 4; k++) s->data[i * s->stride + (size_t)k] = (uint8_t)joints[k];
    }
    return true;
}

/* ---- which is which ---- */

static bool lies_in_0_1(const float *values, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!(values[i] >= 0 && values[i] <= 1)) return false;
    return true;
}

/* Of floats, values: count x components. */
static bool put_floats(struct gn_baker *b, const struct gn_grid *grid, bool alone, float *values,
                       const struct gn_elements *e, struct gn_stream *s) {
    const size_t n = (size_t)e->components;
    const bool unorm = lies_in_0_1(values, e->count * n), is_base = s->target < 0;
    const bool directs = strcmp(s->semantic, "NORMAL") == 0 || strcmp(s->semantic, "TANGENT") == 0;
    if (strcmp(s->semantic, "POSITION") == 0 && n == 3 && grid->kind != GN_GRID_NONE)
        return is_base ? put_positions(b, grid, values, e->count, s)
                       : put_rounded(b, values, e->count, n, grid->step, s);
    if (directs && n >= 3)
        return is_base ? put_directions(b, values, e->count, n, s)
                       : put_rounded(b, values, e->count, n, DIRECTION_STEP, s);
    if (starts_with(s->semantic, "TEXCOORD_") && n == 2 && s->uv_step > 0)
        return unorm && is_base && s->uv_step * 65536 >= 1
                   ? put_unorm(b, values, e->count, n, GN_COMPONENT_U16, s)
                   : put_rounded(b, values, e->count, n, s->uv_step, s);
    if (starts_with(s->semantic, "COLOR_") && unorm && is_base)
        return put_unorm(b, values, e->count, n, GN_COMPONENT_U8, s);
    if (starts_with(s->semantic, "WEIGHTS_") && unorm && alone && n == 4)
        return put_weights(b, values, e->count, s);
    return copy_elements(b, e, s);
}

bool gn_stream_read(struct gn_baker *b, const struct gn_grid *grid, bool alone,
                    struct gn_stream *s) {
    struct gn_elements e;
    if (!gn_document_accessor(b->in, s->accessor, &e)) return !(b->failed = true);
    s->has_bounds = strcmp(s->semantic, "POSITION") == 0;
    if (starts_with(s->semantic, "JOINTS_") && e.components == 4) return put_joints(b, &e, s);
    if (e.component != GN_COMPONENT_F32) return copy_elements(b, &e, s);
    float *values = gn_bake_alloc(b, e.count, (size_t)e.components * sizeof *values);
    if (!values) return false;
    gn_document_floats(b->in, s->accessor, (size_t)e.components, values);
    return put_floats(b, grid, alone, values, &e, s);
}

/* ---- writing ---- */

static double component_at(const uint8_t *at, int component) {
    float f = 0;
    uint16_t u = 0;
    memcpy(&f, at, component_bytes(component) == 4 ? 4 : 0);
    memcpy(&u, at, component_bytes(component) == 2 ? 2 : 0);
    switch (component) {
    case 5120: return (double)(int8_t)*at;
    case GN_COMPONENT_U8: return (double)*at;
    case 5122: return (double)(int16_t)u;
    case GN_COMPONENT_U16: return (double)u;
    default: return (double)f;
    }
}

static void set_bounds(const struct gn_stream *s, size_t count, json_t *accessor) {
    json_t *least = json_array(), *most = json_array();
    for (size_t k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            const double value = component_at(
                s->data + i * s->stride + k * component_bytes(s->component), s->component);
            low = fmin(low, value);
            high = fmax(high, value);
        }
        const bool whole = s->component != GN_COMPONENT_F32;
        json_array_append_new(least, whole ? json_integer((json_int_t)low) : json_real(low));
        json_array_append_new(most, whole ? json_integer((json_int_t)high) : json_real(high));
    }
    json_object_set_new(accessor, "min", least);
    json_object_set_new(accessor, "max", most);
}

size_t gn_stream_write(struct gn_baker *b, const struct gn_stream *s, size_t count) {
    const struct gn_block block = {GN_BLOCK_VERTICES, s->data, count, s->stride};
    json_t *accessor = gn_bake_accessor_json(b, s->accessor);
    json_object_set_new(accessor, "bufferView", json_integer((json_int_t)gn_bake_view(b, &block)));
    json_object_set_new(accessor, "count", json_integer((json_int_t)count));
    json_object_set_new(accessor, "componentType", json_integer(s->component));
    json_object_del(accessor, "normalized");
    if (s->normalized) json_object_set_new(accessor, "normalized", json_true());
    if (s->has_bounds) set_bounds(s, count, accessor);
    b->quantized |= s->is_quantized;
    return gn_bake_add(b, "accessors", accessor);
}
