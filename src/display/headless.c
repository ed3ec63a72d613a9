/* A screen that nobody sees, 60 times a second: the kiosk's tests run on it. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "display/kms/flip.h"
#include "display/private.h"

static bool settle(struct gn_display *display, int64_t now_ns) {
    struct gn_flip *flip = display->unseen;
    struct gn_screen *s = &display->screen;
    const int64_t at_ns = gn_flip_deadline(flip, now_ns);
    const struct itimerspec never = {0},
                            when = {.it_value = {at_ns / GN_NS_PER_S, at_ns % GN_NS_PER_S}};
    s->lit = !s->blank;
    s->may_draw = s->lit && gn_flip_may_draw(flip, now_ns);
    s->seen_ns = gn_flip_seen_ns(flip, now_ns);
    s->counts.shown = flip->shown;
    s->counts.missed = flip->missed;
    timerfd_settime(s->fd, TFD_TIMER_ABSTIME, at_ns == INT64_MAX ? &never : &when, NULL);
    return true;
}

static bool unseen_open(struct gn_display *display, const struct gn_screen_opts *opts,
                        int64_t now_ns, struct gn_warnings *warnings, struct gn_err *err) {
    (void)warnings;
    struct gn_screen *s = &display->screen;
    struct gn_flip *flip = display->unseen = gn_xalloc(1, sizeof *flip);
    flip->blind = true;
    flip->period_ns = GN_NS_PER_S / 60;
    flip->shortest_ns = opts->max_fps > 0 ? GN_NS_PER_S / opts->max_fps : 0;
    *s = (struct gn_screen){
        .fd = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK),
        .has_context = true,
        .generation = 1,
        .lit = true,
        .width_px = opts->width_px ? opts->width_px : 1280,
        .height_px = opts->height_px ? opts->height_px : 720,
        .rotate_deg = opts->rotate_deg,
        .period_ns = flip->period_ns,
    };
    if (s->fd < 0) return gn_fail(err, "cannot make a timer: %s", strerror(errno));
    return settle(display, now_ns);
}

static bool unseen_dispatch(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    return settle(display, now_ns); /* which sets the timer anew: there is nothing to read */
}

static bool unseen_renew(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    return settle(display, now_ns);
}

static bool unseen_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    if (!display->screen.may_draw) return false;
    gn_flip_begun(display->unseen, now_ns);
    return settle(display, now_ns);
}

static bool unseen_present(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    gn_flip_committed(display->unseen, now_ns);
    gn_flip_done(display->unseen, now_ns, now_ns);
    return settle(display, now_ns);
}

static void unseen_blank(struct gn_display *display, bool on, int64_t now_ns) {
    display->screen.blank = on;
    settle(display, now_ns);
}

void gn_screen_unseen_close(struct gn_display *display) {
    if (!display->unseen) return;
    if (display->screen.fd >= 0) close(display->screen.fd);
    free(display->unseen);
    display->unseen = NULL;
}

const struct gn_screen_ops gn_screen_unseen = {
    .open = unseen_open,
    .dispatch = unseen_dispatch,
    .renew = unseen_renew,
    .begin = unseen_begin,
    .present = unseen_present,
    .blank = unseen_blank,
};
