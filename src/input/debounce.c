#include "input/debounce.h"

void gn_debounce_init(struct gn_debounce *d, int64_t stable_ns, bool level) {
    *d = (struct gn_debounce){.stable_ns = stable_ns, .settled = level, .raw = level};
}

void gn_debounce_edge(struct gn_debounce *d, bool level, int64_t time_ns) {
    if (!d->moving) d->first_ns = time_ns;
    d->moving = true;
    d->last_ns = time_ns;
    d->raw = level;
}

void gn_debounce_level(struct gn_debounce *d, bool level, int64_t time_ns) {
    if (level != d->raw) gn_debounce_edge(d, level, time_ns);
}

int64_t gn_debounce_deadline(const struct gn_debounce *d) {
    return d->moving ? d->last_ns + d->stable_ns : INT64_MAX;
}

bool gn_debounce_step(struct gn_debounce *d, int64_t now_ns, struct gn_debounced *out) {
    const int64_t deadline_ns = gn_debounce_deadline(d);
    if (now_ns < deadline_ns) return false;
    d->moving = false;
    if (d->raw == d->settled) return false;
    d->settled = d->raw;
    *out = (struct gn_debounced){.level = d->raw, .first_ns = d->first_ns, .time_ns = deadline_ns};
    return true;
}
