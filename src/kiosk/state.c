#include "kiosk/state.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "core/file.h"

static const char head[] = "gnomon-state 1\n", sum_key[] = "crc32 ";
enum { SUM_LENGTH = sizeof sum_key - 1 + 8 + 1 }; /* "crc32 0123abcd\n" */

/* ---- text ----------------------------------------------------------------------------------- */

static unsigned sum_text(const char *text, size_t size) {
    return (unsigned)crc32(0, (const Bytef *)text, (uInt)size);
}

/* The lines between the first and the last, in their order. */
static const struct line {
    const char *key;
    enum { TEXT, FLAG, NUMBER } kind;
    size_t offset, size;
} lines[] = {
#define LINE(key, kind, member)                                                                    \
    { key, kind, offsetof(struct gn_state, member), sizeof((struct gn_state *)0)->member }
    LINE("sequence", NUMBER, sequence),
    LINE("mode", TEXT, mode),
    LINE("scene", TEXT, scene),
    LINE("past", TEXT, past),
    LINE("listed", TEXT, listed),
    LINE("given", FLAG, given),
    LINE("runs", FLAG, runs),
    LINE("boot", TEXT, boot),
#define X(id) LINE(#id, NUMBER, counts.id),
    GN_STATE_COUNTS(X)
#undef X
#undef LINE
};
enum { LINES = sizeof lines / sizeof lines[0] };

static size_t print_line(const struct line *line, const void *value, char *out, size_t size) {
    const char *text = value;
    switch (line->kind) {
    case TEXT:
        if (!text[0] || strpbrk(text, "\r\n")) return 0;
        return (size_t)snprintf(out, size, "%s %s\n", line->key, text);
    case FLAG:
        return (size_t)snprintf(out, size, "%s %s\n", line->key,
                                *(const bool *)value ? "yes" : "no");
    default:
        return (size_t)snprintf(out, size, "%s %" PRIu64 "\n", line->key, *(const uint64_t *)value);
    }
}

size_t gn_state_print(const struct gn_state *s, char out[GN_STATE_TEXT_MAX]) {
    size_t used = (size_t)snprintf(out, GN_STATE_TEXT_MAX, "%s", head);
    for (int i = 0; i < LINES; i++)
        used += print_line(&lines[i], (const char *)s + lines[i].offset, out + used,
                           GN_STATE_TEXT_MAX - used);
    return used + (size_t)snprintf(out + used, GN_STATE_TEXT_MAX - used, "%s%08x\n", sum_key,
                                   sum_text(out, used));
}

static bool is_whole(const char *text, size_t size, struct gn_err *err) {
    char sum[SUM_LENGTH + 1];
    if (size < sizeof head - 1 + SUM_LENGTH || memcmp(text, head, sizeof head - 1) != 0)
        return gn_fail(err, "is no state of this version");
    snprintf(sum, sizeof sum, "%s%08x\n", sum_key, sum_text(text, size - SUM_LENGTH));
    return memcmp(text + size - SUM_LENGTH, sum, SUM_LENGTH) == 0 ||
           gn_fail(err, "its checksum is wrong");
}

/* length: that of the value, which ends before a line end. */
static void take_value(const struct line *line, const char *value, size_t length, void *out) {
    switch (line->kind) {
    case TEXT:
        if (length >= line->size) return; /* written by a later version */
        memcpy(out, value, length);
        ((char *)out)[length] = 0;
        break;
    case FLAG: *(bool *)out = *value == 'y'; break;
    case NUMBER: *(uint64_t *)out = strtoull(value, NULL, 10); break;
    }
}

static void take_line(struct gn_state *s, const char *text, size_t length) {
    const char *space = memchr(text, ' ', length);
    const size_t key = space ? (size_t)(space - text) : length;
    for (int i = 0; space && i < LINES; i++)
        if (strlen(lines[i].key) == key && memcmp(lines[i].key, text, key) == 0)
            take_value(&lines[i], space + 1, length - key - 1, (char *)s + lines[i].offset);
}

bool gn_state_parse(const char *text, size_t size, struct gn_state *out, struct gn_err *err) {
    *out = (struct gn_state){0};
    if (!is_whole(text, size, err)) return false;
    const char *end = text + size;
    for (const char *line = text; line < end;) {
        const char *stop = memchr(line, '\n', (size_t)(end - line)); /* the checksum's, at least */
        take_line(out, line, (size_t)(stop - line));
        line = stop + 1;
    }
    return true;
}

/* ---- both generations ------------------------------------------------------------------------ */

struct name {
    char text[PATH_MAX + 8];
};

static struct name name_of(const char *path, int generation) {
    struct name name;
    snprintf(name.text, sizeof name.text, "%s%s", path, generation ? ".2" : "");
    return name;
}

static ssize_t read_text(const struct gn_disk *disk, const char *path, char *out, size_t size) {
    const int fd = disk->open(disk->user, AT_FDCWD, path, O_RDONLY | O_NONBLOCK | O_NOCTTY, 0);
    if (fd < 0) return -1;
    const ssize_t got = gn_disk_read_all(disk, fd, out, size);
    const int reason = errno;
    disk->close(disk->user, fd);
    errno = reason;
    return got;
}

/* Sets *gone if there is no such file. */
static bool read_generation(const struct gn_disk *disk, const char *path, struct gn_state *out,
                            bool *gone, struct gn_err *err) {
    char text[GN_STATE_TEXT_MAX + 1];
    const ssize_t size = read_text(disk, path, text, sizeof text);
    *gone = size < 0 && errno == ENOENT;
    if (size < 0) return gn_fail(err, "%s: cannot read: %s", path, strerror(errno));
    if (size > GN_STATE_TEXT_MAX) return gn_fail(err, "%s: is too long for a state", path);
    if (gn_state_parse(text, (size_t)size, out, err)) return true;
    gn_fail_prefix(err, "%s", path);
    return false;
}

enum gn_state_found gn_state_read(const struct gn_disk *disk, const char *path,
                                  struct gn_state *out, int *older, struct gn_err *err) {
    struct gn_state other = {0};
    struct gn_err why[2] = {0};
    bool gone[2];
    *out = (struct gn_state){0};
    const bool first = read_generation(disk, name_of(path, 0).text, out, &gone[0], &why[0]);
    const bool second = read_generation(disk, name_of(path, 1).text, &other, &gone[1], &why[1]);
    *older = first && (!second || other.sequence <= out->sequence);
    if (second && *older == 0) *out = other;
    if (first || second) return GN_STATE_READ;
    if (gone[0] && gone[1]) return GN_STATE_NONE;
    *err = why[gone[0]];
    return GN_STATE_BROKEN;
}

bool gn_state_save(const struct gn_disk *disk, const char *path, int older,
                   const struct gn_state *state, struct gn_err *err) {
    char text[GN_STATE_TEXT_MAX];
    const size_t size = gn_state_print(state, text);
    return gn_file_keep(disk, name_of(path, older).text, text, size, err);
}
