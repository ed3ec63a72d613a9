/* [schedule]: the screen off, or darker, by the local clock. The clock is looked at when the next
 * minute begins and every ten seconds, so that one that jumps is noticed. While it is not set the
 * screen stays on: boards without a clock of their own start in the past. */
#include <stdio.h>
#include <time.h>

#include "core/clock.h"
#include "kiosk/private.h"

static bool is_set(struct gn_show_hours *hours, int64_t time_s, bool trusts) {
    if (time_s < GN_CLOCK_PAST_S) return false;
    hours->was_set |= trusts || gn_clock_was_set();
    return hours->was_set;
}

static void look_at_clock(void *user, int64_t now_ns) {
    struct gn_show *s = user;
    const struct gn_schedule_settings *o = &s->config.options->settings->schedule;
    struct timespec now;
    if (o->on.count == 0 && o->dim.count == 0 && !s->kiosk.asleep && !s->hours.dims) return;
    clock_gettime(CLOCK_REALTIME, &now);
    tzset();
    s->hours.is_set = is_set(&s->hours, now.tv_sec, o->clock_trusted);
    const struct gn_kiosk_event event = {.kind = GN_KIOSK_HOURS,
                                         .time_ns = now_ns,
                                         .by = s->hours.is_set &&
                                               !gn_schedule_is_on(&o->on, now.tv_sec)};
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &event);
    const bool dims = s->hours.is_set && o->dim.count > 0 && gn_schedule_is_on(&o->dim, now.tv_sec);
    s->changed |= dims != s->hours.dims;
    s->hours.dims = dims;
    const int64_t minute_s = 60 - now.tv_sec % 60;
    s->hours.timer.due_ns = now_ns + (minute_s < 10 ? minute_s : 10) * GN_NS_PER_S - now.tv_nsec;
}

void gn_show_open_hours(struct gn_show *s) {
    if (!s->hours.timer.call) {
        s->hours.timer = (struct gn_timer){.call = look_at_clock, .user = s};
        gn_loop_add_timer(s->loop, &s->hours.timer);
    }
    s->hours.timer.due_ns = GN_LOOP_NEVER;
    look_at_clock(s, gn_loop_now_ns(s->loop));
}
