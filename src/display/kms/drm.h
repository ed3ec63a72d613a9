/* The kernel's display interface as a table of functions that tests can replace: libdrm's under
 * their own names and contracts (drmModeGetCrtc is ModeGetCrtc) and a few of our own. libdrm is
 * opened at run time on first use, so that the program starts without it and names the missing
 * package. */
#ifndef GN_DISPLAY_KMS_DRM_H
#define GN_DISPLAY_KMS_DRM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#include "core/err.h"

/* Without their "drm". Ioctl is for dumb buffers and GEM_CLOSE. */
/* clang-format off */
#define GN_DRM_TABLE(X) \
    X(GetVersion) X(FreeVersion) X(GetCap) X(SetClientCap) X(IsMaster) X(SetMaster) X(DropMaster) \
    X(HandleEvent) X(CrtcGetSequence) X(Ioctl) X(ModeGetResources) X(ModeFreeResources) \
    X(ModeGetConnector) X(ModeGetConnectorCurrent) X(ModeFreeConnector) X(ModeGetEncoder) \
    X(ModeFreeEncoder) X(ModeGetCrtc) X(ModeFreeCrtc) X(ModeSetCrtc) X(ModeSetCursor) \
    X(ModePageFlip) X(ModeGetPlaneResources) X(ModeFreePlaneResources) X(ModeGetPlane) \
    X(ModeFreePlane) X(ModeObjectGetProperties) X(ModeFreeObjectProperties) X(ModeGetProperty) \
    X(ModeFreeProperty) X(ModeGetPropertyBlob) X(ModeFreePropertyBlob) X(ModeCreatePropertyBlob) \
    X(ModeDestroyPropertyBlob) X(ModeConnectorSetProperty) X(ModeAtomicAlloc) X(ModeAtomicFree) \
    X(ModeAtomicAddProperty) X(ModeAtomicCommit) X(ModeAddFB2) X(ModeAddFB2WithModifiers) \
    X(ModeRmFB)
/* clang-format on */

enum { GN_KMS_CARDS_MAX = 8 };

struct gn_kms_node {
    char path[64];  /* "/dev/dri/card1" */
    char place[96]; /* place on the board: "platform-gpu", "pci-0000:00:02.0"; or "" */
};

struct gn_drm_ops {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a type and a name */
#define X(name) __typeof__(drm##name) *name;
    GN_DRM_TABLE(X)
#undef X
    /* Lists all primary nodes; writes at most `most`, returns the count. */
    int (*list)(struct gn_kms_node *out, int most);
    /* Returns a non-blocking, close-on-exec descriptor, or -1 and errno. */
    int (*open)(const char *path);
    void (*close)(int fd);
    /* Maps a dumb buffer; NULL and errno on failure. */
    void *(*map)(int fd, uint64_t offset, size_t size);
    void (*unmap)(void *memory, size_t size);
};

/* libdrm's table; NULL with an error if it is missing. */
const struct gn_drm_ops *gn_drm_real(struct gn_err *err);

#endif
