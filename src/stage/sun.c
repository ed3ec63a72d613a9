#include "stage/sun.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "core/hash.h"
#include "core/sun.h"
#include "environment/daylight.h"
#include "options/date.h"
#include "stage/lights.h"

enum { THREADS = 2 };
/* A sky is made for the middle of such a cell of the sun's places, and kept while the sun is in it;
 * its brightness is exact. */
#define CELL_ALTITUDE_DEG 0.5
#define CELL_AZIMUTH_DEG  2.0

/* ---- settings ---- */

static bool has_place(const struct gn_settings *o, struct gn_place *place) {
    const struct gn_sun_settings *s = &o->sun;
    const bool flag = !isnan(s->place_deg[0]);
    place->latitude_deg = flag ? s->place_deg[0] : s->latitude_deg;
    place->longitude_deg = flag ? s->place_deg[1] : s->longitude_deg;
    return !isnan(place->latitude_deg) && !isnan(place->longitude_deg);
}

static bool depends_on_time(const struct gn_settings *o) {
    struct gn_place place;
    return has_place(o, &place) && (isnan(o->sun.azimuth_deg) || isnan(o->sun.altitude_deg));
}

static bool is_now(const struct gn_settings *o) {
    return !o->sun.date || strcmp(o->sun.date, "now") == 0;
}

bool gn_stage_sun_lacks_clock(const struct gn_settings *settings) {
    return depends_on_time(settings) && is_now(settings) && time(NULL) < GN_CLOCK_PAST_S;
}

bool gn_stage_sun_is_set(const struct gn_settings *settings) {
    struct gn_place place;
    const bool given = has_place(settings, &place) || !isnan(settings->sun.azimuth_deg) ||
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

bool gn_stage_sun_time(const struct gn_settings *settings, double *utc_s, struct gn_err *err) {
    const struct gn_sun_settings *s = &settings->sun;
    struct gn_date date;
    if (is_now(settings) || !gn_date_parse(s->date, &date)) {
        *utc_s = (double)time(NULL);
        return true;
    }
    return gn_date_utc(&date, s->time_zone, utc_s, err) ||
           gn_fail_prefix(err, "%s", gn_settings_label(settings, sun.time_zone));
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
    if (!gn_stage_sun_is_set(settings)) return true;
    const int light = gn_stage_sun_light(scene);
    warn_of_light(scene, light, warnings);
    if (light < 0) return true;
    if (!gn_stage_sun_time(settings, &opts->view.sun_utc_s, err)) return false;
    struct gn_light_opts *entry = gn_stage_light_entry(&opts->shadow, (uint32_t)light);
    if (entry) GN_LIGHT_SET(entry, radius, GN_SUN_TAN_RADIUS);
    opts->exposure_given = true;
    return true;
}

/* ---- the sky ---- */

struct cell {
    int altitude, azimuth;
    double turbidity;
    float north_deg;
};

/* Those of the modes of a process, and of a split screen's sides. */
static struct sky {
    bool made;
    struct cell cell;
    double base_strength, strength; /* of the light as it was made, as it is now */
    uint64_t id;
    struct gn_environment base, now;
} skies[2];
static int next_sky;

static struct sky *find_sky(const struct cell *cell) {
    for (int i = 0; i < 2; i++) {
        const struct cell *c = &skies[i].cell;
        if (skies[i].made && c->altitude == cell->altitude && c->azimuth == cell->azimuth &&
            c->turbidity == cell->turbidity && c->north_deg == cell->north_deg)
            return &skies[i];
    }
    struct gn_daylight daylight;
    struct sky *sky = &skies[next_sky];
    float to_sun[3];
    next_sky = (next_sky + 1) % 2;
    gn_daylight_build(cell->altitude * CELL_ALTITUDE_DEG, cell->turbidity, &daylight);
    gn_sun_direction(cell->azimuth * CELL_AZIMUTH_DEG, fmax(daylight.altitude_deg, 0),
                     (double)cell->north_deg, to_sun);
    gn_environment_make_sky(&daylight, to_sun, THREADS, &sky->base);
    sky->made = true;
    sky->cell = *cell;
    sky->base_strength = daylight.strength;
    sky->strength = 0;
    return sky;
}

static void set_sky(struct gn_frame_environment_opts *e, const struct gn_daylight *daylight,
                    double azimuth_deg, float north_deg) {
    const struct cell cell = {.altitude = (int)lround(daylight->altitude_deg / CELL_ALTITUDE_DEG),
                              .azimuth = (int)lround(azimuth_deg / CELL_AZIMUTH_DEG),
                              .turbidity = daylight->turbidity,
                              .north_deg = north_deg};
    struct sky *sky = find_sky(&cell);
    if (sky->strength != daylight->strength) {
        sky->strength = daylight->strength;
        gn_environment_scale(&sky->base.whole, (float)(sky->strength / sky->base_strength),
                             &sky->now.whole);
        sky->id =
            (gn_hash(GN_HASH_INIT, &sky->now.whole, sizeof sky->now.whole) | 4) & ~UINT64_C(3);
    }
    e->of = &sky->now;
    e->id = sky->id;
    e->lights_key = e->shows_key = e->reflected_only = false;
}

/* ---- the moment ---- */

static bool aim_sun(struct gn_pose *pose, struct gn_frame_opts *opts,
                    const struct gn_settings *settings) {
    const struct gn_sun_settings *s = &settings->sun;
    const int light = gn_stage_sun_is_set(settings) ? gn_stage_sun_light(pose->scene) : -1;
    const float north_deg = pose->scene->environment.north_deg;
    struct gn_place place;
    struct gn_sun_view view = {.azimuth_deg = 180, .altitude_deg = 45};
    struct gn_daylight daylight;
    vec3 along;
    if (light < 0) return false;
    if (has_place(settings, &place)) view = gn_sun_view(opts->view.sun_utc_s, &place);
    if (!isnan(s->azimuth_deg)) view.azimuth_deg = fmod(s->azimuth_deg + 360, 360);
    if (!isnan(s->altitude_deg)) view.altitude_deg = s->altitude_deg;
    gn_daylight_build(view.altitude_deg, s->turbidity, &daylight);
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
        set_sky(&opts->environment, &daylight, view.azimuth_deg, north_deg);
    return true;
}

void gn_stage_aim_lights(struct gn_pose *pose, struct gn_frame_opts *opts,
                         const struct gn_settings *settings) {
    if (!aim_sun(pose, opts, settings)) gn_stage_aim(pose, opts, settings);
}
