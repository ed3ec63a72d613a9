/* Inside the screen on the kernel's modesetting: what its files share. */
#ifndef GN_DISPLAY_KMS_STATE_H
#define GN_DISPLAY_KMS_STATE_H

#include "display/kms/dumb.h"
#include "display/kms/kms.h"
#include "display/kms/output.h"

#define GN_KMS_NEVER    INT64_MAX
#define GN_KMS_S        INT64_C(1000000000)
#define GN_KMS_LOOK_NS  (2 * GN_KMS_S)  /* between two looks while nothing is lit */
#define GN_KMS_PROBE_NS (10 * GN_KMS_S) /* and between two that ask the wires */

enum { GN_KMS_TICKETS = 4 };

struct gn_kms_shot { /* a picture with its framebuffer; fb 0: none */
    void *key;       /* of its buffer */
    uint32_t fb;
    int fence; /* ours to close, -1: none */
};
/* What an event brings back. Flips share one until one of them is lost, whose event may come yet,
 * and must not be taken for a later one's. */
struct gn_kms_ticket {
    struct gn_kms *kms;
    uint64_t number;
};

struct gn_kms {
    struct gn_kms_env env;
    const struct gn_screen_opts *opts;
    struct gn_screen screen;

    struct gn_kms_node node; /* of the open card */
    int fd;                  /* -1: no card */
    void *scanout;           /* NULL: GL does not start on it, see reason */
    struct gn_kms_card card, fresh;
    struct gn_kms_output output; /* drm NULL: none */
    char notice[256];            /* shown in place of pictures; "": none */
    bool says;                   /* it is another, and not yet shown */
    char reason[128];            /* why nothing is shown, when it is nothing better known */
    char holder[64];             /* who has the screen */

    char connector[32];       /* its name */
    unsigned orientation_deg; /* of its panel */
    uint64_t monitor;         /* that is plugged into it */
    uint64_t lit_for;         /* the one that output.mode was lit for */
    bool connected;           /* something to show on is chosen, and a surface for it */
    drmModeModeInfo ladder[GN_KMS_LADDER_MAX];
    int ladder_count, mode; /* the mode in use is ladder[mode] */
    struct gn_surface_opts surface_opts;
    struct gn_surface surface; /* unless rung is COPY */
    struct gn_dumb copies[2];

    bool master, away;          /* away: on another console */
    bool blank;                 /* to be switched off */
    int64_t sleep_ns;           /* when it is to be switched off, or once more */
    bool lit;                   /* the CRTC shows what was last flipped; else: a modeset */
    struct gn_kms_shot front;   /* seen */
    struct gn_kms_shot pending; /* on its way; the same as front when shown again */
    struct gn_kms_shot waiting; /* refused for the moment */
    int64_t waiting_ns;         /* since when */
    struct gn_flip flip;
    struct gn_kms_ticket tickets[GN_KMS_TICKETS];
    uint64_t ticket;    /* of the pending flip */
    int64_t event_ns;   /* the time that its event tells; -1: no event yet */
    int unreadable;     /* looks in a row at which not all could be read */
    int losses;         /* of the context where there is a monitor, since a frame was last seen */
    int64_t starved_ns; /* since when there is no framebuffer to be had; 0: there is */
    int64_t look_ns, master_ns, again_ns; /* when next; GN_KMS_NEVER */
    int64_t probe_ns;                     /* looks from then on ask the wires */
};

/* Files call downwards: kms.c, blank.c, frame.c, look.c, buffers.c. */

/* kms/buffers.c: which buffer the screen, the flip and the queue hold. */
bool gn_kms_is_copy(const struct gn_kms *kms); /* frames are copied into dumb buffers */
bool gn_kms_make_copies(struct gn_kms *kms);
struct gn_dumb *gn_kms_free_copy(struct gn_kms *kms); /* the one that is not on the screen */
void gn_kms_drop_surface(struct gn_kms *kms);         /* and all buffers */
/* The screen shows this buffer from now on; it may be the one that it showed before. */
void gn_kms_take_front(struct gn_kms *kms, struct gn_kms_shot shot, int64_t now_ns);
void gn_kms_discard(struct gn_kms *kms, struct gn_kms_shot *shot); /* it will not be shown */
void gn_kms_flip_is_lost(struct gn_kms *kms); /* no event will come for the pending flip */

/* kms/look.c: cards and connectors. Probing a connector takes tens of milliseconds, so it is done
 * after a hotplug event and every GN_KMS_PROBE_NS; otherwise the kernel's cached state is read. */
void gn_kms_look(struct gn_kms *kms, int64_t now_ns);
/* Gives the card up; `restore`: it still accepts commits, so its CRTC is put back first. */
void gn_kms_leave_card(struct gn_kms *kms, bool restore, int64_t now_ns);
/* Ends the context and closes the card. */
void gn_kms_close_card(struct gn_kms *kms);
/* The current buffers and mode cannot be lit: takes other buffers, then another mode. */
void gn_kms_next_try(struct gn_kms *kms, int error, int64_t now_ns);
bool gn_kms_try_master(struct gn_kms *kms, int64_t now_ns);

/* kms/frame.c: commits and their events. */
void gn_kms_send(struct gn_kms *kms, struct gn_kms_shot shot, int64_t now_ns);
void gn_kms_send_drawn(struct gn_kms *kms, int64_t now_ns); /* the frame that GL has drawn */
void gn_kms_show_notice(struct gn_kms *kms, int64_t now_ns);
void gn_kms_lose_master(struct gn_kms *kms, int64_t now_ns);
void gn_kms_drain(struct gn_kms *kms, int64_t now_ns);

/* kms/blank.c: a screen that is switched off on purpose. */
bool gn_kms_may_sleep(const struct gn_kms *kms);
void gn_kms_sleep(struct gn_kms *kms, int64_t now_ns);
void gn_kms_set_blank(struct gn_kms *kms, bool on, int64_t now_ns);

#endif
