/* Reads a snapshot of a card from the kernel. */
#include "display/kms/card.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "core/hash.h"

/* names by connector type, as the kernel has them */
static const char *const type_names[] = {
    "Unknown", "VGA",       "DVI-I", "DVI-D", "DVI-A",     "Composite", "SVIDEO",
    "LVDS",    "Component", "DIN",   "DP",    "HDMI-A",    "HDMI-B",    "TV",
    "eDP",     "Virtual",   "DSI",   "DPI",   "Writeback", "SPI",       "USB",
};
enum { TYPES = sizeof type_names / sizeof *type_names };

struct reader {
    const struct gn_drm_ops *drm;
    int fd;
    struct gn_kms_card *card;
    const drmModeRes *resources;
};

static void read_crtcs(struct reader *r) {
    for (int i = 0; i < r->resources->count_crtcs && i < GN_KMS_CRTCS_MAX; i++) {
        struct gn_kms_crtc *out = &r->card->crtcs[r->card->crtc_count++];
        out->id = r->resources->crtcs[i];
        drmModeCrtc *crtc = r->drm->ModeGetCrtc(r->fd, out->id);
        r->card->partial |= !crtc;
        if (!crtc) continue;
        out->lit = crtc->mode_valid;
        out->mode = crtc->mode;
        r->drm->ModeFreeCrtc(crtc);
    }
}

/* ---- connectors ---- */

static void read_encoders(struct reader *r, const drmModeConnector *from,
                          struct gn_kms_connector *out) {
    for (int i = 0; i < from->count_encoders; i++) {
        drmModeEncoder *e = r->drm->ModeGetEncoder(r->fd, from->encoders[i]);
        r->card->partial |= !e;
        if (!e) continue;
        out->crtcs |= e->possible_crtcs;
        for (int k = 0; k < r->card->crtc_count; k++)
            if (e->encoder_id == from->encoder_id && r->card->crtcs[k].lit &&
                r->card->crtcs[k].id == e->crtc_id)
                out->crtc = k;
        r->drm->ModeFreeEncoder(e);
    }
    out->crtcs &= (1u << r->card->crtc_count) - 1;
}

/* Rotation that compensates the "panel orientation" property. */
static unsigned degrees_of(const char *orientation) {
    if (strcmp(orientation, "Upside Down") == 0) return 180;
    if (strcmp(orientation, "Left Side Up") == 0) return 270;
    return strcmp(orientation, "Right Side Up") == 0 ? 90 : 0;
}

static void read_property(const drmModePropertyRes *p, uint64_t value,
                          struct gn_kms_connector *out) {
    if (strcmp(p->name, "link-status") == 0) out->bad_link = value != 0;
    if (strcmp(p->name, "non-desktop") == 0 && value != 0) out->connected = out->unknown = false;
    if (strcmp(p->name, "panel orientation") != 0) return;
    for (int i = 0; i < p->count_enums; i++)
        if (p->enums[i].value == value) out->orientation_deg = degrees_of(p->enums[i].name);
}

/* Identifies the monitor by its EDID, which has the serial number. */
static void read_edid(struct reader *r, uint32_t id, struct gn_kms_connector *out) {
    drmModePropertyBlobRes *blob = id ? r->drm->ModeGetPropertyBlob(r->fd, id) : NULL;
    r->card->partial |= id && !blob;
    if (!blob) return;
    out->monitor = gn_hash(GN_HASH_INIT, blob->data, blob->length);
    r->drm->ModeFreePropertyBlob(blob);
}

static void read_properties(struct reader *r, const drmModeConnector *from,
                            struct gn_kms_connector *out) {
    for (int i = 0; i < from->count_props; i++) {
        drmModePropertyRes *p = r->drm->ModeGetProperty(r->fd, from->props[i]);
        r->card->partial |= !p;
        if (!p) continue;
        read_property(p, from->prop_values[i], out);
        if (strcmp(p->name, "EDID") == 0) read_edid(r, (uint32_t)from->prop_values[i], out);
        r->drm->ModeFreeProperty(p);
    }
}

