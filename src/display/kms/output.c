#include "display/kms/output.h"

#include <drm_fourcc.h>
#include <errno.h>
#include <string.h>

/* libdrm returns -errno, or -1 with errno set. */
static int error_of(int result) {
    if (result == 0) return 0;
    if (result != -1) return result < 0 ? -result : result;
    return errno ? errno : EIO;
}

/* ---- opening ---- */

struct plane_values {
    uint32_t ids[GN_PROP_PLANE_COUNT];
    uint64_t values[GN_PROP_PLANE_COUNT];
};

/* Rates a plane as primary for this CRTC: 0 unusable, 3 active on it now, -1 unknown. */
static int rate_plane(const struct gn_kms_output *o, uint32_t id, struct plane_values *v) {
    drmModePlane *plane = o->drm->ModeGetPlane(o->fd, id);
    if (!plane) return -1;
    const bool possible = plane->possible_crtcs >> o->crtc_index & 1;
    const uint32_t now = plane->crtc_id;
    o->drm->ModeFreePlane(plane);
    if (!possible) return 0;
    if (!gn_kms_props_read(o->drm, o->fd, id, DRM_MODE_OBJECT_PLANE, gn_kms_plane_props,
                           GN_PROP_PLANE_COUNT, v->ids, v->values))
        return -1;
    if (v->values[GN_PROP_PLANE_TYPE] != DRM_PLANE_TYPE_PRIMARY) return 0;
    if (now == o->crtc) return 3;
    return now == 0 ? 2 : 1;
}

static bool has_all(const uint32_t *ids, int first, int last) {
    for (int i = first; i <= last; i++)
        if (ids[i] == 0) return false;
    return true;
}

/* Finds the primary plane and the properties that every atomic driver has. Fails if one is missing
 * or could not be read. */
static bool find_objects(struct gn_kms_output *o) {
    drmModePlaneRes *all = o->drm->ModeGetPlaneResources(o->fd);
    int best = 0;
    for (uint32_t i = 0; all && i < all->count_planes && best >= 0; i++) {
        struct plane_values v;
        const int rate = rate_plane(o, all->planes[i], &v);
        if (rate < 0) best = rate;
        if (rate <= best) continue;
        best = rate;
        o->plane = all->planes[i];
        memcpy(o->plane_props, v.ids, sizeof v.ids);
    }
    if (all) o->drm->ModeFreePlaneResources(all);
    return best > 0 &&
           gn_kms_props_read(o->drm, o->fd, o->connector, DRM_MODE_OBJECT_CONNECTOR,
                             gn_kms_connector_props, GN_PROP_CONNECTOR_COUNT, o->connector_props,
                             NULL) &&
           gn_kms_props_read(o->drm, o->fd, o->crtc, DRM_MODE_OBJECT_CRTC, gn_kms_crtc_props,
                             GN_PROP_CRTC_COUNT, o->crtc_props, NULL) &&
           o->connector_props[GN_PROP_CONNECTOR_CRTC] &&
           has_all(o->crtc_props, 0, GN_PROP_CRTC_COUNT - 1) &&
           has_all(o->plane_props, GN_PROP_PLANE_FB, GN_PROP_PLANE_H);
}

static bool set_caps(const struct gn_kms_output *o, uint64_t on) {
    const bool planes = o->drm->SetClientCap(o->fd, DRM_CLIENT_CAP_UNIVERSAL_PLANES, on) == 0;
    return o->drm->SetClientCap(o->fd, DRM_CLIENT_CAP_ATOMIC, on) == 0 && planes;
}

