/* [render] shaders: waits for files of that folder to change, and makes the programs again. */
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "core/clock.h"
#include "gl/gl.h"
#include "kiosk/part.h"

static const int64_t MOMENT_NS = GN_NS_PER_S / 10;

struct shaders {
    const struct gn_part_host *host;
    struct gn_watch watch; /* inotify; fd -1: there is no folder */
    struct gn_timer timer; /* a moment after the last change: an editor writes several files */
    bool changed;          /* set then */
};

static void take_event(void *user, int64_t now_ns) {
    struct shaders *s = user;
    char buffer[4096] __attribute__((aligned(__alignof__(struct inotify_event))));
    while (read(s->watch.fd, buffer, sizeof buffer) > 0) s->timer.due_ns = now_ns + MOMENT_NS;
}

static void take_change(void *user, int64_t now_ns) {
    struct shaders *s = user;
    (void)now_ns;
    s->changed = true;
}

static bool watch_folder(int fd, const char *path) {
    return inotify_add_watch(fd, path, IN_CLOSE_WRITE | IN_MOVED_TO | IN_ONLYDIR) >= 0;
}

/* The folder and those in it, where shader files are. */
static bool watch_folders(int fd, const char *folder) {
    char path[4096];
    if (!watch_folder(fd, folder)) return false;
    DIR *list = opendir(folder);
    if (!list) return false;
    for (struct dirent *entry; (entry = readdir(list));) {
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] != '.' && !watch_folder(fd, path) && errno != ENOTDIR) break;
    }
    closedir(list);
    return true;
}

static void close_shaders(void *part) {
    struct shaders *s = part;
    gn_loop_remove(&s->watch);
    gn_loop_remove_timer(&s->timer);
    if (s->watch.fd >= 0) close(s->watch.fd);
    *s = (struct shaders){.host = s->host, .watch.fd = -1};
}

static void open_shaders(void *part) {
    struct shaders *s = part;
    const struct gn_part_host *h = s->host;
    const char *folder = (*h->settings)->render.shaders;
    struct gn_err err = {0};
    *s = (struct shaders){.host = h, .watch.fd = -1};
    gn_problem_cure(h->problems, GN_PROBLEM_SHADERS);
    if (!folder) return;
    const int fd = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    s->watch = (struct gn_watch){.fd = fd, .events = EPOLLIN, .call = take_event, .user = s};
    s->timer = (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = take_change, .user = s};
    if (fd >= 0 && watch_folders(fd, folder) && gn_loop_add(h->loop, &s->watch)) {
        gn_loop_add_timer(h->loop, &s->timer);
        return;
    }
    gn_fail(&err, "%s: changes are not noticed: %s", folder, strerror(errno));
    gn_problem_report(h->problems, GN_PROBLEM_SHADERS, err.text);
    close_shaders(s);
}

static void reopen_shaders(void *part) {
    close_shaders(part);
    open_shaders(part);
}

/* Makes the programs again. One that fails stays as it is. */
static void renew_shaders(void *part) {
    struct shaders *s = part;
    const struct gn_part_host *h = s->host;
    struct gn_err err = {0};
    if (!s->changed || !*h->gl) return;
    s->changed = false;
    *h->changed = true;
    if (gn_gl_renew_programs(*h->gl, &err))
        gn_problem_cure(h->problems, GN_PROBLEM_SHADERS); /* the same problem again is news */
    else
        gn_problem_report(h->problems, GN_PROBLEM_SHADERS, err.text);
}

const struct gn_part gn_part_shaders = {
    .name = "shaders",
    .size = sizeof(struct shaders),
    .open = open_shaders,
    .reopen = reopen_shaders,
    .step = renew_shaders,
    .close = close_shaders,
};
