/* Pictures of KTX2 that the GPU gets as the file has them: blocks of ETC2 and EAC, and levels that
 * somebody made with care. */
#include "scene/private.h"

#include <inttypes.h>

/* The first level whose sides are within texture_px, or the last one. */
static uint32_t first_level(const struct gn_gltf *g, const struct gn_ktx2 *ktx2) {
    const uint32_t level = gn_gltf_halvings(ktx2->px, g->limits.texture_px);
    return level < ktx2->level_count ? level : ktx2->level_count - 1;
}

/* Levels from that one on. */
static struct gn_picture_need need_of(const struct gn_ktx2 *ktx2, uint32_t first) {
    struct gn_picture_need need = {.decoding = gn_ktx2_level_work_bytes(ktx2)};
    for (int k = 0; k < 2; k++) need.px[k] = gn_level_px(ktx2->px[k], first);
    need.kept = need.on_gpu =
        gn_packing_all_bytes(ktx2->packing, need.px, ktx2->level_count - first);
    for (int i = 0; i < GN_HALVINGS && first + 1 < ktx2->level_count; i++)
        need.halved[i] = need.decoding + 1;
    need.work = gn_gltf_picture_work(need.px);
    return need;
}

bool gn_gltf_levels(struct gn_gltf *g, const struct gn_blob *blob, const struct gn_ktx2 *ktx2,
                    struct gn_image *image, struct gn_err *err) {
    const uint32_t first = first_level(g, ktx2), count = ktx2->level_count - first;
    const struct gn_picture_need need = need_of(ktx2, first), whole = need_of(ktx2, 0);
    if (!gn_gltf_picture_fits(g, &need, &whole, err)) return false;
    uint8_t *levels = gn_gltf_alloc(g, g->memory.scene, need.kept, 1);
    if (!levels || !gn_gltf_check_time(g)) return false;
    if (!gn_ktx2_read_levels(blob->data, blob->size, ktx2, first, levels, err)) {
        g->damaged_work += need.work;
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
