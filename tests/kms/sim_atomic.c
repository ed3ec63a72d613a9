/* The atomic interface: a request is applied to a copy of the card's state, which is then
 * validated. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>

#include "sim_state.h"

enum { ITEMS = 96 };
struct item {
    uint32_t object, property;
    uint64_t value;
};
struct _drmModeAtomicReq {
    int count;
    struct item items[ITEMS];
};

static drmModeAtomicReqPtr alloc_request(void) {
    return sim_fails(SIM_ModeAtomicAlloc) ? NULL : sim_reply(sizeof(struct _drmModeAtomicReq));
}

static void free_request(drmModeAtomicReqPtr request) { sim_reply_free(request); }

static int add_property(drmModeAtomicReqPtr r, uint32_t object, uint32_t property, uint64_t value) {
    if (sim_fails(SIM_ModeAtomicAddProperty)) return -errno;
    if (r->count == ITEMS) {
        sim_complain("more than %d properties in a request", ITEMS);
        return -ENOMEM;
    }
    r->items[r->count++] = (struct item){object, property, value};
    return r->count;
}

/* ---- reading a request ---- */

static int set_crtc_of(const struct sim_card *card, uint64_t id, int *out) {
    *out = sim_index((uint32_t)id, sim_crtc_id(card, 0), SIM_CRTCS);
    return id == 0 || *out >= 0 ? 0 : EINVAL;
}

static int set_connector(const struct sim_card *card, struct sim_connector_state *c,
                         const struct item *item) {
    switch (item->property - SIM_PROP_BASE) {
    case SIM_P_CONNECTOR_CRTC: return set_crtc_of(card, item->value, &c->crtc);
    case SIM_P_LINK:
        if (item->value == DRM_MODE_LINK_STATUS_GOOD) c->bad_link = false;
        return 0;
    case SIM_P_RANGE:
        if (item->value >= 3 || card->traits.keeps_range) return EINVAL;
        c->range = item->value;
        return 0;
    default: return ENOENT;
    }
}

static int set_crtc(struct sim_card *card, struct sim_crtc_state *c, const struct item *item) {
    const struct sim_blob *blob = sim_blob_find(card, (uint32_t)item->value);
    switch (item->property - SIM_PROP_BASE) {
    case SIM_P_ACTIVE: c->active = item->value; return 0;
    case SIM_P_MODE:
        if (item->value == c->blob && item->value) return 0;
        if (item->value && !blob) return EINVAL;
        c->blob = (uint32_t)item->value;
        c->has_mode = blob;
        c->mode = blob ? blob->mode : (drmModeModeInfo){0};
        return 0;
    default: return ENOENT;
    }
}

static int set_fence(struct sim_plane_state *p, uint64_t value) {
    p->fence = (int)value;
    if (p->fence < 0 || fcntl(p->fence, F_GETFD) >= 0) return 0;
    sim_complain("closed fence in a request");
    return EINVAL;
}

static int set_plane(struct sim_card *card, struct sim_plane_state *p, const struct item *item) {
    const uint32_t property = item->property - SIM_PROP_BASE;
    if (property >= SIM_P_SRC_X && property <= SIM_P_SRC_H) {
        p->src[property - SIM_P_SRC_X] = item->value;
        return 0;
    }
    if (property >= SIM_P_X && property <= SIM_P_H) {
        p->dst[property - SIM_P_X] = (int64_t)item->value;
        return 0;
    }
    switch (property) {
    case SIM_P_FB:
        if (item->value && !sim_fb_find(card, (uint32_t)item->value)) {
            sim_complain("unknown framebuffer %u in a request", (unsigned)item->value);
            return EINVAL;
        }
        p->fb = (uint32_t)item->value;
        return 0;
    case SIM_P_CRTC: return set_crtc_of(card, item->value, &p->crtc);
    case SIM_P_FENCE: return card->traits.fences ? set_fence(p, item->value) : ENOENT;
    case SIM_P_ROTATION: p->rotation = item->value; return card->traits.rotation ? 0 : ENOENT;
    default: return ENOENT;
    }
}

static void touch(unsigned *touched, int before, int after) {
    if (before >= 0) *touched |= 1u << before;
    if (after >= 0) *touched |= 1u << after;
}

static int set(struct sim_card *card, struct sim_state *next, const struct item *item,
               unsigned *touched) {
    int i = sim_index(item->object, sim_connector_id(card, 0), SIM_CONNECTORS);
    if (i >= 0) {
        const int before = next->connectors[i].crtc;
        const int error = set_connector(card, &next->connectors[i], item);
        touch(touched, before, next->connectors[i].crtc);
        return error;
    }
    i = sim_index(item->object, sim_plane_id(card, 0), SIM_PLANES);
    if (i >= 0) {
        const int before = next->planes[i].crtc;
        const int error = set_plane(card, &next->planes[i], item);
        touch(touched, before, next->planes[i].crtc);
        return error;
    }
    i = sim_index(item->object, sim_crtc_id(card, 0), SIM_CRTCS);
    touch(touched, i, i);
    return i < 0 ? ENOENT : set_crtc(card, &next->crtcs[i], item);
}

/* ---- commits ---- */

static int commit_flip(struct sim_card *card, const struct sim_state *next, unsigned touched,
                       const struct sim_flip *flip) {
    for (int i = 0; i < SIM_CRTCS; i++) {
        if (!(touched >> i & 1)) continue;
        if (!next->crtcs[i].active && flip->user) return EINVAL;
        if (!card->crtcs[i].flip.pending) continue;
        sim_complain("commit while a flip is pending");
        return EBUSY;
    }
    card->state = *next;
    for (int i = 0; i < SIM_CRTCS; i++)
        if (touched >> i & 1) sim_start_flip(card, i, flip);
    return 0;
}

static int commit(int fd, const drmModeAtomicReqPtr request, uint32_t flags, void *user) {
    struct sim_file *f = sim_enter_as_master(SIM_ModeAtomicCommit, fd);
    if (!f) return -errno;
    struct sim_card *card = sim_card_of(f);
    const bool test = flags & DRM_MODE_ATOMIC_TEST_ONLY, told = flags & DRM_MODE_PAGE_FLIP_EVENT,
               blocks = !test && !(flags & DRM_MODE_ATOMIC_NONBLOCK);
    if (!f->atomic || (test && told)) return -EINVAL;
    if (blocks) sim_wait_for_flips(card);
    struct sim_state next = card->state;
    unsigned touched = 0;
    int error = 0;
    for (int i = 0; i < request->count && error == 0; i++)
        error = set(card, &next, &request->items[i], &touched);
    if (error == 0) error = sim_check(card, &next, flags & DRM_MODE_ATOMIC_ALLOW_MODESET, test);
    if (error != 0 || test) return -error;
    const struct sim_flip flip = {.file = sim_index_of(f), .user = told ? user : NULL};
    if (!blocks) return -commit_flip(card, &next, touched, &flip);
    sim_run_to(sim.now_ns + 17 * SIM_MS);
    sim_take(card, &next);
    return 0;
}

void sim_fill_atomic(struct gn_drm_ops *ops) {
    ops->ModeAtomicAlloc = alloc_request;
    ops->ModeAtomicFree = free_request;
    ops->ModeAtomicAddProperty = add_property;
    ops->ModeAtomicCommit = commit;
}
