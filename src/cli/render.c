/* gnomon render: a scene to a picture, or to a numbered run of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "caption/captions.h"
#include "cli/commands.h"
#include "core/clock.h"
#include "core/stop.h"
#include "image/write.h"
#include "shadow/grey.h"
#include "stage/stage.h"

struct render {
    struct gn_stage stage;
    struct gn_captions *captions; /* NULL: none */
    enum gn_picture_format format;
    bool map; /* --aov map */
    uint8_t *rgba;
    float *floats; /* RGBA from the GPU, packed in place to what the file wants */
};

/* "frame-%04d.png": exactly one %d, with at most a width. */
static bool is_pattern(const char *path) {
    const char *percent = strchr(path, '%');
    if (!percent) return false;
    const char *p = percent + 1 + strspn(percent + 1, "0123456789");
    return *p == 'd' && p - percent <= 4 && !strchr(p, '%');
}

static bool check_options(const struct gn_settings *o, struct render *r, struct gn_err *err) {
    if (!o->run.out) return gn_fail_usage(err, "render: no output file: add -o FILE.png");
    if (!gn_picture_format_of(o->run.out, &r->format, err)) return false;
    if (o->run.frames > 1 && !is_pattern(o->run.out))
        return gn_fail_usage(
            err, "-o %s: with --frames %d the name needs a number, as in frame-%%04d.png",
            o->run.out, o->run.frames);
    if (strchr(o->run.out, '%') && !is_pattern(o->run.out))
        return gn_fail_usage(
            err, "-o %s: only one %%d, as in frame-%%04d.png, can stand in the name", o->run.out);
    if (o->render.aov == GN_AOV_DISTANCE && r->format != GN_PICTURE_PFM)
        return gn_fail_usage(err, "-o %s: distances are metres and need a .pfm file", o->run.out);
    r->map = o->render.aov == GN_AOV_COUNT;
    return true;
}

static void keep_channels(float *values, size_t count, int channels) {
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < channels; k++)
            values[i * (size_t)channels + (size_t)k] = values[4 * i + (size_t)k];
}

static bool write_color(struct render *r, const struct gn_plan *plan, const char *path,
                        struct gn_err *err) {
    int w = (int)plan->width_px, h = (int)plan->height_px;
    if (r->format == GN_PICTURE_PNG)
        return gn_gl_read_rgba8(r->stage.gl, r->rgba, err) &&
               gn_picture_write_png8(path, r->rgba, w, h,
                                     r->stage.settings->render.output == GN_PICTURE_SRGB, err);
    if (plan->output == GN_OUTPUT_FLOAT) {
        if (!gn_gl_read_f32(r->stage.gl, r->floats, err)) return false;
    } else {
        if (!gn_gl_read_rgba8(r->stage.gl, r->rgba, err)) return false;
        for (size_t i = 0; i < 4 * (size_t)w * (size_t)h; i++)
            r->floats[i] = (float)r->rgba[i] / 255.0f;
    }
    keep_channels(r->floats, (size_t)w * (size_t)h, 3);
    return gn_picture_write_pfm(path, r->floats, 3, w, h, err);
}

static bool write_normals(struct render *r, const struct gn_plan *plan, const char *path,
                          struct gn_err *err) {
    int w = (int)plan->width_px, h = (int)plan->height_px;
    if (r->format == GN_PICTURE_PFM) {
        keep_channels(r->floats, (size_t)w * (size_t)h, 3);
        return gn_picture_write_pfm(path, r->floats, 3, w, h, err);
    }
    for (size_t i = 0; i < 4 * (size_t)w * (size_t)h; i++)
        r->rgba[i] = (uint8_t)lrintf(255.0f * fminf(fmaxf(0.5f * r->floats[i] + 0.5f, 0.0f), 1.0f));
    return gn_picture_write_png8(path, r->rgba, w, h, false, err);
}

static bool write_grey(const struct render *r, const char *path, const float *grey, int w, int h,
                       struct gn_err *err) {
    return r->format == GN_PICTURE_PFM ? gn_picture_write_pfm(path, grey, 1, w, h, err)
                                       : gn_picture_write_png16_grey(path, grey, w, h, err);
}

