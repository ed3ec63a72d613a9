/* What a scene takes on the GPU, counted before anything is uploaded. */
#include "scene/private.h"

#include <inttypes.h>
#include <math.h>

#define CUTOFF_STEP (2.0f / 255.0f) /* cutoffs nearer than this share a texture */

static void mark_use(struct gn_scene *scene, int32_t texture, bool color, bool mask) {
    if (texture < 0) return;
    const struct gn_texture *t = &scene->pictures.textures[texture];
    struct gn_image *image = &scene->pictures.images[t->image];
    if (!mask) *(color ? &image->as_color : &image->as_data) = true;
    image->mipmaps |= t->mipmaps;
}

static struct gn_image *base_image(const struct gn_scene *scene, const struct gn_material *m) {
    const int32_t texture = m->textures[GN_TEXTURE_BASE].texture;
    if (texture < 0) return NULL;
    return &scene->pictures.images[scene->pictures.textures[texture].image];
}

/* What the texture's alpha must be at least where vertices have no alpha of their own. */
static float cutoff_of(const struct gn_material *m) {
    return gn_material_least_alpha(m) / m->base_color[3];
}

int gn_scene_find_cutoff(const struct gn_scene *scene, const struct gn_material *m,
                         enum gn_texture_slot slot) {
    if (slot != GN_TEXTURE_BASE || m->alpha != GN_ALPHA_MASK) return -1;
    const struct gn_image *image = base_image(scene, m);
    int nearest = image && image->cutoff_count > 0 ? 0 : -1;
    for (int i = 1; nearest >= 0 && i < (int)image->cutoff_count; i++)
        if (fabsf(image->cutoffs[i] - cutoff_of(m)) < fabsf(image->cutoffs[nearest] - cutoff_of(m)))
            nearest = i;
    return nearest;
}

static void mark_cutoff(struct gn_scene *scene, const struct gn_material *m) {
    struct gn_image *image = base_image(scene, m);
    const float cutoff = cutoff_of(m);
    if (m->alpha != GN_ALPHA_MASK || !image || image->levels || !image->has_alpha) return;
    if (!(cutoff > 0.0f && cutoff <= 1.0f)) return; /* all of it shows, or nothing */
    for (uint32_t i = 0; i < image->cutoff_count; i++)
        if (fabsf(image->cutoffs[i] - cutoff) < CUTOFF_STEP) return;
    if (image->cutoff_count < GN_CUTOFFS_MAX) image->cutoffs[image->cutoff_count++] = cutoff;
}

uint64_t gn_scene_image_bytes(const struct gn_image *image) {
    const uint64_t texels = (uint64_t)image->width_px * image->height_px;
    uint64_t bytes = texels * 4 * (image->mipmaps ? 4 : 3) / 3;
    if (image->levels)
        bytes =
            gn_packing_all_bytes(image->packing, (uint32_t[]){image->width_px, image->height_px},
                                 image->mipmaps ? image->level_count : 1);
    return (uint64_t)(image->as_data + image->as_color + image->cutoff_count) * bytes;
}

uint64_t gn_scene_index_bytes(const struct gn_scene *scene) {
    return (uint64_t)scene->buffers.index_count * (scene->buffers.vertex_count > 65536 ? 4 : 2);
}

uint64_t gn_scene_deformation_bytes(const struct gn_scene *scene) {
    const struct gn_scene_deformation *d = &scene->deformation;
    const uint64_t rows = (d->delta_texels + GN_DELTAS_WIDTH - 1) / GN_DELTAS_WIDTH;
    return sizeof(vec4) * (rows * GN_DELTAS_WIDTH + (uint64_t)3 * d->width * d->height);
}

/* The longest side with which textures are within so many bytes; they are over that. */
static uint32_t fit_textures(const struct gn_scene *scene, uint64_t most_bytes) {
    uint32_t px = 0;
    uint64_t bytes = UINT64_MAX;
    for (uint32_t i = 0; i < scene->pictures.image_count; i++) {
        const struct gn_image *image = &scene->pictures.images[i];
        if (image->width_px > px) px = image->width_px;
        if (image->height_px > px) px = image->height_px;
    }
    while (bytes > most_bytes && px > 1) {
        px = (px + 1) / 2;
        bytes = 0;
        for (uint32_t i = 0; i < scene->pictures.image_count; i++) {
            const struct gn_image *image = &scene->pictures.images[i];
            const uint32_t sides[2] = {image->width_px, image->height_px};
            bytes += gn_scene_image_bytes(image) >> 2 * gn_gltf_halvings(sides, px);
        }
    }
    return px;
}

uint64_t gn_scene_gpu_bytes(const struct gn_scene *s) {
    uint64_t bytes = gn_scene_index_bytes(s) + gn_scene_deformation_bytes(s) +
                     (uint64_t)gn_scene_vertex_bytes(s) * s->buffers.vertex_count;
    for (uint32_t i = 0; i < s->pictures.image_count; i++)
        bytes += gn_scene_image_bytes(&s->pictures.images[i]);
    return bytes;
}

bool gn_scene_count_gpu(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    for (uint32_t i = 0; i < scene->material_count; i++) mark_cutoff(scene, &scene->materials[i]);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        uint32_t textures = 0;
        for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++) {
            mark_use(scene, scene->materials[i].textures[slot].texture,
                     gn_texture_slots[slot].texels == GN_TEXELS_SRGB,
                     gn_scene_find_cutoff(scene, &scene->materials[i], slot) >= 0);
            textures += scene->materials[i].textures[slot].texture >= 0;
        }
        if (textures > scene->material_textures) scene->material_textures = textures;
    }
    for (uint32_t i = 0; i < scene->light_count; i++)
        mark_use(scene, scene->lights[i].slide, true, false);
    uint64_t textures = 0,
             buffers = gn_scene_index_bytes(scene) + gn_scene_deformation_bytes(scene) +
                       (uint64_t)gn_scene_vertex_bytes(scene) * scene->buffers.vertex_count;
    for (uint32_t i = 0; i < scene->pictures.image_count; i++)
        textures += gn_scene_image_bytes(&scene->pictures.images[i]);
    const uint64_t most_mb = g->limits.gpu_mb;
    if (textures + buffers <= most_mb << 20) return true;
    if (buffers < most_mb << 20 && gn_gltf_halve_pictures(g, "gpu_mb", most_mb))
        g->pictures.fit_px = fit_textures(scene, (most_mb << 20) - buffers);
    return gn_gltf_fail(g, NULL,
                        "textures of %" PRIu64 " MB and buffers of %" PRIu64
                        " MB are over the limit gpu_mb=%" PRIu64,
                        (textures + 1048575) >> 20, (buffers + 1048575) >> 20, most_mb);
}
