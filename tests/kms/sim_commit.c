/* Commits: their rules, and pending flips. */
#include <drm_fourcc.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>

#include "sim_state.h"

/* ---- flips ---- */

bool sim_is_stalled(const struct sim_crtc *c) {
    return c->stall != SIM_FLOWS && c->stall != SIM_EVENT_LOST && c->stall != SIM_EVENT_LATE;
}

static int64_t period_ns(const drmModeModeInfo *m) {
    return m->clock ? INT64_C(1000000) * m->htotal * m->vtotal / m->clock : SIM_S / 60;
}

static void tell(struct sim_card *card, int crtc, const struct sim_flip *flip, int64_t ns) {
    struct sim_file *f = flip->file >= 0 ? &sim.files[flip->file] : NULL;
    if (!f || !flip->user) return;
    if (f->event_count == SIM_EVENTS) {
        sim_complain("more than %d unread events", SIM_EVENTS);
        return;
    }
    const int64_t since_ns = ns - card->crtcs[crtc].lit_ns;
    f->events[f->event_count++] = (struct sim_event){
        .user = flip->user,
        .ns = ns,
        .sequence = card->traits.no_vblank
                        ? 0
                        : (unsigned)(since_ns / period_ns(&card->state.crtcs[crtc].mode)),
        .crtc = sim_crtc_id(card, crtc)};
}

void sim_finish_flip(struct sim_card *card, int crtc) {
    struct sim_crtc *c = &card->crtcs[crtc];
    const struct sim_flip flip = c->flip;
    c->flip = (struct sim_flip){.file = SIM_NOBODY};
    if (!flip.pending) return;
    if (c->shown) sim_fb_unref(c->shown);
    c->shown = flip.fb;
    sim_counts.flips++;
    if (c->stall == SIM_FLOWS) tell(card, crtc, &flip, sim.now_ns);
    if (c->stall == SIM_EVENT_LATE) {
        sim.late.flip = flip;
        sim.late.flip.done_ns = sim.now_ns + 12100 * SIM_MS;
        sim.late.card = (int)(card - sim.cards), sim.late.crtc = crtc;
    }
    if (c->stall == SIM_EVENT_LOST || c->stall == SIM_EVENT_LATE) c->stall = SIM_FLOWS;
}

void sim_tell_late(void) {
    const struct sim_flip flip = sim.late.flip;
    sim.late.flip.pending = false;
    tell(&sim.cards[sim.late.card], sim.late.crtc, &flip, sim.now_ns);
}

void sim_start_flip(struct sim_card *card, int crtc, const struct sim_flip *how) {
    struct sim_crtc *c = &card->crtcs[crtc];
    const int64_t period = period_ns(&card->state.crtcs[crtc].mode),
                  ready_ns = sim.now_ns + 2 * SIM_MS;
    c->flip = *how;
    c->flip.pending = true;
    c->flip.fb = sim_fb_ref(sim_fb_find(card, card->state.planes[crtc].fb));
    c->flip.committed_ns = sim.now_ns;
    c->flip.done_ns = c->lit_ns + ((ready_ns - c->lit_ns) / period + 1) * period;
    if (card->traits.no_vblank) c->flip.done_ns = sim.now_ns + SIM_MS / 20;
    if (sim_is_stalled(c)) c->flip.done_ns = INT64_MAX;
}

/* A blocking commit waits for flips, at most 10 s. */
void sim_wait_for_flips(struct sim_card *card) {
    for (int i = 0; i < SIM_CRTCS; i++) {
        const struct sim_flip *flip = &card->crtcs[i].flip;
        if (!flip->pending) continue;
        const int64_t patience_ns = flip->committed_ns + 10 * SIM_S;
        if (flip->done_ns < patience_ns) {
            sim_counts.waits++;
            sim_run_to(flip->done_ns);
        } else if (patience_ns > sim.now_ns)
            sim_run_to(patience_ns);
        if (flip->pending) sim_finish_flip(card, i);
    }
}

/* ---- rules ---- */

static bool same_mode(const drmModeModeInfo *a, const drmModeModeInfo *b) {
    return a->clock == b->clock && a->hdisplay == b->hdisplay && a->vdisplay == b->vdisplay &&
           a->htotal == b->htotal && a->vtotal == b->vtotal;
}

static bool needs_modeset(const struct sim_state *a, const struct sim_state *b, int crtc) {
    const struct sim_crtc_state *x = &a->crtcs[crtc], *y = &b->crtcs[crtc];
    for (int i = 0; i < SIM_CONNECTORS; i++) {
        const struct sim_connector_state *c = &a->connectors[i], *d = &b->connectors[i];
        if ((c->crtc == crtc) != (d->crtc == crtc)) return true;
        if (d->crtc == crtc && c->bad_link != d->bad_link) return true;
    }
    return x->active != y->active || x->has_mode != y->has_mode || !same_mode(&x->mode, &y->mode);
}

