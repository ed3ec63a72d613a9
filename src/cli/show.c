/* gnomon show: the kiosk. One epoll over signals, the screen and a clock for --stats; nothing is
 * drawn while nothing changes. It waits for a card and a monitor for as long as it takes. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>

#include "cli/args.h"
#include "cli/commands.h"
#include "cli/service.h"
#include "cli/show_hand.h"
#include "cli/show_stats.h"
#include "cli/stage.h"
#include "cli/stop.h"
#include "cli/wake.h"
#include "core/arena.h"
#include "core/clock.h"

struct show {
    struct gn_options *options; /* ours: a reload makes others */
    struct gn_cli_place *place; /* NULL: the options say where */
    struct gn_stage stage;
    struct gn_screen_opts screen_opts;
    struct gn_show_stats stats;
    struct gn_service service;
    struct gn_warnings *warnings;
    int epoll, signals;  /* descriptors, -1 when not open */
    uint32_t generation; /* of the context that stage.gl lives in */
    int64_t begun_ns;    /* when the first frame is seen; 0: none yet */
    uint64_t frames, most_frames;
    unsigned long allocations; /* as of the first frame */
    uint64_t objects;
    bool moves, changed; /* changed: there is another picture to be seen */
    bool ends, reloads;
    bool says; /* a text, in place of pictures */
};

/* ---- opening ---- */

static bool watch(struct show *s, int fd, struct gn_err *err) {
    struct epoll_event event = {.events = EPOLLIN, .data.fd = fd};
    return epoll_ctl(s->epoll, EPOLL_CTL_ADD, fd, &event) == 0 ||
           gn_fail(err, "show: cannot wait: %s", strerror(errno));
}

/* Before anything else, and for good: a signal that comes while the scene loads, or a second one at
 * the end, ends the kiosk as well as any other. */
static bool open_loop(struct show *s, struct gn_err *err) {
    s->signals = gn_stop_open();
    s->epoll = epoll_create1(EPOLL_CLOEXEC);
    if (s->signals < 0 || s->epoll < 0)
        return gn_fail(err, "show: cannot wait for signals: %s", strerror(errno));
    return watch(s, s->signals, err);
}

static bool encodes(const struct gn_options *o) {
    uint32_t without = 0;
    return !gn_caps_parse(o->without, &without, NULL) || !(without & 1u << GN_CAP_SRGB);
}

static struct gn_screen_opts screen_opts_of(const struct gn_options *o) {
    return (struct gn_screen_opts){
        .width_px = (uint32_t)o->size.width_px,
        .height_px = (uint32_t)o->size.height_px,
        .connector = o->connector,
        .card = o->card,
        .render_node = o->render_node,
        .modeline = o->modeline,
        .mode_width = (uint32_t)o->display_mode.width_px,
        .mode_height = (uint32_t)o->display_mode.height_px,
        .mode_hz = o->display_mode.hz,
        .cap_width = (uint32_t)o->max_mode.width_px,
        .cap_height = (uint32_t)o->max_mode.height_px,
        .cap_hz = o->max_mode.hz,
        .rotate_deg = (unsigned)o->rotate_deg,
        .max_fps = (unsigned)o->max_fps,
        .unencoded = !encodes(o),
        .legacy = o->legacy,
    };
}

static bool open_display(struct show *s, struct gn_err *err) {
    const struct gn_options *o = s->options;
    struct gn_wake wake = {0};
    s->screen_opts = screen_opts_of(o);
    gn_wake_begin(&wake, o);
    const bool ok = gn_display_open_screen(&s->stage.display, o->backend, &s->screen_opts,
                                           gn_clock_monotonic_ns(), s->warnings, err);
    gn_wake_end(&wake);
    if (ok && s->place) s->place->opened = true;
    return ok && watch(s, s->stage.display.screen.fd, err);
}

/* ---- the context ---- */

/* What tilers draw on chip costs them next to nothing. */
static uint32_t samples_of(const struct show *s) {
    const struct gn_options *o = s->options;
    if (gn_options_given(o, msaa)) return (uint32_t)o->msaa;
    return gn_gl_caps(s->stage.gl)->tiler ? 4 : 0;
}

/* What a frame is drawn with, and how large, follows the screen. */
static void fit_to_screen(struct show *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    const bool direct = s->stage.display.ops->screen && !screen->copy_to;
    struct gn_frame_opts *f = &s->stage.frame_opts;
    const struct gn_gl_window window = {screen->width_px, screen->height_px, screen->srgb};
    f->width_px = screen->width_px;
    f->height_px = screen->height_px;
    f->turn_deg = screen->rotate_deg;
    f->unencoded = direct && !screen->srgb;
    f->msaa = samples_of(s);
    gn_gl_set_window(s->stage.gl, direct ? &window : NULL);
}

/* A kiosk that cannot draw shows why, and stays: somebody will come and read it. */
static bool say(struct show *s, struct gn_err *err) {
    if (gn_stop_asked()) return false;
    gn_stage_stop_gl(&s->stage);
    if (!gn_display_say(&s->stage.display, err->text, gn_clock_monotonic_ns())) return false;
    s->says = true;
    fprintf(stderr, "gnomon: warning: %s\n", err->text);
    *err = (struct gn_err){0};
    return true;
}

