/* [display] pixel_shift: where the picture stands, and when it moves on. */
#include "kiosk/shift.h"

#include "core/clock.h"
#include "kiosk/part.h"

static const int64_t STEP_NS = 60 * GN_NS_PER_S;

struct shift {
    const struct gn_part_host *host;
    int64_t minute; /* of the last frame */
};

/* From 0 to most, to -most and back, by one at a time. */
static int triangle(int64_t at, int most) {
    const int k = (int)(at % (4 * most));
    return k <= most ? k : k <= 3 * most ? 2 * most - k : k - 4 * most;
}

void gn_shift_at(int64_t minute, int most, int out_px[2]) {
    out_px[0] = most > 0 ? triangle(minute, most) : 0;
    out_px[1] = most > 0 ? triangle(minute / (4 * most), most) : 0; /* there and back, then up */
}

static int most_px(const struct gn_part_host *h) {
    const bool is_window = h->display->ops && h->display->ops->is_window;
    return is_window ? 0 : (*h->settings)->display.pixel_shift_px;
}

static int64_t minute_now(const struct gn_part_host *h) {
    return (gn_loop_now_ns(h->loop) - h->counts->begun_ns) / STEP_NS;
}

static bool shift_wants_frame(const void *part) {
    const struct shift *s = part;
    return most_px(s->host) > 0 && !*s->host->still && minute_now(s->host) != s->minute;
}

static int64_t shift_due_ns(const void *part) {
    const struct gn_part_host *h = ((const struct shift *)part)->host;
    if (most_px(h) == 0) return INT64_MAX;
    return h->counts->begun_ns + (minute_now(h) + 1) * STEP_NS;
}

static void shift_frame(void *part, struct gn_frame_opts *opts) {
    struct shift *s = part;
    if (*s->host->still) return;
    s->minute = minute_now(s->host);
    gn_shift_at(s->minute, most_px(s->host), opts->view.shift_px);
}

const struct gn_part gn_part_shift = {
    .name = "shift",
    .size = sizeof(struct shift),
    .wants_frame = shift_wants_frame,
    .due_ns = shift_due_ns,
    .add_frame = shift_frame,
};
