/* Buttons against an oracle that knows no state: random lives of two buttons and their chord -
 * bounces, spikes, bursts, lost edges, times that stand still or go back - are laid out as arrays,
 * a millisecond an entry, and what had to happen is read off the whole arrays.
 *
 *   test_gesture_traces [FIRST [COUNT]]    GN_FULL=1: a million; a seed that fails is printed */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/dice.h"
#include "input/gesture.h"

#define MS INT64_C(1000000)
enum {
    TICKS = 1400,
    EVENTS_MAX = 700,
    FOUND_MAX = 4000,
    LATER = 100 * TICKS,
    A = 0,
    B = 1,
    BOTH = 2
};

/* ---- a life -------------------------------------------------------------------------------- */

struct edge {
    int tick, said, time; /* when it is heard; what its timestamp says; what that comes to */
    bool level;
};
struct life {
    struct edge edges[2][EVENTS_MAX];
    int count[2];
    bool held[2]; /* at the start */
    int stable, hold, twice, repeat, chord, stuck;
    unsigned gestures[3];
    bool has_chord;
    bool lazy; /* the machine is called for edges alone; else every millisecond */
};

static struct gn_dice dice;

static uint64_t next(void) { return gn_dice_next(&dice); }

static int between(int low, int high) { return low + (int)(next() % (uint64_t)(high - low + 1)); }
static int least(int a, int b) { return a < b ? a : b; }
static int most(int a, int b) { return a > b ? a : b; }
static bool chance(int percent) { return between(1, 100) <= percent; }

static void add(struct life *l, int b, int tick, bool level) {
    if (l->count[b] == EVENTS_MAX || tick >= TICKS - 400 || chance(4)) return; /* 4 %: lost */
    const int said = chance(5) ? most(tick - between(1, 9), 0) : tick;
    l->edges[b][l->count[b]++] = (struct edge){.tick = tick, .said = said, .level = level};
}

/* Edges around a change of level: each half as likely as the one before. */
static int bounce(struct life *l, int b, int tick, bool level) {
    add(l, b, tick, level);
    while (chance(50)) {
        add(l, b, tick += between(0, 4), !level);
        add(l, b, tick += between(0, 4), level);
    }
    return tick;
}

static void live(struct life *l, int b) {
    static const int longest[] = {1, 30, 30, 120, 450};
    int tick = between(0, 60);
    bool level = l->held[b];
    while (tick < TICKS - 400) {
        const int kind = between(0, 9);
        if (kind == 0) { /* a spike */
            add(l, b, tick, !level);
            add(l, b, tick += between(0, 12), level);
        } else if (kind == 1 && chance(30)) { /* a burst */
            for (int i = between(5, 120); i > 0; i--) add(l, b, tick += chance(80), level = !level);
        } else {
            tick = bounce(l, b, tick, level = !level);
        }
        tick += between(0, longest[between(0, 4)]);
    }
}

/* The other one does the same a little later, now and then. */
static void follow(struct life *l) {
    const int late = between(0, 60);
    for (int i = 0; i < l->count[A]; i++)
        add(l, B, l->edges[A][i].tick + late, l->edges[A][i].level);
}

/* The next edge that is heard, A's first; NULL: there is none. at: how many have been. */
static struct edge *hear(struct life *l, int at[2], int *b) {
    struct edge *a = at[A] < l->count[A] ? &l->edges[A][at[A]] : NULL;
    struct edge *other = at[B] < l->count[B] ? &l->edges[B][at[B]] : NULL;
    *b = a && (!other || a->tick <= other->tick) ? A : B;
    at[*b]++;
    return *b == A ? a : other;
}

/* Time never goes back. */
static void straighten(struct life *l) {
    int at[2] = {0}, now = 0, b;
    for (struct edge *e; (e = hear(l, at, &b));)
        now = e->time = most(now, l->lazy ? e->said : e->tick);
}

