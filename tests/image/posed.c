#include "image/posed.h"

#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BUFFERS = 8 };

struct file {
    json_t *json;
    uint8_t *buffers[BUFFERS];
    char folder[PATH_MAX];
    double (*local)[16], (*world)[16]; /* of nodes, column by column */
    double **weights;                  /* of nodes, or NULL */
    size_t node_count;
};

static json_t *item(json_t *up, const char *array, json_int_t i) {
    return json_array_get(json_object_get(up, array), (size_t)i);
}

static json_int_t whole(json_t *up, const char *key, json_int_t none) {
    json_t *value = json_object_get(up, key);
    return value ? (json_int_t)json_number_value(value) : none;
}

static uint8_t *slurp(const char *path, size_t *size) {
    FILE *f = fopen(path, "rb");
    if (!f) return NULL;
    fseek(f, 0, SEEK_END);
    *size = (size_t)ftell(f);
    rewind(f);
    uint8_t *bytes = calloc(*size + 1, 1);
    if (bytes && fread(bytes, 1, *size, f) != *size) *size = 0;
    fclose(f);
    return bytes;
}

static uint8_t *decode_base64(const char *text) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint8_t *out = calloc(strlen(text) + 4, 1), *at = out;
    uint32_t bits = 0;
    for (int held = 0; out && *text && *text != '='; text++) {
        bits = bits << 6 | (uint32_t)(strchr(digits, *text) - digits);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        *at++ = (uint8_t)(bits >> held);
    }
    return out;
}

static bool open_file(struct file *f, const char *path) {
    size_t size = 0;
    uint8_t *bytes = slurp(path, &size);
    snprintf(f->folder, sizeof f->folder, "%s", path);
    char *slash = strrchr(f->folder, '/');
    if (slash) slash[1] = 0;
    const bool glb = bytes && memcmp(bytes, "glTF", 4) == 0;
    uint32_t json_size = (uint32_t)size;
    if (glb) memcpy(&json_size, bytes + 12, 4);
    f->json = bytes ? json_loadb((char *)bytes + (glb ? 20 : 0), json_size, 0, NULL) : NULL;
    for (json_int_t i = 0; f->json && i < BUFFERS; i++) {
        json_t *buffer = item(f->json, "buffers", i);
        const char *uri = json_string_value(json_object_get(buffer, "uri"));
        const char *data = uri ? strstr(uri, ";base64,") : NULL;
        char name[2 * PATH_MAX];
        if (!buffer) break;
        snprintf(name, sizeof name, "%s%s", f->folder, uri ? uri : "");
        if (data)
            f->buffers[i] = decode_base64(data + 8);
        else if (uri)
            f->buffers[i] = slurp(name, &size);
        else {
            f->buffers[i] = malloc(size - json_size - 28);
            memcpy(f->buffers[i], bytes + 28 + json_size, size - json_size - 28);
        }
    }
    free(bytes);
    return f->json;
}

/* ---- accessors ----------------------------------------------------------------------------- */

static const uint8_t *view_at(const struct file *f, json_t *up, size_t *stride) {
    json_t *view = item(f->json, "bufferViews", whole(up, "bufferView", -1));
    if (!view) return NULL;
    if (stride) *stride = (size_t)whole(view, "byteStride", (json_int_t)*stride);
    return f->buffers[whole(view, "buffer", 0)] + whole(view, "byteOffset", 0) +
           whole(up, "byteOffset", 0);
}

static size_t bytes_of(int type) { return type <= 5121 ? 1 : type <= 5123 ? 2 : 4; }

static double component(const uint8_t *p, int type, bool normalized) {
    int16_t s;
    uint16_t u;
    uint32_t w;
    float x;
    switch (type) {
    case 5120: return normalized ? fmax((int8_t)*p / 127.0, -1) : (int8_t)*p;
    case 5121: return normalized ? *p / 255.0 : *p;
    case 5122: memcpy(&s, p, 2); return normalized ? fmax(s / 32767.0, -1) : s;
    case 5123: memcpy(&u, p, 2); return normalized ? u / 65535.0 : u;
    case 5125: memcpy(&w, p, 4); return w;
    default: memcpy(&x, p, 4); return (double)x;
    }
}

