#include "cli/inspect_time.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/embedded.h"
#include "cost/drawn.h"
#include "gl/source.h"

enum { FPS = 60, SAMPLES = 4, TEXTURE_PX = 4096 };
#define TURN_RAD     (6.0f / FPS * GLM_PIf / 180.0f) /* of a turntable, in a frame */
#define GOAL_MS      (1000.0 / FPS)
#define LANES_OF_FEW 1.3 /* lanes for each pixel where triangles are large */

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
static const struct gn_plan *build_plan(struct gn_inspect_time *time, struct gn_stage *stage,
                                        const struct gn_frame_opts *opts,
                                        struct gn_warnings *warnings) {
    struct gn_view view = stage->shown;
    const int64_t now_ns = stage->settings->scene.time_ns;
    view.opts = *opts;
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

/* ---- what to change ---- */

/* What many small triangles cost: lanes beyond those of large ones. */
static double lanes_ms(const struct gn_frame_cost *cost, double *ratio) {
    double ms = 0, lanes = 0, pixels = 0;
    for (uint32_t i = 0; i < cost->plan->pass_count; i++) {
        const struct gn_pass_cost *pass = &cost->passes[i];
        if (cost->when[i] != GN_COST_EACH_FRAME || pass->pixels == 0) continue;
        const double of_few = LANES_OF_FEW * (double)pass->pixels / (double)pass->lanes;
        ms += (pass->ms - pass->vertex_ms) * fmax(1 - of_few, 0) + 0.8 * pass->vertex_ms;
        lanes += (double)pass->lanes;
        pixels += (double)pass->pixels;
    }
    *ratio = pixels > 0 ? lanes / pixels : 0;
    return ms;
}

static void advise(struct gn_inspect_time *time) {
    const struct gn_frame_cost *cost = &time->cost;
    const double all = cost->ms[GN_COST_EACH_FRAME];
    double ratio;
    const double lanes = lanes_ms(cost, &ratio), maps = cost->ms[GN_COST_CAMERA_MOVES],
                 light = cost->plan->light_count > 0 ? cost->lights[0].ms : 0;
    char *out = time->advice;
    const size_t size = sizeof time->advice;
    if (all + maps <= GOAL_MS)
        snprintf(out, size, "nothing: %.1f of the %.1f ms of %d frames a second", all + maps,
                 GOAL_MS, FPS);
    else if (maps > lanes && maps > light)
        snprintf(out, size,
                 "maps that are drawn again when the camera moves take %.1f ms: fewer cascades, a "
                 "smaller --map, or fewer lights with a shadow",
                 maps);
    else if (lanes > light && lanes > 0.2 * all)
        snprintf(out, size,
                 "small triangles take about %.1f of %.1f ms, %.2f lanes for each pixel: simplify "
                 "the densest meshes (gnomon bake --simplify)",
                 lanes, all, ratio);
    else if (light > 0.2 * all)
        snprintf(out, size,
                 "light '%s' takes %.1f of %.1f ms: a cheaper technique (--shadow pcf or pcf2), "
                 "fewer --taps, or gnomon_shadow none",
                 cost->lights[0].name, light, all);
    else
        snprintf(out, size,
                 "pixels: material '%s' takes %.1f of %.1f ms; %d frames a second are reached at "
                 "%.0f %% of the width and height",
                 cost->materials[0].name, cost->materials[0].ms, all, FPS,
                 100 * sqrt(GOAL_MS / (all + maps)));
}

/* ---- all of it ---- */

static void set_output(const struct gn_settings *o, struct gn_frame_opts *opts) {
    opts->output.width_px = (uint32_t)o->render.size.width_px;
    opts->output.height_px = (uint32_t)o->render.size.height_px;
    opts->output.msaa = o->render.msaa == GN_MSAA_AUTO ? SAMPLES : (uint32_t)o->render.msaa;
}

bool gn_inspect_time_build(struct gn_inspect_time *time, struct gn_stage *stage,
                           const struct gn_cost_gpu *gpu, struct gn_warnings *warnings,
                           struct gn_err *err) {
    const struct gn_embedded *text = gn_embedded_find("programs.cost");
    const struct gn_caps caps = {.has = (1u << GN_CAP_COUNT) - 1,
                                 .max_texture_px = TEXTURE_PX,
                                 .max_texture_units = GN_SAMPLERS_MAX,
                                 .etc2 = true,
                                 .tiler = true};
    const struct gn_size *px = &stage->settings->render.size;
    *time = (struct gn_inspect_time){0};
    if (px->width_px > TEXTURE_PX || px->height_px > TEXTURE_PX)
        return gn_fail_usage(err, "--size: %dx%d is more than a board's GPU draws: at most %dx%d",
                             px->width_px, px->height_px, TEXTURE_PX, TEXTURE_PX);
    time->table = text ? gn_cost_table_create((const char *)text->data, gpu->name) : NULL;
    if (!time->table) return gn_fail(err, "this build knows no program of %s", gpu->name);
    struct gn_frame_opts opts = stage->shown.opts;
    set_output(stage->settings, &opts);
    time->builder = gn_frame_create(stage->scene, &caps);
    const struct gn_plan *plan = build_plan(time, stage, &opts, warnings);
    time->counts = gn_xalloc(plan->draw_count + 1, sizeof *time->counts);
    time->names = gn_xalloc(plan->program_count + 1, sizeof *time->names);
    for (uint32_t i = 0; i < plan->program_count; i++)
        gn_gl_key_text(&plan->programs[i], time->names[i], sizeof *time->names);
    gn_cost_count(plan, &stage->pose, time->counts);
    gn_frame_cost_build(&time->cost, plan, gpu, time->table, time->names, time->counts, time->when);
    advise(time);
    return true;
}

void gn_inspect_time_finish(struct gn_inspect_time *time) {
    gn_frame_cost_finish(&time->cost);
    gn_cost_table_destroy(time->table);
    gn_frame_destroy(time->builder);
    free(time->counts);
    free(time->names);
    free(time->when);
    *time = (struct gn_inspect_time){0};
}
