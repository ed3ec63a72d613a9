#include "kiosk/still.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/clock.h"
#include "core/memory.h"
#include "kiosk/private.h"
#include "stage/gather.h"
#include "stage/occlusion.h"
#include "stage/sun.h"

static const int64_t REST_NS = GN_NS_PER_S * 3 / 10; /* a view that is so old has come to rest */
enum { FADE_IN_FRAMES = 30, FADE_OUT_FRAMES = 8 };

void gn_still_drop(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    gn_view_close(&t->view, s->stage.gl);
    gn_sun_gather_finish(&t->sun);
    free(t->aside);
    *t = (struct gn_show_still){.changed_ns = gn_loop_now_ns(s->show->loop)};
}

static bool shows_hours(const struct gn_show_screen *s) {
    return s->stage.settings->sun.hours && !isnan(s->stage.shown.opts.view.sun_utc_s) &&
           gn_stage_sun_moves(s->stage.settings);
}

static bool is_complete(const struct gn_show_screen *s) {
    const struct gn_show_still *t = &s->still;
    return shows_hours(s) ? t->painted && t->sun.painted == t->sun.hours.count
                          : t->points == GN_STILL_POINTS;
}

/* The mean may be seen. */
static bool has_mean(const struct gn_show_screen *s) {
    return s->still.painted || s->still.points == GN_STILL_POINTS;
}

bool gn_still_wants_frame(const struct gn_show_screen *s) {
    const struct gn_show_still *t = &s->still;
    return has_mean(s) ? t->share < 1.0f : t->share > 0.0f;
}

static bool may_gather(const struct gn_show_screen *s) {
    const struct gn_show_still *t = &s->still;
    const struct gn_frame_opts *opts = &s->stage.shown.opts;
    const struct gn_screen *screen = &s->stage.display.screen;
    const bool wanted = shows_hours(s) || s->stage.settings->render.gather != GN_GATHER_NONE;
    if (!wanted || !s->stage.gl || t->never || is_complete(s)) return false;
    if ((t->share > 0.0f && !t->painted) || !s->stage.shown.builder) return false;
    if (!screen->may_draw || !screen->lit || screen->black || s->drawn.dark) return false;
    if (s->truth.on || s->split.on || s->staged.loaded || gn_kiosk_waits(&s->kiosk)) return false;
    return opts->debug.aov == GN_AOV_COLOR && !opts->debug.show_maps && !opts->debug.show_lights &&
           !gn_loader_is_busy(s->show->scenes.loader) && !gn_occluder_works(s->stage.occluder);
}

int64_t gn_still_due_ns(const struct gn_show_screen *s) {
    return may_gather(s) ? s->still.changed_ns + REST_NS : INT64_MAX;
}

/* ---- the view that gathers ---- */

static struct gn_gather_point point_of(const struct gn_show_still *t) {
    return (struct gn_gather_point){t->points % GN_STILL_POINTS, GN_STILL_POINTS, true};
}

static bool share_shown(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    return gn_gather_share(&t->view, &t->aside, &s->stage.shown, point_of(t));
}

/* A program of a plan, of all that it can need. True: it was the last. */
static bool warm(struct gn_show_screen *s, struct gn_view *view, const struct gn_frame_opts *opts) {
    struct gn_err unused = {0}; /* the technique's picture stays */
    struct gn_frame_opts all = *opts;
    all.all_seen = true;
    const struct gn_plan *plan = gn_view_build(view, s->stage.gl, &all, NULL);
    s->still.never |= opts->gather.part > 0.0f && !plan->gathers;
    if (s->still.never) return false;
    switch (gn_gl_warm(s->stage.gl, plan, true, &unused)) {
    case GN_GL_WARM_DONE: return true;
    case GN_GL_WARM_FAILED: s->still.never = true; return false;
    case GN_GL_WARM_REBUILD: gn_view_stop(view); return false;
    default: return false;
    }
}

/* The picture, its depth and two means take at most a sixteenth of the machine's memory; hours of
 * sun, which are asked for, an eighth. */
static bool can_gather(const struct gn_show_screen *s) {
    enum { BYTES = 3 * 8 + 4 };
    const struct gn_frame_output_opts *output = &s->stage.shown.opts.output;
    const uint64_t pixels = (uint64_t)output->width_px * output->height_px,
                   memory = gn_memory_total_mb() << 20;
    const bool room =
        shows_hours(s) ? GN_SUN_GATHER_BYTES * pixels <= memory / 8 : BYTES * pixels <= memory / 16;
    return room && gn_gl_caps(s->stage.gl)->has & 1u << GN_CAP_RGBA16F;
}

