#include "kiosk/content.h"

#include <errno.h>
#include <jansson.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/encoding.h"
#include "core/file.h"

static const int64_t SETTLE_NS = GN_NS_PER_S / 2, POLL_NS = 2 * GN_NS_PER_S;
enum { GLTF_MAX = 1 << 20 }; /* of a larger one only the file itself is waited for */

struct version { /* zeroed: there is no such file */
    dev_t device;
    ino_t inode;
    off_t size;
    int64_t changed_ns;
};
struct gn_content_file {
    char *path;
    int folder;                  /* inotify's number; -1: none */
    struct version loaded, seen; /* when it was loaded last; at the last look */
};

static struct version look_at(const char *path) {
    struct stat info;
    if (stat(path, &info) != 0) return (struct version){0};
    return (struct version){.device = info.st_dev,
                            .inode = info.st_ino,
                            .size = info.st_size,
                            .changed_ns = info.st_mtim.tv_sec * GN_NS_PER_S + info.st_mtim.tv_nsec};
}

static bool is_same(const struct version *a, const struct version *b) {
    return a->device == b->device && a->inode == b->inode && a->size == b->size &&
           a->changed_ns == b->changed_ns;
}

/* ---- waiting -------------------------------------------------------------------------------- */

static bool is_about(const struct gn_contents *c, const struct inotify_event *event) {
    if (event->len == 0) return event->mask & IN_Q_OVERFLOW;
    for (int i = 0; i < c->count; i++)
        if (c->files[i].folder == event->wd &&
            strcmp(gn_file_name(c->files[i].path), event->name) == 0)
            return true;
    return false;
}

/* Looks at all files. True: they are as at the last look; *fresh: one is not as it was loaded. */
static bool look_again(struct gn_contents *c, bool *fresh) {
    bool stable = true;
    *fresh = false;
    for (int i = 0; i < c->count; i++) {
        const struct version now = look_at(c->files[i].path);
        stable &= is_same(&now, &c->files[i].seen);
        *fresh |= !is_same(&now, &c->files[i].loaded);
        c->files[i].seen = now;
    }
    return stable;
}

static void take_events(void *user, int64_t now_ns) {
    struct gn_contents *c = user;
    char buffer[4096] __attribute__((aligned(__alignof__(struct inotify_event))));
    ssize_t got;
    bool about = false, fresh;
    while ((got = read(c->watch.fd, buffer, sizeof buffer)) > 0)
        for (const char *at = buffer; at < buffer + got;) {
            const struct inotify_event *event = (const struct inotify_event *)(const void *)at;
            about |= is_about(c, event);
            at += sizeof *event + event->len;
        }
    if (!about) return;
    look_again(c, &fresh);
    c->timer.due_ns = now_ns + SETTLE_NS;
}

static void check_files(void *user, int64_t now_ns) {
    struct gn_contents *c = user;
    bool fresh;
    const bool stable = look_again(c, &fresh);
    c->timer.due_ns = now_ns + (stable ? POLL_NS : SETTLE_NS);
    if (!stable || !fresh) return;
    for (int i = 0; i < c->count; i++) c->files[i].loaded = c->files[i].seen;
    c->changed = true;
}

/* ---- the list ------------------------------------------------------------------------------- */

static const struct gn_content_file *find_file(const struct gn_contents *c, const char *path) {
    for (int i = 0; i < c->count; i++)
        if (strcmp(c->files[i].path, path) == 0) return &c->files[i];
    return NULL;
}

static void watch_folder(struct gn_contents *c, struct gn_content_file *file) {
    char folder[PATH_MAX];
    const int length = (int)(gn_file_name(file->path) - file->path);
    if (snprintf(folder, sizeof folder, "%.*s", length, length ? file->path : "") >= PATH_MAX)
        return;
    file->folder = inotify_add_watch(c->watch.fd, length ? folder : ".",
                                     IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM |
                                         IN_CREATE | IN_DELETE | IN_ONLYDIR);
}

