#include "stage/sun_hours.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/sun.h"
#include "image/write.h"
#include "options/date.h"
#include "stage/lights.h"
#include "stage/rays.h"
#include "stage/sun.h"

#define DAY_S 86400.0

/* ---- when and where ---- */

static bool check_settings(const struct gn_settings *o, struct gn_place *place,
                           struct gn_err *err) {
    if (!gn_stage_sun_place(o, place))
        return gn_fail_usage(err, "--aov sun-hours: no place: add --sun LAT,LON, or latitude and "
                                  "longitude of [sun]");
    if (!isnan(o->sun.azimuth_deg) || !isnan(o->sun.altitude_deg))
        return gn_fail_usage(err, "--aov sun-hours: the sun goes through a day: leave out %s",
                             isnan(o->sun.azimuth_deg) ? gn_settings_label(o, sun.altitude_deg)
                                                       : gn_settings_label(o, sun.azimuth_deg));
    if (!o->run.from != !o->run.to)
        return gn_fail_usage(err, "%s: --from and --to are given together",
                             o->run.from ? "--from" : "--to");
    if (!o->run.from && !gn_settings_given(o, sun.date))
        return gn_fail_usage(err, "--aov sun-hours: no date: add --date 2026-12-21, or --from and "
                                  "--to with a time, as 2026-12-21T09:00");
    return true;
}

static bool check_moment(const char *flag, const char *text, struct gn_err *err) {
    struct gn_date date;
    return (gn_date_parse(text, &date) && date.has_time) ||
           gn_fail_usage(err, "%s %s: no time: write it as 2026-12-21T09:00", flag, text);
}

static bool find_moments(struct gn_sun_hours *h, const struct gn_settings *o, struct gn_err *err) {
    if (!check_moment("--from", o->run.from, err) || !check_moment("--to", o->run.to, err) ||
        !gn_stage_sun_moment(o, o->run.from, &h->begin_s, err) ||
        !gn_stage_sun_moment(o, o->run.to, &h->end_s, err))
        return false;
    if (h->end_s <= h->begin_s)
        return gn_fail_usage(err, "--to %s: that is not later than --from", o->run.to);
    return h->end_s - h->begin_s <= DAY_S ||
           gn_fail_usage(err, "--to %s: that is more than a day after --from", o->run.to);
}

/* From sunrise to sunset; 12 hours before and after noon where there is none. */
static void find_day(struct gn_sun_hours *h, const struct gn_place *place, double utc_s) {
    const struct gn_sun_day day = gn_sun_day(utc_s, place);
    h->begin_s = isnan(day.rise_s) ? day.noon_s - DAY_S / 2 : day.rise_s;
    h->end_s = isnan(day.set_s) ? day.noon_s + DAY_S / 2 : day.set_s;
}

/* ---- the sun's positions ---- */

/* A point of the disk for each: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences"
 * (2018), by equal areas. What is below the horizon is left out. */
static void add_position(struct gn_sun_hours *h, uint32_t i, const struct gn_place *place,
                         double north_deg) {
    const struct gn_sun_view view = gn_sun_view(h->begin_s + (i + 0.5) * h->step_h * 3600, place);
    const double turn = 2 * M_PI * fmod(0.7548776662466927 * i, 1),
                 radius_deg = GN_SUN_RADIUS_DEG / view.sun.distance_au *
                              sqrt(fmod(0.5698402909980532 * i + 0.5, 1)),
                 altitude_deg = view.altitude_deg + radius_deg * sin(turn),
                 across = fmax(cos(altitude_deg * M_PI / 180), 1e-6);
    if (altitude_deg <= 0) return;
    gn_sun_direction(view.azimuth_deg + radius_deg * cos(turn) / across, altitude_deg, north_deg,
                     h->to_ws[h->count++]);
}

/* when: for the message, as "on 2026-12-21". */
static bool add_positions(struct gn_sun_hours *h, const struct gn_scene *scene,
                          const struct gn_place *place, const char *when, struct gn_err *err) {
    const int light = gn_stage_sun_light(scene);
    if (light < 0)
        return gn_fail(err, "hours of sun: the scene has lights, but no directional one that "
                            "can be the sun");
    h->light = (uint32_t)light;
    h->step_h = (h->end_s - h->begin_s) / 3600 / GN_SUN_POSITIONS;
    for (uint32_t i = 0; i < GN_SUN_POSITIONS; i++)
        add_position(h, i, place, (double)scene->environment.north_deg);
    return h->count > 0 ||
           gn_fail(err, "hours of sun: at %.2f, %.2f the sun stays below the horizon %s",
                   place->latitude_deg, place->longitude_deg, when);
}

bool gn_sun_hours_build(struct gn_sun_hours *h, const struct gn_settings *settings,
                        const struct gn_scene *scene, struct gn_err *err) {
    const char *from = settings->run.from;
    struct gn_place place;
    double utc_s;
    char when[100];
    *h = (struct gn_sun_hours){0};
    if (!check_settings(settings, &place, err)) return false;
    if (from ? !find_moments(h, settings, err)
             : !gn_stage_sun_moment(settings, settings->sun.date, &utc_s, err))
        return false;
    if (!from) find_day(h, &place, utc_s);
    if (from)
        snprintf(when, sizeof when, "from %.40s to %.40s", from, settings->run.to);
    else
        snprintf(when, sizeof when, "on %.40s", settings->sun.date);
    return add_positions(h, scene, &place, when, err);
}

