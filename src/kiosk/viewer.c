/* Keys of a window. Those that kiosk.ini gives to a button are that button's. */
#include "kiosk/viewer.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "core/clock.h"
#include "core/text.h"
#include "kiosk/private.h"
#include "options/command.h"
#include "options/viewer_keys.h"

static const int64_t HOLD_NS = GN_NS_PER_S / 4; /* an arrow that is down longer turns on */
static const int64_t HINT_NS = 4 * GN_NS_PER_S;
static const float STEP = 1.0f / 24; /* turn by a press, in heights of the window */
static const float TURN_PER_S = 0.5f;

/* ---- the help page ---- */

/* Keys of a button but those that the viewer takes first. */
static void add_button(const struct gn_button_config *button, char *out, size_t size) {
    const char *comma = "";
    char name[40];
    int place;
    for (const char *at = button->opts.keys; at && gn_text_word(&at, name, sizeof name);) {
        const unsigned key = gn_key_find(name); /* a window has no knobs and taps */
        if (key >= GN_KEY_KNOB_LEFT || gn_viewer_key_find(key, &place)) continue;
        gn_text_add(out, size, "%s%s", comma, name);
        comma = ", ";
    }
    const int command = gn_ctl_find(gn_action_name(button->on[GN_GESTURE_PRESS].action.kind));
    if (*comma)
        gn_text_add(out, size, "\t%s\n",
                    command >= 0 ? gn_ctl_rows[command].what : "another action");
}

/* A title, then groups: a heading, rows, an empty line. */
static void show_help(struct gn_show_screen *s, bool on) {
    char *out = s->text.help;
    const size_t size = sizeof s->text.help;
    s->viewer.helps = on;
    *out = 0;
    if (on) gn_text_add(out, size, "Keys\n");
    for (const struct gn_viewer_key *row = gn_viewer_keys; on && row->name; row++) {
        if (row->group)
            gn_text_add(out, size, "%s%s\n", row == gn_viewer_keys ? "" : "\n", row->group);
        gn_text_add(out, size, "%s\t%s\n", row->name, row->meaning);
    }
    if (on && s->show->buttons.map.count > 0) gn_text_add(out, size, "\nButtons\n");
    for (int i = 0; on && i < s->show->buttons.map.count; i++)
        add_button(&s->show->buttons.map.items[i], out, size);
    s->changed = true;
}

/* ---- commands ---- */

/* The reason is for the terminal. */
static void show_failure(struct gn_show_screen *s, const char *what, const struct gn_err *err) {
    fprintf(stderr, "gnomon: warning: %s\n", err->text);
    gn_show_note(s, "%s", what);
}

static void choose_camera(struct gn_show_screen *s, int number) {
    const uint32_t count = s->stage.scene->camera_count, place = (uint32_t)number;
    const struct gn_frame_opts *look = &s->looks.of[s->kiosk.shown.mode].frame_opts;
    const uint32_t camera = (place + count - (uint32_t)look->view.camera % count) % count;
    if (place < count)
        gn_show_send(s, (struct gn_kiosk_event){.kind = GN_KIOSK_CAMERA, .camera = camera});
    else
        gn_show_note(s, "The scene has %u camera%s", count, count == 1 ? "" : "s");
}

static void change_speed(struct gn_show_screen *s, int by) {
    gn_show_send(s, (struct gn_kiosk_event){.kind = GN_KIOSK_SPEED, .by = by});
    if (s->kiosk.speed >= 0)
        gn_show_note(s, s->kiosk.speed ? "Speed x%d" : "Normal speed", 1 << s->kiosk.speed);
    else
        gn_show_note(s, "Speed 1/%d", 1 << -s->kiosk.speed);
}

static bool set_option(struct gn_show_screen *s, const char *key, const char *value) {
    struct gn_err err = {0};
    if (gn_show_set_option(s, gn_changes_find(key, &err), value, &err)) return true;
    show_failure(s, "That cannot be changed", &err);
    return false;
}

/* One that is shown becomes none, else the studio: of less strength beside a scene's own lights,
 * unless the settings have one. */
