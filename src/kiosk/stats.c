#include "kiosk/stats.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "core/clock.h"

bool gn_show_stats_open(struct gn_show_stats *s, const struct gn_settings *settings,
                        struct gn_err *err) {
    const struct itimerspec every = {{1, 0}, {1, 0}};
    s->tells_first = settings->run.stats || settings->run.verbose;
    s->last_ns = gn_clock_monotonic_ns();
    if (!settings->run.stats) return true;
    s->timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
    if (s->timer >= 0 && timerfd_settime(s->timer, 0, &every, NULL) == 0) return true;
    return gn_fail(err, "--stats: cannot make a timer: %s", strerror(errno));
}

void gn_show_stats_close(struct gn_show_stats *s) {
    if (s->timer >= 0) close(s->timer);
    s->timer = -1;
}

void gn_show_stats_frame(struct gn_show_stats *s, const struct gn_display *display,
                         int64_t draw_ns) {
    const struct gn_screen *screen = &display->screen;
    s->draw_ns += draw_ns;
    s->drawn++;
    s->all_drawn++;
    if (!s->tells_first || s->first_is_told || !screen->lit) return;
    s->first_is_told = true;
    printf("first frame on %s\n", screen->what[0] ? screen->what : display->ops->name);
    fflush(stdout);
}

void gn_show_stats_step(struct gn_show_stats *s, const struct gn_display *display, int64_t now_ns) {
    const struct gn_screen *screen = &display->screen;
    const struct gn_screen_counts *c = &screen->counts;
    uint64_t ticks;
    if (s->timer < 0 || read(s->timer, &ticks, sizeof ticks) != sizeof ticks) return;
    if (c->shown < s->last.shown) s->last = (struct gn_screen_counts){0}; /* opened again */
    const double seconds = (double)(now_ns - s->last_ns) * 1e-9;
    const uint64_t shown = c->shown - s->last.shown, again = c->again - s->last.again;
    printf("%.1f fps, %llu drawn, %llu again, %llu missed, %.1f ms to draw, %s\n",
           (double)shown / seconds, (unsigned long long)s->all_drawn, (unsigned long long)again,
           (unsigned long long)(c->missed - s->last.missed),
           s->drawn ? (double)s->draw_ns * 1e-6 / (double)s->drawn : 0.0,
           screen->status[0] ? screen->status
           : screen->what[0] ? screen->what
                             : display->ops->name);
    fflush(stdout);
    s->last = *c;
    s->last_ns = now_ns;
    s->draw_ns = 0;
    s->drawn = 0;
}
