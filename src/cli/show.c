/* gnomon show: the kiosk. So far on an invisible display only, at 60 Hz or max_fps: it runs,
 * animates, draws nothing while nothing changes, and ends cleanly on SIGTERM or SIGINT. */
#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/stage.h"
#include "cli/stop.h"
#include "core/arena.h"
#include "core/clock.h"

struct show {
    struct gn_stage stage;
    int signals, timer; /* descriptors, -1 when not open */
    int64_t begun_ns, period_ns;
    uint64_t ticks, most_ticks, frames, missed;
    bool moves;
};

/* Before anything else, and for good: a signal that comes while the scene loads, or a second one at
 * the end, ends the kiosk as well as any other. */
static bool open_signals(struct show *s, struct gn_err *err) {
    sigset_t ends;
    gn_stop_block(&ends);
    s->signals = signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
    return s->signals >= 0 || gn_fail(err, "show: cannot wait for signals: %s", strerror(errno));
}

static bool open_timer(struct show *s, struct gn_err *err) {
    s->timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
    int fps = s->stage.options->max_fps > 0 && s->stage.options->max_fps < 60
                  ? s->stage.options->max_fps
                  : 60;
    s->period_ns = GN_NS_PER_S / fps;
    struct timespec period = {s->period_ns / GN_NS_PER_S, s->period_ns % GN_NS_PER_S};
    struct itimerspec every = {period, period};
    if (s->timer < 0 || timerfd_settime(s->timer, 0, &every, NULL) < 0)
        return gn_fail(err, "show: cannot make a timer: %s", strerror(errno));
    return true;
}

static void close_loop(struct show *s) {
    if (s->signals >= 0) close(s->signals);
    if (s->timer >= 0) close(s->timer);
}

static bool draw(struct show *s, struct gn_warnings *warnings, struct gn_err *err) {
    int64_t time_ns = s->stage.options->time_ns + gn_clock_monotonic_ns() - s->begun_ns;
    if (!gn_stage_draw(&s->stage, s->moves ? time_ns : s->stage.options->time_ns, warnings, err))
        return false;
    gn_gl_finish_frame(s->stage.gl);
    s->frames++;
    return true;
}

/* One wait: false when it is time to go. */
static bool wait_tick(struct show *s) {
    struct pollfd fds[2] = {{.fd = s->signals, .events = POLLIN},
                            {.fd = s->timer, .events = POLLIN}};
    bool timed =
        s->moves || s->most_ticks < UINT64_MAX; /* else nothing changes: sleep until a signal */
    while (poll(fds, timed ? 2 : 1, -1) < 0 && errno == EINTR) {
    }
    uint64_t ticks = 0;
    if (fds[1].revents && read(s->timer, &ticks, sizeof ticks) == sizeof ticks)
        s->missed += ticks - 1;
    s->ticks += ticks;
    return !fds[0].revents;
}

static bool run(struct show *s, struct gn_warnings *warnings, struct gn_err *err) {
    s->most_ticks =
        s->stage.options->frames > 0 ? (uint64_t)s->stage.options->frames - 1 : UINT64_MAX;
    s->begun_ns = gn_clock_monotonic_ns();
    if (!draw(s, warnings, err) || !open_timer(s, err)) return false;
    unsigned long allocations = gn_alloc_count();
    uint64_t objects = gn_gl_stats(s->stage.gl).objects_created;
    while (s->ticks < s->most_ticks && wait_tick(s))
        if (s->moves && !draw(s, warnings, err)) return false;
    if (s->stage.options->verbose)
        printf("%llu frames, %llu late, %lu allocations and %llu GL objects after the first\n",
               (unsigned long long)s->frames, (unsigned long long)s->missed,
               gn_alloc_count() - allocations,
               (unsigned long long)(gn_gl_stats(s->stage.gl).objects_created - objects));
    return true;
}

bool gn_cli_show(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    if (strcmp(options->backend, "auto") == 0)
        return gn_fail(err, "show: this version has no display on a screen; --backend egl or "
                            "osmesa runs the kiosk unseen");
    struct show s = {.signals = -1, .timer = -1};
    bool ok = open_signals(&s, err) && gn_stage_load(&s.stage, options, warnings, err) &&
              gn_stage_open(&s.stage, warnings, err);
    if (ok) {
        s.moves = s.stage.pose.animated || options->turntable_deg_s != 0.0;
        ok = run(&s, warnings, err);
    }
    close_loop(&s);
    gn_stage_close(&s.stage);
    return ok || gn_stop_asked(); /* what that broke off is no failure */
}
