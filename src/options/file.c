#include "options/file.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "core/text.h"
#include "options/explain.h"
#include "options/section.h"
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
    const struct gn_config_over *over;    /* NULL: it is the machine's own */
    const struct gn_section_row *section; /* that is read: its kind; */
    struct gn_named_section *one;         /* and of many that one, as [mode "Soft"]; else NULL */
    struct gn_sections many[GN_SECTION_COUNT];
    int lines[GN_OPTION_COUNT]; /* where each was set in sections that are not of many */
};

/* ---- sections ------------------------------------------------------------------------------ */

static bool open_one(struct load *load, const struct gn_ini_line *line, struct gn_err *err) {
    struct gn_sections *all = &load->many[load->section - gn_section_rows];
    struct gn_arena *arena = &load->options->arena;
    const char *kind = line->section;
    if (load->section->one_word && line->name[strcspn(line->name, " \t")])
        return gn_fail_usage(err, "%s: %s \"%s\": a %s's name has no spaces", line->where, kind,
                             line->name, kind);
    for (int i = 0; i < all->count; i++)
        if (strcmp(all->items[i].name, line->name) == 0)
            return gn_fail_usage(err, "%s: %s \"%s\" is there already, in line %d", line->where,
                                 kind, line->name, all->items[i].line);
    if (all->count == GN_SECTIONS_MAX)
        return gn_fail_usage(err, "%s: more than %d %ss", line->where, GN_SECTIONS_MAX, kind);
    if (!all->items) all->items = gn_arena_alloc(arena, GN_SECTIONS_MAX, sizeof *all->items);
    const struct gn_named_section one = {.name = gn_arena_strdup(arena, line->name),
                                         .label = gn_arena_strdup(arena, line->where),
                                         .line = line->number};
    if (!all->items || !one.name || !one.label)
        return gn_fail(err, "%s: no memory left", line->where);
    load->one = &all->items[all->count++];
    *load->one = one;
    return true;
}

static bool open_section(struct load *load, const struct gn_ini_line *line, struct gn_err *err) {
    load->one = NULL;
    load->section = gn_section_find(line->section, line->name);
    if (load->section) return !line->name || open_one(load, line, err);
    const struct gn_section_row *other = gn_section_find(line->section, !line->name);
    if (other && line->name)
        return gn_fail_usage(err, "%s: [%s] has no name", line->where, line->section);
    if (other)
        return gn_fail_usage(err, "%s: a %s has a name: [%s]", line->where, line->section,
                             other->title);
    char list[200];
    gn_section_list(list, sizeof list);
    return gn_fail_usage(err, "%s: unknown section [%s]; expected %s", line->where, line->section,
                         list);
}

/* ---- settings ------------------------------------------------------------------------------ */

static bool fail_key(const struct gn_ini_line *line, const struct gn_section_row *section,
                     struct gn_err *err) {
    char keys[400] = "", others[200] = "",
         names[GN_OPTION_COUNT][40]; /* the nearest is one of all */
    struct gn_text_guess guess = {0};
    int count;
    const struct gn_option_row *rows = gn_section_options(section, &count);
    for (int i = 0; i < count; i++) {
        if (!gn_section_key(section, &rows[i], names[i], sizeof names[i])) continue;
        gn_text_guess(&guess, line->key, names[i]);
        gn_text_add(keys, sizeof keys, "%s %s", keys[0] ? "," : "", names[i]);
    }
    for (int i = 0; i < GN_SECTION_COUNT; i++) { /* of another section, as it is spelled */
        if (gn_section_rows[i].title == section->title ||
            !gn_section_find_key(&gn_section_rows[i], line->key))
            continue;
        gn_text_add(others, sizeof others, "%s [%s]", others[0] ? "," : "",
                    gn_section_rows[i].title);
    }
    if (others[0])
        return gn_fail_usage(err, "%s: unknown key \"%s\" in [%s]; it is a key of%s", line->where,
                             line->key, line->section, others);
    if (!guess.name)
        return gn_fail_usage(err, "%s: unknown key \"%s\"; keys of [%s]:%s", line->where, line->key,
                             line->section, keys);
    return gn_fail_usage(err, "%s: unknown key \"%s\" in [%s]; expected %s", line->where, line->key,
                         line->section, guess.name);
}

