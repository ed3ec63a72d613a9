/* Object properties by name. Ids differ between cards and are constant while the card is open. */
#include <string.h>

#include "display/kms/output.h"

const char *const gn_kms_connector_props[GN_PROP_CONNECTOR_COUNT] = {
    [GN_PROP_CONNECTOR_CRTC] = "CRTC_ID",
    [GN_PROP_CONNECTOR_LINK] = "link-status",
    [GN_PROP_CONNECTOR_DPMS] = "DPMS",
    [GN_PROP_CONNECTOR_RANGE] = "Broadcast RGB",
};
const char *const gn_kms_crtc_props[GN_PROP_CRTC_COUNT] = {
    [GN_PROP_CRTC_ACTIVE] = "ACTIVE",
    [GN_PROP_CRTC_MODE] = "MODE_ID",
};
const char *const gn_kms_plane_props[GN_PROP_PLANE_COUNT] = {
    [GN_PROP_PLANE_TYPE] = "type",         [GN_PROP_PLANE_FB] = "FB_ID",
    [GN_PROP_PLANE_CRTC] = "CRTC_ID",      [GN_PROP_PLANE_SRC_X] = "SRC_X",
    [GN_PROP_PLANE_SRC_Y] = "SRC_Y",       [GN_PROP_PLANE_SRC_W] = "SRC_W",
    [GN_PROP_PLANE_SRC_H] = "SRC_H",       [GN_PROP_PLANE_X] = "CRTC_X",
    [GN_PROP_PLANE_Y] = "CRTC_Y",          [GN_PROP_PLANE_W] = "CRTC_W",
    [GN_PROP_PLANE_H] = "CRTC_H",          [GN_PROP_PLANE_FENCE] = "IN_FENCE_FD",
    [GN_PROP_PLANE_ROTATION] = "rotation", [GN_PROP_PLANE_FORMATS] = "IN_FORMATS",
};

bool gn_kms_prop_value(const struct gn_drm_ops *drm, int fd, uint32_t prop, const char *start,
                       uint64_t *out) {
    drmModePropertyRes *p = prop ? drm->ModeGetProperty(fd, prop) : NULL;
    bool found = false;
    for (int i = 0; p && i < p->count_enums && !found; i++) {
        found = strncmp(p->enums[i].name, start, strlen(start)) == 0;
        if (found) *out = p->enums[i].value;
    }
    if (p) drm->ModeFreeProperty(p);
    return found;
}

bool gn_kms_props_read(const struct gn_drm_ops *drm, int fd, uint32_t object, uint32_t type,
                       const char *const *names, int count, uint32_t *ids, uint64_t *values) {
    memset(ids, 0, (size_t)count * sizeof *ids);
    if (values) memset(values, 0, (size_t)count * sizeof *values);
    drmModeObjectProperties *all = drm->ModeObjectGetProperties(fd, object, type);
    bool complete = all;
    for (uint32_t i = 0; all && i < all->count_props; i++) {
        drmModePropertyRes *p = drm->ModeGetProperty(fd, all->props[i]);
        complete &= p != NULL;
        for (int k = 0; p && k < count; k++) {
            if (strcmp(p->name, names[k]) != 0) continue;
            ids[k] = p->prop_id;
            if (values) values[k] = all->prop_values[i];
        }
        if (p) drm->ModeFreeProperty(p);
    }
    if (all) drm->ModeFreeObjectProperties(all);
    return complete;
}
