/* One connector, CRTC and primary plane of an open card: commits, atomic or legacy, and
 * framebuffers. Functions that return int return 0 or an errno. */
#ifndef GN_DISPLAY_KMS_OUTPUT_H
#define GN_DISPLAY_KMS_OUTPUT_H

#include "display/kms/card.h"
#include "display/kms/scanout.h"

enum { GN_KMS_FBS_MAX = 16 };

enum gn_kms_connector_prop { /* names are in kms/props.c */
                             GN_PROP_CONNECTOR_CRTC,
                             GN_PROP_CONNECTOR_LINK,
                             GN_PROP_CONNECTOR_DPMS,
                             GN_PROP_CONNECTOR_RANGE, /* optional */
                             GN_PROP_CONNECTOR_COUNT,
};
enum gn_kms_crtc_prop { GN_PROP_CRTC_ACTIVE, GN_PROP_CRTC_MODE, GN_PROP_CRTC_COUNT };
enum gn_kms_plane_prop {
    GN_PROP_PLANE_TYPE,
    GN_PROP_PLANE_FB,
    GN_PROP_PLANE_CRTC,
    GN_PROP_PLANE_SRC_X,
    GN_PROP_PLANE_SRC_Y,
    GN_PROP_PLANE_SRC_W,
    GN_PROP_PLANE_SRC_H,
    GN_PROP_PLANE_X,
    GN_PROP_PLANE_Y,
    GN_PROP_PLANE_W,
    GN_PROP_PLANE_H,
    GN_PROP_PLANE_FENCE,    /* optional: id 0 if missing */
    GN_PROP_PLANE_ROTATION, /* optional */
    GN_PROP_PLANE_FORMATS,  /* optional */
    GN_PROP_PLANE_COUNT,
};

/* Reads ids, and values unless NULL, of an object's properties by name; id 0 for missing ones.
 * False: some could not be read. */
bool gn_kms_props_read(const struct gn_drm_ops *drm, int fd, uint32_t object, uint32_t type,
                       const char *const *names, int count, uint32_t *ids, uint64_t *values);
/* The value of an enumerated property whose name begins so. False: it has none, or is 0. */
bool gn_kms_prop_value(const struct gn_drm_ops *drm, int fd, uint32_t prop, const char *start,
                       uint64_t *out);
extern const char *const gn_kms_connector_props[GN_PROP_CONNECTOR_COUNT];
extern const char *const gn_kms_crtc_props[GN_PROP_CRTC_COUNT];
extern const char *const gn_kms_plane_props[GN_PROP_PLANE_COUNT];

struct gn_kms_fb {
    void *key;   /* of its buffer; NULL: its surface is gone */
    uint32_t id; /* 0: unused entry */
};
struct gn_kms_output {
    const struct gn_drm_ops *drm;
    int fd;
    bool atomic;
    uint32_t connector, crtc, plane; /* plane 0: legacy interface */
    int crtc_index;
    uint32_t connector_props[GN_PROP_CONNECTOR_COUNT];
    uint32_t crtc_props[GN_PROP_CRTC_COUNT];
    uint32_t plane_props[GN_PROP_PLANE_COUNT];
    struct gn_kms_fb fbs[GN_KMS_FBS_MAX];
    drmModeModeInfo mode; /* current mode */
    struct gn_kms_range {
        bool is_set; /* `value` goes out with each modeset */
        bool lacks;  /* one was asked for that the connector does not have */
        uint64_t value, old;
    } range;
    enum { GN_AWAKE, GN_MAY_SLEEP, GN_ASLEEP } dpms; /* woken before the modeset */
    bool was_lit;                                    /* state before it was opened */
    uint32_t old_fb, old_x, old_y;
    drmModeModeInfo old_mode;
};

/* Saves the state of the CRTC so that close can restore it. */
bool gn_kms_output_open(struct gn_kms_output *output, const struct gn_drm_ops *drm, int fd,
                        bool legacy, const struct gn_kms_card *card, int connector, int crtc,
                        struct gn_err *err);
/* `restore` puts the CRTC back into its old state, if still possible. Framebuffers are removed in
 * any case. A zeroed struct may be closed. */
void gn_kms_output_close(struct gn_kms_output *output, bool restore);

/* From the next modeset on. Where the connector cannot do that it stays as it is. */
void gn_kms_output_set_range(struct gn_kms_output *output, enum gn_screen_range range);

/* Reads the plane's formats and modifiers. */
void gn_kms_output_formats(const struct gn_kms_output *output, struct gn_surface_opts *out);
bool gn_kms_output_takes_fence(const struct gn_kms_output *output);

/* Returns the framebuffer of a buffer, created on first use. */
int gn_kms_output_fb(struct gn_kms_output *output, const struct gn_buffer *buffer, uint32_t *out);
/* The surface is gone. Its framebuffers stay until the next modeset, since removing a visible one
 * would switch the CRTC off. */
void gn_kms_output_orphan_fbs(struct gn_kms_output *output);

struct gn_kms_part { /* of a framebuffer, its lower left; 0 x 0: all */
    uint32_t width_px, height_px;
};
struct gn_kms_flip { /* what is shown next */
    uint32_t fb;
    struct gn_kms_part part; /* scaled to the mode's size; atomic only */
    int fence;               /* borrowed; -1: none */
    void *user;              /* of the event when it is complete; NULL: none comes */
};
/* Sets a mode, testing it first; blocks. No fence, no event. */
int gn_kms_output_light(struct gn_kms_output *output, const drmModeModeInfo *mode,
                        const struct gn_kms_flip *flip);
/* Non-blocking. */
int gn_kms_output_flip(struct gn_kms_output *output, const struct gn_kms_flip *flip);
/* Whether that could be flipped to; changes nothing. */
int gn_kms_output_test(struct gn_kms_output *output, const struct gn_kms_flip *flip);
/* Switches the CRTC off; blocks. */
int gn_kms_output_dark(struct gn_kms_output *output);
/* Switches the monitor off, keeping mode and framebuffer; blocks. */
int gn_kms_output_sleep(struct gn_kms_output *output);
/* The driver reports no vblanks. */
bool gn_kms_output_lacks_vblank(const struct gn_kms_output *output);

#endif
