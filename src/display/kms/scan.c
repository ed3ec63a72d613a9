/* Selects card, connector, mode and buffers, with fallbacks. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "display/kms/state.h"

enum { UNREADABLE_MAX = 4 }; /* scans before an unreadable object is ignored */

/* ---- cards ---- */

#define BY_PATH "/dev/dri/by-path/"

static bool leads_to(const char *link, const char *path) {
    char target[PATH_MAX];
    return realpath(link, target) && strcmp(target, path) == 0;
}

/* Matches the path, a link to it, or its place: "platform-gpu-card" is the same as "platform-gpu",
 * with or without /dev/dri/by-path, which only udev creates. */
static bool is_configured(const struct gn_kms *k, const struct gn_kms_node *node) {
    const size_t folder = sizeof BY_PATH - 1, length = strlen(node->place);
    const char *card = k->opts->card;
    char link[PATH_MAX];
    if (!card || strcmp(card, node->path) == 0 || leads_to(card, node->path)) return true;
    if (strncmp(card, BY_PATH, folder) == 0) card += folder;
    snprintf(link, sizeof link, BY_PATH "%s", card);
    if (leads_to(link, node->path)) return true;
    return length > 0 && strncmp(card, node->place, length) == 0 &&
           (card[length] == 0 || strcmp(card + length, "-card") == 0);
}

/* Score of a card, -1 if it cannot show anything. The snapshot is left in device.fresh. */
static int score_card(struct gn_kms *k, const struct gn_kms_node *node, bool probe, int *fd) {
    struct gn_err why = {0};
    if (!is_configured(k, node)) return -1;
    *fd = k->env.drm->open(node->path);
    if (*fd < 0) {
        snprintf(k->text.reason, sizeof k->text.reason, "%s: %s%s", node->path, strerror(errno),
                 errno == EACCES ? "; add the user to the group video" : "");
        return -1;
    }
    if (k->away) k->env.drm->DropMaster(*fd); /* the first to open a card becomes its master */
    if (gn_kms_card_read(k->env.drm, *fd, probe, &k->device.fresh, &why))
        return gn_kms_card_score(&k->device.fresh, k->opts->connector);
    k->env.drm->close(*fd);
    *fd = -1;
    return -1;
}

/* Returns the descriptor of the best card with at least this score, or -1; its snapshot goes to
 * device.card. */
static int find_card(struct gn_kms *k, int least, bool probe, struct gn_kms_node *out) {
    struct gn_kms_node nodes[GN_KMS_CARDS_MAX];
    const int count = k->env.drm->list(nodes, GN_KMS_CARDS_MAX);
    int best = least - 1, kept = -1;
    bool is_there = !k->opts->card;
    k->text.reason[0] = 0;
    for (int i = 0; i < count; i++) {
        int fd = -1;
        is_there |= is_configured(k, &nodes[i]);
        if (k->device.fd >= 0 && strcmp(nodes[i].path, k->device.node.path) == 0) continue;
        const int score = score_card(k, &nodes[i], probe, &fd);
        if (score <= best) {
            if (fd >= 0) k->env.drm->close(fd);
            continue;
        }
        if (kept >= 0) k->env.drm->close(kept);
        kept = fd, best = score;
        *out = nodes[i];
        k->device.card = k->device.fresh;
    }
    if (!is_there) snprintf(k->text.reason, sizeof k->text.reason, "%s not found", k->opts->card);
    return kept;
}

static void start_gl(struct gn_kms *k) {
    struct gn_err why = {0};
    k->device.scanout = k->env.scanout->open(k->device.fd, k->opts->render_node, &why);
    k->text.message[0] = 0;
    if (!k->device.scanout) {
        snprintf(k->text.reason, sizeof k->text.reason, "%s: %s", k->device.node.path, why.text);
        snprintf(k->text.message, sizeof k->text.message, "%s", k->text.reason);
    }
    k->screen.has_context = k->device.scanout;
    if (k->device.scanout) k->screen.generation++;
}

