/* What holds for a light of a scene with these options, on a GPU without capabilities. */
#ifndef GN_TESTS_UNIT_LIGHT_HELP_H
#define GN_TESTS_UNIT_LIGHT_HELP_H

#include "frame/frame.h"

static inline struct gn_light_opts gn_light_held(const struct gn_scene *scene,
                                                 const struct gn_frame_opts *opts, uint32_t light) {
    const struct gn_caps caps = {.max_texture_px = 1024, .max_texture_units = 16};
    struct gn_frame *frame = gn_frame_create(scene, &caps);
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_frame_build(frame, &pose, opts, NULL);
    const struct gn_light_opts held = gn_frame_light_opts(frame, &pose, opts, light);
    gn_pose_finish(&pose);
    gn_frame_destroy(frame);
    return held;
}

#endif
