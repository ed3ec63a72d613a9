#include "kiosk/truth.h"

#include <stdio.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "stage/rays.h"

static const int64_t REST_NS = GN_NS_PER_S * 3 / 10, /* a view that is so old has come to rest */
    POLL_NS = GN_NS_PER_S / 20, TELL_NS = GN_NS_PER_S / 4;

static void pause(struct gn_show_screen *s) {
    const struct gn_action action = {.kind = GN_ACTION_PAUSE};
    gn_show_act(s, &action, gn_loop_now_ns(s->show->loop));
}

static void tell(struct gn_show_screen *s, int percent) {
    s->truth.percent = percent;
    s->truth.told_ns = gn_loop_now_ns(s->show->loop);
    gn_show_note(s, "Ray tracing %d %%", percent);
}

void gn_truth_drop(struct gn_show_screen *s) {
    struct gn_show_truth *t = &s->truth;
    gn_rays_destroy(t->rays);
    gn_view_close(&t->view, s->stage.gl);
    t->rays = NULL;
    t->shown = false;
}

void gn_truth_end(struct gn_show_screen *s) {
    const bool pauses = s->truth.pauses;
    gn_truth_drop(s);
    s->truth = (struct gn_show_truth){0};
    if (pauses && s->kiosk.paused) pause(s);
    s->changed = true;
}

void gn_truth_begin(struct gn_show_screen *s) {
    if (s->stage.display.screen.rotate_deg != 0) {
        gn_show_note(s, "No ray tracing on a rotated screen");
        return;
    }
    gn_truth_drop(s);
    s->truth = (struct gn_show_truth){
        .on = true, .pauses = !s->kiosk.paused, .changed_ns = gn_loop_now_ns(s->show->loop)};
    if (!s->kiosk.paused) pause(s);
    tell(s, 0);
}

void gn_truth_step(struct gn_show_screen *s) {
    const struct gn_show_truth *t = &s->truth;
    if (!t->on) return;
    if (!s->kiosk.paused) {
        gn_truth_end(s);
        gn_show_note(s, "Ray tracing ended: the scene moves");
        return;
    }
    if (!t->rays || t->shown) return;
    const int percent = (int)(100.0 * gn_rays_progress(t->rays));
    if (percent != t->percent && gn_loop_now_ns(s->show->loop) >= t->told_ns + TELL_NS)
        tell(s, percent);
}

bool gn_truth_wants_frame(const struct gn_show_screen *s) {
    const struct gn_show_truth *t = &s->truth;
    if (!t->on || t->shown) return false;
    return t->rays ? gn_rays_are_done(t->rays)
                   : gn_loop_now_ns(s->show->loop) >= t->changed_ns + REST_NS;
}

int64_t gn_truth_due_ns(const struct gn_show_screen *s) {
    const struct gn_show_truth *t = &s->truth;
    if (!t->on || t->shown || !s->stage.display.screen.may_draw) return INT64_MAX;
    return t->rays ? gn_loop_now_ns(s->show->loop) + POLL_NS : t->changed_ns + REST_NS;
}

/* ---- a frame ---- */

/* Drops rays of another look, camera or moment. */
static void follow_shown(struct gn_show_screen *s) {
    struct gn_show_truth *t = &s->truth;
    if (t->generation == s->stage.shown.generation) return;
    gn_truth_drop(s);
    t->generation = s->stage.shown.generation;
    t->changed_ns = gn_loop_now_ns(s->show->loop);
}

static bool has_come(const struct gn_show_truth *t) { return t->rays && gn_rays_are_done(t->rays); }

static struct gn_view *share_shown(struct gn_show_screen *s) {
    struct gn_view *view = &s->truth.view;
    gn_view_share(view, GN_VIEW_TRUTH, &s->stage.shown, &s->stage.shown.opts);
    GN_LIGHT_SET(&view->opts.shadow.any, technique, GN_TECHNIQUE_TRUTH);
    view->opts.output.msaa = 0;
    view->rays = s->truth.rays;
    return view;
}

static bool begin_rays(struct gn_show_screen *s, struct gn_err *err) {
    struct gn_view *view = share_shown(s);
    const struct gn_plan *plan = gn_view_plan(view, s->stage.gl, s->show->warnings, err);
    s->truth.rays = plan ? gn_rays_begin(&s->stage, view, plan, err) : NULL;
    return s->truth.rays;
}

const struct gn_plan *gn_truth_draw(struct gn_show_screen *s, int64_t time_ns, struct gn_err *err) {
    struct gn_show_truth *t = &s->truth;
    struct gn_view *view = &s->stage.shown;
    struct gn_err why = {0};
    gn_view_pose(view, s->stage.settings, time_ns);
    follow_shown(s);
    if (has_come(t)) {
        t->shown = true;
        view = share_shown(s);
    } else if (!t->rays && gn_loop_now_ns(s->show->loop) >= t->changed_ns + REST_NS &&
               !begin_rays(s, &why)) {
        gn_truth_end(s);
        fprintf(stderr, "gnomon: warning: %s\n", why.text);
        gn_show_note(s, "This scene cannot be ray traced");
    }
    return gn_view_draw(view, &s->stage, time_ns, s->show->warnings, err);
}