/* Programs are made before there is a monitor; what size it will have matters not to them. */
static bool start_gl(struct show *s, struct gn_err *err) {
    const struct gn_screen *screen = &s->stage.display.screen;
    s->generation = screen->generation;
    s->changed = true;
    if (!gn_stage_start_gl(&s->stage, s->warnings, err)) return say(s, err);
    if (s->says) gn_display_say(&s->stage.display, NULL, gn_clock_monotonic_ns());
    s->says = false;
    if (screen->may_draw) return true;
    s->stage.frame_opts.width_px = 64;
    s->stage.frame_opts.height_px = 36;
    gn_gl_set_window(s->stage.gl, NULL);
    if (!gn_stage_draw(&s->stage, s->options->time_ns, s->warnings, err)) return say(s, err);
    gn_gl_finish_frame(s->stage.gl); /* many drivers compile as late as they can */
    return true;
}

static bool renew(struct show *s, struct gn_err *err) {
    struct gn_wake wake = {0};
    gn_stage_stop_gl(&s->stage);
    s->generation = 0;
    gn_wake_begin(&wake, s->options);
    const bool ok = gn_display_renew(&s->stage.display, gn_clock_monotonic_ns(), err);
    gn_wake_end(&wake);
    return ok;
}

static bool is_stale(const struct show *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    return screen->lost || (screen->has_context && screen->generation != s->generation);
}

static bool keep_context(struct show *s, struct gn_err *err) {
    const struct gn_screen *screen = &s->stage.display.screen;
    if (screen->lost && !renew(s, err)) return false;
    if (screen->lost || !screen->has_context || screen->generation == s->generation) return true;
    gn_stage_stop_gl(&s->stage);
    return start_gl(s, err);
}

/* ---- frames ---- */

static bool wants_frame(const struct show *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    return screen->may_draw && s->stage.gl &&
           (s->moves || s->changed || screen->damaged || !screen->lit);
}

static bool draw(struct show *s, struct gn_err *err) {
    const struct gn_screen *screen = &s->stage.display.screen;
    const int64_t seen_ns = screen->seen_ns, start_ns = s->options->time_ns;
    if (screen->black) {
        gn_gl_black(s->stage.gl);
        return true;
    }
    if (s->begun_ns == 0) s->begun_ns = seen_ns;
    fit_to_screen(s);
    if (!gn_stage_draw(&s->stage, s->moves ? start_ns + seen_ns - s->begun_ns : start_ns,
                       s->warnings, err))
        return false;
    if (!s->stage.display.ops->screen) gn_gl_finish_frame(s->stage.gl);
    return !screen->copy_to ||
           gn_gl_read_xrgb8888(s->stage.gl, screen->copy_to, screen->copy_stride, err);
}

static bool frame(struct show *s, struct gn_err *err) {
    struct gn_display *display = &s->stage.display;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    if (!gn_display_begin(display, begun_ns, err)) return !err->text[0];
    const bool drawn = draw(s, err);
    if (gn_gl_is_lost(s->stage.gl) && gn_display_lose(display, gn_clock_monotonic_ns())) {
        *err = (struct gn_err){0};
        return true;
    }
    if (!drawn) return false;
    const int64_t drawn_ns = gn_clock_monotonic_ns();
    s->changed = false;
    if (!gn_display_present(display, drawn_ns, err)) return false;
    gn_show_stats_frame(&s->stats, display, drawn_ns - begun_ns);
    if (s->frames++ > 0) return true;
    s->allocations = gn_alloc_count();
    s->objects = gn_gl_stats(s->stage.gl).objects_created;
    return true;
}

/* ---- reloading ---- */

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* Does the display have to be opened again? */
static bool same_screen(const struct gn_options *a, const struct gn_options *b) {
    return same_text(a->backend, b->backend) && same_text(a->connector, b->connector) &&
           same_text(a->card, b->card) && same_text(a->render_node, b->render_node) &&
           same_text(a->modeline, b->modeline) &&
           memcmp(&a->display_mode, &b->display_mode, sizeof a->display_mode) == 0 &&
           memcmp(&a->max_mode, &b->max_mode, sizeof a->max_mode) == 0 &&
           memcmp(&a->size, &b->size, sizeof a->size) == 0 && a->rotate_deg == b->rotate_deg &&
           a->max_fps == b->max_fps && a->legacy == b->legacy && encodes(a) == encodes(b);
}

static void drop_options(struct gn_options *options) {
    if (options) gn_options_finish(options);
    free(options);
}

static struct gn_options *read_options(const struct show *s, const struct gn_options *like,
                                       struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_options *o = gn_xalloc(1, sizeof *o);
    if (gn_args_parse(o, like->argc, like->argv, warnings, err)) {
        o->command = GN_COMMAND_SHOW; /* the bare command, too, is the kiosk by now */
        if (s->place) o->backend = s->place->backend;
        return o;
    }
    drop_options(o);
    return NULL;
}

