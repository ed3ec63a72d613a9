/* PLY files before assimp 5.2 reads them: it hangs on an unknown format line, and loses a byte of
 * some binary ones. */
#include <string.h>

#include "import/private.h"

bool gn_import_ply_check(const struct gn_import *import, const struct gn_bytes *model) {
    static const char *const known[] = {"ascii ", "binary_little_endian ", "binary_big_endian "};
    char header[4096];
    const char *path = import->opts->model;
    const size_t size = model->size < sizeof header ? model->size : sizeof header - 1;
    memcpy(header, model->data, size);
    header[size] = 0;
    if (strncmp(header, "ply", 3) != 0) return true; /* assimp rejects it */
    for (const char *line = header; line; line = strpbrk(line, "\r\n")) {
        line += strspn(line, "\r\n");
        if (!*line || strncmp(line, "end_header", 10) == 0) break;
        if (strncmp(line, "format ", 7) != 0) continue;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++)
            if (strncmp(line + 7, known[i], strlen(known[i])) == 0) return true;
        break;
    }
    return gn_fail(import->err,
                   "%s: bad or missing format line in the header: expected ascii, "
                   "binary_little_endian or binary_big_endian",
                   path);
}

/* assimp takes a line feed that follows the header of a binary file for the rest of its last line,
 * and then reads all numbers one byte too early. */
void gn_import_ply_guard(struct gn_bytes *bytes) {
    static const char last[] = "\nend_header\n";
    const char *header = memmem(bytes->data, bytes->size, last, strlen(last));
    if (!header || !memmem(bytes->data, (size_t)(header - (const char *)bytes->data),
                           "\nformat binary", strlen("\nformat binary")))
        return;
    const size_t at = (size_t)(header - (const char *)bytes->data) + strlen(last);
    if (at >= bytes->size || bytes->data[at] != '\n') return;
    bytes->data = gn_import_grow(bytes->data, bytes->size + 2);
    memmove(bytes->data + at + 1, bytes->data + at, bytes->size + 1 - at);
    bytes->size++;
}
