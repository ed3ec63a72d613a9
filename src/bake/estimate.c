/* What baking would save, from the headers of accessors alone. */
#include <string.h>

#include "bake/private.h"

/* Measured: FlightHelmet, the default scene, Suzanne, the teapot: .28 to .36 of what attributes of
 * floats take, 1.1 to 1.5 bytes a triangle. */
#define FLOATS_SHARE   .32
#define TRIANGLE_BYTES 1.3

struct estimator {
    struct gn_baker *b;
    bool *seen; /* by accessor */
    size_t count;
    struct gn_bake_estimate *out;
};

/* Bytes of an accessor of the file that is neither compressed nor counted yet, else 0. */
static double plain_bytes(struct estimator *e, int64_t accessor, bool *floats, double *elements) {
    if (accessor < 0 || (uint64_t)accessor >= e->count || e->seen[accessor]) return 0;
    e->seen[accessor] = true;
    const json_t *json = json_array_get(e->b->accessors, (size_t)accessor);
    const int64_t view = gn_bake_number(json, "bufferView");
    const json_t *from = view < 0 ? NULL : json_array_get(e->b->views, (size_t)view);
    const int64_t component = gn_bake_number(json, "componentType");
    const char *type = json_string_value(json_object_get(json, "type"));
    if (!from || gn_bake_extension(from, "EXT_meshopt_compression") ||
        gn_bake_extension(from, "KHR_meshopt_compression"))
        return 0;
    const bool vector = type && strncmp(type, "VEC", 3) == 0;
    *floats = component == GN_COMPONENT_F32;
    *elements = (double)gn_bake_number(json, "count");
    const int width = component <= GN_COMPONENT_U8 ? 1 : component <= GN_COMPONENT_U16 ? 2 : 4;
    return *elements < 0 ? 0 : *elements * width * (vector ? type[3] - '0' : 1);
}

static void add_attributes(struct estimator *e, const json_t *set) {
    const char *semantic;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)set, semantic, value) {
        bool floats = false;
        double elements = 0;
        const double bytes = plain_bytes(e, gn_bake_number(set, semantic), &floats, &elements);
        (void)value;
        e->out->bytes += bytes;
        e->out->bytes_baked += floats ? FLOATS_SHARE * bytes : bytes;
    }
}

static void add_primitive(struct estimator *e, const json_t *primitive) {
    const json_t *target;
    size_t i;
    bool floats = false;
    double corners = 0;
    const double bytes = plain_bytes(e, gn_bake_number(primitive, "indices"), &floats, &corners);
    e->out->bytes += bytes;
    e->out->bytes_baked += bytes > 0 ? TRIANGLE_BYTES * corners / 3 : 0;
    add_attributes(e, json_object_get(primitive, "attributes"));
    json_array_foreach(json_object_get(primitive, "targets"), i, target) add_attributes(e, target);
}

bool gn_bake_estimate(const struct gn_bake_opts *opts, const void *data, size_t size,
                      struct gn_bake_estimate *out) {
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    struct gn_baker b = {.opts = opts, .warnings = &warnings, .err = &err};
    *out = (struct gn_bake_estimate){0};
    b.in = gn_document_open(opts->path, data, size, opts->limits, &warnings, &err);
    if (!b.in) return false;
    const json_t *root = gn_document_json(b.in), *mesh, *primitive;
    struct estimator e = {.b = &b, .out = out};
    b.accessors = json_object_get(root, "accessors");
    b.views = json_object_get(root, "bufferViews");
    e.count = gn_document_accessor_count(b.in);
    e.seen = gn_arena_alloc(&b.whole, e.count, sizeof *e.seen);
    size_t i, k;
    if (e.seen)
        json_array_foreach(json_object_get(root, "meshes"), i, mesh)
            json_array_foreach(json_object_get(mesh, "primitives"), k, primitive)
                add_primitive(&e, primitive);
    gn_document_close(b.in);
    gn_arena_finish(&b.whole);
    return e.seen;
}
