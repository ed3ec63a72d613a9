/* Modes of the kiosk: the list, the scenes, and entering one. */
#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "kiosk/private.h"
#include "shadow/planar.h"

_Static_assert((int)GN_TECHNIQUE_COUNT < GN_KIOSK_MODES_MAX, "every technique is a mode");

/* ---- the list ---- */

static void add_mode(struct gn_show_modes *modes, const char *name, const char *title,
                     int settings) {
    if (modes->count == GN_KIOSK_MODES_MAX) return;
    gn_text_format(modes->titles[modes->count], sizeof modes->titles[0], "%s", title);
    modes->settings[modes->count] = settings;
    modes->names[modes->count++] = name;
}

int gn_show_find_mode(const struct gn_show_modes *modes, const char *name) {
    for (int i = 0; name && i < modes->count; i++)
        if (strcmp(modes->names[i], name) == 0) return i;
    return -1;
}

static int mode_or_base(const struct gn_show_modes *modes, const char *name) {
    const int named = gn_show_find_mode(modes, name);
    return named >= 0 ? named : modes->base >= 0 ? modes->base : 0;
}

static bool is_window(const struct gn_show *s, const struct gn_options *o) {
    const char *backend = s->config.place ? s->config.place->backend : o->all[0].display.backend;
    return strcmp(backend, "window") == 0;
}

/* Whether a kiosk goes through the mode of a technique. One is as good as that of the options if it
 * has the same title. */
static bool is_offered(const struct gn_options *o, enum gn_technique technique) {
    const struct gn_technique_row *row = &gn_techniques[technique];
    const uint8_t base = o->all[0].render.shadow.items[0];
    return technique == (enum gn_technique)base ||
           (row->offered && strcmp(row->title, gn_techniques[base].title) != 0);
}

static void add_technique(struct gn_show *s, enum gn_technique technique, bool is_base) {
    const struct gn_options *o = s->config.options;
    const struct gn_technique_row *row = &gn_techniques[technique];
    const bool window = is_window(s, o), all = window || o->all[0].run.mode ||
                                               (o->buttons && gn_buttons_name_mode(o->buttons));
    char title[80];
    snprintf(title, sizeof title, window ? "%s - %s" : "%s", row->title, row->name);
    if (!all && !is_offered(o, technique)) s->modes.passed_by |= 1u << s->modes.count;
    if (is_base) s->modes.base = s->modes.count;
    add_mode(&s->modes, row->name, title, is_base ? 0 : 1 + (int)technique);
}

/* Without modes in the file each technique is a mode, the best first. The technique of the options
 * gets no settings of its own, so that lights keep the technique that the scene names; if it comes
 * from the command line it is the only mode. */
static void list_techniques(struct gn_show *s) {
    enum gn_technique order[GN_TECHNIQUE_COUNT];
    const struct gn_settings *o = &s->config.options->all[0];
    const bool only = gn_settings_from(o, render.shadow) == GN_SOURCE_FLAG;
    gn_techniques_by_rank(order);
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) {
        const bool is_base = order[i] == (enum gn_technique)o->render.shadow.items[0];
        if (only && !is_base) continue;
        if (gn_techniques[order[i]].on_plane && !is_base &&
            !gn_planar_has_plane(s->screen.stage.scene))
            continue;
        add_technique(s, order[i], is_base);
    }
}

/* The number of the scene with that path; adds it if there is room. */
static int find_scene(struct gn_show_scenes *scenes, const char *path) {
    for (int i = 0; i < scenes->count; i++) {
        const char *other = scenes->paths[i];
        if (path == other || (path && other && strcmp(path, other) == 0)) return i;
    }
    if (scenes->count == GN_KIOSK_SCENES_MAX) return 0;
    scenes->paths[scenes->count] = path;
    return scenes->count++;
}

void gn_show_take_rules(struct gn_show_screen *s) {
    const struct gn_settings *o = s->stage.settings;
    s->rules.idle = (enum gn_idle)o->kiosk.idle;
    s->rules.idle_after_ns = o->kiosk.idle_after_ns;
    s->rules.plays_alone = o->kiosk.plays_alone;
    s->rules.wake_ns = o->schedule.wake_ns;
    s->rules.sleeps_black = o->schedule.off & GN_OFF_BLACK;
    s->rules.fade_ns = o->kiosk.fade_ns;
    s->rules.caption_ns = o->kiosk.captions ? o->kiosk.caption_ns : 0;
    s->rules.names_first = s->show->config.options->is_lesson;
    s->rules.restarts = 0;
    for (int i = 0; i < s->show->modes.count; i++)
        if (s->rules.replays || gn_show_settings(s->show, i)->scene.animation_restart)
            s->rules.restarts |= 1u << i;
}

