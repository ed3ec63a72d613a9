/* What tests of point lights share: one scene with a lamp, drawn as a picture of what is seen of
 * it. */
#ifndef GN_IMAGE_POINT_HELP_H
#define GN_IMAGE_POINT_HELP_H

#include "display/display.h"
#include "frame/frame.h"
#include "gl/gl.h"
#include "unit/gltf_maker.h"

enum { HELP_LAMP_MAP_PX = 128 };

extern struct help_lamp {
    struct gn_display display;
    struct gn_gl *gl;
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_frame *frame;
} lamp;

/* Set-up and tear-down of a group. */
int help_lamp_open(void **state);
int help_lamp_close(void **state);
/* The maker's scene, with one point light for nodes to refer to. */
void help_lamp_load(struct gn_maker *maker);
int help_lamp_unload(void **state);
/* Visibility, seen by a camera; read it with gn_gl_read_f32(). The plan holds until the next. */
const struct gn_plan *help_lamp_draw(int camera, int technique, int encoding, int width_px,
                                     int height_px);

#endif