/* The new scene in the old one's place. */
static bool take_stage(struct show *s, struct gn_stage *fresh, struct gn_options *options,
                       struct gn_err *err) {
    const bool keeps_display = same_screen(s->options, options);
    gn_stage_stop_gl(&s->stage);
    if (keeps_display) {
        fresh->display = s->stage.display;
        s->stage.display = (struct gn_display){0};
    }
    gn_stage_close(&s->stage);
    drop_options(s->options);
    s->stage = *fresh;
    s->options = options;
    s->generation = 0;
    s->begun_ns = 0;
    s->moves =
        s->most_frames < UINT64_MAX || s->stage.pose.animated || options->turntable_deg_s != 0.0;
    return keeps_display || open_display(s, err);
}

/* What cannot be loaded leaves the picture as it is. */
static bool reload(struct show *s, struct gn_err *err) {
    struct gn_err why = {0};
    struct gn_stage fresh = {0};
    s->reloads = false;
    struct gn_options *options = read_options(s, s->options, s->warnings, &why);
    if (options && gn_stage_load(&fresh, options, s->warnings, &why))
        return take_stage(s, &fresh, options, err);
    fprintf(stderr, "gnomon: warning: %s (not reloaded)\n", why.text);
    gn_stage_close(&fresh);
    drop_options(options);
    return true;
}

/* ---- the loop ---- */

static void hear(struct show *s) {
    for (int signal; (signal = gn_stop_read(s->signals)) != 0;) {
        s->reloads |= signal == SIGHUP;
        s->ends |= signal != SIGHUP;
    }
}

static void take_hand(struct show *s) {
    struct gn_screen *screen = &s->stage.display.screen;
    const struct gn_hand hand = screen->hand;
    screen->hand = (struct gn_hand){0};
    s->ends |= hand.quit;
    s->changed |= gn_show_hand_turn(&s->stage, &hand);
}

static bool step(struct show *s, struct gn_err *err) {
    struct epoll_event ready[4];
    const bool busy = wants_frame(s) || is_stale(s);
    while (epoll_wait(s->epoll, ready, 4, busy ? 0 : -1) < 0 && errno == EINTR) {
    }
    hear(s);
    if (s->ends) return true;
    if (s->reloads && !reload(s, err)) return false;
    if (!gn_display_dispatch(&s->stage.display, gn_clock_monotonic_ns(), err)) return false;
    take_hand(s);
    if (s->ends) return true;
    gn_show_stats_step(&s->stats, &s->stage.display, gn_clock_monotonic_ns());
    s->changed |= gn_service_step(&s->service, &s->stage.display.screen, gn_clock_monotonic_ns());
    return keep_context(s, err) && (!wants_frame(s) || frame(s, err));
}

static bool run(struct show *s, struct gn_err *err) {
    const struct gn_options *o = s->options;
    s->most_frames = o->frames > 0 ? (uint64_t)o->frames : UINT64_MAX;
    s->moves = o->frames > 0 || s->stage.pose.animated || o->turntable_deg_s != 0.0;
    while (!s->ends && s->frames < s->most_frames)
        if (!step(s, err)) return false;
    if (s->options->verbose && s->stage.gl)
        printf("%llu frames, %llu late, %lu allocations and %llu GL objects after the first\n",
               (unsigned long long)s->frames,
               (unsigned long long)s->stage.display.screen.counts.missed,
               gn_alloc_count() - s->allocations,
               (unsigned long long)(gn_gl_stats(s->stage.gl).objects_created - s->objects));
    return true;
}

static void close_all(struct show *s) {
    gn_stage_close(&s->stage);
    gn_show_stats_close(&s->stats);
    gn_service_close(&s->service);
    if (s->signals >= 0) close(s->signals);
    if (s->epoll >= 0) close(s->epoll);
    drop_options(s->options);
}

bool gn_cli_show_at(const struct gn_options *options, struct gn_cli_place *place,
                    struct gn_warnings *warnings, struct gn_err *err) {
    struct show s = {.place = place,
                     .epoll = -1,
                     .signals = -1,
                     .stats.timer = -1,
                     .service = {.socket = -1, .timer = -1},
                     .warnings = warnings};
    bool ok = open_loop(&s, err) && gn_service_open(&s.service, gn_clock_monotonic_ns(), err) &&
              (s.service.timer < 0 || watch(&s, s.service.timer, err));
    s.options = ok ? read_options(&s, options, NULL, err) : NULL;
    ok = s.options && gn_stage_load(&s.stage, s.options, warnings, err) && open_display(&s, err) &&
         gn_show_stats_open(&s.stats, s.options, err) &&
         (s.stats.timer < 0 || watch(&s, s.stats.timer, err)) && run(&s, err);
    close_all(&s);
    return ok || (err->status != GN_EXIT_DISPLAY &&
                  (s.ends || gn_stop_asked())); /* what that broke off is no failure */
}

bool gn_cli_show(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    return gn_cli_show_at(options, NULL, warnings, err);
}
