/* Texts on the picture: captions of changes, the information page, and a problem of the
 * configuration as long as it lasts. */
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "core/file.h"
#include "core/text.h"
#include "core/turn.h"
#include "kiosk/private.h"

void gn_show_open_captions(struct gn_show_screen *s) {
    const struct gn_captions_opts opts = {
        .font = s->stage.settings->render.font, .warnings = s->show->warnings, .rises = true};
    gn_captions_destroy(s->text.captions);
    s->text.captions = gn_captions_create(&opts);
    s->text.view = (struct gn_kiosk_view){0};
    s->text.since_ns = 0;
    s->text.card[0] = '\0';
    struct gn_err why = {0};
    if (!opts.font || gn_captions_open_font(s->text.captions, &why)) return;
    char text[sizeof why.text + 64];
    gn_fail_prefix(&why, "%s", gn_settings_label(s->stage.settings, render.font));
    snprintf(text, sizeof text, "%s (texts are shown in the built-in font)", why.text);
    gn_show_report_error(s->show, GN_PROBLEM_FONT, text);
}

const char *gn_show_path_name(const char *path) {
    return path ? gn_file_name(path) : "default scene";
}

/* As people call it: a file's name without what follows the last dot. */
static const char *write_title(const char *path, char out[120]) {
    gn_text_format(out, 120, "%s", path ? gn_file_name(path) : "Sundial");
    char *dot = strrchr(out, '.');
    if (dot && dot > out) *dot = '\0';
    return out;
}

/* What config_error has; false: nothing. An error of run time (keep_old() of reload.c,
 * gn_show_report_error()) stands in s->config with its words, one of the start in the options. */
static bool find_lasting(const struct gn_show *s, const struct gn_problem_words **words,
                         const char **shown) {
    const struct gn_options *o = s->config.options;
    const bool is_of_run = o->config_error == s->config.error;
    const char *text = is_of_run ? s->config.shown : o->config_shown;
    *words = &gn_problem_words[is_of_run ? s->config.kind : GN_PROBLEM_CONFIG];
    *shown = text ? text : "";
    return o->config_error;
}

/* ---- loading ---- */

static const int64_t PATIENCE_NS = GN_NS_PER_S / 10; /* shorter loads have no bar */

/* The first load, and others that take long. */
static bool is_loading(const struct gn_show_screen *s, int64_t now_ns) {
    if (s->show->reload.first) return true;
    const bool works = gn_loader_number(s->show->scenes.loader) >= 0 || s->staged.loaded;
    return s->rules.caption_ns > 0 && works && now_ns - s->show->scenes.load_begun_ns > PATIENCE_NS;
}

static const char *loading_path(const struct gn_show_screen *s) {
    const int loads = gn_loader_number(s->show->scenes.loader),
              number = loads < 0 && s->staged.loaded ? s->staged.loaded->number : loads;
    if (s->show->reload.options && (s->show->reload.first || number == GN_SHOW_RELOAD))
        return s->show->reload.options->settings->scene.path;
    return s->show->scenes.paths[number >= 0 ? number : s->scene];
}

static const double UPLOAD_SHARE = 0.2; /* the bar's last part */

/* -1: no bar. */
static int progress_percent(const struct gn_show_screen *s, int64_t now_ns) {
    const double done = gn_loader_progress(s->show->scenes.loader);
    const struct gn_show_staged *staged = &s->staged;
    if (!is_loading(s, now_ns)) return -1;
    if (done >= 0.0) return (int)(100.0 * (1.0 - UPLOAD_SHARE) * done);
    const bool ends = staged->whole || staged->sent >= staged->all;
    const double sent = !staged->loaded || staged->all == 0 ? 0.0
                        : ends                              ? 1.0
                               : (double)staged->sent / (double)staged->all;
    return (int)(100.0 * (1.0 - UPLOAD_SHARE * (1.0 - sent)));
}

bool gn_show_bar_moves(const struct gn_show_screen *s) {
    return progress_percent(s, gn_loop_now_ns(s->show->loop)) != s->text.bar;
}

/* A split screen names both of its modes as long as it is on. */
static bool has_labels(const struct gn_show_screen *s) {
    return s->split.on && s->rules.caption_ns > 0;
}

