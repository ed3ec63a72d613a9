/* From arguments to the first mode: shared by start and reload. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "kiosk/private.h"
#include "options/args.h"

void gn_show_drop_options(struct gn_options *options) {
    if (options) gn_options_finish(options);
    free(options);
}

struct gn_options *gn_show_read_options(const struct gn_options *like, struct gn_warnings *warnings,
                                        struct gn_err *err) {
    struct gn_options *o = gn_xalloc(1, sizeof *o);
    if (gn_args_parse(o, like->argc, like->argv, warnings, err)) {
        gn_options_run_as(o, GN_COMMAND_SHOW); /* also for the bare command */
        /* with modes in the file one of them is always on */
        if (!o->settings->mode && o->mode_count > 0) o->settings = &o->all[1];
        o->home = o->settings->mode;
        return o;
    }
    gn_show_drop_options(o);
    return NULL;
}

/* Cameras, clips and variants that the settings name are those of another scene. */
const char *gn_show_put_file(struct gn_options *o, const char *path) {
    const struct gn_scene_list list = {.paths = {gn_arena_strdup(&o->arena, path)}, .count = 1};
    const struct gn_option_row *row = gn_option_rows;
    while (row->offset != offsetof(struct gn_settings, scene.path)) row++;
    for (int i = 0; i < o->all_count; i++) {
        gn_settings_put(&o->all[i], row, &list, GN_SOURCE_FLAG, row->name);
        o->all[i].scene.camera = o->all[i].scene.animation = o->all[i].scene.variant = NULL;
    }
    return list.paths[0];
}

/* One black triangle, seen by nobody, on the ground of messages (#202428): for what is shown while
 * the first scene loads. */
static const char nothing[] =
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_materials_unlit\"],"
    "\"scenes\":[{\"nodes\":[0],\"extras\":{\"gnomon_background\":[0.01444,0.01764,0.02122]}}],"
    "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
    "\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},"
    "\"extensions\":{\"KHR_materials_unlit\":{}}}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,0,1]}]}";

bool gn_show_load_nothing(struct gn_show *s, struct gn_err *err) {
    struct gn_options *o = gn_show_read_options(s->config.options, NULL, err);
    if (!o) return false;
    for (int i = 0; i < o->all_count; i++) { /* what speaks of a scene */
        struct gn_settings *settings = &o->all[i];
        settings->scene = (struct gn_scene_settings){.list.count = 1};
        settings->run.input_script = NULL;
    }
    s->reload = (struct gn_show_reload){.options = s->config.options,
                                        .file = s->config.file,
                                        .scene = s->first.scene,
                                        .first = true};
    s->config.options = o;
    return gn_stage_take(
        &s->screen.stage, o->settings,
        gn_scene_load_bytes("(nothing)", nothing, sizeof nothing - 1, NULL, NULL, err), NULL, err);
}

static bool is_same_path(const char *a, const char *b) { return a && strcmp(a, b) == 0; }

/* Cameras and clips that they name there are those of the lost scene. */
void gn_show_replace_scene(struct gn_options *o, const char *path, const char *by) {
    const char *lost = gn_arena_strdup(&o->arena, path); /* it may be the text that is replaced */
    const char *own = by ? gn_arena_strdup(&o->arena, by) : NULL;
    for (int i = 0; i < o->all_count; i++) {
        struct gn_scene_settings *scene = &o->all[i].scene;
        if (is_same_path(scene->path, lost))
            scene->camera = scene->animation = scene->variant = NULL;
        for (int k = 0; k < scene->list.count; k++)
            if (is_same_path(scene->list.paths[k], lost)) scene->list.paths[k] = own;
    }
}

bool gn_show_look_at_first(const struct gn_show *s, struct gn_options *o, struct gn_loaded *loaded,
                           struct gn_stage_look *look, char why[GN_SHOW_WHY], struct gn_err *err) {
    const bool replaces = !loaded->scene && o->settings->scene.path && !s->config.place;
    why[0] = 0;
    const char *lost = s->first.lost;
    if (loaded->scene && lost[0])
        snprintf(why, GN_SHOW_WHY, "%.480s (showing the %s)", lost, s->first.instead);
    if (!loaded->scene) {
        *err = loaded->err;
        gn_stage_name_source(o->settings, err);
        if (!replaces) return false;
        snprintf(why, GN_SHOW_WHY, "%.480s (showing the default scene)",
                 lost[0] ? lost : err->text);
        *err = (struct gn_err){0};
        gn_show_replace_scene(o, o->settings->scene.path, NULL);
        loaded->scene = gn_stage_scene(o->settings, s->warnings, err);
        if (!loaded->scene) return false;
        gn_pose_init(&loaded->pose, loaded->scene, GN_POSE_DEFAULT);
    }
    return gn_stage_look_build(look, o->settings, loaded->scene, s->warnings, err);
}

bool gn_show_begin(struct gn_show *s, int scene, struct gn_err *err) {
    struct gn_show_screen *screen = &s->screen;
    const int frames = screen->stage.settings->run.frames;
    s->counts.most_frames = frames > 0 && !s->reload.first ? (uint64_t)frames : UINT64_MAX;
    screen->hand = (struct gn_show_hand){0};
    screen->scaling = (struct gn_show_scaling){0};
    screen->stage.shown.rested_ns = 0;
    gn_show_list_modes(s, scene);
    gn_truth_drop(screen);
    gn_still_drop(screen);
    screen->truth = (struct gn_show_truth){0};
    gn_view_close(&screen->split.view, screen->stage.gl);
    screen->split = (struct gn_show_split){0}; /* its mode is of the other list */
    const struct gn_kiosk_place first = {.mode = s->modes.first, .scene = scene};
    screen->kiosk = (struct gn_kiosk){.shown = first, .wanted = first};
    screen->scene = gn_kiosk_scene(&screen->rules, &screen->kiosk.shown);
    if (!gn_show_build_looks(s, screen->stage.scene, &screen->looks, err)) return false;
    gn_show_enter(screen);
    return true;
}
