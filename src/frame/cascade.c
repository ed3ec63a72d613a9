#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "core/hash.h"
#include "frame/private.h"
#include "shadow/cascade.h"

_Static_assert(CASCADES_SIZE == GN_CASCADES_MAX, "one vec4 each");

#define MOST_PIXELS 2.0f /* that a texel covers, before it is rounded up to a step */
#define NOWHERE     1e9f /* texels from a tile: there is light */

/* Of a surface that faces the eye, at a distance of 1. */
static float pixel_width(const struct gn_frame *frame) {
    const uint32_t size[2] = {frame->plan.width_px, frame->plan.height_px};
    const vec4 *m = frame->eye.clip_from_world;
    float width = INFINITY;
    for (int k = 0; k < 2; k++) {
        vec3 row = {m[0][k], m[1][k], m[2][k]};
        width = fminf(width, 2.0f / ((float)size[k] * glm_vec3_norm(row)));
    }
    return width;
}

/* All that the number goes by, but the eye; nor does it by the technique: modes agree on it,
 * whichever comes first. */
static uint64_t choice_of(const struct gn_frame *frame, const struct gn_shadow_opts *opts) {
    const uint32_t by[] = {opts->map_px,  opts->all_receive,       opts->cascades,
                           frame->camera, frame->picture_width_px, frame->picture_height_px};
    return gn_hash(GN_HASH_INIT, by, sizeof by);
}

/* As few as keep a texel under MOST_PIXELS; where none do, as few as come near to what the best
 * number does. 0: nothing that is seen is in shadow, which says nothing. */
static uint32_t count(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                      const struct gn_shadow_opts *opts) {
    const struct gn_frame_light *of = gn_frame_light_of_slot(frame, slot);
    struct gn_shadow_opts some = {.technique = GN_TECHNIQUE_PCF,
                                  .encoding = GN_ENCODING_R32UI,
                                  .all_receive = opts->all_receive};
    float tangents[GN_CASCADES_MAX + 1] = {0}, least = INFINITY;
    for (some.cascades = 1; some.cascades <= opts->cascades; some.cascades++) {
        const uint32_t most_px = gn_frame_most_px(frame, of, some.cascades);
        some.map_px = opts->map_px < most_px ? opts->map_px : most_px;
        gn_frame_make_memories(frame, slot, some.cascades > 1 ? GN_CASCADE_MEMORIES : 1);
        const float tangent =
            gn_cascade_tangent(pose, of->light, &frame->eye, &some, frame->memory[slot]);
        if (tangent == 0.0f) return 0;
        if (tangent <= MOST_PIXELS * GN_SHADOW_STEP * pixel_width(frame)) return some.cascades;
        tangents[some.cascades] = tangent;
        least = fminf(least, tangent);
    }
    uint32_t chosen = 1;
    while (tangents[chosen] > GN_SHADOW_STEP * least) chosen++;
    return chosen;
}

uint32_t gn_frame_choose_cascades(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                                  const struct gn_shadow_opts *opts) {
    const uint32_t light = gn_frame_light_of_slot(frame, slot)->light;
    struct gn_light_note *note = &frame->notes.at[light];
    const uint64_t choice = choice_of(frame, opts);
    if (!gn_cascade_can(&frame->scene->lights[light], &frame->eye, opts)) return 1;
    for (int i = 0; i < GN_CASCADE_CHOICES; i++)
        if (note->cascades[i].count > 0 && note->cascades[i].choice == choice)
            return note->cascades[i].count;
    const uint32_t chosen = count(frame, pose, slot, opts);
    if (chosen == 0) return 1;
    note->cascades[note->next_choice].choice = choice;
    note->cascades[note->next_choice].count = chosen;
    note->next_choice = (note->next_choice + 1) % GN_CASCADE_CHOICES;
    return chosen;
}

void gn_frame_cascade_constants(const struct gn_shadow_view *view, float (*constants)[4]) {
    const double middle = 0.5 * (double)view->inner_px;
    if (view->cascade_count == 0) return;
    for (uint32_t i = 0; i < GN_CASCADES_MAX; i++) {
        const struct gn_shadow_cascade *cascade = &view->cascades[i];
        const bool empty = i >= view->cascade_count || view->empty || view->tiles[i].empty;
        float *c = constants[i];
        for (int k = 0; k < 2; k++)
            c[k] = empty ? NOWHERE : (float)(-cascade->corner_texels[k] - middle);
        c[2] = empty ? 1.0f : cascade->texel;
        c[3] = view->empty || i + 1 >= view->cascade_count
                   ? 0.0f
                   : 1.0f / (GN_CASCADE_FADE * cascade->end_m);
    }
}

void gn_frame_pass_cascades(const struct gn_frame *frame, const struct gn_light_group *group,
                            struct gn_pass *pass) {
    for (uint32_t i = 0; i < group->shadow_count; i++)
        if (frame->shadows[group->first_shadow + i].cascade_count > 0)
            pass->constant_count = PASS_SIZE;
}
