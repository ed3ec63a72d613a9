/* Keys of the kernel's input devices (evdev): keyboards, remote controls, buttons that the kernel's
 * gpio-keys owns. Only devices that have a key of ours are listened to, and the kernel is asked for
 * those keys alone; none is ever grabbed, so a power key still does what it did. */
#ifndef GN_INPUT_DEVICES_H
#define GN_INPUT_DEVICES_H

#include "core/loop.h"
#include "input/keys.h"
#include "input/report.h"

enum { GN_DEVICES_MAX = 16 };

struct gn_evdev_ops { /* each returns 0 or an errno value */
    /* A descriptor that does not block and tells of these keys (GN_KEY_BYTES) with monotonic times;
     * has: the keys that it has at all. ENOTSUP: none of them is bound. */
    int (*open)(void *context, const char *path, const uint8_t *bound, uint8_t *has, int *fd);
    /* The keys that are down. */
    int (*state)(void *context, int fd, uint8_t *bits);
};
extern const struct gn_evdev_ops gn_evdev;

struct gn_device {
    int fd; /* -1: the place is free */
    struct gn_watch watch;
    struct gn_devices *all;
    bool readable; /* since it was read */
    char path[64];
    bool dropped; /* events were lost: until the next report they mean nothing */
    uint8_t has[GN_KEY_BYTES];
    struct gn_key_source keys;
};
struct gn_devices {
    const struct gn_evdev_ops *ops;
    void *context;
    const char *folder; /* "/dev/input" */
    struct gn_loop *loop;
    struct gn_timer *timer; /* made due by a device that is readable */
    struct gn_keys *keys;
    struct gn_reports *reports;
    struct gn_device list[GN_DEVICES_MAX];
    int denied; /* devices that could not be opened for want of permission, at the last search */
    bool full;  /* and that was said */
};

void gn_devices_init(struct gn_devices *devices); /* the fields above list are set */
void gn_devices_finish(struct gn_devices *devices);
/* Opens those that are new. */
void gn_devices_search(struct gn_devices *devices, int64_t now_ns);
/* One of those that are open has this key. */
bool gn_devices_have(const struct gn_devices *devices, unsigned key);
/* Reads all that there is from those that are readable; true: one is gone, and a search is due. */
bool gn_devices_read(struct gn_devices *devices, int64_t now_ns);

#endif
