#include "display/kms/kms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "display/kms/state.h"

#define SETTLE_NS (GN_KMS_S / 10) /* connectors bounce when a monitor is plugged in */

/* ---- published state ---- */

static void publish_state(struct gn_kms *k, int64_t now_ns) {
    struct gn_screen *s = &k->screen;
    const bool copies = k->buffers.opts.fallback == GN_FALLBACK_COPY;
    const bool ready = k->monitor.connected && k->master && !k->away && !k->blank && !s->lost &&
                       !k->text.message[0] && !k->text.changed;
    s->blank = k->blank;
    s->lit = ready && k->lit;
    s->may_draw = ready && !k->frames.waiting.fb && gn_flip_may_draw(&k->flip, now_ns) &&
                  (copies || k->env.scanout->has_free(k->device.scanout));
    s->width_px = k->monitor.connected ? k->buffers.opts.width_px : 0;
    s->height_px = k->monitor.connected ? k->buffers.opts.height_px : 0;
    s->range = k->output.range.is_set ? k->opts->range : GN_RANGE_AUTO;
    s->lacks_range = k->monitor.connected && k->output.range.lacks;
    s->what[0] = 0;
    if (k->monitor.connected)
        snprintf(s->what, sizeof s->what, "%s %ux%u@%.2f %s%s", k->monitor.connector, s->width_px,
                 s->height_px, gn_kms_mode_mhz(&k->monitor.candidates[k->monitor.mode]) / 1000.0,
                 k->output.atomic ? "atomic" : "legacy",
                 s->range == GN_RANGE_FULL      ? ", full range"
                 : s->range == GN_RANGE_LIMITED ? ", limited range"
                                                : "");
    s->rotate_deg = (k->opts->rotate_deg + k->monitor.orientation_deg) % 360;
    s->srgb = !copies && k->buffers.surface.srgb;
    s->period_ns = k->flip.period_ns;
    s->seen_ns = k->flip.period_ns > 0 ? gn_flip_seen_ns(&k->flip, now_ns) : now_ns;
    s->counts.shown = k->flip.shown;
    s->counts.missed = k->flip.missed;
    s->counts.stalled = k->flip.stalls;

    char *out = s->status;
    const size_t size = sizeof s->status;
    *out = 0;
    if (k->device.fd < 0 || k->screen.lost)
        snprintf(out, size, "waiting for a card%s%s", k->text.reason[0] ? ": " : "",
                 k->text.reason);
    else if (k->away)
        snprintf(out, size, "another console is active");
    else if (k->blank)
        snprintf(out, size, "switched off");
    else if (!k->monitor.connected && k->text.reason[0])
        snprintf(out, size, "%s", k->text.reason);
    else if (!k->monitor.connected)
        snprintf(out, size, "waiting for a monitor%s%s", k->opts->connector ? " on " : "",
                 k->opts->connector ? k->opts->connector : "");
    else if (k->text.message[0])
        snprintf(out, size, "%s", k->text.message);
    else if (!k->master)
        snprintf(out, size, "%s controls the screen (%s)",
                 k->text.holder[0] ? k->text.holder : "another program", k->device.node.path);
}

const struct gn_screen *gn_kms_screen(const struct gn_kms *k) { return &k->screen; }

int gn_kms_fd(const struct gn_kms *k) { return k->screen.lost ? -1 : k->device.fd; }

gn_display_proc gn_kms_get_proc(struct gn_kms *k, const char *name) {
    return k->device.scanout ? k->env.scanout->get_proc(k->device.scanout, name) : NULL;
}

static int64_t sooner(int64_t a, int64_t b) { return a < b ? a : b; }

static bool may_send_waiting(const struct gn_kms *k) {
    return k->frames.waiting.fb && !k->blank && k->monitor.connected && k->master &&
           !k->flip.pending;
}

