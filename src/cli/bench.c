/* gnomon bench: what a scene costs. Techniques take turns in blocks of a few frames, so that
 * other load on the machine hits them all alike. The order matters: the start is timed before
 * anything else has run, then come the driver's cache and the empty context, memory when all
 * programs and targets exist, and last the passes, which need a read-back each. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/bench_move.h"
#include "cli/bench_report.h"
#include "cli/commands.h"
#include "cli/inspect_time.h"
#include "cli/memory.h"
#include "core/arena.h"
#include "core/clock.h"
#include "core/terminal.h"
#include "image/write.h"
#include "stage/driver_cache.h"
#include "stage/stage.h"

enum { WARM_UP = 10, BLOCK = 6, FRAMES_DEFAULT = 60, FPS = 60, MS_NS = 1000000, RENDERER = 96 };

struct entry { /* a technique to measure */
    struct gn_frame_opts opts;
    struct gn_bench_run *run;
    uint32_t frame; /* steps of animation so far */
    double *ms;     /* of timed frames: run->frames so far */
    int64_t cpu_ns;
    uint64_t allocations; /* in timed frames, of memory and GL objects: there should be none */
};

struct bench {
    const struct gn_settings *settings;
    struct gn_warnings *warnings;
    struct gn_stage stage;
    struct gn_bench_move move;
    struct gn_memory_probe *probe; /* NULL: other scenes came before */
    struct gn_bench_report *report;
    char *renderer; /* of RENDERER bytes, for the report */
    struct entry entries[GN_TECHNIQUE_COUNT];
    double *pass_ms;
    uint32_t frames, pass_room;
    int64_t start_ns;
};

/* ---- frames ---- */

static const struct gn_plan *prepare_frame(struct bench *b, const struct entry *e, uint32_t frame,
                                           struct gn_err *err) {
    struct gn_stage *stage = &b->stage;
    stage->shown.opts = e->opts;
    gn_view_pose(&stage->shown, b->settings,
                 b->settings->scene.time_ns + (int64_t)frame * GN_NS_PER_S / FPS);
    gn_bench_move_step(&b->move, &stage->pose, frame);
    gn_stage_refine(stage, &stage->shown);
    return gn_view_plan(&stage->shown, stage->gl, b->warnings, err);
}

static bool draw_frame(struct bench *b, const struct entry *e, uint32_t frame, struct gn_err *err) {
    const struct gn_plan *plan = prepare_frame(b, e, frame, err);
    if (!plan || !gn_gl_run(b->stage.gl, plan, NULL, err)) return false;
    gn_gl_finish_frame(b->stage.gl);
    return true;
}

static uint64_t allocations(const struct bench *b) {
    return gn_alloc_count() + gn_gl_stats(b->stage.gl).objects_created;
}

static bool time_frames(struct bench *b, struct gn_err *err) {
    const uint32_t count = b->report->run_count;
    for (uint32_t i = 0; i < count; i++) {
        struct entry *e = &b->entries[i];
        for (; e->frame < WARM_UP; e->frame++)
            if (!draw_frame(b, e, e->frame, err)) return false;
    }
    const uint32_t blocks = (b->frames + BLOCK - 1) / BLOCK * count;
    for (uint32_t block = 0; block < blocks; block++) {
        struct entry *e = &b->entries[block % count];
        /* The first frame of a block is drawn a second time, untimed: it follows another
         * technique's, whose programs and maps lie in the processor's caches. */
        if (!draw_frame(b, e, e->frame - 1, err)) return false;
        for (int i = 0; i < BLOCK && e->run->frames < b->frames; i++) {
            uint64_t before = allocations(b);
            int64_t wall_ns = gn_clock_monotonic_ns(), cpu_ns = gn_clock_process_cpu_ns();
            if (!draw_frame(b, e, e->frame, err)) return false;
            e->cpu_ns += gn_clock_process_cpu_ns() - cpu_ns;
            e->ms[e->run->frames++] = (double)(gn_clock_monotonic_ns() - wall_ns) / MS_NS;
            e->frame++;
            e->allocations += allocations(b) - before;
        }
        e->run->stats = gn_gl_stats(b->stage.gl);
    }
    return true;
}

static bool time_passes(struct bench *b, struct entry *e, struct gn_err *err) {
    for (uint32_t n = 0; n < b->frames; n++) {
        const struct gn_plan *plan = prepare_frame(b, e, e->frame++, err);
        if (!plan) return false;
        if (plan->pass_count > b->pass_room)
            b->pass_ms =
                gn_xrealloc(b->pass_ms, b->pass_room = plan->pass_count, sizeof *b->pass_ms);
        if (!gn_gl_run(b->stage.gl, plan, b->pass_ms, err)) return false;
        for (uint32_t i = 0; i < plan->pass_count; i++)
            gn_bench_add_pass(e->run, plan->passes[i].label, b->pass_ms[i] / b->frames);
    }
    return true;
}

