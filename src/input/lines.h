/* The buttons that are lines of GPIO chips: found, asked for, read, and found again after whatever
 * happened to them. Nothing here is an error: what is wrong is said once, and tried again.
 *
 * A line that is not there: when the folder of devices changes; without news of that, every 2 s.
 * One that may not be opened or that somebody else has: every 2 s for half a minute, then every
 * minute. A chip that goes takes its lines with it, and comes back under any number.
 *
 * A still kiosk sleeps: edges that are lost are lost out of a full buffer, so a line at rest - up,
 * and quiet - wakes us for every edge that matters. Its level is read after each gap in the
 * kernel's numbers and each full buffer; and every second as long as it is down or moving, so that
 * a lost release is no long press; every minute once it is stuck. */
#ifndef GN_INPUT_LINES_H
#define GN_INPUT_LINES_H

#include "core/loop.h"
#include "input/gesture.h"
#include "input/line_find.h"
#include "input/report.h"

struct gn_line_opts {
    const char *button; /* its name */
    const char *text;   /* the line, as in gn_button_opts; NULL: none */
    bool active_high, optional;
    enum gn_bias bias;
    int64_t debounce_ns; /* of the button: the kernel's is shorter */
};
struct gn_line {
    struct gn_line_opts opts;
    struct gn_line_spec spec;
    bool wanted;
    void *request; /* NULL: it is waited for */
    struct gn_watch watch;
    struct gn_lines *all;
    bool readable, hung_up; /* since it was read */
    char where[96];
    bool no_bias;
    uint32_t seqno;
    int problem;                          /* an enum of lines.c; 0: none */
    int64_t since_ns, retry_ns, check_ns; /* INT64_MAX: never */
    char said[GN_REPORT_SIZE];
};
struct gn_lines {
    const struct gn_gpio_ops *ops;
    void *context;      /* of ops */
    const char *folder; /* "/dev" */
    struct gn_loop *loop;
    struct gn_timer *timer;       /* made due by a line that is readable */
    bool watched;                 /* gn_lines_changed() is called when the folder changes */
    struct gn_gestures *gestures; /* where edges go; button i is line i */
    struct gn_reports *reports;
    struct gn_line lines[GN_BUTTONS_MAX];
    int count;
};

/* Wrong usage is all that fails. The fields above are set, lines are not. */
bool gn_lines_init(struct gn_lines *lines, const struct gn_line_opts *opts, int count,
                   struct gn_err *err);
void gn_lines_finish(struct gn_lines *lines);

/* Looks for all that are missing. */
void gn_lines_search(struct gn_lines *lines, int64_t now_ns);
/* The folder has changed. */
void gn_lines_changed(struct gn_lines *lines, int64_t now_ns);
/* Reads the lines that are readable. Their edges go on in the order of their times. */
void gn_lines_read(struct gn_lines *lines, int64_t now_ns);
/* What is due; and when that will be, after the gestures have been stepped. */
void gn_lines_step(struct gn_lines *lines, int64_t now_ns);
int64_t gn_lines_deadline(const struct gn_lines *lines);

#endif
