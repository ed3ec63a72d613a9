/* [schedule] off = cec: a television that goes into standby and comes back with the screen. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "kiosk/part.h"

struct television {
    const struct gn_part_host *host;
    struct gn_television *thread; /* NULL: none */
    char device[256];             /* of the settings that it was opened with; "": to be found */
    struct gn_watch watch;
    struct gn_television_state state; /* after the last attempt */
    bool is_set, on;                  /* what was wanted last */
    char connector[64];
    const char *wanted, *told, *waits; /* for the status */
};

static void take_state(void *user, int64_t now_ns) {
    struct television *t = user;
    (void)now_ns;
    gn_television_read(t->thread, &t->state);
    if (t->state.problem[0])
        gn_problem_report(t->host->problems, GN_PROBLEM_TELEVISION, t->state.problem);
    else
        gn_problem_cure(t->host->problems, GN_PROBLEM_TELEVISION);
}

static void close_television(void *part) {
    struct television *t = part;
    gn_loop_remove(&t->watch);
    gn_television_close(t->thread);
    gn_problem_cure(t->host->problems, GN_PROBLEM_TELEVISION);
    *t = (struct television){.host = t->host};
}

static void open_television(void *part) {
    struct television *t = part;
    const struct gn_part_host *h = t->host;
    const struct gn_schedule_settings *o = &(*h->options)->settings->schedule;
    const struct gn_television_opts opts =
        h->television ? *h->television : (struct gn_television_opts){.cec.device = o->cec_device};
    struct gn_err err = {0};
    const char *device = o->cec_device ? o->cec_device : "";
    const bool is_wanted = o->off & GN_OFF_CEC;
    if (is_wanted && t->thread && strcmp(t->device, device) == 0) return; /* as it is */
    close_television(t);
    if (!is_wanted) return;
    t->thread = gn_television_open(&opts, &err);
    if (!t->thread) {
        gn_problem_report(h->problems, GN_PROBLEM_TELEVISION, err.text);
        return;
    }
    snprintf(t->device, sizeof t->device, "%s", device);
    t->watch = (struct gn_watch){
        .fd = gn_television_fd(t->thread), .events = EPOLLIN, .call = take_state, .user = t};
    if (gn_loop_add(h->loop, &t->watch)) return;
    gn_fail(&err, "cannot wait for the television: %s", strerror(errno));
    close_television(t);
    gn_problem_report(h->problems, GN_PROBLEM_TELEVISION, err.text);
}

/* The one that is configured, else the one in use: of "HDMI-A-1 1920x1080@60.00 atomic". False: it
 * is not known yet. */
static bool find_connector(const struct gn_part_host *h, char *out, size_t size) {
    const struct gn_screen *screen = &h->display->screen;
    const char *named = (*h->settings)->display.connector;
    if (!named && h->display->ops->is_console)
        snprintf(out, size, "%.*s", (int)strcspn(screen->what, " "), screen->what);
    else
        snprintf(out, size, "%s", named ? named : "");
    return named || !h->display->ops->is_console || screen->what[0] || screen->status[0];
}

static void step_television(void *part) {
    struct television *t = part;
    const bool on = !gn_kiosk_is_dark(t->host->kiosk);
    char connector[sizeof t->connector];
    if (!t->thread || !find_connector(t->host, connector, sizeof connector)) return;
    if (t->is_set && t->on == on && strcmp(t->connector, connector) == 0) return;
    gn_television_set(t->thread, on, connector);
    t->is_set = true;
    t->on = on;
    memcpy(t->connector, connector, sizeof connector);
}

static const void *television_status(void *part) {
    static const char *const wishes[] = {"", "on", "standby"};
    struct television *t = part;
    const struct gn_television_state *state = &t->state;
    if (!t->thread) return NULL;
    t->wanted = wishes[!t->is_set ? GN_TELEVISION_ANY
                       : t->on    ? GN_TELEVISION_ON
                                  : GN_TELEVISION_STANDBY];
    t->told = wishes[state->told];
    t->waits = state->waits[0] ? state->waits : NULL;
    return t;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct television, wanted, "television.wanted", "", "what it is to be"),
    GN_METRIC(struct television, told, "television.told", "", "what it has acknowledged last"),
    GN_METRIC(struct television, state.device, "television.device", "", "the CEC adapter"),
    GN_METRIC(struct television, waits, "television.waits", "", "why it is not what is wanted"),
    GN_METRIC(struct television, state.attempts, "television.attempts", "",
              "how often it was sent to"),
};

const struct gn_part gn_part_television = {
    .name = "television",
    .size = sizeof(struct television),
    .open = open_television,
    .reopen = open_television,
    .step = step_television,
    .status = television_status,
    GN_PART_METRICS(metrics),
    .close = close_television,
};
