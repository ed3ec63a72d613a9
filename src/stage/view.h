/* A view: one picture of a scene. What builds its plans, what of the scene it shows, of which pose,
 * and on what output. Views share a stage's GL, and may share a pose: the sides of a split screen
 * do. A second screen is one more view. */
#ifndef GN_STAGE_VIEW_H
#define GN_STAGE_VIEW_H

#include "frame/frame.h"
#include "gl/gl.h"
#include "options/settings.h"

struct gn_rays; /* stage/rays.h */
struct gn_stage;

enum gn_view_number { /* views of one frame: each has targets of its own */
                      GN_VIEW_SHOWN,
                      GN_VIEW_LEFT,
                      GN_VIEW_TRUTH,
                      GN_VIEW_STILL,
};
struct gn_view {
    struct gn_frame *builder;   /* NULL: the next plan makes it */
    struct gn_frame_opts opts;  /* the look, the camera (.view), the output */
    struct gn_pose *pose;       /* of the scene that GL has; not owned */
    int64_t rested_ns;          /* how much of the scene's time the turntable has stood */
    const struct gn_rays *rays; /* with technique truth: finished ones of this moment, to be drawn
                                   instead of a cast; NULL: cast. Not owned */
    uint64_t generation;        /* increases when look, camera, output or moment change */
    struct gn_view_basis {      /* what it was posed with last */
        struct gn_frame_view_opts view;
        struct gn_frame_output_opts output;
        struct gn_moment at;
        vec3 aim_ws; /* of the light that is turned */
    } posed;
};

/* Ends the builder, which belongs to a context and a scene; the next plan makes another one. */
void gn_view_stop(struct gn_view *view);
/* The same for a view that is not shown any more, with its targets on the GPU. gl: NULL is legal.
 */
void gn_view_close(struct gn_view *view, struct gn_gl *gl);
/* Another look; the output stays, and the orbit where the camera is the same. */
void gn_view_enter(struct gn_view *view, const struct gn_frame_opts *look);
/* The pose, camera, output and cover of another view, in this look; the builder stays. */
void gn_view_share(struct gn_view *view, enum gn_view_number number, const struct gn_view *with,
                   const struct gn_frame_opts *look);
/* Poses the scene and the turntable at a time. */
void gn_view_pose(struct gn_view *view, const struct gn_settings *settings, int64_t time_ns);
/* Builds a plan with these options in place of the view's own, as gn_frame_build() does. */
const struct gn_plan *gn_view_build(struct gn_view *view, const struct gn_gl *gl,
                                    const struct gn_frame_opts *opts, struct gn_warnings *warnings);
/* Builds the plan of the pose as it is and makes its GL objects. A capability that the GPU claims
 * and a test draw disproves is left out, as by --without, with a warning. NULL on failure; with -v
 * the source of a shader that does not compile is printed. */
const struct gn_plan *gn_view_plan(struct gn_view *view, struct gn_gl *gl,
                                   struct gn_warnings *warnings, struct gn_err *err);
/* Poses at a time, builds the plan, makes its objects and draws it; with technique truth casts its
 * rays, which may take minutes. NULL on failure. */
const struct gn_plan *gn_view_draw(struct gn_view *view, struct gn_stage *stage, int64_t time_ns,
                                   struct gn_warnings *warnings, struct gn_err *err);

#endif
