/* Lines of a material file that assimp cannot read: it takes them by their first letter, so that an
 * `aniso` of Blender is a number without digits, and refuses the whole model. They are left out. */
#include <ctype.h>
#include <string.h>

#include "import/private.h"

static const struct word {
    const char *name;
    bool has_number; /* assimp parses one */
} words[] = {
    {"newmtl", false}, {"Ka", true},    {"Kd", true},    {"Ks", true},    {"Ke", true},
    {"Tf", true},      {"d", true},     {"Tr", true},    {"Ns", true},    {"Ni", true},
    {"Pr", true},      {"Pm", true},    {"Ps", true},    {"Pc", true},    {"illum", true},
    {"bump", false},   {"norm", false}, {"disp", false}, {"refl", false},
};

static const char *skip_blanks(const char *c, const char *end) {
    while (c < end && (*c == ' ' || *c == '\t')) c++;
    return c;
}

/* word: set where it is one that assimp knows, and only its number is wrong. */
static bool is_readable(const char *line, const char *end, const char **word) {
    const char *c = skip_blanks(line, end);
    size_t length = 0;
    while (c + length < end && !isspace((unsigned char)c[length])) length++;
    const char *value = skip_blanks(c + length, end);
    if (value < end && (*value == '-' || *value == '+')) value++;
    const bool is_number =
        value < end && (isdigit((unsigned char)*value) || *value == '.' ||
                        strncasecmp(value, "nan", 3) == 0 || strncasecmp(value, "inf", 3) == 0);
    if (length > 4 && strncasecmp(c, "map_", 4) == 0) return true;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strlen(words[i].name) == length && strncasecmp(c, words[i].name, length) == 0) {
            if (!words[i].has_number || is_number) return true;
            *word = words[i].name;
        }
    return false;
}

void gn_import_mtl_clean(const struct gn_import *import, const char *name, struct gn_bytes *bytes) {
    size_t number = 1, damaged = 0, first = 0;
    const char *what = "";
    char *c = (char *)bytes->data, *end = c + bytes->size;
    while (c < end) {
        char *line = c;
        while (c < end && *c != '\n' && *c != '\r') c++;
        const char *word = NULL;
        if (!is_readable(line, c, &word)) memset(line, ' ', (size_t)(c - line));
        if (word && damaged++ == 0) {
            first = number;
            what = word;
        }
        for (; c < end && (*c == '\n' || *c == '\r'); c++) number += *c == '\n';
    }
    if (damaged > 0)
        gn_warn(import->warnings, "%s: %.100s:%zu: %s without a number; shown without this line%s",
                import->opts->model, name, first, what, damaged > 1 ? " and others like it" : "");
}
