/* gnomon compare: how much two pictures differ, and where; how torn shadows look. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/commands.h"
#include "core/arena.h"
#include "core/json.h"
#include "image/measure.h"
#include "image/write.h"
#include "truth/tear.h"

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

/* ---- shadows ---- */

static const char *const part_names[GN_TEAR_PARTS] = {
    [GN_TEAR_ALL] = "all", [GN_TEAR_FLOOR] = "floor", [GN_TEAR_SURFACE] = "surfaces"};

/* A picture of what A and B show; none: path is NULL, and pixels stay zeroed. */
static bool load_beside(const char *path, const struct gn_pixels *a, struct gn_pixels *pixels,
                        struct gn_err *err) {
    if (!path) return true;
    if (!gn_pixels_load(pixels, path, err)) return false;
    if (pixels->width_px == a->width_px && pixels->height_px == a->height_px) return true;
    return gn_fail(err, "%.200s is %zux%zu, the pictures are %zux%zu", path, pixels->width_px,
                   pixels->height_px, a->width_px, a->height_px);
}

/* The first channel; NULL of none. free() it. */
static float *make_grey(const struct gn_pixels *pixels) {
    const size_t count = pixels->width_px * pixels->height_px;
    float *grey = pixels->rgb ? gn_xalloc(count, sizeof *grey) : NULL;
    for (size_t i = 0; grey && i < count; i++) grey[i] = pixels->rgb[3 * i];
    return grey;
}

static bool check_shadow_options(const struct gn_settings *o, struct gn_err *err) {
    const double *l = o->run.shadows.to_light;
    if ((o->run.shadows.normal || o->run.shadows.distance || !isnan(l[0])) &&
        !o->run.shadows.measure)
        return gn_fail_usage(err, "compare: --normal, --distance, --to-light: add --shadows");
    if (!isnan(l[0]) && !o->run.shadows.normal)
        return gn_fail_usage(err, "compare: --to-light: add --normal FILE");
    if (l[0] == 0 && l[1] == 0 && l[2] == 0)
        return gn_fail_usage(err, "compare: --to-light 0,0,0 is no direction");
    return true;
}

static bool measure_shadows(const struct gn_settings *o, const struct gn_pixels *a,
                            const struct gn_pixels *b, struct gn_tear_score score[GN_TEAR_PARTS],
                            struct gn_err *err) {
    struct gn_pixels normal = {0}, distance = {0};
    const bool ok = load_beside(o->run.shadows.normal, a, &normal, err) &&
                    load_beside(o->run.shadows.distance, a, &distance, err);
    const size_t pixels = a->width_px * a->height_px;
    float *truth = make_grey(b), *distance_m = make_grey(&distance), *facing = NULL;
    struct gn_tear tear = {0};
    if (ok && !isnan(o->run.shadows.to_light[0])) {
        facing = gn_xalloc(pixels, sizeof *facing);
        gn_tear_face(normal.rgb, distance_m, o->run.shadows.to_light, pixels, facing);
    }
    if (ok) {
        gn_tear_init(&tear, &(struct gn_tear_view){(int)a->width_px, (int)a->height_px, truth,
                                                   facing, normal.rgb, distance_m});
        gn_tear_compare(&tear, a->rgb, 3, score);
    }
    gn_tear_finish(&tear);
    free(truth);
    free(distance_m);
    free(facing);
    gn_pixels_finish(&normal);
    gn_pixels_finish(&distance);
    return ok;
}

/* Floor and surfaces are told apart by distances alone. */
static int shadow_parts(const struct gn_settings *o) {
    return o->run.shadows.distance ? GN_TEAR_PARTS : GN_TEAR_ALL + 1;
}

static void print_shadows(const struct gn_settings *o, const struct gn_tear_score *score) {
    printf("shadows    %10s %10s %10s %10s\n", "tear %/px", "grain %/px", "RMSE", "pixels");
    for (int p = 0; p < shadow_parts(o); p++)
        if (isnan(score[p].tear))
            printf("%-10s %10s %10s %10s %10ld\n", part_names[p], "-", "-", "-", score[p].pixels);
        else
            printf("%-10s %10.4f %10.4f %10.4f %10ld\n", part_names[p], score[p].tear,
                   score[p].grain, score[p].rmse, score[p].pixels);
}

static json_t *make_shadows(const struct gn_settings *o, const struct gn_tear_score *score) {
    json_t *parts = json_object();
    for (int p = 0; p < shadow_parts(o); p++)
        json_object_set_new(parts, part_names[p],
                            json_pack("{so so so so}", "tear_percent_px",
                                      gn_json_make_number(score[p].tear), "grain_percent_px",
                                      gn_json_make_number(score[p].grain), "rmse",
                                      gn_json_make_number(score[p].rmse), "pixels",
                                      gn_json_make_count((size_t)score[p].pixels)));
    return parts;
}

/* ---- all ---- */

/* score: NULL without --shadows. */
static bool print_measure(const struct gn_settings *o, const struct gn_pixels *a,
                          const struct gn_measure *m, const struct gn_tear_score *score,
                          struct gn_err *err) {
    const double psnr_db = gn_measure_psnr_db(m);
    if (!o->run.json) {
        printf("size       %zux%zu\n", a->width_px, a->height_px);
        printf("RMSE       %.6g\nPSNR       %.4g dB\n", m->rmse, psnr_db);
        printf("largest    %.6g at %zu,%zu\n", m->max, m->worst_x, m->worst_y);
        printf("differing  %.6g %% of the pixels, by more than %.6g\n", 100 * m->share,
               o->run.tolerance);
        if (score) print_shadows(o, score);
        return true;
    }
    json_t *worst =
        json_pack("[oo]", gn_json_make_count(m->worst_x), gn_json_make_count(m->worst_y));
    json_t *object = json_pack(
        "{so so so so so so so so}", "width_px", gn_json_make_count(a->width_px), "height_px",
        gn_json_make_count(a->height_px), "rmse", gn_json_make_number(m->rmse), "psnr_db",
        gn_json_make_number(psnr_db), "largest", gn_json_make_number(m->max), "largest_at_px",
        worst, "tolerance", gn_json_make_number(o->run.tolerance), "differing_percent",
        gn_json_make_number(100 * m->share));
    if (score) json_object_set_new(object, "shadows", make_shadows(o, score));
    return gn_json_print(object, 9, stdout, err);
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
    struct gn_tear_score score[GN_TEAR_PARTS];
    if (o->run.shadows.measure && !measure_shadows(o, a, b, score, err)) return false;
    gn_measure(a->rgb, b->rgb, a->width_px, a->height_px, 3, o->run.tolerance, &m);
    if (o->run.diff && !write_difference(o->run.diff, a, b, err)) return false;
    if (!print_measure(o, a, &m, o->run.shadows.measure ? score : NULL, err)) return false;
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
    const bool ok = check_shadow_options(options->settings, err) &&
                    gn_pixels_load(&a, options->words[0], err) &&
                    gn_pixels_load(&b, options->words[1], err) && compare(options, &a, &b, err);
    gn_pixels_finish(&a);
    gn_pixels_finish(&b);
    return ok;
}
