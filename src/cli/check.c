/* gnomon show --check FILE: the configuration as show would read it, and all that it names looked
 * at: scenes are loaded, cameras and clips found in them. Then it says what a kiosk would make of
 * it. */
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "options/args.h"
#include "options/binding.h"
#include "options/value.h"
#include "stage/stage.h"

enum { SCENES_MAX = GN_SCENES_MAX + GN_MODES_MAX };

struct check {
    struct gn_warnings *warnings;
    struct gn_scene_limits limits;
    const char *paths[SCENES_MAX];
    struct gn_scene *scenes[SCENES_MAX];
    int scene_count;
};

/* ---- scenes --------------------------------------------------------------------------------- */

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* Loaded once, however many modes show it. */
static const struct gn_scene *scene_of(struct check *c, const struct gn_settings *settings,
                                       const char *path, struct gn_err *err) {
    for (int i = 0; i < c->scene_count; i++)
        if (same_text(c->paths[i], path)) return c->scenes[i];
    struct gn_scene *scene = gn_stage_read(path, &c->limits, c->warnings, err);
    if (!scene) {
        gn_fail_prefix(err, "%s", gn_settings_label(settings, scene.path));
        return NULL;
    }
    c->paths[c->scene_count] = path;
    c->scenes[c->scene_count++] = scene;
    return scene;
}

static bool has_plane(const struct gn_scene *scene) {
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].plane && scene->items[i].receives) return true;
    return false;
}

static bool check_technique(const struct gn_settings *settings, const struct gn_stage_look *look,
                            const struct gn_scene *scene, struct gn_err *err) {
    const struct gn_frame_opts *f = &look->frame_opts;
    if (!f->shadow.technique_given || !gn_techniques[f->shadow.technique].on_plane ||
        has_plane(scene))
        return true;
    return gn_fail(err, "%s: %s needs a plane, and nothing in %s is one; gnomon_plane names it",
                   gn_settings_label(settings, render.shadow),
                   gn_techniques[f->shadow.technique].name, scene->name);
}

/* One mode's settings, on one scene. */
static bool check_look(struct check *c, const struct gn_settings *settings, const char *path,
                       struct gn_err *err) {
    struct gn_stage_look look;
    const struct gn_scene *scene = scene_of(c, settings, path, err);
    return scene && gn_stage_look(&look, settings, scene, c->warnings, err) &&
           check_technique(settings, &look, scene, err);
}

/* Of several scenes that next-scene goes through one will do: a camera may be in that one alone. */
static bool check_looks(struct check *c, const struct gn_settings *settings, struct gn_err *err) {
    const struct gn_scene_list *list = &settings->scene.list;
    struct gn_err why = {0};
    for (int i = 0; i < list->count; i++)
        if (!scene_of(c, settings, list->paths[i], err)) return false;
    if (check_look(c, settings, list->paths[0], err)) return true;
    for (int i = 1; i < list->count; i++)
        if (check_look(c, settings, list->paths[i], &why)) {
            *err = (struct gn_err){0};
            return true;
        }
    return false;
}

static bool check_all(struct check *c, const struct gn_options *o, struct gn_err *err) {
    if (!gn_stage_limits(o->settings, &c->limits, err) || !check_looks(c, o->settings, err))
        return false;
    for (int i = 0; i < o->mode_count; i++)
        if (!check_looks(c, &o->all[1 + i], err)) return false;
    return true;
}

/* ---- what it makes -------------------------------------------------------------------------- */

static void print_setting(const struct gn_option_row *row, const void *value, int count) {
    char key[64], text[1024];
    gn_value_text(row, value, text, sizeof text);
    printf("%s%s = %s", count ? ", " : "", gn_option_key(row, key, sizeof key), text);
}

static void print_sections(const struct gn_settings *o) {
    static const char *const sections[] = {"display", "scene", "render", "kiosk"};
    for (size_t s = 0; s < sizeof sections / sizeof sections[0]; s++) {
        int count = 0;
        for (int i = 0; i < GN_OPTION_COUNT; i++) {
            const struct gn_option_row *row = &gn_option_rows[i];
            if (!row->section || strcmp(row->section, sections[s]) != 0 ||
                o->source[i] == GN_SOURCE_DEFAULT)
                continue;
            if (count == 0) printf("[%s] ", sections[s]);
            print_setting(row, gn_settings_value(o, row), count++);
        }
        if (count) putchar('\n');
    }
}

static void print_modes(const struct gn_options *o) {
    if (o->mode_count == 0) puts("modes: the techniques, one after the other");
    for (int i = 0; i < o->mode_count; i++) {
        const struct gn_mode *mode = &o->modes[i];
        printf("mode \"%s\": ", mode->name);
        int count = 0;
        for (const struct gn_override *set = mode->first; set; set = set->next)
            print_setting(set->row, set->value, count++);
        puts(count ? "" : "nothing of its own");
    }
}

static void print_button(const struct gn_button_config *button) {
    static const char *const gestures[GN_GESTURE_COUNT] = {
        [GN_GESTURE_PRESS] = "press",   [GN_GESTURE_CLICK] = "click",
        [GN_GESTURE_DOUBLE] = "double", [GN_GESTURE_HOLD] = "hold",
        [GN_GESTURE_REPEAT] = "repeat", [GN_GESTURE_CHORD] = "together",
    };
    const struct gn_button_opts *o = &button->opts;
    printf("button \"%s\":", o->name);
    if (o->line) printf(" line %s", o->line);
    if (o->keys) printf("%s keys %s", o->line ? "," : "", o->keys);
    if (o->chord) printf(" %s", o->chord);
    int count = 0;
    for (int g = 0; g < GN_GESTURE_COUNT; g++) {
        const struct gn_binding *on = &button->on[g];
        if (!on->bound) continue;
        printf("%s %s = %s%s%s", count++ ? "," : ";", gestures[g], gn_action_name(on->action.kind),
               on->action.name ? " " : "", on->action.name ? on->action.name : "");
    }
    putchar('\n');
}

static void print_buttons(const struct gn_options *o) {
    struct gn_buttons defaults;
    gn_buttons_defaults(&defaults);
    const struct gn_buttons *buttons = o->buttons ? o->buttons : &defaults;
    if (!o->buttons) puts("no buttons in the file, so there are:");
    for (int i = 0; i < buttons->count; i++) print_button(&buttons->items[i]);
}

static void print_check(const struct check *c, const struct gn_options *o) {
    printf("%s is valid: %d mode%s, %d button%s, %d scene%s\n", o->config_path, o->mode_count,
           o->mode_count == 1 ? "" : "s", o->buttons ? o->buttons->count : 0,
           o->buttons && o->buttons->count == 1 ? "" : "s", c->scene_count,
           c->scene_count == 1 ? "" : "s");
    print_sections(o->settings);
    print_modes(o);
    print_buttons(o);
}

bool gn_cli_check(const struct gn_options *options, struct gn_warnings *warnings,
                  struct gn_err *err) {
    struct check c = {.warnings = warnings};
    struct gn_options again;
    bool ok = gn_args_parse(&again, options->argc, options->argv, NULL, err);
    if (ok) gn_options_run_as(&again, GN_COMMAND_RENDER); /* a missing camera or clip is an error */
    ok = ok && check_all(&c, &again, err);
    if (ok) print_check(&c, options);
    for (int i = 0; i < c.scene_count; i++) gn_scene_destroy(c.scenes[i]);
    gn_options_finish(&again);
    return ok;
}