bool gn_show_offers(const struct gn_show *s, const struct gn_options *o) {
    return gn_options_leave_modes(o) && !is_window(s, o);
}

/* As if kiosk.ini had a section for each. A second one, of the turntable, takes the place of the
 * settings of the first technique, which is none of the modes. */
static void list_offers(struct gn_show *s, int scene) {
    const struct gn_stage *stage = &s->screen.stage;
    struct gn_options *o = s->config.options;
    struct gn_show_modes *modes = &s->modes;
    gn_offers_build(&(struct gn_offers_of){.scene = stage->scene,
                                           .settings = &o->all[0],
                                           .clips = stage->pose.at.clips,
                                           .paths = s->scenes.paths,
                                           .path_count = s->scenes.listed,
                                           .shown = scene},
                    &modes->offers);
    modes->offered = true;
    modes->base = modes->offers.first;
    for (int i = 0; i < modes->offers.count; i++) {
        const struct gn_offer *offer = &modes->offers.items[i];
        add_mode(modes, offer->name, gn_offer_title(offer), offer->turns ? 1 : 0);
        if (!offer->turns) continue;
        const double rate = o->all[0].scene.turntable_deg_s == 0.0 ? GN_OFFER_TURNTABLE_DEG_S : 0.0;
        o->all[1] = o->all[0];
        gn_settings_put(&o->all[1], gn_option_find_key("scene", "turntable"), &rate, GN_SOURCE_MODE,
                        offer->name);
    }
}

/* That the options resume, else the one that the settings show. */
static int first_offer(struct gn_show *s) {
    const int found = gn_show_find_mode(&s->modes, s->config.options->resumes);
    s->config.options->resumes = NULL;
    return found >= 0 && s->modes.offers.items[found].scene < 0 ? found : s->modes.offers.first;
}

static void set_offer_rules(const struct gn_offers *offers, struct gn_kiosk_rules *rules) {
    rules->first_mode = offers->home;
    rules->replays = offers->replays;
    rules->own_camera = UINT32_MAX;
    for (int i = 0; i < offers->count; i++)
        rules->own_scene[i] = (uint8_t)(1 + offers->items[i].scene);
}

void gn_show_list_modes(struct gn_show *s, int scene) {
    const struct gn_options *o = s->config.options;
    const struct gn_scene_list *list = &o->all[0].scene.list;
    s->modes = (struct gn_show_modes){.base = -1};
    s->scenes.count = s->scenes.listed = list->count > 0 ? list->count : 1;
    for (int i = 0; i < s->scenes.count; i++) s->scenes.paths[i] = list->paths[i];
    for (int i = 0; i < o->mode_count; i++)
        add_mode(&s->modes, o->modes[i].name, o->modes[i].name, 1 + i);
    if (gn_show_offers(s, o))
        list_offers(s, scene);
    else if (o->mode_count == 0)
        list_techniques(s);
    s->modes.first = s->modes.offered ? first_offer(s) : mode_or_base(&s->modes, o->settings->mode);
    s->screen.rules = (struct gn_kiosk_rules){.mode_count = s->modes.count,
                                              .scene_count = s->scenes.listed,
                                              .first_mode = mode_or_base(&s->modes, o->home),
                                              .passed_by = s->modes.passed_by};
    if (s->modes.offered) set_offer_rules(&s->modes.offers, &s->screen.rules);
    gn_show_take_rules(&s->screen);
    for (int i = 0; i < s->modes.count && !s->modes.offered; i++) {
        const struct gn_settings *mode = gn_show_settings(s, i);
        if (gn_settings_from(mode, scene.path) == GN_SOURCE_MODE)
            s->screen.rules.own_scene[i] = (uint8_t)(1 + find_scene(&s->scenes, mode->scene.path));
        if (gn_settings_from(mode, scene.camera) == GN_SOURCE_MODE)
            s->screen.rules.own_camera |= 1u << i;
    }
}

void gn_show_list_again(struct gn_show_screen *s) {
    struct gn_show *show = s->show;
    struct gn_err unused = {0};
    if (!show->modes.offered) return;
    gn_show_list_modes(show, s->scene);
    s->kiosk.shown = s->kiosk.wanted =
        (struct gn_kiosk_place){.mode = show->modes.first, .scene = s->scene};
    s->kiosk.camera = s->kiosk.bad_modes = 0;
    gn_show_build_looks(show, s->stage.scene, &s->looks,
                        &unused); /* as when it was loaded: not false */
}

