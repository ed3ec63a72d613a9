#include "take/take.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "core/clock.h"
#include "take/copy.h"

static const char versions[] = "versions", previous[] = "previous", link_new[] = "link.new";
static const uint64_t BYTES = UINT64_C(2) << 30, RESERVE = 64 << 20;
enum { FILES = 4096, DEPTH = 8, PATIENCE_S = 60 };

static struct gn_take_limits limits_or_default(const struct gn_take_limits *given) {
    const struct gn_take_limits own = given ? *given : (struct gn_take_limits){0};
    return (struct gn_take_limits){.bytes = own.bytes ? own.bytes : BYTES,
                                   .reserve = own.reserve ? own.reserve : RESERVE,
                                   .files = own.files ? own.files : FILES,
                                   .depth = own.depth ? own.depth : DEPTH,
                                   .patience_ns = own.patience_ns ? own.patience_ns
                                                                  : PATIENCE_S * GN_NS_PER_S};
}

static int open_folder(const struct gn_take *t, int at, const char *name) {
    return t->files->open(t->files->user, at, name, O_RDONLY | O_DIRECTORY, 0);
}

static void close_one(const struct gn_take *t, int *fd) {
    if (*fd >= 0) t->files->close(t->files->user, *fd);
    *fd = -1;
}

/* ---- versions ------------------------------------------------------------------------------- */

/* The version that the link leads to; "" where there is no link, or it leads to nothing. False: it
 * cannot be read, or is not ours; then no version may be removed. */
static bool read_link(const struct gn_take *t, const char *name, char out[GN_TAKE_NAME]) {
    char target[sizeof versions + GN_TAKE_NAME];
    struct stat info;
    const ssize_t length = readlinkat(t->folder, name, target, sizeof target - 1);
    out[0] = '\0';
    if (length < 0) return errno == ENOENT;
    target[length] = '\0';
    const char *version = target + sizeof versions;
    if (length <= (ssize_t)sizeof versions || length == (ssize_t)sizeof target - 1 ||
        strncmp(target, versions, sizeof versions - 1) != 0 || version[-1] != '/' ||
        strchr(version, '/') || version[0] == '.') {
        errno = EINVAL;
        return false;
    }
    if (fstatat(t->versions, version, &info, AT_SYMLINK_NOFOLLOW) != 0) return errno == ENOENT;
    snprintf(out, GN_TAKE_NAME, "%s", version);
    return true;
}

static bool read_links(struct gn_take *t, struct gn_err *err) {
    if (read_link(t, GN_TAKE_CURRENT, t->shown) && read_link(t, previous, t->before)) return true;
    return gn_fail(err, "%s: its links current and previous are not those of gnomon take: %s",
                   t->path, strerror(errno));
}

/* Removes what no link leads to. What cannot be removed stays for the next time. */
static void remove_others(struct gn_take *t) {
    struct gn_disk_names names = {0};
    if (t->files->list(t->files->user, t->versions, &names) == 0)
        for (int i = 0; i < names.count; i++) {
            const char *name = names.items[i];
            const unsigned number = (unsigned)strtoul(name, NULL, 10);
            if (number >= t->number) t->number = number + 1;
            if (strcmp(name, t->shown) != 0 && strcmp(name, t->before) != 0)
                gn_take_remove(t->files, t->versions, name);
        }
    gn_disk_free_names(&names);
}

static unsigned number_of(const char *version) { return (unsigned)strtoul(version, NULL, 10); }

static bool has_hash(const char *version, uint64_t hash) {
    char text[24];
    const char *dash = strchr(version, '-');
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return dash && strcmp(dash + 1, text) == 0;
}

/* ---- opening -------------------------------------------------------------------------------- */

static bool fail_dir(const char *dir, const char *what, struct gn_err *err) {
    return gn_fail(err, "%s: cannot %s: %s", dir, what, strerror(errno));
}

static bool lock_dir(struct gn_take *t, const char *dir, struct gn_err *err) {
    const int64_t until_ns = gn_clock_monotonic_ns() + t->limits.patience_ns;
    t->lock =
        t->files->open(t->files->user, t->folder, "lock", O_RDWR | O_CREAT | O_NOFOLLOW, 0644);
    if (t->lock < 0) return fail_dir(dir, "write into it", err);
    while (flock(t->lock, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK && errno != EINTR) return fail_dir(dir, "lock it", err);
        if (gn_clock_monotonic_ns() > until_ns)
            return gn_fail(err, "%s: another gnomon take is at work there", dir);
        usleep(50000);
    }
    return true;
}

