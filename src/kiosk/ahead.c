/* Work ahead: programs of other modes and another scene are made ready while the kiosk shows
 * something else, one piece a frame, so that no frame is missed. A program takes 1 to 5 MB in the
 * driver: those of other modes are made once, so that its cache on disk has them, and as many stay
 * as shares of the memory allow. A mode without its programs is made ready when it is wanted. */
#include <errno.h>
#include <malloc.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/memory.h"
#include "kiosk/private.h"

enum { SLICE_BYTES = 1 << 20 };

void gn_show_unready(struct gn_show_screen *s) {
    s->looks.ready = s->looks.made = s->staged.looks.ready = 0;
    s->ahead.keeps = s->ahead.idle = false;
}

static void forget_upload(struct gn_show_screen *s) {
    gn_view_stop(&s->staged.view);
    s->staged.view.pose = NULL;
    s->staged.whole = false;
}

void gn_show_forget_work(struct gn_show_screen *s) {
    gn_show_unready(s);
    forget_upload(s);
    s->fade.prepared = false;
    gn_view_stop(&s->split.view);
    gn_truth_drop(s);
    gn_still_drop(s);
}

void gn_show_drop_staged(struct gn_show_screen *s) {
    s->staged.stale = s->pauses && s->staged.loaded;
    if (s->pauses) return;
    if (s->stage.gl) gn_gl_staged_begin(s->stage.gl, NULL);
    forget_upload(s);
    gn_loaded_drop(s->staged.loaded);
    s->staged.loaded = NULL;
    s->staged.looks.ready = 0;
}

bool gn_show_reload_is_staged(const struct gn_show_screen *s) {
    return s->staged.loaded && s->staged.loaded->number == GN_SHOW_RELOAD;
}

/* The mode or scene of that number cannot be shown. */
static void fail_place(struct gn_show_screen *s, enum gn_kiosk_event_kind kind, int number,
                       const char *why) {
    const bool of_mode = kind == GN_KIOSK_MODE_FAILED;
    *(of_mode ? &s->show->problems.mode : &s->show->problems.scene) = number;
    const enum gn_problem problem = of_mode ? GN_PROBLEM_MODE : GN_PROBLEM_SCENE;
    gn_problem_report_again(&s->show->problems, problem, why);
    if (!of_mode) gn_parts_loaded(&s->show->parts, GN_PART_LOAD_SCENE);
    gn_show_send(s, (struct gn_kiosk_event){.kind = kind, .mode = number, .scene = number});
    gn_latency_drop(&s->show->buttons.latency);
}

/* As if the staged scene of the reload had not loaded. */
static void fail_reload(struct gn_show_screen *s, const struct gn_err *err) {
    gn_show_drop_staged(s);
    s->show->reload.loaded = gn_xalloc(1, sizeof *s->show->reload.loaded);
    s->show->reload.loaded->number = GN_SHOW_RELOAD;
    s->show->reload.loaded->err = *err;
}

/* ---- programs ---- */

/* All that the mode can need, on this screen. */
static const struct gn_plan *plan_mode(const struct gn_show_screen *s,
                                       const struct gn_show_looks *looks, struct gn_view *view,
                                       int mode) {
    const int variant = view->pose->at.variant;
    struct gn_frame_opts opts = looks->of[mode].frame_opts;
    opts.output = s->stage.shown.opts.output;
    opts.all_seen = true;
    opts.cover.captions = gn_show_sample_captions(s);
    gn_pose_choose_variant(view->pose, looks->of[mode].variant);
    const struct gn_plan *plan = gn_view_build(view, s->stage.gl, &opts, NULL);
    gn_pose_choose_variant(view->pose, variant);
    return plan;
}

/* wanted: the mode waits for it. True: it did a piece; false: nothing was left to do. */
static bool warm_mode(struct gn_show_screen *s, struct gn_show_looks *looks, struct gn_view *view,
                      int mode, bool wanted) {
    struct gn_err err = {0};
    char text[sizeof err.text + 64];
    const struct gn_plan *plan = plan_mode(s, looks, view, mode);
    switch (gn_gl_warm(s->stage.gl, plan, wanted, &err)) {
    case GN_GL_WARM_DONE:
        looks->made |= 1u << mode;
        if (gn_gl_has_programs(s->stage.gl, plan)) looks->ready |= 1u << mode;
        return false;
    case GN_GL_WARM_FAILED:
        if (looks == &s->staged.looks && gn_show_reload_is_staged(s)) {
            fail_reload(s, &err);
            return true;
        }
        snprintf(text, sizeof text, "mode \"%.40s\": %s", s->show->modes.names[mode], err.text);
        looks->ready |= 1u << mode; /* not tried again */
        looks->made |= 1u << mode;
        fail_place(s, GN_KIOSK_MODE_FAILED, mode, text);
        return true;
    case GN_GL_WARM_REBUILD: gn_view_stop(view); return true;
    default: return true;
    }
}

