/* Looking for something to show on: cards, connectors, modes, and what to do without. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "display/kms/state.h"

enum { UNREADABLE_MAX = 4 }; /* then it is how it is */

/* ---- cards ---- */

#define BY_PATH "/dev/dri/by-path/"

static bool leads_to(const char *link, const char *path) {
    char target[PATH_MAX];
    return realpath(link, target) && strcmp(target, path) == 0;
}

/* By its path, a link to that, or its place: "platform-gpu-card" and "platform-gpu" are one, with
 * and without the folder of such links, which only udev makes. */
static bool is_asked_for(const struct gn_kms *k, const struct gn_kms_node *node) {
    const size_t folder = sizeof BY_PATH - 1, length = strlen(node->place);
    const char *asked = k->opts->card;
    char link[PATH_MAX];
    if (!asked || strcmp(asked, node->path) == 0 || leads_to(asked, node->path)) return true;
    if (strncmp(asked, BY_PATH, folder) == 0) asked += folder;
    snprintf(link, sizeof link, BY_PATH "%s", asked);
    if (leads_to(link, node->path)) return true;
    return length > 0 && strncmp(asked, node->place, length) == 0 &&
           (asked[length] == 0 || strcmp(asked + length, "-card") == 0);
}

/* -1: it is no card that shows pictures. The snapshot is left in fresh. */
static int rate(struct gn_kms *k, const struct gn_kms_node *node, bool probe, int *fd) {
    struct gn_err why = {0};
    if (!is_asked_for(k, node)) return -1;
    *fd = k->env.drm->open(node->path);
    if (*fd < 0) {
        snprintf(k->reason, sizeof k->reason, "%s: %s%s", node->path, strerror(errno),
                 errno == EACCES ? "; add the user to the group video" : "");
        return -1;
    }
    if (k->away) k->env.drm->DropMaster(*fd); /* which the first to open a card becomes */
    if (gn_kms_card_read(k->env.drm, *fd, probe, &k->fresh, &why))
        return gn_kms_card_score(&k->fresh, k->opts->connector);
    k->env.drm->close(*fd);
    *fd = -1;
    return -1;
}

/* The best card that rates at least `least`; its descriptor, or -1. The snapshot goes to card. */
static int find_card(struct gn_kms *k, int least, bool probe, struct gn_kms_node *out) {
    struct gn_kms_node nodes[GN_KMS_CARDS_MAX];
    const int count = k->env.drm->list(nodes, GN_KMS_CARDS_MAX);
    int best = least - 1, kept = -1;
    bool is_there = !k->opts->card;
    k->reason[0] = 0;
    for (int i = 0; i < count; i++) {
        int fd = -1;
        is_there |= is_asked_for(k, &nodes[i]);
        if (k->fd >= 0 && strcmp(nodes[i].path, k->node.path) == 0) continue;
        const int score = rate(k, &nodes[i], probe, &fd);
        if (score <= best) {
            if (fd >= 0) k->env.drm->close(fd);
            continue;
        }
        if (kept >= 0) k->env.drm->close(kept);
        kept = fd, best = score;
        *out = nodes[i];
        k->card = k->fresh;
    }
    if (!is_there) snprintf(k->reason, sizeof k->reason, "%s is not there", k->opts->card);
    return kept;
}

static void start_gl(struct gn_kms *k) {
    struct gn_err why = {0};
    k->scanout = k->env.scanout->open(k->fd, k->opts->render_node, &why);
    k->notice[0] = 0;
    if (!k->scanout) {
        snprintf(k->reason, sizeof k->reason, "%s: %s", k->node.path, why.text);
        snprintf(k->notice, sizeof k->notice, "%s", k->reason);
    }
    k->screen.has_context = k->scanout;
    if (k->scanout) k->screen.generation++;
}

