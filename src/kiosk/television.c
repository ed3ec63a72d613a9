/* [schedule] off = cec: a television that goes into standby and comes back with the screen. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "kiosk/private.h"

static void take_state(void *user, uint32_t events, int64_t now_ns) {
    struct gn_show *s = user;
    struct gn_show_television *t = &s->television;
    (void)events;
    (void)now_ns;
    gn_television_read(t->told, &t->state);
    if (t->state.problem[0])
        gn_problem_report(&s->problems, GN_PROBLEM_TELEVISION, t->state.problem);
    else
        gn_problem_cure(&s->problems, GN_PROBLEM_TELEVISION);
}

void gn_show_close_television(struct gn_show *s) {
    struct gn_show_television *t = &s->television;
    gn_loop_remove(&t->watch);
    gn_television_close(t->told);
    gn_problem_cure(&s->problems, GN_PROBLEM_TELEVISION);
    *t = (struct gn_show_television){.watch.fd = -1};
}

void gn_show_open_television(struct gn_show *s) {
    const struct gn_schedule_settings *o = &s->config.options->settings->schedule;
    const struct gn_television_opts opts = {.cec.device = o->cec_device};
    struct gn_show_television *t = &s->television;
    struct gn_err err = {0};
    const char *device = o->cec_device ? o->cec_device : "";
    const bool is_wanted = o->off & GN_OFF_CEC;
    if (is_wanted && t->told && strcmp(t->device, device) == 0) return; /* it knows already */
    gn_show_close_television(s);
    if (!is_wanted) return;
    t->told = gn_television_open(&opts, &err);
    if (!t->told) {
        gn_problem_report(&s->problems, GN_PROBLEM_TELEVISION, err.text);
        return;
    }
    snprintf(t->device, sizeof t->device, "%s", device);
    t->watch = (struct gn_watch){
        .fd = gn_television_fd(t->told), .events = EPOLLIN, .call = take_state, .user = s};
    if (gn_loop_add(s->loop, &t->watch)) return;
    gn_fail(&err, "cannot wait for the television: %s", strerror(errno));
    gn_show_close_television(s);
    gn_problem_report(&s->problems, GN_PROBLEM_TELEVISION, err.text);
}

/* The one that is configured, else the one in use: of "HDMI-A-1 1920x1080@60.00 atomic". False: it
 * is not known yet. */
static bool find_connector(const struct gn_show *s, char *out, size_t size) {
    const struct gn_screen *screen = &s->stage.display.screen;
    const char *named = s->stage.settings->display.connector;
    if (!named && s->stage.display.ops->is_console)
        snprintf(out, size, "%.*s", (int)strcspn(screen->what, " "), screen->what);
    else
        snprintf(out, size, "%s", named ? named : "");
    return named || !s->stage.display.ops->is_console || screen->what[0] || screen->status[0];
}

void gn_show_step_television(struct gn_show *s) {
    struct gn_show_television *t = &s->television;
    const bool on = !gn_kiosk_is_dark(&s->kiosk);
    char connector[sizeof t->connector];
    if (!t->told || !find_connector(s, connector, sizeof connector)) return;
    if (t->is_set && t->on == on && strcmp(t->connector, connector) == 0) return;
    gn_television_set(t->told, on, connector);
    t->is_set = true;
    t->on = on;
    memcpy(t->connector, connector, sizeof connector);
}
