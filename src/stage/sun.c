#include "stage/sun.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "environment/daylight.h"
#include "options/date.h"
#include "stage/lights.h"
#include "stage/sky.h"

static const double LOW_SUN = 6 * M_PI / 180;

/* ---- settings ---- */

bool gn_stage_sun_place(const struct gn_settings *o, struct gn_place *place) {
    const struct gn_sun_settings *s = &o->sun;
    const bool flag = !isnan(s->place_deg[0]);
    place->latitude_deg = flag ? s->place_deg[0] : s->latitude_deg;
    place->longitude_deg = flag ? s->place_deg[1] : s->longitude_deg;
    return !isnan(place->latitude_deg) && !isnan(place->longitude_deg);
}

static bool depends_on_time(const struct gn_settings *o) {
    struct gn_place place;
    return gn_stage_sun_place(o, &place) &&
           (isnan(o->sun.azimuth_deg) || isnan(o->sun.altitude_deg));
}

static bool is_now(const struct gn_settings *o) {
    return !o->sun.date || strcmp(o->sun.date, "now") == 0;
}

bool gn_stage_sun_lacks_clock(const struct gn_settings *settings) {
    return depends_on_time(settings) && is_now(settings) &&
           gn_clock_day_ns() / GN_NS_PER_S < GN_CLOCK_PAST_S;
}

bool gn_stage_sun_is_set(const struct gn_settings *settings) {
    struct gn_place place;
    const bool given = gn_stage_sun_place(settings, &place) || !isnan(settings->sun.azimuth_deg) ||
                       !isnan(settings->sun.altitude_deg);
    return given && !gn_stage_sun_lacks_clock(settings);
}

bool gn_stage_sun_moves(const struct gn_settings *settings) {
    return depends_on_time(settings) && !gn_stage_sun_lacks_clock(settings);
}

int gn_stage_sun_light(const struct gn_scene *scene) {
    int first = -1;
    for (int i = (int)scene->light_count - 1; i >= 0; i--)
        if (scene->lights[i].type == GN_LIGHT_DIRECTIONAL) first = i;
    for (int i = 0; i < (int)scene->light_count; i++)
        if (scene->lights[i].is_sun) return i;
    return scene->added.light ? (int)scene->light_count - 1 : first;
}

bool gn_stage_sun_moment(const struct gn_settings *settings, const char *text, double *utc_s,
                         struct gn_err *err) {
    struct gn_date date;
    if (!text || !gn_date_parse(text, &date)) {
        const int64_t now_s = gn_clock_day_ns() / GN_NS_PER_S;
        *utc_s = (double)now_s;
        return true;
    }
    return gn_date_utc(&date, settings->sun.time_zone, utc_s, err) ||
           gn_fail_prefix(err, "%s", gn_settings_label(settings, sun.time_zone));
}

bool gn_stage_sun_time(const struct gn_settings *settings, double *utc_s, struct gn_err *err) {
    return gn_stage_sun_moment(settings, settings->sun.date, utc_s, err);
}

/* Of the default scene, at another latitude than that of its sundial. */
static void warn_of_dial(const struct gn_settings *settings, struct gn_warnings *warnings) {
    struct gn_place place;
    if (settings->scene.path || !gn_stage_sun_place(settings, &place) ||
        fabs(place.latitude_deg - GN_STAGE_DIAL_LATITUDE) < 0.5)
        return;
    gn_warn(warnings,
            "sun: the sundial of the default scene is made for %g degrees north and errs at %g; "
            "show one of `gnomon dial --latitude %g -o dial.glb`",
            GN_STAGE_DIAL_LATITUDE, place.latitude_deg, place.latitude_deg);
}

static void warn_of_light(const struct gn_scene *scene, int light, struct gn_warnings *warnings) {
    if (light < 0)
        gn_warn(warnings, "sun: the scene has lights, but no directional one that can be the sun");
    else if (!scene->lights[light].is_sun && !scene->added.light)
        gn_warn(warnings, "sun: no light of the scene has gnomon_sun; the sun is \"%.60s\"",
                scene->lights[light].name);
}

bool gn_stage_sun_start(struct gn_frame_opts *opts, const struct gn_settings *settings,
                        const struct gn_scene *scene, struct gn_warnings *warnings,
                        struct gn_err *err) {
    if (settings->sun.hours && !depends_on_time(settings))
        gn_warn(warnings, "sun: hours are those of a place and a day: give latitude and longitude, "
                          "and leave out azimuth or altitude");
    if (!gn_stage_sun_is_set(settings)) return true;
    const int light = gn_stage_sun_light(scene);
    warn_of_light(scene, light, warnings);
    warn_of_dial(settings, warnings);
    if (light < 0) return true;
    if (!gn_stage_sun_time(settings, &opts->view.sun_utc_s, err)) return false;
    struct gn_light_opts *entry = gn_stage_light_entry(&opts->shadow, (uint32_t)light);
    if (entry) GN_LIGHT_SET(entry, radius, GN_SUN_TAN_RADIUS);
    opts->exposure_given = true;
    return true;
}

