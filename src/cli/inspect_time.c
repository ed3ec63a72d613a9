#include "cli/inspect_time.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

enum { FPS = 60, SAMPLES = 4, TEXTURE_PX = 4096 };
#define GOAL_MS      (1000.0 / FPS)
#define LANES_OF_FEW 1.3 /* lanes for each pixel where triangles are large */

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
    const struct gn_frame_cost *cost = &time->frame.cost;
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
    const struct gn_size *px = &stage->settings->render.size;
    *time = (struct gn_inspect_time){0};
    if (px->width_px > TEXTURE_PX || px->height_px > TEXTURE_PX)
        return gn_fail_usage(err, "--size: %dx%d is more than a board's GPU draws: at most %dx%d",
                             px->width_px, px->height_px, TEXTURE_PX, TEXTURE_PX);
    struct gn_frame_opts opts = stage->shown.opts;
    set_output(stage->settings, &opts);
    if (!gn_stage_time_build(&time->frame, stage, &opts, gpu, warnings, err)) return false;
    advise(time);
    return true;
}

void gn_inspect_time_finish(struct gn_inspect_time *time) { gn_stage_time_finish(&time->frame); }
