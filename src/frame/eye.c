#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"

#define FAR_TIMES 1e4f /* times the extent of the scene */

/* A camera moved by the user shows all of the scene: the camera's own near and far planes then only
 * extend the range. */
static void make_projection(const struct gn_camera *camera, const struct gn_orbit *orbit,
                            bool placed, float aspect, const float reach_m[2],
                            mat4 clip_from_view) {
    const bool moved = placed || !gn_orbit_is_zero(orbit);
    float near_m = camera->near_m, far_m = reach_m[1];
    /* A far plane far beyond the scene shows nothing more and costs depth precision. */
    if (camera->far_m > 0.0f && camera->far_m < FAR_TIMES * reach_m[1]) far_m = camera->far_m;
    if (moved) far_m = fmaxf(far_m, reach_m[1]);
    if (camera->orthographic) {
        float half[2];
        gn_orbit_ortho_half(orbit, camera, aspect, half);
        if (moved) near_m = fminf(near_m, -reach_m[1]);
        glm_ortho(-half[0], half[0], -half[1], half[1], near_m, far_m, clip_from_view);
        return;
    }
    if (moved) near_m = fminf(near_m, 0.125f * reach_m[0]);
    glm_perspective(camera->yfov_rad, aspect, near_m, far_m, clip_from_view);
}

static void shift_scene(const struct gn_frame *frame, const int shift_px[2], mat4 clip_from_view) {
    if (shift_px[0] == 0 && shift_px[1] == 0) return;
    const float x = 2.0f * (float)shift_px[0] / (float)frame->picture.width_px,
                y = 2.0f * (float)shift_px[1] / (float)frame->picture.height_px;
    for (int k = 0; k < 4; k++) {
        clip_from_view[k][0] += x * clip_from_view[k][3];
        clip_from_view[k][1] += y * clip_from_view[k][3];
    }
}

struct look {
    mat4 view_from_world, clip_from_world;
    vec3 eye_ws;
    bool orthographic;
};

static void find_look(const struct gn_frame *frame, const struct gn_pose *pose,
                      const struct gn_frame_opts *opts, struct look *look) {
    static const struct gn_orbit unmoved;
    const struct gn_orbit *orbit = opts->view.light_plus_1 ? &unmoved : &opts->view.orbit;
    struct gn_framing framing;
    const float aspect = (float)frame->picture.width_px / (float)frame->picture.height_px;
    struct gn_framing_opts framing_opts = opts->view.framing;
    framing_opts.aspect = aspect;
    mat4 clip_from_view;
    float reach_m[2] = {0}; /* to what is looked at, and to the end of the scene */
    if (opts->view.light_plus_1)
        gn_frame_light_camera(pose, opts->view.light_plus_1 - 1, aspect, &framing.camera,
                              framing.view_from_world, framing.eye_ws);
    else
        reach_m[0] =
            gn_orbit_view(orbit, pose, (uint32_t)opts->view.camera, &framing_opts, &framing);
    const struct gn_camera camera = framing.camera;
    glm_mat4_copy(framing.view_from_world, look->view_from_world);
    glm_vec3_copy(framing.eye_ws, look->eye_ws);
    look->orthographic = camera.orthographic;
    const float angle_rad = opts->view.turntable_rad;
    if (angle_rad != 0.0f) { /* about the vertical axis through the scene's centre */
        vec3 centre, back;
        mat4 turned_from_world = GLM_MAT4_IDENTITY_INIT;
        glm_vec3_center((float *)pose->scene->box.min, (float *)pose->scene->box.max, centre);
        glm_vec3_negate_to(centre, back);
        glm_translate(turned_from_world, centre);
        glm_rotate_y(turned_from_world, -angle_rad, turned_from_world);
        glm_translate(turned_from_world, back);
        glm_mat4_mul(look->view_from_world, turned_from_world, look->view_from_world);
        glm_vec3_sub(look->eye_ws, centre, look->eye_ws);
        glm_vec3_rotate(look->eye_ws, angle_rad, (vec3){0.0f, 1.0f, 0.0f});
        glm_vec3_add(look->eye_ws, centre, look->eye_ws);
    }
    const struct gn_box *box = &pose->box_ws;
    vec3 reach;
    for (int k = 0; k < 3; k++)
        reach[k] =
            fmaxf(fabsf(box->min[k] - look->eye_ws[k]), fabsf(box->max[k] - look->eye_ws[k]));
    const float far_m = glm_vec3_norm(reach) * 1.01f, least_m = 2.0f * camera.near_m;
    reach_m[1] = isfinite(far_m) && far_m > least_m ? far_m : least_m;
    const bool placed = !opts->view.light_plus_1 && framing.distance_m > 0.0f;
    make_projection(&camera, orbit, placed, aspect, reach_m, clip_from_view);
    shift_scene(frame, opts->view.shift_px, clip_from_view);
    /* Rotates the picture in clip space: free for a rotated screen. */
    const float c = frame->picture.turn[0], s = frame->picture.turn[1];
    for (int k = 0; k < 4; k++) {
        const float x = clip_from_view[k][0], y = clip_from_view[k][1];
        clip_from_view[k][0] = c * x + s * y;
        clip_from_view[k][1] = c * y - s * x;
    }
    glm_mat4_mul(clip_from_view, look->view_from_world, look->clip_from_world);
}

void gn_frame_eye_at(const struct gn_frame *frame, const struct gn_pose *pose,
                     const struct gn_frame_opts *opts, struct gn_eye *eye) {
    struct look look;
    find_look(frame, pose, opts, &look);
    gn_eye_build(eye, look.clip_from_world);
}

void gn_frame_eye(struct gn_frame *frame, const struct gn_pose *pose,
                  const struct gn_frame_opts *opts, float (*constants)[4]) {
    struct look look;
    find_look(frame, pose, opts, &look);
    gn_eye_build(&frame->eye, look.clip_from_world);
    memcpy(constants[PASS_CLIP], look.clip_from_world, sizeof look.clip_from_world);
    for (int k = 0; k < 3; k++) {
        /* orthographic: the unit vector towards the camera is the view's +Z */
        constants[PASS_EYE][k] = look.orthographic ? look.view_from_world[k][2] : look.eye_ws[k];
        constants[PASS_EXPOSURE][1 + k] = look.eye_ws[k];
    }
    constants[PASS_EYE][3] = look.orthographic ? 0.0f : 1.0f;
}

float gn_frame_camera_azimuth(const struct gn_pose *pose, const struct gn_frame_view_opts *view) {
    struct gn_framing framing;
    vec3 up, back;
    gn_orbit_view(&view->orbit, pose, (uint32_t)view->camera, &view->framing, &framing);
    for (int k = 0; k < 3; k++) {
        up[k] = framing.view_from_world[k][1];
        back[k] = framing.view_from_world[k][2];
    }
    /* looking straight down, or up: the lower edge of the picture, or the upper one */
    if (hypotf(back[0], back[2]) < 1e-3f) glm_vec3_scale(up, back[1] > 0.0f ? -1.0f : 1.0f, back);
    return atan2f(back[0], back[2]) + view->turntable_rad;
}