bool gn_kms_try_master(struct gn_kms *k, int64_t now_ns) {
    k->master = k->env.drm->IsMaster(k->fd) || k->env.drm->SetMaster(k->fd) == 0;
    k->lit = false;
    k->sleep_ns = now_ns;
    k->master_ns = k->master ? GN_KMS_NEVER : now_ns + GN_KMS_S;
    if (!k->master && !k->holder[0] && k->env.who)
        k->env.who(k->node.path, k->holder, sizeof k->holder);
    if (k->master) k->holder[0] = 0;
    return k->master;
}

static void open_card(struct gn_kms *k, int64_t now_ns) {
    k->fd = find_card(k, 0, true, &k->node);
    if (k->fd < 0) {
        k->losses = 0; /* it was the card that went, not a context that is of no use */
        return;
    }
    k->screen.counts.opened++;
    k->flip = (struct gn_flip){.rung = k->flip.rung,
                               .shown = k->flip.shown,
                               .missed = k->flip.missed,
                               .stalls = k->flip.stalls};
    if (!k->away) gn_kms_try_master(k, now_ns);
    start_gl(k);
}

void gn_kms_close_card(struct gn_kms *k) {
    gn_kms_drop_surface(k);
    gn_kms_output_close(&k->output, false);
    if (k->scanout) k->env.scanout->close(k->scanout);
    k->scanout = NULL;
    k->screen.has_context = false;
    if (k->fd >= 0) k->env.drm->close(k->fd);
    k->fd = -1;
}

/* The context stays until renew: objects in it are to be destroyed first. */
void gn_kms_leave_card(struct gn_kms *k, bool restore, int64_t now_ns) {
    if (k->screen.lost || k->fd < 0) return;
    gn_kms_flip_is_lost(k);
    gn_kms_drop_surface(k);
    gn_kms_output_close(&k->output, restore && k->master);
    k->losses += k->connected;
    k->connected = k->lit = false;
    k->look_ns = now_ns;
    k->screen.lost = k->scanout;
    if (!k->scanout) gn_kms_close_card(k);
}

/* ---- what to show, and how ---- */

static bool take_surface(struct gn_kms *k) {
    struct gn_err why = {0};
    struct gn_surface_opts *o = &k->surface_opts;
    o->width_px = k->ladder[k->mode].hdisplay;
    o->height_px = k->ladder[k->mode].vdisplay;
    if (k->notice[0]) o->rung = GN_RUNG_COPY;
    for (; o->rung < GN_RUNG_COPY; o->rung++)
        if (k->env.scanout->set_surface(k->scanout, o, &k->surface, &why)) return true;
    return gn_kms_make_copies(k);
}

static enum gn_rung first_rung(const struct gn_kms *k) {
    return k->surface_opts.modifier_count > 0 ? GN_RUNG_MODIFIERS : GN_RUNG_PLAIN;
}

/* From this mode on, the first one for which there are buffers. */
static bool take_mode(struct gn_kms *k) {
    for (; k->mode < k->ladder_count; k->mode++, k->surface_opts.rung = first_rung(k)) {
        gn_kms_drop_surface(k);
        if (!take_surface(k)) continue;
        const uint32_t mhz = gn_kms_mode_mhz(&k->ladder[k->mode]);
        k->flip.period_ns = mhz > 0 ? 1000 * GN_KMS_S / mhz : GN_KMS_S / 60;
        k->flip.shortest_ns = k->opts->max_fps > 0 ? GN_KMS_S / k->opts->max_fps : 0;
        return true;
    }
    gn_kms_drop_surface(k);
    return false;
}

static void give_up_connector(struct gn_kms *k, const char *why, int64_t now_ns) {
    k->connected = k->lit = false;
    snprintf(k->reason, sizeof k->reason, "%s: no mode can be set (%s)", k->connector, why);
    k->look_ns = now_ns + 5 * GN_KMS_LOOK_NS;
}

