/* What the board suffers from: a problem while it lasts, a line in the journal when it begins and
 * when it ends. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/info_page.h"
#include "kiosk/part.h"
#include "kiosk/sensor.h"

static const int64_t READING_NS = 10 * GN_NS_PER_S;

static const enum gn_problem problems[GN_HEALTH_COUNT] = {
    [GN_HEALTH_VOLTAGE] = GN_PROBLEM_VOLTAGE,
    [GN_HEALTH_THROTTLED] = GN_PROBLEM_THROTTLED,
    [GN_HEALTH_CMA] = GN_PROBLEM_CMA,
};

struct health {
    const struct gn_part_host *host;
    struct gn_sensor *sensor; /* NULL: none */
    struct gn_watch watch;
    struct gn_health_log log;
    char summary[160];     /* "": it has suffered from nothing so far */
    int8_t low, throttled; /* for the status, as are the next */
    int64_t cma_mb, cma_free_mb;
    double temperature_c;
};

/* Its numbers change with each reading: the problem keeps those of its beginning. */
static void report_ailment(struct health *h, enum gn_health_kind kind, bool lasted) {
    const struct gn_ailment *a = &h->log.of[kind];
    char text[512];
    if (a->lasts == lasted) return;
    if (a->lasts) {
        snprintf(text, sizeof text, "%s; %s", a->text, gn_health_cures[kind]);
        gn_problem_report(h->host->problems, problems[kind], text);
    } else {
        gn_problem_cure(h->host->problems, problems[kind]);
        fprintf(stderr, "gnomon: no more: %s\n", gn_health_names[kind]);
    }
}

static void take_health(void *user, int64_t now_ns) {
    struct health *h = user;
    struct gn_health reading;
    bool lasted[GN_HEALTH_COUNT];
    (void)now_ns;
    gn_sensor_read(h->sensor, &reading);
    for (int i = 0; i < GN_HEALTH_COUNT; i++) lasted[i] = h->log.of[i].lasts;
    gn_health_take(&h->log, &reading);
    for (int i = 0; i < GN_HEALTH_COUNT; i++) report_ailment(h, (enum gn_health_kind)i, lasted[i]);
    gn_health_summarise(&h->log, h->summary, sizeof h->summary);
}

static void close_health(void *part) {
    struct health *h = part;
    gn_loop_remove(&h->watch);
    gn_sensor_close(h->sensor);
    h->sensor = NULL;
}

static void open_health(void *part) {
    struct health *h = part;
    const struct gn_part_host *host = h->host;
    struct gn_err err = {0};
    h->sensor = gn_sensor_open(host->root ? host->root : "",
                               host->reading_ns ? host->reading_ns : READING_NS, &err);
    if (h->sensor) {
        h->watch = (struct gn_watch){
            .fd = gn_sensor_fd(h->sensor), .events = EPOLLIN, .call = take_health, .user = h};
        if (gn_loop_add(host->loop, &h->watch)) return;
        gn_fail(&err, "cannot wait for the board's health: %s", strerror(errno));
        close_health(h);
    }
    gn_problem_report(host->problems, GN_PROBLEM_START, err.text);
}

static void add_health_info(void *part, struct gn_info *info) {
    info->board = ((const struct health *)part)->summary;
}

/* What is so now, by the last reading, and how often it began. */
static const void *health_status(void *part) {
    struct health *h = part;
    const struct gn_health *last = &h->log.last;
    const struct gn_ailment *of = h->log.of;
    const bool has_cma = last->cma_kb > 0 && last->cma_free_kb >= 0;
    if (!h->log.begun) return NULL;
    h->low = last->undervoltage >= 0 || last->firmware >= 0 ? of[GN_HEALTH_VOLTAGE].lasts : -1;
    h->throttled = last->cooled >= 0 || last->firmware >= 0 ? of[GN_HEALTH_THROTTLED].lasts : -1;
    h->cma_mb = has_cma ? last->cma_kb / 1024 : -1;
    h->cma_free_mb = has_cma ? last->cma_free_kb / 1024 : -1;
    h->temperature_c = last->hottest_mc > 0 ? (double)last->hottest_mc * 1e-3 : NAN;
    return h;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct health, low, "board.undervoltage", "", "the supply's voltage is too low"),
    GN_METRIC(struct health, throttled, "board.throttled", "", "the clock is lowered"),
    GN_METRIC(struct health, log.of[GN_HEALTH_CMA].lasts, "board.cma_runs_out", "",
              "contiguous memory for screen and GPU runs out"),
    GN_METRIC(struct health, log.of[GN_HEALTH_VOLTAGE].times, "board.undervoltages", "",
              "how often the voltage was too low"),
    GN_METRIC(struct health, log.of[GN_HEALTH_THROTTLED].times, "board.throttlings", "",
              "how often the clock was lowered"),
    GN_METRIC(struct health, log.of[GN_HEALTH_CMA].times, "board.cma_shortages", "",
              "how often contiguous memory ran out"),
    GN_METRIC(struct health, cma_mb, "board.cma_mb", "MiB", "contiguous memory"),
    GN_METRIC(struct health, cma_free_mb, "board.cma_free_mb", "MiB", "what is free of it"),
    GN_METRIC(struct health, temperature_c, "board.temperature_c", "degrees Celsius",
              "of the hottest sensor"),
};

const struct gn_part gn_part_health = {
    .name = "health",
    .size = sizeof(struct health),
    .open = open_health,
    .add_info = add_health_info,
    .status = health_status,
    GN_PART_METRICS(metrics),
    .close = close_health,
};
