/* gnomon show --check FILE: reads the configuration as show does and checks what it names: loads
 * the scenes, looks for cameras and clips in them; fonts, the socket, devices, folders. Then
 * prints what a kiosk would make of it. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "caption/font.h"
#include "caption/shape.h"
#include "cli/commands.h"
#include "core/file.h"
#include "kiosk/control/listen.h"
#include "options/args.h"
#include "options/binding.h"
#include "options/section.h"
#include "options/value.h"
#include "stage/lights.h"
#include "stage/stage.h"

enum { SCENES_MAX = GN_SCENES_MAX + GN_SECTIONS_MAX };

struct check {
    struct gn_errors *errors;
    struct gn_warnings *warnings;
    struct gn_scene_limits limits;
    const char *paths[SCENES_MAX];
    struct gn_scene *scenes[SCENES_MAX];
    int scene_count;
};

/* An error that was noted before has no text. */
static void note(struct check *c, bool ok, struct gn_err *err) {
    if (!ok && err->text[0]) gn_errors_take(c->errors, err);
}

/* ---- scenes --------------------------------------------------------------------------------- */

/* Loaded once, however many modes show it. NULL without an error: it failed before. */
static const struct gn_scene *scene_of(struct check *c, const struct gn_settings *settings,
                                       const char *path, struct gn_err *err) {
    for (int i = 0; i < c->scene_count; i++)
        if (c->paths[i] == path || (c->paths[i] && path && strcmp(c->paths[i], path) == 0))
            return c->scenes[i];
    struct gn_scene *scene = gn_stage_read(path, &c->limits, c->warnings, err);
    if (!scene) gn_fail_prefix(err, "%s", gn_settings_label(settings, scene.path));
    c->paths[c->scene_count] = path;
    c->scenes[c->scene_count++] = scene;
    return scene;
}

/* One mode's settings, on one scene. */
static bool check_look(struct check *c, const struct gn_settings *settings, const char *path,
                       struct gn_err *err) {
    struct gn_stage_look look;
    const struct gn_scene *scene = scene_of(c, settings, path, err);
    if (!scene || !gn_stage_look_build(&look, settings, scene, c->warnings, err)) return false;
    const struct gn_light_opts *any = &look.frame_opts.shadow.any;
    const struct gn_technique_row *technique = &gn_techniques[any->technique];
    if (!GN_LIGHT_HAS(any, technique) || !technique->on_plane) return true;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].plane && scene->items[i].receives) return true;
    return gn_fail(err, "%s: %s needs a plane, and nothing in %s is one; gnomon_plane names it",
                   gn_settings_label(settings, render.shadow), technique->name, scene->name);
}

/* A list of scenes for next-scene is valid if the settings fit one of them: a camera may be in that
 * one only. */
static bool check_looks(struct check *c, const struct gn_settings *settings, struct gn_err *err) {
    const struct gn_scene_list *list = &settings->scene.list;
    struct gn_err why = {0};
    for (int i = 0; i < list->count; i++) note(c, scene_of(c, settings, list->paths[i], err), err);
    if (check_look(c, settings, list->paths[0], err)) return true;
    for (int i = 1; i < list->count; i++)
        if (check_look(c, settings, list->paths[i], &why)) {
            *err = (struct gn_err){0};
            return true;
        }
    return false;
}

/* Of several scenes none may have a light of that name. */
static void check_lights(struct check *c, const struct gn_settings *s) {
    for (int k = 0; k < s->light_count && s->several_scenes; k++) {
        bool found = false;
        for (int n = 0; n < c->scene_count; n++)
            for (uint32_t i = 0; c->scenes[n] && i < c->scenes[n]->light_count; i++)
                found |= gn_light_section_is_of(&s->lights[k], c->scenes[n], i);
        if (!found)
            gn_warn(c->warnings, "%s: light \"%s\": no scene has a light of that name",
                    s->lights[k].label, s->lights[k].name);
    }
}

/* Each is in one of the scenes at least. */
static bool check_clip(const struct check *c, const char *button, const char *clip,
                       struct gn_err *err) {
    struct gn_err why = {0};
    for (int i = 0; i < c->scene_count; i++)
        if (!c->scenes[i] || gn_scene_find_clip(c->scenes[i], clip, &why) >= 0) return true;
    return gn_fail(err, "button \"%s\": play %s: %s", button, clip, why.text);
}

static void check_clips(struct check *c, const struct gn_buttons *buttons, struct gn_err *err) {
    for (int i = 0; buttons && i < buttons->count; i++)
        for (int g = 0; g < GN_GESTURE_COUNT; g++) {
            const struct gn_binding *on = &buttons->items[i].on[g];
            if (on->bound && on->action.kind == GN_ACTION_PLAY)
                note(c, check_clip(c, buttons->items[i].opts.name, on->action.name, err), err);
        }
}

