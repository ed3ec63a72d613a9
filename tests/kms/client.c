#include "client.h"

#include <string.h>

#include "core/err.h"
#include "unit/check.h"

enum { SPINS_MAX = 300 };

static bool find_holder(const char *node, char *out, size_t size) {
    (void)node;
    if (size > 0) out[0] = 0;
    return false;
}

static struct gn_kms_env env = {.drm = &sim_drm, .scanout = &sim_gl, .find_holder = find_holder};

static float drawn = 1;

void client_draws(float share) { drawn = share; }

void client_has_uevents(bool uevents) { env.no_uevents = !uevents; }

const struct gn_screen *client_screen(const struct client *c) { return gn_kms_screen(c->kms); }

void client_begin(struct client *c, const struct client_kind *kind, int monitor) {
    sim_begin();
    sim_set_gpu(&kind->gpu);
    sim_add_card(0, "/dev/dri/card0", &kind->traits);
    sim_plug(0, 0, monitor);
    client_open(c, &kind->opts);
    if (monitor != SIM_NO_MONITOR) client_frames(c, 5);
}

void client_end(struct client *c, const struct client_kind *kind) {
    client_close(c);
    if (sim_end() != 0) fail_msg("%s: %s", kind->name, sim_complaint());
}

void client_open(struct client *c, const struct gn_screen_opts *opts) {
    *c = (struct client){.opts = *opts, .moves = true, .changed = true, .told_ns = sim_now()};
    c->kms = gn_kms_create(&env, &c->opts, sim_now());
}

void client_begin_alone(struct client *c, int monitor, const struct gn_screen_opts *opts) {
    sim_begin();
    sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){.console = true});
    sim_plug(0, 0, monitor);
    client_open(c, opts);
    client_frames(c, 3);
}

void client_close(struct client *c) {
    gn_kms_destroy(c->kms);
    c->kms = NULL;
}

void client_leave_console(struct client *c) {
    c->away = true;
    c->heard |= GN_KMS_EVENT_VT_LEFT;
}

void client_enter_console(struct client *c) {
    c->away = false;
    c->heard |= GN_KMS_EVENT_VT_ENTERED;
}

void client_blank(struct client *c, bool on) {
    c->blank = on;
    c->told_ns = sim_now();
    gn_kms_blank(c->kms, on, c->told_ns);
}

/* ---- a step ---- */

static unsigned take_events(struct client *c) {
    unsigned events = c->heard;
    c->heard = 0;
    if (sim_readable(gn_kms_fd(c->kms))) events |= GN_KMS_EVENT_READABLE;
    if (sim_take_uevent() && !env.no_uevents) events |= GN_KMS_EVENT_HOTPLUG;
    return events;
}

/* A new process, as the supervisor starts one. */
static void start_anew(struct client *c) {
    c->gave_up = true;
    c->restarts++;
    gn_kms_destroy(c->kms);
    c->told_ns = sim_now();
    c->kms = gn_kms_create(&env, &c->opts, c->told_ns);
    if (c->away) c->heard |= GN_KMS_EVENT_VT_LEFT;
    if (c->blank) client_blank(c, true);
}

static bool wants_frame(const struct client *c) {
    const struct gn_screen *s = client_screen(c);
    return s->may_draw && (c->moves || c->changed || s->damaged || !s->lit);
}

static bool draw(struct client *c, struct gn_err *err) {
    const struct gn_screen *s = client_screen(c);
    c->told_ns = sim_now();
    if (!gn_kms_begin(c->kms, c->told_ns, err)) return !err->text[0];
    c->colour = c->colour % 1000000 + 1;
    const uint32_t width_px = 2 * (uint32_t)(drawn * (float)s->width_px / 2),
                   height_px = 2 * (uint32_t)(drawn * (float)s->height_px / 2);
    if (s->copy_to)
        sim_paint_copy(s->copy_to, c->colour);
    else if (drawn < 1 && gn_kms_scale(c->kms, width_px, height_px)) {
        sim_paint_part(c->colour, width_px, height_px);
        c->scaled++;
    } else
        sim_paint(c->colour);
    c->frames++;
    c->changed = false;
    if (c->blank) sim_complain("frame drawn while blank");
    return gn_kms_present(c->kms, c->told_ns, err);
}

