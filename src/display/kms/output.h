/* One connector, one CRTC and its primary plane on an open card: what is committed to them, by the
 * atomic interface or by the older one, and the framebuffers that they show. Functions that return
 * int return 0 or an errno. */
#ifndef GN_DISPLAY_KMS_OUTPUT_H
#define GN_DISPLAY_KMS_OUTPUT_H

#include "display/kms/card.h"
#include "display/kms/scanout.h"

enum { GN_KMS_FBS_MAX = 16 };

enum gn_kms_connector_prop { /* names in kms/props.c */
                             GN_PROP_CONNECTOR_CRTC,
                             GN_PROP_CONNECTOR_LINK,
                             GN_PROP_CONNECTOR_DPMS,
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
    GN_PROP_PLANE_FENCE,    /* 0 where the driver has none */
    GN_PROP_PLANE_ROTATION, /* 0 where the driver has none */
    GN_PROP_PLANE_FORMATS,  /* 0 where the driver has none */
    GN_PROP_PLANE_COUNT,
};

/* Ids of an object's properties by name, 0 where there is none; values, if not NULL, likewise.
 * False: some could not be read. */
bool gn_kms_props_read(const struct gn_drm_ops *drm, int fd, uint32_t object, uint32_t type,
                       const char *const *names, int count, uint32_t *ids, uint64_t *values);
extern const char *const gn_kms_connector_props[GN_PROP_CONNECTOR_COUNT];
extern const char *const gn_kms_crtc_props[GN_PROP_CRTC_COUNT];
extern const char *const gn_kms_plane_props[GN_PROP_PLANE_COUNT];

struct gn_kms_fb {
    void *key;   /* of its buffer; NULL: of a surface that is gone */
    uint32_t id; /* 0: an empty place */
};
struct gn_kms_output {
    const struct gn_drm_ops *drm;
    int fd;
    bool atomic;
    uint32_t connector, crtc, plane; /* plane 0: not by the atomic interface */
    int crtc_index;
    uint32_t connector_props[GN_PROP_CONNECTOR_COUNT];
    uint32_t crtc_props[GN_PROP_CRTC_COUNT];
    uint32_t plane_props[GN_PROP_PLANE_COUNT];
    struct gn_kms_fb fbs[GN_KMS_FBS_MAX];
    drmModeModeInfo mode;                            /* lit with */
    enum { GN_AWAKE, GN_MAY_SLEEP, GN_ASLEEP } dpms; /* before it is lit it is woken */
    bool was_lit;                                    /* and what there was before */
    uint32_t old_fb, old_x, old_y;
    drmModeModeInfo old_mode;
};

/* Remembers what the CRTC shows, to put it back. */
bool gn_kms_output_open(struct gn_kms_output *output, const struct gn_drm_ops *drm, int fd,
                        bool legacy, const struct gn_kms_card *card, int connector, int crtc,
                        struct gn_err *err);
/* `restore`: puts the CRTC back as it was found, where that is still possible, and dark where it
 * was dark. Framebuffers go in any case. A zeroed one may be closed. */
void gn_kms_output_close(struct gn_kms_output *output, bool restore);

/* Formats and modifiers of the plane. */
void gn_kms_output_formats(const struct gn_kms_output *output, struct gn_surface_opts *out);
bool gn_kms_output_takes_fence(const struct gn_kms_output *output);

/* The framebuffer of a buffer, made once. */
int gn_kms_output_fb(struct gn_kms_output *output, const struct gn_buffer *buffer, uint32_t *out);
/* The surface is gone: its framebuffers are nobody's. They stay until another one is lit, for to
 * remove what is shown switches the CRTC off. */
void gn_kms_output_orphan_fbs(struct gn_kms_output *output);

/* A modeset, tested first; blocks until it is done. */
int gn_kms_output_light(struct gn_kms_output *output, const drmModeModeInfo *mode, uint32_t fb);
/* Does not block; an event with `user` tells of its end. The fence stays the caller's; -1: none. */
int gn_kms_output_flip(struct gn_kms_output *output, uint32_t fb, int fence, void *user);
/* Switches the CRTC off; blocks. */
int gn_kms_output_dark(struct gn_kms_output *output);
/* Switches the monitor off, to be lit again soon: mode and framebuffer stay; blocks. */
int gn_kms_output_sleep(struct gn_kms_output *output);
/* The driver tells of no refreshes. */
bool gn_kms_output_lacks_vblank(const struct gn_kms_output *output);

#endif
