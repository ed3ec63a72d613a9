#include "kiosk/control/control.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "kiosk/control/listen.h"
#include "kiosk/control/passed.h"

enum { CLIENTS = GN_CONTROL_CLIENTS_MAX };
static const int64_t STUCK_NS = 5 * GN_NS_PER_S; /* time to read a reply before it is cut off */
static const int64_t SILENT_NS =
    30 * GN_NS_PER_S; /* time without a line before it may be replaced */
static const int64_t CHANGE_NS = GN_NS_PER_S / GN_CONTROL_CHANGES_PER_S;

struct client {
    int fd;
    uid_t uid;
    struct gn_watch watch;
    struct gn_control *control;
    bool readable, ended, skips;      /* skips: it discards the rest of a line that is too long */
    enum { IDLE, ASKS, WAITS } state; /* a request is to be taken, or to be answered */
    int passed;                       /* a descriptor that came, for its next request; -1: none */
    char *out;                        /* the unsent part of a reply; from malloc */
    size_t out_size, out_at;
    int64_t sent_ns, line_ns; /* last progress in sending; its last line */
    size_t used;              /* of in */
    char in[GN_REQUEST_LINE_MAX + 1];
    struct gn_request request;
};

struct gn_control {
    struct gn_listen listen;
    struct gn_loop *loop;
    struct gn_watch listener;
    struct gn_timer timer; /* due when there is something to do */
    int spare;             /* a descriptor that is closed to refuse a connection without any left */
    int64_t now_ns;
    int64_t changes_ns[2]; /* virtual times of the leaky buckets: of others, of owners */
    int turn;              /* the client that is served first */
    struct gn_control_counts counts;
    struct client *clients[CLIENTS]; /* NULL: none */
};

/* ---- opening -------------------------------------------------------------------------------- */

static void accept_connection(void *user, int64_t now_ns);
static void serve_clients(void *user, int64_t now_ns);

struct gn_control *gn_control_open(const char *path, struct gn_loop *loop, struct gn_err *err) {
    struct gn_control *c = gn_xalloc(1, sizeof *c);
    c->loop = loop;
    c->listen = (struct gn_listen){.fd = -1, .lock = -1};
    c->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
    c->timer = (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = serve_clients, .user = c};
    gn_loop_add_timer(loop, &c->timer);
    if (gn_listen_open(&c->listen, path, err)) {
        c->listener = (struct gn_watch){
            .fd = c->listen.fd, .events = EPOLLIN, .call = accept_connection, .user = c};
        if (gn_loop_add(loop, &c->listener)) return c;
        gn_fail(err, "control socket %s: cannot wait: %s", path, strerror(errno));
    }
    gn_control_close(c);
    return NULL;
}

static void close_passed(int *fd) {
    if (*fd >= 0) gn_passed_close(*fd);
    *fd = -1;
}

static void drop_client(struct client **place) {
    struct client *client = *place;
    *place = NULL;
    if (!client) return;
    gn_loop_remove(&client->watch);
    close_passed(&client->passed);
    close_passed(&client->request.fd);
    gn_passed_close_socket(client->fd);
    free(client->out);
    free(client);
}

void gn_control_close(struct gn_control *c) {
    if (!c) return;
    for (int i = 0; i < CLIENTS; i++) drop_client(&c->clients[i]);
    gn_loop_remove(&c->listener);
    gn_loop_remove_timer(&c->timer);
    gn_listen_close(&c->listen);
    if (c->spare >= 0) close(c->spare);
    free(c);
}

struct gn_control_counts gn_control_counts(const struct gn_control *c) {
    return c->counts;
}

/* ---- replies -------------------------------------------------------------------------------- */

/* The reply's line; the caller frees it. A fixed one if there is no memory for it. */
static char *line_of(json_t *reply, size_t *size) {
    char *text = reply ? json_dumps(reply, JSON_COMPACT) : NULL;
    json_decref(reply);
    if (!text) text = strdup("{\"ok\":false,\"error\":\"no memory left\",\"status\":1}");
    if (!text) abort();
    *size = strlen(text);
    text[(*size)++] = '\n'; /* in place of the ending zero */
    return text;
}

static void flush_reply(struct client *client, int64_t now_ns) {
    while (client->out) {
        const ssize_t sent = send(client->fd, client->out + client->out_at,
                                  client->out_size - client->out_at, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0 && errno == EAGAIN) return;
        if (sent < 0) { /* the client has closed the connection */
            client->ended = true;
            client->used = 0;
            client->readable = false;
        }
        client->sent_ns = now_ns;
        client->out_at += sent > 0 ? (size_t)sent : 0;
        if (sent > 0 && client->out_at < client->out_size) continue;
        free(client->out);
        client->out = NULL;
    }
}

