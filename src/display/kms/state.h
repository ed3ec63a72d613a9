/* State shared by the files of the KMS screen. */
#ifndef GN_DISPLAY_KMS_STATE_H
#define GN_DISPLAY_KMS_STATE_H

#include "display/kms/dumb.h"
#include "display/kms/kms.h"
#include "display/kms/output.h"

#define GN_KMS_NEVER    INT64_MAX
#define GN_KMS_S        INT64_C(1000000000)
#define GN_KMS_SCAN_NS  (2 * GN_KMS_S)  /* scan interval while nothing is shown */
#define GN_KMS_PROBE_NS (10 * GN_KMS_S) /* scan interval with connector probing */

enum { GN_KMS_TICKETS = 4 };

struct gn_kms_frame { /* a buffer with its framebuffer; fb 0: none */
    void *key;        /* of its buffer */
    uint32_t fb;
    int fence; /* owned; -1: none */
    struct gn_kms_part part;
};
struct gn_kms_scaling {      /* whether the plane scales such a part */
    struct gn_kms_part part; /* that was asked for last; 0 x 0: none since the last modeset */
    bool can;                /* scale it */
    bool fills;              /* the frame that is being drawn fills only that */
};
/* User data of flip events. The ticket number changes when a flip is lost, so that its late event
 * is not taken for that of a later flip. */
struct gn_kms_ticket {
    struct gn_kms *kms;
    uint64_t number;
};

struct gn_kms_device {        /* the open card */
    struct gn_kms_node node;  /* its node */
    int fd;                   /* -1: no card */
    void *scanout;            /* NULL: GL does not start on it, see text.reason */
    struct gn_kms_card card;  /* last snapshot */
    struct gn_kms_card fresh; /* snapshot of a card being scored */
    int unreadable;           /* consecutive snapshots with unreadable objects */
};
struct gn_kms_text {
    char message[256]; /* shown in place of frames; "": none */
    bool changed;      /* the message changed and is not shown yet */
    char reason[128];  /* why nothing is shown, if nothing more specific is known */
    char holder[64];   /* process that has the screen */
};
struct gn_kms_monitor {       /* connector in use and its monitor */
    char connector[32];       /* its name */
    unsigned orientation_deg; /* of its panel */
    uint64_t id;              /* as in gn_kms_connector.monitor */
    uint64_t lit_for;         /* monitor for which output.mode was set */
    bool connected;           /* a connector is selected and has buffers */
    drmModeModeInfo candidates[GN_KMS_CANDIDATES_MAX];
    int candidate_count, mode; /* the mode in use is candidates[mode] */
};
struct gn_kms_buffers {
    struct gn_surface_opts opts;
    struct gn_surface surface; /* unless opts.fallback is COPY */
    struct gn_dumb copies[2];
};
struct gn_kms_frames {           /* at most one frame each */
    struct gn_kms_frame front;   /* scanned out */
    struct gn_kms_frame pending; /* its flip is pending; may equal front */
    struct gn_kms_frame waiting; /* refused temporarily, sent again later */
    int64_t waiting_ns;          /* since when it waits */
    struct gn_kms_ticket tickets[GN_KMS_TICKETS];
    uint64_t ticket;  /* of the pending flip */
    int64_t event_ns; /* time stamp of its event; -1: no event yet */
};
struct gn_kms_due {     /* monotonic, or GN_KMS_NEVER */
    int64_t scan_ns;    /* next scan of cards and connectors */
    int64_t probe_ns;   /* scans from then on probe connectors */
    int64_t master_ns;  /* next attempt to become master */
    int64_t again_ns;   /* next flip of an unchanged frame */
    int64_t sleep_ns;   /* when to switch the screen off, again if needed */
    int64_t starved_ns; /* since when no framebuffer can be created; 0: one can */
};

struct gn_kms {
    struct gn_kms_env env;
    const struct gn_screen_opts *opts;
    struct gn_screen screen;
    struct gn_kms_device device;
    struct gn_kms_output output; /* drm NULL: not open */
    struct gn_kms_monitor monitor;
    struct gn_kms_buffers buffers;
    struct gn_kms_text text;
    bool master, away; /* away: another VT is active */
    bool blank;        /* blanking requested */
    bool lit; /* the CRTC shows the last flipped frame; false: needs a modeset. screen.lit is
                 more: see publish_state() */
    struct gn_kms_frames frames;
    struct gn_kms_scaling scaling;
    struct gn_flip flip;
    int losses; /* context losses with a monitor connected since the last visible frame */
    struct gn_kms_due due;
};

/* Files call downwards: kms.c, blank.c, frame.c, scan.c, buffers.c. */

/* kms/buffers.c: buffers scanned out, pending and waiting. */
bool gn_kms_is_copy(const struct gn_kms *kms); /* frames are copied into dumb buffers */
bool gn_kms_make_copies(struct gn_kms *kms);
struct gn_dumb *gn_kms_free_copy(struct gn_kms *kms); /* the one not scanned out */
void gn_kms_drop_surface(struct gn_kms *kms);         /* drops all buffers too */
/* The buffer is scanned out from now on; may be the same as before. */
void gn_kms_take_front(struct gn_kms *kms, struct gn_kms_frame frame, int64_t now_ns);
void gn_kms_discard(struct gn_kms *kms,
                    struct gn_kms_frame *frame); /* the frame will not be shown */
void gn_kms_flip_is_lost(struct gn_kms *kms);    /* no event will come for the pending flip */

/* kms/scan.c: cards and connectors. Probing a connector takes tens of milliseconds, so it is done
 * after a hotplug event and every GN_KMS_PROBE_NS; otherwise the kernel's cached state is read. */
void gn_kms_scan(struct gn_kms *kms, int64_t now_ns);
/* Closes the card; `restore`: it still accepts commits, so its CRTC is restored first. */
void gn_kms_leave_card(struct gn_kms *kms, bool restore, int64_t now_ns);
/* Destroys the context and closes the card. */
void gn_kms_close_card(struct gn_kms *kms);
/* Current buffers and mode cannot be set: tries other buffers, then the next mode. */
void gn_kms_next_try(struct gn_kms *kms, int error, int64_t now_ns);
bool gn_kms_try_master(struct gn_kms *kms, int64_t now_ns);

/* kms/frame.c: commits and flip events. */
void gn_kms_send(struct gn_kms *kms, struct gn_kms_frame frame, int64_t now_ns);
void gn_kms_send_drawn(struct gn_kms *kms, int64_t now_ns); /* sends the frame that GL has drawn */
void gn_kms_send_message(struct gn_kms *kms, int64_t now_ns);
void gn_kms_lose_master(struct gn_kms *kms, int64_t now_ns);
void gn_kms_drain(struct gn_kms *kms, int64_t now_ns);

/* kms/blank.c */
bool gn_kms_may_sleep(const struct gn_kms *kms);
void gn_kms_sleep(struct gn_kms *kms, int64_t now_ns);
void gn_kms_set_blank(struct gn_kms *kms, bool on, int64_t now_ns);

#endif
