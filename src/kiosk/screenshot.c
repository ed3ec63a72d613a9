#include "kiosk/screenshot.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include "caption/message.h"
#include "core/arena.h"
#include "core/file.h"
#include "core/thread.h"
#include "core/turn.h"
#include "image/write.h"

struct gn_screenshot {
    struct gn_watch done;     /* an eventfd */
    bool asked, runs, failed; /* at most one is true */
    pthread_t thread;
    char path[PATH_MAX];
    int fd; /* -1: the path */
    uint32_t width_px, height_px;
    unsigned turn_deg;
    uint8_t *rgba;
    bool ok; /* the result, until it is taken */
    struct gn_err err;
};

static bool check_name(const char *path, struct gn_err *err) {
    const size_t length = strlen(path);
    if (path[0] != '/')
        return gn_fail_usage(err, "screenshot: \"%.200s\" is not an absolute path", path);
    if (length <= 4 || strcmp(path + length - 4, ".png") != 0 || path[length - 5] == '/')
        return gn_fail_usage(err, "screenshot: \"%.200s\" does not end in .png", path);
    return length < PATH_MAX || gn_fail_usage(err, "screenshot: the path is too long");
}

bool gn_screenshot_check(const char *path, struct gn_err *err) {
    struct stat info;
    if (!check_name(path, err)) return false;
    if (lstat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return gn_fail(err, "screenshot: %.200s is no regular file; not replacing it", path);
    return true;
}

/* The real path of the folder and the path's last part, if the rest of the path is the folder as
 * the configuration names it, or its real path. The path itself is not looked up: that would tell a
 * client what is there, and could wait for a file system that does not answer. */
static bool resolve_in(const char *folder, const char *path, char *target) {
    char real[PATH_MAX];
    const char *const spellings[] = {folder, real}, *slash = strrchr(path, '/');
    if (!realpath(folder, real)) return false;
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(spellings[i]);
        while (length > 0 && spellings[i][length - 1] == '/') length--;
        if (length == (size_t)(slash - path) && strncmp(path, spellings[i], length) == 0)
            return snprintf(target, PATH_MAX, "%s%s", real[1] ? real : "", slash) < PATH_MAX;
    }
    return false;
}

bool gn_screenshot_permits(const char *path, int fd, const char *folder, char *target,
                           struct gn_err *err) {
    target[0] = 0;
    if (fd < 0 && !check_name(path, err)) return false;
    if (fd < 0 && folder && resolve_in(folder, path, target)) return true;
    if (fd < 0 && folder)
        return gn_fail(err,
                       "screenshot: %.200s is not in %.200s; pass a memory file, or a path there",
                       path, folder);
    if (fd < 0)
        return gn_fail(
            err, "screenshot: no memory file was passed: use gnomon ctl, or name a folder for them "
                 "as screenshots in [kiosk]");
    /* seals are a property of memory files alone; others may be pipes, or files of a remote or
     * user's file system, on which a write can wait for ever */
    const int flags = fcntl(fd, F_GETFL);
    if (fcntl(fd, F_GET_SEALS) < 0 || (flags & O_ACCMODE) == O_RDONLY || flags & O_PATH)
        return gn_fail(err,
                       "screenshot: the descriptor that was passed is no writable memory file");
    return true;
}

struct gn_screenshot *gn_screenshot_create(struct gn_loop *loop,
                                           void (*call)(void *user, int64_t now_ns), void *user,
                                           struct gn_err *err) {
    struct gn_screenshot *shot = gn_xalloc(1, sizeof *shot);
    const int fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    shot->done = (struct gn_watch){.fd = fd, .events = EPOLLIN, .call = call, .user = user};
    if (fd >= 0 && gn_loop_add(loop, &shot->done)) return shot;
    gn_fail(err, "screenshots: cannot wait: %s", strerror(errno));
    gn_screenshot_destroy(shot);
    return NULL;
}

void gn_screenshot_destroy(struct gn_screenshot *shot) {
    if (!shot) return;
    if (shot->runs) pthread_join(shot->thread, NULL);
    free(shot->rgba);
    gn_loop_remove(&shot->done);
    if (shot->done.fd >= 0) close(shot->done.fd);
    free(shot);
}

void gn_screenshot_ask(struct gn_screenshot *shot, const char *path, int fd) {
    shot->fd = fd;
    snprintf(shot->path, sizeof shot->path, "%s", path);
    shot->asked = true;
}

bool gn_screenshot_is_asked(const struct gn_screenshot *shot) { return shot->asked; }

