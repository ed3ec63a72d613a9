/* Pictures of KTX2 that the GPU gets as the file has them: blocks of ETC2 and EAC, and levels that
 * somebody made with care. */
#include "scene/private.h"

#include <inttypes.h>

uint32_t gn_gltf_first_level(const struct gn_gltf *g, const uint32_t px[2], uint32_t count) {
    const uint32_t longer = px[0] > px[1] ? px[0] : px[1], most = g->limits.texture_px;
    uint32_t level = 0;
    while (most > 0 && level + 1 < count && gn_level_px(longer, level) > most) level++;
    return level;
}

bool gn_gltf_levels(struct gn_gltf *g, const struct gn_blob *blob, const struct gn_ktx2 *ktx2,
                    struct gn_image *image, struct gn_err *err) {
    const uint32_t first = gn_gltf_first_level(g, ktx2->px, ktx2->level_count),
                   count = ktx2->level_count - first;
    struct gn_picture_need need = {.decoding = gn_ktx2_level_work_bytes(ktx2)};
    for (int k = 0; k < 2; k++) need.px[k] = gn_level_px(ktx2->px[k], first);
    need.kept = need.on_gpu = gn_packing_all_bytes(ktx2->packing, need.px, count);
    if (!gn_gltf_picture_fits(g, &need, err)) return false;
    uint8_t *levels = gn_gltf_alloc(g, g->memory.scene, need.kept, 1);
    if (!levels || !gn_gltf_check_time(g)) return false;
    if (!gn_ktx2_read_levels(blob->data, blob->size, ktx2, first, levels, err)) {
        g->damaged_work += gn_gltf_picture_work(&need);
        gn_arena_undo(g->memory.scene, levels, need.kept);
        return false;
    }
    gn_gltf_picture_count(g, &need);
    *image = (struct gn_image){.width_px = need.px[0],
                               .height_px = need.px[1],
                               .rgba = ktx2->packing == GN_PACKING_RGBA8 ? levels : NULL,
                               .levels = levels,
                               .packing = ktx2->packing,
                               .level_count = count,
                               .has_alpha = gn_packing_has_alpha(ktx2->packing, levels, need.px)};
    return true;
}
