#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"

#define FAR_TIMES 1e4f  /* times the extent of the scene */
#define WIDER     1.25f /* than the picture, which may be shifted */
#define ROUNDING  4e-6f /* of a coordinate, after the transforms of a vertex */

/* About the vertical axis through the scene's centre. */
static void turn_camera(struct gn_framing *framing, const struct gn_box *scene, float angle_rad) {
    vec3 centre, back;
    mat4 turned_from_world = GLM_MAT4_IDENTITY_INIT;
    if (angle_rad == 0.0f) return;
    glm_vec3_center((float *)scene->min, (float *)scene->max, centre);
    glm_vec3_negate_to(centre, back);
    glm_translate(turned_from_world, centre);
    glm_rotate_y(turned_from_world, -angle_rad, turned_from_world);
    glm_translate(turned_from_world, back);
    glm_mat4_mul(framing->view_from_world, turned_from_world, framing->view_from_world);
    glm_vec3_sub(framing->eye_ws, centre, framing->eye_ws);
    glm_vec3_rotate(framing->eye_ws, angle_rad, (vec3){0.0f, 1.0f, 0.0f});
    glm_vec3_add(framing->eye_ws, centre, framing->eye_ws);
}

/* Behind all of a box. */
static float end_of(const struct gn_framing *framing, const struct gn_box *box) {
    vec3 reach;
    for (int k = 0; k < 3; k++)
        reach[k] =
            fmaxf(fabsf(box->min[k] - framing->eye_ws[k]), fabsf(box->max[k] - framing->eye_ws[k]));
    return glm_vec3_norm(reach) * 1.01f;
}

/* A camera moved by the user shows all of the scene: its own near and far planes then only extend
 * the range. */
static void set_planes(struct gn_framing *framing, const struct gn_box *box, bool moved,
                       float target_m) {
    struct gn_camera *camera = &framing->camera;
    const float end_m = end_of(framing, box), least_m = 2.0f * camera->near_m,
                reach_m = isfinite(end_m) && end_m > least_m ? end_m : least_m;
    /* A far plane far beyond the scene shows nothing more and costs depth precision. */
    if (camera->far_m <= 0.0f || camera->far_m >= FAR_TIMES * reach_m) camera->far_m = reach_m;
    if (!moved) return;
    camera->far_m = fmaxf(camera->far_m, reach_m);
    camera->near_m = fminf(camera->near_m, camera->orthographic ? -reach_m : 0.125f * target_m);
}

/* An unseen floor is wider than the model: a camera that has all of that in its range has its floor
 * in it, too, or the far plane would cut the shadows. */
static void reach_floor(struct gn_framing *framing, const struct gn_pose *pose) {
    const struct gn_scene *scene = pose->scene;
    struct gn_camera *camera = &framing->camera;
    for (uint32_t i = 0; scene->added.floor && i < scene->item_count; i++)
        if (scene->materials[scene->items[i].material].shadow_catcher &&
            1.01f * camera->far_m > end_of(framing, &pose->box_ws))
            camera->far_m = fmaxf(camera->far_m, end_of(framing, &pose->items[i].box_ws));
}

static void project(const struct gn_camera *c, float aspect, float wider, mat4 clip_from_view) {
    const float x = c->xmag_m * wider, y = c->ymag_m * wider;
    if (c->orthographic)
        glm_ortho(-x, x, -y, y, c->near_m, c->far_m, clip_from_view);
    else
        glm_perspective(c->yfov_rad, aspect, c->near_m, c->far_m, clip_from_view);
    for (int k = 0; k < 2 && !c->orthographic; k++) clip_from_view[k][k] /= wider;
}

/* The near plane goes out to the nearest surface in view: one at 0.1 mm leaves depth steps of
 * metres at 100 m. It goes by doubling, and an orthographic range by halving, so that depths stay
 * the same while things move a little. */
static void fit_planes(struct gn_framing *framing, const struct gn_pose *pose, float aspect) {
    struct gn_camera *c = &framing->camera;
    const float given_m = c->near_m, rounding_m = ROUNDING * glm_vec3_norm(framing->eye_ws);
    struct gn_eye eye;
    mat4 clip_from_world;
    vec3 start_ws;
    float depths_m[2];
    project(c, aspect, WIDER, clip_from_world);
    glm_mat4_mul(clip_from_world, framing->view_from_world, clip_from_world);
    gn_eye_build(&eye, clip_from_world);
    for (int k = 0; k < 3; k++)
        start_ws[k] = framing->eye_ws[k] - given_m * framing->view_from_world[k][2];
    gn_eye_depths(&eye, start_ws, pose, depths_m);
    const float free_m = 0.99f * depths_m[0] - rounding_m,
                seen_m = 1.01f * depths_m[1] + rounding_m;
    if (!isfinite(free_m) || !isfinite(seen_m)) return; /* nothing is in view */
    if (c->orthographic) {
        float range_m = c->far_m - given_m;
        while (range_m > 2.0f * seen_m) range_m *= 0.5f;
        c->far_m = fminf(c->far_m, given_m + range_m);
        while (range_m > 2.0f * (c->far_m - given_m - free_m)) range_m *= 0.5f;
        c->near_m = fmaxf(given_m, c->far_m - range_m);
    }
    while (!c->orthographic && 2.0f * c->near_m < fminf(given_m + free_m, 0.5f * c->far_m))
        c->near_m *= 2.0f;
}