static void send_reply(struct client *client, json_t *json) {
    struct gn_control *c = client->control;
    client->state = IDLE;
    client->out = line_of(json, &client->out_size);
    client->out_at = 0;
    client->sent_ns = c->now_ns;
    c->counts.answered++;
    flush_reply(client, c->now_ns);
}

/* ---- lines ---------------------------------------------------------------------------------- */

static bool is_owner(const struct client *client) {
    return gn_listen_is_owner(&client->control->listen, client->uid);
}

/* A leaky bucket as a virtual time: a burst of one second's changes, then an even rate. */
static bool changes_too_often(const struct client *client) {
    const int64_t now_ns = client->control->now_ns;
    int64_t *until_ns = &client->control->changes_ns[is_owner(client)];
    if (!(gn_ctl_rows[client->request.command].flags & GN_CTL_CHANGES)) return false;
    if (*until_ns - now_ns > GN_NS_PER_S - CHANGE_NS) return true;
    *until_ns = (*until_ns > now_ns ? *until_ns : now_ns) + CHANGE_NS;
    return false;
}

static bool check_request(struct client *client, const char *line, size_t length,
                          struct gn_err *err) {
    struct gn_control_counts *counts = &client->control->counts;
    if (!gn_request_parse(line, length, &client->request, err)) {
        counts->wrong++;
        return false;
    }
    if (changes_too_often(client)) {
        counts->busy++;
        return gn_fail(err, "busy");
    }
    return is_owner(client) || !(gn_ctl_rows[client->request.command].flags & GN_CTL_OWNER) ||
           gn_fail(err, "permission denied: the kiosk opens files for its own user and root only");
}

static void take_line(struct client *client, const char *line, size_t length) {
    struct gn_err err = {0};
    client->line_ns = client->control->now_ns;
    client->control->counts.requests++;
    if (!check_request(client, line, length, &err)) {
        send_reply(client, gn_reply_failure(&err));
        return;
    }
    client->state = ASKS;
    if (!(gn_ctl_rows[client->request.command].flags & GN_CTL_FILE)) return;
    client->request.fd = client->passed;
    client->passed = -1;
}

/* A descriptor takes the place of an earlier one. */
static void read_input(struct client *client) {
    int passed;
    const ssize_t got = gn_passed_receive(client->fd, client->in + client->used,
                                          sizeof client->in - client->used, &passed);
    if (passed >= 0) {
        close_passed(&client->passed);
        client->passed = passed;
    }
    if (got > 0) client->used += (size_t)got;
    if (got > 0 || (got < 0 && errno == EINTR)) return;
    client->ended |= got == 0 || errno != EAGAIN;
    client->readable = false;
}

/* Handles one line, or reads one piece of input. False: nothing to do for this client now. */
static bool serve_client(struct client **place) {
    struct client *client = *place;
    if (!client || client->out || client->state != IDLE) return false;
    const char *newline = memchr(client->in, '\n', client->used);
    if (newline || (client->ended && client->used > 0)) { /* the last line needs no newline */
        const size_t length = newline ? (size_t)(newline - client->in) : client->used;
        if (!client->skips) take_line(client, client->in, length);
        client->skips = false;
        const size_t bytes = length < client->used ? length + 1 : client->used;
        client->used -= bytes;
        memmove(client->in, client->in + bytes, client->used);
    } else if (client->used == sizeof client->in) {
        /* a line that is too long is refused at once, and the rest of it is discarded */
        client->used = 0;
        if (!client->skips) take_line(client, client->in, sizeof client->in);
        client->skips = true;
    } else if (client->readable) {
        read_input(client);
    } else if (client->ended) {
        drop_client(place); /* all its requests are answered */
    } else {
        return false;
    }
    return true;
}

/* ---- clients -------------------------------------------------------------------------------- */

/* Whether that user may have one more client when `without` (or NULL) is closed. */
static bool has_place(const struct gn_control *c, uid_t uid, const struct client *without) {
    int all = 0, own = 0, others = 0;
    for (int i = 0; i < CLIENTS; i++) {
        const struct client *client = c->clients[i];
        if (!client || client == without) continue;
        all++;
        own += client->uid == uid;
        others += !is_owner(client);
    }
    return all < CLIENTS && (gn_listen_is_owner(&c->listen, uid) ||
                             (own < GN_CONTROL_USER_MAX && others < CLIENTS - GN_CONTROL_KEPT));
}

/* An unused place, or that of the client that was silent for longest; NULL: none. */
static struct client **find_place(struct gn_control *c, uid_t uid) {
    struct client **found = NULL;
    const bool is_full = !has_place(c, uid, NULL);
    for (int i = 0; i < CLIENTS; i++) {
        const struct client *client = c->clients[i];
        if (!client && !is_full) return &c->clients[i];
        if (client && client->state == IDLE && !client->out &&
            c->now_ns - client->line_ns >= SILENT_NS &&
            (!found || client->line_ns < (*found)->line_ns) && has_place(c, uid, client))
            found = &c->clients[i];
    }
    if (found) drop_client(found);
    return found;
}

