/* The fit is exact: a plane of the frustum that touches the points gives one equation for the eye,
 * two opposite planes its place on one axis and its distance. */
#include "scene/framing.h"

#include <cglm/cglm.h>
#include <math.h>

static const float FILLED = .92f;              /* of half of the picture */
static const float ASSUMED_ASPECT = 16.0f / 9; /* of a file's camera that does not say its own */

/* How far an extent's points reach along n, from the centre. A point that turns about the vertical
 * axis reaches farthest where its radius points as n does. */
static float find_extents_reach(const struct gn_framing_fit *fit, const struct gn_extent *extent,
                                const vec3 n) {
    float most = -INFINITY;
    const float aside = hypotf(n[0], n[2]);
    for (uint32_t i = 0; i < extent->count; i++) {
        vec3 p;
        glm_vec3_sub(extent->points[i], (float *)fit->centre_ws, p);
        const float reach =
            fit->turns ? n[1] * p[1] + aside * hypotf(p[0], p[2]) : glm_vec3_dot((float *)n, p);
        most = fmaxf(most, reach);
    }
    return most;
}

static float find_clips_reach(const struct gn_framing_fit *fit, int clips, int over, const vec3 n) {
    const struct gn_extent *extents = fit->pose->scene->extents;
    const float reach = find_extents_reach(fit, &extents[clips - GN_POSE_NONE], n);
    if (over < 0) return reach;
    return fmaxf(reach, find_extents_reach(fit, &extents[over - GN_POSE_NONE], n));
}

/* Of a fade the mean: a point on the straight way between one within the one extent and one within
 * the other is within that, too; and at both ends of the fade the camera goes on without a jump. */
static float find_reach(const struct gn_framing_fit *fit, const vec3 n) {
    const struct gn_pose *pose = fit->pose;
    if (!pose) return find_extents_reach(fit, fit->extent, n);
    const float reach = find_clips_reach(fit, pose->at.clips, pose->at.over, n);
    if (pose->at.fade >= 1) return reach;
    float before = 0;
    for (int i = 0; i < GN_POSE_PARTS; i++)
        if (pose->before[i].share > 0)
            before += pose->before[i].share *
                      find_clips_reach(fit, pose->before[i].clips, pose->before[i].over, n);
    return pose->at.fade * reach + (1 - pose->at.fade) * before;
}

static float reach_between(const struct gn_framing_fit *fit, const vec3 axis, float sign,
                           const vec3 back, float slope) {
    vec3 n;
    for (int k = 0; k < 3; k++) n[k] = sign * axis[k] + slope * back[k];
    return find_reach(fit, n);
}

void gn_framing_fit(const struct gn_framing_fit *fit, vec3 axes[3], struct gn_camera *camera,
                    vec3 eye_ws) {
    const float slope = tanf(camera->yfov_rad / 2) * FILLED;
    vec3 forward;
    glm_vec3_negate_to(axes[2], forward);
    const float nearest = find_reach(fit, axes[2]), farthest = -find_reach(fit, forward);
    float aside[2], distance = 0, size = nearest - farthest; /* all from the centre */
    for (int k = 0; k < 2; k++) {
        const float s = k == 0 ? slope * fit->aspect : slope;
        const float more = reach_between(fit, axes[k], 1, axes[2], s),
                    less = reach_between(fit, axes[k], -1, axes[2], s);
        aside[k] = (more - less) / 2;
        if (fit->target_ws) {
            vec3 to;
            glm_vec3_sub((float *)fit->target_ws, (float *)fit->centre_ws, to);
            aside[k] = glm_vec3_dot(axes[k], to);
        }
        distance = fmaxf(distance, fmaxf(more - aside[k], less + aside[k]) / s);
        size = fmaxf(size, more + less);
    }
    size = fmaxf(size, 1e-9f);
    distance = fmaxf(distance, nearest + .05f * size);
    glm_vec3_copy((float *)fit->centre_ws, eye_ws);
    glm_vec3_muladds(axes[0], aside[0], eye_ws);
    glm_vec3_muladds(axes[1], aside[1], eye_ws);
    glm_vec3_muladds(axes[2], distance, eye_ws);
    camera->near_m = fmaxf((distance - nearest) / 2, distance / 100);
    camera->far_m = distance - farthest + size;
}

