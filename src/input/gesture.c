/* Holds, doubles and chords are measured between debounced edges, one debounce interval behind the
 * wire; an event carries the time of its first edge. Edges and timers
 * of all buttons are processed in that order, however often step is called. A timer precedes an
 * edge at the same time: held for exactly hold_ns is a hold. */
#include "input/gesture.h"

#include <assert.h>
#include <string.h>

#define MS    INT64_C(1000000)
#define NEVER INT64_MAX

const char *const gn_gesture_names[GN_GESTURE_COUNT] = {
    [GN_GESTURE_PRESS] = "press", [GN_GESTURE_CLICK] = "click",   [GN_GESTURE_DOUBLE] = "double",
    [GN_GESTURE_HOLD] = "hold",   [GN_GESTURE_REPEAT] = "repeat", [GN_GESTURE_CHORD] = "chord",
};

/* ---- output -------------------------------------------------------------------------------- */

static void set_note(struct gn_gestures *g, int i, enum gn_gesture_note_kind kind) {
    if (g->note_end - g->note_begin < GN_GESTURE_NOTES)
        g->notes[g->note_end++ % GN_GESTURE_NOTES] =
            (struct gn_gesture_note){.button = i, .kind = kind};
}

static void emit_gesture(struct gn_gestures *g, int i, enum gn_gesture gesture, int64_t time_ns) {
    struct gn_gesture_button *b = &g->buttons[i];
    if (!(b->opts.gestures & 1u << gesture)) return;
    /* rate limit: at most GN_GESTURE_RATE gestures in a second */
    int64_t *oldest = &b->recent_ns[b->recent % GN_GESTURE_RATE];
    if (b->recent >= GN_GESTURE_RATE && g->now_ns - *oldest < 1000 * MS) {
        if (!b->fast) set_note(g, i, GN_NOTE_FAST);
        b->fast = true;
        return;
    }
    const unsigned last = (b->recent - 1) % GN_GESTURE_RATE;
    if (b->recent && g->now_ns - b->recent_ns[last] >= 1000 * MS) b->fast = false;
    *oldest = g->now_ns;
    b->recent++;
    if (g->queue_end - g->queue_begin == GN_GESTURE_QUEUE) {
        g->dropped++;
        return;
    }
    g->queue[g->queue_end++ % GN_GESTURE_QUEUE] =
        (struct gn_gesture_event){.button = i, .gesture = gesture, .time_ns = time_ns};
}

bool gn_gestures_next(struct gn_gestures *g, struct gn_gesture_event *out) {
    if (g->queue_begin == g->queue_end) return false;
    *out = g->queue[g->queue_begin++ % GN_GESTURE_QUEUE];
    return true;
}

bool gn_gestures_note(struct gn_gestures *g, struct gn_gesture_note *out) {
    if (g->note_begin == g->note_end) return false;
    *out = g->notes[g->note_begin++ % GN_GESTURE_NOTES];
    return true;
}

/* ---- one button ---------------------------------------------------------------------------- */

static bool binds_gesture(const struct gn_gesture_button *b, unsigned gestures) {
    return b->opts.gestures & gestures;
}

/* A click may still wait for a second one; noise is the line's. */
static void clear_press_due(struct gn_gesture_button *b) {
    for (int due = GN_DUE_CHORD; due <= GN_DUE_STUCK; due++)
        if (due != GN_DUE_CLICK) b->due_ns[due] = NEVER;
}

/* Starts the button's own press, after waiting for a chord if it is in one. */
static void begin_press(struct gn_gestures *g, int i) {
    struct gn_gesture_button *b = &g->buttons[i];
    b->state = GN_BUTTON_DOWN;
    b->due_ns[GN_DUE_CHORD] = NEVER;
    emit_gesture(g, i, GN_GESTURE_PRESS, b->down_first_ns);
    b->acted = b->second;
    b->second = false;
    if (b->acted) {
        emit_gesture(g, i, GN_GESTURE_DOUBLE, b->down_first_ns);
        return;
    }
    if (binds_gesture(b, 1u << GN_GESTURE_HOLD))
        b->due_ns[GN_DUE_HOLD] = b->down_ns + b->opts.hold_ns;
    if (binds_gesture(b, 1u << GN_GESTURE_REPEAT))
        b->due_ns[GN_DUE_REPEAT] = b->down_ns + b->opts.hold_ns;
}

/* The press became another gesture: reports the click before it. */
static void click_before(struct gn_gestures *g, int i) {
    struct gn_gesture_button *b = &g->buttons[i];
    if (b->second) emit_gesture(g, i, GN_GESTURE_CLICK, b->click_ns);
    b->second = false;
}

