/* gnomon ctl: sends one request to a running kiosk over its socket, and prints the reply. */
#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "cli/commands.h"
#include "core/clock.h"
#include "core/file.h"
#include "core/json.h"
#include "core/opener.h"
#include "core/text.h"
#include "kiosk/control/listen.h"
#include "kiosk/control/request.h"
#include "kiosk/screenshot.h"
#include "options/command.h"

static const int64_t PATIENCE_NS = 10 * GN_NS_PER_S;
static const int64_t LONG_PATIENCE_NS = 60 * GN_NS_PER_S; /* a scene may have to be loaded */
enum { REPLY_MAX = 256 * 1024, PICTURE_MAX = 1 << 30 };

struct talk { /* with the kiosk */
    int fd;
    int memory; /* a memory file to be passed with the request; -1: none */
    char path[PATH_MAX];
    int64_t until_ns;
    char reply[REPLY_MAX];
};

/* ---- the request -------------------------------------------------------------------------- */

/* The command of the words, if their number is right; or -1. */
static int find_request(const struct gn_options *o, struct gn_err *err) {
    const char *name = o->word_count > 0 ? o->words[0] : NULL;
    const int command = name ? gn_ctl_find(name) : -1;
    if (command < 0) {
        char list[400];
        const char *nearest = name ? gn_ctl_nearest(name) : NULL;
        gn_ctl_list(list, sizeof list);
        if (nearest)
            gn_fail_usage(err, "ctl: unknown command \"%.60s\"; did you mean %s?", name, nearest);
        else if (name)
            gn_fail_usage(err, "ctl: unknown command \"%.60s\"; expected one of%s", name, list);
        else
            gn_fail_usage(err, "ctl: no command; expected one of%s", list);
        return -1;
    }
    const struct gn_ctl_row *row = &gn_ctl_rows[command];
    const int wanted = gn_ctl_words((enum gn_ctl)command), given = o->word_count - 1;
    if (given <= wanted && given >= gn_ctl_words_least((enum gn_ctl)command)) return command;
    if (given < wanted)
        gn_fail_usage(err, "ctl %s: expected %s", row->name, row->words);
    else
        gn_fail_usage(err, "ctl %s: unexpected argument \"%.80s\"%s", row->name,
                      o->words[1 + wanted], wanted ? " (quote what has spaces)" : "");
    return -1;
}

static json_t *make_request(const struct gn_options *o, int command, struct gn_err *err) {
    const struct gn_ctl_row *row = &gn_ctl_rows[command];
    json_t *request = json_pack("{s:s}", "cmd", row->name);
    for (int i = 0; i < o->word_count - 1 && row->members[i]; i++) {
        const char *word = o->words[1 + i], *value = word;
        char folder[PATH_MAX], path[PATH_MAX];
        if (strcmp(row->members[i], "file") == 0 && word[0] != '/') {
            /* the kiosk has another working directory */
            if (!getcwd(folder, sizeof folder) ||
                snprintf(path, sizeof path, "%s/%s", folder, word) >= (int)sizeof path) {
                gn_fail(err, "ctl: %.200s: give the whole path", word);
                break;
            }
            value = path;
        }
        json_t *text = json_string(value);
        if (!text) gn_fail_usage(err, "ctl %s: \"%.80s\" is not UTF-8", row->name, word);
        if (!text || json_object_set_new(request, row->members[i], text) != 0) break;
    }
    if (!err->text[0]) return request;
    json_decref(request);
    return NULL;
}

/* ---- the connection ------------------------------------------------------------------------- */

static bool wait_for(struct talk *t, short events) {
    const int64_t left_ns = t->until_ns - gn_clock_monotonic_ns();
    struct pollfd p = {.fd = t->fd, .events = events};
    return left_ns > 0 && (poll(&p, 1, (int)(left_ns / 1000000) + 1) > 0 || errno == EINTR);
}

/* 0 or an errno. The kiosk's queue of connections may be full for a while. */
static int try_path(struct talk *t, const char *path) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (snprintf(address.sun_path, sizeof address.sun_path, "%s", path) >=
        (int)sizeof address.sun_path)
        return ENAMETOOLONG;
    t->fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    while (t->fd >= 0) {
        if (connect(t->fd, (const struct sockaddr *)&address, sizeof address) == 0) return 0;
        if (errno != EAGAIN || gn_clock_monotonic_ns() > t->until_ns) break;
        usleep(10000);
    }
    const int reason = errno;
    if (t->fd >= 0) close(t->fd);
    t->fd = -1;
    return reason;
}

