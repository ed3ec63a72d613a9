/* gnomon render: a scene to a picture, or to a numbered sequence of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "caption/captions.h"
#include "cli/commands.h"
#include "core/arena.h"
#include "core/clock.h"
#include "core/terminal.h"
#include "image/write.h"
#include "shadow/grey.h"
#include "stage/gather.h"
#include "stage/hours_picture.h"
#include "stage/sun.h"

struct render {
    struct gn_stage stage;
    struct gn_captions *captions; /* NULL: none */
    enum gn_picture_format format;
    bool map;                   /* --aov map */
    struct gn_sun_hours *hours; /* --aov sun-hours; NULL: another */
    uint8_t *rgba;
    float *floats;    /* RGBA from the GPU, packed in place to what the file wants */
    int64_t begun_ns; /* the rays of a frame; 0: not yet */
    int percent;      /* of them, as printed last */
};

/* "frame-%04d.png": exactly one %d, with at most a width. */
static bool is_pattern(const char *path) {
    const char *percent = strchr(path, '%');
    if (!percent) return false;
    const char *p = percent + 1 + strspn(percent + 1, "0123456789");
    return *p == 'd' && p - percent <= 4 && !strchr(p, '%');
}

static void keep_channels(float *values, size_t count, int channels) {
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < channels; k++)
            values[i * (size_t)channels + (size_t)k] = values[4 * i + (size_t)k];
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
    if (view->encoding == GN_ENCODING_SCREEN)
        return gn_fail(err, "light %d has no map: truth casts rays",
                       r->stage.settings->render.light);
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
    const int w = (int)plan->width_px, h = (int)plan->height_px;
    const size_t pixels = (size_t)w * (size_t)h;
    if (r->map) return write_map(r, plan, path, err);
    /* as the rays have it: at outlines the rasteriser's choice of surface is not in it */
    if ((plan->aov == GN_AOV_VISIBILITY || plan->aov == GN_AOV_OCCLUSION) &&
        r->stage.truth.visibility)
        return write_grey(r, path, r->stage.truth.visibility, w, h, err);
    if (plan->aov == GN_AOV_COLOR && r->format == GN_PICTURE_PNG)
        return gn_gl_read_rgba8(r->stage.gl, r->rgba, err) &&
               (plan->transparent ? gn_picture_write_png8_alpha : gn_picture_write_png8)(
                   path, r->rgba, w, h, r->stage.settings->render.output == GN_PICTURE_SRGB, err);
    if (plan->aov == GN_AOV_COLOR && plan->output != GN_OUTPUT_FLOAT) {
        if (!gn_gl_read_rgba8(r->stage.gl, r->rgba, err)) return false;
        for (size_t i = 0; i < 4 * pixels; i++) r->floats[i] = (float)r->rgba[i] / 255.0f;
    } else if (!gn_gl_read_f32(r->stage.gl, r->floats, err)) {
        return false;
    }
    if (plan->aov != GN_AOV_NORMAL && plan->aov != GN_AOV_COLOR) {
        keep_channels(r->floats, pixels, 1);
        return write_grey(r, path, r->floats, w, h, err);
    }
    if (r->format == GN_PICTURE_PFM) {
        keep_channels(r->floats, pixels, 3);
        return gn_picture_write_pfm(path, r->floats, 3, w, h, err);
    }
    for (size_t i = 0; i < 4 * pixels; i++)
        r->rgba[i] = (uint8_t)lrintf(255.0f * fminf(fmaxf(0.5f * r->floats[i] + 0.5f, 0.0f), 1.0f));
    return gn_picture_write_png8(path, r->rgba, w, h, false, err);
}

static bool write_hours(struct render *r, int64_t time_ns, const char *path,
                        struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *o = r->stage.settings;
    const int w = o->render.size.width_px, h = o->render.size.height_px;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    struct gn_sun_hours_picture picture = {0};
    bool ok = gn_sun_hours_draw(r->hours, &r->stage, time_ns, &picture, warnings, err);
    const double took_s = (double)(gn_clock_monotonic_ns() - begun_ns) * 1e-9;
    if (ok && r->format == GN_PICTURE_PFM) {
        ok = gn_picture_write_pfm(path, picture.hours, 1, w, h, err);
    } else if (ok) {
        gn_hours_picture_draw(r->hours, &picture, o, r->rgba, w, h, warnings);
        ok = gn_picture_write_png8(path, r->rgba, w, h, true, err);
    }
    if (ok)
        printf("hours of sun: %u positions over the horizon, %.2f h, in %.1f s\n", r->hours->count,
               r->hours->count * r->hours->step_h, took_s);
    gn_sun_hours_finish(&picture);
    return ok;
}

/* On a terminal, once the work has taken a second. */
static void print_progress(void *user, double share) {
    struct render *r = user;
    const int percent = (int)(100.0 * share);
    const int64_t now_ns = gn_clock_monotonic_ns();
    if (r->begun_ns == 0) r->begun_ns = now_ns;
    if (percent <= r->percent || now_ns - r->begun_ns < GN_NS_PER_S) return;
    r->percent = percent;
    fprintf(stderr, "\rrays %d %%%s", percent, percent >= 100 ? "\n" : "");
}

/* Likewise. */
static void print_frames(int done, int all, int64_t begun_ns) {
    const double spent_s = (double)(gn_clock_monotonic_ns() - begun_ns) / (double)GN_NS_PER_S;
    char bar[100];
    if (spent_s < 1 || !isatty(STDERR_FILENO)) return;
    gn_terminal_write_bar(bar, sizeof bar, done, all, spent_s);
    if (done < all)
        fprintf(stderr, "\r\33[K%s", bar);
    else
        fprintf(stderr, "\r\33[Kwrote %d files, %.1f s\n", all, spent_s);
}

