/* EXT_mesh_gpu_instancing: translations, rotations and scales of the copies of a node's mesh. */
#include "scene/exact.h"
#include "scene/private.h"

#include <cglm/cglm.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

struct copies {
    const struct gn_accessor *translation, *rotation, *scale;
    size_t count;
};

static const struct gn_accessor *read_attribute(struct gn_gltf *g, const struct gn_at *attributes,
                                                const char *key, uint8_t components,
                                                struct copies *copies) {
    int32_t index = gn_at_ref(g, attributes, key, g->file.accessor_count, "accessors");
    const struct gn_accessor *a = gn_gltf_accessor(g, index);
    struct gn_at at = gn_at_any(attributes, key);
    if (a && (a->components != components || a->component == GN_U32))
        gn_gltf_fail(g, &at, "must be VEC%d of floats or normalized bytes or shorts", components);
    else if (a && copies->count > 0 && copies->count != a->count)
        gn_gltf_fail(g, &at, "%zu elements, but another attribute has %zu", a->count,
                     copies->count);
    if (gn_gltf_spare(g, "shown without it") || !a || g->failed) return NULL;
    copies->count = a->count;
    return a;
}

static struct copies read_copies(struct gn_gltf *g, const struct gn_placed *placed) {
    struct copies copies = {0};
    struct gn_at root = gn_at_root(g), nodes = gn_at_array(g, &root, "nodes");
    struct gn_at node = gn_at_element(&nodes, placed->json);
    struct gn_at extension = gn_at_object(g, &node, "extensions.EXT_mesh_gpu_instancing");
    struct gn_at attributes = gn_at_object(g, &extension, "attributes");
    gn_gltf_spare(g, "ignored");
    if (!extension.json || g->failed) return copies;
    copies.translation = read_attribute(g, &attributes, "TRANSLATION", 3, &copies);
    copies.rotation = read_attribute(g, &attributes, "ROTATION", 4, &copies);
    copies.scale = read_attribute(g, &attributes, "SCALE", 3, &copies);
    if (copies.count == 0 && !g->failed)
        gn_gltf_warn(g, &extension, "has none of TRANSLATION, ROTATION, SCALE; shown once");
    return copies;
}

/* n values per copy, or the fallback where there is no such attribute. */
static float *read_values(struct gn_gltf *g, const struct gn_accessor *a, size_t count, size_t n,
                          const float *fallback) {
    float *out = gn_gltf_alloc(g, &g->memory.step, (uint64_t)count * n, sizeof *out);
    for (size_t i = 0; out && i < count * n; i++) out[i] = fallback[i % n];
    if (!out || !a) return out;
    struct gn_accessor copy = *a;
    if (n == 4) copy.normalized = true; /* integer rotations are always normalised */
    gn_accessor_floats(&copy, n, out);
    return out;
}

/* One copy, or, where its numbers are no place, one without a size: false. */
static bool put_copy(const float *t, const float *r, const float *s, mat4 out) {
    const float turn = glm_vec4_norm((float *)r);
    bool right = turn < 1e18f;
    for (int k = 0; k < 3; k++) right &= fabsf(t[k]) < 1e18f && fabsf(s[k]) < 1e18f;
    struct gn_node local = {.rotation = {0, 0, 0, 1}};
    if (right) {
        memcpy(local.translation, t, sizeof local.translation);
        memcpy(local.scale, s, sizeof local.scale);
        if (turn > 1e-6f) glm_vec4_scale((float *)r, 1 / turn, local.rotation);
    }
    gn_node_local(&local, out);
    return right;
}

bool gn_gltf_instances(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct gn_at root = gn_at_root(g), nodes = gn_at_any(&root, "nodes");
    uint64_t total = 0;
    for (uint32_t i = 0; i < scene->node_count && !g->failed; i++) {
        struct gn_placed *placed = &g->placed[i];
        if (placed->mesh < 0) continue;
        struct copies copies = read_copies(g, placed);
        if (copies.count > g->limits.instances - total)
            return gn_gltf_fail(g, &nodes, "more instances than the limit instances=%" PRIu64,
                                g->limits.instances);
        placed->first_instance = (uint32_t)total;
        placed->instance_count = (uint32_t)copies.count;
        total += copies.count;
    }
    scene->instance_count = (uint32_t)total;
    GN_NEW(g, g->memory.scene, scene->instances, total);
    for (uint32_t i = 0; i < scene->node_count && !g->failed; i++) {
        const struct gn_placed *placed = &g->placed[i];
        if (placed->instance_count == 0) continue;
        struct copies copies = read_copies(g, placed);
        gn_arena_reset(&g->memory.step);
        float *t = read_values(g, copies.translation, copies.count, 3, (float[]){0, 0, 0});
        float *r = read_values(g, copies.rotation, copies.count, 4, (float[]){0, 0, 0, 1});
        float *s = read_values(g, copies.scale, copies.count, 3, (float[]){1, 1, 1});
        size_t lost = 0;
        for (size_t k = 0; k < copies.count && !g->failed; k++)
            lost += !put_copy(t + 3 * k, r + 4 * k, s + 3 * k,
                              scene->instances[placed->first_instance + k]);
        struct gn_at node = gn_at_element(&nodes, placed->json);
        if (lost > 0)
            gn_gltf_warn(g, &node, "%zu copies with numbers that are not finite are not shown",
                         lost);
    }
    return !g->failed;
}
