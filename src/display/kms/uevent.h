/* What the kernel tells of devices that come and go, without udev: a NETLINK_KOBJECT_UEVENT socket
 * in the kernel's own group. */
#ifndef GN_DISPLAY_KMS_UEVENT_H
#define GN_DISPLAY_KMS_UEVENT_H

#include <stdbool.h>
#include <stddef.h>

/* A descriptor that does not block, or -1: then only the regular looks find what is new. */
int gn_uevent_open(void);
/* Reads all that is there; true if some of it is about displays, or if something was lost. */
bool gn_uevent_read(int fd);
/* One message: strings, each with its zero byte. Pure. */
bool gn_uevent_is_drm(const char *message, size_t size);

#endif
