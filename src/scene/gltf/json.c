#include "scene/private.h"

#include <assert.h>
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/gltf/json_text.h"

/* ---- parsing ---- */

/* The parser recurses and allocates as the text demands: bound both before it starts. A
 * container or a key costs jansson about 256 bytes, any other value about 96; the text is copied
 * once by gn_json_text_replace() and once, as strings, by jansson. */
static bool check_json_size(struct gn_gltf *g, const char *text, size_t size, size_t offset) {
    uint64_t depth = 0, bytes = 2 * (uint64_t)size;
    bool quoted = false;
    for (size_t i = 0; i < size; i++) {
        char c = text[i];
        if (quoted && c == '\\')
            i++;
        else if (c == '"')
            quoted = !quoted;
        else if (quoted)
            continue;
        else if (c == ',')
            bytes += 96;
        else if (c == ':')
            bytes += 256;
        else if ((c == ']' || c == '}') && depth > 0)
            depth--;
        else if (c == '[' || c == '{') {
            bytes += 256;
            if (++depth > g->limits.json_depth)
                return gn_gltf_fail(g, NULL,
                                    "byte %zu: JSON nested deeper than json_depth=%" PRIu64,
                                    offset + i, g->limits.json_depth);
        }
    }
    if (bytes > gn_gltf_room(g))
        return gn_gltf_fail(g, NULL, "byte %zu: JSON too large for memory_mb=%" PRIu64, offset,
                            g->limits.memory_mb);
    g->memory.other_bytes += (size_t)bytes;
    return true;
}

/* What jansson refuses is replaced only in a text that it has refused: few have any of it. */
static json_t *load_json(const char *text, size_t size, json_error_t *error) {
    json_t *json = json_loadb(text, size, 0, error);
    if (json) return json;
    char *replaced = gn_json_text_replace(text, size);
    json = json_loadb(replaced ? replaced : text, size, JSON_DECODE_INT_AS_REAL, error);
    free(replaced);
    return json;
}

bool gn_gltf_parse(struct gn_gltf *g, const char *text, size_t size, size_t offset) {
    if (!check_json_size(g, text, size, offset)) return false;
    size_t zeros = 0; /* padding, and ends of C strings, that some exporters write with the text */
    while (zeros < size && !text[size - zeros - 1]) zeros++;
    if (zeros > 0) gn_gltf_warn(g, NULL, "%zu zero bytes after the JSON ignored", zeros);
    size -= zeros;
    json_error_t error;
    g->file.json = load_json(text, size, &error);
    if (!g->file.json) {
        size_t byte = offset + (error.position > 0 ? (size_t)error.position : 0);
        return gn_gltf_fail(g, NULL, "byte %zu (line %d): JSON: %s", byte, error.line, error.text);
    }
    if (!json_is_object(g->file.json))
        return gn_gltf_fail(g, NULL, "byte %zu: JSON: must be an object", offset);
    return true;
}

/* ---- cursors ---- */

static bool fail_type(struct gn_gltf *g, struct gn_at *at, const char *wanted) {
    static const char *const types[] = {
        [JSON_OBJECT] = "an object",    [JSON_ARRAY] = "an array", [JSON_STRING] = "a string",
        [JSON_INTEGER] = "a number",    [JSON_REAL] = "a number",  [JSON_TRUE] = "true or false",
        [JSON_FALSE] = "true or false", [JSON_NULL] = "null"};
    gn_gltf_fail(g, at, "must be %s, is %s", wanted, types[json_typeof(at->json)]);
    at->json = NULL;
    return false;
}

/* Empties the cursor and fails unless it is absent or right. */
static bool check_type(struct gn_gltf *g, struct gn_at *at, bool right, const char *wanted) {
    if (++g->getters % 1024 == 0) gn_gltf_check_time(g);
    if (!at->json) return false;
    return right || fail_type(g, at, wanted);
}