/* ---- one of them ---- */

const struct gn_settings *gn_show_settings(const struct gn_show *s, int mode) {
    return &s->config.options->all[s->modes.settings[mode]];
}

bool gn_show_build_looks(const struct gn_show *s, const struct gn_scene *scene,
                         struct gn_show_looks *looks, struct gn_err *err) {
    looks->ready = looks->made = 0;
    for (int i = 0; i < s->modes.count; i++) {
        const struct gn_settings *settings = gn_show_settings(s, i);
        if (!gn_stage_look_build(&looks->of[i], settings, scene, s->warnings, err)) return false;
        if (s->modes.offered)
            gn_offer_apply(&s->modes.offers.items[i], settings, scene, &looks->of[i]);
    }
    return true;
}

/* They are not where they would be had the pose gone on. */
static bool clips_jump(const struct gn_pose *pose, const struct gn_stage_look *look, int over,
                       const struct gn_kiosk_view *view) {
    const bool replays = over >= 0 && view->clip_ns < pose->at.over_ns;
    return look->clips != pose->at.clips || over != pose->at.over || replays ||
           (pose->animated && (look->run.turns != pose->at.run.turns ||
                               look->run.speed_less_1 != pose->at.run.speed_less_1 ||
                               look->run.start_ns != pose->at.run.start_ns ||
                               view->clips_begun_ns != pose->at.begun_ns));
}

/* From what is shown to what these clips make of it, in [kiosk] clip_fade. */
static void choose_clips(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                         int64_t seen_ns) {
    const struct gn_stage_look *look = &s->looks.of[view->mode];
    struct gn_pose *pose = &s->stage.pose;
    const bool plays =
        view->clip >= 0 && (uint32_t)view->clip < s->stage.scene->animation.clip_count;
    const int clips = look->clips, over = plays ? view->clip : -1;
    const int64_t fade_ns = s->stage.settings->kiosk.clip_fade_ns;
    const bool was_seen = s->clips_of == s->stage.scene && s->show->counts.frames > 0;
    s->clips_of = s->stage.scene;
    const bool jumps = clips_jump(pose, look, over, view);
    pose->at.run = look->run;
    pose->at.begun_ns = view->clips_begun_ns;
    if (jumps) {
        s->clips_begun_ns = seen_ns;
        if (fade_ns > 0 && was_seen)
            gn_pose_choose_fading(pose, clips, over);
        else
            gn_pose_choose_over(pose, clips, over);
    } else if (pose->at.fade < 1) {
        const double share =
            fade_ns > 0 ? (double)(seen_ns - s->clips_begun_ns) / (double)fade_ns : 1;
        if (share >= 1)
            gn_pose_choose_over(pose, clips, over);
        else
            pose->at.fade = share > 0 ? (float)share : 0;
    }
    pose->at.over_ns = view->clip_ns;
}

void gn_show_enter(struct gn_show_screen *s) {
    const struct gn_stage_look *look = &s->looks.of[s->kiosk.shown.mode];
    s->stage.settings = gn_show_settings(s->show, s->kiosk.shown.mode);
    gn_view_enter(&s->stage.shown, &look->frame_opts);
    /* the last frame is of the time at which it is seen, which may be later */
    const int64_t loop_ns = gn_loop_now_ns(s->show->loop),
                  now_ns = loop_ns > s->kiosk.seen_ns ? loop_ns : s->kiosk.seen_ns;
    const struct gn_kiosk_view view = gn_kiosk_view(&s->rules, &s->kiosk, now_ns);
    choose_clips(s, &view, now_ns);
    gn_pose_choose_variant(&s->stage.pose, look->variant);
    s->ahead.keeps = s->ahead.idle = false;
    s->changed = true;
}

void gn_show_take_view(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                       int64_t seen_ns) {
    const struct gn_stage_look *look = &s->looks.of[view->mode];
    struct gn_frame_opts *f = &s->stage.shown.opts;
    choose_clips(s, view, seen_ns);
    const uint32_t camera =
        ((uint32_t)look->frame_opts.view.camera + view->camera) % s->stage.scene->camera_count;
    if ((uint32_t)f->view.camera != camera) f->view.orbit = (struct gn_orbit){0};
    f->view.camera = (int)camera;
    f->view.light_plus_1 =
        camera == (uint32_t)look->frame_opts.view.camera ? look->frame_opts.view.light_plus_1 : 0;
}
