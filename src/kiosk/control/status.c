#include "kiosk/control/status.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <config.h> /* the generated one */

#include "core/clock.h"
#include "core/json.h"
#include "kiosk/private.h"
#include "stage/lights.h"

/* Resident memory in MiB: cheap to read, and shows leaks. */
static double memory_mb(struct gn_show_status *status, int64_t now_ns) {
    long pages = 0;
    if (status->memory_ns != 0 && now_ns - status->memory_ns < GN_NS_PER_S)
        return status->memory_mb;
    FILE *file = fopen("/proc/self/statm", "re");
    if (file && fscanf(file, "%*s %ld", &pages) != 1) pages = 0;
    if (file) fclose(file);
    status->memory_ns = now_ns;
    status->memory_mb = (double)pages * (double)sysconf(_SC_PAGESIZE) / (1024.0 * 1024.0);
    return status->memory_mb;
}

/* Of the wanted mode, as it will be entered; while another scene is wanted, of the one shown. */
static uint32_t camera_of(const struct gn_show *s) {
    const int wanted = s->kiosk.wanted.mode, shown = s->kiosk.shown.mode;
    const bool same_scene =
        gn_kiosk_scene(&s->rules, &s->kiosk.wanted) == gn_kiosk_scene(&s->rules, &s->kiosk.shown);
    const int mode = same_scene ? wanted : shown;
    const bool resets = mode != shown && s->rules.own_camera >> mode & 1;
    const uint32_t first = (uint32_t)s->looks.of[mode].frame_opts.view.camera;
    return (first + (resets ? 0 : s->kiosk.camera)) % s->stage.scene->camera_count;
}

/* What holds of the settings of single lights: {name: text}. */
static json_t *lights_json(const struct gn_show *s) {
    const struct gn_settings *o = s->stage.settings;
    const struct gn_scene *scene = s->stage.scene;
    json_t *lights = json_object();
    for (int i = 0; i < o->light_count; i++) {
        char holds[400];
        bool here = false;
        for (uint32_t k = 0; scene && k < scene->light_count; k++)
            here |= gn_light_section_is_of(&o->lights[i], scene, k);
        gn_stage_print_light(o, &o->lights[i], holds, sizeof holds);
        const size_t used = strlen(holds);
        if (!here) snprintf(holds + used, sizeof holds - used, " (not in this scene)");
        json_t *name = gn_json_make_text(o->lights[i].name); /* always UTF-8 */
        json_object_set_new(lights, json_string_value(name), gn_json_make_text(holds));
        json_decref(name);
    }
    return lights;
}

/* The counters over all starts. */
static json_t *state_json(const struct gn_show_memory *memory) {
    json_t *state = json_pack("{s:o}", "file", gn_json_make_text(memory->path));
#define X(id) json_object_set_new(state, #id, json_integer((json_int_t)memory->state.counts.id));
    GN_STATE_COUNTS(X)
#undef X
    return state;
}

static json_t *television_json(const struct gn_show_television *tv) {
    static const char *const wishes[] = {"", "on", "standby"};
    const struct gn_television_state *t = &tv->state;
    return json_pack("{s:s, s:s, s:o, s:o, s:I}", "wanted",
                     !tv->is_set ? ""
                     : tv->on    ? "on"
                                 : "standby",
                     "told", wishes[t->told], "device", gn_json_make_text(t->device), "waits",
                     gn_json_make_text(t->waits[0] ? t->waits : NULL), "attempts",
                     (json_int_t)t->attempts);
}

/* What the kernel does not tell is null. */
static json_t *known_json(bool is_known, json_int_t value) {
    return is_known ? json_integer(value) : json_null();
}

/* What is so now, by the last reading, and how often it began. */
static json_t *board_json(const struct gn_health_log *log) {
    const struct gn_health *h = &log->last;
    const struct gn_ailment *of = log->of;
    const bool has_cma = h->cma_kb > 0 && h->cma_free_kb >= 0;
    const bool tells_voltage = h->undervoltage >= 0 || h->firmware >= 0;
    const bool tells_clock = h->cooled >= 0 || h->firmware >= 0;
    return json_pack(
        "{s:o, s:o, s:b, s:i, s:i, s:i, s:o, s:o, s:o}", "undervoltage",
        tells_voltage ? json_boolean(of[GN_HEALTH_VOLTAGE].lasts) : json_null(), "throttled",
        tells_clock ? json_boolean(of[GN_HEALTH_THROTTLED].lasts) : json_null(), "cma_runs_out",
        of[GN_HEALTH_CMA].lasts, "undervoltages", (int)of[GN_HEALTH_VOLTAGE].times, "throttlings",
        (int)of[GN_HEALTH_THROTTLED].times, "cma_shortages", (int)of[GN_HEALTH_CMA].times, "cma_mb",
        known_json(has_cma, h->cma_kb / 1024), "cma_free_mb",
        known_json(has_cma, h->cma_free_kb / 1024), "temperature_c",
        h->hottest_mc > 0 ? gn_json_make_number((double)h->hottest_mc * 1e-3) : json_null());
}

