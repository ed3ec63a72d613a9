/* [sun]: a light of the scene and its sky follow the sun of a place and a time. */
#ifndef GN_STAGE_SUN_H
#define GN_STAGE_SUN_H

#include "core/sun.h"
#include "core/warn.h"
#include "frame/frame.h"
#include "options/settings.h"

#define GN_STAGE_DIAL_LATITUDE 50.0 /* of the default scene's sundial */

/* Whether settings have a place, or an azimuth or an altitude, and do not lack a clock. */
bool gn_stage_sun_is_set(const struct gn_settings *settings);
/* Whether the sun is to be that of now, and the clock was never set: it shows a time before 2024.
 */
bool gn_stage_sun_lacks_clock(const struct gn_settings *settings);
/* Whether the sun is set, and stands somewhere else at another time. */
bool gn_stage_sun_moves(const struct gn_settings *settings);
/* Whether settings have a place, which is then set. */
bool gn_stage_sun_place(const struct gn_settings *settings, struct gn_place *place);
/* The sun at that moment, with the azimuth and the altitude of the settings where they are given;
 * without a place 180 and 45. */
struct gn_sun_view gn_stage_sun_view(const struct gn_settings *settings, double utc_s);
/* The light that becomes the sun: the first directional one with gnomon_sun, else the one made for
 * a scene without lights, else the first directional one; -1: the scene has none. */
int gn_stage_sun_light(const struct gn_scene *scene);
/* The moment of `date`, seconds of UTC since 1970; of "now" by the system's clock. False: there is
 * no such time zone. */
bool gn_stage_sun_time(const struct gn_settings *settings, double *utc_s, struct gn_err *err);
/* The same of a date as gn_date_parse() reads it, or of "now" or NULL. */
bool gn_stage_sun_moment(const struct gn_settings *settings, const char *text, double *utc_s,
                         struct gn_err *err);
/* "21 June 2026, 14:00; by the sun 13:08": a moment by the clock of time_zone, and the apparent
 * solar time of the place, which a sundial shows; "" unless gn_stage_sun_moves(). */
void gn_stage_sun_print(const struct gn_settings *settings, double utc_s, char *out, size_t size);
/* How long the shadows of a picture of that size stay within a pixel, of the scene's middle. The
 * sun turns by W = 15.04 degrees an hour, at most, so a shadow that is L long moves by W * L a
 * second. L is that of the scene's highest point, height / sin(altitude), and at most the diagonal
 * of its box; a pixel is 2 tan(fov / 2) * distance / height_px there. The result is the longest
 * part of a minute (60 / n, whole seconds) that is no longer, from 1 to 60 s, and to 12 s while the
 * sun is lower than 6 degrees, for the light changes fast then. */
double gn_stage_sun_step_s(const struct gn_pose *pose, const struct gn_frame_opts *opts,
                           double altitude_deg);
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