static bool write_map(struct render *r, const struct gn_plan *plan, const char *path,
                      struct gn_err *err) {
    uint32_t slot = 0;
    while (slot < plan->shadow_count &&
           (int)plan->shadows[slot].light != r->stage.settings->render.light)
        slot++;
    if (slot == plan->shadow_count)
        return gn_fail(err, "light %d has no map: it casts no shadow, or %d stronger lights do",
                       r->stage.settings->render.light, GN_ALL_SHADOWS_MAX);
    const struct gn_shadow_view *view = &plan->shadows[slot];
    if (view->encoding == GN_ENCODING_STENCIL)
        return gn_fail(err, "light %d has no map: its shadow is in the stencil; use --planar mask",
                       r->stage.settings->render.light);
    const struct gn_shadow_grey grey = gn_shadow_grey_of(view);
    size_t width = view->map.width_px, height = view->map.height_px;
    float *codes = gn_picture_alloc(width * height, sizeof *codes, err),
          *flipped = codes ? gn_picture_alloc(width * height, sizeof *flipped, err) : NULL;
    bool ok = flipped && gn_gl_read_map(r->stage.gl, slot, codes, err);
    for (size_t y = 0; ok && y < height; y++)
        for (size_t x = 0; x < width; x++)
            flipped[(height - 1 - y) * width + x] = gn_shadow_grey_at(&grey, codes[y * width + x]);
    ok = ok && write_grey(r, path, flipped, (int)width, (int)height, err);
    free(codes);
    free(flipped);
    return ok;
}

static bool write_picture(struct render *r, const struct gn_plan *plan, const char *path,
                          struct gn_err *err) {
    if (r->map) return write_map(r, plan, path, err);
    if (plan->aov == GN_AOV_COLOR) return write_color(r, plan, path, err);
    if (!gn_gl_read_f32(r->stage.gl, r->floats, err)) return false;
    if (plan->aov == GN_AOV_NORMAL) return write_normals(r, plan, path, err);
    keep_channels(r->floats, (size_t)plan->width_px * plan->height_px, 1);
    return write_grey(r, path, r->floats, (int)plan->width_px, (int)plan->height_px, err);
}

/* On a terminal, once the work has taken a second. */
static void show_progress(int64_t begun_ns, int done, int all) {
    if (all > 1 && gn_clock_monotonic_ns() - begun_ns > GN_NS_PER_S && isatty(STDERR_FILENO))
        fprintf(stderr, "\rframe %d of %d%s", done, all, done == all ? "\n" : "");
}

static bool draw_frames(struct render *r, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *o = r->stage.settings;
    int64_t begun_ns = gn_clock_monotonic_ns();
    int frames = o->run.frames > 0 ? o->run.frames : 1;
    for (int i = 0; i < frames && !gn_stop_asked(); i++) {
        char path[4096];
        int length = is_pattern(o->run.out) ? snprintf(path, sizeof path, o->run.out, i)
                                            : snprintf(path, sizeof path, "%s", o->run.out);
        if (length < 0 || (size_t)length >= sizeof path)
            return gn_fail_usage(err, "-o: that name is too long");
        int64_t time_ns =
            o->scene.time_ns + (int64_t)llround((double)i / o->run.fps * (double)GN_NS_PER_S);
        const struct gn_plan *plan = gn_stage_draw(&r->stage, time_ns, warnings, err);
        if (!plan || !write_picture(r, plan, path, err)) return false;
        if (o->run.plan && i == 0) gn_plan_print(plan, stdout);
        show_progress(begun_ns, i + 1, frames);
    }
    return true;
}

static bool make_room(struct render *r, struct gn_err *err) {
    size_t pixels = (size_t)r->stage.settings->render.size.width_px *
                    (size_t)r->stage.settings->render.size.height_px;
    bool wants_floats =
        r->stage.frame_opts.debug.aov != GN_AOV_COLOR || r->format == GN_PICTURE_PFM;
    r->rgba = gn_picture_alloc(pixels, 4, err);
    if (!r->rgba) return false;
    if (wants_floats) r->floats = gn_picture_alloc(pixels, 4 * sizeof(float), err);
    return !wants_floats || r->floats;
}

/* It stays, so that any time will do. */
static void write_caption(struct render *r, struct gn_warnings *warnings) {
    const struct gn_settings *o = r->stage.settings;
    const struct gn_captions_opts opts = {.font = o->render.font, .warnings = warnings};
    if (!o->run.caption) return;
    r->captions = gn_captions_create(&opts);
    gn_captions_set(r->captions, GN_CAPTION_ERROR, o->run.caption, 0);
    r->stage.frame_opts.captions = gn_captions_run(r->captions, (uint32_t)o->render.size.width_px,
                                                   (uint32_t)o->render.size.height_px, 0);
}

bool gn_cli_render(const struct gn_options *options, struct gn_warnings *warnings,
                   struct gn_err *err) {
    struct render r = {0};
    gn_stop_block(NULL);
    bool ok = check_options(options->settings, &r, err) &&
              gn_stage_load(&r.stage, options->settings, warnings, err);
    r.stage.frame_opts.output_float =
        options->settings->render.aov == GN_AOV_COLOR && r.format == GN_PICTURE_PFM;
    ok = ok && gn_stage_open(&r.stage, warnings, err);
    if (ok) write_caption(&r, warnings);
    ok = ok && make_room(&r, err) && draw_frames(&r, warnings, err);
    free(r.rgba);
    free(r.floats);
    gn_stage_close(&r.stage);
    gn_captions_destroy(r.captions);
    return ok || gn_stop_asked(); /* what that broke off is no failure */
}
