#include "display/television.h"

#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/worker.h"

enum { UNPLUGGED_S = 5, STARTS_S = 2, GIVEN_UP_S = 60, STARTS_MAX = 10 };

struct gn_television {
    struct gn_worker worker;
    struct gn_cec_opts cec; /* the thread's, with its two texts */
    char device[256], connector[64];
    int64_t second_ns;
    char wanted_connector[64]; /* from here on under the worker's mutex */
    struct gn_television_state state;
    int64_t due_ns; /* of the next attempt; INT64_MAX: none */
    int tries;  /* attempts since another state was wanted, without those that found no television,
                 */
    int starts; /* and those in a row in which it reported that it is starting */
};

int gn_television_pause_s(enum gn_cec_result result, bool on, int tries) {
    if (result == GN_CEC_TOLD) return -1;
    if (result == GN_CEC_UNPLUGGED) return UNPLUGGED_S;
    if (result == GN_CEC_STARTS) return tries < STARTS_MAX ? STARTS_S : -1;
    if (tries < GN_TELEVISION_TRIES) return 1 << (tries > 0 ? tries - 1 : 0);
    return on || result == GN_CEC_NO_ADAPTER ? GIVEN_UP_S : -1;
}

static void take_report(struct gn_television *t, bool on, const struct gn_cec_report *r) {
    struct gn_television_state *s = &t->state;
    const bool is_told = r->result == GN_CEC_TOLD || r->result == GN_CEC_STARTS;
    const enum gn_television_wish did = on ? GN_TELEVISION_ON : GN_TELEVISION_STANDBY;
    const bool moved = strcmp(t->connector, t->wanted_connector) != 0; /* meanwhile, */
    s->attempts++;
    s->told = is_told && !moved ? did : GN_TELEVISION_ANY;
    snprintf(s->device, sizeof s->device, "%s", r->adapter.path);
    if (is_told) s->problem[0] = '\0';
    if (s->wanted != did || moved) return; /* or something else is wanted: that is due at once */
    snprintf(s->waits, sizeof s->waits, "%s", is_told ? "" : r->why);
    if (r->result == GN_CEC_UNPLUGGED) {
        t->tries = 0;
        s->problem[0] = '\0';
    } else if (is_told)
        t->tries = 0;
    else if (++t->tries >= GN_TELEVISION_TRIES)
        memcpy(s->problem, s->waits, sizeof s->problem);
    t->starts = r->result == GN_CEC_STARTS ? t->starts + 1 : 0;
    const int pause_s = gn_television_pause_s(r->result, on, t->starts > 0 ? t->starts : t->tries);
    t->due_ns = pause_s < 0 ? INT64_MAX : gn_clock_monotonic_ns() + pause_s * t->second_ns;
}

static void attempt(struct gn_television *t) {
    const bool on = t->state.wanted == GN_TELEVISION_ON;
    struct gn_cec_report report;
    t->due_ns = INT64_MAX;
    t->state.told = GN_TELEVISION_ANY; /* a message may have come through, whatever becomes of it */
    memcpy(t->connector, t->wanted_connector, sizeof t->connector);
    pthread_mutex_unlock(&t->worker.mutex);
    gn_cec_tell(&t->cec, on, &report);
    pthread_mutex_lock(&t->worker.mutex);
    take_report(t, on, &report);
    gn_worker_tell(&t->worker);
}

static void *run_thread(void *argument) {
    struct gn_television *t = argument;
    gn_worker_begin(&t->worker);
    while (!t->worker.closed) {
        if (t->due_ns <= gn_clock_monotonic_ns())
            attempt(t);
        else
            gn_worker_wait(&t->worker, t->due_ns);
    }
    gn_worker_leave(&t->worker);
    return NULL;
}

struct gn_television *gn_television_open(const struct gn_television_opts *opts,
                                         struct gn_err *err) {
    struct gn_television *t = gn_xalloc(1, sizeof *t);
    t->cec = opts->cec;
    t->cec.connector = t->connector;
    if (opts->cec.device) {
        snprintf(t->device, sizeof t->device, "%s", opts->cec.device);
        t->cec.device = t->device;
    }
    t->second_ns = opts->second_ns > 0 ? opts->second_ns : GN_NS_PER_S;
    t->due_ns = INT64_MAX;
    const int error = gn_worker_start(&t->worker, run_thread);
    if (error == 0) return t;
    gn_fail(err, "cannot tell the television anything: %s", strerror(error));
    return NULL;
}

void gn_television_set(struct gn_television *t, bool on, const char *connector) {
    const enum gn_television_wish wish = on ? GN_TELEVISION_ON : GN_TELEVISION_STANDBY;
    pthread_mutex_lock(&t->worker.mutex);
    const bool moves = connector && connector[0] && strcmp(t->wanted_connector, connector) != 0;
    if (moves) {
        snprintf(t->wanted_connector, sizeof t->wanted_connector, "%s", connector);
        t->state.told = GN_TELEVISION_ANY; /* by another adapter, perhaps */
    }
    if (t->state.wanted != wish || moves) {
        t->state.wanted = wish;
        t->state.waits[0] = '\0';
        t->tries = t->starts = 0;
        t->due_ns = t->state.told == wish ? INT64_MAX : 0; /* back before the thread saw it */
        pthread_cond_signal(&t->worker.changed);
    }
    pthread_mutex_unlock(&t->worker.mutex);
}

int gn_television_fd(const struct gn_television *t) { return t->worker.event; }

void gn_television_read(struct gn_television *t, struct gn_television_state *state) {
    gn_worker_hear(&t->worker);
    *state = t->state;
    pthread_mutex_unlock(&t->worker.mutex);
}

void gn_television_close(struct gn_television *t) {
    if (t) gn_worker_close(&t->worker);
}
