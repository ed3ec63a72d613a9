/* The display of the kiosk, and its GL context. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/stop.h"
#include "kiosk/private.h"
#include "options/value.h"
#include "stage/time.h"
#include "stage/wake.h"

#define LEAST_PERIOD_MS (1000.0 / 60) /* faster displays are not filled at the picture's cost */

bool gn_show_open_display(struct gn_show_screen *s, struct gn_err *err) {
    const struct gn_settings *o = s->stage.settings;
    struct gn_wake wake = {0};
    uint32_t without = 0;
    const bool srgb =
        !gn_caps_parse(o->render.without, &without, NULL) || !(without & 1u << GN_CAP_SRGB);
    s->context.screen_opts = (struct gn_screen_opts){
        .loop = s->show->loop,
        .width_px = (uint32_t)o->render.size.width_px,
        .height_px = (uint32_t)o->render.size.height_px,
        .connector = o->display.connector,
        .card = o->display.card,
        .render_node = o->display.render_node,
        .modeline = o->display.modeline,
        .mode_width = (uint32_t)o->display.mode.width_px,
        .mode_height = (uint32_t)o->display.mode.height_px,
        .mode_hz = o->display.mode.hz,
        .cap_width = (uint32_t)o->display.max_mode.width_px,
        .cap_height = (uint32_t)o->display.max_mode.height_px,
        .cap_hz = o->display.max_mode.hz,
        .rotate_deg = (unsigned)o->display.rotate_deg,
        .max_fps = (unsigned)o->display.max_fps,
        .unencoded = !srgb,
        .locks_keys = o->display.console_locked,
        .legacy = o->display.legacy,
        .range = (enum gn_screen_range)o->display.range,
    };
    gn_parts_add_screen(&s->show->parts, &s->context.screen_opts);
    gn_wake_begin(&wake, o);
    const bool ok = gn_display_open_screen(
        &s->stage.display,
        s->show->config.place ? s->show->config.place->backend : o->display.backend,
        &s->context.screen_opts, gn_loop_now_ns(s->show->loop), s->show->warnings, err);
    gn_wake_end(&wake);
    if (wake.no_cache.text[0]) gn_warn(s->show->warnings, "%s", wake.no_cache.text);
    if (ok && s->show->config.place) s->show->config.place->opened = true;
    return ok;
}

double gn_show_scale(const struct gn_show_screen *s) {
    const double scale = s->stage.settings->display.scale;
    return !isnan(scale) ? scale : s->scaling.automatic > 0 ? s->scaling.automatic : 1.0;
}

/* Once for each scene and size of the screen, in the mode that is shown then: a picture that is
 * sharper in some moments than in others is worse than one that is late. */
static void choose_scale(struct gn_show_screen *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    struct gn_show_scaling *scaling = &s->scaling;
    const bool known = scaling->automatic > 0 && scaling->width_px == screen->width_px &&
                       scaling->height_px == screen->height_px;
    if (known || !isnan(s->stage.settings->display.scale) || s->show->reload.first) return;
    *scaling = (struct gn_show_scaling){1, screen->width_px, screen->height_px};
    const struct gn_cost_gpu *gpu = gn_cost_gpu_of(gn_gl_caps(s->stage.gl)->renderer);
    const double period_ms = fmax((double)screen->period_ns * 1e-6, LEAST_PERIOD_MS);
    if (gpu) scaling->automatic = gn_stage_scale(&s->stage, gpu, period_ms);
}

void gn_show_fit_to_screen(struct gn_show_screen *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    const bool direct = s->stage.display.ops->screen && !screen->copy_to;
    const struct gn_gl_window window = {screen->width_px, screen->height_px, screen->srgb};
    struct gn_frame_output_opts *output = &s->stage.shown.opts.output;
    const struct gn_frame_output_opts before = *output;
    *output = (struct gn_frame_output_opts){
        .width_px = screen->width_px,
        .height_px = screen->height_px,
        .turn_deg = screen->rotate_deg,
        .msaa = gn_stage_msaa(&s->stage, screen->width_px, screen->height_px, false),
        .unencoded = direct && !screen->srgb,
    };
    if (output->unencoded != before.unencoded || output->msaa != before.msaa)
        gn_show_unready(s); /* other programs */
    choose_scale(s);
    output->scale = (float)gn_show_scale(s);
    gn_gl_set_window(s->stage.gl, direct ? &window : NULL);
}

