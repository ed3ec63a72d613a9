/* Accessors and views that stay as they are: those of animations, skins, instances, lines. Their
 * numbers change, unless the file has an extension that may refer to them in its own way. */
#include <string.h>

#include "bake/private.h"

/* Those that refer to no accessors and views, or in ways that are known here. */
static const char *const known[] = {
    "KHR_lights_punctual",
    "KHR_materials_*",
    "KHR_texture_*",
    "EXT_texture_*",
    "KHR_mesh_quantization",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "KHR_draco_mesh_compression",
    "EXT_mesh_gpu_instancing",
    "KHR_animation_pointer",
    "KHR_node_*",
    "KHR_xmp*",
    "EXT_materials_*",
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "MOZ_lightmap",
    "MSFT_lod",
};

static bool is_known(const char *name) {
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const size_t length = strcspn(known[i], "*");
        if (strncmp(name, known[i], length) == 0 && (known[i][length] || !name[length]))
            return true;
    }
    return false;
}

/* ---- all ----------------------------------------------------------------------------------- */

static void find_unknown(struct gn_baker *b) {
    static const char *const lists[] = {"extensionsUsed", "extensionsRequired"};
    const json_t *item;
    size_t i;
    for (int k = 0; k < 2; k++) json_array_foreach(json_object_get(b->root, lists[k]), i, item) {
            const char *name = json_string_value(item);
            if (!name || is_known(name)) continue;
            strncpy(b->report->unknown, name, sizeof b->report->unknown - 1);
            b->keeps_all = true;
        }
}

static bool copy_view(struct gn_baker *b, size_t index) {
    const uint8_t *data, nothing[4] = {0};
    size_t size, stride;
    gn_document_view(b->in, index, &data, &size, &stride);
    const struct gn_block block = {GN_BLOCK_BYTES, data && size ? data : nothing,
                                   data && size ? size : sizeof nothing, 1};
    const size_t number = gn_bake_view(b, &block);
    if (b->failed) return false;
    json_t *made = json_array_get(json_object_get(b->root, "bufferViews"), number), *value;
    const char *key;
    json_object_foreach(json_array_get(b->views, index), key,
                        value) if (!json_object_get(made, key) && strcmp(key, "extensions") != 0)
        json_object_set(made, key, value);
    return true;
}

bool gn_bake_keep_all(struct gn_baker *b) {
    find_unknown(b);
    for (size_t i = 0; b->keeps_all && i < gn_document_view_count(b->in); i++)
        if (!copy_view(b, i)) return false;
    const json_t *accessor;
    size_t i;
    if (b->keeps_all)
        json_array_foreach(b->accessors, i, accessor)
            gn_bake_add(b, "accessors", json_deep_copy(accessor));
    return !b->failed;
}

/* ---- those in use -------------------------------------------------------------------------- */

enum { UNSEEN = -1 };

static int64_t copy_accessor(struct gn_baker *b, size_t index, enum gn_block_kind kind) {
    const json_t *old = json_array_get(b->accessors, index);
    json_t *copy = json_deep_copy(old);
    struct gn_elements e;
    if (!gn_document_accessor(b->in, index, &e)) b->failed = true;
    if (!json_object_get(old, "bufferView") && !json_object_get(old, "sparse"))
        return (int64_t)gn_bake_add(b, "accessors", copy); /* zeros */
    const bool padded = kind == GN_BLOCK_VERTICES;
    const size_t stride = b->failed ? 1 : padded ? (e.element + 3) / 4 * 4 : e.element;
    uint8_t *data = gn_bake_alloc(b, b->failed ? 0 : e.count, stride);
    for (size_t i = 0; data && i < e.count; i++)
        memcpy(data + i * stride, e.data + i * e.stride, e.element);
    if (data) {
        const struct gn_block block = {kind, data, e.count, stride};
        json_object_del(copy, "byteOffset");
        json_object_del(copy, "sparse");
        json_object_set_new(copy, "bufferView", json_integer((json_int_t)gn_bake_view(b, &block)));
    }
    gn_arena_reset(&b->step);
    return (int64_t)gn_bake_add(b, "accessors", copy);
}

struct keeper {
    struct gn_baker *b;
    int64_t *numbers; /* new ones, by old */
    size_t count;
};

static void keep_member(struct keeper *k, json_t *object, const char *key,
                        enum gn_block_kind kind) {
    const int64_t old = gn_bake_number(object, key);
    if (old < 0 || (uint64_t)old >= k->count || k->b->failed) return;
    if (k->numbers[old] == UNSEEN) k->numbers[old] = copy_accessor(k->b, (size_t)old, kind);
    json_object_set_new(object, key, json_integer((json_int_t)k->numbers[old]));
}

static void keep_members(struct keeper *k, json_t *object, enum gn_block_kind kind) {
    json_t *value;
    const char *key;
    void *next;
    json_object_foreach_safe(object, next, key, value) keep_member(k, object, key, kind);
}

static void keep_primitives(struct keeper *keeper) {
    json_t *mesh, *primitive, *target, *root = keeper->b->root;
    size_t i, k, t, number = 0;
    json_array_foreach(json_object_get(root, "meshes"), i, mesh)
        json_array_foreach(json_object_get(mesh, "primitives"), k, primitive) {
        if (keeper->b->is_baked[number++]) continue;
        keep_members(keeper, json_object_get(primitive, "attributes"), GN_BLOCK_VERTICES);
        json_array_foreach(json_object_get(primitive, "targets"), t, target)
            keep_members(keeper, target, GN_BLOCK_VERTICES);
        keep_member(keeper, primitive, "indices", GN_BLOCK_OTHER);
    }
}

bool gn_bake_keep_used(struct gn_baker *b) {
    json_t *item, *part, *root = b->root;
    size_t i, k;
    if (b->keeps_all) return true;
    struct keeper keeper = {.b = b, .count = gn_document_accessor_count(b->in)};
    keeper.numbers = gn_arena_alloc(&b->whole, keeper.count, sizeof *keeper.numbers);
    if (!keeper.numbers) return gn_bake_fail(b, "out of memory");
    for (i = 0; i < keeper.count; i++) keeper.numbers[i] = UNSEEN;
    keep_primitives(&keeper);
    json_array_foreach(json_object_get(root, "animations"), i, item)
        json_array_foreach(json_object_get(item, "samplers"), k, part) {
        keep_member(&keeper, part, "input", GN_BLOCK_OTHER);
        keep_member(&keeper, part, "output", GN_BLOCK_OTHER);
    }
    json_array_foreach(json_object_get(root, "skins"), i, item)
        keep_member(&keeper, item, "inverseBindMatrices", GN_BLOCK_OTHER);
    json_array_foreach(json_object_get(root, "nodes"), i, item) keep_members(
        &keeper, json_object_get(gn_bake_extension(item, "EXT_mesh_gpu_instancing"), "attributes"),
        GN_BLOCK_OTHER);
    return !b->failed;
}
