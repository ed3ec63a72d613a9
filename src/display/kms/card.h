/* A card as plain data, as it was when it was read, and what is chosen from it: pure functions, but
 * for gn_kms_card_read(), which asks the kernel. */
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
    char name[32];            /* "HDMI-A-1" */
    bool connected, unknown;  /* unknown: it cannot tell; worth a try if it has modes */
    bool bad_link;            /* link-status says so: only a modeset mends it */
    bool internal;            /* a panel */
    unsigned orientation_deg; /* how the panel is mounted: the picture is to be turned by this */
    uint32_t crtcs;           /* bit i: card->crtcs[i] can drive it */
    int crtc;                 /* the one that drives it now, or -1 */
    uint64_t monitor;         /* which one: of its EDID, without one of its modes; 0: none */
    drmModeModeInfo modes[GN_KMS_MODES_MAX];
    int mode_count;
};
struct gn_kms_crtc {
    uint32_t id;
    bool lit;
    drmModeModeInfo mode; /* when lit */
};
struct gn_kms_card {
    char driver[32];
    struct gn_kms_connector connectors[GN_KMS_CONNECTORS_MAX];
    struct gn_kms_crtc crtcs[GN_KMS_CRTCS_MAX];
    int connector_count, crtc_count;
    bool partial; /* something could not be read, which may be there all the same */
};

/* False, errno set and err filled, where the node shows no pictures (a GPU alone) or is gone.
 * `probe`: connectors look for a monitor anew (tens of ms), else what the kernel knows. */
bool gn_kms_card_read(const struct gn_drm_ops *drm, int fd, bool probe, struct gn_kms_card *out,
                      struct gn_err *err);

/* The connector to light: the one of that name, else the first connected: panels after the others
 * do not count less; ties go to the lowest id. NULL name: any. -1: none. */
int gn_kms_choose_connector(const struct gn_kms_card *card, const char *name);
/* How good a card is: 0 none of its connectors will do, else more is better. */
int gn_kms_card_score(const struct gn_kms_card *card, const char *connector);
/* The CRTC for a connector: that which drives it, else a dark one, else any. -1: none. */
int gn_kms_choose_crtc(const struct gn_kms_card *card, int connector);
/* What to try, best first, each mode once: configured (listed, else made of the modeline or, last,
 * by CVT), current if listed, preferred within the cap, the largest progressive ones of 50-60 Hz
 * (of less where the cap has less) within the cap, first, 640x480. Interlaced only when configured.
 * `crtc` -1: whatever is lit now was meant for another monitor. Returns the count, at most
 * GN_KMS_CANDIDATES_MAX. */
int gn_kms_mode_candidates(const struct gn_kms_card *card, int connector, int crtc,
                           const struct gn_screen_opts *opts, drmModeModeInfo *out);
/* Refreshes in mHz, by the clock where that is known; interlaced: fields. */
uint32_t gn_kms_mode_mhz(const drmModeModeInfo *mode);
bool gn_kms_mode_equal(const drmModeModeInfo *a, const drmModeModeInfo *b); /* timing alone */
/* "74.25 1280 1390 1430 1650 720 725 730 750 +hsync +vsync", as cvt and xorg.conf have it. */
bool gn_kms_modeline_parse(const char *text, drmModeModeInfo *out);
/* A mode of that size by VESA's CVT 1.2, reduced blanking version 1. */
drmModeModeInfo gn_kms_mode_cvt(uint32_t width_px, uint32_t height_px, double hz);

#endif
