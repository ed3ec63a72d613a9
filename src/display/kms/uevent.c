#include "display/kms/uevent.h"

#include <errno.h>
#include <linux/netlink.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { FROM_KERNEL = 1 }; /* multicast group 1; udevd uses group 2 */

int gn_uevent_open(void) {
    struct sockaddr_nl address = {.nl_family = AF_NETLINK, .nl_groups = FROM_KERNEL};
    int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_KOBJECT_UEVENT);
    if (fd < 0) return -1;
    if (bind(fd, (struct sockaddr *)&address, sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

bool gn_uevent_is_drm(const char *message, size_t size) {
    static const char wanted[] = "SUBSYSTEM=drm";
    for (size_t at = 0; at < size;) {
        const size_t length = strnlen(message + at, size - at);
        if (length == sizeof wanted - 1 && memcmp(message + at, wanted, length) == 0) return true;
        at += length + 1;
    }
    return false;
}

bool gn_uevent_read(int fd) {
    bool found = false;
    for (;;) {
        char message[8192];
        struct sockaddr_nl from = {0};
        socklen_t length = sizeof from;
        const ssize_t size =
            recvfrom(fd, message, sizeof message, 0, (struct sockaddr *)&from, &length);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0 && errno == ENOBUFS) { /* queue overflow: messages were dropped */
            found = true;
            continue;
        }
        if (size < 0) return found;
        /* any process may send to a netlink socket; the kernel's port is 0 */
        if (length == sizeof from && from.nl_pid == 0)
            found |= gn_uevent_is_drm(message, (size_t)size);
    }
}
