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
};

/* ---- connectors ---- */

static void read_properties(struct reader *r, const drmModeConnector *from,
                            struct gn_kms_connector *out) {
    for (int i = 0; i < from->count_props; i++) {
        const uint64_t value = from->prop_values[i];
        drmModePropertyRes *p = r->drm->ModeGetProperty(r->fd, from->props[i]);
        r->card->partial |= !p;
        if (!p) continue;
        if (strcmp(p->name, "link-status") == 0) out->bad_link = value != 0;
        if (strcmp(p->name, "non-desktop") == 0 && value != 0)
            out->connected = out->unknown = false;
        for (int k = 0; k < p->count_enums; k++) {
            const char *way = p->enums[k].name;
            if (strcmp(p->name, "panel orientation") != 0 || p->enums[k].value != value) continue;
            out->orientation_deg = strcmp(way, "Upside Down") == 0     ? 180 /* compensates it */
                                   : strcmp(way, "Left Side Up") == 0  ? 270
                                   : strcmp(way, "Right Side Up") == 0 ? 90
                                                                       : 0;
        }
        if (strcmp(p->name, "EDID") == 0 && (uint32_t)value != 0) { /* has the serial number */
            drmModePropertyBlobRes *blob = r->drm->ModeGetPropertyBlob(r->fd, (uint32_t)value);
            r->card->partial |= !blob;
            if (blob) out->monitor = gn_hash(GN_HASH_INIT, blob->data, blob->length);
            if (blob) r->drm->ModeFreePropertyBlob(blob);
        }
        r->drm->ModeFreeProperty(p);
    }
}

static void read_connector(struct reader *r, const drmModeConnector *from) {
    struct gn_kms_connector *out = &r->card->connectors[r->card->connector_count++];
    const uint32_t type = from->connector_type, row = type < TYPES ? type : 0;
    out->id = from->connector_id;
    out->crtc = -1;
    out->connected = from->connection == DRM_MODE_CONNECTED;
    out->unknown = from->connection == DRM_MODE_UNKNOWNCONNECTION;
    out->internal = type == DRM_MODE_CONNECTOR_LVDS || type == DRM_MODE_CONNECTOR_eDP ||
                    type == DRM_MODE_CONNECTOR_DSI || type == DRM_MODE_CONNECTOR_DPI;
    snprintf(out->name, sizeof out->name, "%s-%u", type_names[row], from->connector_type_id);
    for (int i = 0; i < from->count_modes && i < GN_KMS_MODES_MAX; i++)
        out->modes[out->mode_count++] = from->modes[i];
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
    read_properties(r, from, out);
    if (out->monitor != 0 || out->mode_count == 0) return;

    /* a monitor without EDID is identified by its modes, and by which of them is preferred */
    out->monitor = GN_HASH_INIT;
    for (int i = 0; i < out->mode_count; i++) {
        const drmModeModeInfo *m = &out->modes[i];
        const uint32_t fields[] = {m->clock,
                                   m->hdisplay,
                                   m->htotal,
                                   m->vtotal,
                                   m->vdisplay,
                                   m->flags,
                                   m->type & DRM_MODE_TYPE_PREFERRED};
        out->monitor = gn_hash(out->monitor, fields, sizeof fields);
    }
}

bool gn_kms_card_read(const struct gn_drm_ops *drm, int fd, bool probe, struct gn_kms_card *out,
                      struct gn_err *err) {
    memset(out, 0, sizeof *out);
    struct reader r = {drm, fd, out};
    drmModeRes *resources = drm->ModeGetResources(fd);
    if (!resources) {
        const int error = errno;
        gn_fail(err, "no modesetting on this node: %s", strerror(error));
        errno = error;
        return false;
    }
    drmVersion *version = drm->GetVersion(fd);
    snprintf(out->driver, sizeof out->driver, "%s", version ? version->name : "unknown");
    if (version) drm->FreeVersion(version);
    for (int i = 0; i < resources->count_crtcs && i < GN_KMS_CRTCS_MAX; i++) {
        struct gn_kms_crtc *to = &out->crtcs[out->crtc_count++];
        to->id = resources->crtcs[i];
        drmModeCrtc *crtc = drm->ModeGetCrtc(fd, to->id);
        out->partial |= !crtc;
        if (!crtc) continue;
        to->lit = crtc->mode_valid;
        to->mode = crtc->mode;
        drm->ModeFreeCrtc(crtc);
    }
    const int count = resources->count_connectors;
    for (int i = 0; i < count && out->connector_count < GN_KMS_CONNECTORS_MAX; i++) {
        const uint32_t id = resources->connectors[i];
        drmModeConnector *c =
            probe ? drm->ModeGetConnector(fd, id) : drm->ModeGetConnectorCurrent(fd, id);
        out->partial |= !c; /* it disappeared during the scan, as DisplayPort MST branches do */
        if (!c) continue;
        if (c->connector_type != DRM_MODE_CONNECTOR_WRITEBACK) read_connector(&r, c);
        drm->ModeFreeConnector(c);
    }
    const bool can = out->crtc_count > 0 && (out->connector_count > 0 || out->partial);
    drm->ModeFreeResources(resources);
    if (!can) gn_fail(err, "it has no connectors or CRTCs");
    errno = ENOTSUP;
    return can;
}
