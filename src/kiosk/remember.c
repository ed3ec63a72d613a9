/* [kiosk] state: mode, scene and counters outlast a restart. They are read before the first scene
 * is loaded, and saved by a thread: five seconds after a change, at most once a minute, else every
 * ten minutes, and at the end. */
#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "core/file.h"
#include "kiosk/keeper.h"
#include "kiosk/private.h"
#include "kiosk/state.h"
#include "shadow/technique.h"

static const int64_t SETTLE_NS = 5 * GN_NS_PER_S, REST_NS = 60 * GN_NS_PER_S,
                     COUNTS_NS = 600 * GN_NS_PER_S,
                     END_NS = GN_NS_PER_S / 2; /* for what the end still has to save */

struct memory {
    const struct gn_part_host *host;
    char path[PATH_MAX];      /* "": none */
    char good[2][PATH_MAX];   /* the scenes shown last before the start; "" */
    struct gn_state state;    /* to be saved next */
    int older;                /* as gn_state_read() has it */
    struct gn_keeper *keeper; /* NULL: nothing is saved */
    struct gn_watch done;
    struct gn_timer timer;     /* of the next save */
    bool begun;                /* the first one */
    bool changed;              /* since the last one began, */
    int64_t saved_ns;          /* which was then; 0: none was */
    int64_t seen_ns, shown_ns; /* the last look; what is left of a second */
    uint64_t frames, presses;  /* of gn_show_counts, then */
};
static struct memory *memory_of(const struct gn_show *s) { return s->parts.of[GN_PART_state]; }

/* ---- the start ------------------------------------------------------------------------------- */

static void begin_counts(struct gn_state *s) {
    char boot[sizeof s->boot];
    gn_file_read_text("/proc/sys/kernel/random/boot_id", boot, sizeof boot);
    boot[strcspn(boot, "\n")] = 0;
    if (s->runs && strcmp(boot, s->boot) == 0) s->counts.restarts++;
    if (s->runs && strcmp(boot, s->boot) != 0) s->counts.cuts++;
    s->counts.starts++;
    s->runs = true;
    memcpy(s->boot, boot, sizeof boot);
}

/* The mode of that name, unless the command line names one. */
static void recall_mode(const struct gn_show *s, struct gn_options *o) {
    const char *mode = memory_of(s)->state.mode;
    const struct gn_settings *base = &o->all[0];
    const int found = gn_options_find_mode(o, mode);
    if (!mode[0] || o->settings->run.mode || o->is_lesson) return;
    if (gn_show_offers(s, o)) {
        o->resumes = gn_arena_strdup(&o->arena, mode);
        return;
    }
    if (o->mode_count == 0 && (gn_settings_from(base, render.shadow) == GN_SOURCE_FLAG ||
                               strcmp(mode, gn_techniques[base->render.shadow.items[0]].name) == 0))
        return;
    if (found)
        o->settings = &o->all[found];
    else
        gn_warn(s->warnings, "state: there is no mode \"%.60s\" any more; starting as configured",
                mode);
}

/* The place of that scene in the list of next-scene; 0: the first, or it is not there. */
static int list_place(const struct gn_options *o, const char *path) {
    const struct gn_scene_list *list = &o->all[0].scene.list;
    for (int i = 0; i < list->count; i++)
        if (list->paths[i] && strcmp(list->paths[i], path) == 0) return i;
    return 0;
}

static void recall_scene(struct gn_show *s, struct gn_options *o) {
    const struct gn_state *found = &memory_of(s)->state;
    const enum gn_source source = gn_settings_from(&o->all[0], scene.path);
    if (!found->scene[0] || source == GN_SOURCE_FLAG || o->is_lesson) return;
    if (!found->given) {
        s->first.scene = list_place(o, found->listed[0] ? found->listed : found->scene);
    } else if (access(found->scene, R_OK) == 0) {
        s->config.file = gn_show_put_file(o, found->scene);
        s->config.has_past = true; /* rollback: the configuration's */
    } else {
        snprintf(s->first.lost, sizeof s->first.lost, "scene %.400s: cannot open: %s", found->scene,
                 strerror(errno));
        s->first.instead = "configured scene";
    }
}

