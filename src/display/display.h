/* Where pictures go, behind one vtable: a row and a file add one. A display owns the GL context and
 * makes it current in the thread that opened it. One that is asked to be a screen also shows what
 * is drawn; screens come and go while the program runs, and never block it. */
#ifndef GN_DISPLAY_DISPLAY_H
#define GN_DISPLAY_DISPLAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"
#include "core/loop.h"
#include "core/warn.h"
#include "display/pointer.h"

typedef void (*gn_display_proc)(void);
struct gn_display;

/* ---- screens ------------------------------------------------------------------------------- */

struct gn_screen_opts {               /* zero means the default written beside */
    struct gn_loop *loop;             /* not NULL: the screen adds its descriptors and timers */
    uint32_t width_px, height_px;     /* of a screen that nobody sees: 1280 x 720 */
    const char *connector;            /* "HDMI-A-1"; any that is connected */
    const char *card;                 /* "platform-gpu-card", as in /dev/dri/by-path; any */
    const char *render_node;          /* "/dev/dri/renderD129": the GPU; the card's own */
    const char *modeline;             /* as in an xorg.conf, without its name; none */
    uint32_t mode_width, mode_height; /* the current mode, else the preferred within the cap */
    double mode_hz;                   /* any */
    uint32_t cap_width, cap_height;   /* 1920 x 1080: what is chosen unasked is no larger, */
    double cap_hz;                    /* nor has more pixels a second than that at 60 */
    unsigned rotate_deg;              /* 0, 90, 180, 270, clockwise; beside what the panel says */
    unsigned max_fps;                 /* the mode's rate */
    bool unencoded;                   /* the window's framebuffer shall not encode */
    bool legacy;                      /* page flips by the old interface even where atomic is */
    int64_t again_ns;                 /* a still picture is flipped again this often; 10 s */
};

/* Counters since the screen was opened. */
struct gn_screen_counts {
    uint64_t shown;   /* flips that the screen has told of, those of the same picture too */
    uint64_t again;   /* of them, the same picture once more */
    uint64_t missed;  /* refreshes that went by while a frame was on its way */
    uint64_t retried; /* flips that the kernel refused for the moment (EBUSY, ENOMEM) */
    uint64_t stalled; /* flips that were not told of in time (250 ms) */
    uint64_t relit;   /* modesets, the first one too */
    uint64_t opened;  /* cards opened */
};

/* What a screen is now: plain data that changes only inside the functions below. */
struct gn_screen {
    bool has_context;    /* a GL context is current; without, there is no card to draw with */
    bool lost;           /* the context is of no use any more: gn_display_renew() */
    uint32_t generation; /* of the context: another number, another context */
    bool blank;          /* switched off by gn_display_blank(): not lit, as it should be */
    bool black;          /* and it can only be black: that is the picture due when may_draw */
    bool lit;            /* somebody may see it */
    bool may_draw;       /* lit, and no frame is on its way: begin and present are due */
    bool damaged;        /* what it showed last is gone, or of another size: draw a still picture
                            again; begin ends it */
    struct gn_pointer pointer; /* what somebody did there, added up; whoever reads it zeroes it */
    uint32_t width_px, height_px; /* of what is drawn to; 0 while not lit */
    unsigned rotate_deg;          /* 0, 90, 180, 270: the picture is drawn turned clockwise by it */
    bool srgb;                    /* the window's framebuffer encodes; it has one sample a pixel */
    uint8_t *copy_to;             /* not NULL between begin and present: the picture is drawn off
                                     screen, and copied there as XRGB8888, top row first */
    size_t copy_stride;           /* bytes */
    int64_t period_ns;            /* between two refreshes */
    int64_t seen_ns;              /* monotonic: when a frame that is begun now will be seen */
    struct gn_screen_counts counts;
    char what[80];    /* "HDMI-A-1 1920x1080@60.00 atomic"; "" while there is nothing */
    char status[160]; /* what it waits for, one line; "" while it shows */
};

/* ---- the table ----------------------------------------------------------------------------- */

/* One row and one file add a display, which defines gn_display_FILE. The name is that of --backend;
 * the order is the one in which "auto" tries them. */
#define GN_DISPLAY_TABLE(X)                                                                        \
    X(surfaceless, "egl")                                                                          \
    X(osmesa, "osmesa")                                                                            \
    X(kms, "kms")                                                                                  \
    X(window, "window")

