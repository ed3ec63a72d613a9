#include "input/lines.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/private.h"

#define SECOND INT64_C(1000000000)
#define NEVER  INT64_MAX

enum { ENOTSUPP_ = 524 /* kernel-internal value, not in libc */, READS_MAX = 4 };
enum { EDGES_MAX = 256 };

enum problem { FINE, NO_LIBRARY, MISSING, AMBIGUOUS, DENIED, BUSY, BROKEN };

bool gn_lines_init(struct gn_lines *lines, const struct gn_line_opts *opts, int count,
                   struct gn_err *err) {
    lines->count = count;
    for (int i = 0; i < count; i++) {
        struct gn_line *l = &lines->lines[i];
        *l = (struct gn_line){
            .opts = opts[i], .wanted = opts[i].text, .retry_ns = NEVER, .check_ns = NEVER};
        if (l->wanted && !gn_line_parse(opts[i].text, &l->spec, err))
            return gn_fail_prefix(err, "button \"%s\": line", opts[i].button);
        for (int k = 0; opts[i].text && k < i; k++)
            if (opts[k].text && strcmp(opts[k].text, opts[i].text) == 0)
                return gn_fail_usage(err, "button \"%s\": line %s is used by button \"%s\" already",
                                     opts[i].button, opts[i].text, opts[k].button);
    }
    return true;
}

/* ---- reports ------------------------------------------------------------------------------- */

/* Reported once, until the text for this line changes. */
static void report_once(struct gn_lines *lines, struct gn_line *l, const char *text) {
    if (strcmp(l->reported, text) == 0) return;
    snprintf(l->reported, sizeof l->reported, "%s", text);
    gn_report(lines->reports, "button \"%s\": %s%s", l->opts.button, text,
              l->opts.optional && l->problem ? " (default button: its keys still work)" : "");
}

static void have_problem(struct gn_lines *lines, struct gn_line *l, enum problem problem,
                         const char *text, int64_t now_ns) {
    if (l->problem != (int)problem) l->since_ns = now_ns;
    l->problem = problem;
    report_once(lines, l, text);
    switch (problem) {
    case MISSING: l->retry_ns = lines->watched ? NEVER : now_ns + 2 * SECOND; break;
    case AMBIGUOUS: l->retry_ns = lines->watched ? NEVER : now_ns + 60 * SECOND; break;
    case DENIED:
    case BUSY:
    case BROKEN: /* short during system start */
        l->retry_ns = now_ns + (now_ns - l->since_ns < 30 * SECOND ? 2 : 60) * SECOND;
        break;
    case FINE:
    case NO_LIBRARY: l->retry_ns = NEVER; break;
    }
}

/* ---- requesting lines ---------------------------------------------------------------------- */

static bool is_pressed(const struct gn_line *l, bool high) { return high == l->opts.active_high; }

static void release_request(struct gn_lines *lines, struct gn_line *l, int64_t now_ns) {
    gn_loop_remove(&l->watch);
    lines->ops->release(l->request);
    l->request = NULL;
    l->check_ns = NEVER;
    gn_gestures_lose(lines->gestures, (int)(l - lines->lines), now_ns);
}

static void lose_line(struct gn_lines *lines, struct gn_line *l, int error, int64_t now_ns) {
    char text[GN_REPORT_SIZE];
    release_request(lines, l, now_ns);
    snprintf(text, sizeof text, "%s disappeared (%s); waiting for it", l->where, strerror(error));
    l->problem = MISSING;
    l->since_ns = now_ns;
    l->retry_ns = now_ns + (lines->watched ? SECOND / 2 : 2 * SECOND);
    report_once(lines, l, text);
}

static void on_readable(void *user, int64_t now_ns) {
    struct gn_line *l = user;
    l->readable = true;
    l->hung_up |= l->watch.came & (EPOLLHUP | EPOLLERR);
    l->all->timer->due_ns = now_ns;
}

