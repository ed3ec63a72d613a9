/* tool_cycles NAME OUT STOPS: how far pictures of a model are from a path tracer's:
 * OUT/NAME-here.png by gnomon, NAME-there.png by another program, both on transparent ground and
 * without a tone, and the traces of trace.py, brightened by 2^STOPS. Prints a row: the model's
 * pixels, the traces' noise, both errors and their ratio: root mean square of encoded values over
 * grey, of 255, less the noise. Writes OUT/NAME.png: the trace, here, there; here less the trace,
 * there less it (red: brighter, blue: darker, times 4). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/srgb.h"
#include "image/picture.h"

enum { EDGE = 2, GAP = 4, PANELS = 5 };
static const float GREY = .35f; /* encoded: behind what one sees through */

struct model {
    struct gn_picture traces[2], alpha, here, there;
    float brighter;
    int width_px, height_px;
};

static int quit(const char *text) {
    fprintf(stderr, "tool_cycles: %s\n", text);
    return 2;
}

static bool read_one(const char *out, const char *name, const char *end, struct gn_picture *to,
                     struct gn_err *err) {
    char path[1200];
    snprintf(path, sizeof path, "%.500s/%.200s-%s", out, name, end);
    return gn_picture_read(to, path, err);
}

/* A pixel of the mean of the traces, or of one; encoded, over grey. */
static void shown_trace(const struct model *m, int first, int count, int x, int y, float rgb[3]) {
    const float a = fminf(fmaxf(*gn_picture_at(&m->alpha, x, y), 0), 1);
    for (int k = 0; k < 3; k++) {
        float sum = 0;
        for (int i = first; i < first + count; i++) sum += gn_picture_at(&m->traces[i], x, y)[k];
        const float straight = m->brighter * sum / (float)count / fmaxf(a, 1e-6f);
        rgb[k] = a * gn_srgb_encode(fminf(fmaxf(straight, 0), 1)) + (1 - a) * GREY;
    }
}

static void shown_picture(const struct gn_picture *p, int x, int y, float rgb[3]) {
    const float *c = gn_picture_at(p, x, y);
    for (int k = 0; k < 3; k++) rgb[k] = c[3] * c[k] + (1 - c[3]) * GREY;
}

/* It and all within two pixels are the model's in all three. */
static bool counts(const struct model *m, int x, int y) {
    for (int v = y - EDGE; v <= y + EDGE; v++)
        for (int u = x - EDGE; u <= x + EDGE; u++) {
            if (u < 0 || v < 0 || u >= m->width_px || v >= m->height_px) return false;
            if (*gn_picture_at(&m->alpha, u, v) <= .05f ||
                gn_picture_at(&m->here, u, v)[3] <= .02f ||
                gn_picture_at(&m->there, u, v)[3] <= .02f)
                return false;
        }
    return true;
}

static double square(const float a[3], const float b[3]) {
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += ((double)a[k] - (double)b[k]) * ((double)a[k] - (double)b[k]);
    return sum / 3;
}

static void put(struct gn_picture *sheet, int panel, int width_px, int x, int y,
                const float rgb[3]) {
    memcpy(gn_picture_at(sheet, panel * (width_px + GAP) + x, y), rgb, 3 * sizeof *rgb);
}

static void put_sign(struct gn_picture *sheet, int panel, int width_px, int x, int y,
                     const float a[3], const float truth[3]) {
    float more = 0;
    for (int k = 0; k < 3; k++) more += 4.0f / 3 * (a[k] - truth[k]);
    put(sheet, panel, width_px, x, y,
        (float[3]){fminf(fmaxf(more, 0), 1), 0, fminf(fmaxf(-more, 0), 1)});
}

int main(int argc, char **argv) {
    struct model m = {0};
    struct gn_picture sheet;
    struct gn_err err = {0};
    char path[1200];
    double sums[3] = {0}; /* noise, here, there */
    int pixels = 0;
    if (argc != 4) return quit("NAME OUT STOPS");
    const char *name = argv[1], *out = argv[2];
    m.brighter = exp2f(strtof(argv[3], NULL));
    if (!read_one(out, name, "trace-0.pfm", &m.traces[0], &err) ||
        !read_one(out, name, "trace-1.pfm", &m.traces[1], &err) ||
        !read_one(out, name, "trace-alpha.pfm", &m.alpha, &err) ||
        !read_one(out, name, "here.png", &m.here, &err) ||
        !read_one(out, name, "there.png", &m.there, &err))
        return quit(err.text);
    m.width_px = m.alpha.width_px;
    m.height_px = m.alpha.height_px;
    const struct gn_picture *const all[] = {&m.traces[0], &m.traces[1], &m.here, &m.there};
    for (int i = 0; i < 4; i++)
        if (all[i]->width_px != m.width_px || all[i]->height_px != m.height_px ||
            all[i]->channels < (i < 2 ? 3 : 4))
            return quit("the pictures have different sizes, or no alpha");
    gn_picture_init(&sheet, PANELS * (m.width_px + GAP) - GAP, m.height_px, 3);
    for (int y = 0; y < m.height_px; y++)
        for (int x = 0; x < m.width_px; x++) {
            float truth[3], halves[2][3], here[3], there[3];
            shown_trace(&m, 0, 2, x, y, truth);
            for (int i = 0; i < 2; i++) shown_trace(&m, i, 1, x, y, halves[i]);
            shown_picture(&m.here, x, y, here);
            shown_picture(&m.there, x, y, there);
            put(&sheet, 0, m.width_px, x, y, truth);
            put(&sheet, 1, m.width_px, x, y, here);
            put(&sheet, 2, m.width_px, x, y, there);
            if (!counts(&m, x, y)) continue;
            put_sign(&sheet, 3, m.width_px, x, y, here, truth);
            put_sign(&sheet, 4, m.width_px, x, y, there, truth);
            sums[0] += square(halves[0], halves[1]) / 4; /* of their mean */
            sums[1] += square(here, truth);
            sums[2] += square(there, truth);
            pixels++;
        }
    if (pixels == 0) return quit("no pixel is the model's in all pictures");
    double errors[3];
    for (int i = 0; i < 3; i++)
        errors[i] = 255 * sqrt(fmax(sums[i] - (i > 0 ? sums[0] : 0), 0) / pixels);
    printf("%-10s %8d %8.2f %8.2f %8.2f %8.3f\n", name, pixels, errors[0], errors[1], errors[2],
           errors[1] / fmax(errors[2], 1e-6));
    snprintf(path, sizeof path, "%.500s/%.200s.png", out, name);
    return gn_picture_write_png(&sheet, path, &err) ? 0 : quit(err.text);
}