/* Of one frame; laid out anew only where the text is another one. */
static void write_caption(struct render *r) {
    const struct gn_settings *o = r->stage.settings;
    struct gn_frame_opts *f = &r->stage.shown.opts;
    const char *caption = o->run.caption ? o->run.caption : "";
    char moment[96] = "", text[2048];
    if (!r->captions) return;
    if (o->sun.caption) gn_stage_sun_print(o, f->view.sun_utc_s, moment, sizeof moment);
    snprintf(text, sizeof text, "%s%s%s", caption, *caption && *moment ? "\n" : "", moment);
    gn_captions_set(r->captions, GN_CAPTION_TEXT, text, 0);
    f->cover.captions = gn_captions_run(r->captions, (uint32_t)o->render.size.width_px,
                                        (uint32_t)o->render.size.height_px, 0);
}

static bool draw_frames(struct render *r, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *o = r->stage.settings;
    const size_t pixels = (size_t)o->render.size.width_px * (size_t)o->render.size.height_px;
    const int64_t begun_ns = gn_clock_monotonic_ns();
    const int frames = o->run.frames > 0 ? o->run.frames : 1;
    const struct gn_frame_opts look = r->stage.shown.opts;
    const bool gathers = o->render.gather == GN_GATHER_ALWAYS && r->format == GN_PICTURE_PNG &&
                         look.debug.aov == GN_AOV_COLOR;
    r->rgba = gn_picture_alloc(pixels, 4, err);
    if (!r->rgba) return false;
    if (r->stage.shown.opts.debug.aov != GN_AOV_COLOR || r->format == GN_PICTURE_PFM) {
        r->floats = gn_picture_alloc(pixels, 4 * sizeof(float), err);
        if (!r->floats) return false;
    }
    for (int i = 0; i < frames; i++) {
        char path[4096];
        int length = is_pattern(o->run.out) ? snprintf(path, sizeof path, o->run.out, i)
                                            : snprintf(path, sizeof path, "%s", o->run.out);
        if (length < 0 || (size_t)length >= sizeof path)
            return gn_fail_usage(err, "-o: that name is too long");
        const double after_s = (double)i / o->run.fps;
        int64_t time_ns = o->scene.time_ns + (int64_t)llround(after_s * (double)GN_NS_PER_S);
        r->begun_ns = r->percent = 0;
        r->stage.shown.opts = look;
        r->stage.shown.opts.view.sun_utc_s += o->sun.speed * after_s;
        if (r->hours) {
            if (!write_hours(r, time_ns, path, warnings, err)) return false;
            continue;
        }
        write_caption(r);
        if (gathers) gn_stage_gather(&r->stage, &r->stage.shown, time_ns, warnings);
        const struct gn_plan *plan =
            gn_view_draw(&r->stage.shown, &r->stage, time_ns, warnings, err);
        if (!plan || !write_picture(r, plan, path, err)) return false;
        if (o->run.plan && i == 0) gn_plan_print(plan, stdout);
        if (frames > 1) print_frames(i + 1, frames, begun_ns);
    }
    return true;
}

static bool make_hours(struct render *r, struct gn_err *err) {
    const struct gn_settings *o = r->stage.settings;
    if (o->render.aov != GN_AOV_SUN_HOURS)
        return (!o->run.from && !o->run.to) ||
               gn_fail_usage(err, "--from and --to are valid only with --aov sun-hours");
    r->hours = gn_xalloc(1, sizeof *r->hours);
    return gn_sun_hours_build(r->hours, o, r->stage.scene, err);
}

bool gn_cli_render(const struct gn_options *options, struct gn_warnings *warnings,
                   struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    struct render r = {.map = o->render.aov == GN_AOV_MAP};
    if (!o->run.out) return gn_fail_usage(err, "render: no output file: add -o FILE.png");
    if (!gn_picture_format_of(o->run.out, &r.format, err)) return false;
    if (o->run.frames > 1 && !is_pattern(o->run.out))
        return gn_fail_usage(
            err, "-o %s: with --frames %d the name needs a number, as in frame-%%04d.png",
            o->run.out, o->run.frames);
    if (strchr(o->run.out, '%') && !is_pattern(o->run.out))
        return gn_fail_usage(
            err, "-o %s: only one %%d, as in frame-%%04d.png, can stand in the name", o->run.out);
    if (o->render.aov == GN_AOV_DISTANCE && r.format != GN_PICTURE_PFM)
        return gn_fail_usage(err, "-o %s: distances are metres and need a .pfm file", o->run.out);

    bool ok = gn_stage_load(&r.stage, o, warnings, err);
    r.stage.shown.opts.output.keeps_alpha = r.format == GN_PICTURE_PNG;
    r.stage.shown.opts.output.floats = o->render.aov == GN_AOV_COLOR && r.format == GN_PICTURE_PFM;
    if (isatty(STDERR_FILENO)) {
        r.stage.truth.progress = print_progress;
        r.stage.truth.user = &r;
    }
    ok = ok && make_hours(&r, err) && gn_stage_open(&r.stage, warnings, err);
    if (ok)
        r.stage.shown.opts.output.msaa = gn_stage_msaa(&r.stage, (uint32_t)o->render.size.width_px,
                                                       (uint32_t)o->render.size.height_px, true);
    if (ok && (o->run.caption || o->sun.caption)) {
        const struct gn_captions_opts opts = {.font = o->render.font, .warnings = warnings};
        r.captions = gn_captions_create(&opts);
    }
    ok = ok && draw_frames(&r, warnings, err);
    free(r.rgba);
    free(r.floats);
    free(r.hours);
    gn_stage_close(&r.stage);
    gn_captions_destroy(r.captions);
    return ok;
}