static void write_labels(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                         int64_t now_ns) {
    const struct gn_show_modes *modes = &s->show->modes;
    const bool waits = s->kiosk.wanted.mode != view->mode; /* its picture is not there yet */
    char right[160] = "";
    if (has_labels(s))
        snprintf(right, sizeof right, "%s%s",
                 s->truth.on ? gn_techniques[GN_TECHNIQUE_TRUTH].title
                             : modes->titles[s->kiosk.wanted.mode],
                 waits ? " .." : "");
    gn_captions_set_split(s->text.captions, has_labels(s) ? s->split.at : -1.0);
    gn_captions_set(s->text.captions, GN_CAPTION_LEFT,
                    right[0] ? modes->titles[s->split.left] : NULL, now_ns);
    gn_captions_set(s->text.captions, GN_CAPTION_RIGHT, right, now_ns);
}

static const char *mode_text(const struct gn_show_screen *s, const struct gn_kiosk_view *view,
                             char *out, size_t size) {
    const struct gn_show_modes *modes = &s->show->modes;
    const char *title = modes->titles[view->caption_mode];
    const bool waits = view->mode != view->caption_mode, /* the picture is not of that yet */
        only = modes->count == 1 && !s->rules.names_first && !s->rules.replays;
    snprintf(out, size, "%s%s", title, waits ? " .." : only ? ": there is only this view" : "");
    return out;
}

/* NULL: the change has no caption. */
static const char *change_text(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                               const struct gn_info *info) {
    struct gn_show_text *t = &s->text;
    char title[120];
    switch (view->caption) {
    case GN_KIOSK_CAPTION_MODE:
        if (has_labels(s)) return NULL;
        return mode_text(s, view, t->change, sizeof t->change);
    case GN_KIOSK_CAPTION_SCENE:
        snprintf(t->change, sizeof t->change, "%s%s",
                 write_title(s->show->scenes.paths[view->caption_scene], title),
                 view->scene != view->caption_scene ? " .." : "");
        return t->change;
    case GN_KIOSK_CAPTION_CAMERA:
        return s->stage.scene->added.camera
                   ? "There is only this view"
                   : s->stage.scene->cameras[s->stage.shown.opts.view.camera].name;
    case GN_KIOSK_CAPTION_NOTE: return s->viewer.note;
    case GN_KIOSK_CAPTION_PROBLEM: {
        const enum gn_problem kind = gn_problem_last_kind(&s->show->problems);
        return kind < GN_PROBLEM_COUNT ? gn_problem_words[kind].title : NULL;
    }
    case GN_KIOSK_CAPTION_SUN: return info->sun;
    case GN_KIOSK_CAPTION_PAUSE: return view->stands ? "Paused" : NULL;
    default: return NULL;
    }
}

/* What lasts: a card of it for a while, then a mark. */
static void write_card(struct gn_show_screen *s, int64_t now_ns) {
    struct gn_show_text *t = &s->text;
    const struct gn_problem_words *words;
    const char *shown;
    char card[sizeof t->card] = "";
    if (find_lasting(s->show, &words, &shown))
        gn_text_add(card, sizeof card, "%s\n%s%s%s", words->title, shown, *shown ? "\n" : "",
                    words->advice);
    if (strcmp(card, t->card) == 0) return;
    memcpy(t->card, card, sizeof card);
    gn_captions_set(t->captions, GN_CAPTION_CARD, card, now_ns);
    gn_captions_set(t->captions, GN_CAPTION_MARK, card[0] ? "!" : NULL, now_ns);
}

/* The information page, or the help page over it. */
static void write_page(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                       struct gn_info *info, int64_t now_ns) {
    struct gn_show_text *t = &s->text;
    const enum gn_problem kind = gn_problem_last_kind(&s->show->problems);
    if (!find_lasting(s->show, &info->problem, &info->shown))
        info->problem = kind < GN_PROBLEM_COUNT ? &gn_problem_words[kind] : NULL;
    if (t->help[0] || !view->info) {
        t->page.made = false;
        gn_captions_set(t->captions, GN_CAPTION_INFO, t->help, now_ns);
    } else if (gn_info_page_step(&t->page, info, now_ns)) {
        gn_captions_set(t->captions, GN_CAPTION_INFO, t->page.text, now_ns);
    }
}

