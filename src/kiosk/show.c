/* gnomon show: the kiosk. One event loop for signals, the screen, buttons, the control socket,
 * scenes that load and timers. It waits for a card and a monitor for as long as it takes. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/stop.h"
#include "kiosk/private.h"
#include "kiosk/show.h"

/* ---- opening ---- */

static void take_signal(void *user, int number) {
    struct gn_show *s = user;
    s->reloads |= number == SIGHUP;
    s->ends |= number != SIGHUP;
}

/* ---- a step ---- */

/* When the next step is due by itself; 0: at once. */
static int64_t due_ns(const struct gn_show *s) {
    if (gn_show_wants_frame(s) || gn_show_is_stale(s) || gn_show_can_advance(s)) return 0;
    const int64_t now_ns = gn_loop_now_ns(s->loop);
    int64_t at_ns = gn_kiosk_deadline(&s->rules, &s->kiosk);
    if (gn_show_has_work(s) && s->ahead.due_ns < at_ns) at_ns = s->ahead.due_ns;
    const int64_t bar_ns = gn_show_bar_due_ns(s);
    if (bar_ns < at_ns) at_ns = bar_ns;
    const int64_t turns_ns = gn_viewer_due_ns(s);
    if (turns_ns < at_ns) at_ns = turns_ns;
    const int64_t truth_ns = gn_truth_due_ns(s);
    if (truth_ns < at_ns) at_ns = truth_ns;
    const int64_t turntable_ns = gn_show_turntable_due_ns(s);
    if (turntable_ns < at_ns) at_ns = turntable_ns;
    const int64_t parts_ns = gn_parts_due_ns(&s->parts);
    if (parts_ns < at_ns) at_ns = parts_ns;
    const int64_t text_ns = gn_show_captions_due_ns(s); /* an overdue text waits for the screen */
    if (s->stage.display.screen.lit && text_ns > now_ns && text_ns < at_ns) at_ns = text_ns;
    return at_ns;
}

bool gn_show_step(struct gn_show *s, struct gn_err *err) {
    struct gn_screen *screen = &s->stage.display.screen;
    gn_loop_step(s->loop, due_ns(s));

    /* input: requests, a reload, events of the display, buttons and keys */
    gn_parts_look(&s->parts);
    if (s->ends) return true;
    if (s->reloads) gn_show_reload(s);
    if (!gn_show_step_reload(s, err)) return false;
    if (!gn_display_dispatch(&s->stage.display, gn_loop_now_ns(s->loop), err)) return false;
    struct gn_pointer pointer = screen->pointer;
    screen->pointer = (struct gn_pointer){0};
    s->ends |= pointer.quit;
    if (pointer.file) gn_show_load_file(s, pointer.file);
    if (s->stage.display.ops->is_window) {
        gn_split_take_pointer(s, &pointer);
        gn_viewer_take_keys(s, &pointer);
        gn_viewer_set_title(s);
    }
    gn_show_take_moves(s, &pointer);
    gn_show_take_input(s, &pointer);
    gn_show_wake_by_hand(s);
    if (s->ends) return true;

    /* the machine: timeouts, and the wanted mode and scene */
    const struct gn_kiosk_event tick = {.kind = GN_KIOSK_TICK, .time_ns = gn_loop_now_ns(s->loop)};
    const uint32_t idled = s->kiosk.idled;
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &tick);
    if (s->kiosk.idled != idled) gn_show_turn_home(s);
    gn_show_suppress_taps(s);
    const bool off = s->kiosk.blanked || (gn_kiosk_is_dark(&s->kiosk) && !s->rules.sleeps_black);
    if (off != screen->blank) gn_display_blank(&s->stage.display, off, tick.time_ns);
    if (!gn_show_keep_context(s, err)) return false;
    gn_parts_step(&s->parts);
    gn_show_advance(s);
    gn_show_enter_set(s);
    gn_truth_step(s);

    /* a frame if one is due, which does a piece of work ahead itself, else such a piece; with a
     * slow scene they take turns, so that input is heard between them */
    struct gn_show_ahead *ahead = &s->ahead;
    ahead->has_turn = ahead->alone && !ahead->has_turn && gn_show_has_work(s);
    if (gn_show_wants_frame(s) && !ahead->has_turn) {
        if (!gn_show_frame(s, err)) return false;
    } else if (ahead->has_turn ||
               (gn_show_has_work(s) && gn_loop_now_ns(s->loop) >= ahead->due_ns)) {
        gn_gl_set_window(s->stage.gl, NULL); /* not drawn to outside of begin and present */
        gn_show_work(s);
        /* no frame to miss: what is waited for is not spread over frames */
        if ((s->scenes.staged || gn_kiosk_waits(&s->kiosk)) && screen->may_draw)
            s->ahead.due_ns = gn_loop_now_ns(s->loop);
    }
    gn_show_advance(s); /* that piece, or the picture kept for a fade, may be what it waited for */
    gn_show_enter_set(s);
    return true;
}

