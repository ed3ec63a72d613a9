#include <cglm/cglm.h>
#include <math.h>

#include "core/hash.h"
#include "frame/private.h"
#include "shadow/cascade.h"

#define MOST_PIXELS 2.0f /* that a texel covers, before it is rounded up to a step */
#define TOO_COARSE  2.0f /* times that: the camera has moved to where more cascades are worth it */
#define FIXED_WORSE 1.5f /* a map that stays as it is may have texels so much larger */

enum {
    WIDEST_PX = 2048, /* of a fixed map in place of one that the camera moves, or of cascades */
    WIDEST_BYTES = 32 << 20 /* about what such a map takes, filtered */
};

/* The cameras that the number is chosen for: the current one, and those on the path of an animated
 * camera. */
struct views {
    struct gn_frame *frame;
    const struct gn_frame_opts *opts;
    const struct gn_pose *now;
    struct gn_pose other; /* made when it is needed */
    bool stands;          /* the light, and what casts: only the camera moves */
    bool moves;           /* the camera, by a clip */
    int64_t lasts_ns;     /* the path */
    int count;
};
enum { OTHERS = 8, TURNS = 8, MANY_ITEMS = 10000 };

/* Whether its texels are measured as pixels; others are compared with each other. */
static bool is_seen_as_pixels(const struct views *v, uint32_t slot,
                              const struct gn_shadow_opts *opts) {
    const uint32_t light = gn_frame_light_of_slot(v->frame, slot)->light;
    return !gn_light_types[v->frame->scene->lights[light].type].has_position &&
           !gn_techniques[opts->technique].on_plane;
}

/* A fit that measures such a map: of all techniques alike, but of those on a plane. */
static struct gn_shadow_opts measured(const struct views *v, uint32_t slot,
                                      const struct gn_shadow_opts *opts, struct gn_map_choice map) {
    const struct gn_frame_light *light = gn_frame_light_of_slot(v->frame, slot);
    const uint32_t most_px = gn_frame_most_px(v->frame, light, map.cascades);
    gn_frame_make_memories(v->frame, slot, map.cascades > 1 ? GN_CASCADE_MEMORIES : 1);
    const bool on_plane = gn_techniques[opts->technique].on_plane;
    return (struct gn_shadow_opts){.technique = on_plane ? opts->technique : GN_TECHNIQUE_PCF,
                                   .encoding = on_plane ? opts->encoding : GN_ENCODING_R32UI,
                                   .plane = opts->plane,
                                   .points = opts->points,
                                   .whole = map.fixed,
                                   .map_px = map.px < most_px ? map.px : most_px,
                                   .all_receive = opts->all_receive,
                                   .but_floor = opts->but_floor,
                                   .fixed = map.fixed,
                                   .cascades = map.cascades};
}

/* How many pixels a texel of such a map covers where it is seen largest (or in proportion);
 * 0: unknown, the camera sees no shadow. */
