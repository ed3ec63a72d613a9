/* What the board suffers from: a problem while it lasts, a line in the journal when it begins and
 * when it ends. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "kiosk/private.h"

static const enum gn_problem problems[GN_HEALTH_COUNT] = {
    [GN_HEALTH_VOLTAGE] = GN_PROBLEM_VOLTAGE,
    [GN_HEALTH_THROTTLED] = GN_PROBLEM_THROTTLED,
    [GN_HEALTH_CMA] = GN_PROBLEM_CMA,
};

/* Its numbers change with each reading: the problem keeps those of its beginning. */
static void tell_ailment(struct gn_show *s, enum gn_health_kind kind, bool lasted) {
    const struct gn_ailment *a = &s->health.log.of[kind];
    char text[512];
    if (a->lasts == lasted) return;
    if (a->lasts) {
        snprintf(text, sizeof text, "%s; %s", a->text, gn_health_cures[kind]);
        gn_problem_report(&s->problems, problems[kind], text);
    } else {
        gn_problem_cure(&s->problems, problems[kind]);
        fprintf(stderr, "gnomon: no more: %s\n", gn_health_names[kind]);
    }
}

static void take_health(void *user, uint32_t events, int64_t now_ns) {
    struct gn_show *s = user;
    struct gn_show_health *h = &s->health;
    struct gn_health reading;
    bool lasted[GN_HEALTH_COUNT];
    (void)events;
    (void)now_ns;
    gn_sensor_read(h->sensor, &reading);
    for (int i = 0; i < GN_HEALTH_COUNT; i++) lasted[i] = h->log.of[i].lasts;
    gn_health_take(&h->log, &reading);
    for (int i = 0; i < GN_HEALTH_COUNT; i++) tell_ailment(s, (enum gn_health_kind)i, lasted[i]);
    gn_health_summarise(&h->log, h->summary, sizeof h->summary);
}

void gn_show_close_health(struct gn_show *s) {
    gn_loop_remove(&s->health.watch);
    gn_sensor_close(s->health.sensor);
    s->health = (struct gn_show_health){.watch.fd = -1};
}

void gn_show_open_health(struct gn_show *s, const char *root, int64_t interval_ns) {
    struct gn_show_health *h = &s->health;
    struct gn_err err = {0};
    gn_show_close_health(s);
    h->sensor = gn_sensor_open(root, interval_ns, &err);
    if (h->sensor) {
        h->watch = (struct gn_watch){
            .fd = gn_sensor_fd(h->sensor), .events = EPOLLIN, .call = take_health, .user = s};
        if (gn_loop_add(s->loop, &h->watch)) return;
        gn_fail(&err, "cannot wait for the board's health: %s", strerror(errno));
        gn_show_close_health(s);
    }
    gn_problem_report(&s->problems, GN_PROBLEM_START, err.text);
}
