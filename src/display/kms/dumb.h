/* Dumb buffers, written by the CPU; every card has them. */
#ifndef GN_DISPLAY_KMS_DUMB_H
#define GN_DISPLAY_KMS_DUMB_H

#include "display/kms/drm.h"
#include "display/kms/scanout.h"

struct gn_dumb { /* zeroed: no buffer */
    uint32_t width_px, height_px, handle;
    size_t stride, size; /* bytes */
    uint8_t *pixels;     /* XRGB8888, initially black */
};
/* Returns 0 or an errno. */
int gn_dumb_create(struct gn_dumb *dumb, const struct gn_drm_ops *drm, int fd, uint32_t width_px,
                   uint32_t height_px);
void gn_dumb_destroy(struct gn_dumb *dumb, const struct gn_drm_ops *drm, int fd);
struct gn_buffer gn_dumb_buffer(struct gn_dumb *dumb); /* the key is the struct's address */

#endif
