/* A running kiosk under load: clients that ask it a thousand things a second, half of them
 * nonsense, while it draws 60 frames a second. Every line has its reply, in order; nobody comes in
 * who may not; and no frame is missed for it. The full form (GN_FULL=1) is 50 clients for 10 s, the
 * quick one 10 for 2 s. A busy machine misses frames by itself: the kiosk is watched for as long
 * without load first, and the best of three tries counts. */
#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/shot.h"
#include "unit/control_help.h"
#include "unit/folder.h"

enum { CLIENTS_MAX = 50, PER_CLIENT = 20 /* a second */, ASKED_MAX = 4096 };

static char folder[] = "/tmp/gnomon-load-XXXXXX", path[80];
static pid_t kiosk;

/* ---- the kiosk ------------------------------------------------------------------------------ */

static int start_kiosk(void **state) {
    (void)state;
    signal(SIGPIPE, SIG_IGN);
    if (!mkdtemp(folder)) return -1;
    snprintf(path, sizeof path, "%s/ctl", folder);
    kiosk = fork();
    if (kiosk == 0) {
        setenv("XDG_CONFIG_HOME", folder, 1);
        execl(gn_shot_program(), "gnomon", "show", "--backend", "egl", "--size", "160x90",
              "--frames", "1000000", "--turntable", "30", "--shadow", "hard", "--map", "64",
              "--socket", path, "build/selftest/box.glb", (char *)NULL);
        _exit(127);
    }
    return kiosk > 0 ? 0 : -1;
}

static int stop_kiosk(void **state) {
    (void)state;
    kill(kiosk, SIGKILL);
    waitpid(kiosk, NULL, 0);
    return gn_test_remove_folder(folder);
}

static int enter_kiosk(void) {
    int fd = -1;
    for (int i = 0; i < 600 && fd < 0; i++) {
        fd = connect_to(path);
        if (fd < 0) usleep(100000);
    }
    if (fd < 0) fail_msg("no kiosk answers at %s", path);
    return fd;
}

static json_t *ask_status(int fd) {
    static char text[65536];
    size_t used = 0;
    say(fd, "{\"cmd\":\"status\"}\n");
    while (used == 0 || text[used - 1] != '\n') {
        struct pollfd p = {.fd = fd, .events = POLLIN};
        assert_int_equal(poll(&p, 1, 20000), 1);
        const ssize_t got = recv(fd, text + used, sizeof text - used, 0);
        assert_true(got > 0);
        used += (size_t)got;
    }
    json_t *status = json_loadb(text, used, 0, NULL);
    assert_true(json_is_true(json_object_get(status, "ok")));
    return status;
}

static long number_at(json_t *status, const char *object, const char *key) {
    return (long)json_integer_value(json_object_get(json_object_get(status, object), key));
}

struct watch { /* of the kiosk, from one status to the next */
    long drawn, missed;
    double rss_mb;
};

static struct watch look(int fd) {
    json_t *status = ask_status(fd);
    const struct watch w = {number_at(status, "frames", "drawn"),
                            number_at(status, "frames", "missed"),
                            json_real_value(json_object_get(status, "memory_mb"))};
    json_decref(status);
    return w;
}

/* ---- the clients ---------------------------------------------------------------------------- */

static const struct {
    const char *line;
    bool good, may_be_busy;
} lines[] = {
    {"{\"cmd\":\"status\"}\n", true, false},
    {"{\"cmd\":\"status\"\n", false, false},
    {"{\"cmd\":\"get\",\"key\":\"shadow\"}\n", true, false},
    {"\x01\x02\xff{}[]\n", false, false},
    {"{\"cmd\":\"status\"}\n", true, false},
    {"{\"cmd\":\"frobnicate\"}\n", false, false},
    {"{\"cmd\":\"set\",\"key\":\"turntable\",\"value\":30}\n", true, true},
    {"{\"cmd\":\"mode\"}\n", false, false},
    {"{\"cmd\":\"get\",\"key\":\"exposure\"}\n", true, false},
    {"[[[[[[[[[[[[[[\n", false, false},
};
enum { LINES = sizeof lines / sizeof lines[0] };

struct client {
    int fd, sent, heard, first; /* first: which line it begins with */
    int64_t next_ns, sent_ns[ASKED_MAX];
    char in[16384];
    size_t used;
};
struct load {
    struct client *clients;
    int count;
    long sent, heard, wrong_order, busy;
    long late_us[CLIENTS_MAX * PER_CLIENT * 12];
};

