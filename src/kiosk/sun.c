/* [sun]: its time is the clock's, or runs from a date. A frame is drawn when the shadow has moved
 * by about a pixel: the sun goes a twentieth of a degree in 12 seconds, which are counted from
 * whole minutes, so that at each of these moments the picture is that of `render --date`. */
#include <math.h>
#include <string.h>
#include <time.h>

#include "core/clock.h"
#include "kiosk/part.h"
#include "stage/sun.h"

#define STEP_S     12.0
#define SHORTEST_S (1 / 60.0)

struct sun {
    const struct gn_part_host *host;
    struct gn_timer timer;
    const struct gn_settings *of; /* those that time runs by */
    int64_t begun_ns;             /* since when, if it is not the clock's, */
    double begun_utc_s;           /* and from which moment */
    double utc_s;                 /* of what is shown; NAN: there is no sun that moves */
    bool moves;                   /* with time; for the status */
    bool was_unset;               /* the clock */
};

static double clock_s(const struct sun *sun) {
    struct timespec now;
    if (sun->host->day_ahead_ns)
        return (double)(gn_loop_now_ns(sun->host->loop) + *sun->host->day_ahead_ns) * 1e-9;
    clock_gettime(CLOCK_REALTIME, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static bool is_of_clock(const struct gn_settings *o) {
    return (!o->sun.date || strcmp(o->sun.date, "now") == 0) && o->sun.speed == 1;
}

static void begin_run(struct sun *sun, const struct gn_settings *o, int64_t now_ns) {

    sun->begun_ns = now_ns;
    sun->begun_utc_s = clock_s(sun);
    if (o->sun.date && strcmp(o->sun.date, "now") != 0)
        gn_stage_sun_time(o, &sun->begun_utc_s, NULL);
}

/* The moment that is to be shown; *left_s: until another one is. */
static double find_moment(struct sun *sun, const struct gn_settings *o, int64_t now_ns,
                          double *left_s) {
    if (is_of_clock(o)) {
        const double now_s = clock_s(sun), shown_s = floor(now_s / STEP_S) * STEP_S;
        *left_s = shown_s + STEP_S - now_s;
        return shown_s;
    }
    if (sun->of != o) begin_run(sun, o, now_ns);
    *left_s = fmax(STEP_S / fabs(o->sun.speed), SHORTEST_S);
    return sun->begun_utc_s + o->sun.speed * (double)(now_ns - sun->begun_ns) * 1e-9;
}

/* A clock that is set at last brings the sun, whose looks are built anew. */
static void look_for_clock(struct sun *sun, const struct gn_settings *o, int64_t now_ns) {
    const bool unset = gn_stage_sun_lacks_clock(o);
    if (unset && !sun->was_unset)
        sun->host->report_error(sun->host->show, GN_PROBLEM_CONFIG,
                                "sun: the clock is not set; until it is, lights are the file's");
    if (!unset && sun->was_unset) sun->host->renew(sun->host->show, false);
    sun->was_unset = unset;
    if (unset) sun->timer.due_ns = now_ns + 10 * GN_NS_PER_S;
}

static void follow(void *user, int64_t now_ns) {
    struct sun *sun = user;
    const struct gn_settings *o = *sun->host->settings;
    double left_s = INFINITY, utc_s = NAN;
    sun->timer.due_ns = GN_LOOP_NEVER;
    look_for_clock(sun, o, now_ns);
    if (gn_stage_sun_moves(o)) utc_s = find_moment(sun, o, now_ns, &left_s);
    sun->of = o;
    *sun->host->changed |= !isnan(utc_s) && utc_s != sun->utc_s;
    sun->utc_s = utc_s;
    sun->moves = !isnan(utc_s);
    if (isfinite(left_s) && left_s < 1e6)
        sun->timer.due_ns = now_ns + (int64_t)ceil(left_s * (double)GN_NS_PER_S);
}

static void open_sun(void *part) {
    struct sun *sun = part;
    sun->timer = (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = follow, .user = part};
    sun->utc_s = NAN;
    gn_loop_add_timer(sun->host->loop, &sun->timer);
    follow(part, gn_loop_now_ns(sun->host->loop));
}

/* The settings may lie where others lay before. */
static void reopen_sun(void *part) {
    struct sun *sun = part;
    sun->of = NULL;
    follow(part, gn_loop_now_ns(sun->host->loop));
}

/* Another mode may have another date, and a frame of it the moment of its own. */
static void step_sun(void *part) {
    struct sun *sun = part;
    if (sun->of != *sun->host->settings) follow(part, gn_loop_now_ns(sun->host->loop));
}

static void close_sun(void *part) { gn_loop_remove_timer(&((struct sun *)part)->timer); }

static void move_sun(void *part, struct gn_frame_opts *opts) {
    const struct sun *sun = part;
    step_sun(part);
    if (!isnan(sun->utc_s)) opts->view.sun_utc_s = sun->utc_s;
}

static const void *sun_status(void *part) {
    const struct sun *sun = part;
    return sun->moves ? sun : NULL;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct sun, moves, "sun.moves", "", "the sun is that of a place and a time"),
};

const struct gn_part gn_part_sun = {
    .name = "sun",
    .size = sizeof(struct sun),
    .open = open_sun,
    .reopen = reopen_sun,
    .step = step_sun,
    .add_frame = move_sun,
    .status = sun_status,
    GN_PART_METRICS(metrics),
    .close = close_sun,
};
