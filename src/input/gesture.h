/* Buttons to gestures, for every kind of button. Pure: times come with the events. */
#ifndef GN_INPUT_GESTURE_H
#define GN_INPUT_GESTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "input/debounce.h"

#define GN_BUTTONS_MAX 32

enum gn_gesture {
    GN_GESTURE_PRESS,  /* at the debounced edge; a button of a chord waits for the others, at most
                          chord_ns */
    GN_GESTURE_CLICK,  /* on release before a hold; waits for a second click only if a double is
                          bound to this button */
    GN_GESTURE_DOUBLE, /* on the second press, within double_ns of the first release; no click or
                          hold follows */
    GN_GESTURE_HOLD,   /* after hold_ns, while held; no click follows */
    GN_GESTURE_REPEAT, /* at hold_ns, and every repeat_ns while held */
    GN_GESTURE_CHORD,  /* all buttons of a chord went down within chord_ns; their own gestures are
                          suppressed. The chord is a button itself: down until the first of them is
                          released, with all other gestures */
    GN_GESTURE_COUNT,
};
extern const char *const gn_gesture_names[GN_GESTURE_COUNT]; /* "press"; also keys of the INI */

/* Gestures are queued in the order in which they happen. */
struct gn_gesture_event {
    int button; /* index into gn_input_opts.buttons */
    enum gn_gesture gesture;
    int64_t time_ns; /* monotonic: first edge that led to it (a click's release, a chord's last
                        button); hold and repeat: when due */
};

/* ---- state machine ------------------------------------------------------------------------- */

struct gn_gesture_opts { /* per button; zero means the default written beside */
    unsigned gestures;   /* bits 1 << gn_gesture that are enabled */
    uint32_t chord;      /* bits 1 << button, two or more, no chords; 0: not a chord */
    int64_t debounce_ns; /* 20 ms; for lines only */
    int64_t hold_ns;     /* 800 ms */
    int64_t double_ns;   /* 350 ms */
    int64_t repeat_ns;   /* 200 ms */
    int64_t chord_ns;    /* 80 ms */
    int64_t stuck_ns;    /* 30 s: held longer, it is ignored until released */
};

enum gn_gesture_note_kind {
    GN_NOTE_STUCK, /* held for stuck_ns; ignored until released */
    GN_NOTE_NOISY, /* its line did not settle for stuck_ns */
    GN_NOTE_FAST,  /* more than 20 gestures in a second: the rest is dropped */
};
struct gn_gesture_note {
    int button;
    enum gn_gesture_note_kind kind;
};

enum { GN_GESTURE_RATE = 20, GN_GESTURE_QUEUE = 64, GN_GESTURE_NOTES = 32 };
enum gn_gesture_due {               /* timers of a button */
                      GN_DUE_CHORD, /* no other button of a chord followed */
                      GN_DUE_CLICK, /* no second click followed */
                      GN_DUE_HOLD,
                      GN_DUE_REPEAT,
                      GN_DUE_STUCK,
                      GN_DUE_NOISY,
                      GN_DUE_COUNT,
                      GN_DUE_EDGE = GN_DUE_COUNT, /* no timer: the line settles */
};
enum gn_gesture_state {
    GN_BUTTON_UP,
    GN_BUTTON_WAITING, /* down, and may become part of a chord */
    GN_BUTTON_DOWN,
    GN_BUTTON_USED,  /* down as part of a chord */
    GN_BUTTON_MUTED, /* down, ignored until released */
};
struct gn_gesture_button {
    struct gn_gesture_opts opts; /* with defaults filled in */
    uint32_t chords;             /* bits 1 << button of chords it belongs to */
    struct gn_debounce line;
    int keys;      /* number of keys held */
    bool together; /* a chord: all its buttons are held */
    bool down;     /* the button is down by any of these */
    bool acted;    /* no click follows */
    bool second;   /* pressed again in time; begin_press() makes it a double */
    bool noisy, fast;
    enum gn_gesture_state state;
    int64_t down_ns;       /* when the press counted */
    int64_t down_first_ns; /* its first edge */
    int64_t click_ns;      /* first edge of the release, while GN_DUE_CLICK or second is set */
    int64_t due_ns[GN_DUE_COUNT];
    int64_t recent_ns[GN_GESTURE_RATE]; /* times of the last gestures, a ring */
    unsigned recent;
};
struct gn_gestures { /* owns no memory */
    struct gn_gesture_button buttons[GN_BUTTONS_MAX];
    int count;
    int64_t now_ns; /* time of the last step; earlier events happen now */
    struct gn_gesture_event queue[GN_GESTURE_QUEUE];
    struct gn_gesture_note notes[GN_GESTURE_NOTES];
    unsigned queue_begin, queue_end, note_begin, note_end;
    unsigned dropped; /* gestures dropped because the queue was full, in total */
};

void gn_gestures_init(struct gn_gestures *g, const struct gn_gesture_opts *opts, int count,
                      int64_t now_ns);
/* The button has a line now, at that level (true: pressed). If pressed, it is ignored until
 * released. */
void gn_gestures_start(struct gn_gestures *g, int button, bool level, int64_t time_ns);
/* Its line is gone: gestures in progress end without an event. */
void gn_gestures_lose(struct gn_gestures *g, int button, int64_t time_ns);
/* An edge of its line, or a level that was read. */
void gn_gestures_edge(struct gn_gestures *g, int button, bool level, int64_t time_ns);
void gn_gestures_level(struct gn_gestures *g, int button, bool level, int64_t time_ns);
/* One of its keys went down or up; calls must be balanced. */
void gn_gestures_key(struct gn_gestures *g, int button, bool down, int64_t time_ns);
/* One of its keys has been down since before it was opened. */
void gn_gestures_key_held(struct gn_gestures *g, int button, int64_t time_ns);
/* One of its keys that is down disappeared: gestures in progress end without an event. */
void gn_gestures_key_gone(struct gn_gestures *g, int button, int64_t time_ns);
/* The line is up and nothing is pending. */
bool gn_gestures_at_rest(const struct gn_gestures *g, int button);

/* Validates a kernel timestamp: returns now_ns for one that is more than a second ahead of the
 * clock or more than five minutes old: of another clock. A press that was made while a frame took
 * long is still one, since its two edges keep their distance. */
int64_t gn_gesture_sane_time_ns(int64_t time_ns, int64_t now_ns);
/* Advances time. The deadline is when to call it at the latest; INT64_MAX: not before the next
 * event. */
void gn_gestures_step(struct gn_gestures *g, int64_t now_ns);
int64_t gn_gestures_deadline(const struct gn_gestures *g);

bool gn_gestures_next(struct gn_gestures *g, struct gn_gesture_event *out);
bool gn_gestures_note(struct gn_gestures *g, struct gn_gesture_note *out);

#endif
