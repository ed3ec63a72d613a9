/* From the state of the kiosk to a frame on the screen. Nothing is drawn while nothing changes. */
#include <stdio.h>

#include "core/arena.h"
#include "core/clock.h"
#include "kiosk/private.h"
#include "stage/detail.h"
#include "stage/occlusion.h"

#define ASK_NS  (10 * GN_NS_PER_S) /* the GPU is tested at most this often */
#define LONG_NS (GN_NS_PER_S / 4)  /* a frame that is drawn in pieces */

bool gn_show_wants_frame(const struct gn_show_screen *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    if (!screen->may_draw || !s->stage.gl) return false;
    if (screen->black || s->changed || s->fade.keeps || screen->damaged || !screen->lit)
        return true;
    const struct gn_kiosk_view view = gn_kiosk_view(&s->rules, &s->kiosk, screen->seen_ns);
    if (view.dark && s->drawn.dark) return false; /* black stays black */
    const bool moves = s->show->counts.most_frames < UINT64_MAX || s->stage.pose.at.fade < 1 ||
                       (!view.stands && (view.clip >= 0 || !gn_pose_stands(&s->stage.pose) ||
                                         gn_show_turntable_moves(s)));
    const struct gn_kiosk_view *drawn = &s->drawn;
    const bool differs =
        view.dark != drawn->dark || view.mode != drawn->mode || view.scene != drawn->scene ||
        view.camera != drawn->camera || view.clip != drawn->clip ||
        view.clips_begun_ns != drawn->clips_begun_ns || view.info != drawn->info ||
        view.old > 0.0f || drawn->old > 0.0f || view.caption != drawn->caption ||
        view.caption_mode != drawn->caption_mode || view.caption_scene != drawn->caption_scene ||
        (view.stands && (view.time_ns != drawn->time_ns || view.clip_ns != drawn->clip_ns));
    return moves || differs || gn_parts_want_frame(&s->show->parts) || gn_show_bar_moves(s) ||
           gn_truth_wants_frame(s) || gn_still_wants_frame(s) ||
           gn_occluder_fades(s->stage.occluder) || gn_show_captions_due_ns(s) <= screen->seen_ns;
}

/* Fills a requested screenshot from this frame. */
static void fill_screenshot(struct gn_show_screen *s, struct gn_screenshot *shot) {
    const struct gn_frame_opts *f = &s->stage.shown.opts;
    struct gn_err err = {0};
    if (!shot || !gn_screenshot_is_asked(shot)) return;
    uint8_t *rgba = gn_screenshot_begin(shot, f->output.width_px, f->output.height_px,
                                        f->output.turn_deg, &err);
    if (!rgba || !gn_gl_read_rgba8(s->stage.gl, rgba, &err) || !gn_screenshot_start(shot, &err))
        gn_screenshot_fail(shot, &err);
}

/* This picture is the start of a fade. */
static void keep_picture(struct gn_show_screen *s) {
    struct gn_err why = {0};
    if (!gn_gl_keep(s->stage.gl, &why)) {
        gn_problem_report(&s->show->problems, GN_PROBLEM_START, why.text);
        s->rules.fade_ns = 0; /* disables fades */
    }
    s->fade.keeps = false;
    s->fade.kept = true;
}

/* Something is drawn over the scene that is as large as the screen, or this picture is kept. */
static bool covers(const struct gn_show_screen *s, const struct gn_kiosk_view *view) {
    const struct gn_frame_cover_opts *cover = &s->stage.shown.opts.cover;
    return cover->captions || cover->dimmed > 0.0f || s->split.on || s->fade.keeps ||
           view->old > 0.0f || (s->show->screenshot && gn_screenshot_is_asked(s->show->screenshot));
}

