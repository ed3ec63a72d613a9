/* The metrics that are of the whole kiosk: rows without a turn of their own. */
#include <stdio.h>
#include <unistd.h>

#include <config.h> /* the generated one */

#include "core/clock.h"
#include "core/file.h"
#include "core/json.h"
#include "core/text.h"
#include "kiosk/private.h"
#include "stage/lights.h"

/* ---- what is shown, and on what -------------------------------------------------------------- */

struct status {
    const struct gn_part_host *host;
    const char *version, *mode, *scene, *plays;
    const char *backend, *range, *scaled_by, *fonts, *config, *error, *problem;
    int pid, camera, median_frames, worst_frames, pointers, fps;
    bool paused, blanked, info, waits;
    double uptime_s, median_ms, worst_ms, scale;
    uint64_t drawn, seen;
    struct gn_screen screen;
    json_t *modes, *lights;
};

/* Of the wanted mode, as it will be entered; while another scene is wanted, of the one shown. */
static uint32_t camera_of(const struct gn_show *s) {
    const int wanted = s->screen.kiosk.wanted.mode, shown = s->screen.kiosk.shown.mode;
    const bool same_scene = gn_kiosk_scene(&s->screen.rules, &s->screen.kiosk.wanted) ==
                            gn_kiosk_scene(&s->screen.rules, &s->screen.kiosk.shown);
    const int mode = same_scene ? wanted : shown;
    const bool resets = mode != shown && s->screen.rules.own_camera >> mode & 1;
    const uint32_t first = (uint32_t)s->screen.looks.of[mode].frame_opts.view.camera;
    return (first + (resets ? 0 : s->screen.kiosk.camera)) % s->screen.stage.scene->camera_count;
}

/* What holds of the settings of single lights: {name: text}; NULL: there are none. */
static json_t *lights_json(const struct gn_show *s) {
    const struct gn_settings *o = s->screen.stage.settings;
    const struct gn_scene *scene = s->screen.stage.scene;
    json_t *lights = o->light_count > 0 ? json_object() : NULL;
    for (int i = 0; i < o->light_count; i++) {
        char holds[400];
        bool here = false;
        for (uint32_t k = 0; scene && k < scene->light_count; k++)
            here |= gn_light_section_is_of(&o->lights[i], scene, k);
        gn_stage_print_light(o, &o->lights[i], holds, sizeof holds);
        if (!here) gn_text_add(holds, sizeof holds, " (not in this scene)");
        json_t *name = gn_json_make_text(o->lights[i].name); /* always UTF-8 */
        json_object_set_new(lights, json_string_value(name), gn_json_make_text(holds));
        json_decref(name);
    }
    return lights;
}

static const void *kiosk_status(void *part) {
    static const char *const ranges[] = {"auto", "full", "limited"};
    struct status *v = part;
    const struct gn_show *s = v->host->show;
    const struct gn_kiosk *k = &s->screen.kiosk;
    const struct gn_options *o = s->config.options;
    const struct gn_display *display = &s->screen.stage.display;
    const struct gn_latency_report latency = gn_latency_read(&s->buttons.latency);
    const char *scene = s->scenes.paths[gn_kiosk_scene(&s->screen.rules, &k->wanted)];
    const int clip = k->play.clip_plus_1 - 1;
    const bool plays = clip >= 0 && (uint32_t)clip < s->screen.stage.scene->animation.clip_count;
    const int64_t now_ns = gn_loop_now_ns(s->loop);
    *v = (struct status){
        .host = v->host,
        .version = GN_VERSION,
        .pid = (int)getpid(),
        .uptime_s = (double)(now_ns - s->counts.begun_ns) * 1e-9,
        .mode = s->modes.names[k->wanted.mode],
        .scene = scene ? scene : "(default scene)",
        .camera = (int)camera_of(s),
        .paused = k->paused,
        .blanked = k->blanked,
        .info = k->info,
        .plays = plays ? s->screen.stage.scene->animation.clips[clip].name : NULL,
        .waits = s->config.waits || gn_kiosk_waits(k),
        .modes = json_array(),
        .lights = lights_json(s),
        .backend = display->ops ? display->ops->name : "",
        .screen = display->screen,
        .range = ranges[display->screen.range],
        .scale = gn_show_scale(&s->screen),
        .scaled_by = s->screen.context.scaled_by ? s->screen.context.scaled_by : "none",
        .fonts = s->screen.text.captions ? gn_captions_missing(s->screen.text.captions) : "",
        .drawn = s->counts.frames,
        .seen = latency.count,
        .median_ms = (double)latency.median.ns * 1e-6,
        .worst_ms = (double)latency.worst.ns * 1e-6,
        .median_frames = latency.median.frames,
        .worst_frames = latency.worst.frames,
        .pointers = s->buttons.input ? gn_input_pointers(s->buttons.input) : 0,
        .fps = gn_frame_times_fps(&s->counts.times, now_ns),
        .config = o->config_path,
        .error = o->config_error,
        .problem = gn_problem_last(&s->problems),
    };
    for (int i = 0; i < s->modes.count; i++)
        json_array_append_new(v->modes, gn_json_make_text(s->modes.names[i]));
    return v;
}

