/* Items: each primitive of each mesh of a node, and of each instance of it. */
#include "scene/private.h"

#include <inttypes.h>

/* What an item takes where it is posed and drawn, in the arrays of the pose and of a frame, which
 * grow by doubling. */
enum { DRAWN_BYTES = 512 };

static uint32_t copies_of(const struct gn_placed *placed) {
    return placed->instance_count > 0 ? placed->instance_count : 1;
}

/* Of a mesh, by its first primitive: its copies would all be where its joints are. */
static void warn_of_copies(struct gn_gltf *g, const struct gn_placed *placed,
                           const struct gn_primitive *primitive) {
    const uint32_t first = g->file.meshes[placed->mesh].first_primitive;
    struct gn_at root = gn_at_root(g), nodes = gn_at_any(&root, "nodes");
    struct gn_at node = gn_at_element(&nodes, placed->json);
    if (placed->instance_count > 1 && primitive == &g->primitives.list[first])
        gn_gltf_warn(g, &node,
                     "has a skin, so the transforms of EXT_mesh_gpu_instancing do not move it; "
                     "shown once");
}

static bool add_items(struct gn_gltf *g, uint32_t node, const struct gn_primitive *primitive) {
    struct gn_scene *scene = g->scene;
    const struct gn_placed *placed = &g->placed[node];
    uint32_t fallback = (uint32_t)g->file.material_count;
    for (uint32_t k = 0; k < copies_of(placed); k++) {
        struct gn_item *item = &scene->items[scene->item_count++];
        if (!(primitive->hidden_in & 1))
            scene->triangle_count += scene->geometries[primitive->geometry].index_count / 3;
        *item = (struct gn_item){
            .node = node,
            .geometry = primitive->geometry,
            .material = primitive->material < 0 ? fallback : (uint32_t)primitive->material,
            .hidden_in = primitive->hidden_in,
            .instance = placed->instance_count > 0 ? (int32_t)(placed->first_instance + k) : -1,
            .casts = placed->casts,
            .casts_alpha = placed->casts_alpha,
            .receives = placed->receives,
            .cast_faces = placed->cast_faces,
        };
        if (!gn_gltf_deform_item(g, item)) return false;
        if (item->skin < 0) continue;
        warn_of_copies(g, placed, primitive);
        break; /* its node's transform is not used, nor those of copies */
    }
    return true;
}

bool gn_gltf_items(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    uint64_t total = 0;
    struct gn_at root = gn_at_root(g), nodes = gn_at_any(&root, "nodes");
    for (uint32_t i = 0; i < scene->node_count; i++)
        if (g->placed[i].mesh >= 0)
            total += (uint64_t)copies_of(&g->placed[i]) *
                     g->file.meshes[g->placed[i].mesh].primitive_count;
    if (total > g->limits.instances)
        return gn_gltf_fail(g, &nodes,
                            "%" PRIu64 " items are more than the limit instances=%" PRIu64, total,
                            g->limits.instances);
    GN_NEW(g, g->memory.scene, scene->items, total + (g->limits.floor.kind != GN_FLOOR_NONE));
    if (!scene->items) return false;
    if (total * DRAWN_BYTES > gn_gltf_room(g))
        return gn_gltf_fail(
            g, &nodes, "%" PRIu64 " items: out of memory, or over the limit memory_mb=%" PRIu64,
            total, g->limits.memory_mb);
    g->memory.other_bytes += total * DRAWN_BYTES;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const struct gn_mesh *mesh =
            g->placed[i].mesh >= 0 ? &g->file.meshes[g->placed[i].mesh] : NULL;
        for (uint32_t k = 0; mesh && k < mesh->primitive_count; k++) {
            const struct gn_primitive *primitive = &g->primitives.list[mesh->first_primitive + k];
            if (scene->geometries[primitive->geometry].index_count > 0 &&
                !add_items(g, i, primitive))
                return false;
        }
    }
    if (scene->item_count > 0) return true;
    struct gn_at meshes = gn_at_any(&root, "meshes");
    if (g->is_missing[GN_MISSING_DRACO])
        return gn_gltf_fail(g, &meshes,
                            "KHR_draco_mesh_compression is not supported; decompress them "
                            "first (gltf-transform can)");
    if (g->misplaced)
        return gn_gltf_fail(g, &meshes,
                            "the scene is empty: %zu triangles have positions that are not finite, "
                            "and there are no others",
                            g->misplaced);
    return gn_gltf_fail_empty(g, &nodes, "no node of it has a mesh with triangles");
}