static bool fail_path(const char *path, int reason, struct gn_err *err) {
    if (reason == ENOENT || reason == ECONNREFUSED)
        gn_fail(err, "no kiosk answers at %s; is gnomon show running?", path);
    else if (reason == EACCES)
        gn_fail(err,
                "%s: permission denied: the kiosk's own user, root and the members of the "
                "socket's group may ask",
                path);
    else
        gn_fail(err, "%s: cannot connect: %s", path, strerror(reason));
    return false;
}

static bool connect_kiosk(struct talk *t, const struct gn_settings *o, struct gn_err *err) {
    char path[GN_LISTEN_PATH_MAX], tried[3 * GN_LISTEN_PATH_MAX] = "";
    if (o->kiosk.socket) {
        const int reason = try_path(t, o->kiosk.socket);
        snprintf(t->path, sizeof t->path, "%s", o->kiosk.socket);
        return reason == 0 || fail_path(o->kiosk.socket, reason, err);
    }
    for (int i = 0; gn_listen_candidate(i, path, sizeof path); i++) {
        const int reason = try_path(t, path);
        snprintf(t->path, sizeof t->path, "%s", path);
        if (reason == 0) return true;
        if (reason != ENOENT && reason != ECONNREFUSED) return fail_path(path, reason, err);
        gn_text_add(tried, sizeof tried, "%s%s", tried[0] ? " or " : "", path);
    }
    return fail_path(tried, ENOENT, err);
}

static bool fail_talk(const struct talk *t, const char *what, struct gn_err *err) {
    return gn_fail(err, "the kiosk at %s %s", t->path, what);
}

static bool send_request(struct talk *t, const json_t *request, struct gn_err *err) {
    char *line = json_dumps(request, JSON_COMPACT);
    size_t left = line ? strlen(line) : 0;
    bool ok = line && left <= GN_REQUEST_LINE_MAX;
    if (ok)
        line[left++] = '\n';
    else
        gn_fail_usage(err, "ctl: more than %d bytes", GN_REQUEST_LINE_MAX);
    for (const char *at = line; ok && left > 0;) {
        const int fd = at == line ? t->memory : -1;
        const ssize_t sent = gn_send_with(t->fd, at, left, fd, MSG_NOSIGNAL);
        if (sent < 0 && errno == EPIPE) break; /* the reply has the reason */
        if (sent < 0 && errno != EAGAIN && errno != EINTR)
            ok = fail_talk(t, "closed the connection", err);
        else if (sent < 0 && !wait_for(t, POLLOUT))
            ok = fail_talk(t, "accepts no data", err);
        else if (sent > 0)
            at += sent, left -= (size_t)sent;
    }
    free(line);
    return ok;
}

/* An object, a new reference; or NULL. */
static json_t *receive_reply(struct talk *t, struct gn_err *err) {
    size_t used = 0;
    do {
        const ssize_t got = recv(t->fd, t->reply + used, sizeof t->reply - 1 - used, 0);
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
            fail_talk(t, "closed the connection", err);
            return NULL;
        }
        if (got < 0 && !wait_for(t, POLLIN)) {
            fail_talk(t, "did not answer in time", err);
            return NULL;
        }
        used += got > 0 ? (size_t)got : 0;
        t->reply[used] = '\0';
    } while (!memchr(t->reply, '\n', used) && used < sizeof t->reply - 1);
    if (!memchr(t->reply, '\n', used)) {
        fail_talk(t, "sent too long a reply", err);
        return NULL;
    }
    json_t *reply = json_loads(t->reply, 0, NULL);
    if (json_is_object(reply)) return reply;
    fail_talk(t, "sent an invalid reply", err);
    json_decref(reply);
    return NULL;
}

/* ---- the picture of a screenshot ------------------------------------------------------------- */

/* The kiosk writes into memory, and this process the file, with the rights of its user. */
static bool make_memory(struct talk *t, const char *path, struct gn_err *err) {
    if (!gn_screenshot_check(path, err)) return false;
    t->memory = memfd_create("gnomon-screenshot", MFD_CLOEXEC);
    return t->memory >= 0 ||
           gn_fail(err, "screenshot: cannot make a memory file: %s", strerror(errno));
}

