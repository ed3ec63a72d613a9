#include "kiosk/latency.h"

#include <stdlib.h>

void gn_latency_edge(struct gn_latency *l, int64_t edge_ns) {
    if (l->waiting < GN_LATENCY_WAITING) l->edges_ns[l->waiting++] = edge_ns;
}

void gn_latency_drop(struct gn_latency *l) { l->waiting = 0; }

void gn_latency_frame(struct gn_latency *l, int64_t now_ns, bool shows) {
    l->frames_ns[l->frames++ % GN_LATENCY_FRAMES] = now_ns;
    if (!shows) return;
    const unsigned known = l->frames < GN_LATENCY_FRAMES ? l->frames : GN_LATENCY_FRAMES;
    for (int i = 0; i < l->waiting; i++) {
        struct gn_latency_sample sample = {.ns = now_ns - l->edges_ns[i]};
        for (unsigned j = 0; j < known; j++) sample.frames += l->frames_ns[j] >= l->edges_ns[i];
        l->kept[l->count++ % GN_LATENCY_KEPT] = sample;
        if (sample.ns > l->worst.ns) l->worst.ns = sample.ns;
        if (sample.frames > l->worst.frames) l->worst.frames = sample.frames;
    }
    l->waiting = 0;
}

struct gn_latency_sample gn_latency_last(const struct gn_latency *l) {
    return l->count ? l->kept[(l->count - 1) % GN_LATENCY_KEPT] : (struct gn_latency_sample){0};
}

static int by_size(const void *a, const void *b) {
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return p < q ? -1 : p > q;
}

static int64_t median(int64_t *values, int count) {
    qsort(values, (size_t)count, sizeof *values, by_size);
    return values[(count - 1) / 2];
}

struct gn_latency_report gn_latency_read(const struct gn_latency *l) {
    struct gn_latency_report report = {.count = l->count, .worst = l->worst};
    const int kept = l->count < GN_LATENCY_KEPT ? (int)l->count : GN_LATENCY_KEPT;
    int64_t ns[GN_LATENCY_KEPT], frames[GN_LATENCY_KEPT];
    if (kept == 0) return report;
    for (int i = 0; i < kept; i++) {
        ns[i] = l->kept[i].ns;
        frames[i] = l->kept[i].frames;
    }
    report.median = (struct gn_latency_sample){median(ns, kept), (int)median(frames, kept)};
    return report;
}
