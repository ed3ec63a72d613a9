/* A shadow slot: its light, how large a map that may have, and what is remembered of its tiles. */
#include "frame/private.h"
#include "shadow/cascade.h"

/* Maps are dealt group by group: only the last group that has any may have fewer than
 * GN_SHADOWS_MAX. */
struct gn_frame_light *gn_frame_light_of_slot(struct gn_frame *frame, uint32_t slot) {
    return &frame->lights[frame->groups[slot / GN_SHADOWS_MAX].first + slot % GN_SHADOWS_MAX];
}

uint32_t gn_frame_most_px(const struct gn_frame *frame, const struct gn_frame_light *light,
                          uint32_t cascades) {
    uint32_t one_px[2];
    if (cascades > 1)
        gn_cascade_map_size(cascades, 1, one_px);
    else
        gn_shadow_map_size(frame->scene->lights[light->light].type, light->technique, 1, one_px);
    return (uint32_t)frame->caps.max_texture_px / one_px[0];
}

void gn_frame_make_memories(struct gn_frame *frame, uint32_t slot, uint32_t count) {
    struct gn_shadow_memory *memory = frame->memory[slot];
    for (uint32_t i = 0; i < count; i++)
        if (!memory[i].casts) gn_shadow_memory_init(&memory[i], frame->scene->item_count);
}