bool gn_screenshot_is_busy(const struct gn_screenshot *shot) {
    return shot->asked || shot->runs || shot->failed;
}

uint8_t *gn_screenshot_begin(struct gn_screenshot *shot, uint32_t width_px, uint32_t height_px,
                             unsigned turn_deg, struct gn_err *err) {
    free(shot->rgba);
    shot->rgba = gn_picture_alloc((size_t)width_px * height_px, 4, err);
    shot->width_px = width_px;
    shot->height_px = height_px;
    shot->turn_deg = turn_deg;
    return shot->rgba;
}

/* ---- in the thread -------------------------------------------------------------------------- */

/* The index of pixel (u, v) of the upright picture in the turned one. */
static size_t pixel_index(const struct gn_screenshot *s, uint32_t u, uint32_t v) {
    const struct gn_turned turn = {s->turn_deg, s->width_px, s->height_px};
    uint32_t to[2];
    gn_turned_place(&turn, u, v, to);
    return (size_t)to[1] * s->width_px + to[0];
}

static void signal_done(const struct gn_screenshot *shot) {
    const uint64_t one = 1;
    if (write(shot->done.fd, &one, sizeof one) < 0) abort(); /* cannot overflow */
}

static bool write_memory(int fd, const struct gn_bytes *png, struct gn_err *err) {
    for (size_t at = 0; at < png->size;) {
        const ssize_t put = pwrite(fd, png->data + at, png->size - at, (off_t)at);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0)
            return gn_fail(err, "screenshot: cannot write to the client's memory file: %s",
                           strerror(errno));
        at += (size_t)put;
    }
    return true;
}

static void *write_in_thread(void *user) {
    struct gn_screenshot *s = user;
    const struct gn_turned_size size = gn_turned_upright(s->turn_deg, s->width_px, s->height_px);
    const uint32_t width = size.width_px, height = size.height_px;
    struct gn_bytes png = {0};
    gn_thread_lower_priority();
    uint8_t *rgb = gn_picture_alloc((size_t)width * height, 3, &s->err);
    for (uint32_t v = 0; rgb && v < height; v++)
        for (uint32_t u = 0; u < width; u++)
            memcpy(rgb + 3 * ((size_t)v * width + u), s->rgba + 4 * pixel_index(s, u, v), 3);
    s->ok = rgb && gn_picture_encode_png8(rgb, (int)width, (int)height, &png, &s->err) &&
            (s->fd >= 0 ? write_memory(s->fd, &png, &s->err)
                        : gn_file_replace(s->path, png.data, png.size, &s->err));
    gn_bytes_finish(&png);
    free(rgb);
    signal_done(s);
    return NULL;
}

/* ---- here ----------------------------------------------------------------------------------- */

bool gn_screenshot_start(struct gn_screenshot *shot, struct gn_err *err) {
    shot->err = (struct gn_err){0};
    const int reason = pthread_create(&shot->thread, NULL, write_in_thread, shot);
    shot->runs = reason == 0;
    shot->asked = shot->asked && !shot->runs;
    return shot->runs || gn_fail(err, "screenshot: no thread: %s", strerror(reason));
}

bool gn_screenshot_say(struct gn_screenshot *shot, uint32_t width_px, uint32_t height_px,
                       const char *font, const char *text, struct gn_err *err) {
    uint8_t *rgba = gn_screenshot_begin(shot, width_px, height_px, 0, err);
    const struct gn_message_picture picture = {.pixels = rgba,
                                               .stride = 4ul * width_px,
                                               .width_px = width_px,
                                               .height_px = height_px,
                                               .red_first = true,
                                               .font = font};
    if (!rgba) return false;
    if (!gn_message_draw(&picture, text))
        return gn_fail(err, "screenshot: the screen is too small for a text");
    return gn_screenshot_start(shot, err);
}

void gn_screenshot_fail(struct gn_screenshot *shot, const struct gn_err *err) {
    shot->asked = false;
    shot->failed = true;
    shot->ok = false;
    shot->err = *err;
    signal_done(shot);
}

bool gn_screenshot_take(struct gn_screenshot *shot, bool *ok, struct gn_err *err) {
    uint64_t count;
    if ((!shot->runs && !shot->failed) || read(shot->done.fd, &count, sizeof count) != sizeof count)
        return false;
    if (shot->runs) pthread_join(shot->thread, NULL);
    shot->runs = shot->failed = false;
    free(shot->rgba);
    shot->rgba = NULL;
    *ok = shot->ok;
    if (!*ok) *err = shot->err;
    return true;
}
