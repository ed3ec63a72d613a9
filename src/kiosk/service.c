#include "kiosk/service.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/part.h"
#include "options/value.h"

/* Best effort: a lost datagram is not an error. */
static void notify(const struct gn_service *s, const char *text) {
    if (s->socket < 0) return;
    const ssize_t sent = sendto(s->socket, text, strlen(text), MSG_NOSIGNAL | MSG_DONTWAIT,
                                (const struct sockaddr *)&s->to, s->to_length);
    (void)sent;
}

/* 0: no watchdog, or one for another process. */
static int64_t watchdog_ns(void) {
    const char *us = getenv("WATCHDOG_USEC"), *pid = getenv("WATCHDOG_PID");
    int64_t value, whose;
    if (!us || !gn_parse_int(us, &value) || value <= 0 || value > INT64_MAX / 1000) return 0;
    if (pid && (!gn_parse_int(pid, &whose) || whose != getpid())) return 0;
    return value * 1000;
}

/* Wakes the loop again until a flip completes. */
static void rearm_watchdog(void *user, int64_t now_ns) {
    struct gn_service *s = user;
    s->timer.due_ns = now_ns + s->every_ns;
}

/* $JOURNAL_STREAM is inherited by programs whose stderr is something else. */
static bool is_journal(void) {
    const char *stream = getenv("JOURNAL_STREAM");
    struct stat info;
    char own[64];
    if (!stream || fstat(STDERR_FILENO, &info) != 0) return false;
    snprintf(own, sizeof own, "%llu:%llu", (unsigned long long)info.st_dev,
             (unsigned long long)info.st_ino);
    return strcmp(own, stream) == 0;
}

/* One line when it begins to wait, or waits for something else, and one when a picture follows. */
static void log_screen(struct gn_service *s, const struct gn_screen *screen) {
    const uint64_t shown = screen->counts.shown;
    if (!s->logs) return;
    if (shown < s->waited) s->waited = 0; /* the display was opened again */
    if (screen->status[0]) {
        s->waited = shown;
        if (!s->shows && strcmp(s->waits, screen->status) == 0) return;
        snprintf(s->waits, sizeof s->waits, "%s", screen->status);
        s->shows = false;
        fprintf(stderr, "gnomon: %s\n", screen->status);
    } else if (!s->shows && shown > s->waited) {
        s->shows = true;
        fprintf(stderr, "gnomon: picture on %s\n", screen->what[0] ? screen->what : "the screen");
    }
}

bool gn_service_open(struct gn_service *s, struct gn_loop *loop, int64_t now_ns,
                     struct gn_err *err) {
    const char *path = getenv("NOTIFY_SOCKET");
    const bool supervised = (path && *path) || is_journal();
    const bool terminal = !supervised && isatty(STDERR_FILENO);
    *s = (struct gn_service){.socket = -1, .logs = supervised || terminal, .shows = terminal};
    if (!path || !*path) return true;

    /* a path, or an abstract name that begins with "@" */
    const size_t length = strlen(path);
    if ((path[0] != '/' && path[0] != '@') || length >= sizeof s->to.sun_path)
        return gn_fail(err, "NOTIFY_SOCKET=%.80s: expected a path or @NAME", path);
    s->to.sun_family = AF_UNIX;
    memcpy(s->to.sun_path, path, length);
    if (path[0] == '@') s->to.sun_path[0] = 0;
    s->to_length = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length);

    s->socket = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (s->socket < 0) return gn_fail(err, "cannot notify the supervisor: %s", strerror(errno));
    s->every_ns = watchdog_ns() / 4;
    s->next_ns = now_ns + s->every_ns;
    s->timer = (struct gn_timer){.due_ns = s->next_ns, .call = rearm_watchdog, .user = s};
    if (s->every_ns > 0) gn_loop_add_timer(loop, &s->timer);
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    return true;
}

bool gn_service_step(struct gn_service *s, const struct gn_screen *screen, int64_t now_ns) {
    const uint64_t shown = screen->counts.shown;
    const bool sleeps = screen->blank || screen->status[0];
    log_screen(s, screen);
    if (s->socket < 0) return false;
    if (shown < s->shown) s->shown = 0; /* the display was opened again */
    const char *status = screen->status[0] ? screen->status : screen->what;
    if (*status && strcmp(status, s->status) != 0) {
        char line[sizeof s->status + sizeof "STATUS="];
        snprintf(s->status, sizeof s->status, "%s", status);
        snprintf(line, sizeof line, "STATUS=%s", status);
        notify(s, line);
    }
    if (!s->ready) notify(s, "READY=1");
    s->ready = true;
    if (s->every_ns == 0 || now_ns < s->next_ns) return false;
    if (shown == s->shown && !sleeps) return true;
    notify(s, "WATCHDOG=1");
    s->shown = shown;
    s->next_ns = s->timer.due_ns = now_ns + s->every_ns;
    return false;
}

void gn_service_pause(struct gn_service *s, uint64_t pieces, int64_t now_ns) {
    if (s->socket < 0 || s->every_ns == 0 || now_ns < s->next_ns || pieces == s->pieces) return;
    notify(s, "WATCHDOG=1");
    s->pieces = pieces;
    s->next_ns = s->timer.due_ns = now_ns + s->every_ns;
}

void gn_service_close(struct gn_service *s) {
    if (s->socket < 0) return;
    notify(s, "STOPPING=1");
    close(s->socket);
    gn_loop_remove_timer(&s->timer);
    s->socket = -1;
}

/* ---- the part -------------------------------------------------------------------------------- */

struct service {
    const struct gn_part_host *host;
    struct gn_service of;
};

/* A failure is no reason to show no picture. */
static void begin_service(void *part) {
    struct service *s = part;
    struct gn_err err = {0};
    if (!gn_service_open(&s->of, s->host->loop, gn_loop_now_ns(s->host->loop), &err))
        gn_problem_report(s->host->problems, GN_PROBLEM_START, err.text);
}

/* A still picture is to be flipped within a quarter of the watchdog's timeout. */
static void flip_in_time(const void *part, struct gn_screen_opts *opts) {
    const int64_t again_ns = ((const struct service *)part)->of.every_ns * 3 / 4;
    opts->again_ns = again_ns < 10 * GN_NS_PER_S ? again_ns : 0;
}

static void step_service(void *part) {
    struct service *s = part;
    const struct gn_part_host *h = s->host;
    *h->changed |= gn_service_step(&s->of, &h->display->screen, gn_loop_now_ns(h->loop));
}

static bool pause_service(void *part, uint64_t pieces, int64_t run_ns, struct gn_err *err) {
    struct service *s = part;
    (void)run_ns, (void)err;
    gn_service_pause(&s->of, pieces, gn_loop_now_ns(s->host->loop));
    return true;
}

static void close_service(void *part) { gn_service_close(&((struct service *)part)->of); }

const struct gn_part gn_part_service = {
    .name = "service",
    .size = sizeof(struct service),
    .begin = begin_service,
    .add_screen = flip_in_time,
    .step = step_service,
    .pause = pause_service,
    .close = close_service,
};
