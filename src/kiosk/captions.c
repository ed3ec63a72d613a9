/* Texts on the picture: captions of changes, the information page, and a problem of the
 * configuration as long as it lasts. */
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"

void gn_show_open_captions(struct gn_show *s) {
    const struct gn_captions_opts opts = {.font = s->stage.settings->render.font,
                                          .warnings = s->warnings};
    gn_captions_destroy(s->text.captions);
    s->text.captions = gn_captions_create(&opts);
    s->text.view = (struct gn_kiosk_view){0};
    s->text.since_ns = 0;
}

/* The last part of the path; NULL: the built-in scene. */
static const char *scene_name(const struct gn_show *s, int scene) {
    const char *path = s->scenes.paths[scene];
    const char *slash = path ? strrchr(path, '/') : NULL;
    return !path ? "default scene" : slash ? slash + 1 : path;
}

static const char *caption_of(const struct gn_show *s, const struct gn_kiosk_view *view) {
    switch (view->caption) {
    case GN_KIOSK_CAPTION_MODE: return s->modes.names[view->caption_mode];
    case GN_KIOSK_CAPTION_SCENE: return scene_name(s, view->caption_scene);
    case GN_KIOSK_CAPTION_CAMERA:
        return s->stage.scene->cameras[s->stage.frame_opts.view.camera].name;
    case GN_KIOSK_CAPTION_PAUSE: return view->stands ? "pause" : NULL;
    default: return NULL;
    }
}

/* A text is set only when it changes. */
static void write_changes(struct gn_show *s, const struct gn_kiosk_view *view, int64_t now_ns) {
    const char *error = s->config.options->config_error;
    if (!error && view->caption == GN_KIOSK_CAPTION_PROBLEM) error = s->text.problem;
    gn_captions_set(s->text.captions, GN_CAPTION_ERROR, error, now_ns);
    if (view->caption == s->text.view.caption && s->kiosk.caption_ns == s->text.since_ns) return;
    s->text.view = *view;
    s->text.since_ns = s->kiosk.caption_ns;
    gn_captions_set(s->text.captions, GN_CAPTION_MODE, caption_of(s, view),
                    now_ns + s->rules.caption_ns -
                        GN_CAPTION_MODE_NS); /* so that it ends at that time */
}

static void write_page(struct gn_show *s, const struct gn_kiosk_view *view, int64_t now_ns) {
    const struct gn_info info = {
        .scene = scene_name(s, view->scene),
        .mode = s->modes.names[view->mode],
        .screen = &s->stage.display.screen,
        .caps = gn_gl_caps(s->stage.gl),
        .uptime_ns = now_ns - s->counts.begun_ns,
    };
    if (!view->info) {
        s->text.page.made = false;
        gn_captions_set(s->text.captions, GN_CAPTION_INFO, NULL, now_ns);
    } else if (gn_info_page_step(&s->text.page, &info, now_ns))
        gn_captions_set(s->text.captions, GN_CAPTION_INFO, s->text.page.text, now_ns);
}

void gn_show_write_captions(struct gn_show *s, const struct gn_kiosk_view *view, int64_t now_ns) {
    struct gn_frame_opts *f = &s->stage.frame_opts;
    const bool on_side = f->turn_deg / 90 % 2;
    write_changes(s, view, now_ns);
    write_page(s, view, now_ns);
    f->captions_later = true;
    f->captions = gn_captions_run(s->text.captions, on_side ? f->height_px : f->width_px,
                                  on_side ? f->width_px : f->height_px, now_ns);
}

/* The information page is updated once a second. */
int64_t gn_show_captions_due_ns(const struct gn_show *s) {
    const int64_t next_ns = gn_captions_next_ns(s->text.captions),
                  page_ns = s->text.page.made ? s->text.page.made_ns + GN_NS_PER_S : INT64_MAX;
    return next_ns < page_ns ? next_ns : page_ns;
}
