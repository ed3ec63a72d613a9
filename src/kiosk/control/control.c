#include "kiosk/control/control.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "kiosk/control/listen.h"
#include "kiosk/control/passed.h"

enum { CLIENTS = GN_CONTROL_CLIENTS_MAX, ACCEPTS_PER_DISPATCH = 16 };
static const int64_t STUCK_NS =
    5 * GN_NS_PER_S; /* a client that does not read a reply for as long is cut off */
static const int64_t SILENT_NS =
    30 * GN_NS_PER_S; /* a client without a line for as long may be replaced */
static const int64_t CHANGE_NS = GN_NS_PER_S / GN_CONTROL_CHANGES_PER_S;

/* The large part of a client: takes no memory until it is used. */
struct buffers {
    char in[GN_REQUEST_LINE_MAX + 1];
    struct gn_request request;
};
/* Events are edge-triggered, so they are kept as flags. */
struct client {
    int fd; /* -1: none */
    uid_t uid;
    struct gn_watch watch;
    struct gn_control *control;
    struct buffers *buffers;
    bool readable, ended, skips; /* skips: it discards the rest of a line that is too long */
    bool waits;                  /* for the owner to answer its request */
    int passed;                  /* a descriptor that came, for its next request; -1: none */
    size_t used;                 /* of buffers->in */
    char *out;                   /* the unsent part of a reply; from malloc */
    size_t out_size, out_at;
    int64_t stuck_ns, line_ns; /* last progress in sending; its last line */
};

struct gn_control {
    struct gn_listen listen;
    struct gn_loop *loop;
    struct gn_watch listener;
    struct gn_timer timer; /* due when there is something to do */
    int spare;             /* a descriptor that is closed to refuse a connection without any left */
    bool pending;          /* connections wait to be accepted */
    int64_t now_ns;
    int64_t changes_ns[2]; /* virtual times of the leaky buckets: of others, of owners */
    int turn;              /* the client that is served first */
    int budget;
    int queue[CLIENTS], queued, first;
    struct gn_control_counts counts;
    struct client clients[CLIENTS];
    struct buffers buffers[CLIENTS];
};

/* ---- opening -------------------------------------------------------------------------------- */

static void on_connection(void *user, uint32_t events, int64_t now_ns) {
    struct gn_control *c = user;
    (void)events;
    c->pending = true;
    c->timer.due_ns = now_ns;
}

static void serve_clients(void *user, int64_t now_ns);

