#include "frame/orbit.h"

#include <cglm/cglm.h>
#include <math.h>

static const float HIGHEST_RAD = 1.56f; /* elevation over the point looked at: not quite the pole */
static const float FARTHEST_ZOOM = -3.9f;             /* 50 times as far away */
static const float CENTRAL = .25f, NEAR_CENTRE = .5f; /* find_surface_m(): shares of the radius, and
                                                          of the distance to the centre */
static const float LARGEST_ZOOM = 6.9f;               /* orthographic: a thousand times as large */

bool gn_orbit_is_zero(const struct gn_orbit *o) {
    return o->yaw_rad == 0.0f && o->pitch_rad == 0.0f && o->zoom == 0.0f && o->shift_m[0] == 0.0f &&
           o->shift_m[1] == 0.0f && o->shift_m[2] == 0.0f;
}

/* The least distance to the point looked at. */
static float nearest_m(const struct gn_camera *camera) {
    return camera->orthographic ? 1e-6f : fmaxf(2.0f * camera->near_m, 1e-6f);
}

/* A camera: its axes in world space, and the distance to the point that it looks at. */
struct stand {
    vec3 right, up, back, eye_ws;
    float distance_m, radius_m;
};

/* turns_about_m: as in gn_orbit. */
static struct stand stand_of(const struct gn_pose *pose, const struct gn_framing *framing,
                             float turns_about_m) {
    const struct gn_box *box = &pose->scene->box;
    struct stand s;
    vec3 centre, to_centre;
    glm_vec3_copy((float *)framing->eye_ws, s.eye_ws);
    for (int k = 0; k < 3; k++) {
        s.right[k] = framing->view_from_world[k][0];
        s.up[k] = framing->view_from_world[k][1];
        s.back[k] = framing->view_from_world[k][2];
    }
    glm_vec3_center((float *)box->min, (float *)box->max, centre);
    glm_vec3_sub(centre, s.eye_ws, to_centre);
    s.radius_m = 0.5f * glm_vec3_distance((float *)box->min, (float *)box->max);
    s.distance_m = -glm_vec3_dot(to_centre, s.back);
    if (framing->distance_m > 0.0f)
        s.distance_m = framing->distance_m;
    else if (turns_about_m > 0.0f)
        s.distance_m = turns_about_m;
    else if (s.distance_m < 0.05f * s.radius_m)
        s.distance_m = s.radius_m; /* it looks elsewhere */
    s.distance_m = fmaxf(s.distance_m, nearest_m(&framing->camera));
    return s;
}

/* The distance to the first surface on the axis of a camera of the file. 0, for the scene's centre:
 * there is none, or it is about as far away as that and the axis goes by the centre, as where the
 * whole model is shown. */
static float find_surface_m(const struct gn_pose *pose, const struct gn_framing *framing,
                            uint32_t camera, const struct gn_framing_opts *opts) {
    const struct gn_scene *scene = pose->scene;
    if (camera + 1 == opts->made_plus_1 ||
        (scene->added.camera && camera + 1 == scene->camera_count) || framing->distance_m > 0.0f)
        return 0.0f;
    const struct stand s = stand_of(pose, framing, 0.0f);
    const struct gn_camera *c = &framing->camera;
    vec3 forward, centre, about;
    glm_vec3_negate_to((float *)s.back, forward);
    const float surface_m = gn_pose_surface_m(pose, s.eye_ws, forward, c->near_m);
    glm_vec3_center((float *)scene->box.min, (float *)scene->box.max, centre);
    glm_vec3_copy((float *)s.eye_ws, about);
    glm_vec3_muladds(forward, s.distance_m, about);
    const bool is_of_all = glm_vec3_distance(about, centre) < CENTRAL * s.radius_m &&
                           surface_m > NEAR_CENTRE * s.distance_m;
    return isfinite(surface_m) && !is_of_all ? surface_m : 0.0f;
}

/* Rotates about its own right axis, then about the vertical. */
static struct stand turn_stand(const struct stand *at, float yaw_rad, float pitch_rad) {
    struct stand s = *at;
    glm_vec3_rotate(s.up, -pitch_rad, s.right);
    glm_vec3_rotate(s.back, -pitch_rad, s.right);
    glm_vec3_rotate(s.right, yaw_rad, (vec3){0.0f, 1.0f, 0.0f});
    glm_vec3_rotate(s.up, yaw_rad, (vec3){0.0f, 1.0f, 0.0f});
    glm_vec3_rotate(s.back, yaw_rad, (vec3){0.0f, 1.0f, 0.0f});
    return s;
}

