/* Inside the screen on the kernel's modesetting: what its files share. */
#ifndef GN_DISPLAY_KMS_STATE_H
#define GN_DISPLAY_KMS_STATE_H

#include "display/kms/dumb.h"
#include "display/kms/kms.h"
#include "display/kms/output.h"

#define GN_KMS_NEVER    INT64_MAX
#define GN_KMS_S        INT64_C(1000000000)
#define GN_KMS_SCAN_NS  (2 * GN_KMS_S)  /* between two looks while nothing is lit */
#define GN_KMS_PROBE_NS (10 * GN_KMS_S) /* and between two that ask the wires */

enum { GN_KMS_TICKETS = 4 };

struct gn_kms_frame { /* a picture with its framebuffer; fb 0: none */
    void *key;        /* of its buffer */
    uint32_t fb;
    int fence; /* ours to close, -1: none */
};
/* What a flip event brings back. Flips share a ticket until one is lost: its event may still come
 * and must not be taken for a later one's. */
struct gn_kms_ticket {
    struct gn_kms *kms;
    uint64_t number;
};

struct gn_kms_device {        /* the open card */
    struct gn_kms_node node;  /* where it is */
    int fd;                   /* -1: no card */
    void *scanout;            /* NULL: GL does not start on it, see text.reason */
    struct gn_kms_card card;  /* as last read */
    struct gn_kms_card fresh; /* one that is being rated */
    int unreadable;           /* reads in a row in which some objects could not be read */
};
struct gn_kms_text {
    char message[256]; /* shown in place of pictures; "": none */
    bool changed;      /* the notice is another one and not shown yet */
    char reason[128];  /* why nothing is shown, where nothing better is known */
    char holder[64];   /* the program that has the screen */
};
struct gn_kms_monitor {       /* the connector in use and what is plugged into it */
    char connector[32];       /* its name */
    unsigned orientation_deg; /* of its panel */
    uint64_t id;              /* of the monitor that is plugged in */
    uint64_t lit_for;         /* the id for which output.mode was set */
    bool connected;           /* a connector is chosen and there are buffers for it */
    drmModeModeInfo candidates[GN_KMS_CANDIDATES_MAX];
    int candidate_count, mode; /* the mode in use is ladder[mode] */
};
struct gn_kms_buffers {
    struct gn_surface_opts opts;
    struct gn_surface surface; /* unless opts.fallback is COPY */
    struct gn_dumb copies[2];
};
struct gn_kms_frames {           /* at most one each */
    struct gn_kms_frame front;   /* on the screen */
    struct gn_kms_frame pending; /* its flip is pending; the same as front when flipped again */
    struct gn_kms_frame waiting; /* refused for the moment, sent again later */
    int64_t waiting_ns;          /* since when */
    struct gn_kms_ticket tickets[GN_KMS_TICKETS];
    uint64_t ticket;  /* of the pending flip */
    int64_t event_ns; /* the time stamp of its event; -1: no event yet */
};
struct gn_kms_due {     /* monotonic; GN_KMS_NEVER */
    int64_t scan_ns;    /* next look at cards and connectors */
    int64_t probe_ns;   /* looks from then on probe the connectors */
    int64_t master_ns;  /* next try to become master */
    int64_t again_ns;   /* next flip of a still picture */
    int64_t sleep_ns;   /* when the screen is to be switched off, or once more */
    int64_t starved_ns; /* since when no framebuffer can be made; 0: one can */
};

struct gn_kms {
    struct gn_kms_env env;
    const struct gn_screen_opts *opts;
    struct gn_screen screen;
    struct gn_kms_device device;
    struct gn_kms_output output; /* drm NULL: none */
    struct gn_kms_monitor monitor;
    struct gn_kms_buffers buffers;
    struct gn_kms_text text;
    bool master, away; /* away: another console is shown */
    bool blank;        /* to be switched off */
    bool lit;          /* the CRTC shows what was last flipped; false: a modeset is needed */
    struct gn_kms_frames frames;
    struct gn_flip flip;
    int losses; /* of the context while there is a monitor, since a frame was last shown */
    struct gn_kms_due due;
};

/* Files call downwards: kms.c, blank.c, frame.c, scan.c, buffers.c. */

/* kms/buffers.c: which buffer the screen, the flip and the queue hold. */
bool gn_kms_is_copy(const struct gn_kms *kms); /* frames are copied into dumb buffers */
bool gn_kms_make_copies(struct gn_kms *kms);
struct gn_dumb *gn_kms_free_copy(struct gn_kms *kms); /* the one that is not on the screen */
void gn_kms_drop_surface(struct gn_kms *kms);         /* and all buffers */
/* The screen shows this buffer from now on; it may be the one that it showed before. */
void gn_kms_take_front(struct gn_kms *kms, struct gn_kms_frame frame, int64_t now_ns);
void gn_kms_discard(struct gn_kms *kms, struct gn_kms_frame *frame); /* it will not be shown */
void gn_kms_flip_is_lost(struct gn_kms *kms); /* no event will come for the pending flip */

/* kms/scan.c: cards and connectors. Probing a connector takes tens of milliseconds, so it is done
 * after a hotplug event and every GN_KMS_PROBE_NS; otherwise the kernel's cached state is read. */
void gn_kms_scan(struct gn_kms *kms, int64_t now_ns);
/* Gives the card up; `restore`: it still accepts commits, so its CRTC is put back first. */
void gn_kms_leave_card(struct gn_kms *kms, bool restore, int64_t now_ns);
/* Ends the context and closes the card. */
void gn_kms_close_card(struct gn_kms *kms);
/* The current buffers and mode cannot be lit: takes other buffers, then another mode. */
void gn_kms_next_try(struct gn_kms *kms, int error, int64_t now_ns);
bool gn_kms_try_master(struct gn_kms *kms, int64_t now_ns);

/* kms/frame.c: commits and their events. */
void gn_kms_send(struct gn_kms *kms, struct gn_kms_frame frame, int64_t now_ns);
void gn_kms_send_drawn(struct gn_kms *kms, int64_t now_ns); /* the frame that GL has drawn */
void gn_kms_send_message(struct gn_kms *kms, int64_t now_ns);
void gn_kms_lose_master(struct gn_kms *kms, int64_t now_ns);
void gn_kms_drain(struct gn_kms *kms, int64_t now_ns);

/* kms/blank.c: a screen that is switched off on purpose. */
bool gn_kms_may_sleep(const struct gn_kms *kms);
void gn_kms_sleep(struct gn_kms *kms, int64_t now_ns);
void gn_kms_set_blank(struct gn_kms *kms, bool on, int64_t now_ns);

#endif