static void begin_line(struct gn_lines *lines, struct gn_line *l, int64_t now_ns) {
    const int button = (int)(l - lines->lines);
    bool high;
    l->all = lines;
    l->readable = l->hung_up = false;
    l->problem = FINE;
    l->retry_ns = l->check_ns = NEVER;
    l->seqno = 0;
    const int fd = lines->ops->fd(l->request), error = lines->ops->level(l->request, &high);
    fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
    l->watch = (struct gn_watch){.fd = fd, .events = EPOLLIN, .call = on_readable, .user = l};
    if (!error && gn_loop_add(lines->loop, &l->watch)) {
        char text[GN_REPORT_SIZE];
        gn_gestures_start(lines->gestures, button, is_pressed(l, high), now_ns);
        const char *pull = l->opts.bias == GN_BIAS_PULL_DOWN ? "down" : "up";
        snprintf(text, sizeof text, "%s%s%s%s", l->where,
                 l->no_bias ? ", whose chip has no internal pull-" : "", l->no_bias ? pull : "",
                 l->no_bias ? ": add a resistor against spurious presses" : "");
        report_once(lines, l, text);
        return;
    }
    lose_line(lines, l, error ? error : errno, now_ns);
}

static const char *name_of(const struct gn_line *l) { return l->opts.text; }

static void describe_denied(const char *path, const char *name, char *text, size_t size) {
    snprintf(text, size,
             "no permission to open %s to find %s; add the user to group gpio "
             "(sudo usermod -aG gpio USER) and log in again",
             path, name);
}

static void acquire_line(struct gn_lines *lines, struct gn_line *l,
                         const struct gn_line_match *match, int64_t now_ns) {
    struct gn_gpio_chip info;
    void *chip;
    char text[GN_REPORT_SIZE];
    snprintf(l->where, sizeof l->where, "%.40s (%.20s line %u)", name_of(l), match->chip.name,
             match->offset);
    int error = lines->ops->open(lines->context, match->path, &chip, &info);
    if (!error) {
        const int64_t kernel_ns = INT64_C(5000000), quarter_ns = l->opts.debounce_ns / 4;
        struct gn_gpio_wish wish = {.offset = match->offset,
                                    .bias = l->opts.bias,
                                    .debounce_ns = l->opts.debounce_ns > 0 && quarter_ns < kernel_ns
                                                       ? quarter_ns
                                                       : kernel_ns};
        error = lines->ops->request(chip, &wish, &l->request);
        l->no_bias = false;
        if ((error == EINVAL || error == EOPNOTSUPP || error == ENOTSUPP_) &&
            wish.bias != GN_BIAS_NONE) { /* the chip has none: without it */
            wish.bias = GN_BIAS_NONE;
            l->no_bias = lines->ops->request(chip, &wish, &l->request) == 0;
            if (l->no_bias) error = 0;
        }
        lines->ops->close(chip);
    }
    if (!error) {
        begin_line(lines, l, now_ns);
        return;
    }
    const bool denied = error == EACCES || error == EPERM;
    if (denied)
        describe_denied(match->path, name_of(l), text, sizeof text);
    else if (error == EBUSY)
        snprintf(text, sizeof text, "%s is in use by %s%s%s; free it or use another line", l->where,
                 match->line.consumer[0] ? "\"" : "",
                 match->line.consumer[0] ? match->line.consumer : "another program",
                 match->line.consumer[0] ? "\"" : "");
    else
        snprintf(text, sizeof text, "cannot request %s: %s", l->where, strerror(error));
    have_problem(lines, l, denied ? DENIED : error == EBUSY ? BUSY : BROKEN, text, now_ns);
}

/* ---- searching lines ----------------------------------------------------------------------- */