bool gn_kms_try_master(struct gn_kms *k, int64_t now_ns) {
    k->master = k->env.drm->IsMaster(k->device.fd) || k->env.drm->SetMaster(k->device.fd) == 0;
    k->lit = false;
    k->due.sleep_ns = now_ns;
    k->due.master_ns = k->master ? GN_KMS_NEVER : now_ns + GN_KMS_S;
    if (!k->master && !k->text.holder[0] && k->env.find_holder)
        k->env.find_holder(k->device.node.path, k->text.holder, sizeof k->text.holder);
    if (k->master) k->text.holder[0] = 0;
    return k->master;
}

void gn_kms_close_card(struct gn_kms *k) {
    gn_kms_drop_surface(k);
    gn_kms_output_close(&k->output, false);
    if (k->device.scanout) k->env.scanout->close(k->device.scanout);
    k->device.scanout = NULL;
    k->screen.has_context = false;
    if (k->device.fd >= 0) k->env.drm->close(k->device.fd);
    k->device.fd = -1;
}

/* The context stays until renew: its objects must be destroyed first. */
void gn_kms_leave_card(struct gn_kms *k, bool restore, int64_t now_ns) {
    if (k->screen.lost || k->device.fd < 0) return;
    gn_kms_flip_is_lost(k);
    gn_kms_drop_surface(k);
    gn_kms_output_close(&k->output, restore && k->master);
    k->losses += k->monitor.connected;
    k->monitor.connected = k->lit = false;
    k->due.scan_ns = now_ns;
    k->screen.lost = k->device.scanout;
    if (!k->device.scanout) gn_kms_close_card(k);
}

/* ---- mode and buffers ---- */

static enum gn_fallback first_fallback(const struct gn_kms *k) {
    return k->buffers.opts.modifier_count > 0 ? GN_FALLBACK_MODIFIERS : GN_FALLBACK_PLAIN;
}

/* Takes the first mode, from monitor.mode on, for which buffers can be allocated. */
static bool take_mode(struct gn_kms *k) {
    struct gn_surface_opts *o = &k->buffers.opts;
    for (; k->monitor.mode < k->monitor.candidate_count;
         k->monitor.mode++, o->fallback = first_fallback(k)) {
        const drmModeModeInfo *mode = &k->monitor.candidates[k->monitor.mode];
        struct gn_err why = {0};
        gn_kms_drop_surface(k);
        o->width_px = mode->hdisplay;
        o->height_px = mode->vdisplay;
        if (k->text.message[0]) o->fallback = GN_FALLBACK_COPY;
        while (o->fallback < GN_FALLBACK_COPY &&
               !k->env.scanout->set_surface(k->device.scanout, o, &k->buffers.surface, &why))
            o->fallback++;
        if (o->fallback == GN_FALLBACK_COPY && !gn_kms_make_copies(k)) continue;
        const uint32_t mhz = gn_kms_mode_mhz(mode);
        k->flip.period_ns = mhz > 0 ? 1000 * GN_KMS_S / mhz : GN_KMS_S / 60;
        k->flip.shortest_ns = k->opts->max_fps > 0 ? GN_KMS_S / k->opts->max_fps : 0;
        return true;
    }
    gn_kms_drop_surface(k);
    return false;
}

static void give_up_connector(struct gn_kms *k, const char *why, int64_t now_ns) {
    k->monitor.connected = k->lit = false;
    snprintf(k->text.reason, sizeof k->text.reason, "%s: no mode can be set (%s)",
             k->monitor.connector, why);
    k->due.scan_ns = now_ns + 5 * GN_KMS_SCAN_NS;
}

void gn_kms_next_try(struct gn_kms *k, int error, int64_t now_ns) {
    k->lit = false;
    gn_flip_forget(&k->flip);
    if (k->buffers.opts.fallback < GN_FALLBACK_COPY)
        k->buffers.opts.fallback++;
    else {
        k->monitor.mode++;
        k->buffers.opts.fallback = first_fallback(k);
    }
    if (!take_mode(k)) give_up_connector(k, strerror(error), now_ns);
}