void gn_kms_next_try(struct gn_kms *k, int error, int64_t now_ns) {
    k->lit = false;
    gn_flip_forget(&k->flip);
    if (k->surface_opts.rung < GN_RUNG_COPY)
        k->surface_opts.rung++;
    else {
        k->mode++;
        k->surface_opts.rung = first_rung(k);
    }
    if (!take_mode(k)) give_up_connector(k, strerror(error), now_ns);
}

static int find_mode(const struct gn_kms *k, const drmModeModeInfo *mode) {
    for (int i = 0; i < k->ladder_count; i++)
        if (gn_kms_mode_equal(&k->ladder[i], mode)) return i;
    return -1;
}

static bool is_listed(const struct gn_kms_connector *c, const drmModeModeInfo *mode) {
    for (int i = 0; i < c->mode_count; i++)
        if (gn_kms_mode_equal(&c->modes[i], mode)) return true;
    return false;
}

/* A monitor that comes back gets the mode that it had, if that is still one of its. */
static void keep_mode(struct gn_kms *k, const struct gn_kms_connector *c,
                      const drmModeModeInfo *mode) {
    if (find_mode(k, mode) < 0 && !is_listed(c, mode)) return;
    int at = find_mode(k, mode);
    if (at < 0 && k->ladder_count < GN_KMS_LADDER_MAX) k->ladder_count++;
    if (at < 0) at = k->ladder_count - 1;
    memmove(&k->ladder[1], &k->ladder[0], (size_t)at * sizeof *mode);
    k->ladder[0] = *mode;
}

static bool same_surface(const struct gn_kms *k) {
    const struct gn_surface_opts *o = &k->surface_opts;
    const bool is_there = o->rung == GN_RUNG_COPY ? k->copies[0].handle != 0 : k->surface.format;
    return is_there && o->width_px == k->ladder[0].hdisplay &&
           o->height_px == k->ladder[0].vdisplay;
}

static bool is_unreadable(const struct gn_kms *k) {
    return k->unreadable > 0 && k->unreadable < UNREADABLE_MAX;
}

static bool open_output(struct gn_kms *k, int connector, int crtc) {
    const bool legacy = k->opts->legacy || k->unreadable >= UNREADABLE_MAX;
    struct gn_err why = {0};
    if (k->output.drm && k->output.connector == k->card.connectors[connector].id &&
        k->output.crtc == k->card.crtcs[crtc].id)
        return true;
    gn_kms_drop_surface(k);
    gn_kms_output_close(&k->output, k->master);
    if (!gn_kms_output_open(&k->output, k->env.drm, k->fd, legacy, &k->card, connector, crtc,
                            &why)) {
        k->unreadable++;
        return false;
    }
    gn_kms_output_formats(&k->output, &k->surface_opts);
    k->surface_opts.unencoded = k->opts->unencoded;
    return true;
}

static void connect(struct gn_kms *k, int connector, int64_t now_ns) {
    const struct gn_kms_connector *c = &k->card.connectors[connector];
    const int crtc = gn_kms_choose_crtc(&k->card, connector);
    snprintf(k->connector, sizeof k->connector, "%s", c->name);
    k->orientation_deg = c->orientation_deg;
    k->monitor = c->monitor;
    k->lit = false;
    k->sleep_ns = now_ns;
    if (crtc < 0 || !open_output(k, connector, crtc)) {
        give_up_connector(k, "nothing drives it", now_ns);
        if (is_unreadable(k)) k->look_ns = now_ns + GN_KMS_LOOK_NS;
        return;
    }
    const bool was_lit = k->output.mode.hdisplay > 0, known = was_lit && k->lit_for == c->monitor;
    k->ladder_count =
        gn_kms_mode_ladder(&k->card, connector, was_lit && !known ? -1 : crtc, k->opts, k->ladder);
    if (known) keep_mode(k, c, &k->output.mode);
    k->mode = 0;
    k->connected = true;
    k->reason[0] = 0;
    if (same_surface(k)) return;
    k->surface_opts.rung = first_rung(k);
    if (!take_mode(k)) give_up_connector(k, "no buffers", now_ns);
}

