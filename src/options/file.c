#include "options/file.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "core/text.h"
#include "options/buttons.h"
#include "options/ini.h"
#include "options/value.h"

#define FILE_MAX (1024 * 1024)

static bool is_there(const char *path) { return access(path, F_OK) == 0; }

bool gn_config_find(char *path, size_t size) {
    const char *folder = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    path[0] = '\0';
    if (folder && folder[0] == '/')
        snprintf(path, size, "%s/gnomon/kiosk.ini", folder);
    else if (home && home[0] == '/')
        snprintf(path, size, "%s/.config/gnomon/kiosk.ini", home);
    if (path[0] && is_there(path)) return true;
    snprintf(path, size, "/etc/gnomon/kiosk.ini");
    return is_there(path);
}

struct load {
    struct gn_options *options;
    const char *path;
    struct gn_mode *modes;
    struct gn_light_section *lights;
    struct gn_override **first; /* in a mode's or a light's section: its settings; else NULL */
    struct gn_override **link;  /* where its next setting goes */
    bool in_mode, in_light, in_button; /* what the section is of; of a light with a name */
    struct gn_config_buttons buttons;
    int lines[GN_OPTION_COUNT]; /* where each was set outside of modes */
};

/* ---- sections ------------------------------------------------------------------------------ */

static bool open_mode(struct load *load, const struct gn_ini_line *line, struct gn_err *err) {
    struct gn_options *options = load->options;
    if (!line->name)
        return gn_fail_usage(err, "%s: a mode has a name: [mode \"NAME\"]", line->where);
    for (int i = 0; i < options->mode_count; i++)
        if (strcmp(load->modes[i].name, line->name) == 0)
            return gn_fail_usage(err, "%s: mode \"%s\" is there already, in line %d", line->where,
                                 line->name, load->modes[i].line);
    if (options->mode_count == GN_MODES_MAX)
        return gn_fail_usage(err, "%s: more than %d modes", line->where, GN_MODES_MAX);
    struct gn_mode *mode = &load->modes[options->mode_count++];
    mode->name = gn_arena_strdup(&options->arena, line->name);
    mode->line = line->number;
    load->first = load->link = &mode->first;
    return mode->name || gn_fail(err, "%s: no memory left", line->where);
}

static bool open_light(struct load *load, const struct gn_ini_line *line, struct gn_err *err) {
    struct gn_settings *all = &load->options->all[0];
    struct gn_arena *arena = &load->options->arena;
    for (int i = 0; i < all->light_count; i++)
        if (strcmp(load->lights[i].name, line->name) == 0)
            return gn_fail_usage(err, "%s: light \"%s\" is there already, in line %d", line->where,
                                 line->name, load->lights[i].line);
    if (all->light_count == GN_LIGHT_SECTIONS_MAX)
        return gn_fail_usage(err, "%s: more than %d lights", line->where, GN_LIGHT_SECTIONS_MAX);
    if (!load->lights)
        load->lights = gn_arena_alloc(arena, GN_LIGHT_SECTIONS_MAX, sizeof *load->lights);
    if (!load->lights) return gn_fail(err, "%s: no memory left", line->where);
    all->lights = load->lights;
    struct gn_light_section *light = &load->lights[all->light_count++];
    light->name = gn_arena_strdup(arena, line->name);
    light->label = gn_arena_strdup(arena, line->where);
    light->line = line->number;
    load->first = load->link = &light->first;
    return (light->name && light->label) || gn_fail(err, "%s: no memory left", line->where);
}

static bool open_section(struct load *load, const struct gn_ini_line *line, struct gn_err *err) {
    static const char *const plain[] = {"display", "scene", "render",  "camera",
                                        "light",   "kiosk", "schedule"};
    struct gn_options *options = load->options;
    struct gn_config_buttons *buttons = &load->buttons;
    load->first = NULL;
    load->in_mode = strcmp(line->section, "mode") == 0;
    load->in_button = strcmp(line->section, "button") == 0;
    if (load->in_mode) return open_mode(load, line, err);
    load->in_light = line->name && strcmp(line->section, "light") == 0;
    if (load->in_light) return open_light(load, line, err);
    if (load->in_button) {
        buttons->arena = &options->arena;
        if (!buttons->buttons)
            buttons->buttons = gn_arena_alloc(buttons->arena, 1, sizeof *buttons->buttons);
        if (!buttons->buttons) return gn_fail(err, "%s: no memory left", line->where);
        options->buttons = buttons->buttons;
        return gn_config_button_open(buttons, line, err);
    }
    for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++)
        if (strcmp(line->section, plain[i]) == 0)
            return !line->name ||
                   gn_fail_usage(err, "%s: [%s] has no name", line->where, line->section);
    return gn_fail_usage(err,
                         "%s: unknown section [%s]; expected [display], [scene], [render], "
                         "[camera], [light], [kiosk], [schedule], [mode \"NAME\"], "
                         "[light \"NAME\"] or [button \"NAME\"]",
                         line->where, line->section);
}

/* ---- settings ------------------------------------------------------------------------------ */

