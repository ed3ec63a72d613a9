/* The kernel's input devices (evdev): keys of keyboards, remote controls, gpio-keys; knobs, whose
 * clicks are the keys "knob_left" and "knob_right"; touch screens and mice. Only devices with a
 * bound key or a wanted pointer are opened, and only what is wanted of them wakes us; none is
 * grabbed, so a power key keeps its function. */
#ifndef GN_INPUT_DEVICES_H
#define GN_INPUT_DEVICES_H

#include "core/loop.h"
#include "input/input.h"
#include "input/keys.h"
#include "input/report.h"
#include "input/touch.h"

enum { GN_DEVICES_MAX = 16 };

struct gn_evdev_wish {
    const uint8_t *bound; /* keys: GN_KEY_BYTES */
    enum gn_pointers pointers;
};
struct gn_evdev_found {
    int fd;
    uint8_t has[GN_KEY_BYTES];  /* all keys of the device */
    struct gn_touch_opts touch; /* kind GN_TOUCH_NONE: no pointer, or not wanted */
    bool is_knob;               /* and one is bound: `has` has its two keys */
    char name[80];
};
struct gn_evdev_ops { /* each returns 0 or an errno value */
    /* Opens a non-blocking descriptor that reports what is wanted with monotonic times. ENOTSUP:
     * the device has nothing of it. */
    int (*open)(void *context, const char *path, const struct gn_evdev_wish *wish,
                struct gn_evdev_found *out);
    /* Reads which keys are down (GN_KEY_BYTES); touch: where fingers are, and buttons. */
    int (*state)(void *context, int fd, uint8_t *bits);
    int (*touch)(void *context, int fd, const struct gn_touch_opts *opts,
                 struct gn_touch_state *out);
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
    bool is_knob;
    struct gn_key_source keys;
    struct gn_touch touch; /* zeroed: it is none */
};
struct gn_devices {
    const struct gn_evdev_ops *ops;
    void *context;
    const char *folder; /* "/dev/input" */
    struct gn_loop *loop;
    struct gn_timer *timer; /* armed when a device becomes readable */
    struct gn_keys *keys;
    struct gn_reports *reports;
    enum gn_pointers pointers; /* that are opened, too */
    unsigned touch_rotate_deg; /* as in gn_touch_opts */
    bool suppresses_taps;      /* a touch that begins now never becomes a tap */
    struct gn_device list[GN_DEVICES_MAX];
    struct gn_touch_moves glass, mouse; /* of all devices, since they were taken */
    int denied;                         /* devices without read permission in the last search */
    bool full;                          /* the limit was reported */
};

void gn_devices_init(struct gn_devices *devices); /* Initialises `list`; the fields above it are set
                                                     by the caller. */
/* Opens new devices. */
void gn_devices_search(struct gn_devices *devices, int64_t now_ns);
/* Whether an open device has this key. */
bool gn_devices_have(const struct gn_devices *devices, unsigned key);
/* Whether a finger or a button of a mouse is down. */
bool gn_devices_are_held(const struct gn_devices *devices, int64_t now_ns);
/* The number of open touch screens and mice. */
int gn_devices_pointers(const struct gn_devices *devices);

#endif