/* ---- results ---- */

/* The time of what was drawn last, on the board of --for. */
static bool weigh_run(struct bench *b, struct gn_bench_run *run, struct gn_err *err) {
    const struct gn_run_settings *o = &b->settings->run;
    struct gn_inspect_time time = {0};
    size_t size;
    if (!o->on_gpu) return true;
    bool ok =
        gn_inspect_time_build(&time, &b->stage, &gn_cost_gpus[o->on_gpu - 1], b->warnings, err);
    if (ok && o->json) run->time_json = gn_inspect_time_json(&time);
    FILE *to = ok && !o->json ? open_memstream(&run->time, &size) : NULL;
    if (to) gn_inspect_time_print(&time, to);
    if (ok && !o->json && (!to || fclose(to) != 0)) ok = gn_fail(err, "no memory for a report");
    gn_inspect_time_finish(&time);
    return ok;
}

static bool finish_run(struct bench *b, struct entry *e, struct gn_err *err) {
    const struct gn_plan *plan = prepare_frame(b, e, e->frame, err);
    if (!plan) return false;
    struct gn_bench_run *run = e->run;
    /* what the lights of the picture really use */
    for (uint32_t i = 0; i < plan->shadow_count; i++) {
        const struct gn_shadow_view *view = &plan->shadows[i];
        gn_bench_add_name(run->map_format, view->moments ? gn_moments[view->moments].name
                                                         : gn_encodings[view->encoding].name);
        if (!GN_LIGHT_HAS(&e->opts.shadow.any, technique))
            gn_bench_add_name(run->technique, gn_techniques[view->technique].name);
    }
    if (GN_LIGHT_HAS(&e->opts.shadow.any, technique))
        gn_bench_add_name(run->technique, gn_techniques[e->opts.shadow.any.technique].name);
    if (!run->technique[0]) gn_bench_add_name(run->technique, "none");
    if (!run->map_format[0]) gn_bench_add_name(run->map_format, "none");
    run->output = b->settings->render.output == GN_PICTURE_LINEAR ? "linear" : "srgb";
    run->ms_median = gn_bench_quantile(e->ms, run->frames, .5);
    run->ms_p95 = gn_bench_quantile(e->ms, run->frames, .95);
    run->cpu_ms = (double)e->cpu_ns / MS_NS / run->frames;
    run->idle = gn_pose_stands(&b->stage.pose) && b->settings->scene.turntable_deg_s == 0 &&
                !b->move.lights && !b->move.casters;
    if (e->allocations > 0)
        gn_warn(b->warnings, "%s: timed frames asked for memory or GL objects %llu times",
                run->technique, (unsigned long long)e->allocations);
    return weigh_run(b, run, err);
}

/* ---- the start ---- */

/* Loads the scene, makes an entry for each technique and draws the first picture. */
static bool start_bench(struct bench *b, struct gn_err *err) {
    const struct gn_settings *o = b->settings;
    if (!gn_stage_load(&b->stage, o, b->warnings, err)) return false;
    b->move = (struct gn_bench_move){.lights = o->run.move_lights, .casters = o->run.move_casters};
    gn_bench_move_init(&b->move, &b->stage.pose);
    struct gn_driver_cache before = gn_driver_cache_read();

    /* without --shadow one entry, as the scene has it */
    const struct gn_technique_list *list = &o->render.shadow;
    const bool given = gn_settings_given(o, render.shadow);
    b->frames = o->run.frames > 0 ? (uint32_t)o->run.frames : FRAMES_DEFAULT;
    b->report->run_count = given ? (uint32_t)list->count : 1;
    b->report->runs = gn_xalloc(b->report->run_count, sizeof *b->report->runs);
    for (uint32_t i = 0; i < b->report->run_count; i++) {
        struct entry *e = &b->entries[i];
        e->opts = b->stage.shown.opts;
        if (given) GN_LIGHT_SET(&e->opts.shadow.any, technique, (enum gn_technique)list->items[i]);
        e->run = &b->report->runs[i];
        e->ms = gn_xalloc(b->frames, sizeof *e->ms);
    }

    if (!gn_stage_open(&b->stage, b->warnings, err)) return false;
    const struct gn_size size = o->render.size;
    const uint32_t msaa =
        gn_stage_msaa(&b->stage, (uint32_t)size.width_px, (uint32_t)size.height_px, false);
    for (uint32_t i = 0; i < b->report->run_count; i++) b->entries[i].opts.output.msaa = msaa;
    uint8_t *rgba = gn_picture_alloc(
        (size_t)o->render.size.width_px * (size_t)o->render.size.height_px, 4, err);
    bool ok =
        rgba && draw_frame(b, &b->entries[0], 0, err) && gn_gl_read_rgba8(b->stage.gl, rgba, err);
    const double start_ms = (double)(gn_clock_monotonic_ns() - b->start_ns) / MS_NS;
    b->report->start_ms = b->probe ? start_ms : NAN;
    free(rgba);
    if (!ok) return false;
    b->report->private_dirty_empty_context_mb = b->probe ? gn_memory_probe_read(b->probe) : NAN;
    struct gn_driver_cache after = gn_driver_cache_read();
    b->report->cache_warm = gn_driver_cache_warm(&before, &after);
    snprintf(b->renderer, RENDERER, "%s", gn_gl_caps(b->stage.gl)->renderer);
    b->report->renderer = b->renderer;
    b->report->scene = o->scene.path ? o->scene.path : "(default scene)";
    b->report->width_px = (uint32_t)o->render.size.width_px;
    b->report->height_px = (uint32_t)o->render.size.height_px;
    return true;
}