bool gn_kms_output_open(struct gn_kms_output *o, const struct gn_drm_ops *drm, int fd, bool legacy,
                        const struct gn_kms_card *card, int connector, int crtc,
                        struct gn_err *err) {
    const char *name = card->connectors[connector].name;
    if (crtc < 0) return gn_fail(err, "%s: no usable CRTC or plane", name);
    *o = (struct gn_kms_output){.drm = drm,
                                .fd = fd,
                                .connector = card->connectors[connector].id,
                                .crtc = card->crtcs[crtc].id,
                                .crtc_index = crtc};
    drmModeCrtc *old = drm->ModeGetCrtc(fd, o->crtc);
    if (old) {
        o->was_lit = old->mode_valid && old->buffer_id;
        o->old_fb = old->buffer_id;
        o->old_x = old->x;
        o->old_y = old->y;
        o->old_mode = old->mode;
        drm->ModeFreeCrtc(old);
    }
    o->atomic = !legacy && set_caps(o, 1);
    if (!o->atomic) set_caps(o, 0); /* the legacy interface has everything except fences */
    if (!o->atomic) o->dpms = GN_MAY_SLEEP;
    if (!o->atomic || find_objects(o)) return true;
    *o = (struct gn_kms_output){0};
    return gn_fail(err, "%s: its properties cannot be read", name);
}

/* ---- formats and modifiers ---- */

static const uint32_t formats[] = {DRM_FORMAT_XRGB8888, DRM_FORMAT_ARGB8888, DRM_FORMAT_XBGR8888,
                                   DRM_FORMAT_RGB565};
enum { FORMATS = sizeof formats / sizeof *formats };

/* Modifiers of one format: each entry of the blob's second table has a 64-bit mask, offset into the
 * format table. */
static void read_modifiers(const drmModePropertyBlobRes *blob, struct gn_surface_opts *out) {
    const struct drm_format_modifier_blob *head = blob->data;
    if (blob->length < sizeof *head) return;
    const uint64_t formats_end = head->formats_offset + 4ull * head->count_formats,
                   end = head->modifiers_offset +
                         (uint64_t)sizeof(struct drm_format_modifier) * head->count_modifiers;
    if (formats_end > blob->length || end > blob->length) return;
    const char *bytes = blob->data;
    uint32_t at = 0, format;
    for (; at < head->count_formats; at++) {
        memcpy(&format, bytes + head->formats_offset + 4ull * at, sizeof format);
        if (format == out->formats[0]) break;
    }
    for (uint32_t i = 0; i < head->count_modifiers; i++) {
        struct drm_format_modifier m;
        memcpy(&m, bytes + head->modifiers_offset + i * sizeof m, sizeof m);
        if (at < m.offset || at >= m.offset + 64 || !(m.formats >> (at - m.offset) & 1)) continue;
        if (out->modifier_count < GN_MODIFIERS_MAX)
            out->modifiers[out->modifier_count++] = m.modifier;
    }
}

void gn_kms_output_formats(const struct gn_kms_output *o, struct gn_surface_opts *out) {
    out->format_count = out->modifier_count = 0;
    drmModePlane *plane = o->plane ? o->drm->ModeGetPlane(o->fd, o->plane) : NULL;
    for (int i = 0; plane && i < FORMATS; i++)
        for (uint32_t k = 0; k < plane->count_formats; k++)
            if (plane->formats[k] == formats[i]) {
                out->formats[out->format_count++] = formats[i];
                break;
            }
    if (plane) o->drm->ModeFreePlane(plane);
    if (out->format_count == 0) { /* the legacy interface lists neither formats nor modifiers */
        memcpy(out->formats, formats, sizeof formats);
        out->format_count = FORMATS;
    }
    uint64_t can = 0, values[GN_PROP_PLANE_COUNT];
    uint32_t ids[GN_PROP_PLANE_COUNT];
    if (!o->plane || o->drm->GetCap(o->fd, DRM_CAP_ADDFB2_MODIFIERS, &can) != 0 || !can) return;
    gn_kms_props_read(o->drm, o->fd, o->plane, DRM_MODE_OBJECT_PLANE, gn_kms_plane_props,
                      GN_PROP_PLANE_COUNT, ids, values);
    const uint32_t id = (uint32_t)values[GN_PROP_PLANE_FORMATS];
    drmModePropertyBlobRes *blob = id ? o->drm->ModeGetPropertyBlob(o->fd, id) : NULL;
    if (!blob) return;
    read_modifiers(blob, out);
    o->drm->ModeFreePropertyBlob(blob);
}

bool gn_kms_output_takes_fence(const struct gn_kms_output *o) {
    return o->atomic && o->plane_props[GN_PROP_PLANE_FENCE];
}