static void mute_button(struct gn_gesture_button *b) {
    clear_press_due(b);
    b->state = GN_BUTTON_MUTED;
}

/* ---- chords -------------------------------------------------------------------------------- */

static uint32_t waiting_buttons(const struct gn_gestures *g) {
    uint32_t set = 0;
    for (int i = 0; i < g->count; i++)
        if (g->buttons[i].state == GN_BUTTON_WAITING) set |= UINT32_C(1) << i;
    return set;
}

/* The complete chord with most buttons that contains this one; -1: none. */
static int find_complete(const struct gn_gestures *g, int with, uint32_t set) {
    int best = -1;
    for (int i = 0; i < g->count; i++) {
        const uint32_t chord = g->buttons[i].opts.chord;
        int64_t oldest_ns = NEVER, newest_ns = INT64_MIN;
        if (!(chord >> with & 1) || chord & ~set) continue;
        for (int k = 0; k < g->count; k++) {
            if (!(chord >> k & 1)) continue;
            const int64_t down_ns = g->buttons[k].down_ns;
            if (down_ns < oldest_ns) oldest_ns = down_ns;
            if (down_ns > newest_ns) newest_ns = down_ns;
        }
        if (newest_ns - oldest_ns >= g->buttons[i].opts.chord_ns) continue;
        if (best < 0 || __builtin_popcount(chord) > __builtin_popcount(g->buttons[best].opts.chord))
            best = i;
    }
    return best;
}

/* Whether a larger chord can still be completed in time. */
static bool may_grow(const struct gn_gestures *g, int chord, uint32_t set) {
    const uint32_t inner = g->buttons[chord].opts.chord;
    for (int i = 0; i < g->count; i++) {
        const struct gn_gesture_opts *opts = &g->buttons[i].opts;
        if ((inner & ~opts->chord) || opts->chord == inner) continue;
        bool may = true;
        for (int k = 0; k < g->count; k++) {
            if (!(opts->chord >> k & 1)) continue;
            const struct gn_gesture_button *b = &g->buttons[k];
            may = may && (set >> k & 1 ? g->now_ns - b->down_ns < opts->chord_ns
                                       : b->state == GN_BUTTON_UP);
        }
        if (may) return true;
    }
    return false;
}

static void update_button(struct gn_gestures *g, int i, int64_t first_ns);

static void fire_chord(struct gn_gestures *g, int chord) {
    struct gn_gesture_button *c = &g->buttons[chord];
    int64_t first_ns = INT64_MIN;
    for (int i = 0; i < g->count; i++) {
        struct gn_gesture_button *b = &g->buttons[i];
        if (!(c->opts.chord >> i & 1)) continue;
        b->state = GN_BUTTON_USED;
        b->due_ns[GN_DUE_CHORD] = NEVER;
        click_before(g, i);
        if (b->down_first_ns > first_ns) first_ns = b->down_first_ns;
    }
    emit_gesture(g, chord, GN_GESTURE_CHORD, first_ns);
    c->together = true;
    update_button(g, chord, first_ns);
}

/* The wait for a chord is over: fires the best complete chord, else the button itself. */
static void resolve_chord(struct gn_gestures *g, int i) {
    const int chord = find_complete(g, i, waiting_buttons(g));
    if (chord >= 0)
        fire_chord(g, chord);
    else
        begin_press(g, i);
}

/* Ends the chords of this member: as if released, or without a gesture. */
static void end_chords(struct gn_gestures *g, int member, int64_t first_ns, bool quietly) {
    for (int i = 0; i < g->count; i++) {
        struct gn_gesture_button *c = &g->buttons[i];
        if (!c->together || !(c->opts.chord >> member & 1)) continue;
        if (quietly) mute_button(c);
        c->together = false;
        update_button(g, i, first_ns);
    }
}

/* ---- edges --------------------------------------------------------------------------------- */

