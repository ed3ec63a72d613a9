/* Environments by name: the studio inside the program, and Radiance files, which are prefiltered
 * once and kept (kept.h). */
#ifndef GN_STAGE_ENVIRONMENT_H
#define GN_STAGE_ENVIRONMENT_H

#include "core/warn.h"
#include "frame/frame.h"
#include "options/settings.h"

/* Fills opts->environment, and the colour and radius of a light made as its key among
 * opts->shadow's lights; before gn_stage_set_lights(). By itself (auto) a scene without lights of
 * its own gets the studio, and others only what materials reflect of it that need reflections.
 * False: the file is missing or bad. Environments stay until the process ends; a file that changed
 * replaces what was read of it. Not for several threads. */
bool gn_stage_set_environment(struct gn_frame_opts *opts, const struct gn_settings *settings,
                              const struct gn_scene *scene, struct gn_err *err);
#endif
