/* A screen on the kernel's modesetting, on time and events that come from outside: it finds a card
 * and a connector, lights it, flips, and gets over whatever goes wrong. It owns no timer and no
 * descriptor but the card's, so that a test drives it on a virtual clock. kms/screen.c gives it
 * both.
 */
#ifndef GN_DISPLAY_KMS_KMS_H
#define GN_DISPLAY_KMS_KMS_H

#include "display/kms/card.h"
#include "display/kms/flip.h"
#include "display/kms/scanout.h"

struct gn_kms_env { /* what it stands on; must outlive it */
    const struct gn_drm_ops *drm;
    const struct gn_scanout_ops *scanout;
    /* Who has a card open, for people: "Xorg (pid 612)"; false: not known. May be NULL. */
    bool (*find_holder)(const char *node, char *out, size_t size);
    bool no_uevents; /* no uevent will tell of anything: look every 2 s */
};

enum gn_kms_event { /* bits: what has happened since the last step */
                    GN_KMS_EVENT_READABLE = 1 << 0, /* the card's descriptor */
                    GN_KMS_EVENT_HOTPLUG = 1 << 1,  /* a uevent of drm: look at all cards anew */
                    GN_KMS_EVENT_VT_LEFT = 1 << 2,  /* the console wants the screen: master has been
                                                       dropped when  step returns */
                    GN_KMS_EVENT_VT_ENTERED = 1 << 3, /* it is ours again */
};

struct gn_kms;
/* Takes the first look. Never fails for want of a card. The options must outlive it. */
struct gn_kms *gn_kms_create(const struct gn_kms_env *env, const struct gn_screen_opts *opts,
                             int64_t now_ns);
/* Puts the screen back as it was found and closes the card; NULL is legal. */
void gn_kms_destroy(struct gn_kms *kms);

/* The card's descriptor, to be watched for reading, or -1. Changes in any of the functions below.
 */
int gn_kms_fd(const struct gn_kms *kms);
/* When step is to be called at the latest; INT64_MAX: never. */
int64_t gn_kms_deadline(const struct gn_kms *kms, int64_t now_ns);
/* The screen as it is; `fd` is -1. Valid until the next call of a function below. */
const struct gn_screen *gn_kms_screen(const struct gn_kms *kms);
gn_display_proc gn_kms_get_proc(struct gn_kms *kms, const char *name);

/* As those of struct gn_screen_ops. */
bool gn_kms_step(struct gn_kms *kms, unsigned events, int64_t now_ns, struct gn_err *err);
bool gn_kms_renew(struct gn_kms *kms, int64_t now_ns, struct gn_err *err);
bool gn_kms_begin(struct gn_kms *kms, int64_t now_ns, struct gn_err *err);
bool gn_kms_present(struct gn_kms *kms, int64_t now_ns, struct gn_err *err);
void gn_kms_lose(struct gn_kms *kms, int64_t now_ns);
void gn_kms_blank(struct gn_kms *kms, bool on, int64_t now_ns);
void gn_kms_show_message(struct gn_kms *kms, const char *text, int64_t now_ns);

#endif