static void make(struct life *l, uint64_t seed) {
    dice.state = seed;
    memset(l, 0, sizeof *l);
    l->stable = between(1, 30);
    l->chord = between(5, 60);
    l->hold = l->chord + between(20, 150);
    l->twice = between(10, 150);
    l->repeat = between(1, 90);
    l->stuck = between(0, 3) ? 30000 : between(100, 500);
    l->has_chord = chance(60);
    for (int i = 0; i < 3; i++) l->gestures[i] = chance(25) ? 63 : (unsigned)between(0, 63);
    l->held[A] = chance(15);
    l->held[B] = chance(15);
    live(l, A);
    if (chance(60))
        follow(l);
    else
        live(l, B);
    l->lazy = chance(50);
    straighten(l);
}

/* ---- the oracle ---------------------------------------------------------------------------- */

struct found {
    int tick; /* when it had to happen */
    enum gn_gesture gesture;
    int time; /* what it had to say */
};
struct seen { /* of one button */
    struct found list[FOUND_MAX];
    int count, stuck;
    bool down; /* at the end */
};
struct span { /* down, by the debounced level */
    int from, to, first, first_up;
    int used; /* by a chord, at that tick; 0: no */
    int cut;  /* a chord's: the tick at which one of its buttons was stuck */
    bool muted;
};
struct spans {
    struct span list[FOUND_MAX];
    int count;
};

/* The level counts when nothing has been heard for as long. */
static void lay_out(const struct life *l, int b, bool *settled, int *first) {
    static bool raw[TICKS];
    static int touched[TICKS]; /* the last tick up to here with an edge; -1000: none */
    memset(touched, 0, sizeof touched);
    int e = 0;
    for (int t = 0; t < TICKS; t++) {
        raw[t] = t ? raw[t - 1] : l->held[b];
        touched[t] = t ? touched[t - 1] : -1000;
        for (; e < l->count[b] && l->edges[b][e].time == t; e++) {
            raw[t] = l->edges[b][e].level;
            touched[t] = t;
        }
    }
    for (int t = 0; t < TICKS; t++) {
        const int last = t ? touched[t - 1] : -1000;
        settled[t] = t ? settled[t - 1] : l->held[b];
        first[t] = 0;
        if (t - last < l->stable || last < 0) continue;
        settled[t] = raw[last];
        for (first[t] = last; first[t] > 0;) { /* back over all gaps that are too short */
            const int before = touched[first[t] - 1];
            if (before < 0 || first[t] - before >= l->stable) break;
            first[t] = before;
        }
    }
}

static void find_spans(const struct life *l, int b, struct spans *out) {
    static bool settled[TICKS];
    static int first[TICKS];
    lay_out(l, b, settled, first);
    out->count = 0;
    for (int t = 0; t < TICKS; t++) {
        if (!settled[t] || (t && settled[t - 1])) continue;
        struct span *s = &out->list[out->count++];
        *s = (struct span){.from = t, .to = LATER, .first = first[t], .cut = LATER};
        s->muted = t == 0 && l->held[b];
        for (int u = t + 1; u < TICKS && s->to == LATER; u++)
            if (!settled[u]) {
                s->to = u;
                s->first_up = first[u];
            }
    }
}

/* Both down, pressed within the time of a chord; at one tick A is heard first. */
static void find_chords(const struct life *l, struct spans *a, struct spans *b, struct spans *out) {
    out->count = 0;
    for (int i = 0; i < a->count; i++)
        for (int k = 0; k < b->count; k++) {
            struct span *p = &a->list[i], *q = &b->list[k];
            const bool apart = p->from <= q->from ? p->to <= q->from : q->to < p->from;
            if (p->muted || q->muted || apart || abs(p->from - q->from) >= l->chord) continue;
            if (p->used || q->used) continue;
            p->used = q->used = most(p->from, q->from);
            const bool a_ends = p->to <= q->to;
            struct span *c = &out->list[out->count++];
            *c = (struct span){.from = p->used, .first = most(p->first, q->first), .cut = LATER};
            c->to = a_ends ? p->to : q->to;
            c->first_up = a_ends ? p->first_up : q->first_up;
            if (least(p->from, q->from) + l->stuck <= c->to)
                c->cut = least(p->from, q->from) + l->stuck;
        }
}

static void put(struct seen *s, int tick, enum gn_gesture gesture, int time) {
    if (tick < TICKS && s->count < FOUND_MAX)
        s->list[s->count++] = (struct found){.tick = tick, .gesture = gesture, .time = time};
}

