/* Displays behind one vtable: a row and a file add one. A display owns the GL context and makes it
 * current in the thread that opened it. Opened as a screen it also shows frames; it survives the
 * loss of monitors and cards, and never blocks the program. */
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
    struct gn_loop *loop;             /* required: the screen adds its descriptors and timers */
    uint32_t width_px, height_px;     /* headless screen: 1280 x 720 */
    const char *connector;            /* "HDMI-A-1"; any connected one */
    const char *card;                 /* "platform-gpu-card", as in /dev/dri/by-path; any */
    const char *render_node;          /* "/dev/dri/renderD129", another GPU; the card's own */
    const char *modeline;             /* xorg.conf syntax without a name; none */
    uint32_t mode_width, mode_height; /* the current mode, else the preferred one within the cap */
    double mode_hz;                   /* any */
    uint32_t cap_width, cap_height;   /* 1920 x 1080: limit of modes not configured, in size */
    double cap_hz;                    /* and in pixel rate: that size at 60 Hz */
    unsigned rotate_deg; /* 0, 90, 180, 270, clockwise; added to the panel's orientation */
    unsigned max_fps;    /* the mode's rate */
    bool unencoded;      /* no sRGB encoding in the window's framebuffer */
    bool locks_keys;     /* no key leads away from the text console that it was started on */
    bool legacy;         /* legacy page flips even if atomic is available */
    enum gn_screen_range {
        GN_RANGE_AUTO, /* as the driver and the monitor agree */
        GN_RANGE_FULL,
        GN_RANGE_LIMITED, /* 16 to 235, as televisions have it */
    } range;              /* of the signal's levels; the driver's */
    int64_t again_ns;     /* interval of flips while nothing changes; 10 s */
};

/* Counters since the screen was opened. */
struct gn_screen_counts {
    uint64_t shown;   /* completed flips, repeated frames included */
    uint64_t again;   /* of them, repeats of the same frame */
    uint64_t missed;  /* refreshes missed while a frame was in flight */
    uint64_t retried; /* commits refused temporarily (EBUSY, ENOMEM) */
    uint64_t stalled; /* flips not completed in time (250 ms) */
    uint64_t relit;   /* modesets, including the first */
    uint64_t opened;  /* cards opened */
};

/* State of a screen: plain data, changed only by the functions below. */
struct gn_screen {
    bool has_context;    /* a GL context is current; false: no usable card */
    bool lost;           /* the context is lost: call gn_display_renew() */
    uint32_t generation; /* of the context: changes when it is recreated */
    bool blank;          /* switched off by gn_display_blank(), so not lit */
    bool black;          /* blanking by a black frame only: draw one when may_draw */
    bool lit;            /* frames are visible */
    bool may_draw; /* none is in flight: begin and present are due; the first lights the screen */
    bool damaged; /* the last frame is gone or has another size: draw again even if nothing changed;
                     cleared by begin */
    struct gn_pointer pointer;    /* accumulated input; the reader zeroes it */
    uint32_t width_px, height_px; /* of the framebuffer; 0: nothing to draw to */
    unsigned rotate_deg;          /* 0, 90, 180, 270: draw rotated clockwise by this */
    bool srgb;                    /* the window's framebuffer is sRGB, single-sampled */
    uint8_t *copy_to;   /* not NULL between begin and present: draw off screen and copy here as
                           XRGB8888, top row first */
    size_t copy_stride; /* bytes */
    enum gn_screen_range range; /* of its levels, as it was set; automatic: it was not set */
    bool lacks_range;           /* one is asked for that its connector cannot be set to */
    int64_t period_ns;          /* refresh interval */
    int64_t
        seen_ns; /* monotonic: when a frame begun now becomes visible, as of the last dispatch */
    struct gn_screen_counts counts;
    char what[80];    /* "HDMI-A-1 1920x1080@60.00 atomic"; "": nothing shown */
    char status[160]; /* one line: why nothing is shown; "" while shown */
};

/* ---- the table ----------------------------------------------------------------------------- */

/* Rows of the displays, each in a file that defines gn_display_FILE. The name is that of --backend;
 * "auto" tries them in this order. */
#define GN_DISPLAY_TABLE(X)                                                                        \
    X(surfaceless, "egl")                                                                          \
    X(osmesa, "osmesa")                                                                            \
    X(kms, "kms")                                                                                  \
    X(window, "window")

