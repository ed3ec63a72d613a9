/* Queries: the objects of a card, their properties, and DRM master. */
#include <drm_fourcc.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "sim_state.h"

/* ---- monitors ---- */

drmModeModeInfo sim_mode_info(const struct sim_mode *m) {
    drmModeModeInfo info = {.hdisplay = m->width_px,
                            .hsync_start = m->width_px + 4,
                            .hsync_end = m->width_px + 8,
                            .htotal = m->width_px + 16,
                            .vdisplay = m->height_px,
                            .vsync_start = m->height_px + 2,
                            .vsync_end = m->height_px + 4,
                            .vtotal = m->height_px + 8,
                            .vrefresh = m->hz,
                            .type = m->preferred ? DRM_MODE_TYPE_PREFERRED : 0};
    info.clock = (uint32_t)info.htotal * info.vtotal * m->hz / 1000;
    snprintf(info.name, sizeof info.name, "%ux%u", m->width_px, m->height_px);
    return info;
}

int sim_monitor_modes(int kind, drmModeModeInfo *out) {
    static const struct sim_mode modes[SIM_MONITORS][SIM_MODES] = {
        [SIM_FULL_HD] = {{96, 54, 60, true}, {64, 48, 60, false}, {64, 48, 50, false}},
        [SIM_SMALL] = {{48, 32, 60, true}, {32, 24, 60, false}},
        [SIM_LARGE] = {{120, 68, 30, true}, {120, 68, 60, false}, {96, 54, 60, false}},
        [SIM_NO_EDID] = {{64, 48, 60, false}, {32, 24, 60, false}},
        [SIM_TWIN] = {{96, 54, 60, true}, {64, 48, 60, false}, {64, 48, 50, false}},
        [SIM_VIEWER] = {{64, 48, 60, true}, {96, 54, 60, false}},
        [SIM_WIDE_VIEWER] = {{64, 48, 60, false}, {96, 54, 60, true}},
    };
    int count = 0;
    for (; count < SIM_MODES && modes[kind][count].width_px; count++)
        out[count] = sim_mode_info(&modes[kind][count]);
    return count;
}

/* ---- ids ---- */

uint32_t sim_connector_id(const struct sim_card *card, int i) {
    return card->base + 1 + (uint32_t)i;
}
uint32_t sim_encoder_id(const struct sim_card *card, int i) {
    return card->base + 11 + (uint32_t)i;
}
uint32_t sim_crtc_id(const struct sim_card *card, int i) { return card->base + 21 + (uint32_t)i; }
uint32_t sim_plane_id(const struct sim_card *card, int i) { return card->base + 31 + (uint32_t)i; }

int sim_index(uint32_t id, uint32_t first, int count) {
    return id >= first && id < first + (uint32_t)count ? (int)(id - first) : -1;
}

static int find(uint32_t id, uint32_t first, int count) {
    const int i = sim_index(id, first, count);
    if (i < 0) errno = ENOENT;
    return i;
}

/* ---- properties ---- */

static const char *const prop_names[SIM_PROPS] = {
    [SIM_P_LINK] = "link-status",
    [SIM_P_ORIENTATION] = "panel orientation",
    [SIM_P_NON_DESKTOP] = "non-desktop",
    [SIM_P_EDID] = "EDID",
    [SIM_P_DPMS] = "DPMS",
    [SIM_P_RANGE] = "Broadcast RGB",
    [SIM_P_CONNECTOR_CRTC] = "CRTC_ID",
    [SIM_P_ACTIVE] = "ACTIVE",
    [SIM_P_MODE] = "MODE_ID",
    [SIM_P_TYPE] = "type",
    [SIM_P_FB] = "FB_ID",
    [SIM_P_CRTC] = "CRTC_ID",
    [SIM_P_SRC_X] = "SRC_X",
    [SIM_P_SRC_Y] = "SRC_Y",
    [SIM_P_SRC_W] = "SRC_W",
    [SIM_P_SRC_H] = "SRC_H",
    [SIM_P_X] = "CRTC_X",
    [SIM_P_Y] = "CRTC_Y",
    [SIM_P_W] = "CRTC_W",
    [SIM_P_H] = "CRTC_H",
    [SIM_P_FENCE] = "IN_FENCE_FD",
    [SIM_P_ROTATION] = "rotation",
    [SIM_P_FORMATS] = "IN_FORMATS",
};

