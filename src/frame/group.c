/* Lights into groups: as many as one pass draws with, the rest in passes that add. A program has at
 * most eight lights, four of them with a map, so that their samplers and constants fit every GPU;
 * passes that add are bounded on the screen, so the lights that reach farthest go first. */
#include <string.h>

#include "frame/private.h"

/* 0: all of the scene, 1: a cone, 2: a ball, too. By kind alone: it does not change with the pose.
 */
static int rank_of(const struct gn_frame *frame, const struct gn_frame_light *light) {
    const struct gn_light *l = &frame->scene->lights[light->light];
    const struct gn_light_type_row *type = &gn_light_types[l->type];
    return type->has_cone + (type->has_position && (l->range_m > 0.0f || l->range_moves));
}

/* 1: for the plane alone. Last of those with maps, so that other items can leave it out. */
static int is_for_plane(const struct gn_frame *frame, const struct gn_frame_light *light) {
    (void)frame;
    return gn_techniques[light->technique].on_plane;
}

/* Insertion sort: stable, and they are few. */
static void sort_lights(struct gn_frame *frame, uint32_t first, uint32_t end,
                        int (*rank)(const struct gn_frame *, const struct gn_frame_light *)) {
    for (uint32_t i = first + 1; i < end; i++) {
        struct gn_frame_light light = frame->lights[i];
        uint32_t at = i;
        for (; at > first && rank(frame, &frame->lights[at - 1]) > rank(frame, &light); at--)
            frame->lights[at] = frame->lights[at - 1];
        frame->lights[at] = light;
    }
}

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

void gn_frame_group_lights(struct gn_frame *frame, const struct gn_pose *pose) {
    memset(frame->groups, 0, sizeof frame->groups);
    frame->group_count = 0;
    if (frame->light_count > GN_LIGHTS_MAX || frame->shadow_count > GN_SHADOWS_MAX) {
        sort_lights(frame, 0, frame->shadow_count, rank_of);
        sort_lights(frame, frame->shadow_count, frame->light_count, rank_of);
    }
    /* From "all with maps, then all without" to one group after the other. */
    struct gn_frame_light dealt[GN_ALL_LIGHTS_MAX];
    uint32_t count = 0, map = 0, open = frame->shadow_count;
    for (; count < frame->light_count; frame->group_count++) {
        struct gn_light_group *g = &frame->groups[frame->group_count];
        g->first = count;
        g->first_shadow = map;
        g->shadow_count = least(frame->shadow_count - map, GN_SHADOWS_MAX);
        g->count =
            g->shadow_count + least(frame->light_count - open, GN_LIGHTS_MAX - g->shadow_count);
        for (; count < g->first + g->shadow_count; count++) dealt[count] = frame->lights[map++];
        for (; count < g->first + g->count; count++) dealt[count] = frame->lights[open++];
    }
    memcpy(frame->lights, dealt, count * sizeof *dealt);
    if (frame->group_count == 0) frame->group_count = 1;
    for (uint32_t g = 0; g < frame->group_count; g++) {
        const uint32_t first = frame->groups[g].first;
        sort_lights(frame, first, first + frame->groups[g].shadow_count, is_for_plane);
    }
    for (uint32_t i = 0; i < frame->light_count; i++)
        frame->scene_lights[i] = frame->lights[i].light;
    for (uint32_t g = 1; g < frame->group_count; g++)
        for (uint32_t i = 0; i < frame->groups[g].count; i++)
            gn_reach_build(&frame->groups[g].reaches[i], pose,
                           frame->lights[frame->groups[g].first + i].light);
}

void gn_frame_bound_groups(struct gn_frame *frame) {
    for (uint32_t i = 1; i < frame->group_count; i++) {
        struct gn_light_group *g = &frame->groups[i];
        struct gn_reach_rect r = {0};
        for (uint32_t k = 0; k < g->count; k++)
            r = gn_reach_rect_unite(r, gn_reach_rect(&g->reaches[k], &frame->eye,
                                                     frame->plan.width_px, frame->plan.height_px));
        const uint32_t width = (uint32_t)(r.x1 - r.x0), height = (uint32_t)(r.y1 - r.y0);
        g->seen = r.x0 < r.x1 && r.y0 < r.y1;
        g->rect = (struct gn_rect){(uint32_t)r.x0, (uint32_t)r.y0, width, height};
        if (width == frame->plan.width_px && height == frame->plan.height_px)
            g->rect = (struct gn_rect){0};
    }
}

bool gn_group_touches(const struct gn_light_group *group, const struct gn_box *box_ws) {
    for (uint32_t i = 0; i < group->count; i++)
        if (gn_reach_touches(&group->reaches[i], box_ws)) return true;
    return false;
}