static void begin_state(void *part) {
    struct memory *m = part;
    struct gn_show *s = m->host->show;
    struct gn_options *o = s->config.options;
    const char *path = o->settings->kiosk.state;
    struct gn_err err = {0};
    if (strcmp(path, "no") == 0) return;
    snprintf(m->path, sizeof m->path, "%s", path);
    if (gn_state_read(&gn_disk, m->path, &m->state, &m->older, &err) == GN_STATE_BROKEN)
        gn_warn(s->warnings, "state: %s; starting as configured", err.text);
    memcpy(m->good[0], m->state.scene, PATH_MAX);
    memcpy(m->good[1], m->state.past, PATH_MAX);
    recall_scene(s, o);
    recall_mode(s, o);
    begin_counts(&m->state);
}

/* ---- another scene for the first ------------------------------------------------------------- */

/* What the state asked for is lost: the options as they are configured. */
static bool try_configured(struct gn_show *s, struct gn_options **options) {
    struct gn_err unused = {0};
    if (!s->config.file && s->first.scene == 0) return false;
    struct gn_options *fresh = gn_show_read_options(*options, NULL, &unused);
    if (!fresh) return false;
    gn_show_drop_options(*options);
    *options = fresh;
    s->config.file = NULL;
    s->config.has_past = false;
    s->first.scene = 0;
    recall_mode(s, fresh);
    s->first.instead = "configured scene";
    return true;
}

static bool try_good(struct gn_show *s, struct gn_options *o) {
    const char *path = o->settings->scene.path;
    while (s->first.tries < 2) {
        const char *good = memory_of(s)->good[s->first.tries++];
        if (!good[0] || !path || strcmp(good, path) == 0 || access(good, R_OK) != 0) continue;
        gn_show_replace_scene(o, path, good);
        s->first.instead = "last good scene";
        return true;
    }
    return false;
}

bool gn_show_try_other(struct gn_show *s, struct gn_options **options,
                       const struct gn_loaded *loaded) {
    struct gn_err err = loaded->err;
    if (loaded->scene || s->config.place || !memory_of(s)->path[0] ||
        !(*options)->settings->scene.path)
        return false;
    gn_stage_name_source((*options)->settings, &err);
    if (!s->first.lost[0]) snprintf(s->first.lost, sizeof s->first.lost, "%.480s", err.text);
    return try_configured(s, options) || try_good(s, *options);
}

/* ---- saving ---------------------------------------------------------------------------------- */

static void set_due(struct memory *m, int64_t now_ns) {
    const int64_t settled_ns = now_ns + SETTLE_NS, rested_ns = m->saved_ns + REST_NS;
    if (!m->changed)
        m->timer.due_ns = now_ns + COUNTS_NS;
    else
        m->timer.due_ns = m->saved_ns > 0 && rested_ns > settled_ns ? rested_ns : settled_ns;
}

static void report_failure(const struct memory *m, const struct gn_err *err) {
    char text[sizeof err->text + 64];
    snprintf(text, sizeof text, "state: %s (it will not outlast a restart)", err->text);
    gn_problem_report(m->host->problems, GN_PROBLEM_STATE, text);
}

static void begin_save(void *user, int64_t now_ns) {
    struct memory *m = user;
    m->saved_ns = m->begun ? now_ns : 0; /* after the first there is no rest */
    m->begun = true;
    m->changed = false;
    m->state.sequence++;
    gn_keeper_save(m->keeper, &m->state);
}

static void take_save(void *user, int64_t now_ns) {
    struct memory *m = user;
    struct gn_err err = {0};
    bool ok;
    if (!gn_keeper_take(m->keeper, &ok, &err)) return;
    if (ok)
        gn_problem_cure(m->host->problems, GN_PROBLEM_STATE);
    else
        report_failure(m, &err);
    m->changed |= !ok;
    set_due(m, now_ns);
}

static void open_state(void *part) {
    struct memory *m = part;
    struct gn_loop *loop = m->host->loop;
    struct gn_err err = {0}, unused = {0};
    if (!m->path[0]) return;
    m->keeper = gn_keeper_open(&gn_disk, m->path, m->older, &err);
    m->done = (struct gn_watch){.fd = m->keeper ? gn_keeper_fd(m->keeper) : -1,
                                .events = EPOLLIN,
                                .call = take_save,
                                .user = m};
    if (m->keeper && gn_loop_add(loop, &m->done)) {
        m->seen_ns = gn_loop_now_ns(loop);
        /* at once that it runs: a crash in the first seconds counts, too */
        m->timer = (struct gn_timer){.due_ns = m->seen_ns, .call = begin_save, .user = m};
        gn_loop_add_timer(loop, &m->timer);
        return;
    }
    if (m->keeper) gn_fail(&err, "%s: cannot wait for saves: %s", m->path, strerror(errno));
    gn_keeper_close(m->keeper, 0, &unused);
    m->keeper = NULL;
    report_failure(m, &err);
}