/* ---- what else the settings name ------------------------------------------------------------ */

/* Cards are named by path, or by their place on the bus; a card that is away may come back. */
static bool check_device(const char *name, const char *label, struct gn_err *err) {
    const bool is_number =
        name && (strncmp(name, "card", 4) == 0 || strncmp(name, "renderD", 7) == 0);
    if (!name || (!is_number && name[0] && !strpbrk(name, " \t"))) return true;
    return gn_fail_usage(err,
                         "%s: \"%s\" is not a device such as platform-gpu or a path of "
                         "/dev/dri/by-path; gnomon doctor lists them",
                         label, name);
}

static bool check_folder(const char *folder, const char *label, struct gn_err *err) {
    struct stat info;
    if (folder && stat(folder, &info) != 0)
        return gn_fail(err, "%s: %s: cannot use it: %s", label, folder, strerror(errno));
    return !folder || S_ISDIR(info.st_mode) ||
           gn_fail(err, "%s: %s: is not a folder", label, folder);
}

/* As "HDMI-A-1": the kernel's names end with a number. */
static bool check_connector(const char *name, const char *label, struct gn_err *err) {
    const char *dash = name ? strrchr(name, '-') : NULL;
    if (!name || (dash && dash != name && dash[1] && !dash[1 + strspn(dash + 1, "0123456789")]))
        return true;
    return gn_fail_usage(err,
                         "%s: \"%s\" is not a connector such as HDMI-A-1; gnomon doctor lists them",
                         label, name);
}

static void check_names(struct check *c, const struct gn_settings *s, struct gn_err *err) {
    struct gn_font *font = s->render.font ? gn_font_open_file(s->render.font, err) : NULL;
    gn_font_close(font);
    if (s->render.font && !font) gn_fail_prefix(err, "%s", gn_settings_label(s, render.font));
    note(c, !s->render.font || font, err);
    const bool listens = !s->kiosk.socket || gn_listen_check(s->kiosk.socket, err);
    if (!listens) gn_fail_prefix(err, "%s", gn_settings_label(s, kiosk.socket));
    note(c, listens, err);
    note(c, check_folder(s->kiosk.screenshots, gn_settings_label(s, kiosk.screenshots), err), err);
    note(c, check_connector(s->display.connector, gn_settings_label(s, display.connector), err),
         err);
    note(c, check_device(s->display.card, gn_settings_label(s, display.card), err), err);
    note(c, check_device(s->display.render_node, gn_settings_label(s, display.render_node), err),
         err);
}

/* Boxes would stand for characters that no font here has: titles of modes, scenes, cameras, clips.
 */
static void check_texts(const struct check *c, const struct gn_options *o,
                        const struct gn_settings *s) {
    char missing[400] = "";
    struct gn_font *font = gn_font_open_file(s->render.font, NULL);
    for (int i = 0; font && i < o->mode_count; i++)
        gn_shape_find_missing(font, o->modes[i].name, missing, sizeof missing);
    for (int i = 0; font && i < c->scene_count; i++) {
        const struct gn_scene *scene = c->scenes[i];
        if (c->paths[i])
            gn_shape_find_missing(font, gn_file_name(c->paths[i]), missing, sizeof missing);
        for (uint32_t k = 0; scene && k < scene->camera_count; k++)
            gn_shape_find_missing(font, scene->cameras[k].name, missing, sizeof missing);
        for (uint32_t k = 0; scene && k < scene->animation.clip_count; k++)
            gn_shape_find_missing(font, scene->animation.clips[k].name, missing, sizeof missing);
    }
    gn_font_close(font);
    if (missing[0])
        gn_warn(c->warnings, "texts: missing here: %s; install the packages in brackets", missing);
}

/* ---- what a kiosk makes of it
 * -------------------------------------------------------------------------- */

static void print_setting(const struct gn_section_row *section, const struct gn_option_row *row,
                          const void *value, int count) {
    char key[64], text[1024];
    gn_value_text(row, value, text, sizeof text);
    printf("%s%s = %s", count ? ", " : "", gn_section_key(section, row, key, sizeof key), text);
}