static bool run(struct gn_show *s, struct gn_err *err) {
    bool ok = true;
    gn_warn_flush(s->warnings, stderr);
    while (ok && !s->ends && s->counts.frames < s->counts.most_frames) {
        ok = gn_show_step(s, err);
        gn_warn_flush(s->warnings, stderr);
    }
    s->failed = !ok;
    if (!ok) return false;
    if (s->stage.settings->run.verbose && s->stage.gl)
        printf("%llu frames, %llu late, %lu allocations and %llu GL objects after the first\n",
               (unsigned long long)s->counts.frames,
               (unsigned long long)s->stage.display.screen.counts.missed, s->counts.allocations,
               (unsigned long long)s->counts.objects);
    return true;
}

void gn_show_close(struct gn_show *s) {
    gn_parts_end(&s->parts);
    gn_viewer_close(s);
    gn_input_close(s->buttons.input);
    gn_captions_destroy(s->text.captions);
    if (s->scenes.loader) gn_show_drop_reload(s);
    gn_show_close_loader(s);
    gn_show_drop_staged(s);
    gn_split_end(s);
    gn_stage_close(&s->stage);
    gn_parts_destroy(&s->parts);
    gn_loop_remove_signals(&s->signals);
    gn_loop_close(s->loop);
    gn_changes_destroy(s->config.changes);
    gn_show_drop_options(s->config.options);
    free(s);
}

/* After a failure the caller closes. */
static bool open_all(struct gn_show *s, const struct gn_options *options, struct gn_err *err) {
    /* signals first, and until the process ends: one while the scene loads, or a second one while
     * the kiosk closes, must be handled like any other */
    sigset_t set;
    gn_stop_signals(&set);
    s->signals = (struct gn_signals){.call = take_signal, .user = s};
    s->loop = gn_loop_open(err);
    if (!s->loop) return false;
    s->counts.begun_ns = gn_loop_now_ns(s->loop);
    if (!gn_loop_add_signals(s->loop, &s->signals, &set))
        return gn_fail(err, "show: cannot wait for signals: %s", strerror(errno));
    if (!gn_show_open_loader(s, err)) return false;
    s->config.options = gn_show_read_options(options, NULL, err);
    if (!s->config.options) return false;
    s->parts.host.loop = s->loop;
    gn_parts_begin(&s->parts);
    if (!gn_show_load_first(s, err)) return false;
    gn_show_open_captions(s);
    if (!gn_show_begin(s, err)) return false;
    if (!s->reload.first) { /* where the list of next-scene was */
        s->kiosk.shown.scene = s->kiosk.wanted.scene = s->first.scene;
        s->scenes.shown = gn_kiosk_scene(&s->rules, &s->kiosk.shown);
    }
    if (!gn_show_open_display(s, err)) return false;
    if (!gn_show_open_input(s, err)) { /* a script is of the command line */
        if (s->stage.settings->run.input_script) return false;
        gn_show_report_error(s, GN_PROBLEM_CONFIG, err->text);
        *err = (struct gn_err){0};
    }
    gn_parts_open(&s->parts);
    return true;
}

static const struct gn_part *const rows[] = {
#define X(name) &gn_part_##name,
    GN_PART_TABLE(X)
#undef X
};

static struct gn_show *create(struct gn_show_place *place, struct gn_warnings *warnings) {
    struct gn_show *s = gn_xalloc(1, sizeof *s);
    *s = (struct gn_show){.config.place = place, .warnings = warnings, .parts.rows = rows};
    s->parts.host = (struct gn_part_host){
        .display = &s->stage.display,
        .gl = &s->stage.gl,
        .options = &s->config.options,
        .settings = &s->stage.settings,
        .rules = &s->rules,
        .kiosk = &s->kiosk,
        .counts = &s->counts,
        .problems = &s->problems,
        .still = &s->truth.on,
        .changed = &s->changed,
        .show = s,
        .renew = gn_show_renew,
        .scene_files = gn_show_scene_files,
    };
    gn_parts_create(&s->parts);
    return s;
}

struct gn_show *gn_show_open(const struct gn_options *options, struct gn_warnings *warnings,
                             struct gn_err *err) {
    struct gn_show *s = create(NULL, warnings);
    if (open_all(s, options, err)) return s;
    gn_show_close(s);
    return NULL;
}

/* Signals that the loop does not get to for so long, because of one frame, end the process. */
#define LATE_NS (GN_NS_PER_S / 10 * 8)

bool gn_show_run(const struct gn_options *options, struct gn_show_place *place,
                 struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_show *s = create(place, warnings);
    gn_stop_end_late(LATE_NS);
    const bool ok = (open_all(s, options, err) && run(s, err)) ||
                    (err->status != GN_EXIT_DISPLAY &&
                     (s->ends || gn_stop_asked())); /* stopped on purpose: not a failure */
    gn_show_close(s);
    return ok;
}