static bool is_listed(const struct gn_kms_connector *c, const drmModeModeInfo *mode) {
    for (int i = 0; i < c->mode_count; i++)
        if (gn_kms_mode_equal(&c->modes[i], mode)) return true;
    return false;
}

static bool is_unreadable(const struct gn_kms *k) {
    return k->device.unreadable > 0 && k->device.unreadable < UNREADABLE_MAX;
}

static bool open_output(struct gn_kms *k, int connector, int crtc) {
    const bool legacy = k->opts->legacy || k->device.unreadable >= UNREADABLE_MAX;
    struct gn_err why = {0};
    if (k->output.drm && k->output.connector == k->device.card.connectors[connector].id &&
        k->output.crtc == k->device.card.crtcs[crtc].id)
        return true;
    gn_kms_drop_surface(k);
    gn_kms_output_close(&k->output, k->master);
    if (!gn_kms_output_open(&k->output, k->env.drm, k->device.fd, legacy, &k->device.card,
                            connector, crtc, &why)) {
        k->device.unreadable++;
        return false;
    }
    gn_kms_output_set_range(&k->output, k->opts->range);
    gn_kms_output_formats(&k->output, &k->buffers.opts);
    k->buffers.opts.unencoded = k->opts->unencoded;
    return true;
}

static void use_connector(struct gn_kms *k, int connector, int64_t now_ns) {
    const struct gn_kms_connector *c = &k->device.card.connectors[connector];
    const int crtc = gn_kms_choose_crtc(&k->device.card, connector);
    snprintf(k->monitor.connector, sizeof k->monitor.connector, "%s", c->name);
    k->monitor.orientation_deg = c->orientation_deg;
    k->monitor.id = c->monitor;
    k->lit = false;
    k->due.sleep_ns = now_ns;
    if (crtc < 0 || !open_output(k, connector, crtc)) {
        give_up_connector(k, "no usable CRTC or plane", now_ns);
        if (is_unreadable(k)) k->due.scan_ns = now_ns + GN_KMS_SCAN_NS;
        return;
    }
    const bool was_lit = k->output.mode.hdisplay > 0,
               known = was_lit && k->monitor.lit_for == c->monitor;
    k->monitor.candidate_count = gn_kms_mode_candidates(
        &k->device.card, connector, was_lit && !known ? -1 : crtc, k->opts, k->monitor.candidates);
    struct gn_kms_monitor *m = &k->monitor;
    if (known) { /* a monitor that comes back keeps its mode if it still lists it */
        const drmModeModeInfo *mode = &k->output.mode;
        int at = 0;
        while (at < m->candidate_count && !gn_kms_mode_equal(&m->candidates[at], mode)) at++;
        if (at < m->candidate_count || is_listed(c, mode)) {
            if (at == GN_KMS_CANDIDATES_MAX) at--; /* replaces the last one */
            if (at == m->candidate_count) m->candidate_count++;
            memmove(&m->candidates[1], &m->candidates[0], (size_t)at * sizeof *mode);
            m->candidates[0] = *mode;
        }
    }
    k->monitor.mode = 0;
    k->monitor.connected = true;
    k->text.reason[0] = 0;
    const struct gn_surface_opts *o = &k->buffers.opts;
    const bool has_buffers = o->fallback == GN_FALLBACK_COPY ? k->buffers.copies[0].handle != 0
                                                             : k->buffers.surface.format;
    if (has_buffers && o->width_px == k->monitor.candidates[0].hdisplay &&
        o->height_px == k->monitor.candidates[0].vdisplay)
        return;
    k->buffers.opts.fallback = first_fallback(k);
    if (!take_mode(k)) give_up_connector(k, "no buffers", now_ns);
}

/* ---- scanning ---- */

static bool is_ours(const struct gn_kms *k, const struct gn_kms_connector *c) {
    return k->output.drm && c->id == k->output.connector;
}