static int check_mode(const drmModeModeInfo *mode, bool test) {
    for (int i = 0; i < sim.refusal_count; i++)
        if (sim.refusals[i].width_px == mode->hdisplay && !(test && sim.refusals[i].late))
            return sim.refusals[i].error;
    return 0;
}

static int check_crtc(const struct sim_card *card, const struct sim_state *next, int crtc,
                      bool modeset, bool test) {
    const struct sim_crtc_state *c = &next->crtcs[crtc];
    bool driven = false;
    for (int i = 0; i < SIM_CONNECTORS; i++) driven |= next->connectors[i].crtc == crtc;
    if (c->active && !c->has_mode) return EINVAL;
    if (c->has_mode != driven) return EINVAL;
    if (next->connectors[1].crtc == 0) return EINVAL; /* its encoder cannot drive it */
    if (!needs_modeset(&card->state, next, crtc)) return 0;
    if (!modeset) return EINVAL;
    return c->has_mode ? check_mode(&c->mode, test) : 0;
}

/* Whether a primary plane enlarges so much in one direction. */
static bool may_scale(const struct sim_card *card, int plane, uint64_t from, uint64_t to,
                      bool test) {
    const uint64_t src_px = from >> 16;
    if (src_px == to) return true;
    if (plane >= SIM_CRTCS || src_px > to || (card->traits.enlarges_never && !test)) return false;
    return 100 * to <= card->traits.enlarges * src_px;
}

static int check_plane(struct sim_card *card, const struct sim_state *next, int i, bool test) {
    const struct sim_plane_state *p = &next->planes[i];
    if ((p->fb != 0) != (p->crtc >= 0)) return EINVAL;
    if (p->fb == 0) return 0;
    const struct sim_fb *fb = sim_fb_find(card, p->fb);
    if (!fb || !next->crtcs[p->crtc].has_mode || i % SIM_CRTCS != p->crtc) return EINVAL;
    const drmModeModeInfo *mode = &next->crtcs[p->crtc].mode;
    if (p->src[0] + p->src[2] > (uint64_t)fb->width_px << 16 ||
        p->src[1] + p->src[3] > (uint64_t)fb->height_px << 16)
        return ENOSPC;
    if (!may_scale(card, i, p->src[2], (uint64_t)p->dst[2], test) ||
        !may_scale(card, i, p->src[3], (uint64_t)p->dst[3], test))
        return ERANGE;
    const bool covers = p->dst[0] == 0 && p->dst[1] == 0 && p->dst[2] == mode->hdisplay &&
                        p->dst[3] == mode->vdisplay;
    return i < SIM_CRTCS && !covers ? EINVAL : 0;
}

int sim_check(struct sim_card *card, const struct sim_state *next, bool modeset, bool test) {
    int error = 0;
    for (int i = 0; i < SIM_CRTCS && error == 0; i++)
        error = check_crtc(card, next, i, modeset, test);
    for (int i = 0; i < SIM_PLANES && error == 0; i++) error = check_plane(card, next, i, test);
    return error;
}

/* ---- applying ---- */

void sim_refresh(struct sim_card *card) {
    for (int i = 0; i < SIM_CRTCS; i++) {
        struct sim_crtc *c = &card->crtcs[i];
        struct sim_fb *fb = sim_fb_ref(sim_fb_find(card, card->state.planes[i].fb));
        if (c->shown) sim_fb_unref(c->shown);
        c->shown = fb;
    }
}

void sim_take(struct sim_card *card, const struct sim_state *next) {
    for (int i = 0; i < SIM_CRTCS; i++) {
        struct sim_crtc *c = &card->crtcs[i];
        if (c->flip.pending) sim_finish_flip(card, i);
        if (!needs_modeset(&card->state, next, i)) continue;
        c->lit_ns = sim.now_ns;
        sim_counts.blinks++;
        if (c->stall == SIM_STALLS_UNTIL_RELIT) c->stall = SIM_FLOWS;
    }
    card->state = *next;
    sim_counts.sets++;
    sim_refresh(card);
}

static void cover(struct sim_plane_state *p, int crtc, const struct sim_fb *fb,
                  const drmModeModeInfo *mode) {
    p->fb = fb->id;
    p->crtc = crtc;
    p->src[0] = p->src[1] = 0;
    p->src[2] = (uint64_t)mode->hdisplay << 16, p->src[3] = (uint64_t)mode->vdisplay << 16;
    p->dst[0] = p->dst[1] = 0;
    p->dst[2] = mode->hdisplay, p->dst[3] = mode->vdisplay;
}

