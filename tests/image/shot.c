#include "image/shot.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"

extern char **environ;

static const char *env_or(const char *name, const char *other) {
    const char *value = getenv(name);
    return value && *value ? value : other;
}
const char *gn_shot_program(void) { return env_or("GNOMON", "build/release/gnomon"); }
const char *gn_shot_build(void) { return env_or("BUILD", "build/release"); }
bool gn_shot_full(void) { return strcmp(env_or("GN_FULL", "0"), "0") != 0; }

/* One of the two texts that a child writes. */
struct stream {
    int fd;
    char *text;
    size_t used, room;
};

static void take(struct stream *s) {
    char rest[4096];
    bool full = s->used + 1 >= s->room; /* what does not fit is read and dropped */
    ssize_t n = full ? read(s->fd, rest, sizeof rest)
                     : read(s->fd, s->text + s->used, s->room - 1 - s->used);
    if (n > 0 && !full) s->used += (size_t)n;
    if (n > 0 || (n < 0 && errno == EINTR)) return;
    close(s->fd);
    s->fd = -1;
}

/* Reads both until both end; false when time is up. */
static bool take_all(struct stream s[2], int64_t deadline_ns) {
    while (s[0].fd >= 0 || s[1].fd >= 0) {
        int64_t left_ms = (deadline_ns - gn_clock_monotonic_ns()) / 1000000;
        struct pollfd fds[2] = {{s[0].fd, POLLIN, 0}, {s[1].fd, POLLIN, 0}};
        if (left_ms <= 0) return false;
        if (poll(fds, 2, (int)left_ms) < 0 && errno != EINTR) return false;
        for (int i = 0; i < 2; i++)
            if (s[i].fd >= 0 && fds[i].revents) take(&s[i]);
    }
    return true;
}

static bool spawn(pid_t *pid, const char *const argv[], const int out[2], const int error[2]) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], 1);
    posix_spawn_file_actions_adddup2(&actions, error[1], 2);
    int failed = posix_spawn(pid, argv[0], &actions, NULL, (char *const *)argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    return !failed;
}

static int wait_for(pid_t pid, bool late) {
    int status;
    if (late) kill(pid, SIGKILL);
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
    if (late) return 124;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool gn_run(struct gn_run *run, const char *const argv[], int timeout_s, struct gn_err *err) {
    int out[2], error[2];
    pid_t pid;
    memset(run, 0, sizeof *run);
    if (pipe2(out, O_CLOEXEC)) return gn_fail(err, "no pipe: %s", strerror(errno));
    if (pipe2(error, O_CLOEXEC)) {
        close(out[0]);
        close(out[1]);
        return gn_fail(err, "no pipe: %s", strerror(errno));
    }
    int64_t start_ns = gn_clock_monotonic_ns();
    bool started = spawn(&pid, argv, out, error);
    close(out[1]);
    close(error[1]);
    struct stream streams[2] = {{out[0], run->out, 0, sizeof run->out},
                                {error[0], run->err, 0, sizeof run->err}};
    if (started) {
        int64_t limit_ns = (timeout_s ? timeout_s : 60) * GN_NS_PER_S;
        bool late = !take_all(streams, start_ns + limit_ns);
        run->status = wait_for(pid, late);
    }
    for (int i = 0; i < 2; i++)
        if (streams[i].fd >= 0) close(streams[i].fd);
    run->seconds = (double)(gn_clock_monotonic_ns() - start_ns) / (double)GN_NS_PER_S;
    return started || gn_fail(err, "%s cannot be started; build it first, or set GNOMON", argv[0]);
}

static void join(const char *const argv[], char *text, size_t size) {
    size_t used = 0;
    text[0] = 0;
    for (int i = 0; argv[i] && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, i ? " %s" : "%s", argv[i]);
}

static bool has_arg(const char *const argv[], const char *arg) {
    while (*argv && strcmp(*argv, arg) != 0) argv++;
    return *argv;
}

bool gn_shot_file(const char *path, int *status, struct gn_err *err, const char *scene,
                  const char *const args[]) {
    const char *argv[64] = {gn_shot_program(), "render", scene, "-o", path};
    int n = 5;
    static const char *const plain[][2] = {
        {"--tone", "none"}, {"--msaa", "0"}, {"--floor", "none"}, {"--environment", "none"}};
    while (*args && n < 58) argv[n++] = *args++;
    /* what is compared is what surfaces reflect, unless a test is about how it is shown */
    for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++) {
        if (has_arg(argv, plain[i][0])) continue;
        argv[n++] = plain[i][0];
        argv[n++] = plain[i][1];
    }
    struct gn_run *run = malloc(sizeof *run);
    if (!run) abort();
    bool ok = gn_run(run, argv, 0, err);
    if (status) *status = ok ? run->status : -1;
    if (ok && run->status) {
        char command[256];
        join(argv, command, sizeof command);
        run->err[strcspn(run->err, "\n")] = 0;
        ok = gn_fail(err, "%s: status %d: %s", command, run->status, run->err);
    }
    free(run);
    return ok;
}

bool gn_shot(struct gn_picture *picture, int *status, struct gn_err *err, const char *kind,
             const char *scene, const char *const args[]) {
    static atomic_int number;
    char folder[300], path[400];
    *picture = (struct gn_picture){0};
    mkdir(gn_shot_build(), 0777);
    snprintf(folder, sizeof folder, "%s/shots", gn_shot_build());
    mkdir(folder, 0777);
    snprintf(path, sizeof path, "%s/%d-%d.%s", folder, (int)getpid(), atomic_fetch_add(&number, 1),
             kind);
    bool ok = gn_shot_file(path, status, err, scene, args) && gn_picture_read(picture, path, err);
    unlink(path);
    return ok;
}
