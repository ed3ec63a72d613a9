#include "stage/gather.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "shadow/lamp.h"
#include "stage/lights.h"

/* ---- one picture ---- */

/* Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences" (2018): evenly spread, each
 * part in another of cells of a quarter of a pixel's width. */
static void step_aside(struct gn_frame_view_opts *view, struct gn_gather_point point) {
    const uint32_t part = point.index / GN_GATHER_PART, row = part / 4,
                   rows = point.count / (4 * GN_GATHER_PART);
    const double x = part % 4 + fmod(0.7548776662466927 * point.index, 1),
                 y = row + fmod(0.5698402909980532 * point.index, 1);
    view->aside_px[0] = point.aside ? (float)(x / 4 - 0.5) : 0.0f;
    view->aside_px[1] = point.aside ? (float)(y / rows - 0.5) : 0.0f;
}

/* NULL: the light has no soft shadow. */
static struct gn_light_opts *soften(struct gn_frame_opts *opts, const struct gn_light_opts *holds) {
    const struct gn_technique_row *row = &gn_techniques[holds->technique];
    const bool soft =
        row->soft && !row->on_plane && !row->on_screen && holds->radius > 0.0f && holds->on;
    return soft ? gn_stage_light_entry(&opts->shadow, holds->light) : NULL;
}

bool gn_gather_share(struct gn_view *view, float (**aside)[3], const struct gn_view *shown,
                     struct gn_gather_point point) {
    const struct gn_scene *scene = shown->pose->scene;
    struct gn_frame_opts *opts = &view->opts;
    const uint32_t in_part = point.index % GN_GATHER_PART;
    bool any = false;
    float place[3];
    gn_view_share(view, GN_VIEW_STILL, shown, &shown->opts);
    opts->output.msaa = 0;
    opts->output.keeps_alpha = false;
    opts->cover = (struct gn_frame_cover_opts){0};
    opts->shadow.filter_texels = opts->shadow.gather_points = 0;
    if (!*aside) *aside = gn_xalloc(scene->light_count + 1, sizeof **aside);
    gn_lamp_point(point.index, point.count, place);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        struct gn_light_opts holds =
            gn_frame_light_opts(shown->builder, shown->pose, &shown->opts, i);
        holds.light = i;
        struct gn_light_opts *own = scene->lights[i].slide < 0 ? soften(opts, &holds) : NULL;
        for (int k = 0; k < 3; k++) (*aside)[i][k] = own ? holds.radius * place[k] : 0.0f;
        if (!own) continue;
        any = true;
        GN_LIGHT_SET(own, technique, GN_TECHNIQUE_HARD);
        GN_LIGHT_SET(own, map_format, GN_MAP_FORMAT(GN_ENCODING_AUTO, GN_MOMENTS_NONE));
    }
    step_aside(&opts->view, point);
    opts->gather.part = 1.0f / (float)(in_part + 1);
    opts->gather.whole = 0.0f;
    if (in_part == GN_GATHER_PART - 1)
        opts->gather.whole = (float)GN_GATHER_PART / (float)(point.index + 1);
    return any;
}

bool gn_gather_add(struct gn_view *view, float (**aside)[3], const struct gn_view *shown,
                   struct gn_gather_point point, struct gn_gl *gl) {
    struct gn_err unused = {0}; /* the technique's picture stays */
    if (!gn_gather_share(view, aside, shown, point)) return false;
    shown->pose->lights_aside = (const float(*)[3]) * aside;
    const struct gn_plan *plan = gn_view_plan(view, gl, NULL, &unused);
    shown->pose->lights_aside = NULL;
    return plan && plan->gathers && gn_gl_run(gl, plan, NULL, &unused);
}

/* ---- a whole picture at once ---- */

void gn_stage_gather(struct gn_stage *stage, struct gn_view *view, int64_t time_ns,
                     struct gn_warnings *warnings) {
    struct gn_view still = {0};
    struct gn_gather_point point = {.count = GN_GATHER_POINTS, .aside = view->opts.output.msaa > 1};
    float(*aside)[3] = NULL;
    gn_view_pose(view, stage->settings, time_ns);
    gn_stage_occlude(stage, view);
    gn_stage_refine(stage, view);
    gn_view_build(view, stage->gl, &view->opts, warnings);
    const bool soft = gn_gather_share(&still, &aside, view, point);
    const bool can = gn_gl_caps(stage->gl)->has & 1u << GN_CAP_RGBA16F &&
                     view->opts.background != GN_BACKGROUND_TRANSPARENT; /* a mean has no alpha */
    while (soft && can && point.index < point.count &&
           gn_gather_add(&still, &aside, view, point, stage->gl))
        point.index++;
    if (point.index == point.count) {
        view->opts.shadow = still.opts.shadow;
        view->opts.output.msaa = 0;
        view->opts.cover.mean = 1.0f;
        view->opts.cover.mean_of = GN_VIEW_STILL;
    } else if (soft) {
        gn_warn(warnings, "this picture cannot be gathered: soft shadows are as the technique has "
                          "them; see --gather");
    } else {
        gn_warn(warnings, "no light has soft shadows, so nothing is gathered: choose a technique "
                          "that has them, as --shadow cone, and a light with gnomon_radius");
    }
    gn_view_stop(&still);
    free(aside);
}
