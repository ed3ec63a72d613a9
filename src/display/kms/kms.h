/* A screen on the kernel's modesetting, driven by times and events from its caller: selects card
 * and connector, sets a mode, flips, and recovers from failures. It owns no timer and no descriptor
 * except the card's, so that tests run it on a virtual clock; kms/screen.c provides both. */
#ifndef GN_DISPLAY_KMS_KMS_H
#define GN_DISPLAY_KMS_KMS_H

#include "display/kms/card.h"
#include "display/kms/flip.h"
#include "display/kms/scanout.h"

struct gn_kms_env { /* dependencies; must outlive the screen */
    const struct gn_drm_ops *drm;
    const struct gn_scanout_ops *scanout;
    /* Names a process that has a card open, "Xorg (pid 612)"; false: unknown. May be NULL. */
    bool (*find_holder)(const char *node, char *out, size_t size);
    bool no_uevents; /* no uevents arrive: scan every 2 s */
};

enum gn_kms_event {                                   /* bit mask: events since the last step */
                    GN_KMS_EVENT_READABLE = 1 << 0,   /* the card's descriptor is readable */
                    GN_KMS_EVENT_HOTPLUG = 1 << 1,    /* a drm uevent: scan all cards */
                    GN_KMS_EVENT_VT_LEFT = 1 << 2,    /* switched away from our VT: master has been
                                                         dropped when step returns */
                    GN_KMS_EVENT_VT_ENTERED = 1 << 3, /* switched back to our VT */
};

struct gn_kms;
/* Scans once. Succeeds without a card. The options and their texts are copied. */
struct gn_kms *gn_kms_create(const struct gn_kms_env *env, const struct gn_screen_opts *opts,
                             int64_t now_ns);
/* Restores the screen and closes the card; NULL is legal. */
void gn_kms_destroy(struct gn_kms *kms);

/* The card's descriptor, to be polled for reading, or -1. May change in any function below. */
int gn_kms_fd(const struct gn_kms *kms);
/* When step must be called at the latest; INT64_MAX: never. */
int64_t gn_kms_deadline(const struct gn_kms *kms, int64_t now_ns);
/* State of the screen. Valid until the next call of a function below. */
const struct gn_screen *gn_kms_screen(const struct gn_kms *kms);
gn_display_proc gn_kms_get_proc(struct gn_kms *kms, const char *name);

/* As in struct gn_screen_ops; step: its dispatch, with the events since the last one. */
bool gn_kms_step(struct gn_kms *kms, unsigned events, int64_t now_ns, struct gn_err *err);
bool gn_kms_renew(struct gn_kms *kms, int64_t now_ns, struct gn_err *err);
bool gn_kms_begin(struct gn_kms *kms, int64_t now_ns, struct gn_err *err);
bool gn_kms_scale(struct gn_kms *kms, uint32_t width_px, uint32_t height_px);
bool gn_kms_present(struct gn_kms *kms, int64_t now_ns, struct gn_err *err);
void gn_kms_lose(struct gn_kms *kms, int64_t now_ns);
void gn_kms_blank(struct gn_kms *kms, bool on, int64_t now_ns);
void gn_kms_show_message(struct gn_kms *kms, const char *text, int64_t now_ns);

#endif
