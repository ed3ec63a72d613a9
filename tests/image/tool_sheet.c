/* Puts pictures of one size side by side: tool_sheet OUT.png COLUMNS[/SHRINK] [TITLE=]PNG..; SHRINK
 * divides their size. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "blocks.glsl"
#include "caption/captions.h"
#include "image/picture.h"

enum { GAP = 4 };

static int quit(const char *text) {
    fprintf(stderr, "tool_sheet: %s\n", text);
    return 1;
}

static void put(struct gn_picture *sheet, const struct gn_picture *from, int x0, int y0) {
    for (int y = 0; y < from->height_px; y++)
        for (int x = 0; x < from->width_px; x++)
            memcpy(gn_picture_at(sheet, x0 + x, y0 + y), gn_picture_at(from, x, y),
                   3 * sizeof(float));
}

/* Each pixel becomes the mean of shrink x shrink ones, as they are encoded. */
static void shrink_picture(struct gn_picture *picture, int shrink) {
    struct gn_picture small;
    gn_picture_init(&small, picture->width_px / shrink, picture->height_px / shrink,
                    picture->channels);
    for (int y = 0; y < small.height_px * shrink; y++)
        for (int x = 0; x < small.width_px * shrink; x++)
            for (int c = 0; c < small.channels; c++)
                gn_picture_at(&small, x / shrink, y / shrink)[c] +=
                    gn_picture_at(picture, x, y)[c] / (float)(shrink * shrink);
    gn_picture_finish(picture);
    *picture = small;
}

/* The title, as a kiosk shows the name of a mode. */
static void write_title(struct gn_captions *captions, const char *title, struct gn_picture *on) {
    gn_captions_set(captions, GN_CAPTION_MODE, title, 0);
    const struct gn_caption_run *run =
        gn_captions_run(captions, (uint32_t)on->width_px, (uint32_t)on->height_px, 0);
    for (uint32_t i = 0; run && i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        for (int y = 0; y < q->height; y++)
            for (int x = 0; x < q->width; x++) {
                const size_t at =
                    (size_t)(q->atlas_y + y) * run->atlas->width_px + q->atlas_x + (size_t)x;
                const float share =
                    q->ground ? 1 - (float)CAPTION_SHADE : (float)run->atlas->coverage[at] / 255;
                float *rgb = gn_picture_at(on, q->x + x, q->y + y);
                for (int c = 0; c < 3; c++) rgb[c] += share * ((q->ground ? 0 : 1) - rgb[c]);
            }
    }
}

int main(int argc, char **argv) {
    const char *slash = argc > 3 ? strchr(argv[2], '/') : NULL;
    const int columns = argc > 3 ? atoi(argv[2]) : 0, count = argc - 3;
    const int shrink = slash ? atoi(slash + 1) : 1;
    struct gn_picture sheet = {0}, one = {0};
    struct gn_err err = {0};
    if (columns < 1 || shrink < 1) return quit("OUT.png COLUMNS[/SHRINK] [TITLE=]PNG..");
    struct gn_captions *captions = gn_captions_create(&(struct gn_captions_opts){0});
    for (int i = 0; i < count; i++) {
        char *path = strchr(argv[3 + i], '='), *title = path ? argv[3 + i] : NULL;
        if (path) *path++ = 0;
        if (!gn_picture_read(&one, path ? path : argv[3 + i], &err)) return quit(err.text);
        if (shrink > 1) shrink_picture(&one, shrink);
        const int w = one.width_px + GAP, h = one.height_px + GAP;
        if (!sheet.data)
            gn_picture_init(&sheet, columns * w - GAP, (count + columns - 1) / columns * h - GAP,
                            3);
        const int x = i % columns * w, y = i / columns * h;
        if (one.channels < 3 || x + one.width_px > sheet.width_px ||
            y + one.height_px > sheet.height_px)
            return quit("the pictures are not alike");
        if (title) write_title(captions, title, &one);
        put(&sheet, &one, x, y);
        gn_picture_finish(&one);
    }
    const bool ok = gn_picture_write_png(&sheet, argv[1], &err);
    gn_picture_finish(&sheet);
    gn_captions_destroy(captions);
    return ok ? 0 : quit(err.text);
}
