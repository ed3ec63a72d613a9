/* State shared by the simulator's files. */
#ifndef GN_KMS_SIM_STATE_H
#define GN_KMS_SIM_STATE_H

#include "sim.h"

enum {
    SIM_PLANES = 2 * SIM_CRTCS, /* one primary and one overlay per CRTC */
    SIM_FBS = 48,
    SIM_BLOBS = 32,
    SIM_FILES = 8,
    SIM_HANDLES = 64,
    SIM_EVENTS = 16,
    SIM_NOBODY = -1,
    SIM_STRANGER = -2,
    SIM_CONSOLE = -3,
    SIM_FIRST_FD = 1000,
};

enum sim_prop {
    SIM_P_LINK = 1,
    SIM_P_ORIENTATION,
    SIM_P_NON_DESKTOP,
    SIM_P_EDID,
    SIM_P_DPMS,
    SIM_P_RANGE,
    SIM_P_CONNECTOR_CRTC,
    SIM_P_ACTIVE,
    SIM_P_MODE,
    SIM_P_TYPE,
    SIM_P_FB,
    SIM_P_CRTC,
    SIM_P_SRC_X,
    SIM_P_SRC_Y,
    SIM_P_SRC_W,
    SIM_P_SRC_H,
    SIM_P_X,
    SIM_P_Y,
    SIM_P_W,
    SIM_P_H,
    SIM_P_FENCE,
    SIM_P_ROTATION,
    SIM_P_FORMATS,
    SIM_PROPS
};
enum { SIM_PROP_BASE = 700 };

struct sim_bo { /* memory */
    int refs;
    uint32_t colour;
    uint32_t painted[2]; /* width and height, of the lower left; 0: all of it */
    uint8_t *pixels;     /* of a dumb buffer */
    size_t size;
    uint32_t width_px, height_px;
};
struct sim_fb {
    uint32_t id; /* 0: removed but still shown */
    int refs;
    int file;   /* owner, or SIM_CONSOLE.. */
    bool asked; /* removal was requested while visible */
    struct sim_bo *bo;
    uint32_t width_px, height_px, format;
};
struct sim_blob {
    uint32_t id;
    int file;
    bool asked;
    drmModeModeInfo mode;
};

struct sim_crtc_state {
    bool active, has_mode;
    uint32_t blob; /* of the mode property */
    drmModeModeInfo mode;
};
struct sim_plane_state {
    uint32_t fb;
    int crtc;
    uint64_t src[4]; /* x y w h, 16.16 */
    int64_t dst[4];
    uint64_t rotation;
    int fence;
};
struct sim_connector_state {
    int crtc;
    bool bad_link;
    bool asleep;    /* legacy DPMS */
    uint64_t range; /* of "Broadcast RGB" */
};
struct sim_state { /* committed state; a flip to it may be pending */
    struct sim_crtc_state crtcs[SIM_CRTCS];
    struct sim_plane_state planes[SIM_PLANES];
    struct sim_connector_state connectors[SIM_CONNECTORS];
};

struct sim_flip {
    bool pending;
    struct sim_fb *fb;
    int file;
    void *user;
    int64_t committed_ns, done_ns;
};
struct sim_crtc {
    struct sim_fb *shown;
    struct sim_flip flip;
    enum sim_stall stall;
    int64_t lit_ns;
};
struct sim_card {
    bool there, present; /* there: the card was added */
    char path[64], place[96];
    struct sim_traits traits;
    unsigned life; /* how often it was added */
    uint32_t base; /* of its object ids */
    uint32_t next_id;
    int master;
    int plugged[SIM_CONNECTORS], known[SIM_CONNECTORS]; /* kinds of monitors */
    struct sim_state state;
    struct sim_crtc crtcs[SIM_CRTCS];
    struct sim_fb fbs[SIM_FBS];
    struct sim_blob blobs[SIM_BLOBS];
};

