#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/lesson.h"
#include "image/write.h"
#include "stage/stage.h"
#include "truth/contact.h"
#include "truth/penumbra.h"

static const struct gn_size default_size = {480, 360};
enum { SAMPLES = 64 }; /* points of a light, for a picture of penumbrae */

struct desk {
    const struct gn_lesson *lesson;
    struct gn_settings settings; /* of the step that is drawn */
    struct gn_stage stage;
    struct gn_truth truth;
    float *share; /* of the light that each pixel sees, if penumbrae are measured; else NULL */
    float *shot;  /* RGBA: visibility in R */
    uint8_t *rgba;
    size_t pixels;
    const char *folder;
};

static bool measures(const struct desk *desk, enum gn_figure figure) {
    return gn_lesson_figures(desk->lesson) & 1u << figure;
}

/* ---- figures ---- */

/* The most light in a pixel that is dark and farther from edges than the filter reaches. */
static double measure_glow(const struct gn_mask_truth *mask, const float *shot, size_t pixels) {
    float *edges = gn_xalloc(pixels, sizeof *edges), most = 0;
    gn_mask_edges(mask, edges);
    for (size_t i = 0; i < pixels; i++)
        if (!mask->lit[i] && edges[i] >= mask->safe_px[i]) most = fmaxf(most, shot[4 * i]);
    free(edges);
    return 100.0 * (double)most;
}

static void measure_step(struct desk *desk, const struct gn_shadow_view *view, double *figures) {
    const struct gn_mask_truth *mask = &desk->truth.mask;
    const unsigned map_px = view ? view->map.tile_px : 1024;
    const float reach = view ? gn_techniques[view->technique].radius_texels : 1;
    struct gn_mask_score score;
    gn_truth_band(&desk->truth, map_px);
    gn_truth_safe(&desk->truth, map_px, (double)reach);
    gn_mask_compare(mask, desk->shot, 4, &score);
    figures[GN_FIGURE_DARKENING] = gn_mask_darkening(&score);
    figures[GN_FIGURE_LEAK] = gn_mask_leak(&score);
    figures[GN_FIGURE_WRONG] = gn_mask_wrong(&score);
    if (measures(desk, GN_FIGURE_GLOW))
        figures[GN_FIGURE_GLOW] = measure_glow(mask, desk->shot, desk->pixels);
    if (measures(desk, GN_FIGURE_GAP)) {
        struct gn_contact contact;
        gn_contact_compare(&desk->truth, desk->shot, 4, map_px, &contact);
        figures[GN_FIGURE_GAP] = contact.mean;
    }
    if (measures(desk, GN_FIGURE_PENUMBRA)) {
        struct gn_penumbra_score penumbra;
        gn_penumbra_compare(desk->share, desk->shot, 4, mask->width_px, mask->height_px, &penumbra);
        figures[GN_FIGURE_PENUMBRA] = penumbra.soft;
    }
    for (int i = 0; i < GN_FIGURE_COUNT; i++)
        if (!measures(desk, (enum gn_figure)i)) figures[i] = (double)NAN;
}

/* ---- pictures ---- */

/* The truth in grey; what is too dark in red, what is too bright in blue. */
static void paint_difference(const struct desk *desk, uint8_t *rgba) {
    static const float too_dark[3] = {.95f, .1f, .05f}, too_bright[3] = {.05f, .3f, 1};
    enum { RAISED = 2 };
    for (size_t i = 0; i < desk->pixels; i++) {
        const float truth = desk->share ? desk->share[i] : (float)desk->truth.mask.lit[i];
        const float off = desk->shot[4 * i] - truth, share = fminf(1, RAISED * fabsf(off));
        const float grey = desk->truth.mask.item[i] < 0 ? .5f : .25f + .6f * truth;
        for (int k = 0; k < 3; k++) {
            const float mark = off < 0 ? too_dark[k] : too_bright[k];
            rgba[4 * i + (size_t)k] = (uint8_t)lrintf(255 * (grey + share * (mark - grey)));
        }
        rgba[4 * i + 3] = 255;
    }
}

static bool write_picture(const struct desk *desk, const char *what, bool srgb,
                          struct gn_err *err) {
    char path[4096];
    const int length =
        snprintf(path, sizeof path, "%s/%s-%s.png", desk->folder, desk->lesson->name, what);
    if (length < 0 || (size_t)length >= sizeof path)
        return gn_fail_usage(err, "-o: that name is too long");
    return gn_picture_write_png8(path, desk->rgba, desk->truth.mask.width_px,
                                 desk->truth.mask.height_px, srgb, err);
}