int64_t gn_kms_deadline(const struct gn_kms *k, int64_t now_ns) {
    int64_t at = k->due.scan_ns;
    if (k->screen.lost) return GN_KMS_NEVER;
    if (!k->master && !k->away && k->device.fd >= 0) at = sooner(at, k->due.master_ns);
    if (!k->monitor.connected && !k->flip.pending) return at;
    if (gn_kms_may_sleep(k)) return sooner(at, k->due.sleep_ns > now_ns ? k->due.sleep_ns : now_ns);
    if (k->blank && !k->flip.pending) return at;
    at = sooner(at, gn_flip_deadline(&k->flip, now_ns));
    if (may_send_waiting(k)) at = sooner(at, k->flip.next_ns > now_ns ? k->flip.next_ns : now_ns);
    if (k->lit && !k->flip.pending && !k->frames.waiting.fb) at = sooner(at, k->due.again_ns);
    return at;
}

/* ---- steps ---- */

static void apply_events(struct gn_kms *k, unsigned events, int64_t now_ns) {
    const bool has_card = k->device.fd >= 0 && !k->screen.lost;
    if (events & GN_KMS_EVENT_VT_LEFT) {
        k->away = true;
        k->lit = false;
        if (has_card && k->master) k->env.drm->DropMaster(k->device.fd);
        if (has_card) k->master = false;
        if (has_card) k->due.master_ns = GN_KMS_NEVER;
    }
    if (events & GN_KMS_EVENT_VT_ENTERED) {
        k->away = false;
        /* a program in between has ended the flip; after a short switch its event may still come */
        if (k->flip.pending && k->flip.stalled) gn_kms_flip_is_lost(k);
        if (has_card) gn_kms_try_master(k, now_ns);
        k->due.scan_ns = k->due.probe_ns = now_ns;
    }
    if (events & GN_KMS_EVENT_READABLE && has_card) gn_kms_drain(k, now_ns);
    if (!(events & GN_KMS_EVENT_HOTPLUG)) return;
    k->due.scan_ns = sooner(k->due.scan_ns, now_ns + SETTLE_NS);
    k->due.probe_ns = sooner(k->due.probe_ns, k->due.scan_ns);
}

/* Returns false when recovery has failed. */
static bool apply_flip_act(struct gn_kms *k, enum gn_flip_act what, int64_t now_ns) {
    if (k->blank && what != GN_FLIP_WAIT && what != GN_FLIP_DRAIN) { /* no recovery while blanked */
        gn_kms_flip_is_lost(k);
        k->flip.lost_flips--;
        return true;
    }
    switch (what) {
    case GN_FLIP_WAIT: return true;
    case GN_FLIP_DRAIN: gn_kms_drain(k, now_ns); return true;
    case GN_FLIP_RELIGHT:
        gn_kms_flip_is_lost(k);
        if (k->master) gn_kms_output_dark(&k->output);
        return true;
    case GN_FLIP_REOPEN: gn_kms_leave_card(k, true, now_ns); return true;
    case GN_FLIP_GIVE_UP: break;
    }
    return false;
}

void gn_kms_lose(struct gn_kms *k, int64_t now_ns) {
    gn_kms_leave_card(k, true, now_ns);
    publish_state(k, now_ns);
}

/* Without GL the reason is shown already and is more important. */
void gn_kms_show_message(struct gn_kms *k, const char *text, int64_t now_ns) {
    const bool ends = !text || !*text;
    if (k->device.scanout && (!ends || k->text.message[0])) {
        snprintf(k->text.message, sizeof k->text.message, "%s", ends ? "" : text);
        struct gn_kms_frame waiting = k->frames.waiting;
        if (waiting.fb) gn_kms_discard(k, &waiting);
        k->text.changed = true;
    }
    gn_kms_step(k, 0, now_ns, NULL);
}

