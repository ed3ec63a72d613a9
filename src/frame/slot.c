/* A shadow slot: its light, how large a map that may have, and what is remembered of its tiles. */
#include "frame/private.h"
#include "shadow/cascade.h"

void gn_frame_add_plane_slots(struct gn_frame *frame) {
    uint32_t planar = 0;
    for (uint32_t g = 0; g < frame->group_count; g++) {
        struct gn_light_group *group = &frame->groups[g];
        group->plane_count = 0;
        for (uint32_t i = 0; i < group->shadow_count; i++)
            group->plane_count += gn_techniques[frame->lights[group->first + i].technique].on_plane;
        group->first_on_plane[0] = group->first_shadow + group->shadow_count - group->plane_count;
        planar += group->plane_count;
    }
    frame->view_count = frame->shadow_count;
    frame->plane.shown = planar > 0 ? frame->plane.count : 1;
    if (frame->plan.stencil) frame->plane.shown = 1; /* which has no planes */
    while (frame->plane.shown > 1 &&
           frame->shadow_count + (frame->plane.shown - 1) * planar > GN_ALL_SHADOWS_MAX)
        frame->plane.shown--;
    for (uint32_t plane = 1; plane < frame->plane.shown; plane++)
        for (uint32_t g = 0; g < frame->group_count; g++) {
            frame->groups[g].first_on_plane[plane] = frame->view_count;
            frame->view_count += frame->groups[g].plane_count;
        }
}

/* The slot of the same light on the first plane, and which plane it is, from 1. */
static uint32_t first_slot(const struct gn_frame *frame, uint32_t slot, uint32_t *plane) {
    *plane = 1;
    for (uint32_t p = 1; slot >= frame->shadow_count && p < frame->plane.shown; p++)
        for (uint32_t g = 0; g < frame->group_count; g++) {
            const struct gn_light_group *group = &frame->groups[g];
            const uint32_t at = slot - group->first_on_plane[p];
            if (slot < group->first_on_plane[p] || at >= group->plane_count) continue;
            *plane = p + 1;
            return group->first_on_plane[0] + at;
        }
    return slot;
}

uint32_t gn_frame_plane_of_slot(const struct gn_frame *frame, uint32_t slot) {
    uint32_t plane;
    first_slot(frame, slot, &plane);
    return plane;
}

struct gn_frame_light *gn_frame_light_of_slot(struct gn_frame *frame, uint32_t slot) {
    uint32_t plane;
    if (frame->floor.is_apart && slot == frame->floor.slot) return &frame->lights[0];
    /* maps are dealt group by group: only the last group that has any may have fewer than
     * GN_SHADOWS_MAX */
    const uint32_t map = first_slot(frame, slot, &plane);
    return &frame->lights[frame->groups[map / GN_SHADOWS_MAX].first + map % GN_SHADOWS_MAX];
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