struct props {
    uint32_t ids[SIM_PROPS];
    uint64_t values[SIM_PROPS];
    uint32_t count;
};

static void put(struct props *p, enum sim_prop prop, uint64_t value) {
    p->ids[p->count] = SIM_PROP_BASE + prop;
    p->values[p->count++] = value;
}

static uint32_t crtc_or_0(const struct sim_card *card, int crtc) {
    return crtc >= 0 ? sim_crtc_id(card, crtc) : 0;
}

static uint32_t formats_id(const struct sim_card *card) { return card->base + 90; }

/* 0 for a monitor without EDID. */
static uint32_t edid_id(const struct sim_card *card, int kind) {
    const bool has = kind != SIM_NO_MONITOR && kind < SIM_VIEWER && kind != SIM_NO_EDID;
    return has ? card->base + 50 + (uint32_t)kind : 0;
}

static void connector_props(const struct sim_file *f, const struct sim_card *card, int i,
                            struct props *p) {
    put(p, SIM_P_LINK, card->state.connectors[i].bad_link);
    put(p, SIM_P_NON_DESKTOP, 0);
    put(p, SIM_P_ORIENTATION, 0);
    put(p, SIM_P_EDID, edid_id(card, card->known[i]));
    put(p, SIM_P_DPMS, card->state.connectors[i].asleep ? DRM_MODE_DPMS_OFF : DRM_MODE_DPMS_ON);
    if (card->traits.range) put(p, SIM_P_RANGE, card->state.connectors[i].range);
    if (f->atomic) put(p, SIM_P_CONNECTOR_CRTC, crtc_or_0(card, card->state.connectors[i].crtc));
}

static void plane_props(const struct sim_file *f, const struct sim_card *card, int i,
                        struct props *p) {
    const struct sim_plane_state *s = &card->state.planes[i];
    put(p, SIM_P_TYPE, i < SIM_CRTCS ? DRM_PLANE_TYPE_PRIMARY : DRM_PLANE_TYPE_OVERLAY);
    if (card->traits.rotation) put(p, SIM_P_ROTATION, s->rotation);
    if (card->traits.modifiers) put(p, SIM_P_FORMATS, formats_id(card));
    if (!f->atomic) return;
    put(p, SIM_P_FB, s->fb);
    put(p, SIM_P_CRTC, crtc_or_0(card, s->crtc));
    for (int k = 0; k < 4; k++) put(p, (enum sim_prop)(SIM_P_SRC_X + k), s->src[k]);
    for (int k = 0; k < 4; k++) put(p, (enum sim_prop)(SIM_P_X + k), (uint64_t)s->dst[k]);
    if (card->traits.fences) put(p, SIM_P_FENCE, (uint64_t)-1);
}

static drmModeObjectPropertiesPtr object_props(int fd, uint32_t id, uint32_t type) {
    struct sim_file *f = sim_enter(SIM_ModeObjectGetProperties, fd);
    struct reply {
        drmModeObjectProperties all;
        struct props p;
    };
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    const int connector = sim_index(id, sim_connector_id(card, 0), SIM_CONNECTORS),
              crtc = sim_index(id, sim_crtc_id(card, 0), SIM_CRTCS),
              plane = sim_index(id, sim_plane_id(card, 0), SIM_PLANES);
    errno = ENOENT;
    if (connector < 0 && crtc < 0 && plane < 0) return NULL;
    if (plane >= 0 && type != DRM_MODE_OBJECT_PLANE) return NULL;
    struct reply *r = sim_reply(sizeof *r);
    if (connector >= 0) connector_props(f, card, connector, &r->p);
    if (plane >= 0) plane_props(f, card, plane, &r->p);
    if (crtc >= 0 && f->atomic) {
        put(&r->p, SIM_P_ACTIVE, card->state.crtcs[crtc].active);
        put(&r->p, SIM_P_MODE, card->state.crtcs[crtc].blob);
    }
    r->all.count_props = r->p.count;
    r->all.props = r->p.ids;
    r->all.prop_values = r->p.values;
    return &r->all;
}