/* Sends the only reply; a new socket has room for it. */
static void refuse_connection(struct gn_control *c, int fd, const struct gn_err *err) {
    size_t size;
    char *line = line_of(gn_reply_failure(err), &size);
    c->counts.refused++;
    if (send(fd, line, size, MSG_NOSIGNAL | MSG_DONTWAIT) < 0) c->counts.cut++;
    free(line);
    gn_passed_close_socket(fd);
}

static void on_client(void *user, int64_t now_ns) {
    struct client *client = user;
    client->readable = true;
    client->control->timer.due_ns = now_ns;
}

static bool admit_client(struct gn_control *c, int fd, struct gn_err *err) {
    uid_t uid;
    if (!gn_listen_permits(&c->listen, fd, &uid))
        return gn_fail(err, "permission denied: user %ld is not in the group of %s", (long)uid,
                       c->listen.path);
    struct client **place = find_place(c, uid);
    if (!place) return gn_fail(err, "busy");
    struct client *client = gn_xalloc(1, sizeof *client);
    client->fd = fd;
    client->uid = uid;
    client->control = c;
    client->passed = client->request.fd = -1;
    client->line_ns = c->timer.due_ns = c->now_ns;
    client->readable = true;
    client->watch = (struct gn_watch){.fd = fd,
                                      .events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET,
                                      .call = on_client,
                                      .user = client};
    if (!gn_loop_add(c->loop, &client->watch)) {
        free(client);
        return gn_fail(err, "busy");
    }
    *place = client;
    c->counts.accepted++;
    return true;
}

/* One connection in each step of the loop. Where no descriptor is left the spare one is closed, so
 * that the connection can be accepted and refused; else it would keep the listener readable. */
static void accept_connection(void *user, int64_t now_ns) {
    struct gn_control *c = user;
    struct gn_err err = {0};
    c->now_ns = now_ns;
    int fd = accept4(c->listen.fd, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
    const bool lacks_descriptor = fd < 0 && (errno == EMFILE || errno == ENFILE);
    if (lacks_descriptor) {
        if (c->spare >= 0) close(c->spare);
        fd = accept4(c->listen.fd, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
        gn_fail(&err, "busy");
    }
    if (fd >= 0 && (lacks_descriptor || !admit_client(c, fd, &err))) refuse_connection(c, fd, &err);
    if (lacks_descriptor) c->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
}

/* ---- serving -------------------------------------------------------------------------------- */

/* Closes clients that have not read their reply in time; sets the timer for the next. */
static void cut_stuck(struct gn_control *c) {
    for (int i = 0; i < CLIENTS; i++) {
        if (!c->clients[i] || !c->clients[i]->out) continue;
        const int64_t due_ns = c->clients[i]->sent_ns + STUCK_NS;
        if (due_ns <= c->now_ns) {
            drop_client(&c->clients[i]);
            c->counts.cut++;
        } else if (due_ns < c->timer.due_ns) {
            c->timer.due_ns = due_ns;
        }
    }
}

static void serve_clients(void *user, int64_t now_ns) {
    struct gn_control *c = user;
    c->now_ns = now_ns;
    for (int i = 0; i < CLIENTS; i++)
        if (c->clients[i]) flush_reply(c->clients[i], now_ns);

    /* round robin, a line each, so that a busy client does not starve the others */
    int budget = GN_CONTROL_PER_STEP;
    for (int idle = 0; idle < CLIENTS && budget > 0; c->turn = (c->turn + 1) % CLIENTS) {
        const bool served = serve_client(&c->clients[c->turn]);
        idle = served ? 0 : idle + 1;
        budget -= served;
    }
    if (budget == 0) c->timer.due_ns = now_ns;
    cut_stuck(c);
}

const struct gn_request *gn_control_next(struct gn_control *c) {
    for (int i = 0; i < CLIENTS; i++) {
        struct client *client = c->clients[i];
        if (!client || client->state != ASKS) continue;
        client->state = WAITS;
        return &client->request;
    }
    return NULL;
}

void gn_control_answer(struct gn_control *c, const struct gn_request *request, json_t *json) {
    struct client *client = NULL;
    for (int i = 0; i < CLIENTS; i++)
        if (c->clients[i] && &c->clients[i]->request == request) client = c->clients[i];
    close_passed(&client->request.fd);
    c->now_ns = c->timer.due_ns = gn_loop_now_ns(c->loop);
    const char *error = json_string_value(json_object_get(json, "error"));
    c->counts.busy += error && strcmp(error, "busy") == 0;
    if (json && !json_object_get(json, "ok")) json_object_set_new(json, "ok", json_true());
    send_reply(client, json);
}