/* *behind: a filtered map is older than the pose, so another frame is due. */
static bool draw_frame(struct gn_show_screen *s, bool *behind, struct gn_err *err) {
    const struct gn_screen *screen = &s->stage.display.screen;
    const int64_t seen_ns = screen->seen_ns;
    const struct gn_kiosk_view view = gn_kiosk_view(&s->rules, &s->kiosk, seen_ns);
    s->drawn.dark = view.dark;
    if (screen->black || (view.dark && s->rules.sleeps_black)) {
        gn_gl_black(s->stage.gl);
        return true;
    }
    gn_show_fit_to_screen(s);
    if (!s->ahead.alone) gn_show_work(s);
    const bool made = gn_occluder_works(s->stage.occluder) || gn_detailer_works(s->stage.detailer);
    const unsigned long allocations = gn_alloc_count();
    const uint64_t objects = gn_gl_stats(s->stage.gl).objects_created;
    gn_show_take_view(s, &view, seen_ns);
    gn_show_write_captions(s, &view, seen_ns);
    const bool is_bare = s->viewer.screenshot && gn_screenshot_is_asked(s->viewer.screenshot);
    gn_parts_add_frame(&s->show->parts, &s->stage.shown.opts);
    if (is_bare) { /* this frame */
        s->stage.shown.opts.cover.captions = NULL;
        s->stage.shown.opts.cover.dimmed = 0.0f;
    }
    gn_show_scale_frame(s, !is_bare && !covers(s, &view));
    const int64_t scene_ns = s->stage.settings->scene.time_ns + view.time_ns;
    gn_show_step_turntable(s, seen_ns, scene_ns);
    gn_still_lay_over(s, scene_ns, view.mode != s->drawn.mode || view.scene != s->drawn.scene);
    const struct gn_plan *left = s->split.on ? gn_split_draw_left(s, scene_ns, err) : NULL;
    if (s->split.on && !left) return false;
    const struct gn_plan *plan =
        s->truth.on ? gn_truth_draw(s, scene_ns, err)
                    : gn_view_draw(&s->stage.shown, &s->stage, scene_ns, s->show->warnings, err);
    if (!plan) return false;
    gn_still_follow(s);
    *behind = plan->is_behind || (left && left->is_behind);
    if (s->split.on)
        gn_split_lay_over(s);
    else if (view.old > 0.0f)
        gn_gl_lay_over(s->stage.gl, view.old);
    if (s->fade.keeps) keep_picture(s);

    /* count allocations, except in the first frame and while a thread loads or makes something; GL
     * objects not where a mode begins either: its maps are made then */
    if (s->show->counts.frames++ > 0 && !made && !gn_loader_is_busy(s->show->scenes.loader) &&
        !gn_occluder_works(s->stage.occluder) && !gn_detailer_works(s->stage.detailer)) {
        s->show->counts.allocations += gn_alloc_count() - allocations;
        if (view.mode == s->drawn.mode && view.scene == s->drawn.scene)
            s->show->counts.objects += gn_gl_stats(s->stage.gl).objects_created - objects;
    }
    /* what programs of other modes may take is weighed again: the last mode's maps are gone */
    if (view.mode != s->drawn.mode) s->ahead.keeps = s->ahead.idle = false;
    s->drawn = view;
    gn_show_send(s, (struct gn_kiosk_event){.kind = GN_KIOSK_FRAME, .time_ns = seen_ns});
    if (!s->stage.display.ops->screen) gn_gl_finish_frame(s->stage.gl);
    gn_frame_times_add(&s->show->counts.times, gn_loop_now_ns(s->show->loop));
    fill_screenshot(s, s->show->screenshot);
    fill_screenshot(s, s->viewer.screenshot);
    return !screen->copy_to ||
           gn_gl_read_xrgb8888(s->stage.gl, screen->copy_to, screen->copy_stride, err);
}

/* While a long frame is drawn requests are answered, and what the parts do by timers is done. */
static bool pause_frame(void *user, uint64_t pieces, int64_t run_ns, struct gn_err *err) {
    struct gn_show *s = user;
    s->screen.pauses = true;
    gn_loop_step(s->loop, 0);
    const bool ok = gn_parts_pause(&s->parts, pieces, run_ns, err);
    s->screen.pauses = false;
    return ok && !s->ends;
}

/* A GPU that was reset may have lost its memory without an error from the driver: after a stalled
 * flip known values are drawn and read back. */
static bool gpu_is_well(struct gn_show_screen *s) {
    const uint64_t stalled = s->stage.display.screen.counts.stalled;
    const int64_t now_ns = gn_loop_now_ns(s->show->loop);
    if (gn_gl_is_lost(s->stage.gl)) return false;
    if (stalled == s->context.checked_stalls || now_ns < s->context.checked_ns + ASK_NS)
        return true;
    s->context.checked_stalls = stalled;
    s->context.checked_ns = now_ns;
    return gn_gl_draws_right(s->stage.gl);
}

bool gn_show_frame(struct gn_show_screen *s, struct gn_err *err) {
    struct gn_display *display = &s->stage.display;
    const int64_t begun_ns = gn_loop_now_ns(s->show->loop);
    if (!gpu_is_well(s) && gn_display_lose(display, begun_ns)) return true;
    if (!gn_display_begin(display, begun_ns, err)) return !err->text[0];
    bool behind = false;
    const bool had_changed = s->changed;
    s->changed = false; /* what changes in a pause is for the next frame */
    gn_gl_set_pause(s->stage.gl, pause_frame, s->show);
    const bool drawn = draw_frame(s, &behind, err);
    s->changed |= drawn ? behind : had_changed;
    if (gn_gl_is_lost(s->stage.gl) && gn_display_lose(display, gn_loop_now_ns(s->show->loop))) {
        *err = (struct gn_err){0};
        return true;
    }
    if (!drawn && s->show->ends) *err = (struct gn_err){0}; /* asked for in a pause */
    if (!drawn) return s->show->ends;
    const int64_t drawn_ns = gn_loop_now_ns(s->show->loop);
    if (!gn_display_present(display, drawn_ns, err)) return false;

    /* latency of buttons */
    struct gn_latency *latency = &s->show->buttons.latency;
    const uint64_t before = latency->count;
    gn_latency_frame(latency, gn_loop_now_ns(s->show->loop), !gn_kiosk_waits(&s->kiosk));
    if (latency->count != before && s->stage.settings->run.verbose) {
        const struct gn_latency_sample last = gn_latency_last(latency);
        printf("seen %.1f ms after the edge, as frame %d\n", (double)last.ns * 1e-6, last.frames);
        fflush(stdout);
    }
    gn_parts_drawn(&s->show->parts, drawn_ns - begun_ns);
    s->ahead.alone = drawn_ns - begun_ns > 2 * s->stage.display.screen.period_ns;
    const int64_t now_ns = gn_loop_now_ns(s->show->loop), took_ns = now_ns - begun_ns;
    s->ahead.until_ns = 0;
    if (took_ns > LONG_NS) {
        s->ahead.until_ns = now_ns + (took_ns < GN_NS_PER_S ? took_ns : GN_NS_PER_S);
        gn_gl_frame_was_long(s->stage.gl);
    }
    return true;
}
