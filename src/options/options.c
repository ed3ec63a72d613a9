#include "options/options.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "options/value.h"
#include "shadow/technique.h"

void gn_options_init(struct gn_options *options, enum gn_command command) {
    struct gn_err err = {0};
    *options = (struct gn_options){.all_count = 1};
    struct gn_settings *settings = gn_xalloc(1, sizeof *settings);
    for (const struct gn_option_row *row = gn_option_rows; row < gn_option_rows + GN_OPTION_COUNT;
         row++) {
        bool ok =
            !row->fallback || gn_value_parse(row, row->fallback, (char *)settings + row->offset,
                                             &options->arena, row->name, &err);
        assert(ok && "a default is in its own range");
        (void)ok;
    }
    settings->run.command = command;
    options->settings = options->all = settings;
}

void gn_options_finish(struct gn_options *options) {
    gn_arena_finish(&options->arena);
    free(options->all);
    *options = (struct gn_options){0};
}

bool gn_options_parse(const struct gn_options *options, const struct gn_option_row *row,
                      const char *text, void *value, struct gn_arena *arena, const char *label,
                      struct gn_err *err) {
    if (!gn_value_parse(row, text, value, arena, label, err)) return false;
    if (row->kind != GN_KIND_TECHNIQUES) return true;
    const struct gn_technique_list *list = value;
    const enum gn_command command = options->all[0].run.command;
    for (int i = 0; i < list->count; i++)
        if (list->items[i] == GN_TECHNIQUE_TRUTH && command != GN_COMMAND_RENDER)
            return gn_fail_usage(err, "%s: truth is for stills: only gnomon render draws with it",
                                 label);
    return list->count < 2 || command == GN_COMMAND_BENCH ||
           gn_fail_usage(err, "%s: \"%s\": one technique at a time; only bench takes a list", label,
                         text);
}

bool gn_options_set(struct gn_options *options, const struct gn_option_row *row, const char *text,
                    enum gn_source source, const char *label, struct gn_err *err) {
    struct gn_settings *settings = &options->all[0];
    _Alignas(16) char value[sizeof(struct gn_limits)] = {0}; /* the largest kind */
    /* a kind that adds (scenes, limits) continues from what this source set */
    if (settings->source[row - gn_option_rows] == source)
        memcpy(value, gn_settings_value(settings, row), gn_value_size(row->kind));
    if (!gn_options_parse(options, row, text, value, &options->arena, label, err)) return false;
    const char *kept = gn_arena_strdup(&options->arena, label);
    if (!kept) return gn_fail(err, "%s: no memory left", label);
    gn_settings_put(settings, row, value, source, kept);
    return true;
}

/* ---- modes --------------------------------------------------------------------------------- */

static bool names_several_scenes(const struct gn_options *options) {
    if (options->all[0].scene.list.count > 1) return true;
    for (int i = 0; i < options->mode_count; i++)
        for (const struct gn_override *o = options->modes[i].first; o; o = o->next)
            if (o->row->kind == GN_KIND_SCENES) return true;
    return false;
}

void gn_options_resolve(struct gn_options *options) {
    const int modes = options->mode_count ? options->mode_count : GN_TECHNIQUE_COUNT;
    const struct gn_option_row *shadow = gn_option_find_key("render", "shadow");
    options->all = gn_xrealloc(options->all, (size_t)modes + 1, sizeof *options->all);
    options->all_count = modes + 1;
    options->settings = options->all;
    options->all[0].several_scenes = names_several_scenes(options);
    for (int i = 0; i < modes; i++) {
        struct gn_settings *settings = &options->all[1 + i];
        *settings = options->all[0];
        if (options->mode_count == 0) {
            settings->mode = gn_techniques[i].name;
            gn_settings_put(settings, shadow,
                            &(struct gn_technique_list){.count = 1, .items = {(uint8_t)i}},
                            GN_SOURCE_MODE, "--mode");
            continue;
        }
        settings->mode = options->modes[i].name;
        for (const struct gn_override *o = options->modes[i].first; o; o = o->next)
            gn_settings_put(settings, o->row, o->value, GN_SOURCE_MODE, o->label);
    }
}

bool gn_options_leave_modes(const struct gn_options *options) {
    return options->mode_count == 0 && options->all[0].scene.path && !options->all[0].run.mode &&
           !(options->buttons && gn_buttons_name_mode(options->buttons));
}

int gn_options_find_mode(const struct gn_options *options, const char *name) {
    for (int i = 1; i < options->all_count; i++)
        if (strcmp(options->all[i].mode, name) == 0) return i;
    return 0;
}

void gn_options_list_modes(const struct gn_options *options, char *out, size_t size) {
    out[0] = '\0';
    for (int i = 0; i < options->mode_count; i++)
        gn_text_add(out, size, "%s \"%s\"", i ? "," : "", options->modes[i].name);
}

static bool fail_technique(const char *name, struct gn_err *err) {
    char names[160] = "";
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++)
        gn_text_add(names, sizeof names, "%s%s", i ? ", " : "", gn_techniques[i].name);
    return gn_fail_usage(err, "there is no shadow technique '%s'; there are %s", name, names);
}

bool gn_options_choose(struct gn_options *options, const char *name, struct gn_err *err) {
    const int found = gn_options_find_mode(options, name);
    char names[300];
    gn_options_list_modes(options, names, sizeof names);
    if (!found && options->mode_count)
        return gn_fail_usage(err, "no mode \"%.48s\"; %s has%s", name, options->config_path, names);
    if (!found) return fail_technique(name, err);
    options->settings = &options->all[found];
    return true;
}

void gn_options_run_as(struct gn_options *options, enum gn_command command) {
    for (int i = 0; i < options->all_count; i++) options->all[i].run.command = command;
}