/* Of many the same value, or the same word in it, is of one alone where the row says so. */
static bool check_unique(const struct load *load, const struct gn_override *setting,
                         struct gn_err *err) {
    const struct gn_sections *all = &load->many[load->section - gn_section_rows];
    char text[200];
    for (int i = 0; setting->row->unique && i < all->count; i++) {
        const struct gn_override *other = gn_section_setting(&all->items[i], setting->row);
        if (other && gn_value_shared(setting->row, setting->value, other->value, text, sizeof text))
            return gn_fail_usage(err, "%s: \"%s\" is %.*s \"%s\"'s already, in line %d",
                                 setting->label, text, (int)strcspn(load->section->title, " "),
                                 load->section->title, all->items[i].name, other->line);
    }
    return true;
}

/* A setting of one of many. Of `as` only the label and the line are read. Limits that it sets again
 * are added to those that are there; other keys may not be set again (line_before()). */
static bool set_one(struct load *load, const struct gn_option_row *row, const char *text,
                    const struct gn_override *as, struct gn_err *err) {
    struct gn_arena *arena = &load->options->arena;
    struct gn_override **link = &load->one->first;
    while (*link && (*link)->row != row) link = &(*link)->next;
    if (*link)
        return gn_options_parse(load->options, row, text, (*link)->value, arena, as->label, err);
    struct gn_override *setting = gn_arena_alloc(arena, 1, sizeof *setting);
    void *value = gn_arena_alloc(arena, 1, gn_value_size(row->kind));
    const char *label = gn_arena_strdup(arena, as->label);
    if (!setting || !value || !label) return gn_fail(err, "%s: no memory left", as->label);
    *setting = (struct gn_override){.row = row, .value = value, .label = label, .line = as->line};
    if (!gn_options_parse(load->options, row, text, value, arena, label, err) ||
        !check_unique(load, setting, err))
        return false;
    *link = setting;
    return true;
}

static int line_before(const struct load *load, const struct gn_option_row *row) {
    if (row->kind == GN_KIND_LIMIT || (row->kind == GN_KIND_SCENES && !load->one))
        return 0; /* may be given again */
    if (!load->one) return load->lines[row - gn_option_rows];
    const struct gn_override *setting = gn_section_setting(load->one, row);
    return setting ? setting->line : 0;
}

static bool take_line(struct load *load, const struct gn_ini_line *line, struct gn_err *err) {
    if (!line->key) return open_section(load, line, err);
    const struct gn_option_row *row = gn_section_find_key(load->section, line->key);
    if (!row) return fail_key(line, load->section, err);
    const char *left_out = load->over ? load->over->why_not(load->options, row, line) : NULL;
    if (left_out) {
        gn_warn(load->over->warnings, "%s: %s is left out: %s", line->where, line->key, left_out);
        return true;
    }
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
    const struct gn_override as = {.label = label, .line = line->number};
    if (load->one) return set_one(load, row, text, &as, err);
    load->lines[row - gn_option_rows] = line->number;
    return gn_options_set(load->options, row, text, GN_SOURCE_INI, label, err);
}

static bool on_line(void *user, const struct gn_ini_line *line, struct gn_err *err) {
    struct load *load = user;
    if (take_line(load, line, err)) return true;
    if (err) gn_config_explain(line, load->section, err);
    return false;
}

static bool load_text(struct load load, const char *text, size_t size, struct gn_err *err) {
    struct gn_options *options = load.options;
    const char *path = load.path;
    options->config_path = gn_arena_strdup(&options->arena, path);
    if (!options->config_path) return gn_fail(err, "%s: no memory left", path);
    struct gn_errors *errors = options->errors;
    if (!gn_ini_parse(path, text, size, on_line, &load, errors, err)) return false;
    const bool checks = !errors || errors->count == 0; /* else all may follow from those */
    for (int i = 0; i < GN_SECTION_COUNT; i++)
        if (load.many[i].count && !gn_section_rows[i].take(options, &load.many[i], checks, err) &&
            !gn_errors_take(errors, err))
            return false;
    return true;
}

bool gn_config_load_text(struct gn_options *options, const char *path, const char *text,
                         size_t size, struct gn_err *err) {
    return load_text((struct load){.options = options, .path = path}, text, size, err);
}

bool gn_config_load(struct gn_options *options, const char *path, const struct gn_config_over *over,
                    struct gn_err *err) {
    struct gn_bytes bytes;
    if (!gn_file_read(path, FILE_MAX, &bytes, err)) return false;
    const bool ok = load_text((struct load){.options = options, .path = path, .over = over},
                              (const char *)bytes.data, bytes.size, err);
    gn_bytes_finish(&bytes);
    return ok;
}
