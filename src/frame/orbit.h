/* The eye moved by hand, away from where its camera stands. Plain data in the frame's options and
 * pure steps; nothing here knows of mice. */
#ifndef GN_FRAME_ORBIT_H
#define GN_FRAME_ORBIT_H

#include "scene/framing.h"

struct gn_orbit {             /* zeroed: as the camera stands */
    float yaw_rad, pitch_rad; /* the eye goes round what it looks at: to the right, and up */
    vec3 shift_m;             /* of what it looks at, world space, before the turntable */
    float distance_m;         /* to what it looks at, as found when it began to move; 0: that to the
                                 scene's centre */
    float zoom;               /* logarithm of how many times nearer; orthographic: larger */
};
struct gn_orbit_hand {     /* input by a pointer; zeroed: none */
    float turn[2], pan[2]; /* drags to the right and up, in heights of the picture */
    float zoom;            /* added to the orbit's */
};

bool gn_orbit_is_zero(const struct gn_orbit *orbit);
/* The next orbit, for a camera of the scene at this pose, in a picture of this shape. A pan moves
 * the scene with the pointer; dragging by the height of the picture turns it by 180 degrees. The
 * camera stays between the poles, not nearer than twice the near plane and not farther than 50
 * times its distance. */
struct gn_orbit gn_orbit_step(const struct gn_orbit *orbit, const struct gn_orbit_hand *hand,
                              const struct gn_pose *pose, uint32_t camera,
                              const struct gn_framing_opts *opts);
/* gn_framing_build() moved by it. It looks at the point on its axis that the orbit has, at the
 * first surface there; a made camera, one that a place is given for, one that shows the whole
 * model, and one that sees none there look at the point at the distance of the scene's centre.
 * Returns the distance in metres to that point. */
float gn_orbit_view(const struct gn_orbit *orbit, const struct gn_pose *pose, uint32_t camera,
                    const struct gn_framing_opts *opts, struct gn_framing *framing);
/* The orthographic half-sizes in metres that show all of the camera's rectangle in a picture of
 * this aspect. */
void gn_orbit_ortho_half(const struct gn_orbit *orbit, const struct gn_camera *camera, float aspect,
                         float half[2]);

#endif