/* Identifies monitors without EDID; includes the preferred flag. */
static uint64_t hash_modes(const struct gn_kms_connector *c) {
    uint64_t hash = GN_HASH_INIT;
    for (int i = 0; i < c->mode_count; i++) {
        const drmModeModeInfo *m = &c->modes[i];
        const uint32_t told[] = {m->clock,
                                 m->hdisplay,
                                 m->htotal,
                                 m->vtotal,
                                 m->vdisplay,
                                 m->flags,
                                 m->type & DRM_MODE_TYPE_PREFERRED};
        hash = gn_hash(hash, told, sizeof told);
    }
    return hash;
}

static bool is_internal(uint32_t type) {
    return type == DRM_MODE_CONNECTOR_LVDS || type == DRM_MODE_CONNECTOR_eDP ||
           type == DRM_MODE_CONNECTOR_DSI || type == DRM_MODE_CONNECTOR_DPI;
}

static void read_connector(struct reader *r, const drmModeConnector *from) {
    struct gn_kms_connector *out = &r->card->connectors[r->card->connector_count++];
    const uint32_t type = from->connector_type < TYPES ? from->connector_type : 0;
    out->id = from->connector_id;
    out->crtc = -1;
    out->connected = from->connection == DRM_MODE_CONNECTED;
    out->unknown = from->connection == DRM_MODE_UNKNOWNCONNECTION;
    out->internal = is_internal(from->connector_type);
    snprintf(out->name, sizeof out->name, "%s-%u", type_names[type], from->connector_type_id);
    for (int i = 0; i < from->count_modes && i < GN_KMS_MODES_MAX; i++)
        out->modes[out->mode_count++] = from->modes[i];
    read_encoders(r, from, out);
    read_properties(r, from, out);
    if (out->monitor == 0 && out->mode_count > 0) out->monitor = hash_modes(out);
}

static void read_connectors(struct reader *r, bool probe) {
    const int count = r->resources->count_connectors;
    for (int i = 0; i < count && r->card->connector_count < GN_KMS_CONNECTORS_MAX; i++) {
        const uint32_t id = r->resources->connectors[i];
        drmModeConnector *c = probe ? r->drm->ModeGetConnector(r->fd, id)
                                    : r->drm->ModeGetConnectorCurrent(r->fd, id);
        r->card->partial |= !c; /* it disappeared during the scan, as DisplayPort MST branches do */
        if (!c) continue;
        if (c->connector_type != DRM_MODE_CONNECTOR_WRITEBACK) read_connector(r, c);
        r->drm->ModeFreeConnector(c);
    }
}

static void read_driver(struct reader *r) {
    drmVersion *version = r->drm->GetVersion(r->fd);
    snprintf(r->card->driver, sizeof r->card->driver, "%s", version ? version->name : "unknown");
    if (version) r->drm->FreeVersion(version);
}

bool gn_kms_card_read(const struct gn_drm_ops *drm, int fd, bool probe, struct gn_kms_card *out,
                      struct gn_err *err) {
    memset(out, 0, sizeof *out);
    struct reader r = {drm, fd, out, NULL};
    drmModeRes *resources = drm->ModeGetResources(fd);
    if (!resources) {
        const int error = errno;
        gn_fail(err, "no modesetting on this node: %s", strerror(error));
        errno = error;
        return false;
    }
    r.resources = resources;
    read_driver(&r);
    read_crtcs(&r);
    read_connectors(&r, probe);
    const bool can = out->crtc_count > 0 && (out->connector_count > 0 || out->partial);
    drm->ModeFreeResources(resources);
    if (!can) gn_fail(err, "it has no connectors or CRTCs");
    errno = ENOTSUP;
    return can;
}
