/* Simulated kernel and GPU for tests of the KMS screen: libdrm and GBM behind the two tables that
 * gn_kms uses, on a virtual clock. One machine at a time.
 *
 * It implements the kernel's rules: DRM master, what an atomic commit must contain, EBUSY while a
 * flip is pending, removing a visible framebuffer switches the CRTC off. It counts objects, reports
 * violations, and can make any call fail. A frame is one colour, a number, so that tests can
 * compare the visible frame with the drawn one. */
#ifndef GN_KMS_SIM_H
#define GN_KMS_SIM_H

#include "display/kms/drm.h"
#include "display/kms/scanout.h"

#define SIM_MS INT64_C(1000000)
#define SIM_S  (1000 * SIM_MS)

enum { SIM_CARDS = 2, SIM_CONNECTORS = 2, SIM_CRTCS = 2, SIM_MODES = 4, SIM_BROKEN = 4 };

enum sim_op { /* operations that are counted and can be made to fail */
#define X(name) SIM_##name,
              GN_DRM_TABLE(X)
#undef X
                  SIM_list,
              SIM_open,
              SIM_map,
              SIM_gl_open,
              SIM_gl_surface,
              SIM_gl_swap,
              SIM_OPS
};

enum sim_stall { /* how flips go wrong: no event comes unless a comment says otherwise */
                 SIM_FLOWS,
                 SIM_STALLS_UNTIL_RELIT,
                 SIM_STALLS_UNTIL_REOPENED,
                 SIM_STALLS,
                 SIM_EVENT_LOST, /* one event is lost; the flip itself completes */
                 SIM_EVENT_LATE, /* one event is 12.1 s late */
                 SIM_STALL_COUNT
};
enum sim_incident { /* incidents between two calls; each is undone after two seconds */
                    SIM_CARD_GOES,
                    SIM_MONITOR_GOES,
                    SIM_MONITOR_CHANGES, /* another monitor with other modes */
                    SIM_MASTER_GOES,     /* another process is master and shows its own picture */
                    SIM_LINK_GOES_BAD,   /* permanent: needs a modeset */
                    SIM_INCIDENTS
};

struct sim_traits { /* of a card; zero is a normal one */
    bool gpu_alone; /* cannot scan out: render only */
    bool legacy;    /* no atomic interface */
    bool no_vblank; /* no vblank: flips complete at once, as with virtio */
    bool modifiers, fences;
    bool rotation;       /* planes can rotate, and the console leaves one rotated */
    bool overlays;       /* other programs leave an overlay */
    unsigned enlarges;   /* by how much a primary plane does at most, in percent; 0: not at all */
    bool enlarges_never; /* although TEST_ONLY accepts it */
    bool console;        /* initially shows the text console */
    bool range;          /* connectors have "Broadcast RGB", and somebody has limited it, */
    bool keeps_range;    /* and it cannot be changed with a mode */
};
#define SIM_RENDER_NODE "/dev/dri/renderD128" /* the only one */
struct sim_gpu {                              /* of all cards */
    bool no_gl;
    bool no_surface[GN_FALLBACK_COUNT]; /* by fallback level */
};
struct sim_mode {
    uint16_t width_px, height_px, hz;
    bool preferred;
};
struct sim_refusal { /* modes of that size are refused */
    uint16_t width_px;
    int error;
    bool late; /* although TEST_ONLY accepts them */
};

extern struct gn_drm_ops sim_drm;
extern const struct gn_scanout_ops sim_gl;

/* ---- machine ---- */

/* A machine without cards, at 100 s. Frees the previous one. */
void sim_begin(void);
/* Reports a violation for each kind of object that the program leaked. Returns the number of
 * violations. */
int sim_end(void);
void sim_add_card(int card, const char *path, const struct sim_traits *traits);
enum { SIM_RANGE_AUTOMATIC, SIM_RANGE_FULL, SIM_RANGE_LIMITED };
uint64_t sim_range(int card); /* "Broadcast RGB" of its first connector */
void sim_set_gpu(const struct sim_gpu *gpu);
void sim_refuse_mode(struct sim_refusal refusal);
void sim_allow_modes(void);

/* Monitors; each kind has its modes and EDID. SIM_TWIN: another monitor with the modes of
 * SIM_FULL_HD. SIM_NO_EDID: connection status unknown. SIM_VIEWER and SIM_WIDE_VIEWER have no EDID
 * and the same modes but different preferred ones, like a virtual card whose viewer is resized. */
enum {
    SIM_NO_MONITOR,
    SIM_FULL_HD,
    SIM_SMALL,
    SIM_LARGE,
    SIM_NO_EDID,
    SIM_TWIN,
    SIM_VIEWER,
    SIM_WIDE_VIEWER,
    SIM_MONITORS
};
void sim_plug(int card, int connector, int kind);
void sim_break_link(int card, int connector);
void sim_lose_card(int card);
/* The card returns with new object ids. NULL: at its old path. */
void sim_return_card(int card, const char *path);
void sim_stall(int card, enum sim_stall how);
void sim_console_takes(int card); /* master is dropped and the text console is shown */
/* Another process becomes master and shows its own picture. */
void sim_stranger_takes(int card);
/* `dark`: the other process also switches its CRTC off. */
void sim_stranger_leaves(int card, bool dark);

/* ---- time ---- */

int64_t sim_now(void);
int64_t sim_next(void); /* time of the next event; INT64_MAX: none */
void sim_run_to(int64_t ns);
bool sim_readable(int fd);
bool sim_take_uevent(void); /* whether a uevent was sent since the last call */

/* ---- failures ---- */

/* The nth call of an op (from 1) and the next `burst` - 1 calls fail; 0: none. */
void sim_fail(enum sim_op op, long nth, int burst, int error);
/* Each call fails with probability 1 / `often`; 0: never. */
void sim_fail_often(uint64_t seed, unsigned often);
/* The incident happens before the nth call of any op. */
void sim_happen(enum sim_incident what, long nth);
void sim_trace(bool on); /* prints every call */
const char *sim_op_name(enum sim_op op);
/* Errnos the op can return, terminated by 0. */
const int *sim_op_errors(enum sim_op op);
const char *sim_incident_name(enum sim_incident what);

/* ---- what is visible ---- */

/* Draws the current frame in that colour; valid between begin and present. */
void sim_paint(uint32_t colour);
/* Only the lower left part of that size. It is visible where the plane enlarges that, and no other,
 * to the whole mode. */
void sim_paint_part(uint32_t colour, uint32_t width_px, uint32_t height_px);
void sim_paint_copy(uint8_t *pixels, uint32_t colour);
/* True if a connected monitor shows that colour, not covered by an overlay. */
bool sim_shows(uint32_t colour);
/* True if all connected monitors are off. */
bool sim_is_dark(void);
bool sim_shows_console(int card);
bool sim_is_master(int fd);

/* ---- counts ---- */

struct sim_counts {
    long calls[SIM_OPS], all_calls;
    long failed;      /* calls made to fail */
    long flips, sets; /* completed flips and modesets */
    long blinks;      /* modesets that change a CRTC's mode */
    long waits;       /* commits that waited for a flip */
    /* objects now, and their maximum */
    int files, fbs, blobs, buffers, dumbs, maps, replies, fences_given;
    int most_fbs, most_buffers, most_blobs;
    int complaints;
};
extern struct sim_counts sim_counts;
/* Records a violation; the first few are kept as text. */
void sim_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));
const char *sim_complaint(void); /* the first one; "" if none */

#endif
