/* Keys of the kernel's input devices (evdev): keyboards, remote controls, gpio-keys. Only devices
 * with a bound key are opened, and only bound keys wake us; none is grabbed, so a power key keeps
 * its function. */
#ifndef GN_INPUT_DEVICES_H
#define GN_INPUT_DEVICES_H

#include "core/loop.h"
#include "input/keys.h"
#include "input/report.h"

enum { GN_DEVICES_MAX = 16 };

struct gn_evdev_ops { /* each returns 0 or an errno value */
    /* Opens a non-blocking descriptor that reports the bound keys (GN_KEY_BYTES) with monotonic
     * times; has: all keys of the device. ENOTSUP: none of them is bound. */
    int (*open)(void *context, const char *path, const uint8_t *bound, uint8_t *has, int *fd);
    /* Reads which keys are down. */
    int (*state)(void *context, int fd, uint8_t *bits);
};
extern const struct gn_evdev_ops gn_evdev;

struct gn_device {
    int fd; /* -1: unused entry */
    struct gn_watch watch;
    struct gn_devices *all;
    bool readable; /* the descriptor became readable and was not read yet */
    char path[64];
    bool dropped; /* SYN_DROPPED: events are invalid until the next report */
    uint8_t has[GN_KEY_BYTES];
    struct gn_key_source keys;
};
struct gn_devices {
    const struct gn_evdev_ops *ops;
    void *context;
    const char *folder; /* "/dev/input" */
    struct gn_loop *loop;
    struct gn_timer *timer; /* armed when a device becomes readable */
    struct gn_keys *keys;
    struct gn_reports *reports;
    struct gn_device list[GN_DEVICES_MAX];
    int denied; /* devices without read permission in the last search */
    bool full;  /* the limit was reported */
};

void gn_devices_init(struct gn_devices *devices); /* Initialises `list`; the fields above it are set
                                                     by the caller. */
/* Opens new devices. */
void gn_devices_search(struct gn_devices *devices, int64_t now_ns);
/* Whether an open device has this key. */
bool gn_devices_have(const struct gn_devices *devices, unsigned key);

#endif
