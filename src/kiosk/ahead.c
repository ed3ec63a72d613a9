/* Work ahead: programs of other modes and another scene are made ready while the kiosk shows
 * something else, one piece a frame, so that no frame is missed. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"

enum { SLICE_BYTES = 1 << 20 };

void gn_show_forget_work(struct gn_show *s) {
    s->looks.ready = s->scenes.looks.ready = 0;
    s->scenes.whole = false;
    gn_frame_destroy(s->scenes.frame);
    s->scenes.frame = NULL;
    s->ahead.idle = s->fade.prepared = false;
}

void gn_show_drop_staged(struct gn_show *s) {
    if (s->stage.gl) gn_gl_stage(s->stage.gl, NULL);
    gn_frame_destroy(s->scenes.frame);
    gn_loaded_destroy(s->scenes.staged);
    s->scenes.frame = NULL;
    s->scenes.staged = NULL;
    s->scenes.whole = false;
    s->scenes.looks.ready = 0;
}

/* ---- programs ---- */

static void fail_mode(struct gn_show *s, struct gn_show_looks *looks, int mode,
                      const struct gn_err *err) {
    const struct gn_kiosk_event failed = {
        .kind = GN_KIOSK_MODE_FAILED, .time_ns = gn_clock_monotonic_ns(), .mode = mode};
    char text[sizeof err->text + 64];
    snprintf(text, sizeof text, "mode \"%.40s\": %s", s->modes.names[mode], err->text);
    gn_show_report_problem(s, text);
    looks->ready |= 1u << mode; /* not tried again */
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &failed);
    gn_latency_drop(&s->buttons.latency);
}

/* Frame options of a mode on this screen. */
static struct gn_frame_opts opts_of(const struct gn_show *s, const struct gn_stage_look *look) {
    const struct gn_frame_opts *now = &s->stage.frame_opts;
    struct gn_frame_opts opts = look->frame_opts;
    opts.width_px = now->width_px;
    opts.height_px = now->height_px;
    opts.turn_deg = now->turn_deg;
    opts.unencoded = now->unencoded;
    opts.msaa = now->msaa;
    opts.all_seen = true;
    opts.captions_later = true;
    return opts;
}

/* True: it did a piece; false: the mode is ready. */
static bool warm_mode(struct gn_show *s, struct gn_show_looks *looks, struct gn_frame **frame,
                      const struct gn_pose *pose, int mode) {
    const struct gn_frame_opts opts = opts_of(s, &looks->of[mode]);
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(*frame, pose, &opts, NULL);
    switch (gn_gl_warm(s->stage.gl, plan, &err)) {
    case GN_GL_WARM_DONE: looks->ready |= 1u << mode; return false;
    case GN_GL_WARM_FAILED: fail_mode(s, looks, mode, &err); return true;
    case GN_GL_WARM_REBUILD:
        gn_frame_destroy(*frame);
        *frame = gn_frame_create(pose->scene, gn_gl_caps(s->stage.gl));
        return true;
    default: return true;
    }
}

/* ---- the staged scene ---- */

static void fail_scene(struct gn_show *s, int scene, const struct gn_err *err) {
    const struct gn_kiosk_event failed = {
        .kind = GN_KIOSK_SCENE_FAILED, .time_ns = gn_clock_monotonic_ns(), .scene = scene};
    gn_show_report_problem(s, err->text);
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &failed);
    gn_latency_drop(&s->buttons.latency);
}

/* After a lost context it begins again. */
static bool upload_staged(struct gn_show *s) {
    struct gn_show_scenes *scenes = &s->scenes;
    struct gn_loaded *staged = scenes->staged;
    struct gn_err err = {0};
    if (!scenes->frame) {
        gn_gl_stage(s->stage.gl, staged->scene);
        scenes->frame = gn_frame_create(staged->scene, gn_gl_caps(s->stage.gl));
        return true;
    }
    if (gn_gl_stage_step(s->stage.gl, SLICE_BYTES, &scenes->whole, &err)) return true;
    const int number = staged->number;
    gn_show_drop_staged(s);
    fail_scene(s, number, &err);
    return true;
}

static bool work_on_staged(struct gn_show *s) {
    struct gn_show_scenes *scenes = &s->scenes;
    const int mode = s->kiosk.wanted.mode;
    if (!scenes->staged) return false;
    if (!scenes->whole) return upload_staged(s);
    return !(scenes->looks.ready >> mode & 1) &&
           warm_mode(s, &scenes->looks, &scenes->frame, &scenes->staged->pose, mode);
}

/* ---- pieces, most urgent first ---- */

static bool do_piece(struct gn_show *s) {
    if (s->rules.fade_ns > 0 && !s->fade.prepared && s->counts.frames > 0) {
        struct gn_err unused = {0}; /* the first fade reports a failure */
        gn_gl_keep_prepare(s->stage.gl, &unused);
        s->fade.prepared = true;
        return true;
    }
    if (work_on_staged(s)) return true;
    for (int i = 0; i < s->modes.count; i++) {
        const int mode = (s->kiosk.wanted.mode + i) % s->modes.count;
        if (!(s->looks.ready >> mode & 1) &&
            warm_mode(s, &s->looks, &s->stage.frame, &s->stage.pose, mode))
            return true;
    }
    return false;
}

bool gn_show_has_work(const struct gn_show *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    return !s->ahead.idle && s->stage.gl && (s->counts.frames > 0 || !screen->lit);
}

void gn_show_work(struct gn_show *s) {
    if (!gn_show_has_work(s)) return;
    s->ahead.idle = !do_piece(s);
    if (s->ahead.idle) gn_gl_warm_end(s->stage.gl);
    s->ahead.due_ns = gn_clock_monotonic_ns() + 2 * s->stage.display.screen.period_ns;
}

