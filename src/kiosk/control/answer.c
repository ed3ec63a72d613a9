#include "kiosk/control/answer.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/control/control.h"
#include "kiosk/control/listen.h"
#include "kiosk/private.h"
#include "kiosk/screenshot.h"

static const int64_t SCREENSHOT_NS = 5 * GN_NS_PER_S; /* limit until its frame comes */
static const int64_t AGAIN_NS = 5 * GN_NS_PER_S;      /* until a socket is tried again */

struct gn_show_control { /* the part's memory */
    const struct gn_part_host *host;
    struct gn_control *control;
    struct gn_timer screenshot_late;
    struct gn_timer again;                        /* while there is no socket */
    const struct gn_request *screenshot, *reload; /* to be answered later; NULL: none */
    char dark[256];                  /* of the screenshot: why it is a text; "": it is a frame */
    struct gn_control_counts counts; /* for the status */
};

/* ---- opening ---- */

static void finish_screenshot(void *user, int64_t now_ns);
static void give_up_screenshot(void *user, int64_t now_ns);

static void close_all(struct gn_show *s, struct gn_show_control *c) {
    gn_loop_remove_timer(&c->screenshot_late);
    gn_screenshot_destroy(s->screenshot);
    s->screenshot = NULL;
    gn_control_close(c->control);
    c->control = NULL;
}

/* The caption says so, too, where the configuration names a socket; once for each reason. */
static void report_closed(struct gn_show *s, bool named, const char *why) {
    if (strcmp(s->problems.of[GN_PROBLEM_CONTROL], why) == 0) return;
    if (named)
        gn_show_report_error(s, GN_PROBLEM_CONTROL, why);
    else
        gn_problem_report(&s->problems, GN_PROBLEM_CONTROL, why);
}

static void report_opened(struct gn_show *s) {
    const char *shown = s->config.options->config_error;
    if (shown && strcmp(shown, s->problems.of[GN_PROBLEM_CONTROL]) == 0)
        s->config.options->config_error = NULL;
    gn_problem_cure(&s->problems, GN_PROBLEM_CONTROL);
    s->screen.changed = true;
}

/* Descriptors, the folder or another kiosk's lock may be what is missing, and come. */
static void open_again(void *part, int64_t now_ns);

static void open_control(void *part) {
    struct gn_show_control *c = part;
    struct gn_show *s = c->host->show;
    char path[GN_LISTEN_PATH_MAX];
    struct gn_err err = {0};
    const char *named = s->screen.stage.settings->kiosk.socket;
    if (!named && (s->screen.stage.display.ops->is_window || !gn_listen_default(path, sizeof path)))
        return;
    c->screenshot_late =
        (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = give_up_screenshot, .user = s};
    gn_loop_add_timer(s->loop, &c->screenshot_late);
    s->screenshot = gn_screenshot_create(s->loop, finish_screenshot, s, &err);
    c->control = s->screenshot ? gn_control_open(named ? named : path, s->loop, &err) : NULL;
    if (c->control) {
        s->control = c;
        if (s->problems.of[GN_PROBLEM_CONTROL][0]) report_opened(s);
        return;
    }
    report_closed(s, named, err.text);
    close_all(s, c);
    c->again = (struct gn_timer){
        .due_ns = gn_loop_now_ns(s->loop) + AGAIN_NS, .call = open_again, .user = c};
    gn_loop_add_timer(s->loop, &c->again);
}

static void open_again(void *part, int64_t now_ns) {
    struct gn_show_control *c = part;
    (void)now_ns;
    gn_loop_remove_timer(&c->again);
    open_control(c);
}

static void close_control(void *part) {
    struct gn_show_control *c = part;
    struct gn_show *s = c->host->show;
    gn_loop_remove_timer(&c->again);
    if (s->control) close_all(s, c);
    s->control = NULL;
}

/* ---- actions ---- */

/* While the screen is off a button only switches it on; a command also has its effect. */
static json_t *answer_action(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    struct gn_action action = {.kind = gn_ctl_action(r->command), .name = r->words[0]};
    const int64_t now_ns = gn_loop_now_ns(s->loop);
    const struct gn_ctl_row *row = &gn_ctl_rows[r->command];
    const bool turns = gn_ctl_words_least(r->command) < gn_ctl_words(r->command);
    if (turns && !gn_turn_parse(r->words[0], &action.turn, err)) {
        gn_fail_prefix(err, "%s", row->name);
        return NULL;
    }
    if (!gn_show_check_action(&s->screen, &action, err)) return NULL;
    const bool was_dark = s->screen.kiosk.blanked;
    gn_show_act(&s->screen, &action, now_ns);
    if (was_dark && action.kind != GN_ACTION_BLANK) gn_show_act(&s->screen, &action, now_ns);
    return gn_parts_status(&s->parts, true);
}

