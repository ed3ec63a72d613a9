/* Numbers of an OBJ file that assimp 5.2 does not count as numbers: ".5" for "0.5". */
#include <ctype.h>
#include <string.h>

#include "import/private.h"

/* Copies text into out unless that is NULL, with a 0 before the point of such numbers in lines of
 * vertices; returns the size of the copy. */
static size_t pad_numbers(const char *text, const char *end, char *out) {
    size_t size = 0;
    bool is_vertex = false;
    for (const char *c = text; c < end; c++) {
        if (c == text || c[-1] == '\n' || c[-1] == '\r') is_vertex = *c == 'v';
        if (is_vertex && *c == '.' && (c[-1] == ' ' || c[-1] == '\t') &&
            isdigit((unsigned char)c[1])) { /* a zero byte follows the last */
            if (out) out[size] = '0';
            size++;
        }
        if (out) out[size] = *c;
        size++;
    }
    return size;
}

void gn_import_obj_pad(struct gn_bytes *bytes) {
    const char *text = (const char *)bytes->data, *end = text + bytes->size;
    const size_t size = pad_numbers(text, end, NULL);
    if (size == bytes->size) return;
    struct gn_bytes padded = {.data = gn_import_alloc(size + 1), .size = size};
    pad_numbers(text, end, (char *)padded.data);
    padded.data[size] = 0;
    gn_bytes_finish(bytes);
    *bytes = padded;
}