/* Its programs: of surfaces, of what they see, and of the picture that this lies over. */
static bool warm_hours(struct gn_show_screen *s, const struct gn_frame_opts *over) {
    static const enum gn_sun_look looks[] = {GN_SUN_NORMAL, GN_SUN_VISIBILITY};
    struct gn_show_still *t = &s->still;
    for (int i = 0; i < 2; i++) {
        gn_sun_gather_share(&t->sun, &t->view, &s->stage.shown, looks[i]);
        if (!warm(s, &t->view, &t->view.opts)) return false;
    }
    return warm(s, &s->stage.shown, over);
}

static void fail_hours(struct gn_show_screen *s, const struct gn_err *err) {
    s->still.never = true;
    fprintf(stderr, "gnomon: warning: %s\n", err->text);
    gn_show_note(s, "Hours of sun cannot be shown here");
}

static void prepare_hours(struct gn_show_screen *s, const struct gn_frame_opts *over) {
    struct gn_show_still *t = &s->still;
    struct gn_err err = {0};
    bool ok = can_gather(s) || gn_fail(&err, "hours of sun: this GPU has no half floats, or the "
                                             "machine too little memory for so many pixels");
    if (ok && !t->sun.hours.count)
        ok = gn_sun_hours_build_day(&t->sun.hours, s->stage.settings, s->stage.scene,
                                    over->view.sun_utc_s, &err);
    if (ok && !warm_hours(s, over)) return;
    t->prepared = ok && gn_sun_gather_begin(&t->sun, &t->view, &s->stage.shown, s->stage.settings,
                                            s->stage.gl, &err);
    if (!t->prepared) fail_hours(s, &err);
}

/* The lights are at their places here: the exposure is chosen by the first plan. */
static void prepare(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    struct gn_frame_opts over = s->stage.shown.opts;
    over.cover.mean = 1.0f;
    over.cover.mean_of = GN_VIEW_STILL;
    if (shows_hours(s))
        prepare_hours(s, &over);
    else if (!can_gather(s) || !share_shown(s))
        t->never = true;
    else
        t->prepared = warm(s, &t->view, &t->view.opts) && warm(s, &s->stage.shown, &over);
    if (t->prepared || t->never) gn_gl_warm_end(s->stage.gl);
}

static bool add_position(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    struct gn_err err = {0};
    bool ok = gn_sun_gather_add(&t->sun, &t->view, &s->stage.shown, s->stage.gl, &err);
    if (ok && gn_sun_gather_may_paint(&t->sun)) {
        ok = gn_sun_gather_paint(&t->sun, &t->view, s->stage.settings, s->stage.gl,
                                 s->show->warnings, &err);
        t->painted = s->changed = ok;
    }
    if (!ok) fail_hours(s, &err);
    return ok;
}

static bool add_point(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    if (shows_hours(s)) return add_position(s);
    return gn_gather_add(&t->view, &t->aside, &s->stage.shown, point_of(t), s->stage.gl);
}

void gn_still_step(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    const int64_t begun_ns = gn_loop_now_ns(s->show->loop),
                  until_ns = begun_ns + s->stage.display.screen.period_ns / 2;
    if (begun_ns < gn_still_due_ns(s)) return;
    gn_gl_set_window(s->stage.gl, NULL);
    if (!t->prepared) {
        prepare(s);
        return;
    }
    do {
        t->never = !add_point(s);
        t->points += !t->never && !shows_hours(s);
        gn_gl_finish_frame(s->stage.gl); /* nothing queues up that a button would wait for */
    } while (!t->never && !is_complete(s) && !s->changed &&
             gn_loop_now_ns(s->show->loop) < until_ns);
}

/* ---- frames ---- */

/* The mean is of another picture now. */
static void begin_anew(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    t->generation = s->stage.shown.generation;
    t->changed_ns = gn_loop_now_ns(s->show->loop);
    t->points = 0;
    t->prepared = t->never = t->painted = false;
    gn_sun_gather_finish(&t->sun);
}

void gn_still_lay_over(struct gn_show_screen *s, int64_t time_ns, bool cut) {
    struct gn_show_still *t = &s->still;
    struct gn_view *view = &s->stage.shown;
    view->opts.cover.mean = 0.0f;
    if (t->share <= 0.0f && !has_mean(s)) return;
    gn_view_pose(view, s->stage.settings, time_ns);
    const bool ends = cut || s->split.on || s->truth.on;
    if (t->generation != view->generation || ends) begin_anew(s);
    t->share += has_mean(s) ? 1.0f / FADE_IN_FRAMES : -1.0f / FADE_OUT_FRAMES;
    t->share = ends ? 0.0f : glm_clamp(t->share, 0.0f, 1.0f);
    view->opts.cover.mean = t->share;
    view->opts.cover.mean_of = GN_VIEW_STILL;
}

void gn_still_follow(struct gn_show_screen *s) {
    struct gn_show_still *t = &s->still;
    if (t->generation != s->stage.shown.generation) begin_anew(s);
    if (t->points == 0 && !t->sun.drawn && t->share <= 0.0f && t->view.builder)
        gn_view_close(&t->view, s->stage.gl);
}