static void take_reply(struct load *l, struct client *c, const char *line, size_t length) {
    const int which = (c->first + c->heard) % LINES;
    json_t *reply = json_loadb(line, length, 0, NULL);
    const bool ok = json_is_true(json_object_get(reply, "ok"));
    const char *error = json_string_value(json_object_get(reply, "error"));
    const bool busy = error && strcmp(error, "busy") == 0;
    l->busy += busy;
    if (!json_is_object(reply) || (ok != lines[which].good && !(busy && lines[which].may_be_busy)))
        l->wrong_order++;
    json_decref(reply);
    l->late_us[l->heard++] = (long)((gn_clock_monotonic_ns() - c->sent_ns[c->heard++]) / 1000);
}

static void hear(struct load *l, struct client *c) {
    const ssize_t got = recv(c->fd, c->in + c->used, sizeof c->in - c->used, MSG_DONTWAIT);
    if (got <= 0) return;
    c->used += (size_t)got;
    char *line = c->in, *newline;
    while ((newline = memchr(line, '\n', c->used - (size_t)(line - c->in))) != NULL) {
        take_reply(l, c, line, (size_t)(newline - line));
        line = newline + 1;
    }
    c->used -= (size_t)(line - c->in);
    memmove(c->in, line, c->used);
}

static void ask(struct load *l, struct client *c, int64_t now_ns) {
    const char *line = lines[(c->first + c->sent) % LINES].line;
    c->sent_ns[c->sent++] = now_ns;
    c->next_ns += GN_NS_PER_S / PER_CLIENT;
    l->sent++;
    assert_int_equal(send(c->fd, line, strlen(line), MSG_NOSIGNAL), strlen(line));
}

/* Until `seconds` are over and all that was asked is answered, but at most two minutes more. */
static void run_load(struct load *l, int seconds) {
    const int64_t begun_ns = gn_clock_monotonic_ns(), end_ns = begun_ns + seconds * GN_NS_PER_S;
    struct pollfd fds[CLIENTS_MAX];
    for (int i = 0; i < l->count; i++) { /* evenly, one after the other */
        l->clients[i].fd = enter_kiosk();
        l->clients[i].first = i % LINES;
        l->clients[i].next_ns = begun_ns + i * (GN_NS_PER_S / PER_CLIENT) / l->count;
        fds[i] = (struct pollfd){.fd = l->clients[i].fd, .events = POLLIN};
    }
    for (int64_t now_ns = begun_ns; now_ns < end_ns || l->heard < l->sent;
         now_ns = gn_clock_monotonic_ns()) {
        if (now_ns > end_ns + 120 * GN_NS_PER_S) break;
        poll(fds, (nfds_t)l->count, 1);
        for (int i = 0; i < l->count; i++) {
            struct client *c = &l->clients[i];
            if (fds[i].revents) hear(l, c);
            if (now_ns < end_ns && now_ns >= c->next_ns) ask(l, c, now_ns);
        }
    }
    for (int i = 0; i < l->count; i++) close(l->clients[i].fd);
}

/* ---- those who may not ---------------------------------------------------------------------- */

/* As another user: tries to come in all the time. How often it did goes to the pipe. */
static pid_t start_stranger(int *out) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    *out = ends[0];
    const pid_t pid = fork();
    if (pid != 0) {
        close(ends[1]);
        return pid;
    }
    int tries = 0;
    if (setgroups(0, NULL) != 0 || setgid(65534) != 0 || setuid(65534) != 0) _exit(1);
    for (; tries < 200; tries++) {
        const int fd = connect_to(path);
        const char came_in = fd >= 0;
        if (write(ends[1], &came_in, 1) != 1) _exit(1);
        if (fd >= 0) close(fd);
        usleep(5000);
    }
    _exit(0);
}

static int count_entries(pid_t pid, int out) {
    char byte;
    int entries = 0, tries = 0, status = 0;
    for (; read(out, &byte, 1) == 1; tries++) entries += byte;
    waitpid(pid, &status, 0);
    close(out);
    assert_int_equal(status, 0);
    assert_int_equal(tries, 200);
    return entries;
}

/* ---- the test ------------------------------------------------------------------------------- */

static int by_size(const void *a, const void *b) {
    const long x = *(const long *)a, y = *(const long *)b;
    return (x > y) - (x < y);
}