static void change_environment(struct gn_show_screen *s) {
    const bool shown = s->looks.of[s->kiosk.shown.mode].frame_opts.environment.of;
    const bool adds = !shown && s->stage.scene->light_count > 0 && !s->stage.scene->added.light;
    const char *next = shown ? "none" : "studio";
    if (adds && !gn_settings_given(s->stage.settings, render.environment_strength) &&
        !set_option(s, "environment-strength", "0.35"))
        return;
    if (set_option(s, "environment", next)) gn_show_note(s, "Environment: %s", next);
}

/* All, as the scene begins, then each, then none. */
static void choose_clip(struct gn_show_screen *s) {
    const struct gn_scene *scene = s->stage.scene;
    const int count = (int)scene->animation.clip_count,
              now = s->looks.of[s->kiosk.shown.mode].clips,
              next = now == GN_POSE_NONE      ? 0
                     : now == GN_POSE_DEFAULT ? 0
                                              : now + 1;
    char value[16];
    snprintf(value, sizeof value, "%d", next);
    if (count == 0)
        gn_show_note(s, "The scene has no clips");
    else if (set_option(s, "animation", next < count ? value : "none"))
        gn_show_note(s, "Clip: %s", next < count ? scene->animation.clips[next].name : "none");
}

/* ---- screenshots ---- */

static void finish_screenshot(void *user, int64_t now_ns) {
    struct gn_show_screen *s = user;
    struct gn_err err = {0};
    bool ok;
    (void)now_ns;
    if (!gn_screenshot_take(s->viewer.screenshot, &ok, &err)) return;
    if (ok)
        gn_show_note(s, "Saved %s", s->viewer.screenshot_path);
    else
        show_failure(s, "The picture could not be saved", &err);
}

/* The first free gnomon-SCENE-NNN.png. */
static bool choose_path(const struct gn_show_screen *s, char *path, size_t size) {
    const char *name = gn_show_path_name(s->show->scenes.paths[s->scene]),
               *dot = strrchr(name, '.');
    const int length = dot && dot > name ? (int)(dot - name) : (int)strlen(name);
    for (int i = 1; i < 1000; i++) {
        struct stat info;
        snprintf(path, size, "gnomon-%.*s-%03d.png", length, name, i);
        for (char *c = path; *c; c++)
            if (*c == ' ' || *c == ':') *c = '-'; /* "default scene" */
        if (lstat(path, &info) != 0 && errno == ENOENT) return true;
    }
    return false;
}

static void write_screenshot(struct gn_show_screen *s) {
    struct gn_show_viewer *v = &s->viewer;
    struct gn_err err = {0};
    if (v->screenshot && gn_screenshot_is_busy(v->screenshot)) return;
    if (!v->screenshot)
        v->screenshot = gn_screenshot_create(s->show->loop, finish_screenshot, s, &err);
    if (!v->screenshot) {
        show_failure(s, "The picture could not be saved", &err);
    } else if (!choose_path(s, v->screenshot_path, sizeof v->screenshot_path)) {
        gn_show_note(s, "Not saved: this folder has 999 pictures of this scene, or cannot be read");
    } else {
        gn_screenshot_ask(v->screenshot, v->screenshot_path, -1);
        s->changed = true;
    }
}

/* ---- keys ---- */

static void run_command(struct gn_show_screen *s, enum gn_viewer_command command, int place) {
    switch (command) {
    case GN_VIEWER_HELP: show_help(s, true); break;
    case GN_VIEWER_CAMERA: choose_camera(s, place); break;
    case GN_VIEWER_ENVIRONMENT: change_environment(s); break;
    case GN_VIEWER_CLIP: choose_clip(s); break;
    case GN_VIEWER_SLOWER: change_speed(s, -1); break;
    case GN_VIEWER_FASTER: change_speed(s, 1); break;
    case GN_VIEWER_SPLIT: gn_split_toggle(s); break;
    case GN_VIEWER_TRUTH: gn_split_toggle_truth(s); break;
    case GN_VIEWER_SCREENSHOT: write_screenshot(s); break;
    case GN_VIEWER_RELOAD:
        gn_show_note(s, "Loading again ..");
        s->show->wants_reload = true;
        break;
    default: break;
    }
}