struct gn_at gn_at_root(const struct gn_gltf *g) {
    return (struct gn_at){.json = g->file.json};
}

struct gn_at gn_at_any(const struct gn_at *up, const char *key) {
    return (struct gn_at){.up = up, .key = key, .json = json_object_get(up->json, key)};
}

/* The value at a path. */
static struct gn_at find_value(struct gn_gltf *g, const struct gn_at *up, const char *path) {
    struct gn_at at = {.up = up, .key = path, .json = up->json};
    const char *name = path;
    for (const char *dot; (dot = strchr(name, '.')) && at.json; name = dot + 1) {
        char key[128];
        snprintf(key, sizeof key, "%.*s", (int)(dot - name), name);
        at.json = json_object_get(at.json, key);
        snprintf(key, sizeof key, "%.*s", (int)(dot - path), path);
        struct gn_at part = {.up = up, .key = key, .json = at.json};
        if (at.json && !json_is_object(at.json)) fail_type(g, &part, "an object");
    }
    at.json = json_object_get(at.json, name);
    return at;
}

struct gn_at gn_at_object(struct gn_gltf *g, const struct gn_at *up, const char *path) {
    struct gn_at at = find_value(g, up, path);
    check_type(g, &at, json_is_object(at.json), "an object");
    return at;
}

struct gn_at gn_at_array(struct gn_gltf *g, const struct gn_at *up, const char *path) {
    struct gn_at at = find_value(g, up, path);
    check_type(g, &at, json_is_array(at.json), "an array");
    return at;
}

struct gn_at gn_at_element(const struct gn_at *array, size_t index) {
    return (struct gn_at){.up = array, .index = index, .json = json_array_get(array->json, index)};
}

struct gn_at gn_at_item(struct gn_gltf *g, const struct gn_at *array, size_t index) {
    struct gn_at at = gn_at_element(array, index);
    check_type(g, &at, json_is_object(at.json), "an object");
    return at;
}

size_t gn_at_size(const struct gn_at *array) { return json_array_size(array->json); }

/* ---- values ---- */

bool gn_json_number(const json_t *json, double *out) {
    if (!json_is_number(json)) return false;
    *out = json_number_value(json);
    return isfinite(*out);
}

bool gn_json_whole(const json_t *json, int64_t *out) {
    double real = json_is_number(json) ? json_number_value(json) : 0.5;
    if (!(fabs(real) < 9223372036854775808.0) || floor(real) != real) return false;
    *out = (int64_t)real;
    return true;
}

int gn_json_word(const json_t *json, const char *const *names, int count) {
    const char *word = json_string_value(json);
    for (int i = 0; word && i < count; i++)
        if (strcmp(word, names[i]) == 0) return i;
    return -1;
}

const char *gn_at_text(struct gn_gltf *g, const struct gn_at *up, const char *path) {
    struct gn_at at = find_value(g, up, path);
    return check_type(g, &at, json_is_string(at.json), "a string") ? json_string_value(at.json)
                                                                   : NULL;
}

/* A failure of this getter alone becomes a warning. */
static void ignore_fault(struct gn_gltf *g, bool failed_before) {
    if (!failed_before) gn_gltf_spare(g, "ignored");
}

const char *gn_at_name(struct gn_gltf *g, const struct gn_at *up) {
    const bool failed = g->failed;
    const char *name = gn_at_text(g, up, "name");
    ignore_fault(g, failed);
    return name;
}

bool gn_at_flag(struct gn_gltf *g, const struct gn_at *up, const char *path, bool fallback) {
    const bool failed = g->failed;
    struct gn_at at = find_value(g, up, path);
    const bool found = check_type(g, &at, json_is_boolean(at.json), "true or false");
    ignore_fault(g, failed);
    return found ? json_is_true(at.json) : fallback;
}

