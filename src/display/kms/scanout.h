/* Buffers a CRTC can scan out: a GBM device with an EGL context, and a surface whose buffers are
 * locked one at a time. A table of functions, so that tests need no GPU. */
#ifndef GN_DISPLAY_KMS_SCANOUT_H
#define GN_DISPLAY_KMS_SCANOUT_H

#include "display/display.h"

enum gn_fallback {                        /* how buffers are allocated, best first */
                   GN_FALLBACK_MODIFIERS, /* modifiers listed by the plane */
                   GN_FALLBACK_LINEAR,    /* DRM_FORMAT_MOD_LINEAR only */
                   GN_FALLBACK_PLAIN,     /* no modifiers */
                   GN_FALLBACK_COPY,      /* rendered off screen, copied to a dumb buffer */
                   GN_FALLBACK_COUNT,
};

enum { GN_FORMATS_MAX = 8, GN_MODIFIERS_MAX = 64, GN_BUFFER_PLANES_MAX = 4 };

struct gn_surface_opts {
    uint32_t width_px, height_px;
    enum gn_fallback fallback;        /* set_surface() never gets COPY */
    bool unencoded;                   /* GL must not encode on write */
    uint32_t formats[GN_FORMATS_MAX]; /* DRM fourccs of the plane, best first */
    int format_count;
    /* The plane's modifiers for the first format; with none of them MODIFIERS fails. */
    uint64_t modifiers[GN_MODIFIERS_MAX];
    int modifier_count;
};
struct gn_surface {  /* the surface created */
    uint32_t format; /* one of opts.formats */
    bool srgb;       /* GL encodes on write */
};
struct gn_buffer { /* a finished frame */
    void *key;     /* identifies the memory for the surface's lifetime */
    uint32_t width_px, height_px, format;
    uint64_t modifier; /* DRM_FORMAT_MOD_INVALID: implicit */
    int plane_count;
    uint32_t handles[4], strides[4], offsets[4];
};

struct gn_scanout_ops {
    /* Opens a device on an open card and makes a surfaceless context current. NULL on failure.
     * Borrows the descriptor, which must stay open until close. A render node, if not NULL, selects
     * another GPU, whose buffers are imported by the card. */
    void *(*open)(int card, const char *render_node, struct gn_err *err);
    gn_display_proc (*get_proc)(void *scanout, const char *name);
    /* Replaces the surface (all buffers of the old one must be released) and makes it current. On
     * failure there is no surface and the context is current without one. */
    bool (*set_surface)(void *scanout, const struct gn_surface_opts *opts, struct gn_surface *out,
                        struct gn_err *err);
    void (*drop_surface)(void *scanout); /* legal without a surface */
    /* Ends the frame and locks its buffer. *fence is a sync file of its rendering for the caller to
     * close, or -1. */
    bool (*swap)(void *scanout, bool want_fence, struct gn_buffer *out, int *fence,
                 struct gn_err *err);
    void (*release)(void *scanout, void *key); /* the buffer is no longer scanned out */
    /* A buffer is free: drawing will not block. */
    bool (*has_free)(void *scanout);
    void (*close)(void *scanout);
};

/* GBM and EGL, opened at run time. */
extern const struct gn_scanout_ops gn_scanout_gbm;

#endif