static float texel_pixels(struct views *v, uint32_t slot, const struct gn_shadow_opts *opts,
                          struct gn_map_choice map) {
    const uint32_t light = gn_frame_light_of_slot(v->frame, slot)->light;
    const struct gn_shadow_opts some = measured(v, slot, opts, map);
    float most = 0.0f;
    for (int i = 0; i < v->count; i++) {
        struct gn_eye eye = v->frame->eye;
        const struct gn_pose *pose = v->now;
        if (i > 0) { /* not the current camera */
            if (!v->other.scene) gn_pose_init(&v->other, v->frame->scene, v->now->at.clips);
            if (v->now->at.over != v->other.at.over)
                gn_pose_choose_over(&v->other, v->now->at.clips, v->now->at.over);
            if (v->now->aimed) gn_pose_aim(&v->other, v->now->aimed_light, v->now->aim_ws);
            const int64_t ns = v->lasts_ns / (OTHERS - 1) * (i - 1);
            const bool last = i == OTHERS && ns > 0; /* the end of the path, too */
            v->other.at.over_ns = last ? v->lasts_ns - 1 : ns;
            gn_pose_step(&v->other, v->other.at.over_ns);
            gn_frame_eye_at(v->frame, &v->other, v->opts, &eye);
            pose = &v->other;
        }
        const float tangent = gn_cascade_tangent(pose, light, &eye, &some, v->frame->memory[slot]);
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

/* As few cascades as keep a texel under MOST_PIXELS; if none do, as few as come near to the best
 * number. Returns what a texel covers then; 0: not known yet. */
static float count_cascades(struct views *v, uint32_t slot, const struct gn_shadow_opts *opts,
                            struct gn_map_choice *map) {
    float pixels[GN_CASCADES_MAX + 1] = {0}, least = INFINITY;
    *map = (struct gn_map_choice){.cascades = 1, .px = opts->map_px};
    for (uint32_t cascades = 1; cascades <= opts->cascades; cascades++) {
        map->cascades = cascades;
        pixels[cascades] = texel_pixels(v, slot, opts, *map);
        if (pixels[cascades] == 0.0f || pixels[cascades] <= MOST_PIXELS * GN_SHADOW_STEP)
            return pixels[cascades];
        least = fminf(least, pixels[cascades]);
    }
    map->cascades = 1;
    while (pixels[map->cascades] > GN_SHADOW_STEP * least) map->cascades++;
    return pixels[map->cascades];
}

/* Whether a map may be wider than its technique has it. What moves is drawn and filtered in each
 * frame: there only cascades that are not filtered are worth that. A mean of many shadows is
 * smooth. */
static bool may_widen(const struct views *v, const struct gn_shadow_opts *opts,
                      const struct gn_map_choice *map) {
    const uint64_t most_bytes = v->opts->shadow.maps_bytes;
    return opts->light.map_px == 0 && opts->encoding != GN_ENCODING_MEAN &&
           (most_bytes == 0 || v->frame->view_count * (uint64_t)WIDEST_BYTES <= most_bytes) &&
           (v->stands || (map->cascades > 1 && !gn_technique_replaces_map(opts->technique)));
}

/* Whether one map that follows the camera would have finer texels somewhere on a turntable; of very
 * many items, for which that takes long, it is assumed. */
static bool is_coarse_in_a_turn(const struct views *v, uint32_t slot,
                                const struct gn_shadow_opts *opts, struct gn_map_choice fixed) {
    const uint32_t light = gn_frame_light_of_slot(v->frame, slot)->light;
    const struct gn_map_choice follows = {.cascades = 1, .px = opts->map_px};
    struct gn_frame_opts turned = *v->opts;
    struct gn_eye eye = v->frame->eye;
    struct gn_shadow_view view;
    struct gn_shadow_opts some = measured(v, slot, opts, fixed);
    if (v->frame->scene->item_count > MANY_ITEMS) return true;
    if (!gn_shadow_fit(v->now, light, &eye, &some, v->frame->memory[slot], &view)) return false;
    some = measured(v, slot, opts, follows);
    for (int i = 1; i < TURNS; i++) {
        struct gn_shadow_view finer;
        turned.view.turntable_rad = v->opts->view.turntable_rad + 2 * GLM_PIf * (float)i / TURNS;
        gn_frame_eye_at(v->frame, v->now, &turned, &eye);
        if (gn_shadow_fit(v->now, light, &eye, &some, v->frame->memory[slot], &finer) &&
            view.lookup.texel > finer.lookup.texel)
            return true;
    }
    return false;
}

/* A filtered map of a size that is given loses light under lattices by larger texels. */
static bool may_be_worse(const struct gn_shadow_opts *opts) {
    return opts->light.map_px == 0 || !gn_technique_replaces_map(opts->technique);
}

/* The best map of those that follow the camera; or one that stays as it is, if its texels are not
 * much larger: of the same size or, where that is left open, as wide as makes them no larger.
 * False: not known yet. */
static bool choose_map(struct views *v, uint32_t slot, const struct gn_shadow_opts *opts,
                       struct gn_map_choice *map) {
    const struct gn_frame_light *light = gn_frame_light_of_slot(v->frame, slot);
    const float best = count_cascades(v, slot, opts, map);
    const bool has_cascades = map->cascades > 1;
    const uint32_t wide_px = may_widen(v, opts, map) ? WIDEST_PX : 0,
                   most_px = gn_frame_most_px(v->frame, light, 1);
    const float worse = may_be_worse(opts) ? FIXED_WORSE : 1.0f;
    struct gn_map_choice fixed = {.cascades = 1, .px = opts->map_px, .fixed = true};
    if (best == 0.0f) return false;
    if (!v->stands && !is_seen_as_pixels(v, slot, opts)) return true;
    for (bool is_coarse = true; is_coarse; fixed.px *= 2) {
        const float pixels = texel_pixels(v, slot, opts, fixed);
        if (pixels <= worse * best) *map = fixed;
        is_coarse = 2 * fixed.px <= wide_px && 2 * fixed.px <= most_px &&
                    (pixels > best || (!has_cascades && is_coarse_in_a_turn(v, slot, opts, fixed)));
    }
    return true;
}

/* Whether such a map is good enough for where the user has moved the camera. */
static bool is_borne(struct views *now, uint32_t slot, const struct gn_shadow_opts *opts,
                     const struct gn_cascade_choice *c, float *pixels) {
    float borne_px = fmaxf(TOO_COARSE * MOST_PIXELS, c->borne_px);
    *pixels = texel_pixels(now, slot, opts, c->map);
    if (!is_seen_as_pixels(now, slot, opts))
        borne_px = TOO_COARSE * FIXED_WORSE *
                   texel_pixels(now, slot, opts,
                                (struct gn_map_choice){.cascades = 1, .px = opts->map_px});
    return *pixels <= borne_px;
}

/* The user may move the camera to where the first choice is far too coarse. The number of cascades
 * only grows: each change needs programs and targets. If another map does not help, this is not
 * tried again until texels are twice as large, nor while the camera rests. A map that stayed as it
 * is comes back with the camera. */
static void judge_map(struct views *now, uint32_t slot, const struct gn_shadow_opts *opts,
                      struct gn_cascade_choice *c) {
    const struct gn_orbit *orbit = &now->opts->view.orbit;
    struct gn_map_choice chosen;
    float pixels;
    if (gn_orbit_is_zero(orbit)) {
        if (c->home.fixed) c->map = c->home;
        return;
    }
    const uint64_t by = gn_hash(GN_HASH_INIT, orbit, sizeof *orbit);
    if (by == c->judged || (!c->map.fixed && c->map.cascades >= opts->cascades)) return;
    c->judged = by;
    if (is_borne(now, slot, opts, c, &pixels) || !choose_map(now, slot, opts, &chosen)) return;
    const bool is_other = chosen.cascades > c->map.cascades ||
                          (chosen.cascades == c->map.cascades &&
                           (chosen.px != c->map.px || chosen.fixed != c->map.fixed));
    c->borne_px = is_other ? 0.0f : 2.0f * pixels;
    if (is_other) c->map = chosen;
}

/* What the choice depends on, except the camera's position. The technique is not part of it: modes
 * agree on the number, whichever comes first. */
static uint64_t basis_of(const struct views *v, const struct gn_shadow_opts *opts) {
    const struct gn_frame *frame = v->frame;
    const uint32_t by[] = {opts->map_px,
                           opts->light.map_px,
                           opts->all_receive,
                           opts->but_floor,
                           opts->plane,
                           gn_techniques[opts->technique].on_plane ? opts->encoding + 1u : 0,
                           v->stands,
                           !v->stands && gn_technique_replaces_map(opts->technique),
                           may_be_worse(opts),
                           opts->cascades,
                           frame->camera,
                           frame->picture.width_px,
                           frame->picture.height_px,
                           (uint32_t)v->now->at.clips,
                           (uint32_t)(v->moves ? v->now->at.over : -1)};
    return gn_hash(GN_HASH_INIT, by, sizeof by);
}

static struct gn_map_choice choose(struct views *v, uint32_t slot,
                                   const struct gn_shadow_opts *opts) {
    const struct gn_scene *scene = v->frame->scene;
    struct gn_light_note *note =
        &v->frame->notes.lights.at[gn_frame_light_of_slot(v->frame, slot)->light];
    const uint64_t basis = basis_of(v, opts);
    for (struct gn_cascade_choice *c = note->cascades; c < note->cascades + GN_CASCADE_CHOICES; c++)
        if (c->map.cascades > 0 && c->choice == basis) {
            judge_map(v, slot, opts, c);
            return c->map;
        }

    for (uint32_t i = 0; i < scene->animation.clip_count && v->moves; i++)
        if (scene->animation.clips[i].duration_ns > v->lasts_ns)
            v->lasts_ns = scene->animation.clips[i].duration_ns;
    if (v->moves) v->count += OTHERS;
    struct gn_map_choice map;
    const bool known = choose_map(v, slot, opts, &map);
    if (v->other.scene) gn_pose_finish(&v->other);
    if (!known) return (struct gn_map_choice){.cascades = 1, .px = opts->map_px};
    const bool at_home = gn_orbit_is_zero(&v->opts->view.orbit);
    note->cascades[note->next_choice] = (struct gn_cascade_choice){
        .choice = basis, .map = map, .home = at_home ? map : (struct gn_map_choice){0}};
    note->next_choice = (note->next_choice + 1) % GN_CASCADE_CHOICES;
    return map;
}

void gn_frame_choose_map(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *frame_opts, uint32_t slot,
                         struct gn_shadow_opts *opts) {
    const struct gn_scene *scene = frame->scene;
    const struct gn_light *light = &scene->lights[gn_frame_light_of_slot(frame, slot)->light];
    const uint32_t from = frame_opts->view.light_plus_1;
    struct views v = {.frame = frame,
                      .opts = frame_opts,
                      .now = pose,
                      .count = 1,
                      .stands = gn_frame_casters_stand(pose) && !pose->node_moves[light->node]};
    v.moves = pose->node_moves[from ? scene->lights[from - 1].node
                                    : scene->cameras[frame_opts->view.camera].node];
    v.moves |= !from && pose->cameras != scene->cameras; /* it zooms, too */
    const bool on_plane = gn_techniques[opts->technique].on_plane;
    opts->moves = !v.stands;
    if (!gn_cascade_can(light, &frame->eye, opts)) opts->cascades = 1;
    if (opts->encoding == GN_ENCODING_STENCIL) return;
    if (!on_plane &&
        gn_light_types[light->type].shines_around) { /* its tiles are as wide for any eye */
        opts->fixed = v.stands;
        return;
    }
    const struct gn_map_choice map = choose(&v, slot, opts);
    opts->cascades = map.cascades;
    opts->map_px = map.px;
    opts->fixed = opts->whole = map.fixed;
}