uint64_t gn_at_uint(struct gn_gltf *g, const struct gn_at *up, const char *path,
                    uint64_t fallback) {
    struct gn_at at = find_value(g, up, path);
    int64_t value = 0;
    if (!check_type(g, &at, json_is_number(at.json), "an integer")) return fallback;
    if (!gn_json_whole(at.json, &value)) {
        gn_gltf_fail(g, &at, "must be an integer, is %g", json_number_value(at.json));
        return fallback;
    }
    if (value < 0) {
        gn_gltf_fail(g, &at, "must not be negative, is %" PRId64, value);
        return fallback;
    }
    return (uint64_t)value;
}

/* The number at the cursor, if it is one that a float can hold. */
static bool read_float(struct gn_gltf *g, struct gn_at *at, float *out) {
    double value = 0;
    if (!check_type(g, at, json_is_number(at->json), "a number")) return false;
    if (!gn_json_number(at->json, &value) || fabs(value) > (double)FLT_MAX) {
        const double written = json_number_value(at->json);
        const bool replaced = fabs(written) >= GN_JSON_TEXT_LARGEST;
        return gn_gltf_fail(g, at, "%g%s is too large", written, replaced ? " or more" : "");
    }
    *out = (float)value;
    return true;
}

float gn_at_float(struct gn_gltf *g, const struct gn_at *up, const char *path, float fallback) {
    const bool failed = g->failed;
    struct gn_at at = find_value(g, up, path);
    float value = fallback;
    const bool found = read_float(g, &at, &value);
    ignore_fault(g, failed);
    return found ? value : fallback;
}

void gn_at_first_floats(struct gn_gltf *g, const struct gn_at *array, size_t n, float *out) {
    const bool failed = g->failed;
    for (size_t i = 0; i < n && i < gn_at_size(array); i++) {
        struct gn_at at = gn_at_element(array, i);
        read_float(g, &at, &out[i]);
        ignore_fault(g, failed);
    }
}

static bool read_floats(struct gn_gltf *g, const struct gn_at *array, size_t n, float *out) {
    if (!array->json) return false;
    if (gn_at_size(array) != n)
        return gn_gltf_fail(g, array, "must have %zu numbers, has %zu", n, gn_at_size(array));
    for (size_t i = 0; i < n; i++) {
        struct gn_at at = gn_at_element(array, i);
        if (!read_float(g, &at, &out[i])) return false;
    }
    return true;
}

bool gn_at_floats(struct gn_gltf *g, const struct gn_at *up, const char *path, size_t n,
                  float *out) {
    const bool failed = g->failed;
    float read[16];
    assert(n <= sizeof read / sizeof *read);
    struct gn_at array = gn_at_array(g, up, path);
    const bool found = read_floats(g, &array, n, read);
    ignore_fault(g, failed);
    if (found) memcpy(out, read, n * sizeof *out);
    return found;
}

int32_t gn_at_ref_here(struct gn_gltf *g, const struct gn_at *at, size_t count, const char *what) {
    struct gn_at copy = *at;
    int64_t value = 0;
    if (!check_type(g, &copy, json_is_number(at->json), "an index")) return -1;
    if (!gn_json_whole(at->json, &value))
        gn_gltf_fail(g, at, "must be an index, is %g", json_number_value(at->json));
    else if (value < 0 || (uint64_t)value >= count || value > INT32_MAX)
        gn_gltf_fail(g, at, "index %" PRId64 ", but there are %zu %s", value, count, what);
    else
        return (int32_t)value;
    return -1;
}

int32_t gn_at_ref(struct gn_gltf *g, const struct gn_at *up, const char *path, size_t count,
                  const char *what) {
    struct gn_at at = find_value(g, up, path);
    return gn_at_ref_here(g, &at, count, what);
}

int32_t gn_at_spare_ref(struct gn_gltf *g, const struct gn_at *up, const char *path, size_t count,
                        const char *what) {
    const bool failed = g->failed;
    const int32_t index = gn_at_ref(g, up, path, count, what);
    ignore_fault(g, failed);
    return index;
}
