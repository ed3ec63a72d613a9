/* Selects connector, CRTC and modes from a card's snapshot. */
#include <string.h>

#include "display/kms/card.h"

/* ---- connectors and CRTCs ---- */

int gn_kms_choose_connector(const struct gn_kms_card *card, const char *name) {
    const struct gn_kms_connector *all = card->connectors;
    int best = -1;
    for (int i = 0; i < card->connector_count; i++) {
        const struct gn_kms_connector *c = &all[i];
        if (name && strcmp(c->name, name) != 0) continue;
        const bool usable = (c->connected || c->unknown) && c->mode_count > 0 && c->crtcs;
        if (!usable) continue;
        /* a connected one is preferred to one of unknown state */
        if (best < 0 || (c->connected == all[best].connected ? c->id < all[best].id : c->connected))
            best = i;
    }
    return best;
}

int gn_kms_card_score(const struct gn_kms_card *card, const char *connector) {
    const int chosen = gn_kms_choose_connector(card, connector);
    if (chosen < 0) return 0;
    const struct gn_kms_connector *c = &card->connectors[chosen];
    return 1 + 2 * c->connected + (c->crtc >= 0);
}

int gn_kms_choose_crtc(const struct gn_kms_card *card, int connector) {
    const struct gn_kms_connector *c = &card->connectors[connector];
    int dark = -1, any = -1;
    if (c->crtc >= 0) return c->crtc;
    for (int i = card->crtc_count - 1; i >= 0; i--) {
        if (!(c->crtcs >> i & 1)) continue;
        any = i;
        if (!card->crtcs[i].lit) dark = i;
    }
    return dark >= 0 ? dark : any;
}

/* ---- modes ---- */

enum { MOST_MHZ = 60500, LEAST_MHZ = 49500, SLACK_MHZ = 500 };

bool gn_kms_mode_equal(const drmModeModeInfo *a, const drmModeModeInfo *b) {
    return a->clock == b->clock && a->hdisplay == b->hdisplay && a->hsync_start == b->hsync_start &&
           a->hsync_end == b->hsync_end && a->htotal == b->htotal && a->vdisplay == b->vdisplay &&
           a->vsync_start == b->vsync_start && a->vsync_end == b->vsync_end &&
           a->vtotal == b->vtotal && a->flags == b->flags;
}

static bool is_progressive(const drmModeModeInfo *m) {
    return !(m->flags & (DRM_MODE_FLAG_INTERLACE | DRM_MODE_FLAG_DBLSCAN));
}

static uint32_t min_u32(uint32_t a, uint32_t b) { return a < b ? a : b; }
static uint32_t max_u32(uint32_t a, uint32_t b) { return a < b ? b : a; }

static uint32_t cap_mhz(const struct gn_screen_opts *o) {
    return (uint32_t)((o->cap_hz > 0 ? o->cap_hz : 60) * 1000) + SLACK_MHZ;
}

/* The cap limits size and pixel rate, not the refresh rate of smaller modes. A rotated panel counts
 * as unrotated. */
static bool is_within_cap(const drmModeModeInfo *m, const struct gn_screen_opts *o) {
    const uint32_t w = o->cap_width ? o->cap_width : 1920, h = o->cap_height ? o->cap_height : 1080;
    return max_u32(m->hdisplay, m->vdisplay) <= max_u32(w, h) &&
           min_u32(m->hdisplay, m->vdisplay) <= min_u32(w, h) &&
           (uint64_t)m->hdisplay * m->vdisplay * gn_kms_mode_mhz(m) <= (uint64_t)w * h * cap_mhz(o);
}

static double distance_hz(const drmModeModeInfo *m, double hz) {
    const double d = gn_kms_mode_mhz(m) / 1000.0 - hz;
    return d < 0 ? -d : d;
}

/* Compares two listed modes of the configured size. */
static bool fits_better(const drmModeModeInfo *a, const drmModeModeInfo *b, double hz) {
    if (hz > 0 && distance_hz(a, hz) != distance_hz(b, hz))
        return distance_hz(a, hz) < distance_hz(b, hz);
    if (is_progressive(a) != is_progressive(b)) return is_progressive(a);
    if ((a->type ^ b->type) & DRM_MODE_TYPE_PREFERRED) return a->type & DRM_MODE_TYPE_PREFERRED;
    return distance_hz(a, 60) < distance_hz(b, 60);
}

