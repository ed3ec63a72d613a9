/* The state of a kiosk against a disk that loses its power: a file system in memory notes every
 * system call, the power is cut before each of them, and what was not flushed is lost, torn at any
 * length, or zeros. The reader then finds the old state or the new one. */
#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "kiosk/state.h"
#include "unit/folder.h"

static struct gn_err err;

/* ---- a disk --------------------------------------------------------------------------------- */

enum { INODES = 64, NAMES = 4, PENDING = 64, AT_ONCE = 48 /* bytes that a write takes */ };
enum { FIRST_FD = 1000, FOLDER_FD = 2000 };
static const char *const names[] = {"/d/state", "/d/state.2"};
struct disk {
    struct inode {
        char data[GN_STATE_TEXT_MAX];
        size_t size, safe; /* bytes; that many are on the disk for sure */
    } inodes[INODES];
    int inode_count;
    int now[NAMES], safe[NAMES]; /* inode + 1 of each name; 0: none */
    struct change {              /* of the folder, since it was flushed, in their order */
        int name, from, inode;   /* from: the name that ends, or -1 */
    } pending[PENDING];
    int pending_count;
    int calls, cut_at, fail_at, reason; /* -1: not */
    bool dead;
    int torn; /* after a cut, see disk_read() */
    size_t at;
};

/* False: the call has no effect, errno is set. */
static bool begin_call(struct disk *d) {
    const int call = d->calls++;
    d->dead |= call == d->cut_at;
    errno = d->dead ? EIO : d->reason;
    return !d->dead && call != d->fail_at;
}

/* Both generations, and the temporary files, by the number at their end. */
static int name_number(const char *path) {
    for (int i = 0; i < 2; i++)
        if (strcmp(path, names[i]) == 0) return i;
    assert_int_equal(strncmp(path, "/d/.gnomon-", 11), 0);
    const int number = 2 + atoi(strrchr(path, '-') + 1);
    assert_true(number < NAMES);
    return number;
}

static void change_folder(struct disk *d, int name, int from, int inode) {
    if (from >= 0) d->now[from] = 0;
    d->now[name] = inode;
    assert_true(d->pending_count < PENDING);
    d->pending[d->pending_count++] = (struct change){name, from, inode};
}

/* Reading is no call that can be cut. */
static int disk_open(void *user, int folder, const char *path, int flags, mode_t mode) {
    struct disk *d = user;
    (void)mode;
    assert_int_equal(folder, AT_FDCWD);
    if (!(flags & O_CREAT) && !(flags & O_DIRECTORY)) {
        const int inode = d->now[name_number(path)];
        d->at = 0;
        errno = ENOENT;
        return inode ? FIRST_FD + inode : -1;
    }
    if (!begin_call(d)) return -1;
    if (flags & O_DIRECTORY) {
        assert_string_equal(path, "/d/");
        return FOLDER_FD;
    }
    assert_true(flags & O_EXCL);
    errno = EEXIST;
    if (d->now[name_number(path)]) return -1;
    assert_true(d->inode_count < INODES);
    d->inodes[d->inode_count].size = d->inodes[d->inode_count].safe = 0;
    change_folder(d, name_number(path), -1, ++d->inode_count);
    return FIRST_FD + d->inode_count;
}

static ssize_t disk_write(void *user, int fd, const void *data, size_t size) {
    struct disk *d = user;
    struct inode *inode = &d->inodes[fd - FIRST_FD - 1];
    if (!begin_call(d)) return -1;
    if (size > AT_ONCE) size = AT_ONCE;
    memcpy(inode->data + inode->size, data, size);
    inode->size += size;
    return (ssize_t)size;
}

static int disk_fsync(void *user, int fd) {
    struct disk *d = user;
    if (!begin_call(d)) return -1;
    if (fd == FOLDER_FD) {
        memcpy(d->safe, d->now, sizeof d->safe);
        d->pending_count = 0;
    } else {
        d->inodes[fd - FIRST_FD - 1].safe = d->inodes[fd - FIRST_FD - 1].size;
    }
    return 0;
}

static int disk_close(void *user, int fd) {
    (void)fd;
    return begin_call(user) ? 0 : -1;
}

static int disk_rename(void *user, int folder, const char *from, const char *to) {
    struct disk *d = user;
    (void)folder;
    if (!begin_call(d)) return -1;
    const int old = name_number(from);
    assert_true(d->now[old] > 0);
    change_folder(d, name_number(to), old, d->now[old]);
    return 0;
}

static int disk_unlink(void *user, int folder, const char *path, int flags) {
    struct disk *d = user;
    (void)folder, (void)flags;
    if (!begin_call(d)) return -1;
    change_folder(d, name_number(path), -1, 0);
    return 0;
}

/* What is there of a file: once the power was cut, of what was not flushed as many eighths as
 * torn % 9 says, and after them nothing, or zeros to its end (torn from 9 on). */
