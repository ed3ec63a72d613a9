#include "options/explain.h"

#include <string.h>

#include "core/text.h"
#include "shadow/technique.h"

enum { SUGGESTIONS = 3 };

struct nearest { /* zeroed: none yet */
    char names[SUGGESTIONS][GN_INI_NAME_MAX];
    int distance[SUGGESTIONS], count;
};

/* Within edits of a third of the word's length, as gn_text_guess() has it; what is right already is
 * no guess, and nobody who reads it on a screen knows a technique's name. */
static void add_name(struct nearest *n, const char *word, const char *name) {
    const int distance = gn_text_distance(word, name);
    enum gn_technique technique;
    if (distance == 0 || distance > (int)strlen(word) / 3 + 1 ||
        gn_technique_find(name, strlen(name), &technique))
        return;
    int at = n->count < SUGGESTIONS ? n->count++ : SUGGESTIONS;
    for (; at > 0 && n->distance[at - 1] > distance; at--) {
        if (at == SUGGESTIONS) continue;
        n->distance[at] = n->distance[at - 1];
        memcpy(n->names[at], n->names[at - 1], sizeof n->names[0]);
    }
    if (at == SUGGESTIONS) return;
    n->distance[at] = distance;
    gn_text_format(n->names[at], sizeof n->names[0], "%s", name);
}

static void add_keys(struct nearest *n, const char *word, const struct gn_section_row *section) {
    int count;
    const struct gn_option_row *rows = gn_section_options(section, &count);
    for (int i = 0; i < count; i++) {
        char buffer[64];
        const char *key = gn_section_key(section, &rows[i], buffer, sizeof buffer);
        if (key) add_name(n, word, key);
    }
}

/* The first other section that has the key; NULL: none. */
static const struct gn_section_row *find_home(const char *key,
                                              const struct gn_section_row *section) {
    for (int i = 0; i < GN_SECTION_COUNT; i++)
        if (&gn_section_rows[i] != section && gn_section_find_key(&gn_section_rows[i], key))
            return &gn_section_rows[i];
    return NULL;
}

static void add_values(struct nearest *n, const char *word, const struct gn_option_row *row) {
    for (const struct gn_choice *c = row->choices; c && c->name; c++) add_name(n, word, c->name);
}

void gn_config_explain(const struct gn_ini_line *line, const struct gn_section_row *section,
                       struct gn_err *err) {
    struct nearest n = {0};
    char *out = err->shown;
    const size_t size = sizeof err->shown;
    const char *slash = strrchr(line->where, '/'), *name = slash ? slash + 1 : line->where;
    const char *named = NULL; /* title of such sections, which have a name */
    char file[64];
    gn_text_format(file, sizeof file, "%.*s", (int)strcspn(name, ":"), name);
    const struct gn_option_row *row =
        section && line->key ? gn_section_find_key(section, line->key) : NULL;
    if (!line->key) {
        for (int i = 0; i < GN_SECTION_COUNT; i++) {
            char word[GN_INI_NAME_MAX];
            gn_text_format(word, sizeof word, "%.*s", (int)strcspn(gn_section_rows[i].title, " "),
                           gn_section_rows[i].title);
            add_name(&n, line->section, word);
            if (!line->name && gn_section_rows[i].title[strlen(word)] &&
                strcmp(word, line->section) == 0)
                named = gn_section_rows[i].title;
        }
        gn_text_format(out, size, "Line %d of %s: the section [%s] cannot be used.", line->number,
                       file, line->section);
        if (named) gn_text_add(out, size, " It needs a name: [%s].", named);
    } else if (!row) {
        const struct gn_section_row *home = section ? find_home(line->key, section) : NULL;
        gn_text_format(out, size, "Line %d of %s: there is no key \"%s\" in [%s].", line->number,
                       file, line->key, line->section);
        if (home)
            gn_text_add(out, size, " It belongs in [%s].", home->title);
        else if (section)
            add_keys(&n, line->key, section);
    } else {
        const bool shows = row->kind != GN_KIND_TECHNIQUES && !strchr(line->value, '/');
        if (shows) add_values(&n, line->value, row);
        const bool is_valid = gn_option_has_choice(row, line->value);
        gn_text_format(out, size,
                       is_valid ? "Line %d of %s: \"%s\" cannot be set here."
                       : shows  ? "Line %d of %s: \"%s\" cannot be \"%.40s\"."
                                : "Line %d of %s: \"%s\" is set to a value that is not allowed.",
                       line->number, file, line->key, line->value);
    }
    for (int i = 0; i < n.count; i++)
        gn_text_add(out, size, "%s%s%s",
                    i == 0            ? " Did you mean "
                    : i + 1 < n.count ? ", "
                                      : " or ",
                    n.names[i], i + 1 == n.count ? "?" : "");
}
