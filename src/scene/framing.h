/* A camera in a picture of a given shape: where it stands, and its angle. */
#ifndef GN_SCENE_FRAMING_H
#define GN_SCENE_FRAMING_H

#include "scene/pose.h"

/* Direction in which the camera that the loader adds stands: a three-quarter view from the front,
 * the right and above. */
#define GN_FRAMING_ADDED_BACK                                                                      \
    { .55f, .5f, 1 }
#define GN_FRAMING_ADDED_FOV_DEG 35
#define GN_FRAMING_LEAST_SHARE   (1 / 3.0f) /* seen by a camera that is not replaced by itself */

struct gn_framing_opts {  /* zeroed: defaults */
    float aspect;         /* of the picture, width / height; 1 */
    bool turns;           /* the camera goes round the vertical axis through the scene's centre */
    uint32_t made_plus_1; /* this camera of the file gives way to one as the loader adds; 0: none */
    unsigned given;       /* bits: what of these takes the place of what the camera has */
    float theta_rad, phi_rad, distance_m,
        target_ws[3]; /* where it stands: about the vertical, 0 from
                         +Z, towards +X; from straight above */
    float yfov_rad;
    float phi_min_rad, phi_max_rad, distance_min_m,
        distance_max_m; /* of what moves it on; 0: none */
};
enum gn_framing_given {
    GN_FRAMING_THETA = 1,
    GN_FRAMING_PHI = 2,
    GN_FRAMING_DISTANCE = 4,
    GN_FRAMING_TARGET = 8,
    GN_FRAMING_FOV = 16,
    GN_FRAMING_PLACE = 15, /* any but the angle */
};
struct gn_framing {
    struct gn_camera camera; /* with the angle that this picture has */
    mat4 view_from_world;
    vec3 eye_ws;
    float distance_m; /* to the target, where a place is given; else 0 */
};

/* A file's camera stands where its node does. A picture narrower than its aspect keeps its
 * horizontal angle, others its vertical one: so all is shown that the camera's own picture shows.
 * One that says no aspect has 16:9 where the picture is higher than wide, and else any. A
 * camera that the loader added keeps its direction; it goes as near as all of the scene stays in
 * the picture for all of the clips that the pose plays, and with `turns` from all sides; while the
 * pose fades it goes with it, from where it stood to where it will. What is given replaces what the
 * camera has: it looks at the target, upright. */
void gn_framing_build(const struct gn_pose *pose, uint32_t camera,
                      const struct gn_framing_opts *opts, struct gn_framing *framing);

/* The share of the scene's box that a camera sees, in a picture of 16:9 at this pose, by points all
 * over the box: 0 to 1. *cuts: something is beside the picture, too near or too far, and the camera
 * stands outside of the box. */
float gn_framing_share(const struct gn_pose *pose, uint32_t camera, bool *cuts);

/* The part that makes a place: the nearest from which all points of the extent are in the picture,
 * with a margin. axes: the camera's right, up and back. Sets eye_ws, and the camera's planes. */
struct gn_framing_fit {
    const struct gn_extent *extent; /* or, of all that a pose plays: */
    const struct gn_pose *pose;
    vec3 centre_ws; /* of the scene: the axis of `turns` goes through it */
    float aspect;
    bool turns;
    const float *target_ws; /* in the middle of the picture; NULL: what is drawn is */
};
void gn_framing_fit(const struct gn_framing_fit *fit, vec3 axes[3], struct gn_camera *camera,
                    vec3 eye_ws);

#endif
