/* KHR_materials_pbrSpecularGlossiness: from its texture to one of roughness, made once at load. The
 * colours of its specular reflection become their mean. */
#include "scene/private.h"

#include <math.h>

#include "core/srgb.h"

enum { SAMPLES = 65536 }; /* of the mean */

static void find_mean(const struct gn_image *image, float mean[3]) {
    const uint64_t texels = (uint64_t)image->width_px * image->height_px;
    const uint64_t step = texels / SAMPLES + 1;
    float linear[256];
    double sum[3] = {0};
    uint64_t count = 0;
    for (int i = 0; i < 256; i++) linear[i] = gn_srgb_decode((float)i / 255);
    for (uint64_t i = 0; i < texels; i += step, count++)
        for (int k = 0; k < 3; k++) sum[k] += (double)linear[image->rgba[4 * i + (uint64_t)k]];
    for (int k = 0; k < 3; k++) mean[k] = (float)(sum[k] / (double)count);
}

/* G: roughness, B: no metal. */
static bool make_rough(struct gn_gltf *g, const struct gn_image *from, float factor,
                       struct gn_image *out) {
    const uint64_t texels = (uint64_t)from->width_px * from->height_px;
    if (!gn_gltf_check_time(g)) return false;
    uint8_t *rgba = gn_gltf_alloc(g, g->memory.scene, texels, 4);
    if (!rgba) return false;
    for (uint64_t i = 0; i < texels; i++) {
        const float gloss = factor * (float)from->rgba[4 * i + 3];
        rgba[4 * i + 1] = (uint8_t)lrintf(255 - gloss);
        rgba[4 * i + 3] = 255;
    }
    g->memory.other_bytes += 4 * (texels + texels / 3);
    *out =
        (struct gn_image){.width_px = from->width_px, .height_px = from->height_px, .rgba = rgba};
    return true;
}

bool gn_gltf_glossiness(struct gn_gltf *g, float factor, int32_t *texture, float mean[3]) {
    struct gn_scene_pictures *pictures = &g->scene->pictures;
    if (!g->pictures.glossy) /* by number in the scene, which has those made, too */
        GN_NEW(g, &g->memory.load, g->pictures.glossy, 2 * (uint64_t)g->file.texture_count);
    if (g->failed) return false;
    struct gn_glossy *known = &g->pictures.glossy[*texture];
    if (!known->made) {
        const struct gn_image *image = &pictures->images[pictures->textures[*texture].image];
        if (!image->rgba) return false; /* compressed into blocks */
        find_mean(image, known->mean);
        if (!make_rough(g, image, factor, &pictures->images[pictures->image_count])) return false;
        known->made = true;
        known->factor = factor;
        known->texture = (int32_t)pictures->texture_count++;
        pictures->textures[known->texture] = pictures->textures[*texture];
        pictures->textures[known->texture].image = pictures->image_count++;
    }
    if (known->factor != factor) return false;
    *texture = known->texture;
    for (int k = 0; k < 3; k++) mean[k] = known->mean[k];
    return true;
}
