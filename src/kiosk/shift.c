/* [display] pixel_shift: where the picture stands, and when it moves on. */
#include "kiosk/shift.h"

#include "core/clock.h"
#include "kiosk/private.h"

static const int64_t STEP_NS = 60 * GN_NS_PER_S;

/* From 0 to most, to -most and back, by one at a time. */
static int triangle(int64_t at, int most) {
    const int k = (int)(at % (4 * most));
    return k <= most ? k : k <= 3 * most ? 2 * most - k : k - 4 * most;
}

void gn_shift_at(int64_t minute, int most, int out_px[2]) {
    out_px[0] = most > 0 ? triangle(minute, most) : 0;
    out_px[1] = most > 0 ? triangle(minute / (4 * most), most) : 0; /* there and back, then up */
}

static int most_px(const struct gn_show *s) {
    const bool is_window = s->stage.display.ops && s->stage.display.ops->is_window;
    return is_window ? 0 : s->stage.settings->display.pixel_shift_px;
}

static int64_t minute_at(const struct gn_show *s, int64_t now_ns) {
    return (now_ns - s->counts.begun_ns) / STEP_NS;
}

bool gn_show_shifts(const struct gn_show *s) {
    return most_px(s) > 0 && !s->truth.on &&
           minute_at(s, gn_loop_now_ns(s->loop)) != s->shifted_minute;
}

int64_t gn_show_shift_due_ns(const struct gn_show *s) {
    if (most_px(s) == 0) return INT64_MAX;
    return s->counts.begun_ns + (minute_at(s, gn_loop_now_ns(s->loop)) + 1) * STEP_NS;
}

void gn_show_shift(struct gn_show *s) {
    if (s->truth.on) return; /* whose rays would begin anew */
    s->shifted_minute = minute_at(s, gn_loop_now_ns(s->loop));
    gn_shift_at(s->shifted_minute, most_px(s), s->stage.shown.opts.view.shift_px);
}
