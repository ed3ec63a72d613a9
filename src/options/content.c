#include "options/content.h"

#include <string.h>

#include "options/file.h"
#include "options/section.h"
#include "options/value.h"
#include "take/shown.h"

/* Beside those of the sections that are, .. */
static const size_t of_machine[] = {
    offsetof(struct gn_settings, kiosk.content),  offsetof(struct gn_settings, kiosk.socket),
    offsetof(struct gn_settings, kiosk.state),    offsetof(struct gn_settings, kiosk.screenshots),
    offsetof(struct gn_settings, render.size),    offsetof(struct gn_settings, render.without),
    offsetof(struct gn_settings, render.shaders),
};
/* .. without these. */
static const size_t of_both[] = {offsetof(struct gn_settings, display.rotate_deg),
                                 offsetof(struct gn_settings, display.pixel_shift_px)};
/* They are of other scenes. */
static const size_t of_scene[] = {
    offsetof(struct gn_settings, scene.path), offsetof(struct gn_settings, scene.camera),
    offsetof(struct gn_settings, scene.animation), offsetof(struct gn_settings, scene.variant)};

static bool is_among(const size_t *offsets, size_t size, const struct gn_option_row *row) {
    for (size_t i = 0; i < size / sizeof *offsets; i++)
        if (offsets[i] == row->offset) return true;
    return false;
}

/* A wrong value of these could take the screen, the GPU or the hours from the machine. */
static bool is_of_machine(const struct gn_option_row *row) {
    return is_among(of_machine, sizeof of_machine, row) ||
           (row->section && gn_section_find(row->section, false)->of_machine &&
            !is_among(of_both, sizeof of_both, row));
}

/* What is no limit, its parser says. */
static bool raises_limit(const struct gn_options *o, const char *text) {
    const char *equals = strchr(text, '=');
    int64_t value;
    return equals && gn_parse_int(equals + 1, &value) && value > 0 &&
           gn_scene_limits_raise(&o->all[0].render.limits.all, text, (size_t)(equals - text),
                                 (uint64_t)value);
}

static const char *why_not(const struct gn_options *o, const struct gn_option_row *row,
                           const struct gn_ini_line *line) {
    if (row >= gn_option_rows && row < gn_option_rows + GN_OPTION_COUNT && is_of_machine(row))
        return "it is the machine's own";
    if (row->kind != GN_KIND_LIMIT) return NULL;
    /* a mode's takes the place of all of [render] */
    if (line->name) return "content lowers limits in [render] only";
    return raises_limit(o, line->value) ? "content may lower limits, and not raise them" : NULL;
}

/* To its default. */
static void reset_row(struct gn_options *o, int i) {
    const struct gn_option_row *row = &gn_option_rows[i];
    struct gn_settings *all = &o->all[0];
    char *value = (char *)all + row->offset;
    struct gn_err unused = {0};
    memset(value, 0, gn_value_size(row->kind));
    if (row->fallback) gn_value_parse(row, row->fallback, value, &o->arena, row->name, &unused);
    all->source[i] = GN_SOURCE_DEFAULT;
    all->label[i] = NULL;
}

static bool lay_scene(struct gn_options *o, const char *path, struct gn_err *err) {
    const struct gn_option_row *row = gn_option_find_key("scene", "file");
    for (int i = 0; i < GN_OPTION_COUNT; i++)
        if (is_among(of_scene, sizeof of_scene, &gn_option_rows[i])) reset_row(o, i);
    return gn_options_set(o, row, path, GN_SOURCE_INI, "content", err);
}

/* A mode that a button of the file names may be gone. */
static bool check_buttons(const struct gn_options *o, struct gn_err *err) {
    char names[300];
    gn_options_list_modes(o, names, sizeof names);
    for (int b = 0; o->buttons && b < o->buttons->count; b++)
        for (int g = 0; g < GN_GESTURE_COUNT; g++) {
            const struct gn_binding *on = &o->buttons->items[b].on[g];
            bool found = !on->bound || on->action.kind != GN_ACTION_MODE || o->mode_count == 0;
            for (int i = 0; !found && i < o->mode_count; i++)
                found = strcmp(o->modes[i].name, on->action.name) == 0;
            if (!found)
                return gn_fail_usage(err,
                                     "%s: the kiosk's button \"%s\" goes to the mode \"%s\", which "
                                     "is not there; it has%s",
                                     o->config_path, o->buttons->items[b].opts.name,
                                     on->action.name, names);
        }
    return true;
}

static bool lay_ini(struct gn_options *o, const char *path, struct gn_warnings *warnings,
                    struct gn_err *err) {
    const struct gn_config_over over = {.why_not = why_not, .warnings = warnings};
    struct gn_settings *all = &o->all[0];
    for (int i = 0; i < GN_OPTION_COUNT; i++) {
        const char *section = gn_option_rows[i].section;
        if (section && gn_section_find(section, false)->of_content) reset_row(o, i);
    }
    all->lights = NULL;
    all->light_count = 0;
    o->base_path = o->config_path;
    o->modes = NULL;
    o->mode_count = 0;
    return gn_config_load(o, path, &over, err) && check_buttons(o, err);
}

bool gn_options_lay_content(struct gn_options *o, const char *folder, struct gn_warnings *warnings,
                            struct gn_err *err) {
    const char *own = folder ? folder : o->all[0].kiosk.content;
    struct gn_take_shown shown;
    if (!own || strcmp(own, "no") == 0 || !gn_take_shown(own, &shown)) return true;
    o->content = gn_arena_strdup(&o->arena, shown.folder);
    if (!o->content) return gn_fail(err, "no memory left");
    return shown.ini[0] ? lay_ini(o, shown.ini, warnings, err) : lay_scene(o, shown.scene, err);
}