struct sim_event {
    void *user;
    int64_t ns;
    unsigned sequence, crtc;
};
struct sim_handle {
    uint32_t number;
    struct sim_bo *bo;
    bool dumb, asked;
};
struct sim_file {
    int fd; /* 0: unused */
    int card;
    unsigned life;
    bool atomic, universal, was_master;
    struct sim_event events[SIM_EVENTS];
    int event_count;
    struct sim_handle handles[SIM_HANDLES];
    uint32_t next_handle;
    int scanouts;
};

struct sim_world {
    int64_t now_ns;
    struct sim_card cards[SIM_CARDS];
    struct sim_file files[SIM_FILES];
    struct sim_gpu gpu;
    struct sim_refusal refusals[SIM_BROKEN];
    int refusal_count, next_fd;
    bool uevent;
    struct { /* a delayed event */
        struct sim_flip flip;
        int card, crtc;
    } late;
};
extern struct sim_world sim;

/* sim_call.c: entry of every call. Returns NULL or true if the call fails, with errno set. */
struct sim_file *sim_enter(enum sim_op op, int fd);
bool sim_fails(enum sim_op op);
void sim_call_reset(void);
int64_t sim_call_next(void);
void sim_call_pass(void); /* ends the current incident */
struct sim_file *sim_find_file(int fd);
struct sim_card *sim_card_of(const struct sim_file *file);
int sim_index_of(const struct sim_file *file);
void *sim_reply(size_t size); /* allocates as libdrm would */
void sim_reply_free(void *reply);

/* sim_memory.c */
struct sim_bo *sim_bo_create(uint32_t width_px, uint32_t height_px, bool dumb);
void sim_bo_unref(struct sim_bo *bo);
uint32_t sim_handle_add(struct sim_file *file, struct sim_bo *bo, bool dumb);
void sim_handle_close(struct sim_file *file, uint32_t number);
struct sim_fb *sim_fb_find(struct sim_card *card, uint32_t id);
struct sim_fb *sim_fb_add(struct sim_card *card, int file, struct sim_bo *bo, uint32_t format);
struct sim_fb *sim_fb_ref(struct sim_fb *fb);
void sim_fb_unref(struct sim_fb *fb);
void sim_fb_remove(struct sim_card *card, struct sim_fb *fb);
struct sim_blob *sim_blob_find(struct sim_card *card, uint32_t id);
void sim_file_close(struct sim_file *file);

void sim_gl_reset(void); /* sim_gl.c */

/* sim_read.c */
drmModeModeInfo sim_mode_info(const struct sim_mode *mode);
int sim_monitor_modes(int kind, drmModeModeInfo *out);
uint32_t sim_connector_id(const struct sim_card *card, int i);
uint32_t sim_encoder_id(const struct sim_card *card, int i);
uint32_t sim_crtc_id(const struct sim_card *card, int i);
uint32_t sim_plane_id(const struct sim_card *card, int i);
int sim_index(uint32_t id, uint32_t first, int count); /* -1: not among these */

/* sim_commit.c: 0 or an errno; an accepted state is applied at once. */
int sim_check(struct sim_card *card, const struct sim_state *next, bool modeset, bool test);
void sim_take(struct sim_card *card, const struct sim_state *next);
void sim_set_console(struct sim_card *card, int owner);
void sim_start_flip(struct sim_card *card, int crtc, const struct sim_flip *how);
void sim_finish_flip(struct sim_card *card, int crtc);
void sim_tell_late(void);
bool sim_is_stalled(const struct sim_crtc *crtc);
void sim_wait_for_flips(struct sim_card *card);
struct sim_file *sim_enter_as_master(enum sim_op op, int fd);
void sim_refresh(struct sim_card *card); /* updates the visible framebuffers from the state */

/* Fill the drm table's functions, one per file. */
void sim_fill_read(struct gn_drm_ops *ops);
void sim_fill_commit(struct gn_drm_ops *ops);
void sim_fill_atomic(struct gn_drm_ops *ops);
void sim_fill_memory(struct gn_drm_ops *ops);

#endif
