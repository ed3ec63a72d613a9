#include "stage/time.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/embedded.h"
#include "cost/drawn.h"
#include "gl/source.h"

enum { FPS = 60, TEXTURE_PX = 4096 };
#define TURN_RAD (6.0f / FPS * GLM_PIf / 180.0f) /* of a turntable, in a frame */

/* ---- what is drawn when ---- */

struct content { /* of a map, or its moments */
    enum gn_pass_kind kind;
    uint32_t slot, tile;
    uint64_t hash;
};
struct contents {
    struct content *at;
    uint32_t count;
};

static struct content content_of(const struct gn_pass *pass) {
    return (struct content){pass->kind, pass->target.slot, pass->content.tile, pass->content.hash};
}

static struct contents note_contents(const struct gn_plan *plan) {
    struct contents all = {gn_xalloc(plan->pass_count + 1, sizeof *all.at), plan->pass_count};
    for (uint32_t i = 0; i < plan->pass_count; i++) all.at[i] = content_of(&plan->passes[i]);
    return all;
}

static bool holds(const struct contents *all, const struct gn_pass *pass) {
    const struct content wanted = content_of(pass);
    for (uint32_t i = 0; i < all->count; i++)
        if (all->at[i].kind == wanted.kind && all->at[i].slot == wanted.slot &&
            all->at[i].tile == wanted.tile && all->at[i].hash == wanted.hash)
            return true;
    return false;
}

/* Builds the plan, and finds which of its passes are drawn again a frame later, and which when the
 * camera has moved a little. */
static const struct gn_plan *build_plan(struct gn_stage_time *time, struct gn_stage *stage,
                                        const struct gn_frame_opts *opts,
                                        struct gn_warnings *warnings) {
    struct gn_view view = stage->shown;
    const int64_t now_ns = stage->settings->scene.time_ns;
    view.opts = *opts;
    gn_stage_refine(stage, &view);
    gn_view_pose(&view, stage->settings, now_ns + GN_NS_PER_S / FPS);
    struct contents next =
        note_contents(gn_frame_build(time->builder, view.pose, &view.opts, NULL));
    gn_view_pose(&view, stage->settings, now_ns);
    view.opts.view.turntable_rad += TURN_RAD;
    struct contents turned =
        note_contents(gn_frame_build(time->builder, view.pose, &view.opts, NULL));
    view.opts.view.turntable_rad -= TURN_RAD;
    const struct gn_plan *plan = gn_frame_build(time->builder, view.pose, &view.opts, warnings);
    time->when = gn_xalloc(plan->pass_count + 1, sizeof *time->when);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        time->when[i] = pass->kind == GN_PASS_PICTURE || !holds(&next, pass) ? GN_COST_EACH_FRAME
                        : !holds(&turned, pass)                              ? GN_COST_CAMERA_MOVES
                                                                             : GN_COST_KEPT;
    }
    free(next.at);
    free(turned.at);
    return plan;
}

/* ---- all of it ---- */

bool gn_stage_time_build(struct gn_stage_time *time, struct gn_stage *stage,
                         const struct gn_frame_opts *opts, const struct gn_cost_gpu *gpu,
                         struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_embedded *text = gn_embedded_find("programs.cost");
    const struct gn_caps caps = {.has = (1u << GN_CAP_COUNT) - 1,
                                 .max_texture_px = TEXTURE_PX,
                                 .max_texture_units = GN_SAMPLERS_MAX,
                                 .etc2 = true};
    *time = (struct gn_stage_time){0};
    time->table = text ? gn_cost_table_create((const char *)text->data, gpu->name) : NULL;
    if (!time->table) return gn_fail(err, "this build knows no program of %s", gpu->name);
    time->builder = gn_frame_create(stage->scene, &caps);
    const struct gn_plan *plan = build_plan(time, stage, opts, warnings);
    time->counts = gn_xalloc(plan->draw_count + 1, sizeof *time->counts);
    time->names = gn_xalloc(plan->program_count + 1, sizeof *time->names);
    for (uint32_t i = 0; i < plan->program_count; i++)
        gn_gl_key_text(&plan->programs[i], time->names[i], sizeof *time->names);
    gn_cost_count(plan, &stage->pose, time->counts);
    gn_frame_cost_build(&time->cost, plan, gpu, time->table, time->names, time->counts, time->when);
    return true;
}

void gn_stage_time_finish(struct gn_stage_time *time) {
    gn_frame_cost_finish(&time->cost);
    gn_cost_table_destroy(time->table);
    gn_frame_destroy(time->builder);
    free(time->counts);
    free(time->names);
    free(time->when);
    *time = (struct gn_stage_time){0};
}

/* ---- how large a picture may be ---- */

double gn_stage_scale_for(const struct gn_stage_parts *ms, double period_ms) {
    if (ms->fixed + ms->pixels <= period_ms) return 1;
    for (int refreshes = 1; refreshes <= GN_STAGE_REFRESHES_MAX; refreshes++) {
        const double left_ms = refreshes * period_ms - ms->fixed - ms->scaling,
                     share = left_ms > 0 ? sqrt(left_ms / ms->pixels) : 0,
                     scale = floor(share * GN_STAGE_SCALE_STEPS) / GN_STAGE_SCALE_STEPS;
        if (ms->fixed + ms->pixels <= refreshes * period_ms) return 1; /* nothing is won */
        if (scale >= 0.5) return fmin(scale, 1);
    }
    return 1;
}

/* Counted at half of width and height, since counting pixels is what takes long: there a little
 * more lanes are shaded for each pixel. */
double gn_stage_scale(struct gn_stage *stage, const struct gn_cost_gpu *gpu, double period_ms) {
    struct gn_frame_opts opts = stage->shown.opts;
    struct gn_stage_time time;
    struct gn_stage_parts parts = {0};
    struct gn_err err = {0};
    opts.output.scale = 0.5f;
    opts.output.scaled_later = false; /* texts and fades want it scaled before */
    const bool ok = gn_stage_time_build(&time, stage, &opts, gpu, NULL, &err);
    const struct gn_plan *plan = ok ? time.cost.plan : NULL;
    for (uint32_t i = 0; plan && i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        const struct gn_pass_cost *cost = &time.cost.passes[i];
        if (time.when[i] == GN_COST_KEPT) continue;
        if (pass->kind != GN_PASS_PICTURE)
            parts.fixed += cost->ms;
        else if (pass->picture.scales)
            parts.scaling += cost->ms;
        else {
            parts.fixed += cost->vertex_ms;
            parts.pixels += 4 * (cost->ms - cost->vertex_ms);
        }
    }
    gn_stage_time_finish(&time);
    return ok ? gn_stage_scale_for(&parts, period_ms) : 1;
}