static drmModePropertyPtr property(int fd, uint32_t id) {
    struct sim_file *f = sim_enter(SIM_ModeGetProperty, fd);
    if (!f) return NULL;
    const int i = find(id, SIM_PROP_BASE, SIM_PROPS);
    if (i <= 0) return NULL;
    static const char *const ranges[] = {"Automatic", "Full", "Limited 16:235"};
    struct reply {
        drmModePropertyRes prop;
        struct drm_mode_property_enum enums[3];
    } *r = sim_reply(sizeof *r);
    drmModePropertyRes *p = &r->prop;
    p->prop_id = id;
    snprintf(p->name, sizeof p->name, "%s", prop_names[i]);
    for (int k = 0; i == SIM_P_RANGE && k < 3; k++) {
        r->enums[k].value = (uint64_t)k;
        snprintf(r->enums[k].name, sizeof r->enums[k].name, "%s", ranges[k]);
        p->enums = r->enums;
        p->count_enums = 3;
    }
    return p;
}

/* EDIDs of kinds of monitors differ in the serial number only. */
static drmModePropertyBlobPtr edid_blob(uint32_t id, int kind) {
    struct reply {
        drmModePropertyBlobRes blob;
        uint8_t bytes[128];
    };
    struct reply *r = sim_reply(sizeof *r);
    memset(r->bytes + 1, 0xff, 6);
    r->bytes[12] = (uint8_t)kind;
    r->blob = (drmModePropertyBlobRes){.id = id, .length = sizeof r->bytes, .data = r->bytes};
    return &r->blob;
}

/* One format, with LINEAR and another modifier. */
static drmModePropertyBlobPtr formats_blob(uint32_t id) {
    struct reply {
        drmModePropertyBlobRes blob;
        struct drm_format_modifier_blob head;
        uint32_t formats[2];
        struct drm_format_modifier modifiers[2];
    };
    struct reply *r = sim_reply(sizeof *r);
    r->head.version = FORMAT_BLOB_CURRENT;
    r->head.count_formats = r->head.count_modifiers = 2;
    r->head.formats_offset = offsetof(struct reply, formats) - offsetof(struct reply, head);
    r->head.modifiers_offset = offsetof(struct reply, modifiers) - offsetof(struct reply, head);
    r->formats[0] = DRM_FORMAT_RGB565, r->formats[1] = DRM_FORMAT_XRGB8888;
    r->modifiers[0] = (struct drm_format_modifier){.formats = 2, .modifier = 7};
    r->modifiers[1] = (struct drm_format_modifier){.formats = 3};
    r->blob.id = id;
    r->blob.length = (uint32_t)(sizeof *r - offsetof(struct reply, head));
    r->blob.data = &r->head;
    return &r->blob;
}

static drmModePropertyBlobPtr property_blob(int fd, uint32_t id) {
    struct sim_file *f = sim_enter(SIM_ModeGetPropertyBlob, fd);
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    errno = ENOENT;
    if (id == formats_id(card)) return formats_blob(id);
    for (int i = 0; i < SIM_CONNECTORS; i++)
        if (id && id == edid_id(card, card->known[i])) return edid_blob(id, card->known[i]);
    return NULL;
}

/* ---- objects ---- */

static drmModeResPtr resources(int fd) {
    struct sim_file *f = sim_enter(SIM_ModeGetResources, fd);
    struct reply {
        drmModeRes res;
        uint32_t crtcs[SIM_CRTCS], connectors[SIM_CONNECTORS], encoders[SIM_CONNECTORS];
    };
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    errno = EOPNOTSUPP;
    if (card->traits.gpu_alone) return NULL;
    struct reply *r = sim_reply(sizeof *r);
    for (int i = 0; i < SIM_CRTCS; i++) r->crtcs[i] = sim_crtc_id(card, i);
    for (int i = 0; i < SIM_CONNECTORS; i++) r->connectors[i] = sim_connector_id(card, i);
    for (int i = 0; i < SIM_CONNECTORS; i++) r->encoders[i] = sim_encoder_id(card, i);
    r->res = (drmModeRes){.count_crtcs = SIM_CRTCS,
                          .crtcs = r->crtcs,
                          .count_connectors = SIM_CONNECTORS,
                          .connectors = r->connectors,
                          .count_encoders = SIM_CONNECTORS,
                          .encoders = r->encoders,
                          .max_width = 8192,
                          .max_height = 8192};
    return &r->res;
}

