/* Which line of which chip is meant: by its name, or by the label of its chip and its number there.
 * The number of a chip is never asked: it changes with the kernel and from boot to boot. */
#ifndef GN_INPUT_LINE_FIND_H
#define GN_INPUT_LINE_FIND_H

#include <stdint.h>

#include "core/err.h"
#include "input/gpio.h"

struct gn_line_spec {
    char name[48]; /* of the line; "" where it has a label */
    char label[48];
    unsigned offset; /* on that chip */
};
/* "GPIO17", "label:pinctrl-rp1/17"; anything else is a usage error. */
bool gn_line_parse(const char *text, struct gn_line_spec *out, struct gn_err *err);
/* How well this line fits: 2 it is meant, 1 it is called so by other kernels for the same board, 0
 * not at all. */
int gn_line_fits(const struct gn_line_spec *spec, const struct gn_gpio_chip *chip, unsigned offset,
                 const struct gn_gpio_line *line);

struct gn_line_match {
    int fits;  /* of the best; 0: there is none */
    int count; /* of lines that fit so well */
    char path[64];
    struct gn_gpio_chip chip; /* of the first of them */
    struct gn_gpio_line line;
    unsigned offset;
    char list[200]; /* of all, for people: "gpiochip0 (pinctrl-rp1) line 17, .." */
};
struct gn_line_search { /* what was seen on the way */
    int chips, refused; /* refused: of those, not to be opened */
    int error;          /* why the last of them was not */
    char refused_path[64];
};

/* Looks through all chips of the folder ("/dev") for count lines at once. wanted[i] NULL: not that
 * one. */
void gn_line_search(const struct gn_gpio_ops *ops, void *context, const char *folder,
                    const struct gn_line_spec *const *wanted, struct gn_line_match *matches,
                    int count, struct gn_line_search *out);

/* The paths of the folder's chips, without links to others: how many, at most max, by name. */
int gn_line_list_chips(const char *folder, char (*paths)[64], int max);

#endif