static void drive(struct sim_state *next, int crtc, int connector, const drmModeModeInfo *mode) {
    for (int i = 0; i < SIM_CONNECTORS; i++)
        if (next->connectors[i].crtc == crtc) next->connectors[i].crtc = -1;
    const int old = next->connectors[connector].crtc;
    next->connectors[connector].crtc = crtc;
    next->connectors[connector].bad_link = false;
    /* without a mode change it stays asleep */
    if (!same_mode(&next->crtcs[crtc].mode, mode)) next->connectors[connector].asleep = false;
    next->crtcs[crtc] = (struct sim_crtc_state){.active = true, .has_mode = true, .mode = *mode};
    bool still_driven = false;
    for (int i = 0; i < SIM_CONNECTORS; i++) still_driven |= next->connectors[i].crtc == old;
    if (old < 0 || still_driven) return;
    next->crtcs[old] = (struct sim_crtc_state){0};
    next->planes[old].fb = 0, next->planes[old].crtc = -1;
}

/* Framebuffer of the text console or another program. */
static struct sim_fb *owners_fb(struct sim_card *card, int owner, const drmModeModeInfo *mode) {
    for (int i = 0; i < SIM_FBS; i++)
        if (card->fbs[i].id && card->fbs[i].file == owner) {
            if (card->fbs[i].width_px == mode->hdisplay) return &card->fbs[i];
            sim_fb_remove(card, &card->fbs[i]);
        }
    struct sim_bo *bo = sim_bo_create(mode->hdisplay, mode->vdisplay, false);
    struct sim_fb *fb = sim_fb_add(card, owner, bo, DRM_FORMAT_XRGB8888);
    sim_bo_unref(bo);
    return fb;
}

void sim_set_console(struct sim_card *card, int owner) {
    drmModeModeInfo modes[SIM_MODES];
    int connector = 0;
    if (!card->plugged[0] && card->plugged[1]) connector = 1;
    const int count = sim_monitor_modes(card->plugged[connector], modes);
    if (count == 0) return;
    const drmModeModeInfo *mode = &modes[owner == SIM_STRANGER ? count - 1 : 0];
    struct sim_fb *fb = owners_fb(card, owner, mode);
    struct sim_state next = card->state;
    drive(&next, connector, connector, mode);
    next.connectors[connector].asleep = false;
    cover(&next.planes[connector], connector, fb, mode);
    for (int i = SIM_CRTCS; i < SIM_PLANES; i++) next.planes[i].fb = 0, next.planes[i].crtc = -1;
    if (card->traits.rotation && owner == SIM_CONSOLE)
        next.planes[connector].rotation = DRM_MODE_ROTATE_180;
    if (card->traits.overlays && owner == SIM_STRANGER)
        cover(&next.planes[SIM_CRTCS + connector], connector, fb, mode);
    sim_take(card, &next);
}

/* ---- legacy interface ---- */

struct sim_file *sim_enter_as_master(enum sim_op op, int fd) {
    struct sim_file *f = sim_enter(op, fd);
    if (!f) return NULL;
    errno = EACCES;
    return sim_card_of(f)->master == sim_index_of(f) ? f : NULL;
}

static int set_crtc(int fd, uint32_t id, uint32_t fb_id, uint32_t x, uint32_t y,
                    uint32_t *connectors, int count, drmModeModeInfoPtr mode) {
    struct sim_file *f = sim_enter_as_master(SIM_ModeSetCrtc, fd);
    if (!f) return -errno;
    struct sim_card *card = sim_card_of(f);
    const int crtc = sim_index(id, sim_crtc_id(card, 0), SIM_CRTCS);
    if (crtc < 0) return -ENOENT;
    sim_wait_for_flips(card);
    struct sim_state next = card->state;
    if (!mode) {
        next.crtcs[crtc] = (struct sim_crtc_state){0};
        next.planes[crtc].fb = 0, next.planes[crtc].crtc = -1;
        for (int i = 0; i < SIM_CONNECTORS; i++)
            if (next.connectors[i].crtc == crtc) next.connectors[i].crtc = -1;
    } else {
        const struct sim_fb *fb = sim_fb_find(card, fb_id);
        if (!fb) return -ENOENT;
        if (count != 1) return -EINVAL;
        const int connector = sim_index(connectors[0], sim_connector_id(card, 0), SIM_CONNECTORS);
        if (connector < 0) return -ENOENT;
        if (x + mode->hdisplay > fb->width_px || y + mode->vdisplay > fb->height_px) return -ENOSPC;
        drive(&next, crtc, connector, mode);
        cover(&next.planes[crtc], crtc, fb, mode);
    }
    const int error = sim_check(card, &next, true, false);
    if (error != 0) return -error;
    sim_run_to(sim.now_ns + 17 * SIM_MS);
    sim_take(card, &next);
    return 0;
}

