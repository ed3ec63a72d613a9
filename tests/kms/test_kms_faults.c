/* Fault injection: every call of every scenario fails, with each errno it can return, once and
 * three times in a row; and between every two calls a card or monitor disappears, the monitor
 * changes, another process becomes master, or the link goes bad. The right picture must be shown
 * at the end, within bounded time, and nothing leak.
 *
 *   test_kms_faults SCENE                          one scenario, by number, with details
 *   test_kms_faults SCENE plain                    its calls
 *   test_kms_faults SCENE OP NTH ERRNO [TIMES]     with that fault: drmModeRmFB 3 22
 *   test_kms_faults SCENE INCIDENT CALL            with that incident, both by number */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "scenes.h"

enum { BAD_MAX = 20 }; /* failures after which no more scenarios run */

struct fault {
    enum sim_op op;
    long nth;
    int burst, error;
    enum sim_incident incident;
    long at; /* of the incident; 0: a call fails */
};
static struct {
    long runs, failed_calls, calls, frames, incidents, pairs, given_up, bad;
    int64_t slowest_ns[2]; /* after one fault, and after three */
} total;

static void prepare(void *context) {
    const struct fault *f = context;
    if (f->at > 0)
        sim_happen(f->incident, f->at);
    else
        sim_fail(f->op, f->nth, f->burst, f->error);
}

/* The text before the colon is the arguments that reproduce the failure. */
static void tell(const struct scene *scene, const struct fault *f, const char *complaint) {
    const int number = (int)(scene - scenes);
    total.bad++;
    if (f && f->at > 0)
        printf("FAIL  %d %d %ld: %s; %s: %s\n", number, f->incident, f->at, scene->name,
               sim_incident_name(f->incident), complaint);
    else if (f)
        printf("FAIL  %d %s %ld %d %d: %s; %s: %s\n", number, sim_op_name(f->op), f->nth, f->error,
               f->burst, scene->name, strerrorname_np(f->error), complaint);
    else
        printf("FAIL  %d plain: %s: %s\n", number, scene->name, complaint);
}

static void run(const struct scene *scene, struct fault *f) {
    if (total.bad >= BAD_MAX) return;
    const struct ending e = scene_run(scene, f ? prepare : NULL, f);
    total.runs++;
    total.calls += e.calls;
    total.frames += e.frames;
    total.failed_calls += sim_counts.failed;
    int64_t *slowest_ns = &total.slowest_ns[f && f->burst > 1];
    if (e.took_ns > *slowest_ns && !scene->may_give_up) *slowest_ns = e.took_ns;
    total.given_up += e.gave_up;
    const bool may_give_up = scene->may_give_up || (f && f->burst > 1);
    if (e.gave_up && !may_give_up && !e.complaint[0]) tell(scene, f, "gave up");
    if (e.complaint[0]) tell(scene, f, e.complaint);
}

static void fail_all(const struct scene *scene, const struct sim_counts *counts, long stride) {
    for (int op = 0; op < SIM_OPS; op++)
        for (const int *error = sim_op_errors(op); *error; error++) {
            total.pairs += counts->calls[op] > 0;
            if (op == SIM_SetClientCap && scene->needs_atomic) continue;
            for (long nth = 1; nth <= counts->calls[op]; nth += nth < 8 ? 1 : stride)
                for (int burst = 1; burst <= 3; burst += 2) {
                    struct fault f = {.op = op, .nth = nth, .burst = burst, .error = *error};
                    run(scene, &f);
                }
        }
}

static void happen_all(const struct scene *scene, const struct sim_counts *counts, long stride) {
    for (int what = 0; what < SIM_INCIDENTS; what++)
        for (long at = 1; at <= counts->all_calls; at += stride) {
            struct fault f = {.incident = what, .at = at};
            run(scene, &f);
            total.incidents++;
        }
}

static void run_scene(const struct scene *scene, bool full) {
    run(scene, NULL);
    const struct sim_counts counts = sim_counts;
    fail_all(scene, &counts, full ? 1 : 29);
    happen_all(scene, &counts, full ? 1 : 11);
}

static enum sim_op op_of(const char *name) {
    for (int op = 0; op < SIM_OPS; op++)
        if (strcmp(sim_op_name(op), name) == 0) return op;
    printf("unknown operation %s\n", name);
    exit(2);
}

static int run_one(int argc, char **argv) {
    const struct scene *scene = &scenes[atoi(argv[1]) % scene_count];
    struct fault f = {.burst = 1};
    if (argc == 3 && strcmp(argv[2], "plain") != 0) return 2;
    if (argc == 2) {
        run_scene(scene, true);
        return total.bad > 0;
    }
    sim_trace(true);
    if (argc == 4) f.incident = atoi(argv[2]), f.at = atol(argv[3]);
    if (argc >= 5) f.op = op_of(argv[2]), f.nth = atol(argv[3]), f.error = atoi(argv[4]);
    if (argc >= 6) f.burst = atoi(argv[5]);
    run(scene, argc > 3 ? &f : NULL);
    return total.bad > 0;
}

int main(int argc, char **argv) {
    const bool full = getenv("GN_FULL");
    const int64_t from_ns = gn_clock_monotonic_ns();
    if (argc > 1) return run_one(argc, argv);
    for (int i = 0; i < scene_count; i++) run_scene(&scenes[i], full);
    printf("%d scenes, %ld pairs of call and errno, %ld runs, %ld calls, %ld of them made to fail, "
           "%ld incidents, %ld frames; "
           "slowest recovery %.1f s, after three faults %.1f s; gave up %ld times; %ld leaks, "
           "stuck or wrong; %.1f s\n",
           scene_count, total.pairs, total.runs, total.calls, total.failed_calls, total.incidents,
           total.frames, (double)total.slowest_ns[0] / 1e9, (double)total.slowest_ns[1] / 1e9,
           total.given_up, total.bad, (double)(gn_clock_monotonic_ns() - from_ns) / 1e9);
    return total.bad > 0;
}
