/* Lines of GPIO chips as a table of functions: libgpiod 1 (gpiod1.c), libgpiod 2 (gpiod2.c),
 * neither (gpio_none.c), or a test. A level is that of the wire: whether high or low is pressed is
 * not known here. No function blocks; those that return int return 0 or an errno value unless they
 * say otherwise. */
#ifndef GN_INPUT_GPIO_H
#define GN_INPUT_GPIO_H

#include <stdbool.h>
#include <stdint.h>

enum gn_bias { GN_BIAS_PULL_UP, GN_BIAS_PULL_DOWN, GN_BIAS_NONE };

enum { GN_GPIO_EVENTS = 16 }; /* that the kernel keeps for one line: more, and some are lost */

struct gn_gpio_chip {
    char name[32];  /* "gpiochip0": for people only, it changes from boot to boot */
    char label[48]; /* "pinctrl-rp1" */
    unsigned lines;
};
struct gn_gpio_line {
    char name[48];     /* "GPIO17"; "": it has none */
    char consumer[48]; /* who uses it; "": nobody, or it is not known */
    bool used;
};
struct gn_gpio_wish {
    unsigned offset;
    enum gn_bias bias;
    int64_t debounce_ns; /* by the kernel, where the library can ask for it */
};
struct gn_gpio_event {
    int64_t time_ns; /* of the kernel, monotonic since Linux 5.7 */
    bool high;       /* the edge was a rising one */
    uint32_t seqno;  /* one more with each of the line's edges, from 1; 0: not counted */
};

struct gn_gpio_ops {
    const char *library; /* "libgpiod 1.6.3"; NULL: not in this build */
    /* Whether path is a chip, with what of its own name and label; EACCES, ENOENT, ENODEV .. */
    int (*open)(void *context, const char *path, void **chip, struct gn_gpio_chip *out);
    int (*look)(void *chip, unsigned offset, struct gn_gpio_line *out);
    /* An input that tells of both edges; "gnomon" is its consumer. EBUSY: somebody else has it;
     * EINVAL, EOPNOTSUPP and ENOTSUPP (524) perhaps for the bias. The chip may be closed after. */
    int (*request)(void *chip, const struct gn_gpio_wish *wish, void **line);
    void (*close)(void *chip);

    /* Readable: there are events, or the line is gone. To be made non-blocking by who asks. */
    int (*fd)(void *line);
    /* At most GN_GPIO_EVENTS events, in their order: how many; -errno, where -EAGAIN is 0. */
    int (*read)(void *line, struct gn_gpio_event *out);
    int (*level)(void *line, bool *high);
    void (*release)(void *line);
};

extern const struct gn_gpio_ops gn_gpio_library;

#endif