/* ---- what is remembered ---------------------------------------------------------------------- */

static void count(struct memory *m, int64_t now_ns) {
    const struct gn_show *s = m->host->show;
    struct gn_state_counts *c = &m->state.counts;
    const uint64_t frames = s->counts.frames;
    if (s->screen.stage.display.screen.lit && !gn_kiosk_is_dark(&s->screen.kiosk))
        m->shown_ns += now_ns - m->seen_ns;
    m->seen_ns = now_ns;
    c->seconds += (uint64_t)(m->shown_ns / GN_NS_PER_S);
    m->shown_ns %= GN_NS_PER_S;
    c->frames += frames >= m->frames ? frames - m->frames : frames;
    m->frames = frames;
    c->presses += s->counts.presses - m->presses;
    m->presses = s->counts.presses;
}

static bool take_text(const char *text, char *out, size_t size) {
    if (strncmp(out, text, size - 1) == 0) return false;
    snprintf(out, size, "%s", text);
    return true;
}

/* The scene of the configuration stays where another one is shown in its place. */
static bool take_scene(struct memory *m) {
    const struct gn_show *s = m->host->show;
    struct gn_state *state = &m->state;
    const char *path = s->scenes.paths[s->screen.scene];
    const bool given = s->config.file;
    char before[PATH_MAX];
    if (s->first.lost[0]) return false;
    const char *listed = s->scenes.paths[s->screen.kiosk.shown.scene];
    const bool changes = take_text(listed ? listed : "", state->listed, sizeof state->listed) ||
                         given != state->given;
    state->given = given;
    memcpy(before, state->scene, sizeof before);
    if (!take_text(path ? path : "", state->scene, sizeof state->scene)) return changes;
    if (before[0]) memcpy(state->past, before, sizeof before);
    return true;
}

static void look_at_state(void *part) {
    struct memory *m = part;
    const struct gn_show *s = m->host->show;
    const int64_t now_ns = gn_loop_now_ns(s->loop);
    if (!m->keeper) return;
    count(m, now_ns);
    if (s->reload.first) return; /* nothing is shown yet */
    const bool other =
        take_text(s->modes.names[s->screen.kiosk.shown.mode], m->state.mode, sizeof m->state.mode);
    if (!take_scene(m) && !other) return;
    const bool waits = m->changed;
    m->changed = true;
    if (!waits && !gn_keeper_is_busy(m->keeper)) set_due(m, now_ns);
}

static void end_state(void *part) {
    struct memory *m = part;
    if (!m->keeper) return;
    look_at_state(m);
    m->state.runs = m->host->show->failed;
    m->state.sequence++;
    gn_keeper_save(m->keeper, &m->state);
    gn_loop_remove(&m->done);
    gn_loop_remove_timer(&m->timer);
}

static void close_state(void *part) {
    struct memory *m = part;
    struct gn_err err = {0};
    if (!gn_keeper_close(m->keeper, END_NS, &err)) report_failure(m, &err);
    m->keeper = NULL;
}

/* ---- the part -------------------------------------------------------------------------------- */

static const void *state_status(void *part) {
    return ((const struct memory *)part)->path[0] ? part : NULL;
}

static const struct gn_metric metrics[] = {
    GN_METRIC(struct memory, path, "state.file", "", "what outlasts a restart"),
#define X(id) GN_METRIC(struct memory, state.counts.id, "state." #id, "", "over all starts"),
    GN_STATE_COUNTS(X)
#undef X
};

const struct gn_part gn_part_state = {
    .name = "state",
    .size = sizeof(struct memory),
    .begin = begin_state,
    .open = open_state,
    .look = look_at_state,
    .status = state_status,
    GN_PART_METRICS(metrics),
    .end = end_state,
    .close = close_state,
};