void gn_show_scale_frame(struct gn_show_screen *s, bool bare) {
    const struct gn_screen *screen = &s->stage.display.screen;
    struct gn_frame_output_opts *output = &s->stage.shown.opts.output;
    const struct gn_gl_window part = {gn_frame_scaled_px(output->width_px, output->scale),
                                      gn_frame_scaled_px(output->height_px, output->scale),
                                      screen->srgb};
    const bool scales = output->scale < 1.0f;
    output->scaled_later =
        scales && bare && gn_display_scale(&s->stage.display, part.width_px, part.height_px);
    s->context.scaled_by = output->scaled_later ? "plane" : scales ? "blit" : "none";
    if (output->scaled_later) gn_gl_set_window(s->stage.gl, &part);
}

void gn_show_stop_gl(struct gn_show_screen *s) {
    gn_show_forget_work(s);
    gn_stage_stop_gl(&s->stage);
}

/* If GL fails the kiosk shows that as a text and keeps running; the status has the reason. */
static bool show_failure(struct gn_show_screen *s, struct gn_err *err) {
    if (gn_stop_asked()) return false;
    gn_show_stop_gl(s);
    if (!gn_display_show_message(&s->stage.display, gn_problem_words[GN_PROBLEM_GRAPHICS].title,
                                 gn_loop_now_ns(s->show->loop)))
        return false;
    s->context.message = true;
    gn_problem_report(&s->show->problems, GN_PROBLEM_GRAPHICS, err->text);
    *err = (struct gn_err){0};
    return true;
}

bool gn_show_is_stale(const struct gn_show_screen *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    return screen->lost || (screen->has_context && screen->generation != s->context.generation);
}

static void tell_range(struct gn_show_screen *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    const bool lacks = screen->lacks_range;
    char text[160];
    if (s->context.lacks_range == lacks) return;
    s->context.lacks_range = lacks;
    if (!lacks) {
        gn_problem_cure(&s->show->problems, GN_PROBLEM_RANGE);
        return;
    }
    snprintf(text, sizeof text,
             "[display] range: %.*s has no property \"Broadcast RGB\", its levels stay as the "
             "driver has them; set them in the monitor's menu",
             (int)strcspn(screen->what, " "), screen->what);
    gn_problem_report(&s->show->problems, GN_PROBLEM_RANGE, text);
}

bool gn_show_keep_context(struct gn_show_screen *s, struct gn_err *err) {
    const struct gn_screen *screen = &s->stage.display.screen;
    tell_range(s);
    if (screen->lost) {
        struct gn_wake wake = {0};
        gn_show_stop_gl(s);
        s->context.generation = 0;
        gn_wake_begin(&wake, s->stage.settings);
        const bool ok = gn_display_renew(&s->stage.display, gn_loop_now_ns(s->show->loop), err);
        gn_wake_end(&wake);
        if (!ok) return false;
    }
    if (screen->lost || !screen->has_context || screen->generation == s->context.generation)
        return true;
    gn_show_stop_gl(s);
    s->context.generation = screen->generation;
    s->changed = true;
    if (!gn_stage_start_gl(&s->stage, s->show->warnings, err)) return show_failure(s, err);
    if (s->context.message)
        gn_display_show_message(&s->stage.display, NULL, gn_loop_now_ns(s->show->loop));
    gn_problem_cure(&s->show->problems, GN_PROBLEM_GRAPHICS);
    s->context.message = false;
    if (screen->may_draw) return true;

    /* without a monitor the programs are made by drawing a small frame */
    s->stage.shown.opts.output.width_px = 64;
    s->stage.shown.opts.output.height_px = 36;
    s->stage.shown.opts.cover.captions = NULL; /* those are laid out for another size */
    gn_gl_set_window(s->stage.gl, NULL);
    if (!gn_view_draw(&s->stage.shown, &s->stage, s->stage.settings->scene.time_ns,
                      s->show->warnings, err))
        return show_failure(s, err);
    gn_gl_finish_frame(s->stage.gl); /* many drivers compile at the first draw */
    return true;
}

bool gn_show_same_screen(const struct gn_settings *a, const struct gn_settings *b) {
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        if (row->reopens &&
            !gn_value_same(row, gn_settings_value(a, row), gn_settings_value(b, row)))
            return false;
    }
    return true;
}