static void scan_card(struct gn_kms *k, bool probe, int64_t now_ns) {
    struct gn_err why = {0};
    if (!gn_kms_card_read(k->env.drm, k->device.fd, probe, &k->device.card, &why)) {
        gn_kms_leave_card(k, false, now_ns);
        return;
    }
    k->device.unreadable = k->device.card.partial ? k->device.unreadable + 1
                           : k->monitor.connected ? 0
                                                  : k->device.unreadable;
    if (k->device.card.partial)
        k->due.scan_ns = now_ns + (is_unreadable(k) ? 1 : 15) * GN_KMS_SCAN_NS;
    if (k->device.card.partial && is_unreadable(k) && k->monitor.connected)
        return;      /* keep what is shown */
    int chosen = -1; /* the connector in use is kept while it is connected */
    for (int i = 0; i < k->device.card.connector_count && chosen < 0; i++)
        if (is_ours(k, &k->device.card.connectors[i]) && k->device.card.connectors[i].connected &&
            k->device.card.connectors[i].mode_count > 0)
            chosen = i;
    if (chosen < 0) chosen = gn_kms_choose_connector(&k->device.card, k->opts->connector);
    if (chosen < 0) { /* leaves this card, which has no monitor, if another one has */
        struct gn_kms_node other;
        k->monitor.connected = k->lit = false;
        const int fd = find_card(k, 1, probe, &other);
        if (fd < 0) return;
        k->env.drm->close(fd);
        gn_kms_leave_card(k, true, now_ns);
        return;
    }
    const struct gn_kms_connector *c = &k->device.card.connectors[chosen];
    const bool as_it_was = k->monitor.connected && is_ours(k, c) && c->monitor == k->monitor.id &&
                           !c->bad_link && (c->crtc >= 0 || !k->lit) &&
                           (is_listed(c, &k->monitor.candidates[k->monitor.mode]) ||
                            k->opts->mode_width > 0 || k->opts->modeline);
    if (as_it_was) return;
    if (k->flip.pending) { /* nothing is changed during a flip */
        k->monitor.connected = false;
        k->due.scan_ns = now_ns + k->flip.period_ns;
        return;
    }
    use_connector(k, chosen, now_ns);
}

void gn_kms_scan(struct gn_kms *k, int64_t now_ns) {
    bool probe = now_ns >= k->due.probe_ns;
    k->due.scan_ns = GN_KMS_NEVER;
    if (probe) k->due.probe_ns = now_ns + GN_KMS_PROBE_NS;
    const bool no_gl = k->device.fd >= 0 && !k->device.scanout;
    if (no_gl && !k->monitor.connected) {
        gn_kms_close_card(k); /* another card may be usable */
    } else if (no_gl && k->flip.pending) {
        k->due.scan_ns = now_ns + k->flip.period_ns;
    } else if (no_gl) { /* GL may work now; the buffers of the message are dropped */
        start_gl(k);
        if (k->device.scanout) {
            gn_kms_drop_surface(k);
            k->monitor.connected = k->lit = false;
        }
    }
    if (k->device.fd < 0) {
        k->device.fd = find_card(k, 0, true, &k->device.node);
        if (k->device.fd < 0) {
            k->losses = 0; /* the card was lost, not an unusable context */
        } else {
            k->screen.counts.opened++;
            k->flip = (struct gn_flip){.lost_flips = k->flip.lost_flips,
                                       .shown = k->flip.shown,
                                       .missed = k->flip.missed,
                                       .stalls = k->flip.stalls};
            if (!k->away) gn_kms_try_master(k, now_ns);
            start_gl(k);
        }
        probe = k->device.card.partial; /* already probed otherwise */
    }
    if (k->device.fd >= 0) scan_card(k, probe, now_ns);
    if (k->device.card.partial || k->device.fresh.partial)
        k->due.probe_ns = now_ns; /* some objects were not readable */
    const bool dumb = k->device.fd >= 0 && !k->device.scanout;
    if (k->due.scan_ns != GN_KMS_NEVER || (k->monitor.connected && !dumb && !k->env.no_uevents))
        return;
    k->due.scan_ns = now_ns + (dumb ? 5 : 1) * GN_KMS_SCAN_NS;
}