static void print_buttons(const struct gn_options *o) {
    static const char *const gestures[GN_GESTURE_COUNT] = {
        [GN_GESTURE_PRESS] = "press",   [GN_GESTURE_CLICK] = "click",
        [GN_GESTURE_DOUBLE] = "double", [GN_GESTURE_HOLD] = "hold",
        [GN_GESTURE_REPEAT] = "repeat", [GN_GESTURE_CHORD] = "together",
    };
    struct gn_buttons defaults;
    gn_buttons_defaults(&defaults);
    const struct gn_buttons *buttons = o->buttons ? o->buttons : &defaults;
    if (!o->buttons) puts("buttons: none in the file; defaults:");
    for (int i = 0; i < buttons->count; i++) {
        const struct gn_button_config *button = &buttons->items[i];
        const struct gn_button_opts *from = &button->opts;
        printf("button \"%s\":", from->name);
        if (from->line) printf(" line %s", from->line);
        if (from->keys) printf("%s keys %s", from->line ? "," : "", from->keys);
        if (from->chord) printf(" %s", from->chord);
        int count = 0;
        for (int g = 0; g < GN_GESTURE_COUNT; g++) {
            const struct gn_binding *on = &button->on[g];
            if (!on->bound) continue;
            printf("%s %s = %s%s%s", count++ ? "," : ";", gestures[g],
                   gn_action_name(on->action.kind), on->action.name ? " " : "",
                   on->action.name ? on->action.name : "");
        }
        putchar('\n');
    }
}

static void print_check(const struct check *c, const struct gn_options *o) {
    const struct gn_section_row *section = gn_section_rows;
    printf("%s is valid: %d mode%s, %d button%s, %d scene%s\n", o->config_path, o->mode_count,
           o->mode_count == 1 ? "" : "s", o->buttons ? o->buttons->count : 0,
           o->buttons && o->buttons->count == 1 ? "" : "s", c->scene_count,
           c->scene_count == 1 ? "" : "s");
    for (; !gn_section_is_many(section); section++) {
        int count = 0;
        for (int i = 0; i < GN_OPTION_COUNT; i++) {
            const struct gn_option_row *row = &gn_option_rows[i];
            if (!gn_option_is_of(row, section->title) ||
                o->settings->source[i] == GN_SOURCE_DEFAULT)
                continue;
            if (count == 0) printf("[%s] ", section->title);
            print_setting(section, row, gn_settings_value(o->settings, row), count++);
        }
        if (count) putchar('\n');
    }
    if (o->mode_count == 0)
        printf("modes: none in the file; %s\n",
               gn_options_leave_modes(o) ? "what the scene offers" : "one per technique");
    for (int i = 0; i < o->mode_count; i++) {
        const struct gn_named_section *mode = &o->modes[i];
        printf("mode \"%s\": ", mode->name);
        int count = 0;
        for (const struct gn_override *set = mode->first; set; set = set->next)
            print_setting(gn_section_find("mode", true), set->row, set->value, count++);
        puts(count ? "" : "no settings of its own");
    }
    for (int i = 0; i < o->settings->light_count; i++) {
        const struct gn_named_section *light = &o->settings->lights[i];
        char text[400];
        gn_stage_print_light(o->settings, light, text, sizeof text);
        printf("light \"%s\": %s\n", light->name, text[0] ? text : "no settings of its own");
    }
    print_buttons(o);
}

/* One error is the program's one line; of several that line has the number. */
static bool report_errors(struct gn_errors *errors, const char *path, struct gn_err *err) {
    if (errors->count == 0) return true;
    *err = errors->items[0];
    if (errors->count == 1)
        errors->count = 0;
    else {
        const enum gn_exit status = err->status;
        gn_fail(err, "%s: %d errors%s", path, errors->count,
                errors->dropped ? ", and more that are not listed" : "");
        err->status = status;
    }
    return false;
}

bool gn_cli_check(const struct gn_options *options, struct gn_warnings *warnings,
                  struct gn_err *err) {
    struct check c = {.errors = options->errors, .warnings = warnings};
    struct gn_options again;
    if (gn_args_parse(&again, options->argc, options->argv, NULL, err)) {
        gn_options_run_as(&again, GN_COMMAND_RENDER); /* a missing camera or clip is an error */
        c.limits = gn_stage_limits(again.settings);
        for (int i = 0; i <= again.mode_count; i++) {
            const struct gn_settings *settings = i ? &again.all[i] : again.settings;
            check_names(&c, settings, err);
            note(&c, check_looks(&c, settings, err), err);
        }
        check_clips(&c, options->buttons, err);
        check_lights(&c, again.settings);
        check_texts(&c, options, again.settings);
        if (again.settings->run.here) gn_cli_check_here(options, c.errors, warnings);
    } else {
        note(&c, false, err);
    }
    const bool ok = report_errors(c.errors, options->config_path, err);
    if (ok) print_check(&c, options);
    for (int i = 0; i < c.scene_count; i++) gn_scene_destroy(c.scenes[i]);
    gn_options_finish(&again);
    return ok;
}
