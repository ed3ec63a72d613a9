/* Undoes the grids of meshes in the nodes that show them. */
#include <math.h>
#include <string.h>

#include "bake/private.h"

/* Nodes whose own transform must stay as it is, by node. */
static bool mark_fixed(const struct gn_baker *b, bool *fixed, size_t count) {
    const json_t *item, *part, *node;
    size_t i, k;
    bool pointed = false;
    json_array_foreach(json_object_get(b->root, "skins"), i, item)
        json_array_foreach(json_object_get(item, "joints"), k, part) {
        const double joint = json_number_value(part);
        if (joint >= 0 && joint < (double)count) fixed[(size_t)joint] = true;
    }
    json_array_foreach(json_object_get(b->root, "animations"), i, item)
        json_array_foreach(json_object_get(item, "channels"), k, part) {
        const json_t *target = json_object_get(part, "target");
        const int64_t index = gn_bake_number(target, "node");
        if (index >= 0 && (uint64_t)index < count) fixed[index] = true;
        pointed |= json_object_get(target, "extensions") != NULL;
    }
    json_array_foreach(json_object_get(b->root, "nodes"), i, node) fixed[i] |=
        pointed || json_array_size(json_object_get(node, "children")) > 0 ||
        json_object_get(node, "camera") || json_object_get(node, "extensions");
    return true;
}

static void read_numbers(const json_t *list, size_t count, double *out) {
    for (size_t i = 0; i < count && json_array_size(list) == count; i++)
        out[i] = json_number_value(json_array_get(list, i));
}

static json_t *make_numbers(const double *values, size_t count) {
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(list, json_real(values[i]));
    return list;
}

/* matrix = matrix x translation x scale */
static void fold_into_matrix(json_t *node, const double offset[3], double step) {
    double m[16] = {0};
    json_t *matrix = json_object_get(node, "matrix");
    if (json_array_size(matrix) != 16) return;
    read_numbers(matrix, 16, m);
    for (int row = 0; row < 4; row++)
        for (int k = 0; k < 3; k++) m[12 + row] += m[4 * k + row] * offset[k];
    for (int i = 0; i < 12; i++) m[i] *= step;
    json_object_set_new(node, "matrix", make_numbers(m, 16));
}

/* The vector turned by a unit quaternion: v + 2 q x (q x v + w v). */
static void rotate(const double q[4], const double v[3], double out[3]) {
    double t[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        t[i] = q[j] * v[k] - q[k] * v[j] + q[3] * v[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = v[i] + 2 * (q[j] * t[k] - q[k] * t[j]);
    }
}

static void fold_into_parts(json_t *node, const double offset[3], double step) {
    double translation[3] = {0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1}, moved[3];
    read_numbers(json_object_get(node, "translation"), 3, translation);
    read_numbers(json_object_get(node, "rotation"), 4, rotation);
    read_numbers(json_object_get(node, "scale"), 3, scale);
    double norm = 0;
    for (int i = 0; i < 4; i++) norm += rotation[i] * rotation[i];
    for (int i = 0; i < 4 && norm > 0; i++) rotation[i] /= sqrt(norm);
    rotate(rotation, (double[]){scale[0] * offset[0], scale[1] * offset[1], scale[2] * offset[2]},
           moved);
    for (int i = 0; i < 3; i++) {
        translation[i] += moved[i];
        scale[i] *= step;
    }
    json_object_set_new(node, "translation", make_numbers(translation, 3));
    json_object_set_new(node, "scale", make_numbers(scale, 3));
}

/* A new child shows the mesh. What artists say of it goes with it. */
static bool add_child(struct gn_baker *b, json_t *node, const double offset[3], double step) {
    json_t *child = json_object(), *extras = json_object_get(node, "extras"), *value;
    const char *key;
    void *next;
    json_object_set_new(child, "translation", make_numbers(offset, 3));
    json_object_set_new(child, "scale", make_numbers((double[]){step, step, step}, 3));
    json_object_set(child, "mesh", json_object_get(node, "mesh"));
    json_object_del(node, "mesh");
    json_object_foreach_safe(extras, next, key, value) {
        if (strncmp(key, "gnomon_", 7) != 0) continue;
        if (!json_object_get(child, "extras")) json_object_set_new(child, "extras", json_object());
        json_object_set(json_object_get(child, "extras"), key, value);
    }
    if (!json_object_get(node, "children")) json_object_set_new(node, "children", json_array());
    json_t *children = json_object_get(node, "children");
    const size_t number = gn_bake_add(b, "nodes", child);
    json_array_append_new(children, json_integer((json_int_t)number));
    return !b->failed;
}

bool gn_bake_nodes(struct gn_baker *b) {
    json_t *nodes = json_object_get(b->root, "nodes");
    const size_t count = json_array_size(nodes);
    const size_t mesh_count = json_array_size(json_object_get(b->root, "meshes"));
    bool *fixed = gn_arena_alloc(&b->whole, count, sizeof *fixed);
    if (!fixed) return gn_bake_fail(b, "out of memory");
    mark_fixed(b, fixed, count);
    for (size_t i = 0; i < count; i++) {
        json_t *node = json_array_get(nodes, i);
        const int64_t mesh = gn_bake_number(node, "mesh");
        if (mesh < 0 || (uint64_t)mesh >= mesh_count || b->grids[mesh].kind != GN_GRID_SHORTS)
            continue;
        const struct gn_grid *grid = &b->grids[mesh];
        double offset[3];
        for (int k = 0; k < 3; k++) offset[k] = (double)grid->origin[k] * grid->step;
        if (fixed[i]) {
            if (!add_child(b, node, offset, grid->step)) return false;
        } else if (json_object_get(node, "matrix"))
            fold_into_matrix(node, offset, grid->step);
        else
            fold_into_parts(node, offset, grid->step);
    }
    return !b->failed;
}