static drmModeConnectorPtr connector(enum sim_op op, int fd, uint32_t id) {
    struct sim_file *f = sim_enter(op, fd);
    struct reply {
        drmModeConnector c;
        drmModeModeInfo modes[SIM_MODES];
        uint32_t encoder;
        struct props p;
    };
    if (!f) return NULL;
    struct sim_card *card = sim_card_of(f);
    const int i = find(id, sim_connector_id(card, 0), SIM_CONNECTORS);
    if (i < 0) return NULL;
    if (op == SIM_ModeGetConnector) card->known[i] = card->plugged[i];
    struct reply *r = sim_reply(sizeof *r);
    connector_props(f, card, i, &r->p);
    r->encoder = sim_encoder_id(card, i);
    r->c = (drmModeConnector){.connector_id = id,
                              .connector_type = DRM_MODE_CONNECTOR_HDMIA,
                              .connector_type_id = (uint32_t)i + 1,
                              .connection = card->known[i] == SIM_NO_MONITOR ? DRM_MODE_DISCONNECTED
                                            : card->known[i] == SIM_NO_EDID
                                                ? DRM_MODE_UNKNOWNCONNECTION
                                                : DRM_MODE_CONNECTED,
                              .modes = r->modes,
                              .count_encoders = 1,
                              .encoders = &r->encoder,
                              .props = r->p.ids,
                              .prop_values = r->p.values,
                              .count_props = (int)r->p.count};
    r->c.encoder_id = card->state.connectors[i].crtc >= 0 ? r->encoder : 0;
    r->c.count_modes = sim_monitor_modes(card->known[i], r->modes);
    return &r->c;
}

static drmModeConnectorPtr connector_probed(int fd, uint32_t id) {
    return connector(SIM_ModeGetConnector, fd, id);
}
static drmModeConnectorPtr connector_known(int fd, uint32_t id) {
    return connector(SIM_ModeGetConnectorCurrent, fd, id);
}

static drmModeEncoderPtr encoder(int fd, uint32_t id) {
    struct sim_file *f = sim_enter(SIM_ModeGetEncoder, fd);
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    const int i = find(id, sim_encoder_id(card, 0), SIM_CONNECTORS);
    if (i < 0) return NULL;
    drmModeEncoder *e = sim_reply(sizeof *e);
    e->encoder_id = id;
    e->crtc_id = crtc_or_0(card, card->state.connectors[i].crtc);
    e->possible_crtcs = i == 0 ? 3 : 2; /* the second encoder drives the second CRTC only */
    return e;
}

static drmModeCrtcPtr crtc(int fd, uint32_t id) {
    struct sim_file *f = sim_enter(SIM_ModeGetCrtc, fd);
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    const int i = find(id, sim_crtc_id(card, 0), SIM_CRTCS);
    if (i < 0) return NULL;
    drmModeCrtc *c = sim_reply(sizeof *c);
    c->crtc_id = id;
    c->buffer_id = card->state.planes[i].crtc == i ? card->state.planes[i].fb : 0;
    c->mode_valid = card->state.crtcs[i].has_mode;
    c->mode = card->state.crtcs[i].mode;
    c->width = c->mode.hdisplay;
    c->height = c->mode.vdisplay;
    return c;
}

static drmModePlaneResPtr planes(int fd) {
    struct sim_file *f = sim_enter(SIM_ModeGetPlaneResources, fd);
    struct reply {
        drmModePlaneRes res;
        uint32_t ids[SIM_PLANES];
    };
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    struct reply *r = sim_reply(sizeof *r);
    r->res.planes = r->ids;
    for (int i = f->universal ? 0 : SIM_CRTCS; i < SIM_PLANES; i++)
        r->ids[r->res.count_planes++] = sim_plane_id(card, i);
    return &r->res;
}

static drmModePlanePtr plane(int fd, uint32_t id) {
    static const uint32_t formats[] = {DRM_FORMAT_RGB565, DRM_FORMAT_XRGB8888};
    struct sim_file *f = sim_enter(SIM_ModeGetPlane, fd);
    if (!f) return NULL;
    const struct sim_card *card = sim_card_of(f);
    const int i = find(id, sim_plane_id(card, 0), SIM_PLANES);
    if (i < 0) return NULL;
    drmModePlane *p = sim_reply(sizeof *p);
    p->plane_id = id;
    p->possible_crtcs = 1u << i % SIM_CRTCS;
    p->crtc_id = crtc_or_0(card, card->state.planes[i].crtc);
    p->fb_id = card->state.planes[i].fb;
    p->count_formats = 2;
    p->formats = (uint32_t *)formats;
    return p;
}

/* ---- the card ---- */

