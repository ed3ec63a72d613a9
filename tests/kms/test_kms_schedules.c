/* Random schedules: hotplug, VT switches, lost cards, other programs, stalls, random faults, on
 * cards of all kinds. After each, the right picture must be shown within bounded time, and
 * nothing leak.
 *
 *   test_kms_schedules [SEED]     one schedule, with a trace of all calls */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "client.h"
#include "core/clock.h"
#include "image/dice.h"

enum { QUICK = 3000, FULL = 100000, ACTS = 30, BAD_MAX = 20 };
#define WITHIN (45 * SIM_S)

static struct {
    long calls, failed, frames, flips, sets, given_up, bad;
    long acts, waits;
    int64_t slowest_ns;
    int most_fbs, most_blobs, most_buffers;
} total;

/* ---- random numbers ---- */

static struct gn_dice dice;

static uint64_t next(void) { return gn_dice_next(&dice); }

static int below(int n) { return (int)(next() % (uint64_t)n); }
static bool one_in(int n) { return below(n) == 0; }

/* ---- schedules ---- */

static void build(void) {
    const int cards = 1 + one_in(3);
    for (int n = 0; n < cards; n++) {
        const struct sim_traits traits = {.legacy = one_in(4),
                                          .no_vblank = one_in(4),
                                          .modifiers = one_in(2),
                                          .fences = one_in(2),
                                          .console = !one_in(3),
                                          .gpu_alone = n == 1 && one_in(4)};
        char path[32];
        snprintf(path, sizeof path, "/dev/dri/card%d", n);
        sim_add_card(n, path, &traits);
        sim_plug(n, below(SIM_CONNECTORS), below(SIM_MONITORS));
    }
    const struct sim_gpu gpu = {.no_surface = {one_in(3), one_in(3), one_in(5), one_in(2)}};
    sim_set_gpu(&gpu);
    if (one_in(4)) sim_refuse_mode((struct sim_refusal){96, 22, one_in(2)});
}

static void plug_something(void) {
    const int card = below(SIM_CARDS), connector = below(SIM_CONNECTORS);
    sim_plug(card, connector, one_in(3) ? SIM_NO_MONITOR : below(SIM_MONITORS));
}

/* Leaves the console in one of two calls, and enters it in the next. */
static void switch_console(struct client *c) {
    if (c->away)
        client_enter_console(c);
    else if (one_in(2))
        client_leave_console(c);
}

static void move_card(void) {
    const int n = below(SIM_CARDS);
    char path[32];
    snprintf(path, sizeof path, "/dev/dri/card%d", n + 2 * below(3));
    if (one_in(2)) sim_lose_card(n);
    sim_return_card(n, path);
    if (one_in(2)) sim_lose_card(n);
}

static void act(struct client *c) {
    const int n = below(SIM_CARDS);
    switch (below(11)) {
    case 0:
    case 1:
    case 2: plug_something(); break;
    case 3:
    case 4: switch_console(c); break;
    case 5: move_card(); break;
    case 6:
        if (c->away || one_in(4)) sim_stranger_takes(n);
        break;
    case 7:
        for (int i = 0; i < SIM_CARDS; i++) sim_stranger_leaves(i, one_in(2));
        break;
    case 8: sim_stall(n, one_in(2) ? SIM_FLOWS : (enum sim_stall)below(SIM_STALL_COUNT)); break;
    case 9: sim_break_link(n, below(SIM_CONNECTORS)); break;
    case 10: client_blank(c, !c->blank); break;
    }
    c->moves = !one_in(3);
    c->changed = true;
}

static void pause(struct client *c) {
    static const int64_t longest[] = {SIM_MS,       10 * SIM_MS, 40 * SIM_MS,
                                      200 * SIM_MS, 3 * SIM_S,   15 * SIM_S};
    const int64_t most = longest[below(one_in(3) ? 6 : 4)];
    if (most > SIM_S && one_in(2)) c->moves = false;
    client_run(c, (int64_t)(next() % (uint64_t)most) + 1);
}

static void heal(struct client *c) {
    sim_fail_often(0, 0);
    sim_allow_modes();
    for (int n = 0; n < SIM_CARDS; n++) {
        sim_stall(n, SIM_FLOWS);
        sim_stranger_leaves(n, one_in(2));
        sim_return_card(n, NULL);
    }
    sim_plug(0, below(SIM_CONNECTORS), SIM_FULL_HD);
    if (c->away) client_enter_console(c);
    if (c->blank) client_blank(c, false);
}

static void add_up(const struct client *c, int64_t took_ns) {
    total.calls += sim_counts.all_calls;
    total.failed += sim_counts.failed;
    total.flips += sim_counts.flips;
    total.sets += sim_counts.sets;
    total.waits += sim_counts.waits;
    total.frames += c->frames;
    total.given_up += c->restarts;
    if (took_ns > total.slowest_ns) total.slowest_ns = took_ns;
    if (sim_counts.most_fbs > total.most_fbs) total.most_fbs = sim_counts.most_fbs;
    if (sim_counts.most_blobs > total.most_blobs) total.most_blobs = sim_counts.most_blobs;
    if (sim_counts.most_buffers > total.most_buffers) total.most_buffers = sim_counts.most_buffers;
}

static void live(uint64_t seed) {
    struct client c;
    char status[160];
    int64_t took_ns;
    dice.state = seed * UINT64_C(0x2545f4914f6cdd1d) + 1;
    sim_begin();
    build();
    const struct gn_screen_opts opts = {.legacy = one_in(4), .max_fps = one_in(4) ? 20 : 0};
    client_open(&c, &opts);
    if (one_in(2)) sim_fail_often(next(), 20u << below(7));
    for (int i = 0; i < ACTS; i++, total.acts++) {
        act(&c);
        pause(&c);
    }
    heal(&c);
    const bool right = client_settle(&c, WITHIN, &took_ns);
    snprintf(status, sizeof status, "%s", client_screen(&c)->status);
    client_close(&c);
    add_up(&c, took_ns);
    if (!right) sim_complain("wrong picture: %s", status[0] ? status : "no problem reported");
    if (sim_end() == 0) return;
    total.bad++;
    printf("FAIL  seed %" PRIu64 ": %s\n", seed, sim_complaint());
}

int main(int argc, char **argv) {
    const int64_t from_ns = gn_clock_monotonic_ns();
    const uint64_t count = getenv("GN_FULL") ? FULL : QUICK;
    if (argc > 1) {
        sim_trace(true);
        live(strtoull(argv[1], NULL, 10));
        return total.bad > 0;
    }
    for (uint64_t seed = 1; seed <= count && total.bad < BAD_MAX; seed++) live(seed);
    printf("%" PRIu64 " schedules, %ld acts, %ld calls, %ld of them failed by chance, %ld frames, "
           "%ld flips, %ld modesets, %ld of which waited for a flip; at most %d framebuffers, %d "
           "blobs, %d buffers; slowest "
           "recovery %.1f s; gave up %ld times; %ld stuck or leaking; %.1f s\n",
           count, total.acts, total.calls, total.failed, total.frames, total.flips, total.sets,
           total.waits, total.most_fbs, total.most_blobs, total.most_buffers,
           (double)total.slowest_ns / 1e9, total.given_up, total.bad,
           (double)(gn_clock_monotonic_ns() - from_ns) / 1e9);
    return total.bad > 0;
}
