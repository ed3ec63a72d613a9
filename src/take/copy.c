#include "take/copy.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/hash.h"

enum { PIECE = 1 << 18, REMOVE_DEPTH = 64 };
enum { FOLLOWS_NOTHING = O_NOFOLLOW | O_NONBLOCK | O_NOCTTY };

/* ---- names ---------------------------------------------------------------------------------- */

/* How many bytes the UTF-8 character has; 0: it is none, or one that turns or ends a line. */
static size_t character_length(const unsigned char *at) {
    if (at[0] < 0x80) return at[0] >= 0x20 && at[0] != 0x7f;
    const size_t length = at[0] >= 0xc2 && at[0] < 0xe0 ? 2 : (at[0] & 0xf0) == 0xe0 ? 3 : 4;
    if (at[0] < 0xc2 || at[0] > 0xf4) return 0;
    uint32_t code = at[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((at[i] & 0xc0) != 0x80) return 0;
        code = code << 6 | (at[i] & 0x3f);
    }
    const bool is_short = code < (length == 3 ? 0x800u : length == 4 ? 0x10000u : 0x80u);
    const bool moves =
        code < 0xa0 || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return is_short || moves || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : length;
}

static bool is_text(const char *name) {
    const unsigned char *at = (const unsigned char *)name;
    while (*at) {
        const size_t length = character_length(at);
        if (length == 0) return false;
        at += length;
    }
    return true;
}

/* What systems put onto a stick by themselves, and our own report. */
static bool is_ignored(const char *name) {
    static const char *const names[] = {"System Volume Information", "$RECYCLE.BIN", "desktop.ini",
                                        "Thumbs.db", "gnomon-status.txt"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcasecmp(name, names[i]) == 0) return true;
    return name[0] == '.' || strncmp(name, "~$", 2) == 0;
}

/* Adds a part to the path for messages; where it ended before, or -1. */
static int add_part(struct gn_take_walk *w, const char *name, struct gn_err *err) {
    const size_t used = strlen(w->path);
    if (!is_text(name)) {
        gn_fail(err, "%s: a name in it is not UTF-8, or has control characters; rename it",
                w->path);
        return -1;
    }
    if (used + 1 + strlen(name) >= sizeof w->path) {
        gn_fail(err, "%s: too long a path", w->path);
        return -1;
    }
    snprintf(w->path + used, sizeof w->path - used, "/%s", name);
    return (int)used;
}

/* ---- files ---------------------------------------------------------------------------------- */

static bool fail_write(const struct gn_take_walk *w, struct gn_err *err) {
    if (errno == EEXIST)
        return gn_fail(err, "%s: another name differs from it only in capitals; rename one",
                       w->path);
    return gn_fail(err, "%s: cannot write its copy: %s", w->path, strerror(errno));
}

/* to: -1: it is only hashed. */
static bool move_bytes(struct gn_take_walk *w, int from, int to, struct gn_err *err) {
    static char piece[PIECE];
    ssize_t got;
    uint64_t size = 0;
    while ((got = gn_disk_read_all(w->files, from, piece, PIECE)) > 0) {
        w->bytes += (uint64_t)got;
        size += (uint64_t)got;
        if (w->bytes > w->limits.bytes)
            return gn_fail(err, "%s: with this file the folder has more than %llu MB", w->path,
                           (unsigned long long)(w->limits.bytes >> 20));
        w->hash = gn_hash(w->hash, piece, (size_t)got);
        if (to >= 0 && !gn_disk_write_all(w->files, to, piece, (size_t)got))
            return fail_write(w, err);
    }
    if (got < 0) return gn_fail(err, "%s: cannot read: %s", w->path, strerror(errno));
    w->hash = gn_hash(w->hash, &size, sizeof size);
    return true;
}

static bool walk_file(struct gn_take_walk *w, int from, int to, const char *name,
                      struct gn_err *err) {
    const struct gn_disk *files = w->files;
    w->count++;
    if (to < 0) return move_bytes(w, from, -1, err);
    const int copy =
        files->open(files->user, to, name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0644);
    if (copy < 0) return fail_write(w, err);
    bool ok = move_bytes(w, from, copy, err);
    if (ok && files->fsync(files->user, copy) != 0) ok = fail_write(w, err);
    if (files->close(files->user, copy) != 0 && ok) ok = fail_write(w, err);
    return ok;
}

/* ---- folders -------------------------------------------------------------------------------- */

static bool walk_folder(struct gn_take_walk *w, int from, int to, int depth, struct gn_err *err);