/* The first key on a dark screen switches it on, and one on the help page ends that: nothing else.
 */
static bool only_wakes(struct gn_show_screen *s) {
    const struct gn_action wake = {.kind = GN_ACTION_BLANK, .turn = GN_TURN_OFF};
    if (gn_kiosk_is_dark(&s->kiosk))
        gn_show_act(s, &wake, gn_loop_now_ns(s->show->loop));
    else if (s->viewer.helps)
        show_help(s, false);
    else
        return false;
    return true;
}

static void turn(struct gn_pointer *pointer, unsigned arrows, float by) {
    pointer->turn[0] += by * (float)((int)(arrows >> 1 & 1) - (int)(arrows & 1));
    pointer->turn[1] += by * (float)((int)(arrows >> 2 & 1) - (int)(arrows >> 3 & 1));
}

static void take_arrow(struct gn_show_screen *s, struct gn_pointer *pointer, int place, bool down) {
    struct gn_show_viewer *v = &s->viewer;
    v->held &= ~(1u << place);
    if (!down) return;
    turn(pointer, 1u << place, STEP);
    v->held |= 1u << place;
    v->turned_ns = gn_loop_now_ns(s->show->loop) + HOLD_NS;
}

void gn_viewer_take_keys(struct gn_show_screen *s, struct gn_pointer *pointer) {
    struct gn_show_viewer *v = &s->viewer;
    const struct gn_buttons *own = s->show->config.options->buttons;
    const int64_t now_ns = gn_loop_now_ns(s->show->loop);
    unsigned kept = 0;
    if (pointer->key_count > 0 || v->held) s->kiosk.used_ns = now_ns;
    for (unsigned i = 0; i < pointer->key_count; i++) {
        const struct gn_key_event event = pointer->keys[i];
        int place = 0;
        const struct gn_viewer_key *row = gn_viewer_key_find(event.key, &place);
        if (!row) row = gn_viewer_letter_find(pointer->letters[i]);
        if (own && gn_buttons_have_key(own, event.key)) row = NULL;
        if (event.down && (row || v->helps) && only_wakes(s)) continue;
        if (!row && event.key)
            pointer->keys[kept++] = event;
        else if (row && row->command == GN_VIEWER_ORBIT)
            take_arrow(s, pointer, place, event.down);
        else if (row && event.down)
            run_command(s, row->command, place);
    }
    pointer->key_count = kept;

    /* arrows that are held down */
    if (!v->held || now_ns <= v->turned_ns) return;
    turn(pointer, v->held, TURN_PER_S * (float)((double)(now_ns - v->turned_ns) * 1e-9));
    v->turned_ns = now_ns;
}

/* Not where a button has the key, and after what else is to be read first. */
void gn_viewer_hint(struct gn_show_screen *s) {
    const struct gn_buttons *own = s->show->config.options->buttons;
    struct gn_show_viewer *v = &s->viewer;
    if (v->hinted || s->show->reload.first || s->kiosk.seen_ns == 0 || s->kiosk.caption) return;
    v->hinted = true;
    if (own && gn_buttons_have_key(own, gn_key_find("h"))) return;
    gn_show_note(s, "Press h for help");
    v->note_ns = HINT_NS;
}

int64_t gn_viewer_due_ns(const struct gn_show_screen *s) {
    const bool turns = s->viewer.held && s->stage.display.screen.may_draw;
    return turns ? s->viewer.turned_ns : INT64_MAX;
}

void gn_viewer_set_title(struct gn_show_screen *s) {
    char title[sizeof s->viewer.title];
    const char *path = s->show->reload.first ? s->show->reload.options->settings->scene.path
                                             : s->show->scenes.paths[s->scene];
    snprintf(title, sizeof title, "%.150s - gnomon", gn_show_path_name(path));
    if (strcmp(title, s->viewer.title) == 0) return;
    snprintf(s->viewer.title, sizeof s->viewer.title, "%s", title);
    gn_display_set_title(&s->stage.display, title);
}

void gn_viewer_close(struct gn_show_screen *s) {
    gn_screenshot_destroy(s->viewer.screenshot);
    s->viewer.screenshot = NULL;
}