/* ---- options ---- */

static json_t *answer_set(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    const struct gn_option_row *row = gn_changes_find(r->words[0], err);
    char text[1024];
    if (!row || !gn_show_set_option(&s->screen, row, r->words[1], err)) return NULL;
    gn_settings_text(s->screen.stage.settings, row, text, sizeof text);
    return json_pack("{s:s, s:o}", "key", row->name, "value", gn_reply_text(text));
}

static json_t *answer_get(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    const struct gn_option_row *row = gn_changes_find(r->words[0], err);
    char text[1024];
    if (!row) return NULL;
    const struct gn_settings *o = s->screen.stage.settings;
    const bool given = gn_settings_source(o, row->offset) != GN_SOURCE_DEFAULT;
    gn_settings_text(o, row, text, sizeof text);
    return json_pack("{s:s, s:o, s:o}", "key", row->name, "value", gn_reply_text(text), "from",
                     gn_reply_text(given ? gn_settings_label_at(o, row->offset) : "the default"));
}

/* ---- screenshots ---- */

/* Why the screen shows nothing; NULL: it shows a picture, or soon will. */
static const char *why_dark(const struct gn_show *s) {
    const struct gn_screen *screen = &s->screen.stage.display.screen;
    if (s->screen.kiosk.asleep && !s->screen.kiosk.woken)
        return "the screen is off, outside of the hours of [schedule]";
    if (s->screen.kiosk.blanked) return "the screen is switched off by blank";
    return screen->status[0] && !screen->lit ? screen->status : NULL;
}

/* A picture that says it, as large as the screen is or was. */
static void begin_dark(struct gn_show *s, const char *why) {
    const struct gn_screen *screen = &s->screen.stage.display.screen;
    const struct gn_size *size = &s->screen.stage.settings->render.size;
    const bool known = screen->width_px > 0 && screen->height_px > 0,
               on_side = screen->rotate_deg % 180 != 0;
    const uint32_t width = known ? screen->width_px : (uint32_t)size->width_px,
                   height = known ? screen->height_px : (uint32_t)size->height_px;
    char text[300];
    struct gn_err err = {0};
    snprintf(text, sizeof text, "gnomon: %.280s", why);
    if (!gn_screenshot_say(s->screenshot, on_side ? height : width, on_side ? width : height, text,
                           &err))
        gn_screenshot_fail(s->screenshot, &err);
}

/* Answered when the picture is written. */
static json_t *answer_screenshot(struct gn_show *s, const struct gn_request *r,
                                 struct gn_err *err) {
    struct gn_show_control *c = s->control;
    const char *folder = s->screen.stage.settings->kiosk.screenshots;
    char target[PATH_MAX];
    if (!gn_screenshot_permits(r->words[0], r->fd, folder, target, err)) return NULL;
    if (c->screenshot) {
        gn_fail(err, "busy");
    } else {
        const char *dark = why_dark(s);
        c->screenshot = r;
        c->screenshot_late.due_ns = gn_loop_now_ns(s->loop) + SCREENSHOT_NS;
        gn_screenshot_ask(s->screenshot, target, r->fd);
        snprintf(c->dark, sizeof c->dark, "%s", dark ? dark : "");
        if (dark)
            begin_dark(s, dark);
        else
            s->screen.changed = true;
    }
    return NULL;
}

static void give_up_screenshot(void *user, int64_t now_ns) {
    const struct gn_show *s = user;
    struct gn_err err = {0};
    (void)now_ns;
    if (!gn_screenshot_is_asked(s->screenshot)) return;
    gn_fail(&err, "screenshot: no frame came: %s", s->screen.stage.display.screen.status);
    gn_screenshot_fail(s->screenshot, &err);
}

static void finish_screenshot(void *user, int64_t now_ns) {
    const struct gn_show *s = user;
    struct gn_show_control *c = s->control;
    const struct gn_request *r = c->screenshot;
    struct gn_err err = {0};
    bool ok;
    (void)now_ns;
    if (!gn_screenshot_take(s->screenshot, &ok, &err)) return;
    c->screenshot = NULL;
    c->screenshot_late.due_ns = GN_LOOP_NEVER;
    if (!ok) {
        gn_control_refuse(c->control, r, &err);
        return;
    }
    json_t *reply = json_pack("{s:o}", "file", gn_reply_text(r->words[0]));
    if (c->dark[0]) json_object_set_new(reply, "dark", gn_reply_text(c->dark));
    gn_control_answer(c->control, r, reply);
}