/* ---- framebuffers ---- */

static void remove_old_fbs(struct gn_kms_output *o, uint32_t shown) {
    for (int i = 0; i < GN_KMS_FBS_MAX; i++) {
        if (!o->fbs[i].id || o->fbs[i].key || o->fbs[i].id == shown) continue;
        o->drm->ModeRmFB(o->fd, o->fbs[i].id);
        o->fbs[i].id = 0;
    }
}

static int add_fb(struct gn_kms_output *o, const struct gn_buffer *b, uint32_t *out) {
    uint64_t modifiers[4] = {0};
    for (int i = 0; i < b->plane_count && i < 4; i++) modifiers[i] = b->modifier;
    if (b->modifier != DRM_FORMAT_MOD_INVALID) {
        const int result = o->drm->ModeAddFB2WithModifiers(
            o->fd, b->width_px, b->height_px, b->format, b->handles, b->strides, b->offsets,
            modifiers, out, DRM_MODE_FB_MODIFIERS);
        /* without AddFB2 modifiers LINEAR is implied */
        if (result == 0 || b->modifier != DRM_FORMAT_MOD_LINEAR) return error_of(result);
    }
    return error_of(o->drm->ModeAddFB2(o->fd, b->width_px, b->height_px, b->format, b->handles,
                                       b->strides, b->offsets, out, 0));
}

static struct gn_kms_fb *free_place(struct gn_kms_output *o) {
    for (int i = 0; i < GN_KMS_FBS_MAX; i++)
        if (!o->fbs[i].id) return &o->fbs[i];
    return NULL;
}

int gn_kms_output_fb(struct gn_kms_output *o, const struct gn_buffer *b, uint32_t *out) {
    for (int i = 0; i < GN_KMS_FBS_MAX; i++) {
        *out = o->fbs[i].id;
        if (o->fbs[i].id && o->fbs[i].key == b->key) return 0;
    }
    struct gn_kms_fb *place = free_place(o);
    if (!place) { /* framebuffers of many surfaces, none of which could be lit */
        remove_old_fbs(o, 0);
        place = free_place(o);
    }
    if (!place) return ENOMEM; /* more buffers than any surface has */
    int error = add_fb(o, b, out);
    if (error == ENOMEM) { /* drop unused ones and retry */
        remove_old_fbs(o, 0);
        error = add_fb(o, b, out);
    }
    if (error == 0) *place = (struct gn_kms_fb){b->key, *out};
    return error;
}

void gn_kms_output_orphan_fbs(struct gn_kms_output *o) {
    for (int i = 0; i < GN_KMS_FBS_MAX; i++) o->fbs[i].key = NULL;
}

/* ---- commits ---- */

struct request { /* the first error is kept */
    drmModeAtomicReq *list;
    const struct gn_kms_output *o;
    bool bad;
};

static void add_property(struct request *r, uint32_t object, uint32_t property, uint64_t value) {
    if (property == 0) return; /* optional property */
    if (r->o->drm->ModeAtomicAddProperty(r->list, object, property, value) < 0) r->bad = true;
}

static int commit_request(struct request *r, uint32_t flags, void *user) {
    const struct gn_kms_output *o = r->o;
    if (r->bad) return ENOMEM;
    return error_of(o->drm->ModeAtomicCommit(o->fd, r->list, flags, user));
}

/* Commits and frees it. */
static int end_request(struct request *r, uint32_t flags, void *user) {
    const int error = commit_request(r, flags, user);
    r->o->drm->ModeAtomicFree(r->list);
    return error;
}

/* Another program may have left a cursor, an overlay or a second connector on the CRTC. Unreadable
 * planes may be active on it: fail for now. */