struct gn_control *gn_control_open(const char *path, struct gn_loop *loop, struct gn_err *err) {
    struct gn_control *c = gn_xalloc(1, sizeof *c);
    c->loop = loop;
    c->listen = (struct gn_listen){.fd = -1, .lock = -1};
    for (int i = 0; i < CLIENTS; i++)
        c->clients[i] =
            (struct client){.fd = -1, .passed = -1, .control = c, .buffers = &c->buffers[i]};
    c->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
    c->timer = (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = serve_clients, .user = c};
    gn_loop_add_timer(loop, &c->timer);
    if (gn_listen_open(&c->listen, path, err)) {
        c->listener = (struct gn_watch){
            .fd = c->listen.fd, .events = EPOLLIN, .call = on_connection, .user = c};
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

static void drop_client(struct client *client) {
    gn_loop_remove(&client->watch);
    close_passed(&client->passed);
    if (client->waits) close_passed(&client->buffers->request.fd);
    gn_passed_close_socket(client->fd);
    free(client->out);
    client->fd = -1;
    client->out = NULL;
}

void gn_control_close(struct gn_control *c) {
    if (!c) return;
    for (int i = 0; i < CLIENTS; i++)
        if (c->clients[i].fd >= 0) drop_client(&c->clients[i]);
    gn_loop_remove(&c->listener);
    gn_loop_remove_timer(&c->timer);
    gn_listen_close(&c->listen);
    if (c->spare >= 0) close(c->spare);
    free(c);
}

const char *gn_control_path(const struct gn_control *c) { return c->listen.path; }
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

static void flush_reply(struct gn_control *c, struct client *client) {
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
        if (sent > 0) client->stuck_ns = c->now_ns;
        client->out_at += sent > 0 ? (size_t)sent : client->out_size - client->out_at;
        if (client->out_at < client->out_size) continue;
        free(client->out);
        client->out = NULL;
    }
}

static void send_reply(struct gn_control *c, struct client *client, json_t *json) {
    client->out = line_of(json, &client->out_size);
    client->out_at = 0;
    client->stuck_ns = c->now_ns;
    c->counts.answered++;
    flush_reply(c, client);
}

/* ---- lines ---------------------------------------------------------------------------------- */

/* A leaky bucket as a virtual time: a burst of one second's changes, then an even rate. */
static bool changes_too_often(struct gn_control *c, const struct client *client) {
    int64_t *until_ns = &c->changes_ns[gn_listen_is_owner(&c->listen, client->uid)];
    if (!(gn_ctl_rows[client->buffers->request.command].flags & GN_CTL_CHANGES)) return false;
    if (*until_ns - c->now_ns > GN_NS_PER_S - CHANGE_NS) return true;
    *until_ns = (*until_ns > c->now_ns ? *until_ns : c->now_ns) + CHANGE_NS;
    return false;
}

static bool may_ask(const struct gn_control *c, const struct client *client) {
    return !(gn_ctl_rows[client->buffers->request.command].flags & GN_CTL_OWNER) ||
           gn_listen_is_owner(&c->listen, client->uid);
}

static void take_line(struct gn_control *c, struct client *client, const char *line,
                      size_t length) {
    struct gn_err err = {0};
    client->line_ns = c->now_ns;
    c->counts.requests++;
    if (!gn_request_parse(line, length, &client->buffers->request, &err)) {
        c->counts.wrong++;
        send_reply(c, client, gn_reply_failure(&err));
    } else if (changes_too_often(c, client)) {
        c->counts.busy++;
        gn_fail(&err, "busy");
        send_reply(c, client, gn_reply_failure(&err));
    } else if (!may_ask(c, client)) {
        gn_fail(&err, "permission denied: the kiosk opens files for its own user and root only");
        send_reply(c, client, gn_reply_failure(&err));
    } else {
        const int index = (int)(client - c->clients);
        client->buffers->request.from = (uint64_t)index;
        if (gn_ctl_rows[client->buffers->request.command].flags & GN_CTL_FILE) {
            client->buffers->request.fd = client->passed;
            client->passed = -1;
        }
        client->waits = true;
        c->queue[(c->first + c->queued++) % CLIENTS] = index;
    }
}

/* The last line before the end of the stream needs no newline. */
static bool has_line(const struct client *client, size_t *length) {
    const char *newline = memchr(client->buffers->in, '\n', client->used);
    *length = newline ? (size_t)(newline - client->buffers->in) : client->used;
    return newline || (client->ended && client->used > 0);
}

/* Whether there is something to do for it now. */
static bool is_due(const struct client *client) {
    size_t length;
    return client->fd >= 0 && !client->out && !client->waits &&
           (client->readable || client->ended || has_line(client, &length) ||
            client->used == sizeof client->buffers->in);
}

/* A descriptor takes the place of an earlier one. */
static ssize_t receive_input(struct client *client, char *to, size_t room) {
    int passed;
    const ssize_t got = gn_passed_receive(client->fd, to, room, &passed);
    if (passed < 0) return got;
    close_passed(&client->passed);
    client->passed = passed;
    return got;
}

/* Handles one line, or reads one piece of input. */
static void serve_client(struct gn_control *c, struct client *client) {
    char *in = client->buffers->in;
    size_t length;
    c->budget--;
    if (has_line(client, &length)) {
        const bool skipped = client->skips;
        client->skips = false;
        if (!skipped) take_line(c, client, in, length);
        const size_t bytes = length + 1 < client->used ? length + 1 : client->used;
        memmove(in, in + bytes, client->used - bytes);
        client->used -= bytes;
    } else if (client->used == sizeof client->buffers->in) {
        /* a line that is too long is refused at once, and the rest of it is discarded */
        client->used = 0;
        if (!client->skips) take_line(c, client, in, sizeof client->buffers->in);
        client->skips = true;
    } else if (client->readable) {
        const size_t room = sizeof client->buffers->in - client->used;
        const ssize_t got = receive_input(client, in + client->used, room);
        if (got > 0) {
            client->used += (size_t)got;
        } else if (got == 0 || errno != EINTR) {
            client->ended |= got == 0 || errno != EAGAIN;
            client->readable = false;
        }
    } else {
        drop_client(client); /* its stream has ended, and all is answered */
    }
}

/* ---- clients -------------------------------------------------------------------------------- */

/* May that user have one more client, once `without` (or NULL) has gone? */
static bool has_place(const struct gn_control *c, uid_t uid, const struct client *without) {
    const uid_t owners[] = {0, c->listen.uid};
    int places = 0, own = 0, kept = 0;
    for (int i = 0; i < CLIENTS; i++) {
        const bool is_free = c->clients[i].fd < 0 || &c->clients[i] == without;
        places += is_free;
        own += !is_free && c->clients[i].uid == uid;
    }
    for (int k = 0; k < (c->listen.uid ? 2 : 1); k++) {
        int has = 0;
        if (owners[k] == uid) continue;
        for (int i = 0; i < CLIENTS; i++)
            has += c->clients[i].fd >= 0 && &c->clients[i] != without &&
                   c->clients[i].uid == owners[k];
        kept += has < GN_CONTROL_KEPT ? GN_CONTROL_KEPT - has : 0;
    }
    return places > kept && (own < GN_CONTROL_USER_MAX || gn_listen_is_owner(&c->listen, uid));
}

/* An unused client, or that of the user who was silent for longest. */
static struct client *find_room(struct gn_control *c, uid_t uid) {
    struct client *found = NULL;
    const bool is_full = !has_place(c, uid, NULL);
    for (int i = 0; i < CLIENTS; i++) {
        struct client *client = &c->clients[i];
        if (!is_full && client->fd < 0) return client;
        const bool is_silent = client->fd >= 0 && !client->waits && !client->out &&
                               c->now_ns - client->line_ns >= SILENT_NS;
        if (is_silent && (!found || client->line_ns < found->line_ns) && has_place(c, uid, client))
            found = client;
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

static void on_client(void *user, uint32_t events, int64_t now_ns) {
    struct client *client = user;
    struct gn_control *c = client->control;
    c->now_ns = c->timer.due_ns = now_ns;
    client->readable |= (events & (EPOLLIN | EPOLLRDHUP | EPOLLHUP | EPOLLERR));
    if (events & (EPOLLOUT | EPOLLHUP | EPOLLERR)) flush_reply(c, client);
}

static void admit_client(struct gn_control *c, int fd) {
    struct gn_err err = {0};
    uid_t uid;
    if (!gn_listen_permits(&c->listen, fd, &uid)) {
        gn_fail(&err, "permission denied: user %ld is not in the group of %s", (long)uid,
                c->listen.path);
        refuse_connection(c, fd, &err);
        return;
    }
    struct client *client = find_room(c, uid);
    if (client)
        client->watch = (struct gn_watch){.fd = fd,
                                          .events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET,
                                          .call = on_client,
                                          .user = client};
    if (!client || !gn_loop_add(c->loop, &client->watch)) {
        gn_fail(&err, "busy");
        refuse_connection(c, fd, &err);
        return;
    }
    client->fd = fd;
    client->uid = uid;
    client->readable = true;
    client->ended = client->skips = client->waits = false;
    client->used = 0;
    client->line_ns = c->now_ns;
    c->counts.accepted++;
}

static void accept_connections(struct gn_control *c) {
    c->pending = false;
    for (int i = 0; i < ACCEPTS_PER_DISPATCH; i++) {
        int fd = accept4(c->listen.fd, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (fd >= 0) {
            admit_client(c, fd);
        } else if (errno == EMFILE || errno == ENFILE) {
            /* no descriptor is left, and the pending connection keeps the listener readable: the
             * spare descriptor is closed to accept and refuse it */
            struct gn_err err = {0};
            if (c->spare >= 0) close(c->spare);
            fd = accept4(c->listen.fd, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK);
            gn_fail(&err, "busy");
            if (fd >= 0) refuse_connection(c, fd, &err);
            c->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
        } else if (errno != EINTR && errno != ECONNABORTED) {
            return;
        }
    }
}

/* ---- dispatching ---------------------------------------------------------------------------- */

/* Due at once while there is anything to do, else when a client has to be cut off. */
static void set_timer(struct gn_control *c) {
    int64_t at_ns = c->pending ? c->now_ns : GN_LOOP_NEVER;
    for (int i = 0; i < CLIENTS; i++) {
        const struct client *client = &c->clients[i];
        if (is_due(client)) at_ns = c->now_ns;
        if (client->fd >= 0 && client->out && client->stuck_ns + STUCK_NS < at_ns)
            at_ns = client->stuck_ns + STUCK_NS;
    }
    c->timer.due_ns = at_ns;
}

static void serve_clients(void *user, int64_t now_ns) {
    struct gn_control *c = user;
    c->now_ns = now_ns;

    for (int i = 0; i < CLIENTS; i++) {
        struct client *client = &c->clients[i];
        if (client->fd < 0 || !client->out || now_ns - client->stuck_ns < STUCK_NS) continue;
        drop_client(client);
        c->counts.cut++;
    }
    if (c->pending) accept_connections(c);

    /* round robin, a line each, so that a busy client does not starve the others */
    c->budget = GN_CONTROL_PER_STEP;
    for (int idle = 0; idle < CLIENTS && c->budget > 0; c->turn = (c->turn + 1) % CLIENTS) {
        struct client *client = &c->clients[c->turn];
        const bool due = is_due(client);
        if (due) serve_client(c, client);
        idle = due ? 0 : idle + 1;
    }
    set_timer(c);
}

const struct gn_request *gn_control_next(struct gn_control *c) {
    if (c->queued == 0) return NULL;
    const int index = c->queue[c->first];
    c->first = (c->first + 1) % CLIENTS;
    c->queued--;
    return &c->buffers[index].request;
}

void gn_control_answer(struct gn_control *c, const struct gn_request *request, json_t *json) {
    struct client *client = &c->clients[request->from];
    client->waits = false;
    close_passed(&client->buffers->request.fd);
    c->now_ns = gn_loop_now_ns(c->loop);
    if (json && !json_object_get(json, "ok")) json_object_set_new(json, "ok", json_true());
    send_reply(c, client, json);
    set_timer(c);
}

void gn_control_refuse(struct gn_control *c, const struct gn_request *request,
                       const struct gn_err *err) {
    if (err->status == GN_EXIT_RUNTIME && strcmp(err->text, "busy") == 0) c->counts.busy++;
    gn_control_answer(c, request, gn_reply_failure(err));
}
