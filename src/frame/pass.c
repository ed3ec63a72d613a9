/* What passes are made of: the builder's lists and constants, programs, passes and their bare
 * draws. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "frame/private.h"

void *gn_list_grow(void *at, uint32_t count, uint32_t *room, size_t size) {
    if (count < *room) return at;
    *room = *room ? 2 * *room : 64;
    return gn_xrealloc(at, *room, size);
}

float (*gn_frame_constants(const struct gn_frame *frame, uint32_t which))[4] {
    return frame->constants + (size_t)which * GN_PASS_SIZE;
}

uint32_t gn_frame_program(struct gn_frame *frame, const struct gn_program_key *key) {
    for (uint32_t i = 0; i < frame->programs.count; i++)
        if (memcmp(&frame->programs.at[i], key, sizeof *key) == 0) return i;
    GN_LIST_PUSH(&frame->programs) = *key;
    return frame->programs.count - 1;
}

struct gn_pass *gn_frame_begin_pass(struct gn_frame *frame, enum gn_pass_kind kind) {
    struct gn_pass *pass = &GN_LIST_PUSH(&frame->passes);
    *pass = (struct gn_pass){.kind = kind,
                             .first_draw = frame->draws.count,
                             .depth_write = true,
                             .constant_count = PASS_SLIDES};
    return pass;
}

void gn_frame_end_pass(struct gn_frame *frame) {
    struct gn_pass *pass = &frame->passes.at[frame->passes.count - 1];
    pass->draw_count = frame->draws.count - pass->first_draw;
}

void gn_frame_draw_bare(struct gn_frame *frame, const struct gn_program_key *key,
                        uint32_t vertex_count, uint32_t first_instance, uint32_t instance_count) {
    uint32_t program = gn_frame_program(frame, key);
    GN_LIST_PUSH(&frame->draws) = (struct gn_draw){.program = program,
                                                   .geometry = GN_NO_GEOMETRY,
                                                   .vertex_count = vertex_count,
                                                   .first_instance = first_instance,
                                                   .instance_count = instance_count};
}

/* ---- passes of the picture ---- */

struct gn_pass *gn_frame_picture_pass(struct gn_frame *frame, const char *label) {
    struct gn_pass *pass = gn_frame_begin_pass(frame, GN_PASS_PICTURE);
    snprintf(pass->label, sizeof pass->label, "%s", label);
    pass->target = (struct gn_target){.kind = GN_TARGET_OUTPUT,
                                      .width_px = frame->plan.width_px,
                                      .height_px = frame->plan.height_px};
    return pass;
}

uint32_t gn_frame_scaled_px(uint32_t px, float scale) {
    const uint32_t scaled = 2 * (uint32_t)lroundf(0.5f * scale * (float)px);
    return scaled < 2 ? px : scaled < px ? scaled : px;
}

void gn_frame_to_shown(const struct gn_frame *frame, struct gn_pass *pass) {
    if (!gn_plan_scales(&frame->plan)) return;
    pass->target = (struct gn_target){.kind = GN_TARGET_SCALED,
                                      .width_px = frame->plan.shown_width_px,
                                      .height_px = frame->plan.shown_height_px};
}

struct gn_pass *gn_frame_lit_pass(struct gn_frame *frame, const char *label, uint32_t group) {
    const struct gn_light_group *g = &frame->groups[group];
    struct gn_pass *pass = gn_frame_picture_pass(frame, label);
    pass->constants = gn_frame_constants(frame, GN_CONSTANTS_PICTURE + group);
    pass->picture.first_light = g->first;
    pass->picture.light_count = g->count;
    pass->picture.first_shadow = g->first_shadow;
    pass->picture.shadow_count = g->shadow_count;
    pass->picture.plane_count = g->plane_count;
    pass->picture.first_on_plane = g->first_on_plane[0];
    for (uint32_t i = g->first; i < g->first + g->count; i++)
        if (frame->lights[i].slide != GN_SLIDE_NONE)
            pass->picture.slides[pass->picture.slide_count++] =
                (uint32_t)frame->scene->lights[frame->lights[i].light].slide;
    /* The constants of slides follow those of shadows; those of cascades come last. */
    if (pass->picture.slide_count > 0) pass->constant_count = PASS_CASCADES;
    for (uint32_t i = 0; i < g->shadow_count; i++)
        if (frame->shadows[g->first_shadow + i].map.cascade_count > 0)
            pass->constant_count = PASS_ENVIRONMENT;
    if (group == 0 && (frame->plan.environment.light || frame->plan.occlusion.on))
        pass->constant_count = PASS_SIZE;
    if (group == 0) return pass;
    snprintf(pass->label, sizeof pass->label, "%s%slights %u-%u", label, *label ? " " : "",
             g->first + 1, g->first + g->count);
    pass->picture.blend = GN_BLEND_ADD;
    pass->depth_write = false;
    pass->rect = g->rect;
    return pass;
}

void gn_frame_set_plane(struct gn_frame *frame, struct gn_pass *pass, uint32_t group,
                        uint32_t plane) {
    const struct gn_light_group *g = &frame->groups[group];
    const size_t of_pass = GN_PASS_SIZE * sizeof *frame->plane.constants;
    if (!frame->plane.constants)
        frame->plane.constants = gn_xalloc(GN_GROUPS_MAX * (GN_PLANES_MAX - 1), of_pass);
    float(*c)[4] =
        frame->plane.constants + (size_t)(group * (GN_PLANES_MAX - 1) + plane - 2) * GN_PASS_SIZE;
    memcpy(c, pass->constants, of_pass);
    pass->constants = c;
    pass->picture.first_on_plane = g->first_on_plane[plane - 1];
    for (uint32_t i = g->shadow_count - g->plane_count; i < g->shadow_count; i++)
        gn_frame_reader_constants(&frame->shadows[gn_pass_slot(&pass->picture, i)], i, c);
}
