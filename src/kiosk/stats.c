/* Statistics on stdout: with --stats a line a second, with -v a line with the first frame. */
#include "kiosk/stats.h"

#include <stdio.h>

#include "core/clock.h"
#include "kiosk/part.h"

struct stats {
    const struct gn_part_host *host;
    struct gn_timer timer; /* of the next line; added only where lines are wanted */
    int64_t due_ns;
    bool first_printed, prints_first;
    int64_t last_ns, draw_ns; /* since the last line: time spent drawing */
    uint64_t drawn, all_drawn;
    struct gn_screen_counts last;
};

void gn_frame_times_add(struct gn_frame_times *times, int64_t now_ns) {
    times->ns[times->next++ % GN_FRAME_TIMES] = now_ns;
}

int gn_frame_times_fps(const struct gn_frame_times *times, int64_t now_ns) {
    int frames = 0;
    for (int i = 0; i < GN_FRAME_TIMES; i++)
        frames += times->ns[i] != 0 && now_ns - times->ns[i] < GN_NS_PER_S;
    return frames;
}

static void print_line(void *user, int64_t now_ns) {
    struct stats *s = user;
    const struct gn_display *display = s->host->display;
    const struct gn_screen *screen = &display->screen;
    const struct gn_screen_counts *c = &screen->counts;
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
    do s->due_ns += GN_NS_PER_S;
    while (s->due_ns <= now_ns);
    s->timer.due_ns = s->due_ns;
}

static void open_stats(void *part) {
    struct stats *s = part;
    const struct gn_settings *settings = *s->host->settings;
    s->prints_first = settings->run.stats || settings->run.verbose;
    s->last_ns = gn_loop_now_ns(s->host->loop);
    if (!settings->run.stats) return;
    s->due_ns = s->last_ns + GN_NS_PER_S;
    s->timer = (struct gn_timer){.due_ns = s->due_ns, .call = print_line, .user = s};
    gn_loop_add_timer(s->host->loop, &s->timer);
}

static void close_stats(void *part) { gn_loop_remove_timer(&((struct stats *)part)->timer); }

static void count_frame(void *part, int64_t draw_ns) {
    struct stats *s = part;
    const struct gn_display *display = s->host->display;
    const struct gn_screen *screen = &display->screen;
    s->draw_ns += draw_ns;
    s->drawn++;
    s->all_drawn++;
    if (!s->prints_first || s->first_printed || !screen->lit) return;
    s->first_printed = true;
    printf("first frame on %s\n", screen->what[0] ? screen->what : display->ops->name);
    fflush(stdout);
}

const struct gn_part gn_part_stats = {
    .name = "stats",
    .size = sizeof(struct stats),
    .open = open_stats,
    .drawn = count_frame,
    .close = close_stats,
};
