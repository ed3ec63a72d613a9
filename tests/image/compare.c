#include "image/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/arena.h"
#include "image/measure.h"

/* --- colours --- */

bool gn_compare(const struct gn_picture *a, const struct gn_picture *b, double tolerance,
                struct gn_difference *difference) {
    struct gn_measure m;
    *difference = (struct gn_difference){.max = INFINITY, .share = INFINITY};
    if (a->width_px != b->width_px || a->height_px != b->height_px || a->channels != b->channels)
        return false;
    gn_measure(a->data, b->data, (size_t)a->width_px, (size_t)a->height_px, a->channels, tolerance,
               &m);
    *difference = (struct gn_difference){m.max, m.share, (int)m.worst_x, (int)m.worst_y};
    return true;
}

/* --- failures as pictures --- */

static bool shot_is_lit(const struct gn_picture *shot, size_t i) {
    return shot->data[i * shot->channels] >= .5f;
}

static void make_folder(const char *path) {
    char part[512];
    snprintf(part, sizeof part, "%s", path);
    for (char *p = part + 1; *p; p++) {
        if (*p != '/') continue;
        *p = 0;
        mkdir(part, 0777);
        *p = '/';
    }
    mkdir(part, 0777);
}

static void save(const char *folder, const char *name, const char *kind,
                 const struct gn_picture *picture) {
    char path[1024];
    struct gn_err err = {0};
    bool failed = !folder;
    if (failed) folder = "build/failures";
    make_folder(folder);
    snprintf(path, sizeof path, "%s/%s-%s.png", folder, name, kind);
    if (!gn_picture_write_png(picture, path, &err))
        printf("  %s\n", err.text);
    else if (failed)
        printf("  %s\n", path);
}

static void mask_diff(const struct gn_mask_truth *truth, const struct gn_picture *shot,
                      const float *edges, struct gn_picture *out) {
    gn_picture_init(out, truth->width_px, truth->height_px, 3);
    for (size_t i = 0; i < (size_t)truth->width_px * truth->height_px; i++) {
        float *rgb = out->data + 3 * i;
        bool lit = truth->lit[i], shown = shot_is_lit(shot, i);
        rgb[0] = rgb[1] = rgb[2] = lit ? .9f : .25f;
        if (lit == shown) continue;
        float rest = gn_mask_is_away(truth, edges, i) ? 0 : .6f;
        rgb[0] = lit ? 1 : rest;
        rgb[1] = rest;
        rgb[2] = lit ? rest : 1;
    }
}

void gn_mask_save(const char *folder, const char *name, const struct gn_mask_truth *truth,
                  const struct gn_picture *shot) {
    size_t pixels = (size_t)truth->width_px * truth->height_px;
    struct gn_picture lit, diff;
    gn_picture_init(&lit, truth->width_px, truth->height_px, 1);
    for (size_t i = 0; i < pixels; i++) lit.data[i] = truth->lit[i];
    float *edges = gn_xalloc(pixels, sizeof *edges);
    gn_mask_edges(truth, edges);
    mask_diff(truth, shot, edges, &diff);
    save(folder, name, "shot", shot);
    save(folder, name, "truth", &lit);
    save(folder, name, "diff", &diff);
    free(edges);
    gn_picture_finish(&lit);
    gn_picture_finish(&diff);
}

void gn_compare_save(const char *folder, const char *name, const struct gn_picture *shot,
                     const struct gn_picture *expected) {
    save(folder, name, "shot", shot);
    save(folder, name, "truth", expected);
    if (shot->width_px != expected->width_px || shot->height_px != expected->height_px ||
        shot->channels != expected->channels)
        return;
    struct gn_picture diff;
    gn_picture_init(&diff, shot->width_px, shot->height_px, shot->channels);
    size_t count = (size_t)shot->width_px * shot->height_px * shot->channels;
    for (size_t i = 0; i < count; i++)
        diff.data[i] = (shot->channels == 4 || shot->channels == 2) &&
                               (int)(i % shot->channels) == shot->channels - 1
                           ? 1
                           : (float)(8 * gn_measure_channel(shot->data[i], expected->data[i]));
    save(folder, name, "diff", &diff);
    gn_picture_finish(&diff);
}
