/* Buttons on GPIO lines: found, requested, read, and found again after a failure. Failures are
 * reported once and retried, never errors.
 *
 * A missing line is searched for when the folder of devices changes; without inotify, every 2 s.
 * A line without permission or in use: every 2 s for half a minute, then every minute. A chip
 * that disappears takes its lines with it and may return under any number.
 *
 * An idle kiosk must sleep. Edges are lost only when a buffer is full, so a line at rest (up and
 * settled) is not polled. The level is read after each gap in sequence numbers and each full
 * buffer; every second while the line is down or moving, so that a lost release is not taken for
 * a long press; every minute once it is stuck. */
#ifndef GN_INPUT_LINES_H
#define GN_INPUT_LINES_H

#include "core/loop.h"
#include "input/gesture.h"
#include "input/line_find.h"
#include "input/report.h"

struct gn_line_opts {
    const char *button; /* its name */
    const char *text;   /* as in gn_button_opts; NULL: none */
    bool active_high, optional;
    enum gn_bias bias;
    int64_t debounce_ns; /* of the button; the kernel's is shorter */
};
struct gn_line {
    struct gn_line_opts opts;
    struct gn_line_spec spec;
    bool wanted;
    void *request; /* NULL: waiting for the line */
    struct gn_watch watch;
    struct gn_lines *all;   /* the set that it is in */
    bool readable, hung_up; /* the descriptor became readable and was not read yet */
    char where[96];
    bool no_bias;
    uint32_t seqno;
    int problem;                          /* an enum of lines.c; 0: none */
    int64_t since_ns, retry_ns, check_ns; /* INT64_MAX: never */
    char reported[GN_REPORT_SIZE];
};
struct gn_lines {
    const struct gn_gpio_ops *ops;
    void *context;      /* for ops */
    const char *folder; /* "/dev" */
    struct gn_loop *loop;
    struct gn_timer *timer;       /* armed when a line becomes readable */
    bool watched;                 /* gn_lines_changed() is called on changes of the folder */
    struct gn_gestures *gestures; /* receives edges; button i is line i */
    struct gn_reports *reports;
    struct gn_line lines[GN_BUTTONS_MAX];
    int count;
};

/* Fails only on usage errors. The fields above are set by the caller, lines are not. */
bool gn_lines_init(struct gn_lines *lines, const struct gn_line_opts *opts, int count,
                   struct gn_err *err);

/* Searches for all missing lines. */
void gn_lines_search(struct gn_lines *lines, int64_t now_ns);
/* The folder has changed. */
void gn_lines_changed(struct gn_lines *lines, int64_t now_ns);

#endif
