/* Scenes loaded in a thread, one at a time, while frames go on. A load may be cancelled; the next
 * one starts when it has ended, within a moment. */
#ifndef GN_STAGE_LOADER_H
#define GN_STAGE_LOADER_H

#include "core/warn.h"
#include "scene/pose.h"

struct gn_loader;
struct gn_loaded {
    int number;                   /* of gn_loader_start(), from 0 */
    struct gn_scene *scene;       /* NULL: failed, see err */
    struct gn_pose pose;          /* of the scene, with its default clips, at 0 */
    struct gn_occluder *occluder; /* of the scene */
    struct gn_detailer *detailer; /* likewise */
    struct gn_err err;
    struct gn_warnings warnings;
};

struct gn_loader *gn_loader_open(struct gn_err *err);
int gn_loader_fd(const struct gn_loader *loader);       /* readable when a scene can be taken */
bool gn_loader_is_busy(const struct gn_loader *loader); /* a load runs or is to be taken */
/* The number of the load that runs and is not cancelled, else -1. */
int gn_loader_number(const struct gn_loader *loader);
/* How much of that load is done, 0 to 1; below 0: none runs. */
double gn_loader_progress(const struct gn_loader *loader);
/* Not while busy. The path is copied; NULL: the built-in scene. */
void gn_loader_start(struct gn_loader *loader, int number, const char *path,
                     const struct gn_scene_limits *limits);
/* Drops what is loaded, if anything is: gn_loader_take() will not return it. Does not wait. */
void gn_loader_cancel(struct gn_loader *loader);
/* The loaded scene, owned by the caller; NULL: not done yet, or it was cancelled. */
struct gn_loaded *gn_loader_take(struct gn_loader *loader);
/* Frees it, or NULL, in a thread, for a loop that waits for nothing: a large scene takes long. */
void gn_loaded_drop(struct gn_loaded *loaded);
/* Does not wait: a thread that still loads is cancelled and frees its scene. */
void gn_loader_close(struct gn_loader *loader);

#endif