static bool make_folder(const struct gn_take *t, int at, const char *name) {
    return t->files->mkdir(t->files->user, at, name, 0755) == 0 || errno == EEXIST;
}

bool gn_take_open(struct gn_take *t, const struct gn_disk *files, const char *dir,
                  const struct gn_take_limits *limits, struct gn_err *err) {
    *t = (struct gn_take){.files = files,
                          .limits = limits_or_default(limits),
                          .folder = -1,
                          .versions = -1,
                          .lock = -1,
                          .from = -1,
                          .number = 1};
    if (!make_folder(t, AT_FDCWD, dir)) return fail_dir(dir, "make it", err);
    t->folder = open_folder(t, AT_FDCWD, dir);
    if (t->folder < 0) return fail_dir(dir, "open it", err);
    if (!lock_dir(t, dir, err)) return false;
    if (!make_folder(t, t->folder, versions)) return fail_dir(dir, "write into it", err);
    t->versions = open_folder(t, t->folder, versions);
    if (t->versions < 0) return fail_dir(dir, "open its versions", err);
    if (!realpath(dir, t->path)) return fail_dir(dir, "find it", err);
    if (!read_links(t, err)) return false;
    remove_others(t);
    snprintf(t->fresh, sizeof t->fresh, "%u.new", t->number);
    const size_t used = strlen(t->path);
    const int length =
        snprintf(t->path + used, sizeof t->path - used, "/%s/%s", versions, t->fresh);
    return used + (size_t)length < sizeof t->path || gn_fail(err, "%s: too long a path", dir);
}

void gn_take_close(struct gn_take *t) {
    close_one(t, &t->from);
    close_one(t, &t->versions);
    close_one(t, &t->lock); /* ends the lock */
    close_one(t, &t->folder);
}

/* ---- looking -------------------------------------------------------------------------------- */

/* The stick's folder, in any case; -1 and ENOENT: there is none. */
static int find_gnomon(struct gn_take *t, int stick) {
    const int flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW;
    struct gn_disk_names names = {0};
    snprintf(t->name, sizeof t->name, "gnomon");
    int fd = t->files->open(t->files->user, stick, t->name, flags, 0), reason = errno;
    if (fd >= 0 || reason != ENOENT) return fd;
    if (t->files->list(t->files->user, stick, &names) != 0) reason = errno;
    for (int i = 0; reason == ENOENT && i < names.count; i++)
        if (strcasecmp(names.items[i], "gnomon") == 0) {
            snprintf(t->name, sizeof t->name, "%s", names.items[i]);
            fd = t->files->open(t->files->user, stick, t->name, flags, 0);
            if (fd >= 0) break;
            reason = errno;
        }
    gn_disk_free_names(&names);
    errno = reason;
    return fd;
}

static bool open_gnomon(struct gn_take *t, const char *stick, struct gn_err *err) {
    int top = open_folder(t, AT_FDCWD, stick);
    if (top < 0) return gn_fail(err, "%s: cannot open it: %s", stick, strerror(errno));
    t->from = find_gnomon(t, top);
    const int reason = errno;
    close_one(t, &top);
    if (t->from >= 0 || reason == ENOENT || reason == ENOTDIR || reason == ELOOP) return true;
    return gn_fail(err, "%s: cannot read its folder gnomon: %s", stick, strerror(reason));
}

static bool check_kind(const struct gn_take_walk *w, struct gn_err *err) {
    if (w->has_ini || w->scenes == 1) return true;
    if (w->scenes == 0)
        return gn_fail(err, "gnomon: neither a kiosk.ini nor a scene (.glb or .gltf, say) in it");
    return gn_fail(err,
                   "gnomon: %d scenes (%s), and no kiosk.ini that names one: keep one of them, "
                   "or add a kiosk.ini with [scene] and file = NAME",
                   w->scenes, w->names);
}

static bool check_space(const struct gn_take *t, struct gn_err *err) {
    struct statvfs info;
    if (fstatvfs(t->versions, &info) != 0) return true; /* then the disk will say so */
    const uint64_t free_bytes = (uint64_t)info.f_bavail * info.f_frsize;
    if (free_bytes >= t->bytes + t->limits.reserve) return true;
    return gn_fail(err,
                   "gnomon: has %llu MB, and the disk has only %llu MB free, of which %llu MB "
                   "are kept",
                   (unsigned long long)(t->bytes + 1048575) >> 20,
                   (unsigned long long)free_bytes >> 20,
                   (unsigned long long)t->limits.reserve >> 20);
}