/* Frames that were missed for it, of one try. */
static long try_load(int clients, int seconds, int watcher) {
    struct load *l = calloc(1, sizeof *l);
    int out = -1;
    assert_non_null(l);
    l->clients = calloc(CLIENTS_MAX, sizeof *l->clients);
    l->count = clients;
    const struct watch quiet = look(watcher);
    sleep((unsigned)seconds);
    const struct watch before = look(watcher);
    const bool is_root = geteuid() == 0;
    const pid_t stranger = is_root ? start_stranger(&out) : 0;
    run_load(l, seconds);
    const struct watch after = look(watcher);
    const int entries = is_root ? count_entries(stranger, out) : 0;
    qsort(l->late_us, (size_t)l->heard, sizeof *l->late_us, by_size);
    printf("%d clients, %d s: %ld requests, %ld replies, %ld busy, median %.2f ms, 99 %% %.2f ms, "
           "longest %.2f ms\n",
           clients, seconds, l->sent, l->heard, l->busy, (double)l->late_us[l->heard / 2] / 1000,
           (double)l->late_us[l->heard * 99 / 100] / 1000, (double)l->late_us[l->heard - 1] / 1000);
    printf("without load %ld frames, %ld missed; under load %ld, %ld missed; %.1f MB, then %.1f; "
           "%s\n",
           before.drawn - quiet.drawn, before.missed - quiet.missed, after.drawn - before.drawn,
           after.missed - before.missed, before.rss_mb, after.rss_mb,
           is_root ? "200 tries of another user" : "no other user to try as");
    fflush(stdout);
    const long wanted = (long)clients * PER_CLIENT * seconds;
    assert_in_range(l->sent, wanted * 9 / 10, wanted); /* the last may be due at the very end */
    assert_int_equal(l->heard, l->sent);
    assert_int_equal(l->wrong_order, 0);
    assert_int_equal(entries, 0);
    assert_true(after.drawn > before.drawn);
    const long by_itself = before.missed - quiet.missed;
    const long missed = after.missed - before.missed;
    free(l->clients);
    free(l);
    return missed > by_itself ? missed - by_itself : 0;
}

static void no_reply_is_lost_and_no_frame_missed(void **state) {
    const bool full = gn_shot_full();
    const int watcher = enter_kiosk();
    long least = -1;
    (void)state;
    sleep(3); /* programs are made */
    for (int attempt = 0; attempt < 3 && least != 0; attempt++) {
        const long missed = try_load(full ? 50 : 10, full ? 10 : 2, watcher);
        if (least < 0 || missed < least) least = missed;
    }
    json_t *status = ask_status(watcher);
    assert_int_equal(number_at(status, "control", "cut"), 0);
    assert_int_equal(number_at(status, "control", "refused"), 0);
    assert_int_equal(number_at(status, "control", "answered") + 1,
                     number_at(status, "control", "requests")); /* but for this one */
    json_decref(status);
    close(watcher);
    assert_int_equal(least, 0);
}

/* A socket that anybody may open is guarded all the same. */
static void nobody_comes_in_by_an_open_door(void **state) {
    int ends[2];
    char text[200] = "";
    (void)state;
    if (geteuid() != 0) skip();
    const int watcher = enter_kiosk();
    assert_int_equal(chmod(folder, 0755), 0);
    assert_int_equal(chmod(path, 0666), 0);
    assert_int_equal(pipe(ends), 0);
    const pid_t pid = fork();
    if (pid == 0) {
        if (setgroups(0, NULL) != 0 || setgid(65534) != 0 || setuid(65534) != 0) _exit(1);
        const int fd = connect_to(path);
        struct pollfd p = {.fd = fd, .events = POLLIN};
        if (fd < 0 || send(fd, "{\"cmd\":\"quit\"}\n", 15, MSG_NOSIGNAL) > 15) _exit(1);
        poll(&p, 1, 10000);
        const ssize_t got = recv(fd, text, sizeof text - 1, 0);
        _exit(got <= 0 || write(ends[1], text, (size_t)got) != got);
    }
    int status = 1;
    waitpid(pid, &status, 0);
    assert_int_equal(status, 0);
    assert_true(read(ends[0], text, sizeof text - 1) > 0);
    assert_non_null(strstr(text, "{\"ok\":false,\"error\":\"permission denied: user 65534"));
    json_t *now = ask_status(watcher);
    assert_int_equal(number_at(now, "control", "refused"), 1);
    json_decref(now);
    close(ends[0]);
    close(ends[1]);
    close(watcher);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_reply_is_lost_and_no_frame_missed),
        cmocka_unit_test(nobody_comes_in_by_an_open_door),
    };
    return cmocka_run_group_tests(tests, start_kiosk, stop_kiosk);
}