static void disable_others(struct request *r) {
    const struct gn_kms_output *o = r->o;
    drmModePlaneRes *planes = o->drm->ModeGetPlaneResources(o->fd);
    if (!planes) r->bad = true;
    for (uint32_t i = 0; planes && i < planes->count_planes; i++) {
        uint32_t ids[GN_PROP_PLANE_COUNT];
        drmModePlane *p = o->drm->ModeGetPlane(o->fd, planes->planes[i]);
        if (!p) r->bad = true;
        if (p && p->crtc_id == o->crtc && p->plane_id != o->plane) {
            if (!gn_kms_props_read(o->drm, o->fd, p->plane_id, DRM_MODE_OBJECT_PLANE,
                                   gn_kms_plane_props, GN_PROP_PLANE_COUNT, ids, NULL))
                r->bad = true;
            add_property(r, p->plane_id, ids[GN_PROP_PLANE_FB], 0);
            add_property(r, p->plane_id, ids[GN_PROP_PLANE_CRTC], 0);
        }
        if (p) o->drm->ModeFreePlane(p);
    }
    if (planes) o->drm->ModeFreePlaneResources(planes);
}

static void disable_connectors(struct request *r, bool ours) {
    const struct gn_kms_output *o = r->o;
    drmModeRes *all = o->drm->ModeGetResources(o->fd);
    if (!all) r->bad = true;
    for (int i = 0; all && i < all->count_connectors; i++) {
        uint32_t ids[GN_PROP_CONNECTOR_COUNT];
        uint64_t values[GN_PROP_CONNECTOR_COUNT];
        if (!ours && all->connectors[i] == o->connector) continue;
        if (!gn_kms_props_read(o->drm, o->fd, all->connectors[i], DRM_MODE_OBJECT_CONNECTOR,
                               gn_kms_connector_props, GN_PROP_CONNECTOR_COUNT, ids, values))
            r->bad = true;
        if (values[GN_PROP_CONNECTOR_CRTC] == o->crtc)
            add_property(r, all->connectors[i], ids[GN_PROP_CONNECTOR_CRTC], 0);
    }
    if (all) o->drm->ModeFreeResources(all);
}

/* GL has row 0 at the bottom: a lower left part ends with the framebuffer's last row. */
static void add_picture(struct request *r, const drmModeModeInfo *mode,
                        const struct gn_kms_flip *flip) {
    const uint32_t *p = r->o->plane_props, plane = r->o->plane;
    const uint64_t width = flip->part.width_px ? flip->part.width_px : mode->hdisplay,
                   height = flip->part.height_px ? flip->part.height_px : mode->vdisplay;
    add_property(r, plane, p[GN_PROP_PLANE_FB], flip->fb);
    add_property(r, plane, p[GN_PROP_PLANE_SRC_X], 0);
    add_property(r, plane, p[GN_PROP_PLANE_SRC_Y], (mode->vdisplay - height) << 16);
    add_property(r, plane, p[GN_PROP_PLANE_SRC_W], width << 16);
    add_property(r, plane, p[GN_PROP_PLANE_SRC_H], height << 16);
}