static drmVersionPtr version(int fd) {
    struct sim_file *f = sim_enter(SIM_GetVersion, fd);
    static char name[] = "simulated";
    if (!f) return NULL;
    drmVersion *v = sim_reply(sizeof *v);
    v->name = name;
    v->name_len = sizeof name - 1;
    return v;
}

static int cap(int fd, uint64_t which, uint64_t *out) {
    struct sim_file *f = sim_enter(SIM_GetCap, fd);
    if (!f) return -1;
    *out = which != DRM_CAP_ADDFB2_MODIFIERS || sim_card_of(f)->traits.modifiers;
    return 0;
}

static int client_cap(int fd, uint64_t which, uint64_t value) {
    struct sim_file *f = sim_enter(SIM_SetClientCap, fd);
    if (!f) return -1;
    errno = EOPNOTSUPP;
    if (which == DRM_CLIENT_CAP_ATOMIC && sim_card_of(f)->traits.legacy) return -1;
    if (which == DRM_CLIENT_CAP_ATOMIC) f->atomic = f->universal = value;
    if (which == DRM_CLIENT_CAP_UNIVERSAL_PLANES) f->universal = value;
    return 0;
}

static int list(struct gn_kms_node *out, int most) {
    int count = 0;
    if (sim_fails(SIM_list)) return 0;
    for (int n = 0; n < SIM_CARDS && count < most; n++) {
        const struct sim_card *card = &sim.cards[n];
        if (!card->present) continue;
        snprintf(out[count].path, sizeof out[count].path, "%s", card->path);
        snprintf(out[count].place, sizeof out[count].place, "%s", card->place);
        count++;
    }
    return count;
}

static int is_master(int fd) {
    struct sim_file *f = sim_enter(SIM_IsMaster, fd);
    return f && sim_card_of(f)->master == sim_index_of(f);
}

static int set_master(int fd) {
    struct sim_file *f = sim_enter(SIM_SetMaster, fd);
    if (!f) return -1;
    struct sim_card *card = sim_card_of(f);
    const int i = sim_index_of(f);
    errno = f->was_master ? EBUSY : EACCES;
    if (card->master != SIM_NOBODY && card->master != i) return -1;
    card->master = i;
    f->was_master = true;
    return 0;
}

static int drop_master(int fd) {
    struct sim_file *f = sim_enter(SIM_DropMaster, fd);
    if (!f) return -1;
    struct sim_card *card = sim_card_of(f);
    errno = EINVAL;
    if (card->master != sim_index_of(f)) return -1;
    card->master = SIM_NOBODY;
    return 0;
}

/* ---- the table ---- */

#define FREES(function, type)                                                                      \
    static void function(type reply) { sim_reply_free(reply); }
FREES(free_version, drmVersionPtr)
FREES(free_resources, drmModeResPtr)
FREES(free_connector, drmModeConnectorPtr)
FREES(free_encoder, drmModeEncoderPtr)
FREES(free_crtc, drmModeCrtcPtr)
FREES(free_planes, drmModePlaneResPtr)
FREES(free_plane, drmModePlanePtr)
FREES(free_props, drmModeObjectPropertiesPtr)
FREES(free_property, drmModePropertyPtr)
FREES(free_blob, drmModePropertyBlobPtr)

void sim_fill_read(struct gn_drm_ops *ops) {
    ops->GetVersion = version;
    ops->FreeVersion = free_version;
    ops->GetCap = cap;
    ops->SetClientCap = client_cap;
    ops->IsMaster = is_master;
    ops->SetMaster = set_master;
    ops->DropMaster = drop_master;
    ops->ModeGetResources = resources;
    ops->ModeFreeResources = free_resources;
    ops->ModeGetConnector = connector_probed;
    ops->ModeGetConnectorCurrent = connector_known;
    ops->ModeFreeConnector = free_connector;
    ops->ModeGetEncoder = encoder;
    ops->ModeFreeEncoder = free_encoder;
    ops->ModeGetCrtc = crtc;
    ops->ModeFreeCrtc = free_crtc;
    ops->ModeGetPlaneResources = planes;
    ops->ModeFreePlaneResources = free_planes;
    ops->ModeGetPlane = plane;
    ops->ModeFreePlane = free_plane;
    ops->ModeObjectGetProperties = object_props;
    ops->ModeFreeObjectProperties = free_props;
    ops->ModeGetProperty = property;
    ops->ModeFreeProperty = free_property;
    ops->ModeGetPropertyBlob = property_blob;
    ops->ModeFreePropertyBlob = free_blob;
    ops->list = list;
}
