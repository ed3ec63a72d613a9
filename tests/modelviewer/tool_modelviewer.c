/* tool_modelviewer NAME THERE.png HERE.png SHEET.png: two pictures of a model on transparent
 * ground, by another program and by gnomon. Prints a row of the table: mean and 95th percentile of
 * Delta E 2000 over the model's pixels, and their brightness in both. The model's pixels are opaque
 * in both, and so is all within two pixels: edges are left out. The sheet has both over grey, the
 * difference (white: 20), and the model's pixels that are brighter here (red) or there (blue). Exit
 * status 1: the mean is over 4 or the brightness differs by over 15 %. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"
#include "modelviewer/delta_e.h"

enum { EDGE = 2, BINS = 10000, GAP = 4, PANELS = 4 };
static const double MEAN_MOST = 4, BRIGHTNESS_MOST = .15, WHITE = 20, BIN = .01;

struct sums {
    size_t pixels;
    double difference, brightness[2]; /* of encoded values, mean of the channels */
    size_t bins[BINS];
};

static bool is_opaque(const struct gn_picture *p, int x, int y) {
    return gn_picture_at(p, x, y)[3] > .999f;
}

static bool is_inside(const struct gn_picture *a, const struct gn_picture *b, int x, int y) {
    for (int dy = -EDGE; dy <= EDGE; dy++)
        for (int dx = -EDGE; dx <= EDGE; dx++) {
            const int u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= a->width_px || v >= a->height_px) return false;
            if (!is_opaque(a, u, v) || !is_opaque(b, u, v)) return false;
        }
    return true;
}

static double brightness_of(const float *rgb) {
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3;
}

static void put(struct gn_picture *sheet, int panel, int width, int x, int y, const float rgb[3]) {
    memcpy(gn_picture_at(sheet, panel * (width + GAP) + x, y), rgb, 3 * sizeof *rgb);
}

static void put_over_grey(struct gn_picture *sheet, int panel, const struct gn_picture *from, int x,
                          int y) {
    const float *c = gn_picture_at(from, x, y);
    float rgb[3];
    for (int k = 0; k < 3; k++) rgb[k] = c[3] * c[k] + (1 - c[3]) * .35f;
    put(sheet, panel, from->width_px, x, y, rgb);
}

static void measure_pixel(const struct gn_picture *there, const struct gn_picture *here, int x,
                          int y, struct sums *sums, struct gn_picture *sheet) {
    const float *a = gn_picture_at(there, x, y), *b = gn_picture_at(here, x, y);
    double lab_a[3], lab_b[3];
    gn_lab_from_srgb(a, lab_a);
    gn_lab_from_srgb(b, lab_b);
    const double difference = gn_delta_e_2000(lab_a, lab_b);
    const double brighter = brightness_of(b) - brightness_of(a);
    const float grey = (float)fmin(difference / WHITE, 1), sign = (float)(5 * brighter);
    sums->pixels++;
    sums->difference += difference;
    sums->brightness[0] += brightness_of(a);
    sums->brightness[1] += brightness_of(b);
    sums->bins[(size_t)fmin(difference / BIN, BINS - 1)]++;
    put(sheet, 2, here->width_px, x, y, (float[3]){grey, grey, grey});
    put(sheet, 3, here->width_px, x, y,
        (float[3]){fminf(fmaxf(sign, 0), 1), 0, fminf(fmaxf(-sign, 0), 1)});
}

static double percentile(const struct sums *sums, double share) {
    size_t seen = 0;
    for (int i = 0; i < BINS; i++)
        if ((double)(seen += sums->bins[i]) >= share * (double)sums->pixels) return (i + 1) * BIN;
    return BINS * BIN;
}

static void compare(const struct gn_picture *there, const struct gn_picture *here,
                    struct sums *sums, struct gn_picture *sheet) {
    const int w = there->width_px, h = there->height_px;
    gn_picture_init(sheet, PANELS * (w + GAP) - GAP, h, 3);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            put_over_grey(sheet, 0, there, x, y);
            put_over_grey(sheet, 1, here, x, y);
            if (is_inside(there, here, x, y)) measure_pixel(there, here, x, y, sums, sheet);
        }
}

static int quit(const char *text) {
    fprintf(stderr, "tool_modelviewer: %s\n", text);
    return 2;
}

int main(int argc, char **argv) {
    static struct sums sums;
    struct gn_picture there = {0}, here = {0}, sheet = {0};
    struct gn_err err = {0};
    if (argc != 5) return quit("NAME THERE.png HERE.png SHEET.png");
    if (!gn_picture_read(&there, argv[2], &err) || !gn_picture_read(&here, argv[3], &err))
        return quit(err.text);
    if (there.channels != 4 || here.channels != 4) return quit("a picture has no alpha");
    if (there.width_px != here.width_px || there.height_px != here.height_px)
        return quit("the pictures have different sizes");
    compare(&there, &here, &sums, &sheet);
    if (sums.pixels == 0) return quit("no pixel is the model's in both pictures");
    const double count = (double)sums.pixels, mean = sums.difference / count,
                 ratio = sums.brightness[1] / sums.brightness[0];
    printf("%-10s %8zu %8.2f %8.2f %8.1f %8.1f %+7.1f %%\n", argv[1], sums.pixels, mean,
           percentile(&sums, .95), 255 * sums.brightness[0] / count,
           255 * sums.brightness[1] / count, 100 * (ratio - 1));
    if (!gn_picture_write_png(&sheet, argv[4], &err)) return quit(err.text);
    gn_picture_finish(&there);
    gn_picture_finish(&here);
    gn_picture_finish(&sheet);
    return mean > MEAN_MOST || fabs(ratio - 1) > BRIGHTNESS_MOST;
}