/* All components of an accessor, malloc'ed. */
static double *read_accessor(const struct file *f, json_int_t index, size_t *count, int *n) {
    static const char *const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"};
    static const int sizes[] = {1, 2, 3, 4, 16};
    json_t *a = item(f->json, "accessors", index);
    const int type = (int)whole(a, "componentType", 0);
    const bool normalized = json_is_true(json_object_get(a, "normalized"));
    *count = (size_t)whole(a, "count", 0);
    for (int i = 0; i < 5; i++)
        if (strcmp(types[i], json_string_value(json_object_get(a, "type"))) == 0) *n = sizes[i];
    size_t stride = bytes_of(type) * (size_t)*n;
    const uint8_t *data = view_at(f, a, &stride);
    double *out = calloc(*count * (size_t)*n, sizeof *out);
    for (size_t i = 0; data && i < *count; i++)
        for (int k = 0; k < *n; k++)
            out[i * (size_t)*n + (size_t)k] =
                component(data + i * stride + (size_t)k * bytes_of(type), type, normalized);
    json_t *sparse = json_object_get(a, "sparse"), *where = json_object_get(sparse, "indices"),
           *what = json_object_get(sparse, "values");
    for (size_t i = 0; sparse && i < (size_t)whole(sparse, "count", 0); i++) {
        const int of = (int)whole(where, "componentType", 0);
        const uint8_t *values = view_at(f, what, NULL);
        const size_t at = (size_t)component(view_at(f, where, NULL) + i * bytes_of(of), of, false);
        for (int k = 0; k < *n; k++)
            out[at * (size_t)*n + (size_t)k] =
                component(values + (i * (size_t)*n + (size_t)k) * bytes_of(type), type, normalized);
    }
    return out;
}

/* ---- matrices, column by column ------------------------------------------------------------ */

static void multiply(const double a[16], const double b[16], double out[16]) {
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            double sum = 0;
            for (int k = 0; k < 4; k++) sum += a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = sum;
        }
}

static void compose(const double t[3], const double q[4], const double s[3], double out[16]) {
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double m[16] = {(1 - 2 * (y * y + z * z)) * s[0],
                          2 * (x * y + z * w) * s[0],
                          2 * (x * z - y * w) * s[0],
                          0,
                          2 * (x * y - z * w) * s[1],
                          (1 - 2 * (x * x + z * z)) * s[1],
                          2 * (y * z + x * w) * s[1],
                          0,
                          2 * (x * z + y * w) * s[2],
                          2 * (y * z - x * w) * s[2],
                          (1 - 2 * (x * x + y * y)) * s[2],
                          0,
                          t[0],
                          t[1],
                          t[2],
                          1};
    memcpy(out, m, sizeof m);
}

/* ---- clips --------------------------------------------------------------------------------- */

/* n values at a time; turns: they are a quaternion. */
static bool sample(const struct file *f, json_t *sampler, double time_s, int n, bool turns,
                   double *out, double *last_s) {
    size_t keys, values;
    int one, width;
    const char *how = json_string_value(json_object_get(sampler, "interpolation"));
    double *times = read_accessor(f, whole(sampler, "input", 0), &keys, &one);
    double *v = read_accessor(f, whole(sampler, "output", 0), &values, &width);
    const bool cubic = how && strcmp(how, "CUBICSPLINE") == 0;
    const bool step = how && strcmp(how, "STEP") == 0;
    const size_t stride = (size_t)(cubic ? 3 * n : n), middle = (size_t)(cubic ? n : 0);
    size_t k = 0;
    *last_s = fmax(*last_s, times[keys - 1]);
    while (k + 1 < keys && times[k + 1] <= time_s) k++;
    const double *a = v + k * stride, *b = a + stride;
    const bool held = k + 1 == keys || time_s <= times[k] || step;
    const double d = held ? 1 : times[k + 1] - times[k], u = held ? 0 : (time_s - times[k]) / d;
    double cosine = 0, sign = 1, from = 1 - u, to = u;
    for (int i = 0; i < n && turns && !held && !cubic; i++) cosine += a[i] * b[i];
    if (cosine < 0) sign = -1;
    if (turns && !held && !cubic && fabs(cosine) < 1 - 1e-9) {
        const double angle = acos(fabs(cosine));
        from = sin((1 - u) * angle) / sin(angle);
        to = sin(u * angle) / sin(angle);
    }
    for (int i = 0; i < n; i++) {
        if (held)
            out[i] = a[middle + (size_t)i];
        else if (!cubic)
            out[i] = from * a[i] + sign * to * b[i];
        else
            out[i] = (2 * u * u * u - 3 * u * u + 1) * a[n + i] +
                     d * (u * u * u - 2 * u * u + u) * a[2 * n + i] +
                     (3 * u * u - 2 * u * u * u) * b[n + i] + d * (u * u * u - u * u) * b[i];
    }
    free(times);
    free(v);
    return true;
}

