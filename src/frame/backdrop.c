/* The environment as the background: one triangle at the far end of depth, after what is opaque and
 * before what is blended over it. It has the picture's tone, since it is light as bright as in
 * reflections. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"

/* The cube's level: of a rougher one the shape of lamps is lost, and the light's distribution
 * stays.
 */
static const float levels[] = {
    [GN_ENVIRONMENT_SHOW_SHARP] = 0.0f, [GN_ENVIRONMENT_SHOW_BLUR] = 2.0f};

/* Where pixels look, in the environment's own frame: from = centre + x right + y up, x and y of
 * NDC. Of an orthographic camera all rays are parallel, and so the background is of one colour. */
static void set_rays(const struct gn_frame *frame, const struct gn_frame_opts *opts,
                     float (*to)[4]) {
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE);
    const float turn[2] = {cosf(opts->environment.turn_rad), sinf(opts->environment.turn_rad)};
    mat4 clip_from_world, world_from_clip;
    vec3 rays[3];
    memcpy(clip_from_world, c[PASS_CLIP], sizeof clip_from_world);
    glm_mat4_inv_precise(clip_from_world, world_from_clip);
    for (int i = 0; i < 3; i++) {
        vec4 ndc = {i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f, -1.0f, 1.0f}, near_ws;
        glm_mat4_mulv(world_from_clip, ndc, near_ws);
        for (int k = 0; k < 3; k++)
            rays[i][k] =
                c[PASS_EYE][3] == 0.0f ? -c[PASS_EYE][k] : near_ws[k] / near_ws[3] - c[PASS_EYE][k];
    }
    const float scale = 1.0f / fmaxf(glm_vec3_norm(rays[0]), 1e-30f);
    glm_vec3_sub(rays[1], rays[0], rays[1]);
    glm_vec3_sub(rays[2], rays[0], rays[2]);
    for (int i = 0; i < 3; i++) {
        glm_vec3_scale(rays[i], scale, rays[i]);
        to[BACKDROP_RAYS + i][0] = turn[0] * rays[i][0] - turn[1] * rays[i][2];
        to[BACKDROP_RAYS + i][1] = rays[i][1];
        to[BACKDROP_RAYS + i][2] = turn[0] * rays[i][2] + turn[1] * rays[i][0];
    }
}

void gn_frame_add_backdrop(struct gn_frame *frame, const struct gn_pose *pose,
                           const struct gn_frame_opts *opts) {
    (void)pose;
    const struct gn_plan *plan = &frame->plan;
    const enum gn_environment_show show = opts->environment.show;
    if (!plan->environment.light || show == GN_ENVIRONMENT_SHOW_NO || plan->transparent) return;
    struct gn_program_key key = gn_key_of(GN_PROGRAM_BACKDROP);
    if (!plan->tones_sum) key.features |= gn_frame_tone_feature(frame);
    if (plan->encode_srgb && plan->output == GN_OUTPUT_LINEAR8)
        key.features |= GN_FEATURE(ENCODE_SRGB);
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_BACKDROP);
    set_rays(frame, opts, c);
    c[BACKDROP_LIGHT][0] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE)[PASS_SKY][3];
    c[BACKDROP_LIGHT][1] = levels[show];
    struct gn_pass *pass = gn_frame_picture_pass(frame, "backdrop");
    pass->depth_write = false;
    pass->constants = c;
    pass->constant_count = BACKDROP_SIZE;
    gn_frame_draw_bare(frame, &key, 3, 0, 1);
    gn_frame_end_pass(frame);
}