/* The combined state may have changed. */
static void update_button(struct gn_gestures *g, int i, int64_t first_ns) {
    struct gn_gesture_button *b = &g->buttons[i];
    const bool down = b->line.settled || b->keys > 0 || b->together;
    if (down == b->down) return;
    b->down = down;
    if (down) {
        b->down_ns = g->now_ns;
        b->down_first_ns = first_ns;
        b->second = b->due_ns[GN_DUE_CLICK] != NEVER;
        b->due_ns[GN_DUE_CLICK] = NEVER;
        if (!b->together) b->due_ns[GN_DUE_STUCK] = g->now_ns + b->opts.stuck_ns;
        if (!b->chords) {
            begin_press(g, i);
            return;
        }
        int64_t longest_ns = 0;
        for (int c = 0; c < g->count; c++)
            if (b->chords >> c & 1 && g->buttons[c].opts.chord_ns > longest_ns)
                longest_ns = g->buttons[c].opts.chord_ns;
        b->state = GN_BUTTON_WAITING;
        b->due_ns[GN_DUE_CHORD] = g->now_ns + longest_ns;
        const uint32_t set = waiting_buttons(g);
        const int chord = find_complete(g, i, set);
        if (chord >= 0 && !may_grow(g, chord, set)) fire_chord(g, chord);
        return;
    }
    if (b->state == GN_BUTTON_WAITING) resolve_chord(g, i);
    const enum gn_gesture_state was = b->state;
    b->state = GN_BUTTON_UP;
    clear_press_due(b);
    if (was == GN_BUTTON_USED) end_chords(g, i, first_ns, false);
    if (was != GN_BUTTON_DOWN || b->acted) return;
    if (binds_gesture(b, 1u << GN_GESTURE_DOUBLE)) { /* waits for a second click */
        b->click_ns = first_ns;
        b->due_ns[GN_DUE_CLICK] = g->now_ns + b->opts.double_ns;
    } else {
        emit_gesture(g, i, GN_GESTURE_CLICK, first_ns);
    }
}

static void run_due(struct gn_gestures *g, int i, enum gn_gesture_due due) {
    struct gn_gesture_button *b = &g->buttons[i];
    const int64_t due_ns = b->due_ns[due];
    b->due_ns[due] = NEVER;
    switch (due) {
    case GN_DUE_CHORD: resolve_chord(g, i); break;
    case GN_DUE_CLICK: emit_gesture(g, i, GN_GESTURE_CLICK, b->click_ns); break;
    case GN_DUE_HOLD:
        b->acted = true;
        emit_gesture(g, i, GN_GESTURE_HOLD, due_ns);
        break;
    case GN_DUE_REPEAT:
        b->acted = true;
        b->due_ns[due] = due_ns + b->opts.repeat_ns;
        emit_gesture(g, i, GN_GESTURE_REPEAT, due_ns);
        break;
    case GN_DUE_STUCK: {
        const bool used = b->state == GN_BUTTON_USED;
        set_note(g, i, GN_NOTE_STUCK);
        mute_button(b);
        if (used) end_chords(g, i, g->now_ns, true);
        break;
    }
    case GN_DUE_NOISY:
        if (!b->noisy) set_note(g, i, GN_NOTE_NOISY);
        b->noisy = true;
        break;
    case GN_DUE_EDGE: break;
    }
}

/* ---- time ---------------------------------------------------------------------------------- */

/* The first thing due, and when (NEVER: nothing); timers before edges. GN_DUE_EDGE: the button's
 * line settles. */
static int64_t find_due(const struct gn_gestures *g, int *button, enum gn_gesture_due *due) {
    int64_t first_ns = NEVER;
    *button = 0;
    *due = GN_DUE_EDGE;
    for (int i = 0; i < g->count; i++)
        for (int d = 0; d < GN_DUE_COUNT; d++)
            if (g->buttons[i].due_ns[d] < first_ns) {
                first_ns = g->buttons[i].due_ns[d];
                *button = i;
                *due = (enum gn_gesture_due)d;
            }
    for (int i = 0; i < g->count; i++) {
        const int64_t settled_ns = gn_debounce_deadline(&g->buttons[i].line);
        if (settled_ns >= first_ns) continue;
        first_ns = settled_ns;
        *button = i;
        *due = GN_DUE_EDGE;
    }
    return first_ns;
}

int64_t gn_gestures_deadline(const struct gn_gestures *g) {
    int button;
    enum gn_gesture_due due;
    return find_due(g, &button, &due);
}

void gn_gestures_step(struct gn_gestures *g, int64_t now_ns) {
    int button;
    enum gn_gesture_due due;
    for (int64_t first_ns; (first_ns = find_due(g, &button, &due)) <= now_ns;) {
        if (first_ns == NEVER) break;
        if (first_ns > g->now_ns) g->now_ns = first_ns;
        if (due != GN_DUE_EDGE) {
            run_due(g, button, due);
            continue;
        }
        struct gn_gesture_button *b = &g->buttons[button];
        struct gn_debounced edge;
        b->due_ns[GN_DUE_NOISY] = NEVER;
        if (!gn_debounce_step(&b->line, g->now_ns, &edge)) continue;
        b->noisy = false;
        update_button(g, button, edge.first_ns);
    }
    if (now_ns > g->now_ns) g->now_ns = now_ns;
}

