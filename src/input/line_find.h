/* Finds a GPIO line by its name, or by its chip's label and offset. Chip numbers are not used: they
 * differ between kernels and boots. */
#ifndef GN_INPUT_LINE_FIND_H
#define GN_INPUT_LINE_FIND_H

#include "core/err.h"
#include "input/gpio.h"

struct gn_line_spec {
    char name[48]; /* line name; "" if it has a label */
    char label[48];
    unsigned offset; /* offset on that chip */
};
/* Parses "GPIO17" or "label:pinctrl-rp1/17"; anything else is a usage error. */
bool gn_line_parse(const char *text, struct gn_line_spec *out, struct gn_err *err);

struct gn_line_match {
    int fits;  /* match of the best; 0: none */
    int count; /* number of lines with that match */
    char path[64];
    struct gn_gpio_chip chip; /* chip of the first of them */
    struct gn_gpio_line line;
    unsigned offset;
    char list[200]; /* all of them, for messages: "gpiochip0 (pinctrl-rp1) line 17, .." */
};
struct gn_line_search { /* statistics of the search */
    int chips, refused; /* refused: chips that could not be opened */
    int error;          /* errno of the last refusal */
    char refused_path[64];
};

/* Searches all chips of the folder ("/dev") for count lines at once. wanted[i] NULL: skip. */
void gn_line_search(const struct gn_gpio_ops *ops, void *context, const char *folder,
                    const struct gn_line_spec *const *wanted, struct gn_line_match *matches,
                    int count, struct gn_line_search *out);

/* Paths of the folder's chips, sorted by name, without links to other chips; at most max. Returns
 * the count. */
int gn_line_list_chips(const char *folder, char (*paths)[64], int max);

#endif