static bool save_memory(struct talk *t, const char *path, struct gn_err *err) {
    struct gn_bytes png;
    const int fd = t->memory;
    t->memory = -1;
    lseek(fd, 0, SEEK_SET);
    bool ok = gn_file_read_fd(fd, path, PICTURE_MAX, &png, err);
    if (ok && png.size == 0) ok = fail_talk(t, "sent no picture; is it an older one?", err);
    ok = ok && gn_file_replace(path, png.data, png.size, err);
    gn_bytes_finish(&png);
    return ok;
}

/* ---- the reply --------------------------------------------------------------------------- */

static void print_value(const json_t *value) {
    if (json_is_string(value))
        gn_text_print(json_string_value(value), stdout);
    else if (json_is_integer(value))
        printf("%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        printf("%.6g", json_real_value(value));
    else
        fputs(json_is_true(value) ? "yes" : json_is_false(value) ? "no" : "-", stdout);
}

/* "screen.what: HDMI-A-1 1920x1080@60.00 atomic" */
static int print_object(const char *prefix, json_t *object) {
    const char *key;
    json_t *value;
    int lines = 0;
    json_object_foreach(object, key, value) {
        if (!prefix[0] && strcmp(key, "ok") == 0) continue;
        lines++;
        char name[100];
        snprintf(name, sizeof name, "%s%s%s", prefix, prefix[0] ? "." : "", key);
        if (json_is_object(value)) {
            print_object(name, value);
            continue;
        }
        gn_text_print(name, stdout);
        fputs(": ", stdout);
        if (!json_is_array(value)) print_value(value);
        for (size_t i = 0; i < json_array_size(value); i++) {
            if (i) fputs(", ", stdout);
            print_value(json_array_get(value, i));
        }
        putchar('\n');
    }
    return lines;
}

static bool print_reply(const struct gn_settings *o, json_t *reply, struct gn_err *err) {
    const bool ok = json_is_true(json_object_get(reply, "ok"));
    const char *why = json_string_value(json_object_get(reply, "error"));
    if (o->run.json && !gn_json_print(json_incref(reply), 9, stdout, err)) return false;
    if (ok) {
        if (!o->run.json && print_object("", reply) == 0) puts("done");
        return true;
    }
    const bool wrong = json_integer_value(json_object_get(reply, "status")) == GN_EXIT_USAGE;
    if (wrong) return gn_fail_usage(err, "%s", why ? why : "no");
    if (why && strcmp(why, "busy") == 0)
        return gn_fail(err, "the kiosk is busy: too many requests; try again");
    return gn_fail(err, "%s", why ? why : "request refused without a reason");
}

bool gn_cli_ctl(const struct gn_options *options, struct gn_warnings *warnings,
                struct gn_err *err) {
    (void)warnings;
    const int command = find_request(options, err);
    json_t *request = command < 0 ? NULL : make_request(options, command, err);
    if (!request) return false;
    const bool is_slow = gn_ctl_rows[command].flags & GN_CTL_SLOW;
    struct talk *talk = gn_xalloc(1, sizeof *talk);
    talk->fd = talk->memory = -1;
    talk->until_ns = gn_clock_monotonic_ns() + (is_slow ? LONG_PATIENCE_NS : PATIENCE_NS);
    json_t *reply = NULL;
    const bool has_file = gn_ctl_rows[command].flags & GN_CTL_FILE;
    const char *path = has_file ? json_string_value(json_object_get(request, "file")) : NULL;
    if ((!path || make_memory(talk, path, err)) && connect_kiosk(talk, options->settings, err) &&
        send_request(talk, request, err))
        reply = receive_reply(talk, err);
    if (path && json_is_true(json_object_get(reply, "ok")) && !save_memory(talk, path, err)) {
        json_decref(reply);
        reply = NULL;
    }
    json_decref(request);
    if (talk->fd >= 0) close(talk->fd);
    if (talk->memory >= 0) close(talk->memory);
    free(talk);
    const bool ok = reply && print_reply(options->settings, reply, err);
    json_decref(reply);
    return ok;
}
