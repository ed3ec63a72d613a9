/* Built without libgpiod. */
#include <errno.h>

#include "input/gpio.h"

static int no_open(void *context, const char *path, void **chip, struct gn_gpio_chip *out) {
    (void)context;
    (void)path;
    (void)chip;
    (void)out;
    return ENOSYS;
}

const struct gn_gpio_ops gn_gpio_library = {.open = no_open};