struct gn_display_ops {
    const char *name; /* as in the table */
    const char *what; /* description for doctor */
    bool desktop;     /* desktop GL context that accepts ES 3.0 shaders */
    bool is_window;   /* on a desktop: only its own keys are read */
    bool is_console;  /* full screen: keys are read from input devices */
    bool (*open)(struct gn_display *display, struct gn_warnings *warnings,
                 struct gn_err *err); /* makes a context current */
    gn_display_proc (*get_proc)(struct gn_display *display, const char *name);
    void (*close)(struct gn_display *display);
    const struct gn_screen_ops *screen; /* NULL: headless */
};
/* Shown where GL does not start: for whoever stands before the screen. */
#define GN_DISPLAY_NO_GL "Out of order: no graphics. \"gnomon doctor\" shows why."

struct gn_screen_ops { /* see the functions of the same names */
    bool (*open)(struct gn_display *display, const struct gn_screen_opts *opts, int64_t now_ns,
                 struct gn_warnings *warnings, struct gn_err *err);
    bool (*dispatch)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*renew)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*begin)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*present)(struct gn_display *display, int64_t now_ns, struct gn_err *err);
    bool (*scale)(struct gn_display *display, uint32_t width_px,
                  uint32_t height_px);                        /* NULL: it cannot */
    void (*lose)(struct gn_display *display, int64_t now_ns); /* NULL: unsupported */
    void (*blank)(struct gn_display *display, bool on, int64_t now_ns);
    bool (*show_message)(struct gn_display *display, const char *text,
                         int64_t now_ns);                             /* NULL: unsupported */
    bool (*is_free)(void);                                            /* NULL: always */
    void (*set_title)(struct gn_display *display, const char *title); /* NULL: it has none */
};
struct gn_display {
    const struct gn_display_ops *ops;
    void *state;             /* private to ops */
    struct gn_screen screen; /* all zero where it is none */
    void *headless;          /* private: the headless screen */
};

/* NULL-terminated. One whose library was missing at build time fails to open. */
extern const struct gn_display_ops *const gn_displays[];

/* Opens by name ("auto": the first that opens). */
bool gn_display_open(struct gn_display *display, const char *name, struct gn_warnings *warnings,
                     struct gn_err *err);
gn_display_proc gn_display_get_proc(void *display, const char *name); /* for gn_gl_opts */
/* Version and vendor of the EGL that made the current context, "1.5 Mesa Project"; "": none did. */
void gn_display_describe_egl(struct gn_display *display, char *out, size_t size);
void gn_display_close(struct gn_display *display); /* a zeroed one may be closed */

/* Opens by name as a screen ("auto": KMS). Succeeds without card or monitor: see `lost`, `lit` and
 * `status`. The options and their texts are copied. */
bool gn_display_open_screen(struct gn_display *display, const char *name,
                            const struct gn_screen_opts *opts, int64_t now_ns,
                            struct gn_warnings *warnings, struct gn_err *err);
/* Call after each step of the loop: handles ready descriptors and updates the screen to now_ns.
 * Does not block, except for a modeset (up to a tenth of a second). Fails when recovery is
 * impossible (exit status 70: restart the process). */
bool gn_display_dispatch(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* Replaces a `lost` context, if there is a card. Objects of the old one must be destroyed first.
 * Fails as dispatch does. */
bool gn_display_renew(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* Makes the window's framebuffer GL's framebuffer 0. Call when may_draw; false with an empty err:
 * draw later. */
bool gn_display_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* Between begin and present: the frame fills only the lower left part of the framebuffer, of that
 * size, which the display scales to the whole screen. False: it cannot; draw all of it. */
bool gn_display_scale(struct gn_display *display, uint32_t width_px, uint32_t height_px);
/* Submits the frame without waiting. Commits refused temporarily are retried. Fails as dispatch
 * does. */
bool gn_display_present(struct gn_display *display, int64_t now_ns, struct gn_err *err);
/* Reports a context lost by GL: the screen becomes `lost`. False: it cannot be recreated. */
bool gn_display_lose(struct gn_display *display, int64_t now_ns);
/* Switches the screen off or on; switching on shows the last frame at once, if it still exists.
 * Nothing is drawn while off, except one black frame if `black`. Blocks as a modeset does. */
void gn_display_blank(struct gn_display *display, bool on, int64_t now_ns);
/* Shows a text instead of frames, without GL, until the context changes or NULL ends it; if GL does
 * not start, the reason is shown instead. False: unsupported. */
bool gn_display_show_message(struct gn_display *display, const char *text, int64_t now_ns);
/* The window's title, copied; no effect on other screens. */
void gn_display_set_title(struct gn_display *display, const char *title);
/* Whether that screen could be shown now: a monitor is connected and no other process has it. */
bool gn_display_is_free(const char *name);
/* The first other process that has a device open, as "Xorg (pid 612)"; "" and false if none is
 * visible to this user. */
bool gn_display_holder(const char *path, char *out, size_t size);

#endif
