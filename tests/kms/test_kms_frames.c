/* Many frames on virtual time: no memory growth, no allocation, no missed refresh. */
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>

#include "client.h"
#include "core/arena.h"
#include "core/clock.h"

enum { QUICK = 20000, FULL = 1000000, MOST_GROWTH = 64 * 1024 };

struct kind {
    const char *name;
    struct sim_traits traits;
    struct gn_screen_opts opts;
    struct sim_gpu gpu;
};
static const struct kind kinds[] = {
    {.name = "atomic, fences", .traits = {.console = true, .modifiers = true, .fences = true}},
    {.name = "legacy", .traits = {.console = true, .legacy = true}},
    {.name = "no vblank", .traits = {.no_vblank = true}},
    {.name = "copies", .gpu = {.no_surface = {true, true, true}}},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static size_t bytes_in_use(void) {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/* Returns 0, or 1 after printing the failure. */
static int check(const struct kind *kind, long frames, size_t grown, unsigned long allocations,
                 const struct gn_screen_counts *counts) {
    const char *wrong = sim_complaint();
    if (!wrong[0] && grown > MOST_GROWTH) wrong = "memory grows";
    if (!wrong[0] && allocations > 0) wrong = "allocations in the frame loop";
    if (!wrong[0] && counts->missed > 0) wrong = "refreshes are missed";
    if (!wrong[0] && counts->shown < (uint64_t)frames) wrong = "not all frames are shown";
    if (wrong[0]) printf("FAIL  %s: %s\n", kind->name, wrong);
    return wrong[0] != 0;
}

static int run(const struct kind *kind, long frames) {
    const int64_t from_ns = gn_clock_monotonic_ns();
    struct client c;
    int64_t took_ns;
    sim_begin();
    sim_set_gpu(&kind->gpu);
    sim_add_card(0, "/dev/dri/card0", &kind->traits);
    sim_plug(0, 0, SIM_FULL_HD);
    client_open(&c, &kind->opts);
    client_frames(&c, 200);
    const size_t bytes = bytes_in_use();
    const unsigned long allocations = gn_alloc_count();
    const uint64_t shown = client_screen(&c)->counts.shown;
    const int64_t virtual_ns = sim_now();
    while (c.frames < frames + 200 && !sim_complaint()[0]) {
        const long before = c.frames;
        client_frames(&c, 200);
        if (c.frames == before) sim_complain("no frame in five seconds");
    }
    const size_t now = bytes_in_use(), grown = now > bytes ? now - bytes : 0;
    const double seconds = (double)(sim_now() - virtual_ns) / 1e9;
    const unsigned long asked = gn_alloc_count() - allocations;
    if (!client_settle(&c, 5 * SIM_S, &took_ns)) sim_complain("wrong picture at the end");
    struct gn_screen_counts counts = client_screen(&c)->counts;
    counts.shown -= shown;
    const long calls = sim_counts.all_calls;
    client_close(&c);
    const int left = sim_end();
    printf("%s: %ld frames, %.0f s of virtual time, %ld calls, grown by %zu bytes, %lu "
           "allocations, %llu refreshes missed, %d left over; %.1f s\n",
           kind->name, c.frames, seconds, calls, grown, asked, (unsigned long long)counts.missed,
           left, (double)(gn_clock_monotonic_ns() - from_ns) / 1e9);
    return check(kind, frames, grown, asked, &counts);
}

int main(void) {
    const long frames = getenv("GN_FULL") ? FULL : QUICK;
    int bad = 0;
    for (int i = 0; i < KINDS; i++) bad += run(&kinds[i], i == 0 ? frames : frames / 4);
    return bad > 0;
}