/* Programs of other modes, until those are within their shares of the memory: a limit for modes
 * that were not shown yet; for those that were as much as all else takes, or 1/16 of the machine's.
 */
static void drop_programs(struct gn_show_screen *s) {
    const struct gn_gl_idle idle = gn_gl_idle_programs(s->stage.gl);
    const uint64_t all = gn_memory_allocated();
    /* a cold compiler takes more than it keeps: never less than a quarter */
    const uint64_t needed = all - (idle.bytes < all / 4 * 3 ? idle.bytes : all / 4 * 3);
    const uint64_t whole = 125; /* percent: what was measured may be less than what it is */
    const uint64_t percent = gn_stage_limits(s->stage.settings).ahead_percent;
    struct gn_gl_idle most = {.bytes = (gn_memory_total_mb() << 20) / 16,
                              .ahead_bytes = needed / whole * percent};
    if (most.bytes < needed) most.bytes = needed;
    if (most.bytes < most.ahead_bytes) most.bytes = most.ahead_bytes;
    if (!gn_gl_drop_programs(s->stage.gl, &most)) return;
    s->looks.ready &= 1u << s->kiosk.shown.mode;
    s->ahead.dropped = true;
}

/* Only while the wanted mode is shown and no scene is staged: their programs could be dropped. The
 * plan of a mode whose programs are there takes time as well, of a scene with many items. */
static bool work_on_others(struct gn_show_screen *s, int64_t until_ns) {
    const int shown = s->kiosk.shown.mode;
    if (!s->ahead.keeps) {
        gn_gl_keep_programs(s->stage.gl, plan_mode(s, &s->looks, &s->stage.shown, shown));
        drop_programs(s);
        s->ahead.keeps = true;
        if (gn_loop_now_ns(s->show->loop) >= until_ns) return true;
    }
    for (int i = 1; i < s->show->modes.count; i++) {
        const int mode = (shown + i) % s->show->modes.count;
        if ((s->looks.made | s->rules.passed_by) >> mode & 1) continue;
        if (warm_mode(s, &s->looks, &s->stage.shown, mode, false))
            drop_programs(s);
        else if (gn_loop_now_ns(s->show->loop) < until_ns)
            continue;
        return true;
    }
    return false;
}

/* ---- the staged scene ---- */

/* The place in staged.looks of what is shown first: a reload has one look, at 0, of any mode. */
static int first_look(const struct gn_show_screen *s) {
    return gn_show_reload_is_staged(s) ? 0 : s->kiosk.wanted.mode;
}

static bool staged_is_ready(const struct gn_show_screen *s) {
    return !s->stage.gl || (s->staged.whole && s->staged.looks.ready >> first_look(s) & 1);
}

void gn_show_stage_reload(struct gn_show_screen *s, const struct gn_stage_look *look) {
    struct gn_show_staged *staged = &s->staged;
    if (s->show->reload.loaded) {
        gn_show_drop_staged(s);
        staged->loaded = s->show->reload.loaded;
        s->show->reload.loaded = NULL;
    }
    staged->looks.of[0] = *look;
    staged->looks.ready = 0;
    if (look->clips != staged->loaded->pose.at.clips)
        gn_pose_choose(&staged->loaded->pose, look->clips);
    gn_pose_choose_variant(&staged->loaded->pose, look->variant);
    s->ahead.idle = false;
}

bool gn_show_reload_is_ready(const struct gn_show_screen *s) {
    return gn_show_reload_is_staged(s) && staged_is_ready(s);
}

void gn_show_take_staged(struct gn_show_screen *s) {
    struct gn_show_staged *staged = &s->staged;
    struct gn_stage *stage = &s->stage;
    struct gn_loaded *loaded = staged->loaded;
    const struct gn_loaded shown = {.scene = stage->scene,
                                    .pose = stage->pose,
                                    .occluder = stage->occluder,
                                    .detailer = stage->detailer};
    gn_truth_drop(s); /* these are of the other scene */
    gn_still_drop(s);
    gn_view_close(&s->split.view, s->stage.gl);
    gn_view_stop(&stage->shown);
    if (stage->gl) gn_gl_staged_show(stage->gl);
    stage->shown.builder = staged->view.builder;
    staged->view.builder = NULL;
    stage->scene = loaded->scene;
    stage->pose = loaded->pose;
    stage->occluder = loaded->occluder;
    stage->detailer = loaded->detailer;
    loaded->scene = shown.scene;
    loaded->pose = shown.pose;
    loaded->occluder = shown.occluder;
    loaded->detailer = shown.detailer;
    gn_show_drop_staged(s);
    s->scaling = (struct gn_show_scaling){0};
    s->ahead.idle = false;
    s->ahead.alone = true; /* how long its frames take is not known yet */
}

