/* [sun]: a light of the scene and its sky follow the sun of a place and a time. */
#ifndef GN_STAGE_SUN_H
#define GN_STAGE_SUN_H

#include "core/sun.h"
#include "core/warn.h"
#include "frame/frame.h"
#include "options/settings.h"

/* The place of --sun, else of [sun]. False: neither has one. */
bool gn_stage_sun_place(const struct gn_settings *settings, struct gn_place *place);
/* Whether settings have a place, or an azimuth or an altitude, and do not lack a clock. */
bool gn_stage_sun_is_set(const struct gn_settings *settings);
/* Whether the sun is to be that of now, and the clock was never set: it shows a time before 2024.
 */
bool gn_stage_sun_lacks_clock(const struct gn_settings *settings);
/* Whether the sun is set, and stands somewhere else at another time. */
bool gn_stage_sun_moves(const struct gn_settings *settings);
/* The light that becomes the sun: the first directional one with gnomon_sun, else the one made for
 * a scene without lights, else the first directional one; -1: the scene has none. */
int gn_stage_sun_light(const struct gn_scene *scene);
/* The moment of `date`, seconds of UTC since 1970; of "now" by the system's clock. False: there is
 * no such time zone. */
bool gn_stage_sun_time(const struct gn_settings *settings, double *utc_s, struct gn_err *err);
/* The same of a date as gn_date_parse() reads it, or of "now" or NULL. */
bool gn_stage_sun_moment(const struct gn_settings *settings, const char *text, double *utc_s,
                         struct gn_err *err);
/* Before gn_stage_set_lights(), after the environment: the moment, the size of the sun, and an
 * exposure of 0 unless one is given, for the sun's unit is the screen's. Does nothing without
 * [sun].
 */
bool gn_stage_sun_start(struct gn_frame_opts *opts, const struct gn_settings *settings,
                        const struct gn_scene *scene, struct gn_warnings *warnings,
                        struct gn_err *err);
/* After each change of the pose or of opts->view.sun_utc_s: the light's direction and colour, and
 * the sky (sky.h) where the environment is automatic; for one thread. Without [sun], or such a
 * light: gn_stage_aim().
 */
void gn_stage_aim_lights(struct gn_pose *pose, struct gn_frame_opts *opts,
                         const struct gn_settings *settings);

#endif