static bool is_made(const struct gn_scene *scene, uint32_t camera) {
    return scene->added.camera && camera + 1 == scene->camera_count;
}

/* Near and far plane around all that is drawn, from any place. */
static void set_planes(const struct gn_framing_fit *fit, vec3 back, float distance_m,
                       const vec3 eye_ws, struct gn_camera *camera) {
    vec3 forward, from_centre;
    glm_vec3_negate_to(back, forward);
    glm_vec3_sub((float *)eye_ws, (float *)fit->centre_ws, from_centre);
    const float away = glm_vec3_dot(from_centre, back);
    camera->near_m = fmaxf((away - find_reach(fit, back)) / 2, distance_m / 100);
    camera->far_m = fmaxf(1.1f * (away + find_reach(fit, forward)), 10 * camera->near_m);
}

/* Whether the scene's centre, `distance` along the axis, is what the camera looks at: of a scene
 * that reaches to the horizon the centre is near. */
static bool is_before(const vec3 to_centre, float distance, float size) {
    const float aside = sqrtf(fmaxf(glm_vec3_norm2((float *)to_centre) - distance * distance, 0));
    return distance >= .05f * size || (distance >= .005f * size && aside < .5f * distance);
}

/* axes: of the camera as it stands; gets those of the place that is given. Sets eye_ws. */
static void place_camera(const struct gn_framing_opts *opts, struct gn_framing_fit *fit, bool made,
                         vec3 axes[3], struct gn_framing *framing) {
    struct gn_camera *c = &framing->camera;
    vec3 to_centre, target;
    glm_vec3_sub(fit->centre_ws, framing->eye_ws, to_centre);
    float distance = -glm_vec3_dot(to_centre, axes[2]);
    const float size = fmaxf(find_reach(fit, axes[2]), 1e-9f);
    if (!is_before(to_centre, distance, size)) distance = size;
    glm_vec3_copy(framing->eye_ws, target);
    glm_vec3_muladds(axes[2], -distance, target);
    if (made) glm_vec3_copy(fit->centre_ws, target);
    if (opts->given & GN_FRAMING_TARGET) glm_vec3_copy((float *)opts->target_ws, target);
    if (opts->given & (GN_FRAMING_THETA | GN_FRAMING_PHI | GN_FRAMING_TARGET) || made) {
        const bool turned = opts->given & GN_FRAMING_THETA, tilted = opts->given & GN_FRAMING_PHI;
        const float theta = turned ? opts->theta_rad : atan2f(axes[2][0], axes[2][2]);
        const float phi = glm_clamp(tilted ? opts->phi_rad : acosf(glm_clamp(axes[2][1], -1, 1)),
                                    1e-3f, GLM_PIf - 1e-3f);
        glm_vec3_copy((vec3){sinf(phi) * sinf(theta), cosf(phi), sinf(phi) * cosf(theta)}, axes[2]);
        glm_vec3_copy((vec3){cosf(theta), 0, -sinf(theta)}, axes[0]);
        glm_vec3_cross(axes[2], axes[0], axes[1]);
    }
    const bool near_as_fits = made && !(opts->given & GN_FRAMING_DISTANCE);
    if (near_as_fits) {
        if (opts->given & GN_FRAMING_TARGET) fit->target_ws = target;
        gn_framing_fit(fit, axes, c, framing->eye_ws);
        glm_vec3_sub(framing->eye_ws, target, to_centre);
        framing->distance_m = fmaxf(glm_vec3_dot(to_centre, axes[2]), 1e-6f);
        return;
    }
    framing->distance_m =
        opts->given & GN_FRAMING_DISTANCE ? fmaxf(opts->distance_m, 1e-6f) : distance;
    glm_vec3_copy(target, framing->eye_ws);
    glm_vec3_muladds(axes[2], framing->distance_m, framing->eye_ws);
    if (made) set_planes(fit, axes[2], framing->distance_m, framing->eye_ws, c);
}

static void use_added_camera(struct gn_framing *framing) {
    vec3 axes[3] = {{0}, {0}, GN_FRAMING_ADDED_BACK};
    framing->camera = (struct gn_camera){.name = framing->camera.name,
                                         .node = framing->camera.node,
                                         .yfov_rad = glm_rad(GN_FRAMING_ADDED_FOV_DEG)};
    glm_vec3_normalize(axes[2]);
    glm_vec3_crossn(GLM_YUP, axes[2], axes[0]);
    glm_vec3_cross(axes[2], axes[0], axes[1]);
    for (int row = 0; row < 3; row++)
        for (int k = 0; k < 3; k++) framing->view_from_world[k][row] = axes[row][k];
}