bool gn_sun_hours_build_day(struct gn_sun_hours *h, const struct gn_settings *settings,
                            const struct gn_scene *scene, double utc_s, struct gn_err *err) {
    struct gn_place place;
    *h = (struct gn_sun_hours){0};
    if (!gn_stage_sun_place(settings, &place))
        return gn_fail_usage(err, "hours of sun: no place: add latitude and longitude of [sun]");
    find_day(h, &place, utc_s);
    return add_positions(h, scene, &place, "that day", err);
}

/* ---- a picture of them ---- */

void gn_sun_hours_look(struct gn_frame_opts *opts, uint32_t light, enum gn_sun_look look) {
    struct gn_light_opts *own = gn_stage_light_entry(&opts->shadow, light);
    opts->output.msaa = 0;
    opts->cover = (struct gn_frame_cover_opts){0};
    opts->detail = (struct gn_frame_detail_opts){0};
    opts->debug.aov = (enum gn_aov)look;
    opts->debug.light = (int)light;
    opts->debug.faced = true;
    if (!own) return;
    GN_LIGHT_SET(own, technique, GN_TECHNIQUE_HARD);
    GN_LIGHT_SET(own, map_format, GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_NONE));
}

void gn_sun_hours_aim(const struct gn_sun_hours *h, struct gn_pose *pose, uint32_t position) {
    vec3 along;
    glm_vec3_negate_to((float *)h->to_ws[position], along);
    gn_pose_aim(pose, h->light, along);
}

struct drawing {
    struct gn_stage *stage;
    struct gn_view view; /* of its own: the shown one stays as it is */
    struct gn_warnings *warnings;
    struct gn_err *err;
};

static const struct gn_plan *draw(struct drawing *d, const struct gn_sun_hours *h,
                                  enum gn_sun_look look, float *rgba) {
    gn_sun_hours_look(&d->view.opts, h->light, look);
    const struct gn_plan *plan = gn_view_plan(&d->view, d->stage->gl, d->warnings, d->err);
    return plan && gn_gl_run(d->stage->gl, plan, NULL, d->err) &&
                   gn_gl_read_f32(d->stage->gl, rgba, d->err)
               ? plan
               : NULL;
}

static bool add_maps(struct drawing *d, const struct gn_sun_hours *h, size_t pixels, float *rgba,
                     struct gn_sun_hours_picture *out) {
    for (uint32_t i = 0; i < h->count; i++) {
        gn_sun_hours_aim(h, d->view.pose, i);
        if (!draw(d, h, GN_SUN_VISIBILITY, rgba)) return false;
        for (size_t k = 0; k < pixels; k++) out->hours[k] += rgba[4 * k];
        if (d->stage->truth.progress)
            d->stage->truth.progress(d->stage->truth.user, (double)(i + 1) / h->count);
    }
    return true;
}

/* Sums to hours; the background has no normal. */
static void finish_sums(const struct gn_sun_hours *h, size_t pixels, bool is_cast,
                        struct gn_sun_hours_picture *out) {
    for (size_t k = 0; k < pixels; k++) {
        const bool none =
            is_cast ? out->hours[k] < 0.0f : glm_vec3_norm2(out->normal_ws[k]) < 0.25f;
        out->hours[k] = none ? GN_SUN_HOURS_NONE : out->hours[k] * (float)h->step_h;
    }
}

bool gn_sun_hours_draw(const struct gn_sun_hours *h, struct gn_stage *stage, int64_t time_ns,
                       struct gn_sun_hours_picture *out, struct gn_warnings *warnings,
                       struct gn_err *err) {
    const struct gn_frame_output_opts *output = &stage->shown.opts.output;
    const size_t pixels = (size_t)output->width_px * output->height_px;
    const bool casts = stage->shown.opts.shadow.any.technique == GN_TECHNIQUE_TRUTH;
    struct drawing d = {.stage = stage, .warnings = warnings, .err = err};
    float *rgba = gn_picture_alloc(pixels, 4 * sizeof *rgba, err);
    out->hours = rgba ? gn_picture_alloc(pixels, sizeof *out->hours, err) : NULL;
    out->normal_ws = out->hours ? gn_picture_alloc(pixels, sizeof *out->normal_ws, err) : NULL;
    bool ok = out->normal_ws;
    if (ok) {
        gn_view_pose(&stage->shown, stage->settings, time_ns);
        gn_view_share(&d.view, GN_VIEW_STILL, &stage->shown, &stage->shown.opts);
        const struct gn_plan *plan = draw(&d, h, GN_SUN_NORMAL, *out->normal_ws);
        ok = plan &&
             (casts ? gn_stage_cast_sun(stage, &d.view, plan, h->to_ws, h->count, out->hours, err)
                    : add_maps(&d, h, pixels, rgba, out));
    }
    if (ok) finish_sums(h, pixels, casts, out);
    gn_view_close(&d.view, stage->gl);
    free(rgba);
    return ok;
}

void gn_sun_hours_finish(struct gn_sun_hours_picture *picture) {
    free(picture->hours);
    free(picture->normal_ws);
    *picture = (struct gn_sun_hours_picture){0};
}
