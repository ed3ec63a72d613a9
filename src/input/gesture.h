/* What a button means by going down and up: pure, and the same for every kind of button. Time comes
 * with the events; nobody asks a clock. */
#ifndef GN_INPUT_GESTURE_H
#define GN_INPUT_GESTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "input/debounce.h"

#define GN_BUTTONS_MAX 32

enum gn_gesture {
    GN_GESTURE_PRESS,  /* on the debounced edge, at once; a button of a chord waits for the others,
                          at most chord_ns */
    GN_GESTURE_CLICK,  /* on release before a hold; waits for a second one only where a double is
                          bound to this button */
    GN_GESTURE_DOUBLE, /* on the second press, within double_ns of the first click's release; no
                          click and no hold follow */
    GN_GESTURE_HOLD,   /* held for hold_ns, fires while held; no click follows */
    GN_GESTURE_REPEAT, /* at hold_ns, and every repeat_ns from then on while held */
    GN_GESTURE_CHORD,  /* all of a chord's buttons went down within chord_ns; their own gestures do
                          not happen. The chord is a button itself: it is down until the first of
                          them is released, and has all the other gestures, too */
    GN_GESTURE_COUNT,
};
extern const char *const gn_gesture_names[GN_GESTURE_COUNT]; /* "press"; also keys of the INI */

/* What happened, in the order in which it did. */
struct gn_gesture_event {
    int button; /* index into gn_input_opts.buttons */
    enum gn_gesture gesture;
    int64_t time_ns; /* monotonic: of the first edge that led to it (the release's for a click, the
                        last button's for a chord); hold and repeat: when it was due */
};

/* ---- the machine --------------------------------------------------------------------------- */

struct gn_gesture_opts { /* of one button; zero means the default written beside */
    unsigned gestures;   /* bits 1 << gn_gesture: the others do not happen */
    uint32_t chord;      /* bits 1 << button, two or more, none of them a chord; 0: not a chord */
    int64_t debounce_ns; /* 20 ms; for lines, keys do not bounce */
    int64_t hold_ns;     /* 800 ms */
    int64_t double_ns;   /* 350 ms */
    int64_t repeat_ns;   /* 200 ms */
    int64_t chord_ns;    /* 80 ms */
    int64_t stuck_ns;    /* 30 s: held longer, it is ignored until it is released */
};

enum gn_gesture_note_kind {
    GN_NOTE_STUCK, /* held for stuck_ns, from the start on or not; ignored until released */
    GN_NOTE_NOISY, /* its line did not come to rest for stuck_ns */
    GN_NOTE_FAST,  /* more than 20 gestures in a second: the rest does not happen */
};
struct gn_gesture_note {
    int button;
    enum gn_gesture_note_kind kind;
};

enum { GN_GESTURE_RATE = 20, GN_GESTURE_QUEUE = 64, GN_GESTURE_NOTES = 32 };
enum gn_gesture_due {               /* why a button has to be looked at again */
                      GN_DUE_CHORD, /* nobody joins it */
                      GN_DUE_CLICK, /* no second one came */
                      GN_DUE_HOLD,
                      GN_DUE_REPEAT,
                      GN_DUE_STUCK,
                      GN_DUE_NOISY,
                      GN_DUE_COUNT,
};
enum gn_gesture_state {
    GN_BUTTON_UP,
    GN_BUTTON_WAITING, /* down, and may become one of a chord */
    GN_BUTTON_DOWN,
    GN_BUTTON_USED,  /* down as one of a chord */
    GN_BUTTON_MUTED, /* down, and ignored until it is up */
};
struct gn_gesture_button {
    struct gn_gesture_opts opts; /* with the defaults filled in */
    uint32_t chords;             /* bits 1 << button of the chords that it is one of */
    struct gn_debounce line;
    int keys;      /* held */
    bool together; /* a chord: its buttons are held */
    bool down;     /* any of these three */
    bool acted;    /* no click follows */
    bool second;   /* pressed again in time; begin() makes it a double */
    bool noisy, fast;
    enum gn_gesture_state state;
    int64_t down_ns;       /* when the press counted */
    int64_t down_first_ns; /* its first edge */
    int64_t click_ns;      /* the release's first edge, while GN_DUE_CLICK or second is set */
    int64_t due_ns[GN_DUE_COUNT];
    int64_t recent_ns[GN_GESTURE_RATE]; /* of the last gestures, a ring */
    unsigned recent;
};
struct gn_gestures { /* nothing in it is freed */
    struct gn_gesture_button buttons[GN_BUTTONS_MAX];
    int count;
    int64_t now_ns; /* how far it has come; what is said to be earlier happens now */
    struct gn_gesture_event queue[GN_GESTURE_QUEUE];
    struct gn_gesture_note notes[GN_GESTURE_NOTES];
    unsigned queue_begin, queue_end, note_begin, note_end;
    unsigned dropped; /* gestures that found the queue full, ever */
};

void gn_gestures_init(struct gn_gestures *g, const struct gn_gesture_opts *opts, int count,
                      int64_t now_ns);
/* The button has a line from now on, at that level (true: pressed). Pressed: nothing happens until
 * it is released. */
void gn_gestures_start(struct gn_gestures *g, int button, bool level, int64_t time_ns);
/* Its line is gone: what has begun ends without a gesture. */
void gn_gestures_lose(struct gn_gestures *g, int button, int64_t time_ns);
/* An edge of its line, or what was read there. */
void gn_gestures_edge(struct gn_gestures *g, int button, bool level, int64_t time_ns);
void gn_gestures_level(struct gn_gestures *g, int button, bool level, int64_t time_ns);
/* One of its keys went down or up; as often up as down. */
void gn_gestures_key(struct gn_gestures *g, int button, bool down, int64_t time_ns);
/* One of its keys is down, since before anybody listened. */
void gn_gestures_key_held(struct gn_gestures *g, int button, int64_t time_ns);
/* One of its keys that was down is gone: what has begun ends without a gesture. */
void gn_gestures_key_gone(struct gn_gestures *g, int button, int64_t time_ns);
/* Nobody has touched its line for a while. */
bool gn_gestures_at_rest(const struct gn_gestures *g, int button);

/* A kernel's timestamp, unless it can be none of the clock that now_ns is of, or lies ten seconds
 * back: then now_ns. */
int64_t gn_gesture_time_ns(int64_t time_ns, int64_t now_ns);
/* Lets time pass. When to do so at the latest; INT64_MAX: something has to happen first. */
void gn_gestures_step(struct gn_gestures *g, int64_t now_ns);
int64_t gn_gestures_deadline(const struct gn_gestures *g);

bool gn_gestures_next(struct gn_gestures *g, struct gn_gesture_event *out);
bool gn_gestures_note(struct gn_gestures *g, struct gn_gesture_note *out);

#endif