/* ---- reloading ---- */

/* Answered when the reload is done. */
static json_t *ask_reload(struct gn_show *s, const struct gn_request *r, enum gn_reload_cause cause,
                          const char *file) {
    struct gn_show_control *c = s->control;
    struct gn_err replaced;
    gn_fail(&replaced, "a later reload replaces this one");
    if (c->reload) gn_control_refuse(c->control, c->reload, &replaced);
    c->reload = r;
    s->reloads = true;
    s->wish.cause = cause;
    snprintf(s->wish.file, sizeof s->wish.file, "%s", file);
    return NULL;
}

static json_t *answer_reload(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    (void)err;
    return ask_reload(s, r, GN_RELOAD_ASKED, "");
}

/* The client knows its own working directory; the kiosk opens the file with its own rights. */
static json_t *answer_scene(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    const char *file = r->words[0];
    if (file[0] == '/' && strlen(file) < sizeof s->wish.file)
        return ask_reload(s, r, GN_RELOAD_FILE, file);
    gn_fail_usage(err, "scene: expected a whole path, from / on");
    return NULL;
}

static json_t *answer_rollback(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    if (s->config.has_past) return ask_reload(s, r, GN_RELOAD_FILE, s->config.past);
    gn_fail(err, "rollback: no scene FILE has replaced another one");
    return NULL;
}

void gn_show_answer_reload(struct gn_show *s, const struct gn_err *why) {
    struct gn_show_control *c = s->control;
    if (!c || s->reloads) return; /* what is asked for waits for the first scene */
    const struct gn_request *r = c->reload;
    c->reload = NULL;
    if (r && why) gn_control_refuse(c->control, r, why);
    if (r && !why) gn_control_answer(c->control, r, gn_parts_status(&s->parts, true));
}

/* ---- requests ---- */

static json_t *answer_status(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    (void)r, (void)err;
    return gn_parts_status(&s->parts, false);
}

static json_t *answer_quit(struct gn_show *s, const struct gn_request *r, struct gn_err *err) {
    (void)r, (void)err;
    s->ends = true;
    return json_object();
}

/* The reply; NULL with an error: refused; NULL without: it is answered later. */
typedef json_t *answer_fn(struct gn_show *s, const struct gn_request *r, struct gn_err *err);
static answer_fn *const answers[GN_CTL_COUNT] = {
#define X(ID, ...) [GN_CTL_##ID] = answer_action,
    GN_ACTIONS(X)
#undef X
#define X(ID, id, ...) [GN_CTL_##ID] = answer_##id,
        GN_REQUESTS(X)
#undef X
};

static void answer_requests(void *part) {
    struct gn_show_control *c = part;
    struct gn_show *s = c->host->show;
    if (!s->control) return;
    for (const struct gn_request *r; (r = gn_control_next(c->control)) != NULL;) {
        struct gn_err err = {0};
        json_t *reply = answers[r->command](s, r, &err);
        if (err.text[0])
            gn_control_refuse(c->control, r, &err);
        else if (reply || !(gn_ctl_rows[r->command].flags & GN_CTL_SLOW)) /* NULL: no memory */
            gn_control_answer(c->control, r, reply);
    }
}

/* ---- the part -------------------------------------------------------------------------------- */

static const void *control_status(void *part) {
    struct gn_show_control *c = part;
    if (!c->host->show->control) return NULL;
    c->counts = gn_control_counts(c->control);
    return c;
}

#define METRIC(member, ...)                                                                        \
    GN_METRIC(struct gn_show_control, counts.member, "control." #member, __VA_ARGS__)
static const struct gn_metric metrics[] = {
    METRIC(accepted, "", "clients"),
    METRIC(refused, "", "clients that were not permitted, or too many"),
    METRIC(requests, "", "of clients"),
    METRIC(wrong, "", "requests that could not be parsed"),
    METRIC(busy, "", "requests that came too often"),
    METRIC(answered, "", "requests"),
    METRIC(cut, "", "clients closed because they did not read"),
};

const struct gn_part gn_part_control = {
    .name = "control",
    .size = sizeof(struct gn_show_control),
    .open = open_control,
    .look = answer_requests,
    .status = control_status,
    GN_PART_METRICS(metrics),
    .close = close_control,
};
