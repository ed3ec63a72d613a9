/* linux/input.h, Documentation/input/input.rst and event-codes.rst. */
#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "input/devices.h"

static int open_device(void *context, const char *path, const uint8_t *bound, uint8_t *has,
                       int *out) {
    (void)context;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return errno;
    int clock = CLOCK_MONOTONIC, error = 0;
    bool any = false;
    if (ioctl(fd, EVIOCGBIT(EV_KEY, GN_KEY_BYTES), has) < 0) error = errno;
    for (int i = 0; i < GN_KEY_BYTES; i++) any |= has[i] & bound[i];
    if (!error && !any) error = ENOTSUP;
    if (!error && ioctl(fd, EVIOCSCLOCKID, &clock)) error = errno;
    if (error) {
        close(fd);
        return error;
    }
    /* only bound keys wake us, not pointer motion or typing; kernels before 4.4 lack EVIOCSMASK */
    const uint8_t types[EV_CNT / 8] = {1u << EV_SYN | 1u << EV_KEY};
    const struct input_mask keys = {
        .type = EV_KEY, .codes_size = GN_KEY_BYTES, .codes_ptr = (uintptr_t)bound};
    const struct input_mask all = {
        .type = EV_SYN, .codes_size = sizeof types, .codes_ptr = (uintptr_t)types};
    (void)ioctl(fd, EVIOCSMASK, &keys);
    (void)ioctl(fd, EVIOCSMASK, &all);
    *out = fd;
    return 0;
}

static int read_state(void *context, int fd, uint8_t *bits) {
    (void)context;
    return ioctl(fd, EVIOCGKEY(GN_KEY_BYTES), bits) < 0 ? errno : 0;
}

const struct gn_evdev_ops gn_evdev = {.open = open_device, .state = read_state};
