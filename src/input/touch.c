#include "input/touch.h"

#include <linux/input-event-codes.h>
#include <math.h>
#include <string.h>

#include "core/clock.h"

static const int64_t TAP_NS = GN_NS_PER_S / 2, STUCK_NS = 30 * GN_NS_PER_S;
static const double SLOP_MM = 3.0;     /* a finger that has moved farther is no tap */
static const double SLOP_SHARE = .015; /* of the panel, where millimetres are unknown */
static const double SLOP_COUNTS = 4.0;
static const double COUNTS_PER_HEIGHT = 1000.0; /* of a mouse, whose resolution is unknown */
static const double LEAST_SPREAD = .01;         /* of the height: nearer fingers do not zoom */

static double range_of(const struct gn_touch_axis *axis) {
    const double range = (double)axis->max - axis->min;
    return range > 0.0 ? range : 0.0;
}

/* Ranges are often the same for both axes, whatever the panel's shape is. */
static double aspect_of(const struct gn_touch_opts *opts) {
    const double x = range_of(&opts->x), y = range_of(&opts->y);
    const bool in_mm = opts->x.per_mm > 0 && opts->y.per_mm > 0;
    double aspect = 16.0 / 9.0;
    if (x <= 0.0 || y <= 0.0) return aspect;
    if (in_mm)
        aspect = x / opts->x.per_mm / (y / opts->y.per_mm);
    else if (opts->x.max != opts->y.max)
        aspect = x / y;
    aspect = fmin(fmax(aspect, .1), 10.0);
    return opts->rotate_deg % 180 ? 1.0 / aspect : aspect;
}

void gn_touch_init(struct gn_touch *t, const struct gn_touch_opts *opts) {
    *t = (struct gn_touch){.opts = *opts, .held_by = -1, .aspect = aspect_of(opts)};
    for (int i = 0; i < GN_TOUCH_SLOTS; i++) t->state.id[i] = -1;
}

void gn_touch_add(struct gn_touch_moves *moves, const struct gn_touch_moves *more) {
    for (int k = 0; k < 2; k++) {
        moves->turn[k] += more->turn[k];
        moves->pan[k] += more->pan[k];
    }
    moves->zoom += more->zoom;
    moves->wheel += more->wheel;
    moves->used |= more->used;
}

/* ---- where fingers are ---- */

static double share_of(const struct gn_touch_axis *axis, int32_t value) {
    const double range = range_of(axis);
    return range > 0.0 ? fmin(fmax(((double)value - axis->min) / range, 0.0), 1.0) : 0.0;
}

/* In shares of the panel from its upper left corner. */
static void place(const struct gn_touch *t, int slot, double *x, double *y) {
    const double u = share_of(&t->opts.x, t->state.x[slot]);
    const double v = share_of(&t->opts.y, t->state.y[slot]);
    switch (t->opts.rotate_deg % 360) {
    case 90: *x = 1.0 - v, *y = u; break;
    case 180: *x = 1.0 - u, *y = 1.0 - v; break;
    case 270: *x = v, *y = 1.0 - u; break;
    default: *x = u, *y = v; break;
    }
}

static struct gn_touch_at look(const struct gn_touch *t) {
    struct gn_touch_at at = {0};
    double x[GN_TOUCH_SLOTS], y[GN_TOUCH_SLOTS];
    if (t->opts.kind == GN_TOUCH_MOUSE) {
        at.count = t->held_by >= 0;
        at.x = t->mouse_x;
        at.y = t->mouse_y;
        return at;
    }
    for (int i = 0; i < GN_TOUCH_SLOTS; i++) {
        if (t->state.id[i] < 0) continue;
        at.id[at.count] = t->state.id[i];
        place(t, i, &x[at.count], &y[at.count]);
        at.x += x[at.count];
        at.y += y[at.count];
        at.count++;
    }
    if (at.count == 0) return at;
    at.x /= at.count;
    at.y /= at.count;
    for (int i = 0; i < at.count; i++)
        at.spread += hypot((x[i] - at.x) * t->aspect, y[i] - at.y) / at.count;
    return at;
}

/* ---- moves ---- */

static bool has_left_its_place(const struct gn_touch *t, const struct gn_touch_at *at) {
    const double x = fabs(at->x - t->begun_x), y = fabs(at->y - t->begun_y);
    if (t->opts.kind == GN_TOUCH_MOUSE) return hypot(x, y) > SLOP_COUNTS;
    const bool turned = t->opts.rotate_deg % 180;
    const struct gn_touch_axis *h = turned ? &t->opts.y : &t->opts.x,
                               *v = turned ? &t->opts.x : &t->opts.y;
    if (h->per_mm <= 0 || v->per_mm <= 0) return x > SLOP_SHARE || y > SLOP_SHARE;
    return hypot(x * range_of(h) / h->per_mm, y * range_of(v) / v->per_mm) > SLOP_MM;
}

static void begin_touch(struct gn_touch *t, const struct gn_touch_at *at, int64_t time_ns) {
    t->begun_x = at->x;
    t->begun_y = at->y;
    t->begun_ns = time_ns;
    t->is_tap = at->count == 1 && t->held_by <= 0;
}

