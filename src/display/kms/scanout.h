/* Pictures that a CRTC can read: a GBM device with an EGL context on it, and a surface whose
 * buffers are handed over one by one. A table of functions, so that a test can do without a GPU. */
#ifndef GN_DISPLAY_KMS_SCANOUT_H
#define GN_DISPLAY_KMS_SCANOUT_H

#include "display/display.h"

enum gn_fallback {                        /* how buffers are asked for, best first */
                   GN_FALLBACK_MODIFIERS, /* those that the plane lists */
                   GN_FALLBACK_LINEAR,    /* the modifier LINEAR alone */
                   GN_FALLBACK_PLAIN,     /* without a word about modifiers */
                   GN_FALLBACK_COPY,      /* drawn off screen and copied into a dumb buffer */
                   GN_FALLBACK_COUNT,
};

enum { GN_FORMATS_MAX = 8, GN_MODIFIERS_MAX = 64, GN_BUFFER_PLANES_MAX = 4 };

struct gn_surface_opts {
    uint32_t width_px, height_px;
    enum gn_fallback fallback;        /* never COPY */
    bool unencoded;                   /* GL shall not encode when it writes */
    uint32_t formats[GN_FORMATS_MAX]; /* DRM fourccs that the plane takes, best first */
    int format_count;
    /* Of the first of them, what the plane lists; count 0 with MODIFIERS: the rung fails. */
    uint64_t modifiers[GN_MODIFIERS_MAX];
    int modifier_count;
};
struct gn_surface {  /* what came of it */
    uint32_t format; /* of formats */
    bool srgb;       /* GL encodes when it writes */
};
struct gn_buffer { /* a finished picture */
    void *key;     /* the same key is the same memory, as long as the surface lives */
    uint32_t width_px, height_px, format;
    uint64_t modifier; /* DRM_FORMAT_MOD_INVALID: not said */
    int plane_count;
    uint32_t handles[4], strides[4], offsets[4];
};

struct gn_scanout_ops {
    /* A device on an open card, and a context that is current without a surface. NULL on failure.
     * The descriptor stays the caller's, and open until after close. A render node, if not NULL,
     * is the GPU in place of the card's own: its buffers are handed to the card. */
    void *(*open)(int card, const char *render_node, struct gn_err *err);
    gn_display_proc (*get_proc)(void *scanout, const char *name);
    /* Replaces the surface (all of the old one's buffers must have been released) and makes the new
     * one current. On failure there is none, and the context is current without. */
    bool (*set_surface)(void *scanout, const struct gn_surface_opts *opts, struct gn_surface *out,
                        struct gn_err *err);
    void (*drop_surface)(void *scanout); /* legal without one */
    /* Ends the frame and locks its buffer; *fence gets a sync file of its rendering, or -1, and is
     * the caller's to close. */
    bool (*swap)(void *scanout, bool want_fence, struct gn_buffer *out, int *fence,
                 struct gn_err *err);
    void (*release)(void *scanout, void *key); /* nobody reads it any more */
    /* A free buffer is there: drawing will not wait. */
    bool (*has_free)(void *scanout);
    void (*close)(void *scanout);
};

/* GBM and EGL, opened at run time. */
extern const struct gn_scanout_ops gn_scanout_gbm;

#endif
