#include "display/kms/dumb.h"

#include <drm_fourcc.h>
#include <errno.h>
#include <string.h>

int gn_dumb_create(struct gn_dumb *d, const struct gn_drm_ops *drm, int fd, uint32_t width_px,
                   uint32_t height_px) {
    struct drm_mode_create_dumb made = {.width = width_px, .height = height_px, .bpp = 32};
    *d = (struct gn_dumb){.width_px = width_px, .height_px = height_px};
    if (drm->Ioctl(fd, DRM_IOCTL_MODE_CREATE_DUMB, &made) != 0) return errno;
    d->handle = made.handle;
    d->stride = made.pitch;
    d->size = made.size;
    struct drm_mode_map_dumb where = {.handle = made.handle};
    const bool mapped = drm->Ioctl(fd, DRM_IOCTL_MODE_MAP_DUMB, &where) == 0 &&
                        (d->pixels = drm->map(fd, where.offset, d->size)) != NULL;
    if (!mapped) {
        const int error = errno;
        gn_dumb_destroy(d, drm, fd);
        return error;
    }
    memset(d->pixels, 0, d->size);
    return 0;
}

void gn_dumb_destroy(struct gn_dumb *d, const struct gn_drm_ops *drm, int fd) {
    struct drm_mode_destroy_dumb which = {.handle = d->handle};
    if (d->pixels) drm->unmap(d->pixels, d->size);
    if (d->handle) drm->Ioctl(fd, DRM_IOCTL_MODE_DESTROY_DUMB, &which);
    *d = (struct gn_dumb){0};
}

struct gn_buffer gn_dumb_buffer(struct gn_dumb *d) {
    return (struct gn_buffer){.key = d,
                              .width_px = d->width_px,
                              .height_px = d->height_px,
                              .format = DRM_FORMAT_XRGB8888,
                              .modifier = DRM_FORMAT_MOD_INVALID,
                              .plane_count = 1,
                              .handles = {d->handle},
                              .strides = {(uint32_t)d->stride}};
}