static void numbers(json_t *up, const char *key, int n, double *out) {
    json_t *array = json_object_get(up, key);
    for (int i = 0; array && i < n; i++)
        out[i] = json_number_value(json_array_get(array, (size_t)i));
}

static size_t targets_of(const struct file *f, json_t *node) {
    json_t *mesh = item(f->json, "meshes", whole(node, "mesh", -1));
    return json_array_size(json_object_get(item(mesh, "primitives", 0), "targets"));
}

static void pose_node(struct file *f, size_t i, json_t *clip, double time_s, double *last_s) {
    json_t *node = item(f->json, "nodes", (json_int_t)i), *channel;
    const int count = (int)targets_of(f, node);
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    size_t k;
    numbers(node, "translation", 3, t);
    numbers(node, "rotation", 4, q);
    numbers(node, "scale", 3, s);
    f->weights[i] = calloc((size_t)count + 1, sizeof(double));
    json_t *mesh = item(f->json, "meshes", whole(node, "mesh", -1));
    numbers(json_object_get(node, "weights") ? node : mesh, "weights", count, f->weights[i]);
    json_array_foreach(json_object_get(clip, "channels"), k, channel) {
        json_t *target = json_object_get(channel, "target");
        json_t *sampler = item(clip, "samplers", whole(channel, "sampler", 0));
        const char *path = json_string_value(json_object_get(target, "path"));
        if (whole(target, "node", -1) != (json_int_t)i) continue;
        if (strcmp(path, "translation") == 0) sample(f, sampler, time_s, 3, false, t, last_s);
        if (strcmp(path, "rotation") == 0) sample(f, sampler, time_s, 4, true, q, last_s);
        if (strcmp(path, "scale") == 0) sample(f, sampler, time_s, 3, false, s, last_s);
        if (strcmp(path, "weights") == 0)
            sample(f, sampler, time_s, count, false, f->weights[i], last_s);
    }
    compose(t, q, s, f->local[i]);
    numbers(node, "matrix", 16, f->local[i]);
}