static int commit_light(struct gn_kms_output *o, const drmModeModeInfo *mode,
                        const struct gn_kms_flip *flip, uint32_t blob) {
    struct request r = {.list = o->drm->ModeAtomicAlloc(), .o = o};
    if (!r.list) return ENOMEM;
    disable_others(&r);
    disable_connectors(&r, false);
    add_property(&r, o->connector, o->connector_props[GN_PROP_CONNECTOR_CRTC], o->crtc);
    add_property(&r, o->connector, o->connector_props[GN_PROP_CONNECTOR_LINK],
                 DRM_MODE_LINK_STATUS_GOOD);
    if (o->range.is_set)
        add_property(&r, o->connector, o->connector_props[GN_PROP_CONNECTOR_RANGE], o->range.value);
    add_property(&r, o->crtc, o->crtc_props[GN_PROP_CRTC_MODE], blob);
    add_property(&r, o->crtc, o->crtc_props[GN_PROP_CRTC_ACTIVE], 1);
    const uint32_t *p = o->plane_props;
    add_picture(&r, mode, flip);
    add_property(&r, o->plane, p[GN_PROP_PLANE_CRTC], o->crtc);
    add_property(&r, o->plane, p[GN_PROP_PLANE_X], 0);
    add_property(&r, o->plane, p[GN_PROP_PLANE_Y], 0);
    add_property(&r, o->plane, p[GN_PROP_PLANE_W], mode->hdisplay);
    add_property(&r, o->plane, p[GN_PROP_PLANE_H], mode->vdisplay);
    add_property(&r, o->plane, p[GN_PROP_PLANE_ROTATION], DRM_MODE_ROTATE_0);
    int error = commit_request(&r, DRM_MODE_ATOMIC_TEST_ONLY | DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
    if (error == 0) error = commit_request(&r, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
    o->drm->ModeAtomicFree(r.list);
    return error;
}

/* ---- DPMS ---- */

/* Legacy DPMS property of the connector. Returns 0 if it has none. */
static int set_dpms(struct gn_kms_output *o, uint64_t value) {
    uint32_t *ids = o->connector_props;
    if (!ids[GN_PROP_CONNECTOR_DPMS])
        gn_kms_props_read(o->drm, o->fd, o->connector, DRM_MODE_OBJECT_CONNECTOR,
                          gn_kms_connector_props, GN_PROP_CONNECTOR_COUNT, ids, NULL);
    if (!ids[GN_PROP_CONNECTOR_DPMS]) return EOPNOTSUPP;
    return error_of(
        o->drm->ModeConnectorSetProperty(o->fd, o->connector, ids[GN_PROP_CONNECTOR_DPMS], value));
}

int gn_kms_output_sleep(struct gn_kms_output *o) {
    if (!o->atomic) {
        const int error = set_dpms(o, DRM_MODE_DPMS_OFF);
        if (error == EOPNOTSUPP || error == EINVAL) return gn_kms_output_dark(o);
        if (error == 0) o->dpms = GN_ASLEEP;
        return error;
    }
    struct request r = {.list = o->drm->ModeAtomicAlloc(), .o = o};
    if (!r.list) return ENOMEM;
    add_property(&r, o->crtc, o->crtc_props[GN_PROP_CRTC_ACTIVE], 0);
    return end_request(&r, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
}

/* Setting the same mode again does not wake the monitor, and another program may have put it to
 * sleep. */
static int wake_connector(struct gn_kms_output *o) {
    const int error = o->dpms != GN_AWAKE ? set_dpms(o, DRM_MODE_DPMS_ON) : 0;
    const bool cannot = error == EOPNOTSUPP || (error == EINVAL && o->dpms == GN_MAY_SLEEP);
    if (error != 0 && !cannot) return error;
    o->dpms = GN_AWAKE;
    return 0;
}

/* ---- range of levels ---- */

void gn_kms_output_set_range(struct gn_kms_output *o, enum gn_screen_range range) {
    static const char *const names[] = {"Automatic", "Full", "Limited"};
    uint32_t ids[GN_PROP_CONNECTOR_COUNT];
    uint64_t values[GN_PROP_CONNECTOR_COUNT];
    struct gn_kms_range *r = &o->range;
    *r = (struct gn_kms_range){0};
    if (range == GN_RANGE_AUTO) return; /* whatever was set before us */
    gn_kms_props_read(o->drm, o->fd, o->connector, DRM_MODE_OBJECT_CONNECTOR,
                      gn_kms_connector_props, GN_PROP_CONNECTOR_COUNT, ids, values);
    o->connector_props[GN_PROP_CONNECTOR_RANGE] = ids[GN_PROP_CONNECTOR_RANGE];
    r->old = values[GN_PROP_CONNECTOR_RANGE];
    r->is_set =
        gn_kms_prop_value(o->drm, o->fd, ids[GN_PROP_CONNECTOR_RANGE], names[range], &r->value);
    r->lacks = !r->is_set;
}

/* By itself: drivers with the atomic interface take it, too. */
static int send_range(struct gn_kms_output *o, uint64_t value) {
    return error_of(o->drm->ModeConnectorSetProperty(
        o->fd, o->connector, o->connector_props[GN_PROP_CONNECTOR_RANGE], value));
}

/* ---- modeset ---- */

int gn_kms_output_light(struct gn_kms_output *o, const drmModeModeInfo *mode,
                        const struct gn_kms_flip *flip) {
    int error = wake_connector(o);
    if (error != 0) return error;
    if (o->atomic) {
        uint32_t blob = 0;
        error = error_of(o->drm->ModeCreatePropertyBlob(o->fd, mode, sizeof *mode, &blob));
        if (error != 0) return error;
        error = commit_light(o, mode, flip, blob);
        if (error == EINVAL && o->range.is_set) { /* the picture matters more */
            o->range.is_set = false;
            error = commit_light(o, mode, flip, blob);
            o->range.is_set = error != 0; /* that was not the reason */
            o->range.lacks = error == 0;
        }
        o->drm->ModeDestroyPropertyBlob(o->fd, blob); /* the CRTC holds its own reference */
    } else {
        drmModeModeInfo copy = *mode;
        o->drm->ModeSetCursor(o->fd, o->crtc, 0, 0, 0);
        if (o->range.is_set) send_range(o, o->range.value); /* the picture matters more */
        error =
            error_of(o->drm->ModeSetCrtc(o->fd, o->crtc, flip->fb, 0, 0, &o->connector, 1, &copy));
    }
    if (error != 0) return error;
    o->mode = *mode;
    remove_old_fbs(o, flip->fb);
    return 0;
}

static int commit_flip(struct gn_kms_output *o, const struct gn_kms_flip *flip, uint32_t flags) {
    struct request r = {.list = o->drm->ModeAtomicAlloc(), .o = o};
    if (!r.list) return ENOMEM;
    add_picture(&r, &o->mode, flip);
    if (flip->fence >= 0)
        add_property(&r, o->plane, o->plane_props[GN_PROP_PLANE_FENCE], (uint64_t)flip->fence);
    return end_request(&r, flags, flip->user);
}

int gn_kms_output_flip(struct gn_kms_output *o, const struct gn_kms_flip *flip) {
    if (o->atomic) return commit_flip(o, flip, DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT);
    return error_of(
        o->drm->ModePageFlip(o->fd, o->crtc, flip->fb, DRM_MODE_PAGE_FLIP_EVENT, flip->user));
}

int gn_kms_output_test(struct gn_kms_output *o, const struct gn_kms_flip *flip) {
    return o->atomic ? commit_flip(o, flip, DRM_MODE_ATOMIC_TEST_ONLY) : ENOSYS;
}

int gn_kms_output_dark(struct gn_kms_output *o) {
    if (!o->atomic) return error_of(o->drm->ModeSetCrtc(o->fd, o->crtc, 0, 0, 0, NULL, 0, NULL));
    struct request r = {.list = o->drm->ModeAtomicAlloc(), .o = o};
    if (!r.list) return ENOMEM;
    disable_others(&r);
    disable_connectors(&r, true);
    add_property(&r, o->plane, o->plane_props[GN_PROP_PLANE_FB], 0);
    add_property(&r, o->plane, o->plane_props[GN_PROP_PLANE_CRTC], 0);
    add_property(&r, o->crtc, o->crtc_props[GN_PROP_CRTC_MODE], 0);
    add_property(&r, o->crtc, o->crtc_props[GN_PROP_CRTC_ACTIVE], 0);
    return end_request(&r, DRM_MODE_ATOMIC_ALLOW_MODESET, NULL);
}

/* Asked while it is active: an inactive CRTC reports no vblanks either. */
bool gn_kms_output_lacks_vblank(const struct gn_kms_output *o) {
    uint64_t sequence, ns;
    return error_of(o->drm->CrtcGetSequence(o->fd, o->crtc, &sequence, &ns)) == EOPNOTSUPP;
}

/* ---- closing ---- */

void gn_kms_output_close(struct gn_kms_output *o, bool restore) {
    if (!o->drm) return;
    if (restore && (o->mode.hdisplay > 0 || o->dpms == GN_ASLEEP)) {
        wake_connector(o);
        if (o->range.is_set) send_range(o, o->range.old);
        /* restores the console's framebuffer; another program's may be gone */
        if (!o->was_lit || o->drm->ModeSetCrtc(o->fd, o->crtc, o->old_fb, o->old_x, o->old_y,
                                               &o->connector, 1, &o->old_mode) != 0)
            gn_kms_output_dark(o);
    }
    gn_kms_output_orphan_fbs(o);
    remove_old_fbs(o, 0);
    *o = (struct gn_kms_output){0};
}