static void move(struct gn_touch *t, const struct gn_touch_at *at) {
    const double unit = t->opts.kind == GN_TOUCH_MOUSE ? 1.0 / COUNTS_PER_HEIGHT : 1.0;
    const bool pans = at->count > 1 || t->held_by > 0;
    float *by = pans ? t->moves.pan : t->moves.turn;
    by[0] += (float)((at->x - t->at.x) * unit);
    by[1] -= (float)((at->y - t->at.y) * unit);
    if (at->count > 1 && at->spread > LEAST_SPREAD && t->at.spread > LEAST_SPREAD)
        t->moves.zoom += (float)log(at->spread / t->at.spread);
    t->moves.used = true;
}

/* A report: what changed since the last one is one moment. Returns true if a tap has ended. */
static bool report(struct gn_touch *t, int64_t time_ns) {
    const struct gn_touch_at at = look(t), was = t->at;
    const bool same =
        at.count == was.count && memcmp(at.id, was.id, (size_t)at.count * sizeof at.id[0]) == 0;
    bool taps = false;
    if (same) {
        if (t->is_tap && at.count > 0) {
            if (!has_left_its_place(t, &at)) return false; /* and not yet a move */
            t->is_tap = false;
        } else if (at.count > 0 && (at.x != was.x || at.y != was.y || at.spread != was.spread))
            move(t, &at);
    } else {
        const bool other = at.count == 1 && was.count == 1; /* lifted and touched at once */
        t->moves.used = true;
        if (at.count == 0 || other) taps = t->is_tap && time_ns - t->begun_ns <= TAP_NS;
        if (was.count == 0 || other)
            begin_touch(t, &at, time_ns);
        else
            t->is_tap = false;
    }
    t->at = at;
    return taps;
}

/* ---- events ---- */

/* The button that began ends it; others are ignored meanwhile. */
static void press_button(struct gn_touch *t, int button, bool down, int64_t time_ns) {
    t->state.buttons[button] = down;
    if (down && t->held_by < 0)
        t->held_by = button;
    else if (!down && t->held_by == button)
        t->held_by = -1;
    else
        return;
    if (t->opts.kind != GN_TOUCH_MOUSE)
        t->state.id[0] = t->held_by < 0 ? -1 : (int32_t)(time_ns / 1000 & INT32_MAX);
}

static void take_finger(struct gn_touch *t, unsigned code, int32_t value) {
    struct gn_touch_state *s = &t->state;
    if (code == ABS_MT_SLOT) s->slot = value;
    if (s->slot < 0 || s->slot >= GN_TOUCH_SLOTS) return; /* more fingers than are followed */
    if (code == ABS_MT_TRACKING_ID) s->id[s->slot] = value < 0 ? -1 : value;
    if (code == ABS_MT_POSITION_X) s->x[s->slot] = value;
    if (code == ABS_MT_POSITION_Y) s->y[s->slot] = value;
}

static int button_of(const struct gn_touch *t, unsigned code) {
    if (t->opts.kind == GN_TOUCH_SCREEN) return code == BTN_TOUCH && !t->opts.has_slots ? 0 : -1;
    return code == BTN_LEFT ? 0 : code == BTN_RIGHT ? 1 : code == BTN_MIDDLE ? 2 : -1;
}

bool gn_touch_event(struct gn_touch *t, unsigned type, unsigned code, int32_t value,
                    int64_t time_ns) {
    const bool is_mouse = t->opts.kind == GN_TOUCH_MOUSE;
    t->last_ns = time_ns;
    if (type == EV_SYN && code == SYN_REPORT) return report(t, time_ns);
    if (type == EV_KEY && button_of(t, code) >= 0)
        press_button(t, button_of(t, code), value != 0, time_ns);
    if (type == EV_ABS && t->opts.has_slots) take_finger(t, code, value);
    if (type == EV_ABS && !t->opts.has_slots && code == ABS_X) t->state.x[0] = value;
    if (type == EV_ABS && !t->opts.has_slots && code == ABS_Y) t->state.y[0] = value;
    if (type == EV_REL && is_mouse && code == REL_X) t->mouse_x += value;
    if (type == EV_REL && is_mouse && code == REL_Y) t->mouse_y += value;
    if (type == EV_REL && t->opts.kind != GN_TOUCH_SCREEN && code == REL_WHEEL) {
        t->moves.wheel += (float)value;
        t->moves.used = true;
    }
    return false;
}

void gn_touch_set(struct gn_touch *t, const struct gn_touch_state *state, int64_t time_ns) {
    t->state = *state;
    t->last_ns = time_ns;
    t->held_by = -1;
    for (int i = GN_TOUCH_BUTTONS; i-- > 0 && !t->opts.has_slots;)
        if (state->buttons[i]) t->held_by = i;
    for (int i = 0; i < GN_TOUCH_SLOTS; i++)
        if (!t->opts.has_slots) t->state.id[i] = i == 0 && t->held_by >= 0 ? 0 : -1;
    t->at = look(t);
    t->is_tap = false;
}

bool gn_touch_is_held(const struct gn_touch *t, int64_t now_ns) {
    return t->at.count > 0 && now_ns - t->last_ns < STUCK_NS;
}
