/* What a scene's volume of occlusion is kept by: a hash of all that gn_occlusion_make() makes it
 * of, and of the sources that do. */
#include <stdlib.h>

#include "core/arena.h"
#include "core/hash.h"
#include "rays.h"
#include "scene/poses.h"
#include "truth/occlusion.h"

static uint64_t hash_buffers(uint64_t h, const struct gn_scene_buffers *b) {
#define GN_X(NAME, name, type, field, semantic, fewest, components, ...)                           \
    if (b->field) h = gn_hash(h, b->field, (components) * sizeof(type) * b->vertex_count);
    GN_ATTRIBUTES(GN_X)
#undef GN_X
    return gn_hash(h, b->indices, sizeof *b->indices * b->index_count);
}

static uint64_t hash_targets(uint64_t h, const struct gn_geometry *geometry) {
    const struct gn_targets *t = geometry->targets;
    const size_t vertices = t ? (size_t)t->count * t->parts * geometry->vertex_count : 0;
    return vertices > 0 ? gn_hash(h, t->deltas, vertices * sizeof *t->deltas) : h;
}

/* seen: the image is in the hash. */
static uint64_t hash_texture(uint64_t h, const struct gn_scene *scene,
                             const struct gn_texture_ref *ref, bool *seen) {
    if (ref->texture < 0) return h;
    const struct gn_texture *t = &scene->pictures.textures[ref->texture];
    const struct gn_image *image = &scene->pictures.images[t->image];
    const uint32_t px[2] = {image->width_px, image->height_px};
    const uint32_t how[] = {t->image, ref->uv_set, (uint32_t)t->wrap_s,      (uint32_t)t->wrap_t,
                            px[0],    px[1],       (uint32_t)image->packing, t->mag_nearest};
    h = gn_hash(h, how, sizeof how);
    h = gn_hash(h, ref->uv_from_uv, sizeof ref->uv_from_uv);
    if (seen[t->image]) return h;
    seen[t->image] = true;
    return image->levels ? gn_hash(h, image->levels, gn_packing_bytes(image->packing, px, 0))
                         : gn_hash(h, image->rgba, 4 * (size_t)px[0] * px[1]);
}

static uint64_t hash_item(uint64_t h, const struct gn_pose *pose, uint32_t i, bool stays,
                          bool *seen) {
    const struct gn_scene *scene = pose->scene;
    const struct gn_item *item = &scene->items[i];
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    const struct gn_material *m = &scene->materials[item->material];
    const uint32_t what[] = {geometry->first_index,
                             geometry->index_count,
                             geometry->first_vertex,
                             geometry->vertex_count,
                             (uint32_t)m->alpha,
                             m->double_sided,
                             m->shadow_catcher,
                             gn_material_is_blended(m),
                             gn_item_is_occluded(scene, item),
                             item->casts,
                             item->stays,
                             stays,
                             pose->items[i].visible};
    const float cut[] = {m->alpha_cutoff, m->base_color[3]};
    h = gn_hash(h, what, sizeof what);
    h = gn_hash(h, cut, sizeof cut);
    h = gn_hash(h, &pose->items[i].hash, sizeof pose->items[i].hash); /* its place, its weights */
    if (m->alpha == GN_ALPHA_MASK) h = hash_texture(h, scene, &m->textures[GN_TEXTURE_BASE], seen);
    if (m->shadow_catcher) h = hash_texture(h, scene, &m->textures[GN_TEXTURE_OCCLUSION], seen);
    return h;
}

uint64_t gn_occlusion_key(const struct gn_scene *scene, int clips, const struct gn_sky *sky) {
    bool *seen = gn_xalloc(scene->pictures.image_count, sizeof *seen);
    struct gn_poses_place *places = gn_xalloc(scene->item_count, sizeof *places);
    struct gn_pose pose;
    gn_pose_init(&pose, scene, clips);
    const int poses = gn_poses_occlusion(&pose, places);
    uint64_t h = gn_hash(GN_HASH_INIT, GN_RAYS_SOURCES, sizeof GN_RAYS_SOURCES);
    h = gn_hash(h, sky, sizeof *sky);
    h = gn_hash(h, &scene->occlusion, sizeof scene->occlusion);
    h = hash_buffers(h, &scene->buffers);
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (places[i].stays) h = hash_targets(h, &scene->geometries[scene->items[i].geometry]);
    for (int p = 0; p < poses; p++) {
        gn_poses_step(&pose, p, poses);
        for (uint32_t i = 0; i < scene->item_count; i++)
            h = hash_item(h, &pose, i, places[i].stays, seen);
    }
    gn_pose_finish(&pose);
    free(places);
    free(seen);
    return h;
}
