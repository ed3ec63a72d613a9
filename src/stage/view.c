#include "stage/view.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "stage/rays.h"
#include "stage/sun.h"

void gn_view_stop(struct gn_view *view) {
    gn_frame_destroy(view->builder);
    view->builder = NULL;
}

void gn_view_close(struct gn_view *view, struct gn_gl *gl) {
    if (gl && view->builder) gn_gl_drop_view(gl, view->opts.number);
    gn_view_stop(view);
}

void gn_view_enter(struct gn_view *view, const struct gn_frame_opts *look) {
    const struct gn_frame_opts before = view->opts;
    view->opts = *look;
    view->opts.output = before.output;
    if (look->view.camera == before.view.camera) view->opts.view.orbit = before.view.orbit;
    view->generation++;
}

void gn_view_share(struct gn_view *view, enum gn_view_number number, const struct gn_view *with,
                   const struct gn_frame_opts *look) {
    view->pose = with->pose;
    view->rested_ns = with->rested_ns;
    view->opts = *look;
    view->opts.number = number;
    view->opts.view = with->opts.view;
    view->opts.output = with->opts.output;
    view->opts.cover = with->opts.cover;
}

/* All but the look, whose changes gn_view_enter() counts. */
static void count_changes(struct gn_view *view) {
    struct gn_view_basis now;
    memset(&now, 0, sizeof now); /* with the padding, which is compared */
    memcpy(&now.view, &view->opts.view, sizeof now.view);
    memcpy(&now.output, &view->opts.output, sizeof now.output);
    now.output.scaled_later = false; /* the same picture */
    memcpy(&now.at, &view->pose->at, sizeof now.at);
    if (view->pose->aimed) glm_vec3_copy(view->pose->aim_ws, now.aim_ws);
    if (gn_pose_stands(view->pose)) now.at.time_ns = INT64_MIN; /* all times are the same moment */
    if (memcmp(&now, &view->posed, sizeof now) == 0) return;
    memcpy(&view->posed, &now, sizeof now);
    view->generation++;
}

void gn_view_pose(struct gn_view *view, const struct gn_settings *settings, int64_t time_ns) {
    gn_pose_step(view->pose, time_ns);
    const double turned_deg =
        fmod(settings->scene.turntable_deg_s * ((double)(time_ns - view->rested_ns) * 1e-9), 360.0);
    view->opts.view.turntable_rad = glm_rad((float)turned_deg);
    gn_stage_aim_lights(view->pose, &view->opts, settings);
    count_changes(view);
}

const struct gn_plan *gn_view_build(struct gn_view *view, const struct gn_gl *gl,
                                    const struct gn_frame_opts *opts,
                                    struct gn_warnings *warnings) {
    if (!view->builder) view->builder = gn_frame_create(view->pose->scene, gn_gl_caps(gl));
    return gn_frame_build(view->builder, view->pose, opts, warnings);
}

const struct gn_plan *gn_view_plan(struct gn_view *view, struct gn_gl *gl,
                                   struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_plan *plan = gn_view_build(view, gl, &view->opts, warnings);
    while (!gn_gl_prove(gl, plan)) {
        gn_view_stop(view); /* the next builder knows what is left */
        plan = gn_view_build(view, gl, &view->opts, warnings);
    }
    if (gn_gl_prepare(gl, plan, err)) return plan;
    const char *source = gn_gl_failed_source(gl);
    if (source) fputs(source, stderr);
    return NULL;
}

const struct gn_plan *gn_view_draw(struct gn_view *view, struct gn_stage *stage, int64_t time_ns,
                                   struct gn_warnings *warnings, struct gn_err *err) {
    gn_view_pose(view, stage->settings, time_ns);
    gn_stage_occlude(stage, view);
    gn_stage_refine(stage, view);
    const struct gn_plan *plan = gn_view_plan(view, stage->gl, warnings, err);
    const bool ok =
        plan && gn_stage_cast(stage, view, plan, err) && gn_gl_run(stage->gl, plan, NULL, err);
    return ok ? plan : NULL;
}