/* While something loads, that; else the moment of the sun, if it is asked for. */
static void write_lasting(struct gn_show_screen *s, const struct gn_info *info, int64_t now_ns) {
    struct gn_show_text *t = &s->text;
    const bool loads = is_loading(s, now_ns), dates = s->stage.settings->sun.caption;
    char text[200] = "", title[120];
    if (loads && s->stage.display.ops->is_window) /* a visitor reads no names of files */
        snprintf(text, sizeof text, "Loading %s ..", write_title(loading_path(s), title));
    else if (!loads && dates && info->sun)
        snprintf(text, sizeof text, "%s", info->sun);
    t->bar = progress_percent(s, now_ns);
    gn_captions_set(t->captions, GN_CAPTION_TEXT, text, now_ns);
    gn_captions_set_bar(t->captions, loads ? t->bar * .01 : -1.0, now_ns);
}

/* The caption of a change is set when it begins, and ends by itself when it can have been read. */
static void write_change(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                         const struct gn_info *info, int64_t now_ns) {
    struct gn_show_text *t = &s->text;
    const int64_t least_ns = view->caption == GN_KIOSK_CAPTION_PROBLEM ? 5 * s->rules.caption_ns
                             : view->caption == GN_KIOSK_CAPTION_NOTE && s->viewer.note_ns > 0
                                 ? s->viewer.note_ns
                                 : s->rules.caption_ns;
    if (view->caption == t->view.caption && s->kiosk.caption_begun_ns == t->since_ns) return;
    t->view = *view;
    t->since_ns = s->kiosk.caption_begun_ns;
    if (view->caption == GN_KIOSK_CAPTION_NONE && s->rules.caption_ns > 0) return;
    gn_captions_set_least(t->captions, least_ns);
    gn_captions_set(t->captions, GN_CAPTION_MODE, change_text(s, view, info), now_ns);
}

static struct gn_turned_size upright(const struct gn_frame_output_opts *o) {
    return gn_turned_upright(o->turn_deg, o->width_px, o->height_px);
}

const struct gn_caption_run *gn_show_sample_captions(const struct gn_show_screen *s) {
    const struct gn_turned_size size = upright(&s->stage.shown.opts.output);
    return gn_captions_sample(s->text.captions, size.width_px, size.height_px);
}

void gn_show_write_captions(struct gn_show_screen *s, const struct gn_kiosk_view *view,
                            int64_t now_ns) {
    struct gn_show_text *t = &s->text;
    struct gn_frame_opts *f = &s->stage.shown.opts;
    const struct gn_turned_size size = upright(&f->output);
    char title[120];
    struct gn_info info = {
        .scene = write_title(s->show->scenes.paths[view->scene], title),
        .mode = s->show->modes.titles[view->mode],
        .missing = s->stage.scene ? s->stage.scene->missing : NULL,
        .screen = &s->stage.display.screen,
        .caps = gn_gl_caps(s->stage.gl),
        .uptime_ns = now_ns - s->show->counts.begun_ns,
    };
    gn_parts_add_info(&s->show->parts, &info);
    write_lasting(s, &info, now_ns);
    write_card(s, now_ns);
    write_labels(s, view, now_ns);
    write_change(s, view, &info, now_ns);
    write_page(s, view, &info, now_ns);
    f->cover.captions = gn_captions_run(t->captions, size.width_px, size.height_px, now_ns);
}

/* The information page is updated once a second. */
int64_t gn_show_captions_due_ns(const struct gn_show_screen *s) {
    const int64_t next_ns = gn_captions_next_ns(s->text.captions),
                  page_ns = s->text.page.made ? s->text.page.made_ns + GN_NS_PER_S : INT64_MAX;
    return next_ns < page_ns ? next_ns : page_ns;
}

int64_t gn_show_bar_due_ns(const struct gn_show_screen *s) {
    const bool loads = s->text.bar >= 0 || gn_loader_number(s->show->scenes.loader) >= 0;
    const bool shows = s->stage.display.screen.lit && !s->drawn.dark;
    return loads && shows ? gn_loop_now_ns(s->show->loop) + PATIENCE_NS : INT64_MAX;
}