void gn_frame_camera(const struct gn_pose *pose, const struct gn_frame_view_opts *view,
                     float aspect, struct gn_framing *framing) {
    static const struct gn_orbit unmoved;
    const bool of_light = view->light_plus_1 > 0;
    const struct gn_orbit *orbit = of_light ? &unmoved : &view->orbit;
    struct gn_framing_opts opts = view->framing;
    struct gn_camera *camera = &framing->camera;
    float target_m = 0.0f, half[2];
    opts.aspect = aspect;
    if (of_light)
        gn_frame_light_camera(pose, view->light_plus_1 - 1, aspect, framing);
    else
        target_m = gn_orbit_view(orbit, pose, (uint32_t)view->camera, &opts, framing);
    turn_camera(framing, &pose->scene->box, view->turntable_rad);
    const bool placed = framing->distance_m > 0.0f;
    set_planes(framing, &pose->box_ws, placed || !gn_orbit_is_zero(orbit), target_m);
    if (!of_light) reach_floor(framing, pose);
    if (camera->orthographic) {
        gn_orbit_ortho_half(orbit, camera, aspect, half);
        camera->xmag_m = half[0];
        camera->ymag_m = half[1];
    }
    fit_planes(framing, pose, aspect);
}

static void shift_scene(const struct gn_frame *frame, const struct gn_frame_view_opts *view,
                        mat4 clip_from_view) {
    const float x_px = (float)view->shift_px[0] + view->aside_px[0],
                y_px = (float)view->shift_px[1] + view->aside_px[1],
                x = 2.0f * x_px / (float)frame->picture.width_px,
                y = 2.0f * y_px / (float)frame->picture.height_px;
    if (x == 0.0f && y == 0.0f) return;
    for (int k = 0; k < 4; k++) {
        clip_from_view[k][0] += x * clip_from_view[k][3];
        clip_from_view[k][1] += y * clip_from_view[k][3];
    }
}

static void find_look(const struct gn_frame *frame, const struct gn_pose *pose,
                      const struct gn_frame_opts *opts, struct gn_framing *framing,
                      mat4 clip_from_world) {
    const float aspect = (float)frame->picture.width_px / (float)frame->picture.height_px;
    mat4 clip_from_view;
    gn_frame_camera(pose, &opts->view, aspect, framing);
    project(&framing->camera, aspect, 1.0f, clip_from_view);
    shift_scene(frame, &opts->view, clip_from_view);
    /* Rotates the picture in clip space: free for a rotated screen. */
    const float cosine = frame->picture.turn[0], sine = frame->picture.turn[1];
    for (int k = 0; k < 4; k++) {
        const float x = clip_from_view[k][0], y = clip_from_view[k][1];
        clip_from_view[k][0] = cosine * x + sine * y;
        clip_from_view[k][1] = cosine * y - sine * x;
    }
    glm_mat4_mul(clip_from_view, framing->view_from_world, clip_from_world);
}

void gn_frame_eye_at(const struct gn_frame *frame, const struct gn_pose *pose,
                     const struct gn_frame_opts *opts, struct gn_eye *eye) {
    struct gn_framing framing;
    mat4 clip_from_world;
    find_look(frame, pose, opts, &framing, clip_from_world);
    gn_eye_build(eye, clip_from_world);
}

void gn_frame_eye(struct gn_frame *frame, const struct gn_pose *pose,
                  const struct gn_frame_opts *opts, float (*constants)[4]) {
    struct gn_framing framing;
    mat4 clip_from_world;
    find_look(frame, pose, opts, &framing, clip_from_world);
    gn_eye_build(&frame->eye, clip_from_world);
    memcpy(constants[PASS_CLIP], clip_from_world, sizeof clip_from_world);
    const bool flat = framing.camera.orthographic;
    for (int k = 0; k < 3; k++) {
        /* orthographic: the unit vector towards the camera is the view's +Z */
        constants[PASS_EYE][k] = flat ? framing.view_from_world[k][2] : framing.eye_ws[k];
        constants[PASS_EXPOSURE][1 + k] = framing.eye_ws[k];
    }
    constants[PASS_EYE][3] = flat ? 0.0f : 1.0f;
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