bool gn_kms_step(struct gn_kms *k, unsigned events, int64_t now_ns, struct gn_err *err) {
    bool ok = true;
    apply_events(k, events, now_ns);
    if (!k->screen.lost && k->device.fd >= 0) {
        const enum gn_flip_act what = gn_flip_step(&k->flip, now_ns);
        ok = apply_flip_act(k, what, now_ns);
        if (ok && may_send_waiting(k) && now_ns >= k->flip.next_ns) {
            if (now_ns - k->frames.waiting_ns < 12 * GN_KMS_S) {
                gn_kms_send(k, k->frames.waiting, now_ns);
            } else { /* refused for as long as a flip may take: counts as a lost flip */
                k->frames.waiting_ns = now_ns;
                ok = apply_flip_act(k, gn_flip_lost(&k->flip), now_ns);
            }
        }
        const bool may_repeat = k->lit && k->master && k->frames.front.fb && !k->flip.pending &&
                                !k->frames.waiting.fb && !k->blank;
        if (may_repeat && now_ns >= k->due.again_ns) gn_kms_send(k, k->frames.front, now_ns);
    }
    if (!k->screen.lost && !k->master && !k->away && k->device.fd >= 0 &&
        now_ns >= k->due.master_ns)
        gn_kms_try_master(k, now_ns);
    if (!k->screen.lost && k->text.changed && !k->flip.pending) { /* no change during a flip */
        k->text.changed = false;
        gn_kms_drop_surface(k);
        k->monitor.connected = k->lit = false;
        if (k->due.scan_ns > now_ns) k->due.scan_ns = now_ns;
    }
    if (!k->screen.lost && now_ns >= k->due.scan_ns) gn_kms_scan(k, now_ns);
    /* the message is sent once: the screen keeps it */
    const bool may_send_message = !k->screen.lost && k->device.fd >= 0 && k->master && !k->away &&
                                  k->monitor.connected && !k->blank && !k->lit &&
                                  !k->flip.pending && !k->frames.waiting.fb && !k->text.changed;
    if (may_send_message && k->text.message[0]) gn_kms_send_message(k, now_ns);
    gn_kms_sleep(k, now_ns);
    publish_state(k, now_ns);
    if (ok && k->losses <= 3) return true;
    gn_fail(err, "%s: %s %s; see the kernel log",
            k->monitor.connector[0] ? k->monitor.connector : "display",
            ok ? "the GL context is lost again and again on" : "page flips no longer complete on",
            k->device.node.path);
    if (err) err->status = GN_EXIT_DISPLAY;
    return false;
}

bool gn_kms_present(struct gn_kms *k, int64_t now_ns, struct gn_err *err) {
    gn_kms_send_drawn(k, now_ns);
    return gn_kms_step(k, 0, now_ns, err);
}

void gn_kms_blank(struct gn_kms *k, bool on, int64_t now_ns) {
    gn_kms_set_blank(k, on, now_ns);
    gn_kms_step(k, 0, now_ns, NULL);
}

bool gn_kms_renew(struct gn_kms *k, int64_t now_ns, struct gn_err *err) {
    gn_kms_close_card(k);
    k->screen.lost = false;
    k->due.scan_ns = now_ns;
    return gn_kms_step(k, 0, now_ns, err);
}

/* ---- create and destroy ---- */

struct gn_kms *gn_kms_create(const struct gn_kms_env *env, const struct gn_screen_opts *opts,
                             int64_t now_ns) {
    struct gn_kms *k = gn_xalloc(1, sizeof *k);
    /* a copy of the options, followed by their texts */
    const char *const texts[] = {opts->connector, opts->card, opts->render_node, opts->modeline};
    size_t size = sizeof *opts;
    for (int i = 0; i < 4; i++) size += texts[i] ? strlen(texts[i]) + 1 : 0;
    struct gn_screen_opts *copy = gn_xalloc(1, size);
    *copy = *opts;
    const char **const copies[] = {&copy->connector, &copy->card, &copy->render_node,
                                   &copy->modeline};
    char *at = (char *)(copy + 1);
    for (int i = 0; i < 4; i++)
        if (texts[i]) {
            const size_t length = strlen(texts[i]) + 1;
            *copies[i] = memcpy(at, texts[i], length);
            at += length;
        }
    k->env = *env;
    k->opts = copy;
    k->device.fd = -1;
    k->frames.front.fence = k->frames.pending.fence = k->frames.waiting.fence = -1;
    k->due.scan_ns = now_ns;
    k->due.master_ns = k->due.again_ns = GN_KMS_NEVER;
    gn_kms_step(k, 0, now_ns, NULL);
    return k;
}

void gn_kms_destroy(struct gn_kms *k) {
    if (!k) return;
    if (k->device.fd >= 0 && k->output.drm) {
        gn_kms_drop_surface(k);
        gn_kms_output_close(&k->output, k->master);
    }
    gn_kms_close_card(k);
    free((void *)k->opts);
    free(k);
}
