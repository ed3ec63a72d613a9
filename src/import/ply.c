/* Checks the header of a PLY file before assimp reads it: assimp 5.2 hangs on an unknown format
 * line. */
#include <string.h>

#include "import/private.h"

/* Returns the first word after `key `, or NULL if no header line begins with it. */
static const char *find_line(const char *header, const char *key) {
    const size_t length = strlen(key);
    for (const char *line = header; line && *line; line = strpbrk(line, "\r\n")) {
        line += strspn(line, "\r\n");
        if (strncmp(line, "end_header", 10) == 0) return NULL;
        if (strncmp(line, key, length) == 0 && line[length] == ' ') return line + length + 1;
    }
    return NULL;
}

static bool is_known(const char *format) {
    static const char *const known[] = {"ascii ", "binary_little_endian ", "binary_big_endian "};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(format, known[i], strlen(known[i])) == 0) return true;
    return false;
}

bool gn_import_ply_check(const struct gn_import *import) {
    char header[4096];
    const char *path = import->opts->model;
    FILE *file = fopen(path, "rb");
    if (!file) return true; /* the reader reports the error */
    const size_t size = fread(header, 1, sizeof header - 1, file);
    fclose(file);
    header[size] = 0;
    if (strncmp(header, "ply", 3) != 0) return true; /* assimp rejects it */
    const char *format = find_line(header, "format");
    if (format && is_known(format)) return true;
    return gn_fail(import->err,
                   "%s: bad or missing format line in the header: expected ascii, "
                   "binary_little_endian or binary_big_endian",
                   path);
}
