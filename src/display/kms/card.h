/* Snapshot of a card as plain data, and selection from it: pure functions, except
 * gn_kms_card_read(). */
#ifndef GN_DISPLAY_KMS_CARD_H
#define GN_DISPLAY_KMS_CARD_H

#include "display/display.h"
#include "display/kms/drm.h"

enum {
    GN_KMS_CONNECTORS_MAX = 16,
    GN_KMS_CRTCS_MAX = 16,
    GN_KMS_MODES_MAX = 64,
    GN_KMS_CANDIDATES_MAX = 8,
};

struct gn_kms_connector {
    uint32_t id;
    char name[32]; /* "HDMI-A-1" */
    bool connected,
        unknown;   /* unknown: connection state cannot be detected; used if it has modes */
    bool bad_link; /* link-status is BAD: needs a modeset */
    bool internal; /* a built-in panel */
    unsigned
        orientation_deg; /* the frame must be rotated by this to compensate the panel's mounting */
    uint32_t crtcs;      /* bit i: card->crtcs[i] can drive it */
    int crtc;            /* CRTC driving it now, or -1 */
    uint64_t monitor;    /* hash of its EDID, or of its modes if it has none; 0: no monitor */
    drmModeModeInfo modes[GN_KMS_MODES_MAX];
    int mode_count;
};
struct gn_kms_crtc {
    uint32_t id;
    bool lit;
    drmModeModeInfo mode; /* valid if the CRTC is active */
};
struct gn_kms_card {
    char driver[32];
    struct gn_kms_connector connectors[GN_KMS_CONNECTORS_MAX];
    struct gn_kms_crtc crtcs[GN_KMS_CRTCS_MAX];
    int connector_count, crtc_count;
    bool partial; /* some objects could not be read; they may exist */
};

/* Fails, with errno set, for a node without modesetting (a render-only GPU) or a card that is gone.
 * `probe` makes connectors detect monitors again (tens of ms); otherwise the kernel's cached state
 * is read. */
bool gn_kms_card_read(const struct gn_drm_ops *drm, int fd, bool probe, struct gn_kms_card *out,
                      struct gn_err *err);

/* Selects the connector of that name, or with NULL the first connected one; ties go to the lowest
 * id. Returns -1 if there is none. */
int gn_kms_choose_connector(const struct gn_kms_card *card, const char *name);
/* Score of a card: 0 no usable connector, higher is better. */
int gn_kms_card_score(const struct gn_kms_card *card, const char *connector);
/* CRTC for a connector: the one that drives it, else an inactive one, else any. -1: none. */
int gn_kms_choose_crtc(const struct gn_kms_card *card, int connector);
/* Modes to try, best first, without duplicates: configured (listed, else from the modeline or by
 * CVT), current if listed, preferred within the cap, largest progressive ones of 50-60 Hz within
 * the cap (lower rates if the cap is lower), first listed, 640x480. Interlaced only if configured.
 * `crtc` -1: ignore the current mode, it was set for another monitor. Returns the count, at most
 * GN_KMS_CANDIDATES_MAX. */
int gn_kms_mode_candidates(const struct gn_kms_card *card, int connector, int crtc,
                           const struct gn_screen_opts *opts, drmModeModeInfo *out);
/* Refresh rate in mHz, from the clock if known; of fields if interlaced. */
uint32_t gn_kms_mode_mhz(const drmModeModeInfo *mode);
bool gn_kms_mode_equal(const drmModeModeInfo *a,
                       const drmModeModeInfo *b); /* compares timings only */
/* Syntax of cvt and xorg.conf: "74.25 1280 1390 1430 1650 720 725 730 750 +hsync +vsync". */
bool gn_kms_modeline_parse(const char *text, drmModeModeInfo *out);
/* VESA CVT 1.2, reduced blanking version 1. */
drmModeModeInfo gn_kms_mode_cvt(uint32_t width_px, uint32_t height_px, double hz);

#endif
