#include <math.h>

#include "core/hash.h"
#include "frame/private.h"
#include "shadow/cascade.h"

#define MOST_PIXELS 2.0f /* that a texel covers, before it is rounded up to a step */
#define TOO_COARSE  2.0f /* times that: the camera has moved to where more cascades are worth it */

/* The cameras that the number is chosen for: the current one, and those on the path of an animated
 * camera. */
struct views {
    struct gn_frame *frame;
    const struct gn_frame_opts *opts;
    const struct gn_pose *now;
    struct gn_pose other; /* made when it is needed */
    bool moves;
    int64_t lasts_ns; /* the path */
    int count;
};
enum { OTHERS = 8 };

/* How many pixels a texel of so many cascades covers where it is seen largest; 0: unknown, the
 * camera sees no shadow. */
static float texel_pixels(struct views *v, uint32_t slot, const struct gn_shadow_opts *opts,
                          uint32_t cascades) {
    const struct gn_frame_light *light = gn_frame_light_of_slot(v->frame, slot);
    const uint32_t most_px = gn_frame_most_px(v->frame, light, cascades);
    const struct gn_shadow_opts some = {.technique = GN_TECHNIQUE_PCF,
                                        .encoding = GN_ENCODING_R32UI,
                                        .map_px = opts->map_px < most_px ? opts->map_px : most_px,
                                        .all_receive = opts->all_receive,
                                        .cascades = cascades};
    float most = 0.0f;
    gn_frame_make_memories(v->frame, slot, cascades > 1 ? GN_CASCADE_MEMORIES : 1);
    for (int i = 0; i < v->count; i++) {
        struct gn_eye eye = v->frame->eye;
        const struct gn_pose *pose = v->now;
        if (i > 0) { /* not the current camera */
            if (!v->other.scene) gn_pose_init(&v->other, v->frame->scene, v->now->at.clips);
            if (v->now->at.over != v->other.at.over)
                gn_pose_choose_over(&v->other, v->now->at.clips, v->now->at.over);
            if (v->now->aimed) gn_pose_aim(&v->other, v->now->aim_ws);
            const int64_t ns = v->lasts_ns / (OTHERS - 1) * (i - 1);
            const bool last = i == OTHERS && ns > 0; /* the end of the path, too */
            v->other.at.over_ns = last ? v->lasts_ns - 1 : ns;
            gn_pose_step(&v->other, v->other.at.over_ns);
            gn_frame_eye_at(v->frame, &v->other, v->opts, &eye);
            pose = &v->other;
        }
        const float tangent =
            gn_cascade_tangent(pose, light->light, &eye, &some, v->frame->memory[slot]);
        if (i == 0 && tangent == 0.0f) return 0.0f;
        /* The width of a pixel on a surface that faces the camera at a distance of 1 m. */
        const uint32_t size[2] = {v->frame->plan.width_px, v->frame->plan.height_px};
        float pixel = INFINITY;
        for (int k = 0; k < 2; k++) {
            vec3 row = {eye.clip_from_world[0][k], eye.clip_from_world[1][k],
                        eye.clip_from_world[2][k]};
            pixel = fminf(pixel, 2.0f / ((float)size[k] * glm_vec3_norm(row)));
        }
        most = fmaxf(most, tangent / pixel);
    }
    return most;
}

/* As few as keep a texel under MOST_PIXELS; if none do, as few as come near to the best number. 0:
 * not known yet. */
static uint32_t count_cascades(struct views *v, uint32_t slot, const struct gn_shadow_opts *opts) {
    float pixels[GN_CASCADES_MAX + 1] = {0}, least = INFINITY;
    for (uint32_t cascades = 1; cascades <= opts->cascades; cascades++) {
        pixels[cascades] = texel_pixels(v, slot, opts, cascades);
        if (pixels[cascades] == 0.0f) return 0;
        if (pixels[cascades] <= MOST_PIXELS * GN_SHADOW_STEP) return cascades;
        least = fminf(least, pixels[cascades]);
    }
    uint32_t chosen = 1;
    while (pixels[chosen] > GN_SHADOW_STEP * least) chosen++;
    return chosen;
}