static bool fail_key(const struct gn_ini_line *line, const char *section, struct gn_err *err) {
    char keys[400] = "", key[64], near[64];
    struct gn_text_guess guess = {0};
    size_t used = 0;
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const struct gn_option_row *row = &gn_option_rows[i];
        gn_option_key(row, key, sizeof key);
        if (gn_option_find_key(section, key) != row) { /* its whole name, if that may be there */
            const struct gn_option_row whole = {.name = row->name};
            gn_option_key(&whole, key, sizeof key);
            if (gn_option_find_key(section, key) != row) continue;
        }
        gn_text_guess(&guess, line->key, key);
        if (guess.name == key) {
            snprintf(near, sizeof near, "%s", key);
            guess.name = near;
        }
        if (used < sizeof keys) /* the first ones; the nearest is one of all */
            used +=
                (size_t)snprintf(keys + used, sizeof keys - used, "%s %s", used ? "," : "", key);
    }
    if (!guess.name)
        return gn_fail_usage(err, "%s: unknown key \"%s\"; keys of [%s]:%s", line->where, line->key,
                             line->section, keys);
    return gn_fail_usage(err, "%s: unknown key \"%s\" in [%s]; expected %s", line->where, line->key,
                         line->section, near);
}

static struct gn_override *find_override(struct gn_override *override,
                                         const struct gn_option_row *row) {
    while (override && override->row != row) override = override->next;
    return override;
}

static int line_before(struct load *load, const struct gn_option_row *row) {
    if (row->kind == GN_KIND_LIMIT || (row->kind == GN_KIND_SCENES && !load->in_mode))
        return 0; /* may be given again */
    if (!load->first) return load->lines[row - gn_option_rows];
    const struct gn_override *override = find_override(*load->first, row);
    return override ? override->line : 0;
}

static bool on_line(void *user, const struct gn_ini_line *line, struct gn_err *err) {
    struct load *load = user;
    if (!line->key) return open_section(load, line, err);
    if (load->in_button) return gn_config_button_set(&load->buttons, line, err);
    const char *section = load->in_mode    ? NULL
                          : load->in_light ? GN_SECTION_ONE_LIGHT
                                           : line->section;
    const struct gn_option_row *row = gn_option_find_key(section, line->key);
    if (!row) return fail_key(line, section, err);
    if (line_before(load, row))
        return gn_fail_usage(err, "%s: %s is set already, in line %d", line->where, line->key,
                             line_before(load, row));
    char label[400], path[PATH_MAX];
    snprintf(label, sizeof label, "%s: %s", line->where, line->key);
    /* relative paths begin at the folder of the file */
    const char *text = line->value, *slash = strrchr(load->path, '/');
    if ((row->kind == GN_KIND_PATH || row->kind == GN_KIND_SCENES) && text[0] && text[0] != '/' &&
        slash && !gn_option_has_choice(row, text)) {
        snprintf(path, sizeof path, "%.*s%s", (int)(slash - load->path + 1), load->path, text);
        text = path;
    }
    if (!load->first) {
        load->lines[row - gn_option_rows] = line->number;
        return gn_options_set(load->options, row, text, GN_SOURCE_INI, label, err);
    }
    struct gn_arena *arena = &load->options->arena;
    struct gn_override *override = find_override(*load->first, row);
    if (override)
        return gn_options_parse(load->options, row, text, override->value, arena, label, err);
    override = gn_arena_alloc(arena, 1, sizeof *override);
    void *value = gn_arena_alloc(arena, 1, gn_value_size(row->kind));
    const char *kept = gn_arena_strdup(arena, label);
    if (!override || !value || !kept) return gn_fail(err, "%s: no memory left", label);
    if (!gn_options_parse(load->options, row, text, value, arena, label, err)) return false;
    *override =
        (struct gn_override){.row = row, .value = value, .label = kept, .line = line->number};
    *load->link = override;
    load->link = &override->next;
    return true;
}

bool gn_config_load_text(struct gn_options *options, const char *path, const char *text,
                         size_t size, struct gn_err *err) {
    struct load load = {.options = options, .path = path};
    load.modes = gn_arena_alloc(&options->arena, GN_MODES_MAX, sizeof *load.modes);
    options->modes = load.modes;
    options->config_path = gn_arena_strdup(&options->arena, path);
    if (!load.modes || !options->config_path) return gn_fail(err, "%s: no memory left", path);
    struct gn_errors *errors = options->errors;
    if (!gn_ini_parse(path, text, size, on_line, &load, errors, err)) return false;
    if (!load.buttons.buttons || (errors && errors->count))
        return true; /* all may follow from those */
    return gn_config_button_check(&load.buttons, options, path, err) || gn_errors_take(errors, err);
}

bool gn_config_load(struct gn_options *options, const char *path, struct gn_err *err) {
    struct gn_bytes bytes;
    if (!gn_file_read(path, FILE_MAX, &bytes, err)) return false;
    const bool ok = gn_config_load_text(options, path, (const char *)bytes.data, bytes.size, err);
    gn_bytes_finish(&bytes);
    return ok;
}
