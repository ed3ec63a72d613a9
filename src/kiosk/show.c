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
    s->wants_reload |= number == SIGHUP;
    s->ends |= number != SIGHUP;
}

/* ---- a step ---- */

bool gn_show_step(struct gn_show *s, struct gn_err *err) {
    const int64_t screen_ns = gn_show_screen_due_ns(&s->screen),
                  parts_ns = screen_ns > 0 ? gn_parts_due_ns(&s->parts) : 0;
    gn_loop_step(s->loop, parts_ns < screen_ns ? parts_ns : screen_ns);
    gn_parts_look(&s->parts);
    if (s->ends) return true;
    gn_show_reload(s);
    if (!gn_show_step_reload(s, err) || !gn_show_take_events(&s->screen, err)) return false;
    if (s->ends) return true;
    if (!gn_show_step_machine(&s->screen, err)) return false;
    gn_parts_step(&s->parts);
    return gn_show_step_picture(&s->screen, err);
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
    if (s->screen.stage.settings->run.verbose && s->screen.stage.gl)
        printf("%llu frames, %llu late, %lu allocations and %llu GL objects after the first\n",
               (unsigned long long)s->counts.frames,
               (unsigned long long)s->screen.stage.display.screen.counts.missed,
               s->counts.allocations, (unsigned long long)s->counts.objects);
    return true;
}

void gn_show_close(struct gn_show *s) {
    gn_parts_end(&s->parts);
    gn_viewer_close(&s->screen);
    gn_input_close(s->buttons.input);
    gn_captions_destroy(s->screen.text.captions);
    if (s->scenes.loader) gn_show_drop_reload(s);
    gn_show_close_loader(s);
    gn_show_drop_staged(&s->screen);
    gn_split_end(&s->screen);
    gn_still_drop(&s->screen);
    gn_stage_close(&s->screen.stage);
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
    gn_show_open_captions(&s->screen);
    if (!gn_show_begin(s, s->reload.first ? 0 : s->first.scene, err)) return false;
    if (!gn_show_open_display(&s->screen, err)) return false;
    if (!gn_show_open_input(s, err)) { /* a script is of the command line */
        if (s->screen.stage.settings->run.input_script) return false;
        gn_show_report_error(s, GN_PROBLEM_INPUT, err->text);
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
    s->screen.show = s;
    s->parts.host = (struct gn_part_host){
        .display = &s->screen.stage.display,
        .gl = &s->screen.stage.gl,
        .options = &s->config.options,
        .settings = &s->screen.stage.settings,
        .rules = &s->screen.rules,
        .kiosk = &s->screen.kiosk,
        .counts = &s->counts,
        .problems = &s->problems,
        .still = &s->screen.truth.on,
        .stage = &s->screen.stage,
        .changed = &s->screen.changed,
        .show = s,
        .renew = gn_show_renew,
        .report_error = gn_show_report_error,
        .cure_error = gn_show_cure_error,
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