/* The user may move the camera to where the first choice is far too coarse. The number only grows:
 * each change needs programs and targets. If more cascades do not help, this is not tried again
 * until texels are twice as large, nor while the camera rests. */
static void judge_cascades(struct gn_frame *frame, const struct gn_pose *pose,
                           const struct gn_frame_opts *frame_opts, uint32_t slot,
                           const struct gn_shadow_opts *opts, struct gn_cascade_choice *c) {
    const struct gn_orbit *orbit = &frame_opts->view.orbit;
    if (c->count >= opts->cascades || gn_orbit_is_zero(orbit)) return;
    const uint64_t by = gn_hash(GN_HASH_INIT, orbit, sizeof *orbit);
    if (by == c->judged) return;
    c->judged = by;
    struct views now = {.frame = frame, .opts = frame_opts, .now = pose, .count = 1};
    const float pixels = texel_pixels(&now, slot, opts, c->count);
    if (pixels <= fmaxf(TOO_COARSE * MOST_PIXELS, c->borne_px)) return;
    const uint32_t chosen = count_cascades(&now, slot, opts);
    c->borne_px = chosen > c->count ? 0.0f : 2.0f * pixels;
    if (chosen > c->count) c->count = chosen;
}

uint32_t gn_frame_choose_cascades(struct gn_frame *frame, const struct gn_pose *pose,
                                  const struct gn_frame_opts *frame_opts, uint32_t slot,
                                  const struct gn_shadow_opts *opts) {
    const struct gn_scene *scene = frame->scene;
    const uint32_t light = gn_frame_light_of_slot(frame, slot)->light;
    struct gn_light_note *note = &frame->notes.lights.at[light];
    if (!gn_cascade_can(&scene->lights[light], &frame->eye, opts)) return 1;

    struct views v = {.frame = frame, .opts = frame_opts, .now = pose, .count = 1};
    const uint32_t from = frame_opts->view.light_plus_1;
    v.moves = pose->node_moves[from ? scene->lights[from - 1].node
                                    : scene->cameras[frame_opts->view.camera].node];
    v.moves |= !from && pose->cameras != scene->cameras; /* it zooms, too */

    /* What the choice depends on, except the camera's position. The technique is not part of it:
     * modes agree on the number, whichever comes first. */
    const uint32_t by[] = {opts->map_px,
                           opts->all_receive,
                           opts->cascades,
                           frame->camera,
                           frame->picture.width_px,
                           frame->picture.height_px,
                           (uint32_t)pose->at.clips,
                           (uint32_t)(v.moves ? pose->at.over : -1)};
    const uint64_t choice = gn_hash(GN_HASH_INIT, by, sizeof by);
    for (struct gn_cascade_choice *c = note->cascades; c < note->cascades + GN_CASCADE_CHOICES; c++)
        if (c->count > 0 && c->choice == choice) {
            judge_cascades(frame, pose, frame_opts, slot, opts, c);
            return c->count;
        }

    for (uint32_t i = 0; i < scene->animation.clip_count && v.moves; i++)
        if (scene->animation.clips[i].duration_ns > v.lasts_ns)
            v.lasts_ns = scene->animation.clips[i].duration_ns;
    if (v.moves) v.count += OTHERS;
    const uint32_t chosen = count_cascades(&v, slot, opts);
    if (v.other.scene) gn_pose_finish(&v.other);
    if (chosen == 0) return 1;
    note->cascades[note->next_choice] =
        (struct gn_cascade_choice){.choice = choice, .count = chosen};
    note->next_choice = (note->next_choice + 1) % GN_CASCADE_CHOICES;
    return chosen;
}