static uint32_t pixels_of(const drmModeModeInfo *m) { return (uint32_t)m->hdisplay * m->vdisplay; }

static const drmModeModeInfo *find_largest(const struct gn_kms_connector *c,
                                           const struct gn_screen_opts *o, uint32_t below_px) {
    const drmModeModeInfo *best = NULL;
    /* a cap of 3840x2160@30 allows lower rates */
    const uint32_t least_mhz = min_u32(LEAST_MHZ, cap_mhz(o) - 2 * SLACK_MHZ);
    for (int i = 0; i < c->mode_count; i++) {
        const drmModeModeInfo *m = &c->modes[i];
        if (!is_progressive(m) || !is_within_cap(m, o)) continue;
        if (gn_kms_mode_mhz(m) < least_mhz || gn_kms_mode_mhz(m) > MOST_MHZ) continue;
        if (pixels_of(m) >= below_px) continue;
        if (!best || pixels_of(m) > pixels_of(best) ||
            (pixels_of(m) == pixels_of(best) && distance_hz(m, 60) < distance_hz(best, 60)))
            best = m;
    }
    return best;
}

struct candidates {
    drmModeModeInfo *out;
    int count;
};

static void push_mode(struct candidates *l, const drmModeModeInfo *mode) {
    for (int i = 0; mode && i < l->count; i++)
        if (gn_kms_mode_equal(&l->out[i], mode)) return;
    if (mode && l->count < GN_KMS_CANDIDATES_MAX) l->out[l->count++] = *mode;
}

int gn_kms_mode_candidates(const struct gn_kms_card *card, int connector, int crtc,
                           const struct gn_screen_opts *opts, drmModeModeInfo *out) {
    const struct gn_kms_connector *c = &card->connectors[connector];
    const struct gn_kms_crtc *now = crtc >= 0 && c->crtc == crtc ? &card->crtcs[crtc] : NULL;
    const drmModeModeInfo *preferred = NULL, *first = NULL, *vga = NULL;
    bool offered = false; /* the current mode is this monitor's; else it was set for another one */
    for (int i = 0; i < c->mode_count; i++) {
        const drmModeModeInfo *m = &c->modes[i];
        if (!is_progressive(m)) continue;
        /* firmware may have rounded the clock of the current mode differently */
        offered |= now && m->hdisplay == now->mode.hdisplay && m->vdisplay == now->mode.vdisplay &&
                   distance_hz(&now->mode, gn_kms_mode_mhz(m) / 1e3) < 0.6;
        if (!first) first = m;
        if (!vga && m->hdisplay == 640 && m->vdisplay == 480) vga = m;
        if (!preferred && m->type & DRM_MODE_TYPE_PREFERRED && is_within_cap(m, opts))
            preferred = m;
    }
    struct candidates l = {out, 0};
    drmModeModeInfo made;
    if (opts->modeline && gn_kms_modeline_parse(opts->modeline, &made)) push_mode(&l, &made);
    if (opts->mode_width != 0) { /* the configured size: a listed mode, or a made one */
        const drmModeModeInfo *listed = NULL;
        for (int i = 0; i < c->mode_count; i++) {
            const drmModeModeInfo *m = &c->modes[i];
            if (m->hdisplay != opts->mode_width || m->vdisplay != opts->mode_height) continue;
            if (opts->mode_hz > 0 && distance_hz(m, opts->mode_hz) > 0.6) continue;
            if (!listed || fits_better(m, listed, opts->mode_hz)) listed = m;
        }
        if (!listed)
            made = gn_kms_mode_cvt(opts->mode_width, opts->mode_height,
                                   opts->mode_hz > 0 ? opts->mode_hz : 60);
        push_mode(&l, listed ? listed : &made);
    }
    if (offered && now->lit && is_progressive(&now->mode) && is_within_cap(&now->mode, opts))
        push_mode(&l, &now->mode);
    push_mode(&l, preferred);
    const drmModeModeInfo *large = find_largest(c, opts, UINT32_MAX);
    push_mode(&l, large);
    while (large && l.count < GN_KMS_CANDIDATES_MAX - 2)
        push_mode(&l, large = find_largest(c, opts, pixels_of(large)));
    push_mode(&l, first);
    push_mode(&l, vga);
    if (l.count == 0 && c->mode_count > 0) push_mode(&l, &c->modes[0]);
    return l.count;
}
