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

/* A libdrm function that frees an object precedes the one that returns it. */
#define GN_DRM_TABLE(X)                                                                            \
    X(drmGetVersion, GetVersion)                                                                   \
    X(drmFreeVersion, FreeVersion)                                                                 \
    X(drmGetCap, GetCap)                                                                           \
    X(drmSetClientCap, SetClientCap)                                                               \
    X(drmIsMaster, IsMaster)                                                                       \
    X(drmSetMaster, SetMaster)                                                                     \
    X(drmDropMaster, DropMaster)                                                                   \
    X(drmHandleEvent, HandleEvent)                                                                 \
    X(drmCrtcGetSequence, CrtcGetSequence)                                                         \
    X(drmIoctl, Ioctl) /* dumb buffers, GEM_CLOSE */                                               \
    X(drmModeGetResources, ModeGetResources)                                                       \
    X(drmModeFreeResources, ModeFreeResources)                                                     \
    X(drmModeGetConnector, ModeGetConnector)                                                       \
    X(drmModeGetConnectorCurrent, ModeGetConnectorCurrent)                                         \
    X(drmModeFreeConnector, ModeFreeConnector)                                                     \
    X(drmModeGetEncoder, ModeGetEncoder)                                                           \
    X(drmModeFreeEncoder, ModeFreeEncoder)                                                         \
    X(drmModeGetCrtc, ModeGetCrtc)                                                                 \
    X(drmModeFreeCrtc, ModeFreeCrtc)                                                               \
    X(drmModeSetCrtc, ModeSetCrtc)                                                                 \
    X(drmModeSetCursor, ModeSetCursor)                                                             \
    X(drmModePageFlip, ModePageFlip)                                                               \
    X(drmModeGetPlaneResources, ModeGetPlaneResources)                                             \
    X(drmModeFreePlaneResources, ModeFreePlaneResources)                                           \
    X(drmModeGetPlane, ModeGetPlane)                                                               \
    X(drmModeFreePlane, ModeFreePlane)                                                             \
    X(drmModeObjectGetProperties, ModeObjectGetProperties)                                         \
    X(drmModeFreeObjectProperties, ModeFreeObjectProperties)                                       \
    X(drmModeGetProperty, ModeGetProperty)                                                         \
    X(drmModeFreeProperty, ModeFreeProperty)                                                       \
    X(drmModeGetPropertyBlob, ModeGetPropertyBlob)                                                 \
    X(drmModeFreePropertyBlob, ModeFreePropertyBlob)                                               \
    X(drmModeCreatePropertyBlob, ModeCreatePropertyBlob)                                           \
    X(drmModeDestroyPropertyBlob, ModeDestroyPropertyBlob)                                         \
    X(drmModeConnectorSetProperty, ModeConnectorSetProperty)                                       \
    X(drmModeAtomicAlloc, ModeAtomicAlloc)                                                         \
    X(drmModeAtomicFree, ModeAtomicFree)                                                           \
    X(drmModeAtomicAddProperty, ModeAtomicAddProperty)                                             \
    X(drmModeAtomicCommit, ModeAtomicCommit)                                                       \
    X(drmModeAddFB2, ModeAddFB2)                                                                   \
    X(drmModeAddFB2WithModifiers, ModeAddFB2WithModifiers)                                         \
    X(drmModeRmFB, ModeRmFB)

enum { GN_KMS_CARDS_MAX = 8 };

struct gn_kms_node {
    char path[64];  /* "/dev/dri/card1" */
    char place[96]; /* place on the board: "platform-gpu", "pci-0000:00:02.0"; or "" */
};

struct gn_drm_ops {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a type and a name */
#define X(function, name) __typeof__(function) *name;
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