static bool work_on_staged(struct gn_show_screen *s) {
    struct gn_show_staged *staged = &s->staged;
    struct gn_loaded *loaded = staged->loaded;
    const int mode = first_look(s);
    struct gn_err err = {0};
    if (!loaded) return false;
    if (staged->whole)
        return !(staged->looks.ready >> mode & 1) &&
               warm_mode(s, &staged->looks, &staged->view, mode, true);

    /* its bytes are counted for the bar */
    staged->sent += SLICE_BYTES;
    /* upload it; after a lost context the upload begins again */
    if (!staged->view.pose) {
        gn_gl_staged_begin(s->stage.gl, loaded->scene);
        staged->sent = 0;
        staged->all = gn_scene_gpu_bytes(loaded->scene);
        staged->view.pose = &loaded->pose;
    } else if (!gn_gl_staged_step(s->stage.gl, SLICE_BYTES, &staged->whole, &err)) {
        const int number = loaded->number;
        if (number == GN_SHOW_RELOAD) {
            s->show->reload.alone = true; /* the old scene is freed first (keeps_gl()) */
            return true;
        }
        gn_show_drop_staged(s);
        fail_place(s, GN_KIOSK_SCENE_FAILED, number, err.text);
    }
    return true;
}

/* ---- pieces, most urgent first ---- */

bool gn_show_has_work(const struct gn_show_screen *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    return !s->ahead.idle && s->stage.gl && (s->show->counts.frames > 0 || !screen->lit);
}

/* False: there was none. */
static bool work_once(struct gn_show_screen *s, int64_t until_ns) {
    if (s->rules.fade_ns > 0 && !s->fade.prepared && s->show->counts.frames > 0) {
        struct gn_err unused = {0}; /* the first fade reports a failure */
        const struct gn_screen *screen = &s->stage.display.screen;
        gn_gl_keep_prepare(s->stage.gl, screen->width_px, screen->height_px, &unused);
        return s->fade.prepared = true;
    }
    if (work_on_staged(s)) return true;
    const int wanted = s->kiosk.wanted.mode;
    if (!(s->looks.ready >> wanted & 1) && warm_mode(s, &s->looks, &s->stage.shown, wanted, true))
        return true;
    return wanted == s->kiosk.shown.mode && !s->staged.loaded && work_on_others(s, until_ns);
}

void gn_show_work(struct gn_show_screen *s) {
    const int64_t period_ns = s->stage.display.screen.period_ns;
    const int64_t until_ns = gn_loop_now_ns(s->show->loop) + period_ns / 4;
    if (!gn_show_has_work(s)) return;
    do s->ahead.idle = !work_once(s, until_ns);
    while (!s->ahead.idle && gn_kiosk_waits(&s->kiosk) && gn_loop_now_ns(s->show->loop) < until_ns);
    if (s->ahead.idle) {
        gn_gl_warm_end(s->stage.gl);
        if (s->ahead.dropped) malloc_trim(0);
        s->ahead.dropped = false;
    }
    /* while frames go on, each works; this is for when none comes */
    s->ahead.due_ns = gn_loop_now_ns(s->show->loop) + 2 * period_ns;
}

/* ---- the wanted scene and mode ---- */

static void take_loaded(void *user, int64_t now_ns) {
    struct gn_show *s = user;
    struct gn_show_screen *screen = &s->screen;
    (void)now_ns;
    if (screen->pauses) return; /* it is taken after that frame */
    struct gn_loaded *loaded = gn_loader_take(s->scenes.loader);
    if (!loaded) return; /* not done, or cancelled */
    for (int i = 0; i < loaded->warnings.count; i++)
        gn_warn(s->warnings, "%s", loaded->warnings.text[i]);
    if (loaded->number == GN_SHOW_RELOAD) {
        s->reload.loaded = loaded;
        return;
    }
    if (loaded->scene &&
        gn_show_build_looks(s, loaded->scene, &screen->staged.looks, &loaded->err)) {
        gn_show_drop_staged(screen);
        screen->staged.loaded = loaded;
        screen->ahead.idle = false;
        return;
    }
    fail_place(screen, GN_KIOSK_SCENE_FAILED, loaded->number, loaded->err.text);
    gn_loaded_drop(loaded);
}