/* alone: for so many ticks it may become one of a chord. */
static void expect_span(const struct life *l, int b, const struct span *p, int alone, bool second,
                        struct seen *s) {
    const bool hold = l->gestures[b] & 1u << GN_GESTURE_HOLD;
    const bool repeat = l->gestures[b] & 1u << GN_GESTURE_REPEAT;
    const int begins = least(p->from + alone, p->to);
    if (b == BOTH) put(s, p->from, GN_GESTURE_CHORD, p->first);
    put(s, begins, GN_GESTURE_PRESS, p->first);
    if (second) put(s, begins, GN_GESTURE_DOUBLE, p->first);
    const int stuck = b == BOTH ? p->cut - 1 : p->from + l->stuck;
    const int last = second ? 0 : least(least(p->to, stuck), TICKS);
    for (int t = p->from + l->hold; t <= last; t += l->repeat) {
        if (hold && t == p->from + l->hold) put(s, t, GN_GESTURE_HOLD, t);
        if (repeat) put(s, t, GN_GESTURE_REPEAT, t);
    }
}

/* It was released in time to be a click. */
static bool is_click(const struct life *l, int b, const struct span *p) {
    const unsigned held = 1u << GN_GESTURE_HOLD | 1u << GN_GESTURE_REPEAT;
    const int stuck = b == BOTH ? p->cut : p->from + l->stuck;
    return !p->muted && !p->used && p->to < TICKS && stuck > p->to &&
           !(l->gestures[b] & held && p->from + l->hold <= p->to);
}

/* What a button had to say, going from press to press. */
static void expect(const struct life *l, int b, const struct spans *spans, int alone,
                   struct seen *s) {
    const bool twice = l->gestures[b] & 1u << GN_GESTURE_DOUBLE;
    bool second = false; /* the click before this press waits for it */
    memset(s, 0, sizeof *s);
    for (int i = 0; i < spans->count; i++) {
        const struct span *p = &spans->list[i];
        const struct span *after = i + 1 < spans->count ? p + 1 : NULL;
        const int stuck = p->from + l->stuck;
        s->stuck += b != BOTH && stuck <= p->to && stuck < TICKS;
        s->down |= p->to >= TICKS;
        const bool clicks = is_click(l, b, p) && !second;
        if (!p->muted && !p->used) expect_span(l, b, p, alone, second, s);
        second = clicks && twice && after && after->from - p->to < l->twice;
        if (!clicks) continue;
        if (!twice)
            put(s, p->to, GN_GESTURE_CLICK, p->first_up);
        else if (!second)
            put(s, p->to + l->twice, GN_GESTURE_CLICK, p->first_up);
        else if (after->used)
            put(s, after->used, GN_GESTURE_CLICK, p->first_up), second = false;
    }
}

/* Of what is bound no more than twenty in any second. */
static void limit(const struct life *l, int b, struct seen *s) {
    int count = 0;
    for (int i = 0; i < s->count; i++) {
        const struct found *f = &s->list[i];
        if (!(l->gestures[b] & 1u << f->gesture)) continue;
        if (count >= 20 && f->tick - s->list[count - 20].tick < 1000) continue;
        s->list[count++] = *f;
    }
    s->count = count;
}

static void ask_oracle(const struct life *l, struct seen seen[3]) {
    static struct spans a, b, both;
    find_spans(l, A, &a);
    find_spans(l, B, &b);
    both.count = 0;
    if (l->has_chord) find_chords(l, &a, &b, &both);
    expect(l, A, &a, l->has_chord ? l->chord : 0, &seen[A]);
    expect(l, B, &b, l->has_chord ? l->chord : 0, &seen[B]);
    expect(l, BOTH, &both, 0, &seen[BOTH]);
    for (int i = 0; i < 3; i++) limit(l, i, &seen[i]);
}

/* ---- the machine --------------------------------------------------------------------------- */

static void collect(struct gn_gestures *g, int tick, struct seen seen[3]) {
    struct gn_gesture_event event;
    struct gn_gesture_note note;
    while (gn_gestures_next(g, &event)) {
        struct seen *s = &seen[event.button];
        if (s->count < FOUND_MAX)
            s->list[s->count++] = (struct found){
                .tick = tick, .gesture = event.gesture, .time = (int)(event.time_ns / MS)};
    }
    while (gn_gestures_note(g, &note)) seen[note.button].stuck += note.kind == GN_NOTE_STUCK;
}