static void take_search_result(struct gn_lines *lines, struct gn_line *l,
                               const struct gn_line_match *match,
                               const struct gn_line_search *search, int64_t now_ns) {
    char text[GN_REPORT_SIZE];
    if (match->count == 1) {
        acquire_line(lines, l, match, now_ns);
        return;
    }
    if (match->count > 1) {
        snprintf(text, sizeof text, "%d lines are named %s: %.150s; use label:CHIP/NUMBER",
                 match->count, name_of(l), match->list);
        have_problem(lines, l, AMBIGUOUS, text, now_ns);
        return;
    }
    const bool denied = search->refused && (search->error == EACCES || search->error == EPERM);
    if (l->problem == MISSING && !denied) /* reported already, perhaps as disconnected */
        snprintf(text, sizeof text, "%s", l->reported);
    else if (denied)
        describe_denied(search->refused_path, name_of(l), text, sizeof text);
    else if (search->chips == 0)
        snprintf(text, sizeof text, "no GPIO chip found for %s; waiting for one", name_of(l));
    else
        snprintf(text, sizeof text,
                 "no GPIO line named %s; waiting for it (`gnomon doctor` lists the lines)",
                 name_of(l));
    have_problem(lines, l, denied ? DENIED : MISSING, text, now_ns);
}

void gn_lines_search(struct gn_lines *lines, int64_t now_ns) {
    const struct gn_line_spec *wanted[GN_BUTTONS_MAX] = {0};
    struct gn_line_match matches[GN_BUTTONS_MAX];
    struct gn_line_search search;
    int missing = 0;
    for (int i = 0; i < lines->count; i++) {
        struct gn_line *l = &lines->lines[i];
        if (!l->wanted || l->request) continue;
        wanted[i] = &l->spec;
        missing++;
        if (!lines->ops->library)
            have_problem(lines, l, NO_LIBRARY, "GPIO lines need libgpiod, missing in this build",
                         now_ns);
    }
    if (!missing || !lines->ops->library) return;
    gn_line_search(lines->ops, lines->context, lines->folder, wanted, matches, lines->count,
                   &search);
    for (int i = 0; i < lines->count; i++)
        if (wanted[i]) take_search_result(lines, &lines->lines[i], &matches[i], &search, now_ns);
}

/* ---- reading lines ------------------------------------------------------------------------- */

struct edge {
    int64_t time_ns;
    int button, order;
    bool level;
};
struct edges {
    struct edge list[EDGES_MAX];
    int count;
};

static int by_time(const void *a, const void *b) {
    const struct edge *p = a, *q = b;
    if (p->time_ns != q->time_ns) return p->time_ns < q->time_ns ? -1 : 1;
    return p->order - q->order;
}

static void pass_edges(struct gn_lines *lines, struct edges *edges) {
    if (edges->count) qsort(edges->list, (size_t)edges->count, sizeof *edges->list, by_time);
    for (int i = 0; i < edges->count; i++)
        gn_gestures_edge(lines->gestures, edges->list[i].button, edges->list[i].level,
                         edges->list[i].time_ns);
    edges->count = 0;
}

/* Returns true if edges were lost or are left; *error: the line is gone. */
static bool drain_line(struct gn_lines *lines, struct gn_line *l, struct edges *edges,
                       int64_t now_ns, int *total, int *error) {
    bool gap = false;
    *total = 0;
    for (int round = 0; round < READS_MAX; round++) {
        struct gn_gpio_event events[GN_GPIO_EVENTS];
        const int count = lines->ops->read(l->request, events);
        if (count < 0) *error = -count;
        for (int i = 0; i < count; i++) {
            if (edges->count == EDGES_MAX) pass_edges(lines, edges);
            gap |= events[i].seqno && events[i].seqno != l->seqno + 1;
            l->seqno = events[i].seqno;
            edges->list[edges->count] =
                (struct edge){.time_ns = gn_gesture_sane_time_ns(events[i].time_ns, now_ns),
                              .button = (int)(l - lines->lines),
                              .order = edges->count,
                              .level = is_pressed(l, events[i].high)};
            edges->count++;
        }
        *total += count > 0 ? count : 0;
        if (count < GN_GPIO_EVENTS) return gap;
        gap = true;
    }
    return gap;
}