void gn_show_close_loader(struct gn_show *s) {
    gn_loop_remove(&s->scenes.loader_watch);
    gn_loader_close(s->scenes.loader);
    s->scenes.loader = NULL;
}

bool gn_show_open_loader(struct gn_show *s, struct gn_err *err) {
    struct gn_watch *watch = &s->scenes.loader_watch;
    s->scenes.loader = gn_loader_open(err);
    if (!s->scenes.loader) return false;
    *watch = (struct gn_watch){
        .fd = gn_loader_fd(s->scenes.loader), .events = EPOLLIN, .call = take_loaded, .user = s};
    return gn_loop_add(s->loop, watch) ||
           gn_fail(err, "show: cannot wait for scenes: %s", strerror(errno));
}

void gn_show_start_load(struct gn_show *s, int number, const char *path,
                        const struct gn_settings *settings) {
    const struct gn_scene_limits limits = gn_stage_limits(settings);
    s->scenes.load_begun_ns = gn_loop_now_ns(s->loop);
    gn_loader_start(s->scenes.loader, number, path, &limits);
}

static bool is_ready(const struct gn_show_screen *s, int scene) {
    const uint32_t bit = 1u << s->kiosk.wanted.mode;
    if (scene == s->scene) return !s->stage.gl || s->looks.ready & bit;
    return s->staged.loaded && s->staged.loaded->number == scene && staged_is_ready(s);
}

bool gn_show_can_advance(const struct gn_show_screen *s) {
    if (gn_show_reload_is_ready(s)) return true;
    return gn_kiosk_waits(&s->kiosk) && !s->fade.keeps &&
           is_ready(s, gn_kiosk_scene(&s->rules, &s->kiosk.wanted));
}

static void show_wanted(struct gn_show_screen *s, int scene) {
    struct gn_show_scenes *scenes = &s->show->scenes;
    struct gn_stage *stage = &s->stage;
    gn_show_send(s, (struct gn_kiosk_event){
                        .kind = GN_KIOSK_READY, .mode = s->kiosk.wanted.mode, .scene = scene});

    /* the staged scene replaces the stage's */
    if (scene != s->scene) {
        s->show->first.lost[0] = '\0'; /* another one was chosen */
        s->looks = s->staged.looks;
        s->scene = scene;
        stage->shown.opts.view.orbit = (struct gn_orbit){0};
        gn_show_take_staged(s);
        gn_show_list_again(s);
        gn_parts_loaded(&s->show->parts, GN_PART_LOAD_SCENE);
    }
    gn_show_enter(s);
    if (s->show->problems.mode == s->kiosk.shown.mode)
        gn_problem_cure(&s->show->problems, GN_PROBLEM_MODE);
    if (s->show->problems.scene == scene) gn_problem_cure(&s->show->problems, GN_PROBLEM_SCENE);
    s->fade.keeps = s->fade.kept = false;
    if (!stage->settings->run.verbose) return;
    printf("mode %s, scene %s\n", s->show->modes.names[s->kiosk.shown.mode],
           scenes->paths[scene] ? scenes->paths[scene] : "(default scene)");
    fflush(stdout);
}

void gn_show_advance(struct gn_show_screen *s) {
    struct gn_show_scenes *scenes = &s->show->scenes;
    const int scene = gn_kiosk_scene(&s->rules, &s->kiosk.wanted);
    const int loading = gn_loader_number(scenes->loader);
    if (s->staged.stale ||
        (s->staged.loaded && s->staged.loaded->number != scene && !gn_show_reload_is_staged(s)))
        gn_show_drop_staged(s);
    if (loading != GN_SHOW_RELOAD && (loading != scene || scene == s->scene))
        gn_loader_cancel(scenes->loader);
    if (!gn_kiosk_waits(&s->kiosk)) {
        s->fade.keeps = s->fade.kept = false;
        return;
    }

    /* one load at a time; a reload, which may change the list, comes first */
    if (scene != s->scene && !s->staged.loaded && !s->show->reload.options &&
        !gn_loader_is_busy(scenes->loader))
        gn_show_start_load(s->show, scene, scenes->paths[scene], s->stage.settings);
    if (!is_ready(s, scene)) {
        if (s->staged.loaded || scene == s->scene) s->ahead.idle = false;
        return;
    }

    /* a fade starts from the last picture, which is drawn once more and kept */
    if (s->rules.fade_ns > 0 && !s->split.on && s->stage.gl && s->stage.display.screen.lit &&
        s->show->counts.frames > 0 && !s->fade.kept && !gn_kiosk_is_dark(&s->kiosk))
        s->fade.keeps = true;
    else
        show_wanted(s, scene);
}
