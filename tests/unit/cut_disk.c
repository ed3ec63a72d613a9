#include "unit/cut_disk.h"

#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct gn_cut_disk gn_cut_disk;

static const char *path_of(int fd) {
    static char path[PATH_MAX];
    char link[40];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    path[length > 0 ? length : 0] = '\0';
    return path;
}

/* False: the call has no effect, errno is set. fd: -1: it is of no file of the stick. */
static bool begin_call(int fd) {
    const int call = gn_cut_disk.calls++;
    gn_cut_disk.dead |= call == gn_cut_disk.cut_at;
    gn_cut_disk.pulled |= call == gn_cut_disk.pull_at;
    errno = EIO;
    if (gn_cut_disk.dead) return false;
    if (gn_cut_disk.pulled && fd >= 0 &&
        strncmp(path_of(fd), gn_cut_disk.stick, strlen(gn_cut_disk.stick)) == 0)
        return false;
    errno = gn_cut_disk.reason;
    return call != gn_cut_disk.fail_at;
}

static void note_change(int kind, int folder, const char *name, const char *other, int kept) {
    assert_true(gn_cut_disk.change_count < GN_CUT_CHANGES);
    struct gn_cut_change *c = &gn_cut_disk.changes[gn_cut_disk.change_count++];
    *c = (struct gn_cut_change){.kind = kind, .kept = kept};
    c->folder = folder == AT_FDCWD ? folder : dup(folder);
    snprintf(c->name, sizeof c->name, "%s", name);
    snprintf(c->other, sizeof c->other, "%s", other ? other : "");
}

/* Moves what has that name into the trash; its number there, or -1. */
static int trash_name(int folder, const char *name) {
    char to[PATH_MAX];
    snprintf(to, sizeof to, "%s/%d", gn_cut_disk.trash, gn_cut_disk.trash_count);
    return renameat(folder, name, AT_FDCWD, to) == 0 ? gn_cut_disk.trash_count++ : -1;
}

static int cut_open(void *user, int folder, const char *name, int flags, mode_t mode) {
    (void)user;
    if (!begin_call(folder)) return -1;
    const bool makes = flags & O_CREAT && faccessat(folder, name, F_OK, 0) != 0;
    const int fd = gn_disk.open(NULL, folder, name, flags, mode);
    if (fd >= 0 && makes) note_change(GN_CUT_MADE, folder, name, NULL, -1);
    return fd;
}

static ssize_t cut_read(void *user, int fd, void *out, size_t size) {
    (void)user;
    return begin_call(fd) ? read(fd, out, size < 7 ? size : 7) : -1;
}

static ssize_t cut_write(void *user, int fd, const void *data, size_t size) {
    int i = 0;
    (void)user;
    if (!begin_call(-1)) return -1;
    while (i < gn_cut_disk.dirty_count && gn_cut_disk.dirty[i].fd != fd) i++;
    assert_true(i < GN_CUT_DIRTY);
    if (i == gn_cut_disk.dirty_count)
        gn_cut_disk.dirty[gn_cut_disk.dirty_count++] = (struct gn_cut_dirty){fd, dup(fd)};
    return write(fd, data, size < 5 ? size : 5);
}

static void forget_dirty(int i) {
    close(gn_cut_disk.dirty[i].own);
    gn_cut_disk.dirty[i] = gn_cut_disk.dirty[--gn_cut_disk.dirty_count];
}