/* ---- looking ---- */

static bool is_ours(const struct gn_kms *k, const struct gn_kms_connector *c) {
    return k->output.drm && c->id == k->output.connector;
}

/* The one in use stays in use for as long as it is connected. */
static int choose(const struct gn_kms *k) {
    for (int i = 0; i < k->card.connector_count; i++)
        if (is_ours(k, &k->card.connectors[i]) && k->card.connectors[i].connected &&
            k->card.connectors[i].mode_count > 0)
            return i;
    return gn_kms_choose_connector(&k->card, k->opts->connector);
}

/* Another card may have a monitor; ours has none. */
static void look_elsewhere(struct gn_kms *k, bool probe, int64_t now_ns) {
    struct gn_kms_node other;
    const int fd = find_card(k, 1, probe, &other);
    if (fd < 0) return;
    k->env.drm->close(fd);
    gn_kms_leave_card(k, true, now_ns);
}

static void look_at_card(struct gn_kms *k, bool probe, int64_t now_ns) {
    struct gn_err why = {0};
    if (!gn_kms_card_read(k->env.drm, k->fd, probe, &k->card, &why)) {
        gn_kms_leave_card(k, false, now_ns);
        return;
    }
    k->unreadable = k->card.partial ? k->unreadable + 1 : k->connected ? 0 : k->unreadable;
    if (k->card.partial) k->look_ns = now_ns + (is_unreadable(k) ? 1 : 15) * GN_KMS_LOOK_NS;
    if (k->card.partial && is_unreadable(k) && k->connected) return; /* it puts nothing out */
    const int chosen = choose(k);
    if (chosen < 0) {
        k->connected = k->lit = false;
        look_elsewhere(k, probe, now_ns);
        return;
    }
    const struct gn_kms_connector *c = &k->card.connectors[chosen];
    const bool as_it_was =
        k->connected && is_ours(k, c) && c->monitor == k->monitor && !c->bad_link &&
        (c->crtc >= 0 || !k->lit) &&
        (is_listed(c, &k->ladder[k->mode]) || k->opts->mode_width > 0 || k->opts->modeline);
    if (as_it_was) return;
    if (k->flip.pending) { /* nothing is changed under a flip */
        k->connected = false;
        k->look_ns = now_ns + k->flip.period_ns;
        return;
    }
    connect(k, chosen, now_ns);
}

/* It may by now. What it said instead makes room. */
static void start_gl_again(struct gn_kms *k, int64_t now_ns) {
    if (k->flip.pending) {
        k->look_ns = now_ns + k->flip.period_ns;
        return;
    }
    start_gl(k);
    if (!k->scanout) return;
    gn_kms_drop_surface(k);
    k->connected = k->lit = false;
}

void gn_kms_look(struct gn_kms *k, int64_t now_ns) {
    bool probe = now_ns >= k->probe_ns;
    k->look_ns = GN_KMS_NEVER;
    if (probe) k->probe_ns = now_ns + GN_KMS_PROBE_NS;
    if (k->fd >= 0 && !k->scanout && k->connected)
        start_gl_again(k, now_ns);
    else if (k->fd >= 0 && !k->scanout)
        gn_kms_close_card(k); /* another card may do better */
    if (k->fd < 0) {
        open_card(k, now_ns);
        probe = k->card.partial; /* else it has been */
    }
    if (k->fd >= 0) look_at_card(k, probe, now_ns);
    if (k->card.partial || k->fresh.partial) k->probe_ns = now_ns; /* not all have answered */
    const bool dumb = k->fd >= 0 && !k->scanout;
    if (k->look_ns != GN_KMS_NEVER || (k->connected && !dumb && !k->env.deaf)) return;
    k->look_ns = now_ns + (dumb ? 5 : 1) * GN_KMS_LOOK_NS;
}
