/* Lines of vertices of an OBJ file that assimp 5.2 misreads or refuses: ".5" for "0.5"; texture
 * coordinates with one number, whose second is 0; comments, in which it counts numbers. And names
 * of objects, each of which it compares with all before: 100,000 took 30 s. Where there are many,
 * they become names of groups, which are nodes as well and take no search. */
#include <ctype.h>
#include <string.h>

#include "import/private.h"

enum { MOST_OBJECTS = 20000 };

struct copy {
    char *out; /* NULL: only counted */
    size_t size, objects;
    bool differs, as_groups;
};

static void put(struct copy *copy, const char *text, size_t size) {
    if (copy->out) memcpy(copy->out + copy->size, text, size);
    copy->size += size;
}

static bool is_blank(char c) { return c == ' ' || c == '\t'; }

/* The end of the number of a line "vt U"; NULL: it has another count, or goes on in the next. */
static const char *find_single(const char *line, const char *end) {
    const char *found = NULL;
    if (end - line < 3 || line[1] != 't' || !is_blank(line[2])) return NULL;
    for (const char *c = line + 2; c < end;) {
        while (c < end && is_blank(*c)) c++;
        if (c == end) break;
        if (found || *c == '\\') return NULL;
        while (c < end && !is_blank(*c)) c++;
        found = c;
    }
    return found;
}

static void copy_line(const char *line, const char *end, struct copy *copy) {
    const bool is_object = *line == 'o' && end - line > 1 && is_blank(line[1]);
    copy->objects += is_object;
    if (is_object && copy->as_groups) {
        put(copy, "g", 1);
        line++;
    }
    if (*line != 'v') {
        put(copy, line, (size_t)(end - line));
        return;
    }
    const char *comment = memchr(line, '#', (size_t)(end - line));
    if (comment) end = comment;
    const char *single = find_single(line, end);
    copy->differs |= comment || single;
    for (const char *c = line; c < end; c++) {
        if (c == single) put(copy, " 0", 2);
        const bool is_bare = *c == '.' && is_blank(c[-1]) && isdigit((unsigned char)c[1]);
        copy->differs |= is_bare;
        if (is_bare) put(copy, "0", 1);
        put(copy, c, 1);
    }
    if (single == end) put(copy, " 0", 2);
}

static void copy_lines(const char *text, const char *end, struct copy *copy) {
    while (text < end) {
        const char *line = text;
        while (text < end && *text != '\n' && *text != '\r') text++;
        if (text > line) copy_line(line, text, copy);
        if (text < end) put(copy, text++, 1);
    }
}

void gn_import_obj_pad(struct gn_bytes *bytes) {
    const char *text = (const char *)bytes->data, *end = text + bytes->size;
    struct copy count = {0};
    copy_lines(text, end, &count);
    const bool as_groups = count.objects > MOST_OBJECTS;
    if (!count.differs && !as_groups) return;
    struct copy padded = {.out = gn_import_alloc(count.size + 1), .as_groups = as_groups};
    copy_lines(text, end, &padded);
    padded.out[padded.size] = 0;
    gn_bytes_finish(bytes);
    *bytes = (struct gn_bytes){.data = (uint8_t *)padded.out, .size = padded.size};
}
