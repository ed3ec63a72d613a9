#include "truth/benchmark.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "truth/penumbra.h"
#include "truth/sight.h"
#include "truth/tear.h"

enum { MAP_PX = 1024, STEPS = 256, FAR = 1 << 15 };

const struct gn_benchmark_class_row gn_benchmark_classes[GN_BENCHMARK_CLASS_COUNT] = {
    [GN_BENCHMARK_FIELD] = {"field", 640, 480, false, GN_BENCHMARK_WRONG},
    [GN_BENCHMARK_COARSE] = {"coarse", 640, 480, false, GN_BENCHMARK_DARKENING},
    [GN_BENCHMARK_CONTACT] = {"contact", 640, 480, false, GN_BENCHMARK_GAP},
    [GN_BENCHMARK_RODS] = {"rods", 640, 480, false, GN_BENCHMARK_GAP},
    [GN_BENCHMARK_SCALED] = {"scaled", 640, 480, false, GN_BENCHMARK_GAP},
    [GN_BENCHMARK_SOFT] = {"soft", 480, 360, true, GN_BENCHMARK_PENUMBRA},
    [GN_BENCHMARK_THIN] = {"thin", 480, 360, true, GN_BENCHMARK_PENUMBRA},
};
const char *const gn_benchmark_measures[GN_BENCHMARK_MEASURE_COUNT] = {
    [GN_BENCHMARK_ACNE] = "acne",         [GN_BENCHMARK_DARKENING] = "darkening",
    [GN_BENCHMARK_DARKENED] = "darkened", [GN_BENCHMARK_LEAK] = "leak",
    [GN_BENCHMARK_GAP] = "gap",           [GN_BENCHMARK_WRONG] = "wrong",
    [GN_BENCHMARK_PENUMBRA] = "penumbra", [GN_BENCHMARK_REST] = "rest",
    [GN_BENCHMARK_BIAS] = "bias",         [GN_BENCHMARK_GRAIN] = "grain",
    [GN_BENCHMARK_TEAR] = "tear",         [GN_BENCHMARK_PIXEL_GRAIN] = "grain",
};

bool gn_benchmark_name_parse(const char *text, struct gn_benchmark_name *name) {
    static const char *const lights[] = {"sun", "spot", "point"};
    if (text[strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789-")]) return false;
    for (int k = 0; k < GN_BENCHMARK_CLASS_COUNT; k++) {
        const size_t length = strlen(gn_benchmark_classes[k].name);
        if (strncmp(text, gn_benchmark_classes[k].name, length) != 0 || text[length] != '-')
            continue;
        const char *light = text + length + 1;
        for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
            const size_t end = strlen(lights[i]);
            if (strncmp(light, lights[i], end) != 0 || (light[end] && light[end] != '-')) continue;
            name->kind = (enum gn_benchmark_class)k;
            memcpy(name->light, lights[i], end + 1);
            return true;
        }
    }
    return false;
}

size_t gn_benchmark_pixels(enum gn_benchmark_class kind) {
    return (size_t)gn_benchmark_classes[kind].width_px *
           (size_t)gn_benchmark_classes[kind].height_px;
}

/* ---- truth ---- */

static bool make_hard(const struct gn_scene *scene, const struct gn_truth_opts *opts, float *rgb,
                      struct gn_err *err) {
    struct gn_truth truth;
    if (!gn_truth_make(&truth, scene, opts, err)) return false;
    const size_t pixels = (size_t)opts->width_px * (size_t)opts->height_px;
    const double texel = gn_truth_texel(&truth, MAP_PX);
    float *edges = gn_xalloc(pixels, sizeof *edges);
    gn_truth_band(&truth, MAP_PX);
    gn_mask_edges(&truth.mask, edges);
    for (size_t i = 0; i < pixels; i++) {
        const double edge_px = (double)edges[i];
        const double n_l = truth.mask.item[i] < 0 ? 0 : gn_truth_facing(&truth, i);
        const double texels =
            n_l > .25 && edge_px >= 5 ? edge_px * n_l / gn_truth_texel_px(&truth, texel, i) : 0;
        rgb[3 * i] = truth.mask.lit[i];
        rgb[3 * i + 1] =
            (float)(ceil(STEPS * fmin(edge_px / (double)truth.mask.band_px[i], FAR)) / STEPS);
        rgb[3 * i + 2] = (float)(floor(STEPS * fmin(texels, FAR)) / STEPS);
    }
    free(edges);
    gn_truth_finish(&truth);
    return true;
}

static bool make_soft(const struct gn_scene *scene, const struct gn_truth_opts *opts, float *rgb) {
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    const size_t pixels = (size_t)opts->width_px * (size_t)opts->height_px;
    float *share = gn_xalloc(pixels, sizeof *share);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, opts->camera, opts->width_px, opts->height_px);
    gn_ray_lamp_init(&lamp, &pose, opts->light);
    gn_penumbra_cast(&rays, &eye, &lamp, share);
    for (size_t i = 0; i < pixels; i++) {
        rgb[3 * i] = share[i];
        rgb[3 * i + 1] = rgb[3 * i + 2] = 0;
    }
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
    free(share);
    return true;
}

