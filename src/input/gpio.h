/* GPIO lines as a table of functions: libgpiod 1 (gpiod1.c), libgpiod 2 (gpiod2.c), none
 * (gpio_none.c), or a test's. Levels are physical: active-low is handled by the caller. No function
 * blocks; those that return int return 0 or an errno value unless stated otherwise. */
#ifndef GN_INPUT_GPIO_H
#define GN_INPUT_GPIO_H

#include <stdbool.h>
#include <stdint.h>

enum gn_bias { GN_BIAS_PULL_UP, GN_BIAS_PULL_DOWN, GN_BIAS_NONE };

enum { GN_GPIO_EVENTS = 16 }; /* kernel buffer per line; more events are lost */

struct gn_gpio_chip {
    char name[32];  /* "gpiochip0": for messages only, it differs between boots */
    char label[48]; /* "pinctrl-rp1" */
    unsigned lines;
};
struct gn_gpio_line {
    char name[48];     /* "GPIO17"; "": unnamed */
    char consumer[48]; /* current user of the line; "": none or unknown */
    bool used;
};
struct gn_gpio_wish {
    unsigned offset;
    enum gn_bias bias;
    int64_t debounce_ns; /* kernel debounce, if the library supports it */
};
struct gn_gpio_event {
    int64_t time_ns; /* kernel timestamp, monotonic since Linux 5.7 */
    bool high;       /* rising edge */
    uint32_t seqno;  /* counts the line's edges from 1; 0: not supported */
};

struct gn_gpio_ops {
    const char *library; /* "libgpiod 1.6.3"; NULL: built without */
    /* Opens a chip and reads its name and label; EACCES, ENOENT, ENODEV .. */
    int (*open)(void *context, const char *path, void **chip, struct gn_gpio_chip *out);
    int (*look)(void *chip, unsigned offset, struct gn_gpio_line *out);
    /* Requests an input with both edges and consumer "gnomon". EBUSY: in use; EINVAL, EOPNOTSUPP
     * and ENOTSUPP (524): possibly the bias. The chip may be closed afterwards. */
    int (*request)(void *chip, const struct gn_gpio_wish *wish, void **line);
    void (*close)(void *chip);

    /* Readable when there are events or the line is gone. The caller makes it non-blocking. */
    int (*fd)(void *line);
    /* Reads at most GN_GPIO_EVENTS events; returns the count or -errno, 0 for -EAGAIN. */
    int (*read)(void *line, struct gn_gpio_event *out);
    int (*level)(void *line, bool *high);
    void (*release)(void *line);
};

extern const struct gn_gpio_ops gn_gpio_library;

#endif
