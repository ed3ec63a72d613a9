#include "kiosk/sensor.h"

#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/thread.h"

struct gn_sensor { /* shared with the thread; the last one to leave frees it */
    char root[PATH_MAX];
    int64_t interval_ns;
    int event;
    pthread_mutex_t mutex; /* of all that follows */
    pthread_cond_t changed;
    bool closed;
    int users;
    struct gn_health last;
};

/* With the mutex locked, which it unlocks. */
static void leave_sensor(struct gn_sensor *s) {
    const bool is_last = --s->users == 0;
    pthread_mutex_unlock(&s->mutex);
    if (!is_last) return;
    pthread_cond_destroy(&s->changed);
    pthread_mutex_destroy(&s->mutex);
    free(s);
}

static void *run_sensor(void *argument) {
    static const uint64_t one = 1;
    struct gn_sensor *s = argument;
    gn_thread_lower_priority();
    pthread_mutex_lock(&s->mutex);
    while (!s->closed) {
        struct gn_health health;
        pthread_mutex_unlock(&s->mutex);
        gn_health_read(&health, s->root);
        pthread_mutex_lock(&s->mutex);
        s->last = health;
        if (!s->closed && write(s->event, &one, sizeof one) < 0) {
        }
        const int64_t due_ns = gn_clock_monotonic_ns() + s->interval_ns;
        const struct timespec due = {due_ns / GN_NS_PER_S, due_ns % GN_NS_PER_S};
        while (!s->closed && pthread_cond_timedwait(&s->changed, &s->mutex, &due) == 0) {
        }
    }
    leave_sensor(s);
    return NULL;
}

static void init_sensor_locks(struct gn_sensor *s) {
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&s->changed, &attributes);
    pthread_condattr_destroy(&attributes);
    pthread_mutex_init(&s->mutex, NULL);
}

struct gn_sensor *gn_sensor_open(const char *root, int64_t interval_ns, struct gn_err *err) {
    struct gn_sensor *s = gn_xalloc(1, sizeof *s);
    snprintf(s->root, sizeof s->root, "%s", root);
    s->interval_ns = interval_ns;
    s->users = 2;
    init_sensor_locks(s);
    s->event = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    const int error = s->event < 0 ? errno : gn_thread_start_detached(run_sensor, s);
    if (error == 0) return s;
    gn_fail(err, "cannot watch the board's health: %s", strerror(error));
    if (s->event >= 0) close(s->event);
    pthread_mutex_lock(&s->mutex);
    s->users = 1;
    leave_sensor(s);
    return NULL;
}

int gn_sensor_fd(const struct gn_sensor *s) { return s->event; }

void gn_sensor_read(struct gn_sensor *s, struct gn_health *health) {
    uint64_t count;
    if (read(s->event, &count, sizeof count) < 0) {
    }
    pthread_mutex_lock(&s->mutex);
    *health = s->last;
    pthread_mutex_unlock(&s->mutex);
}

void gn_sensor_close(struct gn_sensor *s) {
    if (!s) return;
    pthread_mutex_lock(&s->mutex);
    s->closed = true;
    close(s->event);
    pthread_cond_signal(&s->changed);
    leave_sensor(s);
}
