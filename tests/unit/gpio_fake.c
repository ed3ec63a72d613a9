#include "unit/gpio_fake.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct opened { /* a chip or a line, as it was handed out */
    struct fake_gpio *gpio;
    struct fake_chip *chip;
    struct fake_line *line;
};

static struct opened *hand_out(struct fake_gpio *gpio, struct fake_chip *chip,
                               struct fake_line *line) {
    struct opened *made = calloc(1, sizeof *made);
    *made = (struct opened){.gpio = gpio, .chip = chip, .line = line};
    gpio->opened++;
    return made;
}

static void take_back(struct opened *made) {
    made->gpio->opened--;
    free(made);
}

static int open_chip(void *context, const char *path, void **out, struct gn_gpio_chip *info) {
    struct fake_gpio *gpio = context;
    const int number = atoi(strrchr(path, '/') + strlen("/gpiochip"));
    gpio->searches++;
    for (int i = 0; i < FAKE_CHIPS; i++) {
        struct fake_chip *chip = &gpio->chips[i];
        if (chip->number != number) continue;
        if (chip->open_error) return chip->open_error;
        snprintf(info->name, sizeof info->name, "gpiochip%d", number);
        snprintf(info->label, sizeof info->label, "%s", chip->label);
        info->lines = (unsigned)chip->lines;
        *out = hand_out(gpio, chip, NULL);
        return 0;
    }
    return ENODEV;
}

static void close_chip(void *chip) { take_back(chip); }

static int look(void *chip, unsigned offset, struct gn_gpio_line *out) {
    const struct fake_line *line = &((struct opened *)chip)->chip->line[offset];
    snprintf(out->name, sizeof out->name, "%s", line->name);
    snprintf(out->consumer, sizeof out->consumer, "%s",
             line->requested ? "gnomon" : line->consumer);
    out->used = line->requested || line->consumer[0];
    return 0;
}

static int request(void *opened, const struct gn_gpio_wish *wish, void **out) {
    struct opened *from = opened;
    struct fake_line *line = &from->chip->line[wish->offset];
    if (from->chip->request_error) return from->chip->request_error;
    if (line->requested || line->consumer[0]) return EBUSY;
    if (from->chip->no_bias && wish->bias != GN_BIAS_NONE) return EOPNOTSUPP;
    line->requested = true;
    line->bias = wish->bias;
    line->debounce_ns = wish->debounce_ns;
    line->count = 0;
    line->seqno = 0;
    if (pipe2(line->pipe, O_NONBLOCK | O_CLOEXEC)) abort();
    *out = hand_out(from->gpio, from->chip, line);
    return 0;
}

static int line_fd(void *line) { return ((struct opened *)line)->line->pipe[0]; }

static int read_events(void *opened, struct gn_gpio_event *out) {
    const struct opened *from = opened;
    struct fake_line *line = from->line;
    if (from->chip->gone) return -ENODEV;
    const int count = line->count < GN_GPIO_EVENTS ? line->count : GN_GPIO_EVENTS;
    memcpy(out, line->queue, (size_t)count * sizeof *out);
    line->count -= count;
    memmove(line->queue, line->queue + count, (size_t)line->count * sizeof *out);
    char bytes[FAKE_QUEUE];
    if (line->count == 0 && read(line->pipe[0], bytes, sizeof bytes) < 0 && errno != EAGAIN)
        return -errno;
    return count;
}

static int read_level(void *opened, bool *high) {
    const struct opened *from = opened;
    from->gpio->level_reads++;
    if (from->chip->gone) return ENODEV;
    *high = from->line->high;
    return 0;
}

static void release(void *opened) {
    struct opened *from = opened;
    from->line->requested = false;
    close(from->line->pipe[0]);
    if (from->line->pipe[1] >= 0) close(from->line->pipe[1]);
    take_back(from);
}

static int no_open(void *context, const char *path, void **chip, struct gn_gpio_chip *out) {
    (void)context;
    (void)path;
    (void)chip;
    (void)out;
    return ENOSYS;
}

const struct gn_gpio_ops fake_gpio_none = {.open = no_open};
const struct gn_gpio_ops fake_gpio_ops = {
    .library = "a fake",
    .open = open_chip,
    .look = look,
    .request = request,
    .close = close_chip,
    .fd = line_fd,
    .read = read_events,
    .level = read_level,
    .release = release,
};

/* ---- what happens -------------------------------------------------------------------------- */

void fake_gpio_init(struct fake_gpio *gpio) {
    *gpio = (struct fake_gpio){.folder = "/tmp/gnomon-XXXXXX", .counts = true};
    for (int i = 0; i < FAKE_CHIPS; i++) gpio->chips[i].number = -1;
    if (!mkdtemp(gpio->folder)) abort();
}

static void node_path(const struct fake_gpio *gpio, int number, char *out, size_t size) {
    snprintf(out, size, "%s/gpiochip%d", gpio->folder, number);
}

void fake_gpio_finish(struct fake_gpio *gpio) {
    for (int i = 0; i < FAKE_CHIPS; i++)
        if (gpio->chips[i].number >= 0) fake_gpio_unplug(gpio, i);
    rmdir(gpio->folder);
}

void fake_gpio_plug(struct fake_gpio *gpio, int chip, int number, const char *label, int lines) {
    char path[96];
    struct fake_chip *c = &gpio->chips[chip];
    *c = (struct fake_chip){.number = number, .lines = lines};
    snprintf(c->label, sizeof c->label, "%s", label);
    for (int i = 0; i < lines; i++) {
        c->line[i].name[0] = (char)('A' + i);
        c->line[i].high = true;
    }
    node_path(gpio, number, path, sizeof path);
    const int fd = open(path, O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    if (fd >= 0) close(fd);
}

void fake_gpio_unplug(struct fake_gpio *gpio, int chip) {
    char path[96];
    struct fake_chip *c = &gpio->chips[chip];
    node_path(gpio, c->number, path, sizeof path);
    unlink(path);
    c->number = -1;
    c->gone = true;
    for (int i = 0; i < c->lines; i++) {
        if (!c->line[i].requested) continue;
        close(c->line[i].pipe[1]); /* its poll hangs up */
        c->line[i].pipe[1] = -1;
    }
}

void fake_gpio_edge(struct fake_gpio *gpio, int chip, int line, bool high, int64_t time_ns,
                    bool lost) {
    struct fake_line *l = &gpio->chips[chip].line[line];
    l->high = high;
    if (!l->requested) return;
    l->seqno++;
    if (lost || l->count >= GN_GPIO_EVENTS) return;
    l->queue[l->count++] = (struct gn_gpio_event){
        .time_ns = time_ns, .high = high, .seqno = gpio->counts ? l->seqno : 0};
    if (write(l->pipe[1], "", 1) != 1) abort();
}