static bool measure_scene(struct bench *b, struct gn_err *err) {
    struct gn_bench_report *report = b->report;
    bool ok = start_bench(b, err) && time_frames(b, err);
    report->private_dirty_mb = ok && b->probe ? gn_memory_private_dirty_mb() : NAN;
    for (uint32_t i = 0; ok && i < report->run_count; i++) ok = time_passes(b, &b->entries[i], err);
    for (uint32_t i = 0; ok && i < report->run_count; i++) ok = finish_run(b, &b->entries[i], err);
    for (uint32_t i = 0; i < report->run_count; i++) free(b->entries[i].ms);
    free(b->pass_ms);
    gn_bench_move_finish(&b->move);
    gn_stage_close(&b->stage);
    return ok;
}

static void finish_report(struct gn_bench_report *report) {
    for (uint32_t k = 0; k < report->run_count; k++) {
        free(report->runs[k].passes);
        free(report->runs[k].time);
        json_decref(report->runs[k].time_json);
    }
    free(report->runs);
}

json_t *gn_bench_measure(const struct gn_settings *settings, struct gn_warnings *warnings,
                         struct gn_err *err) {
    struct gn_bench_report report = {0};
    char renderer[RENDERER];
    struct bench b = {
        .settings = settings, .warnings = warnings, .report = &report, .renderer = renderer};
    json_t *object = measure_scene(&b, err) ? gn_bench_json(&report) : NULL;
    finish_report(&report);
    return object;
}

static bool print_reports(const struct gn_settings *o, const struct gn_bench_report *reports,
                          uint32_t count, struct gn_err *err) {
    if (o->run.json) return gn_bench_print_json(reports, count, stdout, err);
    if (o->run.csv)
        gn_bench_print_csv(reports, count, stdout);
    else
        for (uint32_t i = 0; i < count; i++) {
            struct gn_terminal terminal;
            FILE *to = gn_terminal_begin(&terminal, stdout);
            if (i > 0) fputc('\n', to);
            gn_bench_print(&reports[i], to);
            gn_terminal_end(&terminal);
        }
    return true;
}

/* The start of the process is now less its CPU time, since nothing has waited so far; the time in
 * /proc/self/stat has steps of 10 ms. */
bool gn_cli_bench(const struct gn_options *options, struct gn_warnings *warnings,
                  struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    const int64_t start_ns = gn_clock_monotonic_ns() - gn_clock_process_cpu_ns();
    struct gn_bench_report reports[GN_SCENES_MAX] = {0};
    char renderers[GN_SCENES_MAX][RENDERER];
    struct gn_memory_probe probe;
    if (o->run.json && o->run.csv)
        return gn_fail_usage(err, "--json and --csv exclude each other: drop one");
    if (o->run.on_gpu && (o->run.csv || o->run.move_lights || o->run.move_casters))
        return gn_fail_usage(err, "%s is not valid with --for: drop one",
                             o->run.csv           ? "--csv"
                             : o->run.move_lights ? "--move-lights"
                                                  : "--move-casters");
    gn_memory_probe_open(&probe, o->display.backend);
    const uint32_t count = o->scene.list.count > 0 ? (uint32_t)o->scene.list.count : 1;
    bool ok = true;
    for (uint32_t i = 0; ok && i < count; i++) {
        struct gn_settings one = *o;
        one.scene.path = o->scene.list.paths[i];
        struct bench b = {.settings = &one,
                          .warnings = warnings,
                          .start_ns = start_ns,
                          .probe = i == 0 ? &probe : NULL,
                          .report = &reports[i],
                          .renderer = renderers[i]};
        ok = measure_scene(&b, err);
    }
    ok = ok && print_reports(o, reports, count, err);
    for (uint32_t i = 0; i < count; i++) finish_report(&reports[i]);
    gn_memory_probe_close(&probe);
    return ok;
}