static bool walk_subfolder(struct gn_take_walk *w, int from, int to, const char *name, int depth,
                           struct gn_err *err) {
    const struct gn_disk *files = w->files;
    if (depth == w->limits.depth)
        return gn_fail(err, "%s: more than %d folders in each other", w->path, w->limits.depth);
    if (to < 0) return walk_folder(w, from, -1, depth + 1, err);
    if (files->mkdir(files->user, to, name, 0755) != 0) return fail_write(w, err);
    const int copy = files->open(files->user, to, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW, 0);
    if (copy < 0) return fail_write(w, err);
    const bool ok = walk_folder(w, from, copy, depth + 1, err);
    files->close(files->user, copy);
    return ok;
}

/* Opens what is a file or a folder. A pipe or a device is not even opened. */
static int open_entry(const struct gn_take_walk *w, int folder, const char *name, struct stat *info,
                      struct gn_err *err) {
    const struct gn_disk *files = w->files;
    int fd = -1;
    if (fstatat(folder, name, info, AT_SYMLINK_NOFOLLOW) != 0 ||
        ((S_ISREG(info->st_mode) || S_ISDIR(info->st_mode)) &&
         ((fd = files->open(files->user, folder, name, O_RDONLY | FOLLOWS_NOTHING, 0)) < 0 ||
          fstat(fd, info) != 0)))
        gn_fail(err, "%s: cannot read: %s", w->path, strerror(errno));
    else if (S_ISLNK(info->st_mode))
        gn_fail(err, "%s: is a symbolic link; put the file itself there", w->path);
    else if (!S_ISREG(info->st_mode) && !S_ISDIR(info->st_mode))
        gn_fail(err, "%s: is neither a file nor a folder", w->path);
    else
        return fd;
    if (fd >= 0) files->close(files->user, fd);
    return -1;
}

static void note_top(struct gn_take_walk *w, const char *name) {
    w->has_ini |= strcmp(name, GN_TAKE_INI) == 0;
    if (!gn_take_is_scene(name)) return;
    const size_t used = strlen(w->names);
    if (used < sizeof w->names)
        snprintf(w->names + used, sizeof w->names - used, "%s%s", w->scenes ? ", " : "", name);
    w->scenes++;
}

static bool walk_entry(struct gn_take_walk *w, int from, int to, const char *name, int depth,
                       struct gn_err *err) {
    struct stat info;
    if (is_ignored(name)) return true;
    const int end = add_part(w, name, err);
    if (end < 0) return false;
    if (++w->entries > w->limits.files)
        return gn_fail(err, "%s: more than %d files and folders", w->path, w->limits.files);
    const int fd = open_entry(w, from, name, &info, err);
    if (fd < 0) return false;
    const bool is_file = S_ISREG(info.st_mode);
    /* FAT keeps capitals, and Windows does not care about them */
    const char *own =
        is_file && depth == 0 && strcasecmp(name, GN_TAKE_INI) == 0 ? GN_TAKE_INI : name;
    if (is_file && depth == 0) note_top(w, own);
    w->hash = gn_hash(w->hash, w->path, strlen(w->path));
    const bool ok =
        is_file ? walk_file(w, fd, to, own, err) : walk_subfolder(w, fd, to, own, depth, err);
    w->files->close(w->files->user, fd);
    w->path[end] = '\0';
    return ok;
}

static bool walk_folder(struct gn_take_walk *w, int from, int to, int depth, struct gn_err *err) {
    const struct gn_disk *files = w->files;
    struct gn_disk_names names = {0};
    bool ok = files->list(files->user, from, &names) == 0 ||
              gn_fail(err, "%s: cannot read: %s", w->path, strerror(errno));
    for (int i = 0; ok && i < names.count; i++)
        ok = walk_entry(w, from, to, names.items[i], depth, err);
    gn_disk_free_names(&names);
    if (ok && to >= 0 && files->fsync(files->user, to) != 0) ok = fail_write(w, err);
    return ok;
}

bool gn_take_walk(struct gn_take_walk *walk, int from, int to, struct gn_err *err) {
    snprintf(walk->path, sizeof walk->path, "gnomon");
    walk->hash = GN_HASH_INIT;
    return walk_folder(walk, from, to, 0, err);
}

/* ---- removing ------------------------------------------------------------------------------- */

static bool remove_entry(const struct gn_disk *files, int folder, const char *name, int depth) {
    if (files->unlink(files->user, folder, name, 0) == 0 || errno == ENOENT) return true;
    const int flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW;
    const int own = depth < REMOVE_DEPTH ? files->open(files->user, folder, name, flags, 0) : -1;
    struct gn_disk_names names = {0};
    if (own < 0) return false;
    bool ok = files->list(files->user, own, &names) == 0;
    for (int i = 0; i < names.count; i++) ok &= remove_entry(files, own, names.items[i], depth + 1);
    gn_disk_free_names(&names);
    files->close(files->user, own);
    return ok && files->unlink(files->user, folder, name, AT_REMOVEDIR) == 0;
}

bool gn_take_remove(const struct gn_disk *files, int folder, const char *name) {
    return remove_entry(files, folder, name, 0);
}
