/* Kernel uevents without udev: a NETLINK_KOBJECT_UEVENT socket in the kernel's multicast group. */
#ifndef GN_DISPLAY_KMS_UEVENT_H
#define GN_DISPLAY_KMS_UEVENT_H

#include <stdbool.h>
#include <stddef.h>

/* Returns a non-blocking descriptor, or -1: then only periodic scans find changes. */
int gn_uevent_open(void);
/* Reads all pending messages; true if one is about drm or some were lost. */
bool gn_uevent_read(int fd);
/* One message: zero-terminated strings. Pure. */
bool gn_uevent_is_drm(const char *message, size_t size);

#endif