static ssize_t disk_read(void *user, int fd, void *out, size_t size) {
    struct disk *d = user;
    const struct inode *inode = &d->inodes[fd - FIRST_FD - 1];
    const size_t left = inode->safe + (inode->size - inode->safe) * (size_t)(d->torn % 9) / 8;
    const size_t whole = d->torn < 9 ? left : inode->size;
    const size_t got = whole - d->at < size ? whole - d->at : size;
    char text[GN_STATE_TEXT_MAX] = {0};
    memcpy(text, inode->data, left);
    memcpy(out, text + d->at, got);
    d->at += got;
    return (ssize_t)got;
}

static struct gn_disk calls_of(struct disk *d) {
    return (struct gn_disk){.user = d,
                            .open = disk_open,
                            .read = disk_read,
                            .write = disk_write,
                            .fsync = disk_fsync,
                            .close = disk_close,
                            .rename = disk_rename,
                            .unlink = disk_unlink};
}

/* The disk after the cut, with that many of the folder's changes. */
static void lose(struct disk *d, int changes) {
    for (int i = 0; i < changes; i++) {
        if (d->pending[i].from >= 0) d->safe[d->pending[i].from] = 0;
        d->safe[d->pending[i].name] = d->pending[i].inode;
    }
    memcpy(d->now, d->safe, sizeof d->now);
}

/* ---- states --------------------------------------------------------------------------------- */

static struct gn_state state_number(uint64_t n) {
    struct gn_state s = {.sequence = n, .given = n % 2, .runs = n % 3, .boot = "0-1-2"};
    snprintf(s.mode, sizeof s.mode, "Mode %llu", (unsigned long long)n);
    snprintf(s.scene, sizeof s.scene, "/srv/%llu a.glb", (unsigned long long)n % 5);
    snprintf(s.past, sizeof s.past, "/srv/%llu.glb", (unsigned long long)(n % 7));
    s.counts = (struct gn_state_counts){n, n + 1, n + 2, n * 1000, n * 7, n << 40};
    return s;
}

/* Saves states from 1 on, as a kiosk does, until `last`; returns the last that is on the disk. */
static uint64_t save_until(struct disk *d, uint64_t last) {
    const struct gn_disk calls = calls_of(d);
    int older = 0;
    uint64_t saved = 0;
    for (uint64_t n = 1; n <= last && !d->dead; n++) {
        const struct gn_state s = state_number(n);
        if (!gn_state_save(&calls, names[0], older, &s, &err)) continue;
        saved = n;
        older = 1 - older;
    }
    return saved;
}

static struct disk disk, after;

static void a_text_is_read_as_it_was_written(void **state) {
    (void)state;
    char text[GN_STATE_TEXT_MAX];
    const struct gn_state s = state_number(23);
    struct gn_state again;
    const size_t size = gn_state_print(&s, text);
    assert_true(gn_state_parse(text, size, &again, &err));
    assert_memory_equal(&again, &s, sizeof s);
    for (size_t cut = 0; cut < size; cut++) assert_false(gn_state_parse(text, cut, &again, &err));
    for (size_t i = 0; i < size; i++)
        for (int bit = 0; bit < 8; bit++) {
            text[i] ^= (char)(1 << bit);
            if (gn_state_parse(text, size, &again, &err)) fail_msg("byte %zu, bit %d", i, bit);
            text[i] ^= (char)(1 << bit);
        }
}

/* By hand: CRC-32 of the lines by zlib. */
static void the_text_is_for_people_too(void **state) {
    (void)state;
    char text[GN_STATE_TEXT_MAX];
    struct gn_state s = {.sequence = 2, .mode = "Soft"};
    const size_t size = gn_state_print(&s, text);
    text[size] = 0;
    assert_string_equal(text,
                        "gnomon-state 1\nsequence 2\nmode Soft\ngiven no\nruns no\nstarts 0\n"
                        "restarts 0\ncuts 0\nframes 0\npresses 0\nseconds 0\ncrc32 0c9263d6\n");
}

static void texts_that_do_not_fit_are_left_out(void **state) {
    (void)state;
    char text[GN_STATE_TEXT_MAX];
    struct gn_state s = {.sequence = 1, .mode = "a\nscene /etc/passwd"}, again;
    memset(s.scene, 'x', sizeof s.scene - 1);
    memset(s.past, 'y', sizeof s.past - 1);
    const size_t size = gn_state_print(&s, text);
    assert_true(size < sizeof text);
    assert_true(gn_state_parse(text, size, &again, &err));
    assert_string_equal(again.mode, "");
    assert_string_equal(again.scene, s.scene);
    assert_string_equal(again.past, s.past);
}