static void add_file(struct gn_contents *next, const struct gn_contents *before, const char *path,
                     bool missed) {
    if (next->count == GN_CONTENT_FILES_MAX || find_file(next, path)) return;
    const struct gn_content_file *known = find_file(before, path);
    struct gn_content_file *file = &next->files[next->count];
    *file = (struct gn_content_file){.path = strdup(path), .folder = -1};
    if (!file->path) return;
    file->seen = known ? known->seen : look_at(path);
    if (known)
        file->loaded = known->loaded;
    else if (!missed)
        file->loaded = file->seen;
    next->count++;
    watch_folder(next, file);
}

/* A URI's path; false for data: and what is too long. */
static bool decode_uri(const char *uri, char *out, size_t size) {
    if (!uri || strncmp(uri, "data:", 5) == 0 || strlen(uri) >= size) return false;
    out[gn_percent_decode(uri, (uint8_t *)out)] = '\0';
    return true;
}

static void add_referred(struct gn_contents *next, const struct gn_contents *before,
                         const char *path, bool missed) {
    static const char *const lists[] = {"buffers", "images"};
    const size_t length = strlen(path), folder = (size_t)(gn_file_name(path) - path);
    struct gn_bytes bytes;
    struct gn_err unused = {0};
    char name[3 * PATH_MAX] /* "%20" is one */, whole[PATH_MAX];
    if (length < 5 || strcmp(path + length - 5, ".gltf") != 0 ||
        !gn_file_read(path, GLTF_MAX, &bytes, &unused))
        return;
    json_t *root = json_loadb((const char *)bytes.data, bytes.size, 0, NULL);
    for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++) {
        const json_t *list = json_object_get(root, lists[k]);
        for (size_t i = 0; i < json_array_size(list); i++) {
            const json_t *uri = json_object_get(json_array_get(list, i), "uri");
            if (!decode_uri(json_string_value(uri), name, sizeof name) ||
                snprintf(whole, sizeof whole, "%.*s%s", (int)folder, path, name) >= PATH_MAX)
                continue;
            add_file(next, before, whole, missed);
        }
    }
    json_decref(root);
    gn_bytes_finish(&bytes);
}

static void drop_files(struct gn_contents *c) {
    for (int i = 0; i < c->count; i++) free(c->files[i].path);
    free(c->files);
    c->files = NULL;
    c->count = 0;
}

void gn_content_follow(struct gn_contents *c, const char *const *paths, int count, bool missed) {
    struct gn_contents before = *c;
    if (c->watch.fd < 0) return;
    c->files = gn_xalloc(GN_CONTENT_FILES_MAX, sizeof *c->files);
    c->count = 0;
    for (int i = 0; i < count; i++)
        if (paths[i] && paths[i][0]) add_file(c, &before, paths[i], missed);
    for (int i = 0; i < count; i++)
        if (paths[i]) add_referred(c, &before, paths[i], missed);
    drop_files(&before);
}

/* ---- opening -------------------------------------------------------------------------------- */

bool gn_content_open(struct gn_contents *c, struct gn_loop *loop) {
    const int fd = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    *c = (struct gn_contents){
        .watch = {.fd = fd, .events = EPOLLIN, .call = take_events, .user = c},
        .timer = {.due_ns = gn_loop_now_ns(loop) + POLL_NS, .call = check_files, .user = c}};
    if (fd >= 0 && gn_loop_add(loop, &c->watch)) {
        gn_loop_add_timer(loop, &c->timer);
        return true;
    }
    const int why = errno;
    gn_content_close(c);
    errno = why;
    return false;
}

void gn_content_close(struct gn_contents *c) {
    gn_loop_remove(&c->watch);
    gn_loop_remove_timer(&c->timer);
    if (c->watch.fd >= 0) close(c->watch.fd);
    drop_files(c);
    *c = (struct gn_contents){.watch.fd = -1};
}