int64_t gn_gesture_sane_time_ns(int64_t time_ns, int64_t now_ns) {
    const bool sane = time_ns <= now_ns + 1000 * MS && time_ns >= now_ns - 300000 * MS;
    return sane ? time_ns : now_ns;
}

/* ---- input --------------------------------------------------------------------------------- */

static int64_t or_default(int64_t value_ns, int64_t default_ns) {
    return value_ns > 0 ? value_ns : default_ns;
}

void gn_gestures_init(struct gn_gestures *g, const struct gn_gesture_opts *opts, int count,
                      int64_t now_ns) {
    assert(count >= 0 && count <= GN_BUTTONS_MAX);
    memset(g, 0, sizeof *g);
    g->count = count;
    g->now_ns = now_ns;
    for (int i = 0; i < count; i++) {
        struct gn_gesture_button *b = &g->buttons[i];
        b->opts = opts[i];
        b->opts.debounce_ns = or_default(opts[i].debounce_ns, 20 * MS);
        b->opts.hold_ns = or_default(opts[i].hold_ns, 800 * MS);
        b->opts.double_ns = or_default(opts[i].double_ns, 350 * MS);
        b->opts.repeat_ns = or_default(opts[i].repeat_ns, 200 * MS);
        b->opts.chord_ns = or_default(opts[i].chord_ns, 80 * MS);
        b->opts.stuck_ns = or_default(opts[i].stuck_ns, 30000 * MS);
        gn_debounce_init(&b->line, b->opts.debounce_ns, false);
        for (int due = 0; due < GN_DUE_COUNT; due++) b->due_ns[due] = NEVER;
        for (int k = 0; k < count; k++)
            if (opts[k].chord >> i & 1) b->chords |= UINT32_C(1) << k;
    }
}

/* Runs all that is due before time_ns and returns the button; from here the time is g->now_ns. */
static struct gn_gesture_button *step_to(struct gn_gestures *g, int button, int64_t time_ns) {
    assert(button >= 0 && button < g->count);
    gn_gestures_step(g, time_ns);
    return &g->buttons[button];
}

/* Held since before the start: not a press. */
static void find_held(struct gn_gestures *g, struct gn_gesture_button *b) {
    if (b->down) return;
    b->down = true;
    mute_button(b);
    b->due_ns[GN_DUE_STUCK] = g->now_ns + b->opts.stuck_ns;
}

void gn_gestures_start(struct gn_gestures *g, int button, bool level, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    gn_debounce_init(&b->line, b->opts.debounce_ns, level);
    b->due_ns[GN_DUE_NOISY] = NEVER;
    if (level)
        find_held(g, b);
    else
        update_button(g, button, g->now_ns);
}

/* Its source is gone. */
static void lose_button(struct gn_gestures *g, int i) {
    struct gn_gesture_button *b = &g->buttons[i];
    if (!b->down || b->line.settled || b->keys > 0 || b->together) return;
    const bool used = b->state == GN_BUTTON_USED;
    click_before(g, i);
    mute_button(b);
    update_button(g, i, g->now_ns);
    if (used) end_chords(g, i, g->now_ns, true);
}

void gn_gestures_lose(struct gn_gestures *g, int button, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    gn_debounce_init(&b->line, b->opts.debounce_ns, false);
    b->due_ns[GN_DUE_NOISY] = NEVER;
    lose_button(g, button);
}

void gn_gestures_key_gone(struct gn_gestures *g, int button, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    assert(b->keys > 0);
    b->keys--;
    lose_button(g, button);
}

static void watch_noise(struct gn_gesture_button *b) {
    if (b->line.moving && b->due_ns[GN_DUE_NOISY] == NEVER && !b->noisy)
        b->due_ns[GN_DUE_NOISY] = b->line.first_ns + b->opts.stuck_ns;
}

void gn_gestures_edge(struct gn_gestures *g, int button, bool level, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    gn_debounce_edge(&b->line, level, g->now_ns);
    watch_noise(b);
}

void gn_gestures_level(struct gn_gestures *g, int button, bool level, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    gn_debounce_level(&b->line, level, g->now_ns);
    watch_noise(b);
}

void gn_gestures_key(struct gn_gestures *g, int button, bool down, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    assert(down || b->keys > 0);
    b->keys += down ? 1 : -1;
    update_button(g, button, g->now_ns);
}

void gn_gestures_key_held(struct gn_gestures *g, int button, int64_t time_ns) {
    struct gn_gesture_button *b = step_to(g, button, time_ns);
    b->keys++;
    find_held(g, b);
}

bool gn_gestures_at_rest(const struct gn_gestures *g, int button) {
    const struct gn_debounce *line = &g->buttons[button].line;
    return !line->moving && !line->settled;
}