static void read_level(struct gn_lines *lines, struct gn_line *l, int64_t now_ns) {
    bool high;
    const int error = lines->ops->level(l->request, &high);
    if (error)
        lose_line(lines, l, error, now_ns);
    else
        gn_gestures_level(lines->gestures, (int)(l - lines->lines), is_pressed(l, high), now_ns);
}

/* Passes edges on in time order. */
static void read_lines(struct gn_input *input, int64_t now_ns) {
    struct gn_lines *lines = &input->lines;
    struct edges edges = {.count = 0};
    int errors[GN_BUTTONS_MAX] = {0};
    uint32_t gaps = 0;
    for (int i = 0; i < lines->count; i++) {
        struct gn_line *l = &lines->lines[i];
        int total;
        if (!l->readable || !l->request) continue;
        if (drain_line(lines, l, &edges, now_ns, &total, &errors[i])) gaps |= UINT32_C(1) << i;
        if (!total && !errors[i] && l->hung_up) errors[i] = ENODEV;
        l->readable = l->hung_up = false;
    }
    pass_edges(lines, &edges);
    for (int i = 0; i < lines->count; i++)
        if (errors[i])
            lose_line(lines, &lines->lines[i], errors[i], now_ns);
        else if (gaps >> i & 1)
            read_level(lines, &lines->lines[i], now_ns);
}

/* ---- time ---------------------------------------------------------------------------------- */

void gn_lines_changed(struct gn_lines *lines, int64_t now_ns) {
    for (int i = 0; i < lines->count; i++)
        if (lines->lines[i].request) read_level(lines, &lines->lines[i], now_ns);
    gn_lines_search(lines, now_ns);
}

static void check_lines(struct gn_input *input, int64_t now_ns) {
    struct gn_lines *lines = &input->lines;
    bool search = false;
    for (int i = 0; i < lines->count; i++) {
        struct gn_line *l = &lines->lines[i];
        if (!l->request) {
            search |= l->wanted && l->retry_ns <= now_ns;
            continue;
        }
        /* the level of a line that is not at rest is read now and then: an edge may be lost */
        const struct gn_gesture_button *b = &lines->gestures->buttons[i];
        const bool due = l->check_ns != NEVER && now_ns >= l->check_ns;
        if (gn_gestures_at_rest(lines->gestures, i)) {
            l->check_ns = NEVER;
        } else if (due || l->check_ns == NEVER) {
            const bool stuck = b->state == GN_BUTTON_MUTED && b->due_ns[GN_DUE_STUCK] == NEVER;
            l->check_ns = now_ns + (stuck ? 60 : 1) * SECOND;
            if (due) read_level(lines, l, now_ns);
        }
    }
    if (search) gn_lines_search(lines, now_ns);
}

/* Valid after the gestures have been stepped. */
static int64_t lines_deadline(const struct gn_input *input) {
    const struct gn_lines *lines = &input->lines;
    int64_t first_ns = NEVER;
    for (int i = 0; i < lines->count; i++) {
        const struct gn_line *l = &lines->lines[i];
        const int64_t due_ns = l->request ? l->check_ns : l->retry_ns;
        if (l->wanted && due_ns < first_ns) first_ns = due_ns;
    }
    return first_ns;
}

static void close_lines(struct gn_input *input) {
    struct gn_lines *lines = &input->lines;
    for (int i = 0; lines->gestures && i < lines->count; i++)
        if (lines->lines[i].request)
            release_request(lines, &lines->lines[i], lines->gestures->now_ns);
}

/* ---- the source ---- */

static void open_lines(struct gn_input *input, const struct gn_input_world *world, int64_t now_ns,
                       struct gn_warnings *warnings) {
    (void)world, (void)warnings;
    input->lines.loop = input->opts.loop;
    input->lines.timer = &input->timer;
    input->lines.gestures = &input->gestures;
    input->lines.reports = &input->reports;
    input->lines.watched = input->folder_watch >= 0;
    gn_lines_search(&input->lines, now_ns);
}

const struct gn_input_source gn_source_lines = {
    .open = open_lines,
    .read = read_lines,
    .check = check_lines,
    .deadline = lines_deadline,
    .close = close_lines,
};