static bool write_color(struct desk *desk, const char *what, struct gn_warnings *warnings,
                        struct gn_err *err) {
    desk->stage.shown.opts.debug.aov = GN_AOV_COLOR;
    return gn_view_draw(&desk->stage.shown, &desk->stage, 0, warnings, err) &&
           gn_gl_read_rgba8(desk->stage.gl, desk->rgba, err) &&
           write_picture(desk, what, true, err);
}

/* ---- steps ---- */

/* step -1: without a mode. */
static void choose_settings(struct desk *desk, const struct gn_options *options, int step) {
    desk->settings = options->all[1 + step];
    if (!gn_settings_given(&desk->settings, render.size)) desk->settings.render.size = default_size;
    desk->settings.scene.floor_m = INFINITY; /* a scene of a lesson is all there is */
    desk->settings.run.samples = measures(desk, GN_FIGURE_PENUMBRA) ? SAMPLES : 1;
}

static bool choose_look(struct desk *desk, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_stage_look look;
    if (!gn_stage_look_build(&look, &desk->settings, desk->stage.scene, warnings, err))
        return false;
    desk->stage.shown.opts = look.frame_opts;
    desk->stage.shown.opts.tone = GN_TONE_NONE; /* figures and pictures are of the shadow alone */
    return true;
}

static bool draw_step(struct desk *desk, int step, double *figures, struct gn_warnings *warnings,
                      struct gn_err *err) {
    char what[24];
    if (!choose_look(desk, warnings, err)) return false;
    desk->stage.shown.opts.debug.aov = GN_AOV_VISIBILITY;
    const struct gn_plan *plan = gn_view_draw(&desk->stage.shown, &desk->stage, 0, warnings, err);
    if (!plan || !gn_gl_read_f32(desk->stage.gl, desk->shot, err)) return false;
    measure_step(desk, plan->shadow_count > 0 ? &plan->shadows[0] : NULL, figures);
    if (!desk->folder) return true;
    snprintf(what, sizeof what, "%d-diff", step + 1);
    paint_difference(desk, desk->rgba);
    if (!write_picture(desk, what, false, err)) return false;
    snprintf(what, sizeof what, "%d", step + 1);
    return write_color(desk, what, warnings, err);
}

static bool make_truth(struct desk *desk, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_size size = desk->settings.render.size;
    const struct gn_truth_opts opts = {.width_px = size.width_px, .height_px = size.height_px};
    if (!gn_truth_make(&desk->truth, desk->stage.scene, &opts, err)) return false;
    if (measures(desk, GN_FIGURE_PENUMBRA)) {
        struct gn_raycast rays;
        desk->share = gn_picture_alloc(desk->pixels, sizeof *desk->share, err);
        if (!desk->share) return false;
        gn_raycast_init(&rays, desk->stage.scene, &desk->stage.pose, NULL);
        gn_penumbra_cast(&rays, &desk->truth.frame.eye, &desk->truth.frame.lamp, desk->share);
        gn_raycast_finish(&rays);
    }
    if (!desk->folder) return true;
    struct gn_light_opts *any = &desk->stage.shown.opts.shadow.any;
    GN_LIGHT_SET(any, technique, GN_TECHNIQUE_TRUTH);
    any->given &= ~GN_LIGHT_GIVEN(map_format);
    return write_color(desk, "truth", warnings, err);
}

bool gn_lesson_measure(const struct gn_lesson *lesson, const struct gn_lesson_opts *opts,
                       struct gn_lesson_result *result, struct gn_warnings *warnings,
                       struct gn_err *err) {
    struct desk desk = {.lesson = lesson, .folder = opts->folder};
    *result = (struct gn_lesson_result){.lesson = lesson};
    choose_settings(&desk, opts->options, -1);
    desk.pixels =
        (size_t)desk.settings.render.size.width_px * (size_t)desk.settings.render.size.height_px;
    bool ok = gn_stage_load(&desk.stage, &desk.settings, warnings, err) &&
              gn_stage_open(&desk.stage, warnings, err);
    ok = ok && (desk.shot = gn_picture_alloc(desk.pixels, 4 * sizeof *desk.shot, err)) &&
         (desk.rgba = gn_picture_alloc(desk.pixels, 4, err)) && make_truth(&desk, warnings, err);
    for (int i = 0; ok && i < gn_lesson_steps(lesson); i++) {
        choose_settings(&desk, opts->options, i);
        ok = draw_step(&desk, i, result->figures[i], warnings, err);
    }
    gn_truth_finish(&desk.truth);
    free(desk.share);
    free(desk.shot);
    free(desk.rgba);
    gn_stage_close(&desk.stage);
    return ok;
}
