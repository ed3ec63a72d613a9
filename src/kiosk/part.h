/* Services of the kiosk. A file that defines gn_part_NAME and a row of the table add one: it gets
 * what it needs by struct gn_part_host, its memory by its size, its turns by the functions of its
 * row, and its settings have rows of their own in options/rows.h. */
#ifndef GN_KIOSK_PART_H
#define GN_KIOSK_PART_H

#include "core/loop.h"
#include "display/display.h"
#include "display/television.h"
#include "frame/frame.h"
#include "kiosk/machine.h"
#include "kiosk/metric.h"
#include "kiosk/problems.h"
#include "kiosk/stats.h"
#include "options/options.h"

struct gn_gl;
struct gn_info;
struct gn_show;
struct gn_stage;

/* What a part gets of the kiosk. What is behind a pointer may change between two calls. */
struct gn_part_host {
    struct gn_loop *loop;
    const struct gn_display *display;
    struct gn_gl *const *gl;                   /* NULL: there is no context */
    struct gn_options *const *options;         /* a reload replaces them */
    const struct gn_settings *const *settings; /* of the mode that is shown */
    const struct gn_kiosk_rules *rules;
    struct gn_kiosk *kiosk; /* to be changed by gn_kiosk_step() alone */
    const struct gn_show_counts *counts;
    struct gn_problems *problems;
    const bool *still;            /* the picture is not to move: rays are cast of it */
    const struct gn_stage *stage; /* what is shown; its scene is NULL before the first one */
    bool *changed;                /* to be set: the next picture differs */
    struct gn_show *show;         /* for parts that answer for the whole kiosk */
    /* Begins a reload since files have changed; turned: by the turn of the content's link. False:
     * not now. */
    bool (*renew)(struct gn_show *show, bool turned);
    /* Reports a problem that the caption says, too. */
    void (*report_error)(struct gn_show *show, enum gn_problem kind, const char *text);
    void (*cure_error)(struct gn_show *show, enum gn_problem kind);
    /* Files of scenes: of the one that is shown, of the one that the options want, and of one that
     * could not be shown; NULL and "" are none. */
    void (*scene_files)(const struct gn_show *show, const char *out_paths[3]);

    /* for tests; zero is the machine itself */
    const char *root;   /* before /sys and /proc */
    int64_t reading_ns; /* between two readings of the board's health; 0: 10 s */
    const struct gn_television_opts *television; /* in place of the configured adapter */
};

enum gn_part_load {
    GN_PART_LOAD_SCENE,   /* another scene is shown, or could not be */
    GN_PART_LOAD_OPTIONS, /* new options are in use, or their first load begins */
    GN_PART_LOAD_FAILED,  /* a reload has failed */
};

/* All functions may be NULL. The memory of a part begins with a `const struct gn_part_host *host`,
 * which is set before the first call; the rest is zeroed before begin and open. Neither can fail: a
 * part that cannot do its work reports a problem and does nothing until it is opened again. */
struct gn_part {
    const char *name;
    size_t size; /* of its memory */
    /* Once the options are read, before the first scene is loaded. */
    void (*begin)(void *part);
    /* Once the screen is open. */
    void (*open)(void *part);
    /* The options are others: after a reload. NULL: its settings count for the next start, or it
     * reads them at each use. */
    void (*reopen)(void *part);
    /* A load has ended so: content follows other files then. */
    void (*loaded)(void *part, enum gn_part_load what);
    /* Adds to the options that the screen is opened with. */
    void (*add_screen)(const void *part, struct gn_screen_opts *opts);

    /* A step of the kiosk: look comes after the wait, before anything has changed; step after the
     * machine's. due_ns is when the next step is due by itself; INT64_MAX: never. */
    void (*look)(void *part);
    void (*step)(void *part);
    int64_t (*due_ns)(const void *part);

    /* A frame: whether one is wanted, what it shows, and how long the drawing of it took. */
    bool (*wants_frame)(const void *part);
    void (*add_frame)(void *part, struct gn_frame_opts *opts);
    void (*drawn)(void *part, int64_t draw_ns);

    /* While a long frame is drawn, every few milliseconds; pieces and run_ns as gn_gl_pause has
     * them. False and *err: ends the frame, and the kiosk with it. */
    bool (*pause)(void *part, uint64_t pieces, int64_t run_ns, struct gn_err *err);

    /* Sets its lines of the information page, which stay valid until the next call. */
    void (*add_info)(void *part, struct gn_info *info);
    /* Sets the values of its metrics, and returns what they are in; NULL: there are none now. */
    const void *(*status)(void *part);
    const struct gn_metric *metrics;
    int metric_count;

    /* The kiosk begins to end: what takes a while can begin. */
    void (*end)(void *part);
    /* Not called if neither begin nor open were. */
    void (*close)(void *part);
};
#define GN_PART_METRICS(table) .metrics = (table), .metric_count = sizeof(table) / sizeof(table)[0]

/* Rows in the order in which they are opened, called and printed; they are closed in reverse. */
#define GN_PART_TABLE(X)                                                                           \
    X(kiosk)                                                                                       \
    X(state)                                                                                       \
    X(trial)                                                                                       \
    X(scene)                                                                                       \
    X(schedule)                                                                                    \
    X(sun)                                                                                         \
    X(television)                                                                                  \
    X(health)                                                                                      \
    X(process)                                                                                     \
    X(answers)                                                                                     \
    X(control)                                                                                     \
    X(content)                                                                                     \
    X(shaders)                                                                                     \
    X(service)                                                                                     \
    X(stats)                                                                                       \
    X(shift)

#define X(name) extern const struct gn_part gn_part_##name;
GN_PART_TABLE(X)
#undef X
enum {
#define X(name) GN_PART_##name,
    GN_PART_TABLE(X)
#undef X
        GN_PART_COUNT
};

/* ---- all parts of a kiosk: parts.c ----------------------------------------------------------- */

struct gn_parts {
    const struct gn_part *const *rows; /* GN_PART_COUNT */
    struct gn_part_host host;
    void *of[GN_PART_COUNT];
    bool is_open[GN_PART_COUNT]; /* or has begun */
};

/* Takes memory for all, once rows and host are set. */
void gn_parts_create(struct gn_parts *parts);
void gn_parts_destroy(struct gn_parts *parts); /* closes what is open */
void gn_part_open(struct gn_parts *parts, int part);
void gn_part_close(struct gn_parts *parts, int part);

/* The function of that name of each row. */
void gn_parts_begin(struct gn_parts *parts);
void gn_parts_open(struct gn_parts *parts);
void gn_parts_reopen(struct gn_parts *parts);
void gn_parts_loaded(struct gn_parts *parts, enum gn_part_load what);
void gn_parts_add_screen(const struct gn_parts *parts, struct gn_screen_opts *opts);
void gn_parts_look(struct gn_parts *parts);
void gn_parts_step(struct gn_parts *parts);
int64_t gn_parts_due_ns(const struct gn_parts *parts); /* the earliest */
bool gn_parts_want_frame(const struct gn_parts *parts);
void gn_parts_add_frame(struct gn_parts *parts, struct gn_frame_opts *opts);
void gn_parts_drawn(struct gn_parts *parts, int64_t draw_ns);
bool gn_parts_pause(struct gn_parts *parts, uint64_t pieces, int64_t run_ns, struct gn_err *err);
void gn_parts_add_info(struct gn_parts *parts, struct gn_info *info);
/* All metrics; brief: those of the reply to an action. */
json_t *gn_parts_status(struct gn_parts *parts, bool brief);
void gn_parts_end(struct gn_parts *parts);

#endif
