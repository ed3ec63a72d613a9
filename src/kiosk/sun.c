/* [sun]: its time is the clock's, or runs from a date; actions move it on and back. A frame is
 * drawn when the shadow has moved by about a pixel (gn_stage_sun_step_s()). By the clock its steps
 * are counted from whole minutes, so that at each of these moments the picture is that of `render
 * --date`. */
#include <math.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/info_page.h"
#include "kiosk/part.h"
#include "stage/stage.h"
#include "stage/sun.h"

#define SHORTEST_S (1 / 60.0)
#define JUMP_S     12.0 /* until a jump of the clock is seen */
/* the years of which core/sun.h says how far it errs */
#define FIRST_S    (-2208988800.0)
#define LAST_S     4133980799.0

struct sun {
    const struct gn_part_host *host;
    struct gn_timer timer;
    const struct gn_settings *of; /* those that time runs by */
    int64_t begun_ns;             /* since when, if it is not the clock's, */
    double begun_utc_s;           /* and from which moment */
    double utc_s;                 /* of what is shown; NAN: there is no sun that moves */
    double step_s;                /* of the clock, from frame to frame */
    int64_t ahead_s;              /* by actions, of that */
    char text[96];                /* the moment by the clock and by the sun */
    bool moves;                   /* with time; for the status */
    bool was_unset;               /* the clock */
};

static double clock_s(void) { return (double)gn_clock_day_ns() * 1e-9; }

static bool is_of_clock(const struct gn_settings *o) {
    return (!o->sun.date || strcmp(o->sun.date, "now") == 0) && o->sun.speed == 1;
}

static void begin_run(struct sun *sun, const struct gn_settings *o, int64_t now_ns) {
    sun->begun_ns = now_ns;
    sun->begun_utc_s = clock_s();
    if (o->sun.date && strcmp(o->sun.date, "now") != 0)
        gn_stage_sun_time(o, &sun->begun_utc_s, NULL);
}

/* The moment that is to be shown; *left_s: until another one is. */
static double find_moment(struct sun *sun, const struct gn_settings *o, int64_t now_ns,
                          double *left_s) {
    const bool of_clock = is_of_clock(o);
    if (!of_clock && sun->of != o) begin_run(sun, o, now_ns);
    const double now_s =
        of_clock ? clock_s()
                 : sun->begun_utc_s + o->sun.speed * (double)(now_ns - sun->begun_ns) * 1e-9;
    const double altitude_deg = gn_stage_sun_view(o, now_s + (double)sun->ahead_s).altitude_deg;
    const struct gn_stage *stage = sun->host->stage;
    if (stage->scene)
        sun->step_s = gn_stage_sun_step_s(&stage->pose, &stage->shown.opts, altitude_deg);
    *left_s = fmax(sun->step_s / fabs(o->sun.speed), SHORTEST_S);
    if (!of_clock) return now_s;
    const double shown_s = floor(now_s / sun->step_s) * sun->step_s;
    *left_s = fmin(shown_s + sun->step_s - now_s, JUMP_S);
    return shown_s;
}

/* A clock that is set at last brings the sun, whose looks are built anew. */
static void look_for_clock(struct sun *sun, const struct gn_settings *o, int64_t now_ns) {
    const bool unset = gn_stage_sun_lacks_clock(o);
    if (unset && !sun->was_unset)
        sun->host->report_error(sun->host->show, GN_PROBLEM_CLOCK,
                                "sun: the clock is not set; until it is, lights are the file's");
    if (!unset && sun->was_unset) {
        sun->host->cure_error(sun->host->show, GN_PROBLEM_CLOCK);
        sun->host->renew(sun->host->show, false);
    }
    sun->was_unset = unset;
    if (unset) sun->timer.due_ns = now_ns + 10 * GN_NS_PER_S;
}

/* Hours of sun are of the whole day, and the picture below them has one sun: that of its noon. */
static double of_day(const struct gn_settings *o, double utc_s) {
    struct gn_place place;
    if (!o->sun.hours || !gn_stage_sun_place(o, &place)) return utc_s;
    return floor(gn_sun_day(utc_s, &place).noon_s);
}

static void follow(void *user, int64_t now_ns) {
    struct sun *sun = user;
    const struct gn_settings *o = *sun->host->settings;
    double left_s = INFINITY, utc_s = NAN;
    sun->timer.due_ns = GN_LOOP_NEVER;
    look_for_clock(sun, o, now_ns);
    sun->ahead_s = sun->host->kiosk->sun_ahead_s;
    if (gn_stage_sun_moves(o))
        utc_s = fmin(fmax(find_moment(sun, o, now_ns, &left_s) + (double)sun->ahead_s, FIRST_S),
                     LAST_S);
    sun->of = o;
    if (!isnan(utc_s)) utc_s = of_day(o, utc_s);
    *sun->host->changed |= !isnan(utc_s) && utc_s != sun->utc_s;
    sun->utc_s = utc_s;
    gn_stage_sun_print(o, utc_s, sun->text, sizeof sun->text);
    sun->moves = !isnan(utc_s);
    if (isfinite(left_s) && left_s < 1e6)
        sun->timer.due_ns = now_ns + (int64_t)ceil(left_s * (double)GN_NS_PER_S);
}

static void open_sun(void *part) {
    struct sun *sun = part;
    sun->timer = (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = follow, .user = part};
    sun->utc_s = NAN;
    sun->step_s = 12; /* until there is a scene */
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
    if (sun->of != *sun->host->settings || sun->ahead_s != sun->host->kiosk->sun_ahead_s)
        follow(part, gn_loop_now_ns(sun->host->loop));
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

static void add_sun_info(void *part, struct gn_info *info) {
    step_sun(part);
    info->sun = ((const struct sun *)part)->text;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct sun, moves, "sun.moves", "", "the sun is that of a place and a time"),
    GN_METRIC(struct sun, text, "sun.shown", "", "the moment shown, by the clock and by the sun",
              .brief = true),
    GN_METRIC(struct sun, ahead_s, "sun.ahead_s", "s", "how far actions have moved it"),
    GN_METRIC(struct sun, step_s, "sun.step_s", "s", "between two places of the sun, at speed 1"),
};

const struct gn_part gn_part_sun = {
    .name = "sun",
    .size = sizeof(struct sun),
    .open = open_sun,
    .reopen = reopen_sun,
    .step = step_sun,
    .add_frame = move_sun,
    .add_info = add_sun_info,
    .status = sun_status,
    GN_PART_METRICS(metrics),
    .close = close_sun,
};
