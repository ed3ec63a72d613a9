#include "image/soft.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/shot.h"
#include "truth/sight.h"
#include "unit/gltf_maker.h"

/* ---- the default picture ---- */

/* About the studio's key; given, so that the test knows it. */
#define AZIMUTH   "18"
#define ELEVATION "58"
enum { AZIMUTH_DEG = 18, ELEVATION_DEG = 58, ROOM = 6000 };

/* Adds a box of that middle and half its size. */
static void add_box(char *nodes, int *count, double x, double y, double z, const double half[3]) {
    snprintf(nodes + strlen(nodes), ROOM - strlen(nodes),
             "%s{'mesh':1,'translation':[%g,%g,%g],'scale':[%g,%g,%g]}", *count ? "," : "", x, y, z,
             half[0], half[1], half[2]);
    (*count)++;
}

/* What the made light tears: bars low and high over one another, thin legs under a plate. */
static void add_model(struct gn_maker *maker) {
    char nodes[ROOM] = "[", roots[400] = "[{'nodes':[0";
    int count = 0;
    for (int i = 0; i < 9; i++)
        add_box(nodes, &count, -.8 + .2 * i, .75, -.5, (const double[]){.015, .75, .015});
    for (int i = 0; i < 7; i++)
        add_box(nodes, &count, 0, .15 + .2 * i, -.47, (const double[]){.83, .015, .015});
    for (int i = 0; i < 9; i++)
        add_box(nodes, &count, -.8 + .2 * i, 1.45, 0, (const double[]){.02, .02, .5});
    for (int i = 0; i < 4; i++)
        add_box(nodes, &count, i % 2 ? .35 : -.15, .25, i / 2 ? .75 : .35,
                (const double[]){.02, .25, .02});
    add_box(nodes, &count, .1, .52, .55, (const double[]){.35, .02, .28});
    add_box(nodes, &count, -.6, .1, .5, (const double[]){.1, .1, .1});
    add_box(nodes, &count, .2, .64, .5, (const double[]){.06, .1, .06});
    strcat(nodes, "]");
    for (int i = 1; i < count; i++)
        snprintf(roots + strlen(roots), sizeof roots - strlen(roots), ",%d", i);
    strcat(roots, "]}]");
    gn_maker_set(maker, "nodes", nodes);
    gn_maker_set(maker, "scenes", roots);
}

static char *write_model(struct gn_err *err) {
    struct gn_maker maker;
    char *path = NULL;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    add_model(&maker);
    if (asprintf(&path, "%s/soft-default.glb", gn_shot_build()) < 0) abort();
    if (gn_maker_write(&maker, path, err)) return path;
    free(path);
    return NULL;
}

static bool take_aov(const struct gn_soft *soft, const char *aov, const char *technique,
                     struct gn_picture *shot, struct gn_err *err) {
    char size[32];
    snprintf(size, sizeof size, "%dx%d", soft->width_px, soft->height_px);
    const char *args[24] = {"--backend", "egl",      "--aov",   aov,         "--size",
                            size,        "--shadow", technique, "--samples", "512"};
    static const char *const studio[] = {
        "--environment",   "studio", "--floor",           "auto",
        "--light-azimuth", AZIMUTH,  "--light-elevation", ELEVATION};
    if (soft->scene == GN_SOFT_DEFAULT) memcpy(args + 10, studio, sizeof studio);
    return gn_shot(shot, NULL, err, "pfm", soft->path, args);
}

static bool measure_default(struct gn_soft *soft, struct gn_err *err) {
    const size_t pixels = (size_t)soft->width_px * (size_t)soft->height_px;
    const double azimuth = AZIMUTH_DEG * M_PI / 180, elevation = ELEVATION_DEG * M_PI / 180;
    const double to_light[3] = {sin(azimuth) * cos(elevation), sin(elevation),
                                cos(azimuth) * cos(elevation)};
    struct gn_picture truth = {0}, normal = {0}, distance = {0};
    const bool ok = take_aov(soft, "visibility", "truth", &truth, err) &&
                    take_aov(soft, "normal", "none", &normal, err) &&
                    take_aov(soft, "distance", "none", &distance, err);
    if (ok) {
        float *facing = gn_xalloc(2 * pixels, sizeof *facing), *distance_m = facing + pixels;
        for (size_t i = 0; i < pixels; i++) {
            soft->truth.data[i] = truth.data[i * (size_t)truth.channels];
            distance_m[i] = distance.data[i * (size_t)distance.channels];
        }
        gn_tear_face(normal.data, distance_m, to_light, pixels, facing);
        gn_tear_init(&soft->tear,
                     &(struct gn_tear_view){soft->width_px, soft->height_px, soft->truth.data,
                                            facing, normal.data, distance_m});
        free(facing);
    }
    gn_picture_finish(&truth);
    gn_picture_finish(&normal);
    gn_picture_finish(&distance);
    return ok;
}

/* ---- scenes with a light of their own ---- */

static bool measure_penumbra(struct gn_soft *soft, struct gn_err *err) {
    const struct gn_truth_opts opts = {.width_px = soft->width_px, .height_px = soft->height_px};
    const size_t pixels = (size_t)soft->width_px * (size_t)soft->height_px;
    struct gn_truth sight;
    struct gn_scene *scene = gn_scene_load(soft->path, NULL, NULL, err);
    const bool ok = scene && gn_truth_make(&sight, scene, &opts, err);
    if (ok) {
        float *facing = gn_xalloc(pixels, sizeof *facing);
        for (size_t i = 0; i < pixels; i++)
            facing[i] = sight.mask.item[i] < 0 ? 0 : (float)gn_truth_facing(&sight, i);
        gn_picture_finish(&soft->truth);
        gn_penumbra_truth_of(&soft->truth, scene, false, soft->width_px, soft->height_px);
        gn_tear_init(&soft->tear,
                     &(struct gn_tear_view){soft->width_px, soft->height_px, soft->truth.data,
                                            facing, sight.mask.normal_ws, sight.mask.distance_m});
        free(facing);
        gn_truth_finish(&sight);
    }
    gn_scene_destroy(scene);
    return ok;
}

bool gn_soft_init(struct gn_soft *soft, int scene, int width_px, int height_px,
                  struct gn_err *err) {
    *soft = (struct gn_soft){.scene = scene, .width_px = width_px, .height_px = height_px};
    gn_picture_init(&soft->truth, width_px, height_px, 1);
    soft->path = scene == GN_SOFT_DEFAULT ? write_model(err) : gn_penumbra_write(scene, err);
    if (soft->path &&
        (scene == GN_SOFT_DEFAULT ? measure_default(soft, err) : measure_penumbra(soft, err)))
        return true;
    gn_soft_finish(soft);
    return false;
}

void gn_soft_finish(struct gn_soft *soft) {
    gn_picture_finish(&soft->truth);
    gn_tear_finish(&soft->tear);
    free(soft->path);
    *soft = (struct gn_soft){0};
}

bool gn_soft_shoot(const struct gn_soft *soft, const char *technique, struct gn_picture *shot,
                   struct gn_err *err) {
    return take_aov(soft, "visibility", technique, shot, err);
}

void gn_soft_compare(const struct gn_soft *soft, const struct gn_picture *shot,
                     struct gn_tear_score score[GN_TEAR_PARTS]) {
    gn_tear_compare(&soft->tear, shot->data, shot->channels, score);
}