bool gn_benchmark_make(const struct gn_scene *scene, enum gn_benchmark_class kind, float *rgb,
                       struct gn_err *err) {
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[kind];
    const struct gn_truth_opts opts = {.width_px = row->width_px, .height_px = row->height_px};
    if (scene->camera_count == 0 || scene->light_count == 0)
        return gn_fail(err, "has no camera or no light");
    return row->soft ? make_soft(scene, &opts, rgb) : make_hard(scene, &opts, rgb, err);
}

/* ---- the measures ---- */

static void compare_hard(const float *truth, const float *shot, size_t pixels, double reach_texels,
                         double of[]) {
    struct gn_mask_score score = {.pixels = pixels};
    for (size_t i = 0; i < pixels; i++) {
        const float *t = &truth[3 * i];
        const bool lit = t[0] >= .5f;
        const double texels = (double)t[2];
        gn_mask_count(&score,
                      &(struct gn_mask_pixel){.lit = lit,
                                              .away = t[1] > 1,
                                              .safe = lit && texels > 0 && texels >= reach_texels,
                                              .shown = shot[3 * i]});
    }
    of[GN_BENCHMARK_ACNE] = gn_mask_acne(&score);
    of[GN_BENCHMARK_DARKENING] = gn_mask_darkening(&score);
    of[GN_BENCHMARK_DARKENED] = gn_mask_darkened(&score);
    of[GN_BENCHMARK_LEAK] = gn_mask_leak(&score);
    of[GN_BENCHMARK_GAP] = gn_mask_gap(&score);
    of[GN_BENCHMARK_WRONG] = gn_mask_wrong(&score);
}

static void compare_soft(const float *truth, const float *shot,
                         const struct gn_benchmark_class_row *row, double of[]) {
    const size_t pixels = (size_t)row->width_px * (size_t)row->height_px;
    float *share = gn_xalloc(2 * pixels, sizeof *share), *shown = share + pixels;
    for (size_t i = 0; i < pixels; i++) {
        const float value = shot[3 * i];
        share[i] = truth[3 * i];
        shown[i] = value > 0 ? fminf(value, 1) : 0; /* what is no number, too */
    }
    struct gn_penumbra_score score;
    gn_penumbra_compare(share, shown, 1, row->width_px, row->height_px, &score);
    of[GN_BENCHMARK_PENUMBRA] = score.soft;
    of[GN_BENCHMARK_REST] = score.rest;
    of[GN_BENCHMARK_BIAS] = score.bias;
    of[GN_BENCHMARK_GRAIN] = score.grain;
    struct gn_tear tear;
    struct gn_tear_score torn[GN_TEAR_PARTS];
    gn_tear_init(&tear, &(struct gn_tear_view){.width_px = row->width_px,
                                               .height_px = row->height_px,
                                               .truth = share});
    gn_tear_compare(&tear, shown, 1, torn);
    gn_tear_finish(&tear);
    of[GN_BENCHMARK_TEAR] = torn[GN_TEAR_ALL].tear;
    of[GN_BENCHMARK_PIXEL_GRAIN] = torn[GN_TEAR_ALL].grain;
    free(share);
}

void gn_benchmark_compare(enum gn_benchmark_class kind, const float *truth, const float *shot,
                          double reach_texels, struct gn_benchmark_score *score) {
    const struct gn_benchmark_class_row *row = &gn_benchmark_classes[kind];
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++) score->of[m] = (double)NAN;
    if (row->soft)
        compare_soft(truth, shot, row, score->of);
    else
        compare_hard(truth, shot, gn_benchmark_pixels(kind), reach_texels, score->of);
}

void gn_benchmark_mean(const struct gn_benchmark_score *scores, size_t count,
                       struct gn_benchmark_score *mean) {
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++) {
        double sum = 0;
        int measured = 0;
        for (size_t i = 0; i < count; i++) {
            if (isnan(scores[i].of[m])) continue;
            sum += scores[i].of[m];
            measured++;
        }
        mean->of[m] = measured ? sum / measured : (double)NAN;
    }
}