static void ask_machine(struct life *l, struct seen seen[3]) {
    static struct gn_gestures g;
    struct gn_gesture_opts opts[3];
    for (int i = 0; i < 3; i++)
        opts[i] = (struct gn_gesture_opts){.gestures = l->gestures[i],
                                           .chord = i == BOTH ? 3 : 0,
                                           .debounce_ns = l->stable * MS,
                                           .hold_ns = l->hold * MS,
                                           .double_ns = l->twice * MS,
                                           .repeat_ns = l->repeat * MS,
                                           .chord_ns = l->chord * MS,
                                           .stuck_ns = l->stuck * MS};
    memset(seen, 0, 3 * sizeof *seen);
    gn_gestures_init(&g, opts, l->has_chord ? 3 : 2, 0);
    gn_gestures_start(&g, A, l->held[A], 0);
    gn_gestures_start(&g, B, l->held[B], 0);
    int at[2] = {0}, b, tick = 0;
    for (struct edge *e; (e = hear(l, at, &b));) {
        for (; tick <= e->tick && !l->lazy; tick++) {
            gn_gestures_step(&g, tick * MS);
            collect(&g, tick, seen);
        }
        gn_gestures_edge(&g, b, e->level, e->said * MS);
        collect(&g, tick, seen);
    }
    for (; tick < TICKS; tick++) {
        gn_gestures_step(&g, tick * MS);
        collect(&g, tick, seen);
    }
    for (int i = 0; i < 2; i++) seen[i].down = g.buttons[i].line.settled;
}

/* ---- both ---------------------------------------------------------------------------------- */

static void print(const char *who, const struct seen *s) {
    printf("  %s: %d stuck, %s at the end:", who, s->stuck, s->down ? "down" : "up");
    for (int i = 0; i < s->count; i++)
        printf(" %d:%s@%d", s->list[i].tick, gn_gesture_names[s->list[i].gesture], s->list[i].time);
    printf("\n");
}

static bool is_same(const struct life *l, const struct seen *a, const struct seen *b) {
    bool same = a->count == b->count && a->stuck == b->stuck && a->down == b->down;
    for (int i = 0; same && i < a->count; i++) {
        const struct found *f = &a->list[i], *g = &b->list[i];
        same = f->gesture == g->gesture && f->time == g->time && (l->lazy || f->tick == g->tick);
    }
    return same;
}

static bool compare(uint64_t seed, unsigned long *gestures) {
    static struct life life;
    static struct seen truth[3], seen[3];
    make(&life, seed);
    ask_oracle(&life, truth);
    ask_machine(&life, seen);
    bool good = true;
    for (int i = 0; i < 3; i++) {
        truth[i].down = i == BOTH ? seen[i].down : truth[i].down;
        *gestures += (unsigned long)truth[i].count;
        if (is_same(&life, &truth[i], &seen[i])) continue;
        printf("FAIL seed %llu, button %d (stable %d chord %d hold %d twice %d repeat %d stuck %d "
               "bound %u%s)\n",
               (unsigned long long)seed, i, life.stable, life.chord, life.hold, life.twice,
               life.repeat, life.stuck, life.gestures[i], life.lazy ? " lazy" : "");
        print("oracle ", &truth[i]);
        print("machine", &seen[i]);
        good = false;
    }
    return good;
}

int main(int argc, char **argv) {
    const uint64_t first = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    const uint64_t all = getenv("GN_FULL") ? 1000000 : 10000;
    const uint64_t count = argc > 2 ? strtoull(argv[2], NULL, 10) : argc > 1 ? 1 : all;
    unsigned long gestures = 0;
    int failures = 0;
    for (uint64_t seed = first; seed < first + count && failures < 5; seed++)
        failures += !compare(seed, &gestures);
    printf("%llu lives, %lu gestures, %d disagreements\n", (unsigned long long)count, gestures,
           failures);
    return failures > 0 || gestures < count;
}