struct gn_display_ops {
    const char *name; /* as in the table */
    const char *what; /* one line for doctor */
    bool desktop;     /* its context is desktop GL that reads ES 3.0 shaders */
    bool is_window;   /* on a desktop: it has keys of its own, others are not read */
    bool is_console;  /* it owns a whole screen: keys are read from input devices */
    bool (*open)(struct gn_display *display, struct gn_warnings *warnings,
                 struct gn_err *err); /* makes a context current; NULL: it is only a screen */
    gn_display_proc (*get_proc)(struct gn_display *display, const char *name);
    void (*close)(struct gn_display *display);
    const struct gn_screen_ops *screen; /* NULL: as a screen it is one that nobody sees */
};
struct gn_screen_ops { /* see the functions of the same names */
    bool (*open)(struct gn_display *display, const struct gn_screen_opts *opts, int64_t now_ns,
                 struct gn_warnings *warnings, struct gn_err *err);
    bool (*dispatch)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*renew)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*begin)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*present)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    void (*lose)(struct gn_display *display, int64_t now_ns); /* NULL: cannot */
    void (*blank)(struct gn_display *display, bool on, int64_t now_ns);
    bool (*show_message)(struct gn_display *display, const char *text,
                         int64_t now_ns); /* NULL: cannot */
    bool (*is_free)(void);                /* NULL: always */
};
struct gn_display {
    const struct gn_display_ops *ops;
    void *state;             /* private to ops */
    struct gn_screen screen; /* all zero where it is none */
    void *headless;          /* private: of a screen that nobody sees */
};

/* The table's; NULL ends. One whose library is missing in this build fails to open. */
extern const struct gn_display_ops *const gn_displays[];

/* Opens by name ("auto": the first that opens). A name that exists but was not built in says so. */
bool gn_display_open(struct gn_display *display, const char *name, struct gn_warnings *warnings,
                     struct gn_err *err);
gn_display_proc gn_display_get_proc(void *display, const char *name); /* for gn_gl_opts */
void gn_display_close(struct gn_display *display); /* a zeroed one may be closed */

/* Opens by name as a screen ("auto": KMS). Succeeds without card or monitor: it then waits, see
 * `lost`, `lit` and `status`. What the options name must outlive the display. */
bool gn_display_open_screen(struct gn_display *display, const char *name,
                            const struct gn_screen_opts *opts, int64_t now_ns,
                            struct gn_warnings *warnings, struct gn_err *err);
/* To be called after each step of the loop: handles what became ready in it, and brings the screen
 * up to now_ns. Never blocks, but that lighting a monitor takes the kernel up to a
 * tenth of a second. False: it gave up for good (status 70: a new process may do better). */
bool gn_display_dispatch(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* After all that lives in the old context is destroyed: ends it, and makes another where there is a
 * card. To be called when `lost`. Fails as dispatch does. */
bool gn_display_renew(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* Makes the window's framebuffer the one that GL calls 0. To be called when may_draw; false with an
 * empty err: not now after all. */
bool gn_display_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* Sends what was drawn on its way. Never waits for it. Fails as dispatch does; what the kernel
 * refuses is tried again by itself. */
bool gn_display_present(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* GL says that its context is of no use any more: from now on the screen is `lost`. False: there is
 * no other context to be had. */
bool gn_display_lose(struct gn_display *display, int64_t now_ns);
/* Switches the screen off, or on again; on comes with the last picture at once, where it is still
 * there. Nothing is drawn while it is off, but one black picture where `black`; monitors, consoles
 * and contexts may come and go. Blocks as lighting does. */
void gn_display_blank(struct gn_display *display, bool on, int64_t now_ns);
/* Shows a text in place of pictures, without GL, from now on until the context is another, or until
 * NULL ends it; where GL does not start, the reason is shown instead. False: this screen cannot. */
bool gn_display_show_message(struct gn_display *display, const char *text, int64_t now_ns);
/* The screen of that name could be seen now: there is a monitor, and nobody else has it. */
bool gn_display_is_free(const char *name);
/* The first other process that has a device open, as "Xorg (pid 612)"; "" and false: none that this
 * user may see. */
bool gn_display_holder(const char *path, char *out, size_t size);

#endif