/* ---- the moment ---- */

struct gn_sun_view gn_stage_sun_view(const struct gn_settings *settings, double utc_s) {
    const struct gn_sun_settings *s = &settings->sun;
    struct gn_place place;
    struct gn_sun_view view = {.azimuth_deg = 180, .altitude_deg = 45};
    if (gn_stage_sun_place(settings, &place)) view = gn_sun_view(utc_s, &place);
    if (!isnan(s->azimuth_deg)) view.azimuth_deg = fmod(s->azimuth_deg + 360, 360);
    if (!isnan(s->altitude_deg)) view.altitude_deg = s->altitude_deg;
    return view;
}

void gn_stage_sun_print(const struct gn_settings *settings, double utc_s, char *out, size_t size) {
    struct gn_place place;
    char clock[64];
    *out = '\0';
    if (!gn_stage_sun_moves(settings) || !gn_stage_sun_place(settings, &place)) return;
    const double hour_deg = gn_sun_view(utc_s, &place).hour_angle_deg;
    const int minute = (int)floor((hour_deg + 180) * 4) % 1440;
    gn_date_print(utc_s, settings->sun.time_zone, clock, sizeof clock);
    snprintf(out, size, "%s (sundial time %02d:%02d)", clock, minute / 60, minute % 60);
}

static double pixel_m(const struct gn_pose *pose, const struct gn_frame_opts *opts) {
    struct gn_framing_opts as = opts->view.framing;
    struct gn_framing framing;
    vec3 centre;
    const float width = (float)opts->output.width_px, height = (float)opts->output.height_px;
    if (opts->output.width_px == 0 || opts->output.height_px == 0) return NAN;
    as.aspect = width / height;
    gn_framing_build(pose, (uint32_t)opts->view.camera, &as, &framing);
    glm_vec3_center((float *)pose->box_ws.min, (float *)pose->box_ws.max, centre);
    const float half_m =
        framing.camera.orthographic
            ? framing.camera.ymag_m
            : tanf(framing.camera.yfov_rad / 2) * glm_vec3_distance(centre, framing.eye_ws);
    return 2 * (double)(half_m / height);
}

double gn_stage_sun_step_s(const struct gn_pose *pose, const struct gn_frame_opts *opts,
                           double altitude_deg) {
    static const int parts[] = {60, 30, 20, 15, 12, 10, 6, 5, 4, 3, 2};
    const double turn = 15.04 * M_PI / 180 / 3600;
    const double altitude = altitude_deg * M_PI / 180;
    const double height_m = (double)(pose->box_ws.max[1] - pose->box_ws.min[1]);
    const double across_m =
        (double)glm_vec3_distance((float *)pose->box_ws.min, (float *)pose->box_ws.max);
    const double long_m = fmin(height_m / fmax(sin(altitude), 1e-3), across_m);
    const double still_s = pixel_m(pose, opts) / (turn * long_m);
    const double most_s = altitude < LOW_SUN ? fmin(still_s, 12) : still_s;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if (most_s >= parts[i]) return parts[i];
    return 1;
}

static bool aim_sun(struct gn_pose *pose, struct gn_frame_opts *opts,
                    const struct gn_settings *settings) {
    const int light = gn_stage_sun_is_set(settings) ? gn_stage_sun_light(pose->scene) : -1;
    const float north_deg = pose->scene->environment.north_deg;
    const bool is_shown =
        settings->run.command == GN_COMMAND_SHOW || settings->run.command == GN_COMMAND_AUTO;
    const struct gn_sun_view view = gn_stage_sun_view(settings, opts->view.sun_utc_s);
    struct gn_daylight daylight;
    vec3 along;
    if (light < 0) return false;
    gn_daylight_build(view.altitude_deg, settings->sun.turbidity, &daylight);
    /* what has set has no light, and its maps stay those of the horizon */
    gn_sun_direction(view.azimuth_deg, fmax(view.altitude_deg, 0), (double)north_deg, along);
    glm_vec3_negate(along);
    gn_pose_aim(pose, (uint32_t)light, along);
    struct gn_light_opts *entry = gn_stage_light_entry(&opts->shadow, (uint32_t)light);
    if (entry) {
        entry->given |= GN_LIGHT_GIVEN(color);
        memcpy(entry->color, daylight.sun, sizeof entry->color);
    }
    if (opts->environment.is_sky)
        gn_stage_sky_set(&opts->environment, &daylight, view.azimuth_deg, north_deg, is_shown);
    return true;
}

void gn_stage_aim_lights(struct gn_pose *pose, struct gn_frame_opts *opts,
                         const struct gn_settings *settings) {
    if (!aim_sun(pose, opts, settings)) gn_stage_aim(pose, opts, settings);
}