static void after_console_switch(struct client *c, unsigned events) {
    if (!(events & GN_KMS_EVENT_VT_LEFT)) return;
    if (sim_is_master(gn_kms_fd(c->kms)) && sim_counts.failed == 0)
        sim_complain("still master on another console");
    for (int n = 0; n < SIM_CARDS; n++) sim_console_takes(n);
}

static void count_spin(struct client *c) {
    c->steps++;
    if (sim_now() > c->now_ns) c->spins = 0;
    c->now_ns = sim_now();
    if (++c->spins == SPINS_MAX) sim_complain("busy loop: %s", client_screen(c)->status);
}

static void step(struct client *c) {
    struct gn_err err = {0};
    count_spin(c);
    const unsigned events = take_events(c);
    c->told_ns = sim_now();
    bool ok = gn_kms_step(c->kms, events, c->told_ns, &err);
    after_console_switch(c, events);
    if (ok && client_screen(c)->lost) {
        c->told_ns = sim_now();
        ok = gn_kms_renew(c->kms, c->told_ns, &err);
    }
    if (ok && wants_frame(c)) ok = draw(c, &err);
    if (ok) return;
    if (!err.text[0]) sim_complain("gave up without an error");
    start_anew(c);
}

/* ---- time ---- */

/* Whether the kiosk would step again at once. */
static bool is_busy(const struct client *c) {
    return client_screen(c)->lost || wants_frame(c) || c->heard || sim_readable(gn_kms_fd(c->kms));
}

static int64_t next(const struct client *c, int64_t until_ns) {
    if (is_busy(c)) return sim_now();
    const int64_t own_ns = gn_kms_deadline(c->kms, c->told_ns), world_ns = sim_next();
    int64_t at_ns = own_ns < world_ns ? own_ns : world_ns;
    if (at_ns > until_ns) at_ns = until_ns;
    return at_ns > sim_now() ? at_ns : sim_now();
}

static bool spins(const struct client *c) { return c->spins >= SPINS_MAX; }

void client_run(struct client *c, int64_t for_ns) {
    const int64_t until_ns = sim_now() + for_ns;
    do {
        step(c);
        sim_run_to(next(c, until_ns));
    } while (sim_now() < until_ns && !spins(c));
}

void client_frames(struct client *c, long count) {
    const long most = c->frames + count;
    const int64_t until_ns = sim_now() + 5 * SIM_S;
    while (c->frames < most && sim_now() < until_ns && !spins(c)) {
        step(c);
        sim_run_to(next(c, until_ns));
    }
}

static bool is_right(const struct client *c) {
    const struct gn_screen *s = client_screen(c);
    return s->lit && s->status[0] == 0 && c->colour > 0 && sim_shows(c->colour);
}

static void run_until_right(struct client *c, int64_t until_ns) {
    while (!(is_right(c) && !c->changed) && sim_now() < until_ns && !spins(c)) {
        step(c);
        sim_run_to(next(c, until_ns));
    }
}

bool client_settle(struct client *c, int64_t within_ns, int64_t *took_ns) {
    const int64_t from_ns = sim_now();
    c->moves = false;
    c->changed = true;
    *took_ns = 0;
    for (int i = 0; i < 3; i++) { /* other programs may act between these steps */
        const int64_t now_ns = i == 0 ? from_ns : sim_now();
        run_until_right(c, now_ns + within_ns);
        if (sim_now() - now_ns > *took_ns) *took_ns = sim_now() - now_ns;
        if (!is_right(c)) return false;
        client_run(c, 12 * SIM_S);
        if (is_right(c)) return true;
    }
    return false;
}