static bool is_same(int a, int b) {
    struct stat one, other;
    return fstat(a, &one) == 0 && fstat(b, &other) == 0 && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

/* Those of that folder; -1: all. */
static void forget_changes(int folder) {
    int left = 0;
    for (int i = 0; i < gn_cut_disk.change_count; i++) {
        const struct gn_cut_change *c = &gn_cut_disk.changes[i];
        if (folder >= 0 && !is_same(c->folder, folder))
            gn_cut_disk.changes[left++] = *c;
        else if (c->folder >= 0)
            close(c->folder);
    }
    gn_cut_disk.change_count = left;
}

static int cut_fsync(void *user, int fd) {
    (void)user;
    if (!begin_call(-1)) return -1;
    for (int i = gn_cut_disk.dirty_count; i-- > 0;)
        if (gn_cut_disk.dirty[i].fd == fd) forget_dirty(i);
    forget_changes(fd);
    return 0;
}

/* A descriptor that is given out again is another file. */
static int cut_close(void *user, int fd) {
    (void)user;
    for (int i = 0; i < gn_cut_disk.dirty_count; i++)
        if (gn_cut_disk.dirty[i].fd == fd) gn_cut_disk.dirty[i].fd = -1;
    close(fd);
    return begin_call(-1) ? 0 : -1;
}

static int cut_mkdir(void *user, int folder, const char *name, mode_t mode) {
    (void)user;
    if (!begin_call(-1)) return -1;
    const int result = mkdirat(folder, name, mode);
    if (result == 0) note_change(GN_CUT_MADE, folder, name, NULL, -1);
    return result;
}

static int cut_rename(void *user, int folder, const char *from, const char *to) {
    (void)user;
    if (!begin_call(-1)) return -1;
    const int kept = trash_name(folder, to);
    note_change(GN_CUT_MOVED, folder, from, to, kept);
    return renameat(folder, from, folder, to);
}

static int cut_exchange(void *user, int folder, const char *a, const char *b) {
    (void)user;
    if (!begin_call(-1)) return -1;
    errno = EINVAL;
    if (gn_cut_disk.keeps_names) return -1;
    note_change(GN_CUT_EXCHANGED, folder, a, b, -1);
    return gn_disk.exchange(NULL, folder, a, b);
}

static int cut_symlink(void *user, const char *target, int folder, const char *name) {
    (void)user;
    if (!begin_call(-1)) return -1;
    const int result = symlinkat(target, folder, name);
    if (result == 0) note_change(GN_CUT_MADE, folder, name, NULL, -1);
    return result;
}

static int cut_unlink(void *user, int folder, const char *name, int flags) {
    struct stat info;
    (void)user;
    if (!begin_call(-1)) return -1;
    if (fstatat(folder, name, &info, AT_SYMLINK_NOFOLLOW) != 0) return -1;
    errno = flags ? ENOTDIR : EISDIR;
    if (S_ISDIR(info.st_mode) != (flags != 0)) return -1;
    note_change(GN_CUT_GONE, folder, name, NULL, trash_name(folder, name));
    return 0;
}

static int cut_list(void *user, int folder, struct gn_disk_names *names) {
    (void)user;
    return begin_call(folder) ? gn_disk.list(NULL, folder, names) : -1;
}

const struct gn_disk gn_cut_files = {
    .open = cut_open,
    .read = cut_read,
    .write = cut_write,
    .fsync = cut_fsync,
    .close = cut_close,
    .mkdir = cut_mkdir,
    .rename = cut_rename,
    .exchange = cut_exchange,
    .symlink = cut_symlink,
    .unlink = cut_unlink,
    .list = cut_list,
};

static int remove_one(const char *path, const struct stat *info, int flag, struct FTW *place) {
    (void)info, (void)flag, (void)place;
    return remove(path);
}

void gn_cut_remove(const char *folder) { nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS); }

void gn_cut_start(void) {
    while (gn_cut_disk.dirty_count) forget_dirty(0);
    forget_changes(-1);
    gn_cut_disk = (struct gn_cut_disk){.dir = gn_cut_disk.dir,
                                       .stick = gn_cut_disk.stick,
                                       .trash = gn_cut_disk.trash,
                                       .cut_at = -1,
                                       .pull_at = -1,
                                       .fail_at = -1,
                                       .reason = ENOSPC};
    gn_cut_remove(gn_cut_disk.trash);
    assert_int_equal(mkdir(gn_cut_disk.trash, 0755), 0);
}

static void undo_change(const struct gn_cut_change *c) {
    char kept[PATH_MAX];
    snprintf(kept, sizeof kept, "%s/%d", gn_cut_disk.trash, c->kept);
    switch (c->kind) {
    case GN_CUT_MADE: assert_true(trash_name(c->folder, c->name) >= 0); break;
    case GN_CUT_MOVED:
        assert_int_equal(renameat(c->folder, c->other, c->folder, c->name), 0);
        if (c->kept >= 0) assert_int_equal(renameat(AT_FDCWD, kept, c->folder, c->other), 0);
        break;
    case GN_CUT_EXCHANGED:
        assert_int_equal(gn_disk.exchange(NULL, c->folder, c->name, c->other), 0);
        break;
    case GN_CUT_GONE: assert_int_equal(renameat(AT_FDCWD, kept, c->folder, c->name), 0); break;
    }
}

void gn_cut_lose(enum gn_cut_loss loss) {
    const int dir = open(gn_cut_disk.dir, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    for (int i = gn_cut_disk.dirty_count; i-- > 0; forget_dirty(i)) {
        struct stat info;
        assert_int_equal(fstat(gn_cut_disk.dirty[i].own, &info), 0);
        assert_int_equal(ftruncate(gn_cut_disk.dirty[i].own, info.st_size / 2), 0);
    }
    for (int i = gn_cut_disk.change_count; loss != GN_CUT_NOTHING && i-- > 0;)
        if (loss == GN_CUT_ALL || !is_same(gn_cut_disk.changes[i].folder, dir))
            undo_change(&gn_cut_disk.changes[i]);
    close(dir);
    forget_changes(-1);
}
