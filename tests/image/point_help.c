#include "image/point_help.h"

#include "unit/check.h"
#include "unit/gl_help.h"

struct help_lamp lamp;

int help_lamp_open(void **state) {
    (void)state;
    help_open(&lamp.display, "egl");
    lamp.gl = help_gl(&lamp.display, NULL, NULL);
    return 0;
}

int help_lamp_close(void **state) {
    (void)state;
    gn_gl_destroy(lamp.gl);
    gn_display_close(&lamp.display);
    return 0;
}

void help_lamp_load(struct gn_maker *maker) {
    struct gn_err err = {0};
    gn_maker_set(maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'point','intensity':50}]}}");
    lamp.scene = gn_maker_load(maker, NULL, &err);
    if (!lamp.scene || !gn_gl_load(lamp.gl, lamp.scene, &err)) fail_msg("%s", err.text);
    gn_pose_init(&lamp.pose, lamp.scene, GN_POSE_DEFAULT);
    gn_pose_step(&lamp.pose, 0);
    lamp.frame = gn_frame_create(lamp.scene, gn_gl_caps(lamp.gl));
}

int help_lamp_unload(void **state) {
    (void)state;
    gn_frame_destroy(lamp.frame);
    gn_pose_finish(&lamp.pose);
    gn_scene_destroy(lamp.scene);
    return 0;
}

const struct gn_plan *help_lamp_draw(int camera, int technique, int encoding, int width_px,
                                     int height_px) {
    struct gn_frame_opts opts = {
        .output.width_px = (uint32_t)width_px,
        .output.height_px = (uint32_t)height_px,
        .view.camera = camera,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = (enum gn_technique)technique,
                       .map_px = HELP_LAMP_MAP_PX,
                       .map_format = GN_MAP_FORMAT((enum gn_encoding)encoding, GN_MOMENTS_NONE)},
        .shadow.taps_fixed = true,
        .debug.aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(lamp.frame, &lamp.pose, &opts, NULL);
    if (!gn_gl_prepare(lamp.gl, plan, &err) || !gn_gl_run(lamp.gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    return plan;
}
