/* GPIO chips that are not there, behind the table of gpio.h: files called gpiochipN in a folder of
 * their own stand for the nodes of /dev, and the test says what they are, what goes wrong, and what
 * happens on their lines. */
#ifndef GN_UNIT_GPIO_FAKE_H
#define GN_UNIT_GPIO_FAKE_H

#include "input/gpio.h"

enum { FAKE_CHIPS = 4, FAKE_LINES = 8, FAKE_QUEUE = 300 };

struct fake_line {
    char name[48], consumer[48];
    bool high;
    bool requested;
    enum gn_bias bias; /* that it was requested with */
    int64_t debounce_ns;
    int pipe[2]; /* readable while there are events */
    struct gn_gpio_event queue[FAKE_QUEUE];
    int count;
    uint32_t seqno;
};
struct fake_chip {
    int number; /* of its node; -1: it is not there */
    char label[48];
    int lines;
    int open_error;    /* of open() */
    int request_error; /* of request() */
    bool no_bias;      /* refuses requests with one */
    bool gone;         /* under its lines */
    struct fake_line line[FAKE_LINES];
};
struct fake_gpio {
    char folder[64]; /* ends with fake_gpio_finish */
    struct fake_chip chips[FAKE_CHIPS];
    bool counts; /* numbers its events, as libgpiod 2 does */
    int opened;  /* and not closed: 0 in the end */
    int searches;
    int level_reads;
};

extern const struct gn_gpio_ops fake_gpio_ops;  /* its context is a struct fake_gpio */
extern const struct gn_gpio_ops fake_gpio_none; /* a build without a library */

void fake_gpio_init(struct fake_gpio *gpio);
void fake_gpio_finish(struct fake_gpio *gpio);
/* The node appears under that number, with lines A, B, C .. that are high; or goes. */
void fake_gpio_plug(struct fake_gpio *gpio, int chip, int number, const char *label, int lines);
void fake_gpio_unplug(struct fake_gpio *gpio, int chip);
/* An edge; lost: it is not told of. More than 16 wait: it is lost, too. */
void fake_gpio_edge(struct fake_gpio *gpio, int chip, int line, bool high, int64_t time_ns,
                    bool lost);

#endif
