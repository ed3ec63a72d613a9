/* For tests that draw: a context, a small scene made by hand, and plans of it. */
#ifndef GN_TESTS_GL_HELP_H
#define GN_TESTS_GL_HELP_H

#include "display/display.h"
#include "frame/frame.h"
#include "gl/gl.h"

/* Opens the display, or skips the test where there is none. */
void help_open(struct gn_display *display, const char *name);
struct gn_gl *help_gl(struct gn_display *display, const struct gn_gl_opts *extra,
                      struct gn_warnings *warnings);

struct help_stage { /* a scene that is ready to be drawn, at 0 s */
    struct gn_display display;
    struct gn_gl *gl;
    struct gn_scene *scene;  /* owned */
    struct gn_light *lights; /* the scene's own, where help_stage_light() gave it others */
    struct gn_pose pose;
    struct gn_frame *frame;
};
/* Of what make() returns. Skips the test where there is no such display. without, warnings: as in
 * gl.h. */
void help_stage_open(struct help_stage *stage, struct gn_scene *(*make)(void), const char *backend,
                     const char *without, struct gn_warnings *warnings);
void help_stage_close(struct help_stage *stage);
/* A group's setup called `name` that opens what the file's own open_with(backend, without) does. */
#define HELP_OPENS(name, backend, without)                                                         \
    static int name(void **state) {                                                                \
        (void)state;                                                                               \
        open_with(backend, without);                                                               \
        return 0;                                                                                  \
    }
/* Builds, checks, prepares and runs the plan of the pose as it is; fails the test if one fails. */
const struct gn_plan *help_stage_draw(struct help_stage *stage, const struct gn_frame_opts *opts,
                                      struct gn_warnings *warnings);

/* Gives the scene, and the pose, the first `count` of these lights, which it only reads; NULL: of
 * its own. */
void help_stage_light(struct help_stage *stage, struct gn_light *lights, uint32_t count);

/* Writes name (a path of at most one folder) below a new temporary folder and returns the folder.
 */
const char *help_folder(void);
void help_write(const char *folder, const char *name, const char *text);
void help_remove(const char *folder);
/* Writes huge.gltf into the folder: one geometry of that many vertices, a multiple of 3, of 12 zero
 * bytes each, which take no space on the disk. */
void help_write_huge(const char *folder, int vertices);

/* Two flat squares that fill the view, at depth .25 (small: half the width) and .75 of clip space.
 */
extern const struct gn_scene help_scene;
enum { HELP_NEAR, HELP_FAR }; /* geometries */

/* A folder of shaders for it: LIT writes base_color + u_pass[0], DISTANCE u_pass[0].x. */
const char *help_shaders(void);

#endif
