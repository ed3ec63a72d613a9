/* The kernel's display interface as a table of functions, so that a test can be the kernel: those
 * of libdrm by their own names and with their own contracts (drmModeGetCrtc is ModeGetCrtc), and a
 * few of ours. The real table is filled when it is first asked for; libdrm is opened at run time,
 * so that the program starts, and says what to install, where it is missing. */
#ifndef GN_DISPLAY_KMS_DRM_H
#define GN_DISPLAY_KMS_DRM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#include "core/err.h"

/* What is freed by a function of libdrm's stands before that function. */
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
    char place[96]; /* where it is on the board: "platform-gpu", "pci-0000:00:02.0"; or "" */
};

struct gn_drm_ops {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a type and a name */
#define X(function, name) __typeof__(function) *name;
    GN_DRM_TABLE(X)
#undef X
    /* All primary nodes, whatever they can do; at most `most` are written, the count is returned.
     */
    int (*list)(struct gn_kms_node *out, int most);
    /* A descriptor that does not block and is not inherited, or -1 and errno. */
    int (*open)(const char *path);
    void (*close)(int fd);
    /* Memory of a dumb buffer, or NULL and errno. */
    void *(*map)(int fd, uint64_t offset, size_t size);
    void (*unmap)(void *memory, size_t size);
};

/* The kernel's; NULL where libdrm is missing: err says what to install. */
const struct gn_drm_ops *gn_drm_real(struct gn_err *err);

#endif
