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

static size_t word_length(const char *c, const char *end) {
    const char *start = c;
    while (c < end && !isspace((unsigned char)*c)) c++;
    return (size_t)(c - start);
}

static const char *skip_blanks(const char *c, const char *end) {
    while (c < end && (*c == ' ' || *c == '\t')) c++;
    return c;
}

static bool is_number(const char *c, const char *end) {
    if (c < end && (*c == '-' || *c == '+')) c++;
    return c < end && (isdigit((unsigned char)*c) || *c == '.' || strncasecmp(c, "nan", 3) == 0 ||
                       strncasecmp(c, "inf", 3) == 0);
}

static bool is_readable(const char *line, const char *end) {
    const char *c = skip_blanks(line, end);
    const size_t length = word_length(c, end);
    if (length > 4 && strncasecmp(c, "map_", 4) == 0) return true;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strlen(words[i].name) == length && strncasecmp(c, words[i].name, length) == 0)
            return !words[i].has_number || is_number(skip_blanks(c + length, end), end);
    return false;
}

void gn_import_mtl_clean(struct gn_bytes *bytes) {
    char *c = (char *)bytes->data, *end = c + bytes->size;
    while (c < end) {
        char *line = c;
        while (c < end && *c != '\n' && *c != '\r') c++;
        if (!is_readable(line, c)) memset(line, ' ', (size_t)(c - line));
        while (c < end && (*c == '\n' || *c == '\r')) c++;
    }
}
