/* A scene, a display, its GL and a frame builder together, for render, bench, doctor and the kiosk.
 */
#ifndef GN_STAGE_STAGE_H
#define GN_STAGE_STAGE_H

#include "core/warn.h"
#include "display/display.h"
#include "frame/frame.h"
#include "gl/gl.h"
#include "options/settings.h"
#include "stage/view.h"

struct gn_occluder; /* stage/occlusion.h */
struct gn_detailer; /* stage/detail.h */

/* How the settings draw a scene. */
struct gn_stage_look {
    struct gn_frame_opts frame_opts;
    int clips; /* as gn_pose_init() wants them */
    struct gn_pose_run run;
    int variant; /* as gn_pose_choose_variant() wants it */
};
struct gn_stage {
    const struct gn_settings *settings; /* must outlive the stage */
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_display display;
    struct gn_gl *gl;
    struct gn_occluder *occluder;                   /* of that scene; NULL: none was asked for */
    struct gn_detailer *detailer;                   /* likewise */
    struct gn_view shown;                           /* of that scene and pose */
    struct gn_stage_truth {                         /* of technique truth */
        void (*progress)(void *user, double share); /* the caller's, as in gn_cast_opts, or NULL */
        void *user;
        float *visibility; /* of the last picture's first light that is drawn with it, or with aov
                              OCCLUSION of its sky: a value for each pixel, row 0 on top; or NULL */
    } truth;
};

/* The limits of --limit, for the loader, with the defaults of the others. */
struct gn_scene_limits gn_stage_limits(const struct gn_settings *settings);
/* A scene by its path, or lesson:NAME; NULL: the built-in one. Uses no shared state: it may run in
 * a thread. */
struct gn_scene *gn_stage_read(const char *path, const struct gn_scene_limits *limits,
                               struct gn_warnings *warnings, struct gn_err *err);
/* Before a plan of the view is built: its occlusion. Where frames are shown it is made beside them,
 * else at once. */
void gn_stage_occlude(struct gn_stage *stage, struct gn_view *view);
/* The same of its levels of detail. Pictures of technique truth have whole meshes. */
void gn_stage_refine(struct gn_stage *stage, struct gn_view *view);
/* Fills the look; checks what the settings say about the scene (camera, animation, variant, light).
 */
bool gn_stage_look_build(struct gn_stage_look *look, const struct gn_settings *settings,
                         const struct gn_scene *scene, struct gn_warnings *warnings,
                         struct gn_err *err);
/* The scene that the options name, or the default one inside the program; limits of --limit hold.
 */
struct gn_scene *gn_stage_scene(const struct gn_settings *settings, struct gn_warnings *warnings,
                                struct gn_err *err);
/* Puts the source of the scene's name before a failure to load it, unless that is a flag. */
void gn_stage_name_source(const struct gn_settings *settings, struct gn_err *err);
/* The same as gn_stage_load() with a scene that is loaded; it is the stage's from then on, also
 * after a failure. NULL: fails, err stays. */
bool gn_stage_take(struct gn_stage *stage, const struct gn_settings *settings,
                   struct gn_scene *scene, struct gn_warnings *warnings, struct gn_err *err);
/* Loads the scene, poses it at --time and checks what the options say about it (camera, animation,
 * light, technique). */
bool gn_stage_load(struct gn_stage *stage, const struct gn_settings *settings,
                   struct gn_warnings *warnings, struct gn_err *err);
/* Opens the display of --backend, makes the context current, loads the scene into it. */
bool gn_stage_open(struct gn_stage *stage, struct gn_warnings *warnings, struct gn_err *err);
/* The part that lives in the current context; stop_gl is legal without it, too. */
bool gn_stage_start_gl(struct gn_stage *stage, struct gn_warnings *warnings, struct gn_err *err);
void gn_stage_stop_gl(struct gn_stage *stage);
/* The samples of --msaa. By itself: 4 where they are resolved on the chip (tiling GPUs), or the
 * picture is a file that is looked at, not measured; 0 where that takes too much memory. Needs GL.
 */
uint32_t gn_stage_msaa(const struct gn_stage *stage, uint32_t width_px, uint32_t height_px,
                       bool to_file);
void gn_stage_close(
    struct gn_stage *stage); /* a zeroed one may be closed, and one that failed half-way */

#endif
