/* gnomon compare: how much two pictures differ, and where. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/commands.h"
#include "core/json.h"
#include "image/measure.h"
#include "image/write.h"

enum { RAISED = 8 }; /* times a difference, in a PNG */

static bool write_difference(const char *path, const struct gn_pixels *a, const struct gn_pixels *b,
                             struct gn_err *err) {
    enum gn_picture_format format;
    const size_t pixels = a->width_px * a->height_px;
    const int w = (int)a->width_px, h = (int)a->height_px;
    if (!gn_picture_format_of(path, &format, err)) return false;
    float *signed_rgb = gn_picture_alloc(pixels, 3 * sizeof *signed_rgb, err);
    uint8_t *rgba = signed_rgb ? gn_picture_alloc(pixels, 4, err) : NULL;
    bool ok = rgba;
    for (size_t i = 0; ok && i < 3 * pixels; i++) {
        signed_rgb[i] = a->rgb[i] - b->rgb[i];
        const float raised = RAISED * fabsf(signed_rgb[i]);
        rgba[i / 3 * 4 + i % 3] = raised < 1.0f ? (uint8_t)lrintf(255.0f * raised) : 255;
    }
    if (ok)
        ok = format == GN_PICTURE_PFM ? gn_picture_write_pfm(path, signed_rgb, 3, w, h, err)
                                      : gn_picture_write_png8(path, rgba, w, h, false, err);
    free(signed_rgb);
    free(rgba);
    return ok;
}

static bool print_measure(const struct gn_settings *o, const struct gn_pixels *a,
                          const struct gn_measure *m, struct gn_err *err) {
    const double psnr_db = gn_measure_psnr_db(m);
    if (!o->run.json) {
        printf("size       %zux%zu\n", a->width_px, a->height_px);
        printf("RMSE       %.6g\nPSNR       %.4g dB\n", m->rmse, psnr_db);
        printf("largest    %.6g at %zu,%zu\n", m->max, m->worst_x, m->worst_y);
        printf("differing  %.6g %% of the pixels, by more than %.6g\n", 100 * m->share,
               o->run.tolerance);
        return true;
    }
    json_t *worst =
        json_pack("[oo]", gn_json_make_count(m->worst_x), gn_json_make_count(m->worst_y));
    return gn_json_print(
        json_pack("{so so so so so so so so}", "width_px", gn_json_make_count(a->width_px),
                  "height_px", gn_json_make_count(a->height_px), "rmse",
                  gn_json_make_number(m->rmse), "psnr_db", gn_json_make_number(psnr_db), "largest",
                  gn_json_make_number(m->max), "largest_at_px", worst, "tolerance",
                  gn_json_make_number(o->run.tolerance), "differing_percent",
                  gn_json_make_number(100 * m->share)),
        9, stdout, err);
}

static bool compare(const struct gn_options *options, const struct gn_pixels *a,
                    const struct gn_pixels *b, struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    struct gn_measure m;
    if (a->width_px != b->width_px || a->height_px != b->height_px) {
        gn_fail(err, "%.200s is %zux%zu, %.200s is %zux%zu", options->words[0], a->width_px,
                a->height_px, options->words[1], b->width_px, b->height_px);
        err->status = GN_EXIT_DIFFER;
        return false;
    }
    gn_measure(a->rgb, b->rgb, a->width_px, a->height_px, 3, o->run.tolerance, &m);
    if (o->run.diff && !write_difference(o->run.diff, a, b, err)) return false;
    if (!print_measure(o, a, &m, err)) return false;
    if (100 * m.share <= o->run.share) return true;
    gn_fail(err, "%.150s and %.150s differ: %.4g %% of the pixels by more than %.4g",
            options->words[0], options->words[1], 100 * m.share, o->run.tolerance);
    err->status = GN_EXIT_DIFFER;
    return false;
}

bool gn_cli_compare(const struct gn_options *options, struct gn_warnings *warnings,
                    struct gn_err *err) {
    (void)warnings;
    struct gn_pixels a = {0}, b = {0};
    const bool ok = gn_pixels_load(&a, options->words[0], err) &&
                    gn_pixels_load(&b, options->words[1], err) && compare(options, &a, &b, err);
    gn_pixels_finish(&a);
    gn_pixels_finish(&b);
    return ok;
}