/* ---- the wanted scene and mode ---- */

static void take_loaded(void *user, uint32_t events, int64_t now_ns) {
    struct gn_show *s = user;
    struct gn_loaded *loaded = gn_loader_take(s->scenes.loader);
    (void)events, (void)now_ns;
    if (!loaded) return;
    for (int i = 0; i < loaded->warnings.count; i++)
        gn_warn(s->warnings, "%s", loaded->warnings.text[i]);
    if (loaded->scene && gn_show_look(s, loaded->scene, &s->scenes.looks, &loaded->err)) {
        gn_show_drop_staged(s);
        s->scenes.staged = loaded;
        s->ahead.idle = false;
        return;
    }
    fail_scene(s, loaded->number, &loaded->err);
    gn_loaded_destroy(loaded);
}

void gn_show_close_loader(struct gn_show *s) {
    gn_loop_remove(&s->scenes.loader_watch);
    gn_loader_close(s->scenes.loader);
    s->scenes.loader = NULL;
}

bool gn_show_open_loader(struct gn_show *s, struct gn_err *err) {
    struct gn_watch *watch = &s->scenes.loader_watch;
    gn_show_close_loader(s);
    s->scenes.loader = gn_loader_open(err);
    if (!s->scenes.loader) return false;
    *watch = (struct gn_watch){
        .fd = gn_loader_fd(s->scenes.loader), .events = EPOLLIN, .call = take_loaded, .user = s};
    return gn_loop_add(s->loop, watch) ||
           gn_fail(err, "show: cannot wait for scenes: %s", strerror(errno));
}

/* One at a time: also a load whose scene is no longer wanted is finished first. */
static void load_scene(struct gn_show *s, int scene) {
    struct gn_scene_limits limits;
    struct gn_err err = {0};
    if (gn_loader_is_busy(s->scenes.loader)) return;
    if (!gn_stage_limits(s->stage.settings, &limits, &err) ||
        !gn_loader_start(s->scenes.loader, scene, s->scenes.paths[scene], &limits, &err))
        fail_scene(s, scene, &err);
}

/* The staged scene replaces the stage's. */
static void show_staged(struct gn_show *s) {
    struct gn_show_scenes *scenes = &s->scenes;
    struct gn_loaded *staged = scenes->staged;
    struct gn_stage *stage = &s->stage;
    if (stage->gl) {
        gn_gl_stage_show(stage->gl);
        gn_frame_destroy(stage->frame);
        stage->frame = scenes->frame;
        scenes->frame = NULL;
    }
    gn_pose_finish(&stage->pose);
    gn_scene_destroy(stage->scene);
    stage->scene = staged->scene;
    stage->pose = staged->pose;
    stage->frame_opts.view.orbit = (struct gn_orbit){0};
    s->looks = scenes->looks;
    scenes->shown = staged->number;
    staged->scene = NULL;
    staged->pose = (struct gn_pose){0};
    gn_show_drop_staged(s);
    s->ahead.idle = false;
}

static bool is_ready(const struct gn_show *s, int scene) {
    const struct gn_show_scenes *scenes = &s->scenes;
    const uint32_t bit = 1u << s->kiosk.wanted.mode;
    if (scene == scenes->shown) return !s->stage.gl || s->looks.ready & bit;
    if (!scenes->staged || scenes->staged->number != scene) return false;
    return !s->stage.gl || (scenes->whole && scenes->looks.ready & bit);
}

bool gn_show_can_advance(const struct gn_show *s) {
    return gn_kiosk_waits(&s->kiosk) && !s->fade.keeps &&
           is_ready(s, gn_kiosk_scene(&s->rules, &s->kiosk.wanted));
}

/* A fade begins with the last picture: it is drawn once more, and kept. */
static bool waits_for_kept(struct gn_show *s) {
    const struct gn_screen *screen = &s->stage.display.screen;
    if (s->rules.fade_ns == 0 || !s->stage.gl || !screen->lit || s->counts.frames == 0 ||
        s->fade.kept || s->kiosk.blanked)
        return false;
    s->fade.keeps = true;
    return true;
}

static void show_wanted(struct gn_show *s, int scene) {
    const struct gn_kiosk_event ready = {.kind = GN_KIOSK_READY,
                                         .time_ns = gn_clock_monotonic_ns(),
                                         .mode = s->kiosk.wanted.mode,
                                         .scene = scene};
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &ready);
    if (scene != s->scenes.shown) show_staged(s);
    gn_show_enter(s);
    s->fade.keeps = s->fade.kept = false;
    if (!s->stage.settings->run.verbose) return;
    printf("mode %s, scene %s\n", s->modes.names[s->kiosk.shown.mode],
           s->scenes.paths[scene] ? s->scenes.paths[scene] : "(default scene)");
    fflush(stdout);
}

void gn_show_advance(struct gn_show *s) {
    const int scene = gn_kiosk_scene(&s->rules, &s->kiosk.wanted);
    if (s->scenes.staged && s->scenes.staged->number != scene) gn_show_drop_staged(s);
    if (!gn_kiosk_waits(&s->kiosk)) {
        s->fade.keeps = s->fade.kept = false;
        return;
    }
    if (scene != s->scenes.shown && !s->scenes.staged) load_scene(s, scene);
    if (s->scenes.staged && !(s->scenes.looks.ready >> s->kiosk.wanted.mode & 1))
        s->ahead.idle = false;
    if (is_ready(s, scene) && !waits_for_kept(s)) show_wanted(s, scene);
}