static void place_nodes(struct file *f, json_int_t index, const double *parent) {
    static const double same[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    json_t *child;
    size_t k;
    multiply(parent ? parent : same, f->local[index], f->world[index]);
    json_array_foreach(json_object_get(item(f->json, "nodes", index), "children"), k, child)
        place_nodes(f, (json_int_t)json_number_value(child), f->world[index]);
}

/* ---- meshes -------------------------------------------------------------------------------- */

static void add_triangles(struct gn_posed *posed, const double *p, const double *indices,
                          size_t count, uint32_t number, bool one_sided) {
    posed->triangles =
        realloc(posed->triangles, (posed->count + count / 3 + 1) * sizeof *posed->triangles);
    for (size_t i = 0; i + 2 < count; i += 3) {
        struct gn_bvh_triangle *t = &posed->triangles[posed->count++];
        *t = (struct gn_bvh_triangle){.item = number, .flags = one_sided};
        for (size_t c = 0; c < 3; c++)
            memcpy(t->p[c], p + 3 * (indices ? (size_t)indices[i + c] : i + c), sizeof t->p[c]);
    }
}

static void add_morphs(const struct file *f, json_t *primitive, const double *weights, double *p) {
    json_t *target;
    size_t t, count;
    int n;
    json_array_foreach(json_object_get(primitive, "targets"), t, target) {
        const json_int_t index = whole(target, "POSITION", -1);
        if (index < 0) continue;
        double *delta = read_accessor(f, index, &count, &n);
        for (size_t i = 0; i < 3 * count; i++) p[i] += weights[t] * delta[i];
        free(delta);
    }
}

/* Linear blend skinning: a sum over joints of weight x world_from_joint x joint_from_mesh. */
static void add_skin(const struct file *f, json_t *attributes, json_t *skin, double *p,
                     size_t count) {
    static const char *const names[2][2] = {{"JOINTS_0", "WEIGHTS_0"}, {"JOINTS_1", "WEIGHTS_1"}};
    json_t *joints = json_object_get(skin, "joints");
    double *sum = calloc(4 * count, sizeof *sum), *binds = NULL;
    size_t some;
    int n;
    if (json_object_get(skin, "inverseBindMatrices"))
        binds = read_accessor(f, whole(skin, "inverseBindMatrices", 0), &some, &n);
    for (int set = 0; set < 2; set++) {
        if (!json_object_get(attributes, names[set][0])) continue;
        double *joint = read_accessor(f, whole(attributes, names[set][0], 0), &some, &n);
        double *weight = read_accessor(f, whole(attributes, names[set][1], 0), &some, &n);
        for (size_t i = 0; i < 4 * count; i++) {
            if (weight[i] == 0) continue;
            const size_t j = (size_t)joint[i];
            const double *world = f->world[(size_t)json_number_value(json_array_get(joints, j))];
            double m[16];
            const double *from = p + 3 * (i / 4);
            if (binds)
                multiply(world, binds + 16 * j, m);
            else
                memcpy(m, world, sizeof m);
            for (size_t r = 0; r < 3; r++)
                sum[4 * (i / 4) + r] += weight[i] * (m[r] * from[0] + m[4 + r] * from[1] +
                                                     m[8 + r] * from[2] + m[12 + r]);
            sum[4 * (i / 4) + 3] += weight[i];
        }
        free(joint);
        free(weight);
    }
    for (size_t i = 0; i < 3 * count; i++) p[i] = sum[4 * (i / 3) + i % 3] / sum[4 * (i / 3) + 3];
    free(sum);
    free(binds);
}

static bool add_primitive(const struct file *f, size_t node, json_t *primitive, uint32_t number,
                          struct gn_posed *posed) {
    json_t *attributes = json_object_get(primitive, "attributes");
    json_t *skin =
        item(f->json, "skins", whole(item(f->json, "nodes", (json_int_t)node), "skin", -1));
    size_t count, corner_count;
    int n;
    if (whole(primitive, "mode", 4) != 4) return false;
    double *p = read_accessor(f, whole(attributes, "POSITION", 0), &count, &n), *indices = NULL;
    corner_count = count;
    if (json_object_get(primitive, "indices"))
        indices = read_accessor(f, whole(primitive, "indices", 0), &corner_count, &n);
    add_morphs(f, primitive, f->weights[node], p);
    if (skin && json_object_get(attributes, "JOINTS_0"))
        add_skin(f, attributes, skin, p, count);
    else
        for (size_t i = 0; i < count; i++) {
            const double *m = f->world[node], x = p[3 * i], y = p[3 * i + 1], z = p[3 * i + 2];
            for (size_t r = 0; r < 3; r++)
                p[3 * i + r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
        }
    json_t *material = item(f->json, "materials", whole(primitive, "material", -1));
    add_triangles(posed, p, indices, corner_count, number,
                  !json_is_true(json_object_get(material, "doubleSided")));
    free(p);
    free(indices);
    return true;
}

static void measure(struct gn_posed *posed) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double sum = 0;
    for (uint32_t i = 0; i < posed->count; i++)
        for (int c = 0; c < 9; c++) {
            const double x = posed->triangles[i].p[c / 3][c % 3];
            low[c % 3] = fmin(low[c % 3], x);
            high[c % 3] = fmax(high[c % 3], x);
        }
    for (int k = 0; k < 3; k++) sum += (high[k] - low[k]) * (high[k] - low[k]);
    posed->size = sqrt(sum);
}

bool gn_posed_read(struct gn_posed *posed, const char *path, int clip, double time_s) {
    struct file f = {0};
    json_t *node, *primitive;
    size_t i, k;
    uint32_t number = 0;
    bool ok = open_file(&f, path);
    *posed = (struct gn_posed){0};
    if (!ok) return false;
    f.node_count = json_array_size(json_object_get(f.json, "nodes"));
    f.local = calloc(f.node_count + 1, sizeof *f.local);
    f.world = calloc(f.node_count + 1, sizeof *f.world);
    f.weights = calloc(f.node_count + 1, sizeof *f.weights);
    posed->clips = (int)json_array_size(json_object_get(f.json, "animations"));
    json_t *animation = clip < 0 ? NULL : item(f.json, "animations", clip);
    for (i = 0; i < f.node_count; i++) pose_node(&f, i, animation, time_s, &posed->last_s);
    json_array_foreach(json_object_get(item(f.json, "scenes", whole(f.json, "scene", 0)), "nodes"),
                       k, node) place_nodes(&f, (json_int_t)json_number_value(node), NULL);
    json_array_foreach(json_object_get(f.json, "nodes"), i, node) {
        json_t *mesh = item(f.json, "meshes", whole(node, "mesh", -1));
        json_array_foreach(json_object_get(mesh, "primitives"), k, primitive) ok &=
            add_primitive(&f, i, primitive, number++, posed);
    }
    measure(posed);
    for (i = 0; i < f.node_count; i++) free(f.weights[i]);
    for (i = 0; i < BUFFERS; i++) free(f.buffers[i]);
    free(f.local);
    free(f.world);
    free(f.weights);
    json_decref(f.json);
    return ok;
}

void gn_posed_finish(struct gn_posed *posed) {
    free(posed->triangles);
    *posed = (struct gn_posed){0};
}