#define METRIC(member, ...) GN_METRIC(struct status, member, __VA_ARGS__)
static const struct gn_metric kiosk_metrics[] = {
    METRIC(version, "version", "", "of the program"),
    METRIC(pid, "pid", "", "of its process"),
    METRIC(uptime_s, "uptime_s", "s", "since it was started"),
    METRIC(mode, "mode", "", "that is shown, or waited for", .brief = true),
    METRIC(scene, "scene", "", "likewise", .brief = true),
    METRIC(camera, "camera", "", "likewise, by its number in the scene", .brief = true),
    METRIC(paused, "paused", "", "the scene's time stands", .brief = true),
    METRIC(blanked, "blanked", "", "the screen is switched off by blank", .brief = true),
    METRIC(info, "info", "", "the information page is shown", .brief = true),
    METRIC(plays, "plays", "", "the clip that plays once", .brief = true),
    METRIC(waits, "waits", "", "mode, scene or options are not shown yet"),
    METRIC(modes, "modes", "", "names of all modes"),
    METRIC(lights, "lights", "", "of each [light NAME]: what is set"),
    METRIC(backend, "screen.backend", "", "the display"),
    METRIC(screen.what, "screen.what", "", "connector and mode in use"),
    METRIC(screen.status, "screen.status", "", "what is waited for"),
    METRIC(screen.lit, "screen.lit", "", "it shows a picture"),
    METRIC(screen.width_px, "screen.width", "px", "of the screen"),
    METRIC(screen.height_px, "screen.height", "px", "of the screen"),
    METRIC(screen.rotate_deg, "screen.rotate", "degrees", "clockwise"),
    METRIC(scale, "screen.scale", "", "of the scene's width and height"),
    METRIC(scaled_by, "screen.scaled_by", "", "what makes it as large as the screen"),
    METRIC(range, "screen.range", "", "levels of the signal"),
    METRIC(fonts, "screen.fonts_missing", "", "scripts of its texts, and packages to install"),
    METRIC(drawn, "frames.drawn", "frames", "by the GPU"),
    METRIC(screen.counts.shown, "frames.shown", "frames", "flips that completed, repeats included"),
    METRIC(screen.counts.again, "frames.again", "frames", "of them, repeats of the one before"),
    METRIC(screen.counts.missed, "frames.missed", "frames",
           "refreshes missed while one was in flight"),
    METRIC(screen.counts.retried, "frames.retried", "", "commits that were refused for a while"),
    METRIC(screen.counts.stalled, "frames.stalled", "frames",
           "flips that did not complete in time"),
    METRIC(screen.counts.relit, "frames.relit", "", "modesets"),
    METRIC(screen.counts.opened, "frames.opened", "", "how often a card was opened"),
    METRIC(seen, "input.seen", "", "edges of buttons whose effect was shown"),
    METRIC(median_ms, "input.median_ms", "ms", "from an edge to its frame"),
    METRIC(worst_ms, "input.worst_ms", "ms", "from an edge to its frame"),
    METRIC(median_frames, "input.median_frames", "frames", "from an edge to its frame"),
    METRIC(worst_frames, "input.worst_frames", "frames", "from an edge to its frame"),
    METRIC(pointers, "input.pointers", "", "touch screens and mice"),
    METRIC(fps, "fps", "frames", "in the last second"),
    METRIC(config, "config.path", "", "the configuration file"),
    METRIC(error, "config.error", "", "why it is not in use, or another problem that lasts"),
    METRIC(problem, "problem", "", "the last that is not cured"),
};

const struct gn_part gn_part_kiosk = {
    .name = "kiosk",
    .size = sizeof(struct status),
    .status = kiosk_status,
    GN_PART_METRICS(kiosk_metrics),
};

/* ---- the scene ------------------------------------------------------------------------------- */

struct scene {
    const struct gn_part_host *host;
    const char *missing;
    json_t *rollback;
};

static const void *scene_status(void *part) {
    struct scene *v = part;
    const struct gn_show *s = v->host->show;
    const char *past = s->config.past[0] ? s->config.past : "(configured)";
    v->missing = s->screen.stage.scene ? s->screen.stage.scene->missing : NULL;
    v->rollback = s->config.has_past ? gn_json_make_text(past) : NULL;
    return v;
}

static const struct gn_metric scene_metrics[] = {
    GN_METRIC(struct scene, missing, "missing", "", "what the scene is shown without"),
    GN_METRIC(struct scene, rollback, "rollback", "", "the scene of ctl rollback"),
};

const struct gn_part gn_part_scene = {
    .name = "scene",
    .size = sizeof(struct scene),
    .status = scene_status,
    GN_PART_METRICS(scene_metrics),
};

/* ---- the process ----------------------------------------------------------------------------- */

struct process {
    const struct gn_part_host *host;
    int64_t read_ns; /* at most once a second; 0: not yet */
    double memory_mb;
};

/* Resident memory: cheap to read, and shows leaks. */
static const void *process_status(void *part) {
    struct process *v = part;
    const int64_t now_ns = gn_loop_now_ns(v->host->loop);
    char text[64];
    long pages;
    if (v->read_ns != 0 && now_ns - v->read_ns < GN_NS_PER_S) return v;
    gn_file_read_text("/proc/self/statm", text, sizeof text);
    if (sscanf(text, "%*s %ld", &pages) != 1) pages = 0;
    v->read_ns = now_ns;
    v->memory_mb = (double)pages * (double)sysconf(_SC_PAGESIZE) / (1024.0 * 1024.0);
    return v;
}

static const struct gn_metric process_metrics[] = {
    GN_METRIC(struct process, memory_mb, "memory_mb", "MiB", "resident memory of the program"),
};

const struct gn_part gn_part_process = {
    .name = "process",
    .size = sizeof(struct process),
    .status = process_status,
    GN_PART_METRICS(process_metrics),
};
