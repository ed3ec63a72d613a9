/* The control socket: its requests get the answers of the kiosk, and its counts stand in the
 * status. */
#include <string.h>

#include "core/clock.h"
#include "kiosk/control/answer.h"
#include "kiosk/control/control.h"
#include "kiosk/control/listen.h"
#include "kiosk/part.h"

static const int64_t AGAIN_NS = 5 * GN_NS_PER_S; /* until a socket is tried again */

struct socket_part { /* the part's memory */
    const struct gn_part_host *host;
    struct gn_control *control; /* NULL: no socket */
    struct gn_transport transport;
    struct gn_timer again;           /* while there is no socket */
    struct gn_control_counts counts; /* for the status */
};

/* The caption says so, too, where the configuration names a socket; once for each reason. */
static void report_closed(const struct gn_part_host *h, bool named, const char *why) {
    if (strcmp(h->problems->of[GN_PROBLEM_CONTROL], why) == 0) return;
    if (named)
        h->report_error(h->show, GN_PROBLEM_CONTROL, why);
    else
        gn_problem_report(h->problems, GN_PROBLEM_CONTROL, why);
}

static void report_opened(const struct gn_part_host *h) {
    h->cure_error(h->show, GN_PROBLEM_CONTROL);
}

static void answer(void *part, const struct gn_request *request, json_t *reply) {
    const struct socket_part *c = part;
    gn_control_answer(c->control, request, reply);
}

/* Descriptors, the folder or another kiosk's lock may be what is missing, and come. */
static void open_again(void *part, int64_t now_ns);

static void open_control(void *part) {
    struct socket_part *c = part;
    const struct gn_part_host *h = c->host;
    char path[GN_LISTEN_PATH_MAX];
    struct gn_err err = {0};
    const char *named = (*h->settings)->kiosk.socket;
    if (!named && (h->display->ops->is_window || !gn_listen_default(path, sizeof path))) return;
    c->transport = (struct gn_transport){.self = c, .answer = answer};
    c->control = gn_control_open(named ? named : path, h->loop, &err);
    if (c->control) {
        if (h->problems->of[GN_PROBLEM_CONTROL][0]) report_opened(h);
        return;
    }
    report_closed(h, named, err.text);
    c->again = (struct gn_timer){
        .due_ns = gn_loop_now_ns(h->loop) + AGAIN_NS, .call = open_again, .user = c};
    gn_loop_add_timer(h->loop, &c->again);
}

static void open_again(void *part, int64_t now_ns) {
    struct socket_part *c = part;
    (void)now_ns;
    gn_loop_remove_timer(&c->again);
    open_control(c);
}

static void close_control(void *part) {
    struct socket_part *c = part;
    gn_loop_remove_timer(&c->again);
    gn_show_forget_requests(c->host->show, &c->transport);
    gn_control_close(c->control);
    c->control = NULL;
}

static void take_requests(void *part) {
    struct socket_part *c = part;
    if (!c->control) return;
    for (const struct gn_request *r; (r = gn_control_next(c->control)) != NULL;)
        gn_show_take_request(c->host->show, &c->transport, r);
}

static bool answer_in_pause(void *part, uint64_t pieces, int64_t run_ns, struct gn_err *err) {
    (void)pieces, (void)run_ns, (void)err;
    take_requests(part);
    return true;
}

static const void *control_status(void *part) {
    struct socket_part *c = part;
    if (!c->control) return NULL;
    c->counts = gn_control_counts(c->control);
    return c;
}

#define METRIC(member, ...)                                                                        \
    GN_METRIC(struct socket_part, counts.member, "control." #member, __VA_ARGS__)
static const struct gn_metric metrics[] = {
    METRIC(accepted, "", "clients"),
    METRIC(refused, "", "clients that were not permitted, or too many"),
    METRIC(requests, "", "of clients"),
    METRIC(wrong, "", "requests that could not be parsed"),
    METRIC(busy, "", "requests that came too often"),
    METRIC(answered, "", "requests"),
    METRIC(cut, "", "clients closed because they did not read"),
};

const struct gn_part gn_part_control = {
    .name = "control",
    .size = sizeof(struct socket_part),
    .open = open_control,
    .look = take_requests,
    .pause = answer_in_pause,
    .status = control_status,
    GN_PART_METRICS(metrics),
    .close = close_control,
};