static void a_cut_at_any_call_leaves_the_old_or_the_new(void **state) {
    (void)state;
    enum { SAVES = 30 };
    int points = 0, reads = 0;
    disk = (struct disk){.cut_at = -1, .fail_at = -1};
    assert_int_equal(save_until(&disk, SAVES), SAVES);
    const int calls = disk.calls;
    for (int cut = 0; cut <= calls; cut++, points++) {
        disk = (struct disk){.cut_at = cut, .fail_at = -1};
        const uint64_t saved = save_until(&disk, SAVES);
        for (int changes = 0; changes <= disk.pending_count; changes++)
            for (int torn = 0; torn < 18; torn++, reads++) {
                struct gn_state found, expected;
                int older;
                after = disk;
                after.torn = torn;
                lose(&after, changes);
                const struct gn_disk calls = calls_of(&after);
                const enum gn_state_found what =
                    gn_state_read(&calls, names[0], &found, &older, &err);
                if (saved == 0 && what == GN_STATE_NONE) continue; /* the old one: nothing */
                if (what != GN_STATE_READ)
                    fail_msg("cut before call %d, %d changes, torn %d: %s", cut, changes, torn,
                             err.text);
                assert_in_range(found.sequence, saved > 0 ? saved : 1, saved + 1);
                expected = state_number(found.sequence);
                assert_memory_equal(&found, &expected, sizeof found);

                /* and the next start saves, without the loss of what was found */
                const struct gn_state next = state_number(found.sequence + 1);
                const int kept = after.now[1 - older];
                after.cut_at = -1, after.dead = false;
                assert_true(gn_state_save(&calls, names[0], older, &next, &err));
                assert_int_equal(after.now[1 - older], kept);
            }
    }
    printf("power cut at %d points, %d disks read\n", points, reads);
    assert_true(points >= 200);
}

static void a_call_that_fails_loses_nothing(void **state) {
    (void)state;
    static const int reasons[] = {ENOSPC, EIO, EROFS};
    disk = (struct disk){.cut_at = -1, .fail_at = -1};
    save_until(&disk, 4);
    const int calls = disk.calls;
    for (int fail = 0; fail < calls; fail++)
        for (int i = 0; i < 3; i++) {
            struct gn_state found;
            int older;
            disk = (struct disk){.cut_at = -1, .fail_at = fail, .reason = reasons[i]};
            save_until(&disk, 3);
            const struct gn_disk calls = calls_of(&disk);
            assert_int_equal(gn_state_read(&calls, names[0], &found, &older, &err), GN_STATE_READ);
            assert_in_range(found.sequence, 2, 3);
            save_until(&disk, 5); /* it goes on once there is room */
            disk.torn = 0;
            assert_int_equal(gn_state_read(&calls, names[0], &found, &older, &err), GN_STATE_READ);
            assert_int_equal(found.sequence, 5);
        }
}

/* ---- the real one --------------------------------------------------------------------------- */

static void the_disk_keeps_two_generations(void **state) {
    (void)state;
    char folder[] = "/tmp/gnomon-state-XXXXXX", path[100], other[104];
    struct gn_state found;
    struct stat info;
    int older;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/state", folder);
    snprintf(other, sizeof other, "%s.2", path);
    assert_int_equal(gn_state_read(&gn_disk, path, &found, &older, &err), GN_STATE_NONE);
    for (uint64_t n = 1; n <= 3; n++) {
        const struct gn_state s = state_number(n);
        assert_true(gn_state_save(&gn_disk, path, older, &s, &err));
        assert_int_equal(gn_state_read(&gn_disk, path, &found, &older, &err), GN_STATE_READ);
        assert_int_equal(found.sequence, n);
    }
    assert_int_equal(stat(other, &info), 0);
    assert_int_equal(truncate(path, 40), 0); /* the third */
    assert_int_equal(gn_state_read(&gn_disk, path, &found, &older, &err), GN_STATE_READ);
    assert_int_equal(found.sequence, 2);
    assert_int_equal(older, 0);
    assert_int_equal(truncate(other, 0), 0);
    assert_int_equal(gn_state_read(&gn_disk, path, &found, &older, &err), GN_STATE_BROKEN);
    assert_non_null(strstr(err.text, "/state: its checksum is wrong"));
    assert_int_equal(gn_test_remove_folder(folder), 0);
    const struct gn_state s = state_number(1);
    assert_false(gn_state_save(&gn_disk, path, 0, &s, &err));
    assert_non_null(strstr(err.text, "cannot write: No such file"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_text_is_read_as_it_was_written),
        cmocka_unit_test(the_text_is_for_people_too),
        cmocka_unit_test(texts_that_do_not_fit_are_left_out),
        cmocka_unit_test(a_cut_at_any_call_leaves_the_old_or_the_new),
        cmocka_unit_test(a_call_that_fails_loses_nothing),
        cmocka_unit_test(the_disk_keeps_two_generations),
    };
    return RUN(tests);
}