json_t *gn_show_status_short(const struct gn_show *s) {
    const char *scene = s->scenes.paths[gn_kiosk_scene(&s->rules, &s->kiosk.wanted)];
    const int clip = s->kiosk.play.clip_plus_1 - 1;
    const bool plays = clip >= 0 && (uint32_t)clip < s->stage.scene->animation.clip_count;
    return json_pack("{s:o, s:o, s:i, s:b, s:b, s:b, s:o}", "mode",
                     gn_json_make_text(s->modes.names[s->kiosk.wanted.mode]), "scene",
                     gn_json_make_text(scene ? scene : "(default scene)"), "camera",
                     (int)camera_of(s), "paused", s->kiosk.paused, "blanked", s->kiosk.blanked,
                     "info", s->kiosk.info, "plays",
                     gn_json_make_text(plays ? s->stage.scene->animation.clips[clip].name : NULL));
}

static json_t *screen_json(const struct gn_display *display) {
    static const char *const ranges[] = {"auto", "full", "limited"};
    const struct gn_screen *screen = &display->screen;
    return json_pack("{s:s, s:o, s:o, s:b, s:i, s:i, s:i, s:s}", "backend",
                     display->ops ? display->ops->name : "", "what",
                     gn_json_make_text(screen->what), "status", gn_json_make_text(screen->status),
                     "lit", screen->lit, "width", (int)screen->width_px, "height",
                     (int)screen->height_px, "rotate", (int)screen->rotate_deg, "range",
                     ranges[screen->range]);
}

static json_t *frames_json(uint64_t drawn, const struct gn_screen_counts *frames) {
    return json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I}", "drawn", (json_int_t)drawn,
                     "shown", (json_int_t)frames->shown, "again", (json_int_t)frames->again,
                     "missed", (json_int_t)frames->missed, "retried", (json_int_t)frames->retried,
                     "stalled", (json_int_t)frames->stalled, "relit", (json_int_t)frames->relit,
                     "opened", (json_int_t)frames->opened);
}

json_t *gn_show_status_make(const struct gn_show *s, struct gn_show_status *status,
                            struct gn_control_counts c) {
    const struct gn_options *o = s->config.options;
    const struct gn_latency_report latency = gn_latency_read(&s->buttons.latency);
    const int64_t now_ns = gn_loop_now_ns(s->loop);
    json_t *modes = json_array();
    for (int i = 0; i < s->modes.count; i++)
        json_array_append_new(modes, gn_json_make_text(s->modes.names[i]));

    json_t *reply = json_pack("{s:s, s:i, s:f}", "version", GN_VERSION, "pid", (int)getpid(),
                              "uptime_s", (double)(now_ns - s->counts.begun_ns) * 1e-9);
    json_object_update_new(reply, gn_show_status_short(s));
    json_object_set_new(reply, "waits", json_boolean(s->config.waits || gn_kiosk_waits(&s->kiosk)));
    json_object_set_new(reply, "modes", modes);
    if (s->stage.settings->light_count > 0) json_object_set_new(reply, "lights", lights_json(s));
    json_object_set_new(reply, "screen", screen_json(&s->stage.display));
    json_object_set_new(reply, "frames",
                        frames_json(s->counts.frames, &s->stage.display.screen.counts));
    json_object_set_new(
        reply, "input",
        json_pack("{s:I, s:o, s:o, s:i, s:i, s:i}", "seen", (json_int_t)latency.count, "median_ms",
                  gn_json_make_number((double)latency.median.ns * 1e-6), "worst_ms",
                  gn_json_make_number((double)latency.worst.ns * 1e-6), "median_frames",
                  latency.median.frames, "worst_frames", latency.worst.frames, "pointers",
                  s->buttons.input ? gn_input_pointers(s->buttons.input) : 0));
    json_object_set_new(reply, "fps", json_integer(gn_frame_times_fps(&s->counts.times, now_ns)));
    json_object_set_new(reply, "config",
                        json_pack("{s:o, s:o}", "path", gn_json_make_text(o->config_path), "error",
                                  gn_json_make_text(o->config_error)));
    json_object_set_new(reply, "problem", gn_json_make_text(gn_problem_last(&s->problems)));
    if (s->memory.path[0]) json_object_set_new(reply, "state", state_json(&s->memory));
    json_object_set_new(reply, "missing",
                        gn_json_make_text(s->stage.scene ? s->stage.scene->missing : NULL));
    if (s->config.has_past)
        json_object_set_new(reply, "rollback",
                            gn_json_make_text(s->config.past[0] ? s->config.past : "(configured)"));
    const struct gn_schedule *hours = &o->settings->schedule.on;
    if (hours->count > 0 || o->settings->schedule.dim.count > 0) {
        const int64_t next_s = gn_schedule_next(hours, time(NULL));
        json_object_set_new(reply, "schedule",
                            json_pack("{s:b, s:b, s:b, s:I}", "on", !s->kiosk.asleep, "dim",
                                      s->hours.dims, "clock", s->hours.is_set, "next",
                                      (json_int_t)(next_s == INT64_MAX ? 0 : next_s)));
    }
    if (s->television.told)
        json_object_set_new(reply, "television", television_json(&s->television));
    if (s->health.log.begun) json_object_set_new(reply, "board", board_json(&s->health.log));
    json_object_set_new(reply, "memory_mb", gn_json_make_number(memory_mb(status, now_ns)));
    json_object_set_new(reply, "control",
                        json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:I}", "accepted",
                                  (json_int_t)c.accepted, "refused", (json_int_t)c.refused,
                                  "requests", (json_int_t)c.requests, "wrong", (json_int_t)c.wrong,
                                  "busy", (json_int_t)c.busy, "answered", (json_int_t)c.answered,
                                  "cut", (json_int_t)c.cut));
    return reply;
}