enum gn_take_found gn_take_look(struct gn_take *t, const char *stick, struct gn_err *err) {
    struct gn_take_walk walk = {.files = t->files, .limits = t->limits};
    if (!open_gnomon(t, stick, err)) return GN_TAKE_FAILED;
    if (t->from < 0) return GN_TAKE_NOTHING;
    if (!gn_take_walk(&walk, t->from, -1, err)) return GN_TAKE_FAILED;
    if (walk.count == 0) return GN_TAKE_NOTHING;
    t->hash = walk.hash;
    t->bytes = walk.bytes;
    t->count = walk.count;
    if (has_hash(t->shown, t->hash)) return GN_TAKE_SAME;
    if (has_hash(t->before, t->hash) && number_of(t->before) > number_of(t->shown))
        return GN_TAKE_BACK;
    return check_kind(&walk, err) && check_space(t, err) ? GN_TAKE_FRESH : GN_TAKE_FAILED;
}

/* ---- copying, showing ----------------------------------------------------------------------- */

bool gn_take_copy(struct gn_take *t, struct gn_err *err) {
    struct gn_take_walk walk = {.files = t->files, .limits = t->limits};
    int to = -1;
    bool ok = t->files->mkdir(t->files->user, t->versions, t->fresh, 0755) == 0 &&
              (to = open_folder(t, t->versions, t->fresh)) >= 0;
    if (!ok) gn_fail(err, "%s: cannot make it: %s", t->path, strerror(errno));
    ok = ok && gn_take_walk(&walk, t->from, to, err);
    if (ok && (walk.hash != t->hash || walk.bytes != t->bytes))
        ok = gn_fail(err, "gnomon: has changed while it was copied; plug the stick in again");
    close_one(t, &to);
    if (!ok) gn_take_drop(t);
    return ok;
}

void gn_take_drop(struct gn_take *t) { gn_take_remove(t->files, t->versions, t->fresh); }

static bool fail_switch(const struct gn_take *t, struct gn_err *err) {
    return gn_fail(err, "%s: cannot be shown: %s", t->path, strerror(errno));
}

/* The link leads to the one version or to the other at any moment. */
static bool turn_link(const struct gn_take *t, const char *name, const char *version) {
    const struct gn_disk *files = t->files;
    char target[sizeof versions + GN_TAKE_NAME];
    snprintf(target, sizeof target, "%s/%s", versions, version);
    if (files->unlink(files->user, t->folder, link_new, 0) != 0 && errno != ENOENT) return false;
    return files->symlink(files->user, target, t->folder, link_new) == 0 &&
           files->rename(files->user, t->folder, link_new, name) == 0 &&
           files->fsync(files->user, t->folder) == 0;
}

bool gn_take_keep(struct gn_take *t, struct gn_err *err) {
    const struct gn_disk *files = t->files;
    char name[GN_TAKE_NAME];
    snprintf(name, sizeof name, "%u-%016" PRIx64, t->number, t->hash);
    if (files->rename(files->user, t->versions, t->fresh, name) != 0 ||
        files->fsync(files->user, t->versions) != 0 ||
        (t->shown[0] && !turn_link(t, previous, t->shown)) || !turn_link(t, GN_TAKE_CURRENT, name))
        return fail_switch(t, err);
    if (!read_links(t, err)) return false;
    remove_others(t);
    return true;
}

bool gn_take_back(struct gn_take *t, struct gn_err *err) {
    const struct gn_disk *files = t->files;
    char shown[GN_TAKE_NAME];
    snprintf(shown, sizeof shown, "%s", t->shown);
    if (!t->before[0] || strcmp(t->before, shown) == 0)
        return gn_fail(err, "there is no version before this one");
    if (files->exchange(files->user, t->folder, GN_TAKE_CURRENT, previous) == 0) {
        if (files->fsync(files->user, t->folder) != 0) return fail_switch(t, err);
    } else if (!turn_link(t, GN_TAKE_CURRENT, t->before) ||
               (shown[0] && !turn_link(t, previous, shown))) {
        return fail_switch(
            t, err); /* nothing is shown, or the file system cannot exchange two names */
    }
    return read_links(t, err);
}

bool gn_take_give_up(struct gn_take *t, struct gn_err *err) {
    if (t->before[0] && number_of(t->before) < number_of(t->shown)) return gn_take_back(t, err);
    if ((!t->before[0] && !turn_link(t, previous, t->shown)) ||
        t->files->unlink(t->files->user, t->folder, GN_TAKE_CURRENT, 0) != 0 ||
        t->files->fsync(t->files->user, t->folder) != 0)
        return fail_switch(t, err);
    return read_links(t, err);
}