static int set_cursor(int fd, uint32_t id, uint32_t handle, uint32_t width, uint32_t height) {
    struct sim_file *f = sim_enter_as_master(SIM_ModeSetCursor, fd);
    (void)id, (void)handle, (void)width, (void)height;
    return f ? -ENXIO : -errno;
}

/* DPMS and the range can be set on a connector. */
static int set_connector(int fd, uint32_t id, uint32_t property, uint64_t value) {
    struct sim_file *f = sim_enter_as_master(SIM_ModeConnectorSetProperty, fd);
    if (!f) return -errno;
    struct sim_card *card = sim_card_of(f);
    const int i = sim_index(id, sim_connector_id(card, 0), SIM_CONNECTORS);
    if (i < 0) return -ENOENT;
    if (property == SIM_PROP_BASE + SIM_P_RANGE && card->traits.range && value < 3) {
        card->state.connectors[i].range = value;
        return 0;
    }
    if (property != SIM_PROP_BASE + SIM_P_DPMS) return -EINVAL;
    const bool on = value == DRM_MODE_DPMS_ON;
    const int crtc = card->state.connectors[i].crtc;
    if (card->traits.legacy)
        card->state.connectors[i].asleep = !on;
    else if (crtc >= 0) /* drivers with the atomic interface map DPMS to ACTIVE */
        card->state.crtcs[crtc].active = on;
    return 0;
}

static int page_flip(int fd, uint32_t id, uint32_t fb_id, uint32_t flags, void *user) {
    struct sim_file *f = sim_enter_as_master(SIM_ModePageFlip, fd);
    if (!f) return -errno;
    struct sim_card *card = sim_card_of(f);
    const int crtc = sim_index(id, sim_crtc_id(card, 0), SIM_CRTCS);
    const struct sim_fb *fb = sim_fb_find(card, fb_id);
    if (crtc < 0 || !fb) return -ENOENT;
    const struct sim_fb *old = sim_fb_find(card, card->state.planes[crtc].fb);
    if (!old) return -EBUSY;
    if (!card->state.crtcs[crtc].active) return -EINVAL;
    if (fb->width_px < card->state.crtcs[crtc].mode.hdisplay) return -ENOSPC;
    if (fb->format != old->format) return -EINVAL;
    for (int i = 0; i < SIM_CONNECTORS; i++)
        if (card->state.connectors[i].crtc == crtc && card->state.connectors[i].asleep)
            sim_complain("page flip while the monitor sleeps");
    if (card->crtcs[crtc].flip.pending) {
        sim_complain("page flip while a flip is pending");
        return -EBUSY;
    }
    card->state.planes[crtc].fb = fb_id;
    const bool told = flags & DRM_MODE_PAGE_FLIP_EVENT;
    sim_start_flip(card, crtc,
                   &(struct sim_flip){.file = sim_index_of(f), .user = told ? user : NULL});
    return 0;
}

static int get_sequence(int fd, uint32_t id, uint64_t *sequence, uint64_t *ns) {
    struct sim_file *f = sim_enter(SIM_CrtcGetSequence, fd);
    if (!f) return -1;
    const struct sim_card *card = sim_card_of(f);
    const int crtc = sim_index(id, sim_crtc_id(card, 0), SIM_CRTCS);
    errno = crtc < 0 ? ENOENT : card->traits.no_vblank ? EOPNOTSUPP : EINVAL;
    if (crtc < 0 || card->traits.no_vblank || !card->state.crtcs[crtc].active) return -1;
    *ns = (uint64_t)sim.now_ns;
    *sequence = (uint64_t)(sim.now_ns - card->crtcs[crtc].lit_ns) /
                (uint64_t)period_ns(&card->state.crtcs[crtc].mode);
    return 0;
}

static int handle_event(int fd, drmEventContextPtr context) {
    struct sim_file *f = sim_enter(SIM_HandleEvent, fd);
    if (!f) return -1;
    errno = EAGAIN;
    if (f->event_count == 0) return -1;
    if (context->version < 3 || !context->page_flip_handler2) sim_complain("no page flip handler");
    struct sim_event all[SIM_EVENTS];
    const int count = f->event_count;
    memcpy(all, f->events, sizeof all);
    f->event_count = 0;
    for (int i = 0; i < count; i++)
        context->page_flip_handler2(fd, all[i].sequence, (unsigned)(all[i].ns / SIM_S),
                                    (unsigned)(all[i].ns % SIM_S / 1000), all[i].crtc, all[i].user);
    return 0;
}

void sim_fill_commit(struct gn_drm_ops *ops) {
    sim_fill_atomic(ops);
    ops->ModeSetCrtc = set_crtc;
    ops->ModeSetCursor = set_cursor;
    ops->ModePageFlip = page_flip;
    ops->ModeConnectorSetProperty = set_connector;
    ops->CrtcGetSequence = get_sequence;
    ops->HandleEvent = handle_event;
}