void gn_framing_build(const struct gn_pose *pose, uint32_t camera,
                      const struct gn_framing_opts *opts, struct gn_framing *framing) {
    const struct gn_scene *scene = pose->scene;
    const bool replaced = camera + 1 == opts->made_plus_1,
               made = replaced || is_made(scene, camera), placed = opts->given & GN_FRAMING_PLACE;
    const float aspect = opts->aspect > 0 ? opts->aspect : 1;
    struct gn_camera *c = &framing->camera;
    *c = pose->cameras[camera];
    framing->distance_m = 0;
    gn_pose_view(pose, camera, framing->view_from_world, framing->eye_ws);
    if (replaced) use_added_camera(framing);
    if (opts->given & GN_FRAMING_FOV && !c->orthographic) c->yfov_rad = opts->yfov_rad;
    const float own = c->aspect > 0 || made || aspect >= 1 ? c->aspect : ASSUMED_ASPECT;
    if (own > aspect) c->yfov_rad = 2 * atanf(tanf(c->yfov_rad / 2) * own / aspect);
    if (!made && !placed) return;
    struct gn_framing_fit fit = {.pose = pose, .aspect = aspect, .turns = opts->turns};
    vec3 axes[3];
    vec4 *view = framing->view_from_world;
    for (int row = 0; row < 3; row++)
        for (int k = 0; k < 3; k++) axes[row][k] = view[k][row];
    glm_vec3_center((float *)scene->box.min, (float *)scene->box.max, fit.centre_ws);
    if (placed)
        place_camera(opts, &fit, made, axes, framing);
    else
        gn_framing_fit(&fit, axes, c, framing->eye_ws);
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < 3; k++) view[k][row] = axes[row][k];
        view[3][row] = -glm_vec3_dot(axes[row], framing->eye_ws);
    }
}

/* ---- what a camera sees ---- */

static bool is_in_picture(const struct gn_framing *framing, const vec3 point_ws) {
    enum { WIDTH = 16, HEIGHT = 9 };
    const struct gn_camera *c = &framing->camera;
    vec3 at;
    glm_mat4_mulv3((vec4 *)framing->view_from_world, (float *)point_ws, 1, at);
    const float depth = -at[2];
    const float half = c->orthographic ? fmaxf(fabsf(c->ymag_m), fabsf(c->xmag_m) * HEIGHT / WIDTH)
                                       : depth * tanf(c->yfov_rad / 2);
    return depth >= c->near_m && (c->far_m <= 0 || depth <= c->far_m) && fabsf(at[1]) <= half &&
           fabsf(at[0]) <= half * WIDTH / HEIGHT;
}

float gn_framing_share(const struct gn_pose *pose, uint32_t camera, bool *cuts) {
    enum { CELLS = 12 };
    const struct gn_framing_opts opts = {.aspect = 16.0f / 9};
    const struct gn_box *box = &pose->scene->box;
    const struct gn_extent *extent = &pose->scene->extents[pose->at.clips - GN_POSE_NONE];
    struct gn_framing framing;
    gn_framing_build(pose, camera, &opts, &framing);
    int seen = 0;
    for (int i = 0; i < CELLS * CELLS * CELLS; i++) {
        const int cell[3] = {i % CELLS, i / CELLS % CELLS, i / CELLS / CELLS};
        vec3 p;
        for (int k = 0; k < 3; k++)
            p[k] = glm_lerp(box->min[k], box->max[k], ((float)cell[k] + .5f) / CELLS);
        seen += is_in_picture(&framing, p);
    }
    bool inside = true;
    for (int k = 0; k < 3; k++)
        inside &= framing.eye_ws[k] >= box->min[k] && framing.eye_ws[k] <= box->max[k];
    *cuts = false;
    for (uint32_t i = 0; i < extent->count && !inside; i++)
        *cuts |= !is_in_picture(&framing, extent->points[i]);
    return (float)seen / (CELLS * CELLS * CELLS);
}
