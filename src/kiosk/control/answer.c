#include "kiosk/control/answer.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "core/turn.h"
#include "kiosk/private.h"
#include "kiosk/screenshot.h"

static const int64_t SCREENSHOT_NS = 5 * GN_NS_PER_S; /* limit until its frame comes */

struct waiting {                      /* a request that is answered later */
    const struct gn_request *request; /* NULL: none */
    const struct gn_transport *from;
};

struct answers { /* the part's memory */
    const struct gn_part_host *host;
    struct gn_timer screenshot_late;
    struct waiting screenshot, reload;
    char dark[256]; /* of the screenshot: why it is a text; "": it is a frame */
};

static void finish_screenshot(void *user, int64_t now_ns);

static struct answers *answers_of(const struct gn_show *s) { return s->parts.of[GN_PART_answers]; }

static void answer(struct waiting *w, json_t *reply) {
    const struct waiting to = *w;
    *w = (struct waiting){0};
    to.from->answer(to.from->self, to.request, reply);
}

static void refuse(struct waiting *w, const struct gn_err *why) {
    answer(w, gn_reply_failure(why));
}

/* ---- actions ---- */

/* While the screen is off a button only switches it on; a command also has its effect. */
static json_t *answer_action(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    const struct gn_request *r = w->request;
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

static json_t *answer_set(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    const struct gn_option_row *row = gn_changes_find(w->request->words[0], err);
    char text[1024];
    if (!row || !gn_show_set_option(&s->screen, row, w->request->words[1], err)) return NULL;
    gn_settings_text(s->screen.stage.settings, row, text, sizeof text);
    return json_pack("{s:s, s:o}", "key", row->name, "value", gn_reply_text(text));
}

static json_t *answer_get(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    const struct gn_option_row *row = gn_changes_find(w->request->words[0], err);
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

/* A picture that says it in the captions' font, as large as the screen is or was. */
static void begin_dark(struct gn_show *s, const char *why) {
    const struct gn_screen *screen = &s->screen.stage.display.screen;
    const struct gn_size *size = &s->screen.stage.settings->render.size;
    const bool known = screen->width_px > 0 && screen->height_px > 0;
    const struct gn_turned_size upright =
        gn_turned_upright(screen->rotate_deg, known ? screen->width_px : (uint32_t)size->width_px,
                          known ? screen->height_px : (uint32_t)size->height_px);
    const char *font = s->screen.stage.settings->render.font;
    char text[300];
    struct gn_err err = {0};
    if (s->screen.kiosk.blanked)
        snprintf(text, sizeof text, "Screen off. gnomon ctl blank off turns it on.");
    else
        snprintf(text, sizeof text, "Nothing is shown: %.280s.", why);
    if (!gn_screenshot_say(s->screenshot, upright.width_px, upright.height_px, font, text, &err))
        gn_screenshot_fail(s->screenshot, &err);
}

/* Answered when the picture is written. */
static json_t *answer_screenshot(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    struct answers *a = answers_of(s);
    const struct gn_request *r = w->request;
    const char *folder = s->screen.stage.settings->kiosk.screenshots;
    char target[PATH_MAX];
    if (!gn_screenshot_permits(r->words[0], r->fd, folder, target, err)) return NULL;
    if (!s->screenshot) s->screenshot = gn_screenshot_create(s->loop, finish_screenshot, s, err);
    if (!s->screenshot) return NULL;
    if (a->screenshot.request) {
        gn_fail(err, "busy");
    } else {
        const char *dark = why_dark(s);
        a->screenshot = *w;
        a->screenshot_late.due_ns = gn_loop_now_ns(s->loop) + SCREENSHOT_NS;
        gn_screenshot_ask(s->screenshot, target, r->fd);
        snprintf(a->dark, sizeof a->dark, "%s", dark ? dark : "");
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
    struct answers *a = answers_of(s);
    struct gn_err err = {0};
    bool ok;
    (void)now_ns;
    if (!gn_screenshot_take(s->screenshot, &ok, &err)) return;
    a->screenshot_late.due_ns = GN_LOOP_NEVER;
    if (!ok) {
        refuse(&a->screenshot, &err);
        return;
    }
    const char *file = a->screenshot.request->words[0];
    json_t *reply = json_pack("{s:o}", "file", gn_reply_text(file));
    if (a->dark[0]) json_object_set_new(reply, "dark", gn_reply_text(a->dark));
    answer(&a->screenshot, reply);
}

/* ---- reloading ---- */

/* Answered when the reload is done. */
static json_t *ask_reload(struct gn_show *s, const struct waiting *w, enum gn_reload_cause cause,
                          const char *file) {
    struct answers *a = answers_of(s);
    struct gn_err replaced;
    gn_fail(&replaced, "a later reload replaces this one");
    if (a->reload.request) refuse(&a->reload, &replaced);
    a->reload = *w;
    s->wants_reload = true;
    s->wish.cause = cause;
    snprintf(s->wish.file, sizeof s->wish.file, "%s", file);
    return NULL;
}

static json_t *answer_reload(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    (void)err;
    return ask_reload(s, w, GN_RELOAD_ASKED, "");
}

/* The client knows its own working directory; the kiosk opens the file with its own rights. */
static json_t *answer_scene(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    const char *file = w->request->words[0];
    if (file[0] == '/' && strlen(file) < sizeof s->wish.file)
        return ask_reload(s, w, GN_RELOAD_FILE, file);
    gn_fail_usage(err, "scene: expected a whole path, from / on");
    return NULL;
}

static json_t *answer_rollback(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    if (s->config.has_past) return ask_reload(s, w, GN_RELOAD_FILE, s->config.past);
    gn_fail(err, "rollback: no scene FILE has replaced another one");
    return NULL;
}

void gn_show_answer_reload(struct gn_show *s, const struct gn_err *why) {
    struct answers *a = answers_of(s);
    /* what is asked for waits for the first scene */
    if (!a->reload.request || s->wants_reload) return;
    if (why)
        refuse(&a->reload, why);
    else
        answer(&a->reload, gn_parts_status(&s->parts, true));
}

/* ---- requests ---- */

static json_t *answer_status(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    (void)w, (void)err;
    return gn_parts_status(&s->parts, false);
}

static json_t *answer_quit(struct gn_show *s, const struct waiting *w, struct gn_err *err) {
    (void)w, (void)err;
    s->ends = true;
    return json_object();
}

/* The reply; NULL with an error: refused; NULL without: it is answered later. */
typedef json_t *answer_fn(struct gn_show *s, const struct waiting *w, struct gn_err *err);
static answer_fn *const answers[GN_CTL_COUNT] = {
#define X(ID, ...) [GN_CTL_##ID] = answer_action,
    GN_ACTIONS(X)
#undef X
#define X(ID, id, ...) [GN_CTL_##ID] = answer_##id,
        GN_REQUESTS(X)
#undef X
};

void gn_show_take_request(struct gn_show *s, const struct gn_transport *from,
                          const struct gn_request *request) {
    struct waiting w = {.request = request, .from = from};
    struct gn_err err = {0};
    json_t *reply = answers[request->command](s, &w, &err);
    if (err.text[0])
        refuse(&w, &err);
    else if (reply || !(gn_ctl_rows[request->command].flags & GN_CTL_SLOW)) /* NULL: no memory */
        answer(&w, reply);
}

static void drop_screenshot(struct gn_show *s) {
    gn_screenshot_destroy(s->screenshot);
    s->screenshot = NULL;
}

void gn_show_forget_requests(struct gn_show *s, const struct gn_transport *from) {
    struct answers *a = answers_of(s);
    if (a->reload.from == from) a->reload = (struct waiting){0};
    if (a->screenshot.from != from) return;
    drop_screenshot(s); /* the descriptor that it is written to is the transport's */
    a->screenshot = (struct waiting){0};
}

/* ---- the part -------------------------------------------------------------------------------- */

static void open_answers(void *part) {
    struct answers *a = part;
    struct gn_show *s = a->host->show;
    a->screenshot_late =
        (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = give_up_screenshot, .user = s};
    gn_loop_add_timer(s->loop, &a->screenshot_late);
}

static void close_answers(void *part) {
    struct answers *a = part;
    gn_loop_remove_timer(&a->screenshot_late);
    drop_screenshot(a->host->show);
}

const struct gn_part gn_part_answers = {
    .name = "answers",
    .size = sizeof(struct answers),
    .open = open_answers,
    .close = close_answers,
};
