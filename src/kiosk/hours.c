/* [schedule]: the screen off, or darker, by the local clock. The clock is looked at when the next
 * minute begins and every ten seconds, so that one that jumps is noticed. While it is not set the
 * screen stays on: boards without a clock of their own start in the past. */
#include <time.h>

#include "core/clock.h"
#include "kiosk/part.h"

struct hours {
    const struct gn_part_host *host;
    struct gn_timer timer;
    bool is_set, was_set; /* the clock, at the last look; it was once */
    bool dims;            /* these are hours of dim */
    bool is_on;           /* for the status, as is the next */
    int64_t next_s;
};

static const struct gn_schedule_settings *settings_of(const struct hours *hours) {
    return &(*hours->host->options)->settings->schedule;
}

static bool is_set(struct hours *hours, int64_t time_s, bool trusts) {
    if (time_s < GN_CLOCK_PAST_S) return false;
    hours->was_set |= trusts || gn_clock_was_set();
    return hours->was_set;
}

static void look_at_clock(void *user, int64_t now_ns) {
    struct hours *hours = user;
    const struct gn_part_host *h = hours->host;
    const struct gn_schedule_settings *o = settings_of(hours);
    struct timespec now;
    if (o->on.count == 0 && o->dim.count == 0 && !h->kiosk->asleep && !hours->dims) return;
    clock_gettime(CLOCK_REALTIME, &now);
    tzset();
    hours->is_set = is_set(hours, now.tv_sec, o->clock_trusted);
    const struct gn_kiosk_event event = {.kind = GN_KIOSK_HOURS,
                                         .time_ns = now_ns,
                                         .by = hours->is_set &&
                                               !gn_schedule_is_on(&o->on, now.tv_sec)};
    *h->kiosk = gn_kiosk_step(h->rules, h->kiosk, &event);
    const bool dims = hours->is_set && o->dim.count > 0 && gn_schedule_is_on(&o->dim, now.tv_sec);
    *h->changed |= dims != hours->dims;
    hours->dims = dims;
    const int64_t minute_s = 60 - now.tv_sec % 60;
    hours->timer.due_ns = now_ns + (minute_s < 10 ? minute_s : 10) * GN_NS_PER_S - now.tv_nsec;
}

static void open_hours(void *part) {
    struct hours *hours = part;
    hours->timer = (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = look_at_clock, .user = part};
    gn_loop_add_timer(hours->host->loop, &hours->timer);
    look_at_clock(part, gn_loop_now_ns(hours->host->loop));
}

static void reopen_hours(void *part) {
    struct hours *hours = part;
    hours->timer.due_ns = GN_LOOP_NEVER;
    look_at_clock(part, gn_loop_now_ns(hours->host->loop));
}

static void close_hours(void *part) { gn_loop_remove_timer(&((struct hours *)part)->timer); }

static void dim_frame(void *part, struct gn_frame_opts *opts) {
    const struct hours *hours = part;
    opts->cover.dimmed = hours->dims ? 1.0f - (float)settings_of(hours)->dim_to : 0.0f;
}

static const void *hours_status(void *part) {
    struct hours *hours = part;
    const struct gn_schedule_settings *o = settings_of(hours);
    if (o->on.count == 0 && o->dim.count == 0) return NULL;
    const int64_t next_s = gn_schedule_next(&o->on, time(NULL));
    hours->is_on = !hours->host->kiosk->asleep;
    hours->next_s = next_s == INT64_MAX ? 0 : next_s;
    return hours;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct hours, is_on, "schedule.on", "", "these are hours in which the screen is on"),
    GN_METRIC(struct hours, dims, "schedule.dim", "", "these are hours in which it is darker"),
    GN_METRIC(struct hours, is_set, "schedule.clock", "", "the clock is set"),
    GN_METRIC(struct hours, next_s, "schedule.next", "s",
              "when the screen is switched next, since 1970; 0: not within eight days"),
};

const struct gn_part gn_part_schedule = {
    .name = "schedule",
    .size = sizeof(struct hours),
    .open = open_hours,
    .reopen = reopen_hours,
    .add_frame = dim_frame,
    .status = hours_status,
    GN_PART_METRICS(metrics),
    .close = close_hours,
};
