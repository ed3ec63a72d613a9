#include "kiosk/turntable.h"

void gn_turntable_use(struct gn_turntable *t, int64_t now_ns) { t->used_ns = now_ns; }

bool gn_turntable_rests(const struct gn_turntable *t, int64_t rest_ns, int64_t now_ns) {
    return t->used_ns != 0 && now_ns - t->used_ns < rest_ns;
}

/* No frame may have been drawn while it rested: of the time since the last one it stood for the
 * part before its end. */
int64_t gn_turntable_step(struct gn_turntable *t, int64_t rest_ns, int64_t seen_ns,
                          int64_t scene_ns) {
    const int64_t passed_ns = seen_ns - t->seen_ns, end_ns = t->used_ns + rest_ns;
    double share = 0.0;
    if (t->used_ns != 0 && rest_ns > 0 && t->seen_ns != 0 && end_ns > t->seen_ns && passed_ns > 0)
        share = end_ns >= seen_ns ? 1.0 : (double)(end_ns - t->seen_ns) / (double)passed_ns;
    t->rested_ns += (int64_t)(share * (double)(scene_ns - t->scene_ns));
    if (t->off) t->rested_ns = scene_ns;
    t->seen_ns = seen_ns;
    t->scene_ns = scene_ns;
    return t->rested_ns;
}

int64_t gn_turntable_due_ns(const struct gn_turntable *t, int64_t rest_ns, int64_t now_ns) {
    return gn_turntable_rests(t, rest_ns, now_ns) ? t->used_ns + rest_ns : INT64_MAX;
}
