#include "kiosk/truth.h"

#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "stage/rays.h"

static const int64_t REST_NS = GN_NS_PER_S * 3 / 10, /* a view that is so old has come to rest */
    POLL_NS = GN_NS_PER_S / 20, TELL_NS = GN_NS_PER_S / 4;

static void pause(struct gn_show *s) {
    const struct gn_action action = {.kind = GN_ACTION_PAUSE};
    gn_show_act(s, &action, gn_loop_now_ns(s->loop));
}

static void tell(struct gn_show *s, int percent) {
    s->truth.percent = percent;
    s->truth.told_ns = gn_loop_now_ns(s->loop);
    gn_show_note(s, "truth %d %%", percent);
}

void gn_truth_drop(struct gn_show *s) {
    struct gn_show_truth *t = &s->truth;
    gn_rays_destroy(t->rays);
    gn_frame_destroy(t->frame);
    t->rays = NULL;
    t->frame = NULL;
    t->shown = false;
}

void gn_truth_end(struct gn_show *s) {
    const bool pauses = s->truth.pauses;
    gn_truth_drop(s);
    s->truth = (struct gn_show_truth){0};
    if (pauses && s->kiosk.paused) pause(s);
    s->changed = true;
}

void gn_truth_begin(struct gn_show *s) {
    if (s->stage.display.screen.rotate_deg != 0) {
        gn_show_note(s, "truth: not on a rotated screen");
        return;
    }
    gn_truth_drop(s);
    s->truth = (struct gn_show_truth){.on = true,
                                      .pauses = !s->kiosk.paused,
                                      .of.mode = -1,
                                      .changed_ns = gn_loop_now_ns(s->loop)};
    if (!s->kiosk.paused) pause(s);
    tell(s, 0);
}

void gn_truth_step(struct gn_show *s) {
    const struct gn_show_truth *t = &s->truth;
    if (!t->on) return;
    if (!s->kiosk.paused) {
        gn_truth_end(s);
        gn_show_note(s, "the scene goes on: no truth");
        return;
    }
    if (!t->rays || t->shown) return;
    const int percent = (int)(100.0 * gn_rays_progress(t->rays));
    if (percent != t->percent && gn_loop_now_ns(s->loop) >= t->told_ns + TELL_NS) tell(s, percent);
}

bool gn_truth_wants_frame(const struct gn_show *s) {
    const struct gn_show_truth *t = &s->truth;
    if (!t->on || t->shown) return false;
    return t->rays ? gn_rays_are_done(t->rays) : gn_loop_now_ns(s->loop) >= t->changed_ns + REST_NS;
}

int64_t gn_truth_due_ns(const struct gn_show *s) {
    const struct gn_show_truth *t = &s->truth;
    if (!t->on || t->shown || !s->stage.display.screen.may_draw) return INT64_MAX;
    return t->rays ? gn_loop_now_ns(s->loop) + POLL_NS : t->changed_ns + REST_NS;
}

/* ---- a frame ---- */

/* Drops rays of another moment or view. */
static void follow(struct gn_show *s) {
    struct gn_show_truth *t = &s->truth;
    const struct gn_frame_opts *f = &s->stage.frame_opts;
    struct gn_truth_of now;
    memset(&now, 0, sizeof now); /* with the gaps, for they are compared */
    memcpy(&now.view, &f->view, sizeof now.view);
    now.moment = s->stage.pose.at;
    now.width_px = f->output.width_px;
    now.height_px = f->output.height_px;
    now.mode = s->kiosk.shown.mode;
    if (memcmp(&now, &t->of, sizeof now) == 0) return;
    gn_truth_drop(s);
    memcpy(&t->of, &now, sizeof now);
    t->changed_ns = gn_loop_now_ns(s->loop);
}

static bool has_come(const struct gn_show_truth *t) { return t->rays && gn_rays_are_done(t->rays); }

static bool begin_rays(struct gn_show *s, struct gn_err *err) {
    const struct gn_plan *plan = gn_stage_plan(&s->stage, s->warnings, err);
    s->truth.rays = plan ? gn_rays_begin(&s->stage, plan, err) : NULL;
    return s->truth.rays;
}

/* Begins to cast, or draws what was cast. */
static bool use_rays(struct gn_show *s, int64_t time_ns, struct gn_err *err) {
    struct gn_show_truth *t = &s->truth;
    struct gn_stage *stage = &s->stage;
    struct gn_frame *const frame = stage->frame;
    const struct gn_frame_opts opts = stage->frame_opts;
    bool ok;
    if (!t->frame) t->frame = gn_frame_create(stage->scene, gn_gl_caps(stage->gl));
    stage->frame = t->frame;
    GN_LIGHT_SET(&stage->frame_opts.shadow.any, technique, GN_TECHNIQUE_TRUTH);
    stage->frame_opts.output.msaa = 0;
    if (has_come(t)) {
        stage->truth.given = t->rays;
        ok = gn_stage_draw(stage, time_ns, s->warnings, err);
        stage->truth.given = NULL;
    } else {
        ok = begin_rays(s, err);
    }
    t->frame = stage->frame; /* another one where a capability was disproved */
    stage->frame = frame;
    stage->frame_opts = opts;
    return ok;
}

bool gn_truth_draw(struct gn_show *s, int64_t time_ns, struct gn_err *err) {
    struct gn_show_truth *t = &s->truth;
    struct gn_err why = {0};
    gn_stage_pose(&s->stage, time_ns);
    follow(s);
    if (has_come(t)) {
        t->shown = true;
        return use_rays(s, time_ns, err);
    }
    const bool rests = gn_loop_now_ns(s->loop) >= t->changed_ns + REST_NS;
    if (!t->rays && rests && !use_rays(s, time_ns, &why)) {
        gn_truth_end(s);
        gn_show_note(s, "%s", why.text);
    }
    return gn_stage_draw(&s->stage, time_ns, s->warnings, err);
}
