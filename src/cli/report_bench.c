/* The benches of a report. Techniques take turns (bench.c), so their ratios hold on a busy machine,
 * too. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/bench_report.h"
#include "cli/report.h"
#include "core/child.h"
#include "core/json.h"

enum { FRAMES = 60, FRAMES_CPU = 12, STALL_S = 900, TEXT = 1 << 16 };

struct job {
    struct gn_settings settings;
};
struct answer { /* in shared memory */
    struct gn_err err;
    size_t size;     /* of the text; 0: none */
    char text[TEXT]; /* JSON */
};

static void measure(void *shared, const void *argument) {
    const struct job *job = argument;
    struct answer *answer = shared;
    static struct gn_warnings warnings;
    json_t *object = gn_bench_measure(&job->settings, &warnings, &answer->err);
    const size_t size = json_dumpb(object, answer->text, TEXT, JSON_COMPACT);
    answer->size = size <= TEXT ? size : 0;
    json_decref(object);
}

/* The same techniques for every machine: without shadows, and the defaults of a scene with lights
 * and of one without. */
static void set_techniques(struct gn_settings *settings) {
    static const struct gn_technique_list list = {
        .count = 3, .items = {GN_TECHNIQUE_NONE, GN_TECHNIQUE_PCF, GN_TECHNIQUE_CONE}};
    gn_settings_put(settings, gn_option_find("shadow", strlen("shadow")), &list, GN_SOURCE_SET,
                    "--shadow");
}

static json_t *measure_scene(struct job *job, const char *path, struct answer *answer) {
    const struct gn_child child = {.work = measure, .argument = job, .stall_s = STALL_S};
    struct gn_err end = {0};
    json_t *object = NULL;
    memset(answer, 0, sizeof *answer);
    job->settings.scene.path = path;
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r\33[Kbench: %s ", path ? path : "(default scene)");
    const bool ended = gn_child_run(&child, answer, &end);
    if (ended && answer->size) object = json_loadb(answer->text, answer->size, 0, NULL);
    if (isatty(STDERR_FILENO)) fprintf(stderr, "\r\33[K");
    if (object) return object;
    return json_pack("{ss so}", "scene", path ? path : "(default scene)", "failure",
                     gn_json_make_text(!ended ? end.text : answer->err.text));
}

json_t *gn_report_bench(const struct gn_doctor_report *report, const struct gn_settings *settings) {
    json_t *scenes = json_array();
    double load = NAN;
    struct gn_err err;
    struct answer *answer = gn_child_share(sizeof *answer, &err);
    struct job *job = malloc(sizeof *job);
    if (getloadavg(&load, 1) == 1) load /= report->machine.cpus;
    if (job && answer && report->chosen >= 0) {
        const struct gn_doctor_backend *backend = &report->backends[report->chosen];
        job->settings = *settings;
        job->settings.run.command = GN_COMMAND_BENCH;
        job->settings.run.frames = backend->caps.software ? FRAMES_CPU : FRAMES;
        if (backend->caps.software) job->settings.render.size = (struct gn_size){640, 360};
        job->settings.display.backend = backend->name;
        set_techniques(&job->settings);
        json_array_append_new(scenes, measure_scene(job, NULL, answer));
        json_array_append_new(scenes, measure_scene(job, GN_SCENE_LESSON "model", answer));
    }
    free(job);
    if (answer) gn_child_unshare(answer, sizeof *answer);
    return json_pack("{so so}", "load", gn_json_make_number(load), "scenes", scenes);
}
