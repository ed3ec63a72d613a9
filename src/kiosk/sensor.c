#include "kiosk/sensor.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/worker.h"

struct gn_sensor {
    struct gn_worker worker;
    char root[PATH_MAX];
    int64_t interval_ns;
    struct gn_health last;
};

static void *run_sensor(void *argument) {
    struct gn_sensor *s = argument;
    struct gn_worker *w = &s->worker;
    gn_worker_begin(w);
    while (!w->closed) {
        struct gn_health health;
        pthread_mutex_unlock(&w->mutex);
        gn_health_read(&health, s->root);
        pthread_mutex_lock(&w->mutex);
        s->last = health;
        gn_worker_tell(w);
        const int64_t due_ns = gn_clock_monotonic_ns() + s->interval_ns;
        while (!w->closed && gn_clock_monotonic_ns() < due_ns) gn_worker_wait(w, due_ns);
    }
    gn_worker_leave(w);
    return NULL;
}

struct gn_sensor *gn_sensor_open(const char *root, int64_t interval_ns, struct gn_err *err) {
    struct gn_sensor *s = gn_xalloc(1, sizeof *s);
    snprintf(s->root, sizeof s->root, "%s", root);
    s->interval_ns = interval_ns;
    const int error = gn_worker_start(&s->worker, run_sensor);
    if (error == 0) return s;
    gn_fail(err, "cannot watch the board's health: %s", strerror(error));
    return NULL;
}

int gn_sensor_fd(const struct gn_sensor *s) { return s->worker.event; }

void gn_sensor_read(struct gn_sensor *s, struct gn_health *health) {
    gn_worker_hear(&s->worker);
    *health = s->last;
    pthread_mutex_unlock(&s->worker.mutex);
}

void gn_sensor_close(struct gn_sensor *s) {
    if (s) gn_worker_close(&s->worker);
}