struct gn_orbit gn_orbit_step(const struct gn_orbit *orbit, const struct gn_orbit_hand *hand,
                              const struct gn_pose *pose, uint32_t camera,
                              const struct gn_framing_opts *opts) {
    struct gn_framing framing;
    gn_framing_build(pose, camera, opts, &framing);
    const struct gn_camera *c = &framing.camera;
    struct gn_orbit o = *orbit;
    if (gn_orbit_is_zero(orbit)) o.distance_m = find_surface_m(pose, &framing, camera, opts);
    const struct stand s = stand_of(pose, &framing, o.distance_m);
    o.yaw_rad = fmodf(o.yaw_rad - GLM_PIf * hand->turn[0], 2.0f * GLM_PIf);
    const float height_rad = asinf(glm_clamp(s.back[1], -1.0f, 1.0f));
    /* limits, within which the camera itself always is */
    const float high = opts->phi_min_rad > 0.0f ? GLM_PI_2f - opts->phi_min_rad : HIGHEST_RAD;
    const float low = opts->phi_max_rad > 0.0f ? GLM_PI_2f - opts->phi_max_rad : -HIGHEST_RAD;
    o.pitch_rad = glm_clamp(o.pitch_rad - GLM_PIf * hand->turn[1],
                            fminf(fmaxf(low, -HIGHEST_RAD) - height_rad, 0.0f),
                            fmaxf(fminf(high, HIGHEST_RAD) - height_rad, 0.0f));
    float most = c->orthographic ? LARGEST_ZOOM : logf(s.distance_m / nearest_m(c));
    float least = FARTHEST_ZOOM;
    if (opts->distance_min_m > 0.0f) most = fminf(most, logf(s.distance_m / opts->distance_min_m));
    if (opts->distance_max_m > 0.0f)
        least = fmaxf(least, logf(s.distance_m / opts->distance_max_m));
    o.zoom = glm_clamp(o.zoom + hand->zoom, fminf(least, 0.0f), fmaxf(most, 0.0f));

    /* A pan moves the point looked at with the pointer: by a share of the height seen there. */
    const struct stand now = turn_stand(&s, o.yaw_rad, o.pitch_rad);
    float half[2];
    gn_orbit_ortho_half(&o, c, opts->aspect > 0.0f ? opts->aspect : 1.0f, half);
    const float height_m = c->orthographic
                               ? 2.0f * half[1]
                               : 2.0f * s.distance_m * expf(-o.zoom) * tanf(0.5f * c->yfov_rad);
    const float most_m = 100.0f * (s.radius_m + s.distance_m);
    for (int k = 0; k < 3; k++) {
        const float by_m = height_m * (now.right[k] * hand->pan[0] + now.up[k] * hand->pan[1]);
        o.shift_m[k] = glm_clamp(o.shift_m[k] - by_m, -most_m, most_m);
    }
    return o;
}

float gn_orbit_view(const struct gn_orbit *orbit, const struct gn_pose *pose, uint32_t camera,
                    const struct gn_framing_opts *opts, struct gn_framing *framing) {
    gn_framing_build(pose, camera, opts, framing);
    const struct stand s = stand_of(pose, framing, orbit->distance_m);
    const float distance_m =
        framing->camera.orthographic ? s.distance_m : s.distance_m * expf(-orbit->zoom);
    if (gn_orbit_is_zero(orbit)) return distance_m;
    const struct stand now = turn_stand(&s, orbit->yaw_rad, orbit->pitch_rad);
    vec4 *view_from_world = framing->view_from_world;
    float *eye_ws = framing->eye_ws;
    glm_vec3_add(eye_ws, (float *)orbit->shift_m, eye_ws);
    glm_vec3_muladds((float *)s.back, -s.distance_m, eye_ws);
    glm_vec3_muladds((float *)now.back, distance_m, eye_ws);
    for (int k = 0; k < 3; k++) {
        view_from_world[k][0] = now.right[k];
        view_from_world[k][1] = now.up[k];
        view_from_world[k][2] = now.back[k];
    }
    view_from_world[3][0] = -glm_vec3_dot((float *)now.right, eye_ws);
    view_from_world[3][1] = -glm_vec3_dot((float *)now.up, eye_ws);
    view_from_world[3][2] = -glm_vec3_dot((float *)now.back, eye_ws);
    return distance_m;
}

void gn_orbit_ortho_half(const struct gn_orbit *orbit, const struct gn_camera *camera, float aspect,
                         float half[2]) {
    half[0] = fabsf(camera->xmag_m);
    half[1] = fabsf(camera->ymag_m);
    if (half[0] < half[1] * aspect)
        half[0] = half[1] * aspect;
    else
        half[1] = half[0] / aspect;
    for (int k = 0; k < 2; k++) half[k] *= expf(-orbit->zoom);
}
