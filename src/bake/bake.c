/* The steps, in order. */
#include "bake/bake.h"

#include <math.h>
#include <stdlib.h>

#include "bake/private.h"
#include "bake/reorder.h"
#include "core/encoding.h"

bool gn_bake_is_built(void) { return gn_reorder; }

/* A copy in which whole numbers are integers again: a document has only reals. */
static json_t *copy_json(const json_t *json) {
    json_t *copy, *value;
    const char *key;
    size_t i;
    switch (json_typeof(json)) {
    case JSON_OBJECT:
        copy = json_object();
        json_object_foreach((json_t *)(uintptr_t)json, key, value)
            json_object_set_new(copy, key, copy_json(value));
        return copy;
    case JSON_ARRAY:
        copy = json_array();
        json_array_foreach(json, i, value) json_array_append_new(copy, copy_json(value));
        return copy;
    case JSON_REAL: {
        const double number = json_real_value(json);
        const bool whole = fabs(number) < 9e15 && number == rint(number);
        return whole && !(number == 0 && signbit(number)) ? json_integer((json_int_t)number)
                                                          : json_real(number);
    }
    default: return json_deep_copy(json);
    }
}

/* The root without data; what was there of it. */
static json_t *take_list(struct gn_baker *b, const char *key) {
    json_t *list = json_incref(json_object_get(b->root, key));
    json_object_del(b->root, key);
    return list;
}

/* Of buffers in files of their own. */
static uint64_t count_buffer_bytes(const struct gn_baker *b) {
    const json_t *buffer;
    uint64_t bytes = 0;
    size_t i;
    json_array_foreach(json_object_get(b->root, "buffers"), i, buffer) {
        const char *uri = json_string_value(json_object_get(buffer, "uri"));
        const int64_t size = gn_bake_number(buffer, "byteLength");
        if (uri && !gn_data_uri_is(uri) && size > 0) bytes += (uint64_t)size;
    }
    return bytes;
}

static bool take_json(struct gn_baker *b) {
    b->root = copy_json(gn_document_json(b->in));
    b->known = json_object();
    if (!b->root || !b->known) return gn_bake_fail(b, "out of memory");
    b->accessors = take_list(b, "accessors");
    b->views = take_list(b, "bufferViews");
    b->report->other_bytes = count_buffer_bytes(b);
    json_object_del(b->root, "buffers");
    gn_bake_forget_extension(b, "EXT_meshopt_compression");
    gn_bake_forget_extension(b, "KHR_meshopt_compression");
    gn_bake_forget_extension(b, "KHR_draco_mesh_compression");
    return true;
}

bool gn_bake(const struct gn_bake_opts *opts, const void *data, size_t size, struct gn_bytes *out,
             struct gn_bake_report *report, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_baker b = {.opts = opts, .report = report, .warnings = warnings, .err = err};
    *report = (struct gn_bake_report){0};
    *out = (struct gn_bytes){0};
    if (!gn_bake_is_built())
        return gn_fail(err, "bake needs libmeshoptimizer, which this build does not have");
    b.in = gn_document_open(opts->path, data, size, opts->limits, warnings, err);
    if (!b.in) return false;
    const bool done = take_json(&b) && gn_bake_keep_all(&b) && gn_bake_meshes(&b) &&
                      gn_bake_nodes(&b) && gn_bake_keep_used(&b) && gn_bake_images(&b) &&
                      gn_bake_write(&b, out);
    json_decref(b.root);
    json_decref(b.known);
    json_decref(b.accessors);
    json_decref(b.views);
    gn_document_close(b.in);
    gn_arena_finish(&b.whole);
    gn_arena_finish(&b.step);
    free(b.bin);
    return done;
}
