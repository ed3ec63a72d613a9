/* Memory and references to it: files with handles, framebuffers, blobs, mappings. */
#include <drm_fourcc.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "sim_state.h"

/* ---- buffers ---- */

static void most(int *peak, int now) {
    if (now > *peak) *peak = now;
}

struct sim_bo *sim_bo_create(uint32_t width_px, uint32_t height_px, bool dumb) {
    struct sim_bo *bo = calloc(1, sizeof *bo);
    if (!bo) abort();
    bo->refs = 1;
    bo->width_px = width_px, bo->height_px = height_px;
    bo->size = (size_t)4 * width_px * height_px;
    if (dumb && !(bo->pixels = calloc(1, bo->size))) abort();
    most(&sim_counts.most_buffers, ++sim_counts.buffers);
    return bo;
}

void sim_bo_unref(struct sim_bo *bo) {
    if (--bo->refs > 0) return;
    sim_counts.buffers--;
    free(bo->pixels);
    free(bo);
}

static struct sim_handle *find_handle(struct sim_file *file, uint32_t number) {
    for (int i = 0; number && i < SIM_HANDLES; i++)
        if (file->handles[i].number == number) return &file->handles[i];
    return NULL;
}

uint32_t sim_handle_add(struct sim_file *file, struct sim_bo *bo, bool dumb) {
    for (int i = 0; i < SIM_HANDLES; i++) {
        if (file->handles[i].number) continue;
        file->handles[i] = (struct sim_handle){++file->next_handle, bo, dumb, false};
        bo->refs++;
        sim_counts.dumbs += dumb;
        return file->next_handle;
    }
    sim_complain("more than %d handles", SIM_HANDLES);
    abort();
}

void sim_handle_close(struct sim_file *file, uint32_t number) {
    struct sim_handle *h = find_handle(file, number);
    if (!h) return;
    sim_counts.dumbs -= h->dumb;
    sim_bo_unref(h->bo);
    *h = (struct sim_handle){0};
}

/* ---- framebuffers ---- */

struct sim_fb *sim_fb_find(struct sim_card *card, uint32_t id) {
    for (int i = 0; id && i < SIM_FBS; i++)
        if (card->fbs[i].id == id) return &card->fbs[i];
    return NULL;
}

struct sim_fb *sim_fb_add(struct sim_card *card, int file, struct sim_bo *bo, uint32_t format) {
    for (int i = 0; i < SIM_FBS; i++) {
        struct sim_fb *fb = &card->fbs[i];
        if (fb->refs > 0) continue;
        *fb = (struct sim_fb){.id = card->next_id++,
                              .refs = 1,
                              .file = file,
                              .bo = bo,
                              .width_px = bo->width_px,
                              .height_px = bo->height_px,
                              .format = format};
        bo->refs++;
        most(&sim_counts.most_fbs, ++sim_counts.fbs);
        return fb;
    }
    sim_complain("more than %d framebuffers", SIM_FBS);
    abort();
}

struct sim_fb *sim_fb_ref(struct sim_fb *fb) {
    if (fb) fb->refs++;
    return fb;
}

void sim_fb_unref(struct sim_fb *fb) {
    if (--fb->refs > 0) return;
    sim_counts.fbs--;
    sim_bo_unref(fb->bo);
    *fb = (struct sim_fb){0};
}

/* Like drm_framebuffer_remove(): switches off the CRTCs and planes that show it. */
void sim_fb_remove(struct sim_card *card, struct sim_fb *fb) {
    struct sim_state next = card->state;
    bool dark = false;
    for (int p = 0; p < SIM_PLANES; p++) {
        struct sim_plane_state *plane = &next.planes[p];
        if (plane->fb != fb->id) continue;
        const int crtc = plane->crtc;
        plane->fb = 0;
        plane->crtc = -1;
        dark = true;
        if (p >= SIM_CRTCS || crtc < 0) continue;
        next.crtcs[crtc] = (struct sim_crtc_state){0};
        for (int i = 0; i < SIM_CONNECTORS; i++)
            if (next.connectors[i].crtc == crtc) next.connectors[i].crtc = -1;
    }
    if (dark) sim_take(card, &next);
    fb->id = 0;
    sim_fb_unref(fb);
}

static bool format_is_known(uint32_t format) {
    return format == DRM_FORMAT_XRGB8888 || format == DRM_FORMAT_ARGB8888 ||
           format == DRM_FORMAT_RGB565;
}

static int add_fb(struct sim_file *file, uint32_t width, uint32_t height, uint32_t format,
                  const uint32_t *handles, uint64_t modifier, uint32_t *out) {
    struct sim_card *card = sim_card_of(file);
    const struct sim_handle *h = find_handle(file, handles[0]);
    if (!h) {
        sim_complain("framebuffer of a freed buffer");
        return -ENOENT;
    }
    if (!format_is_known(format) || width > h->bo->width_px || height > h->bo->height_px)
        return -EINVAL;
    if (modifier != DRM_FORMAT_MOD_INVALID && !card->traits.modifiers) return -EINVAL;
    *out = sim_fb_add(card, sim_index_of(file), h->bo, format)->id;
    return 0;
}

static int add_fb2(int fd, uint32_t width, uint32_t height, uint32_t format,
                   const uint32_t handles[4], const uint32_t strides[4], const uint32_t offsets[4],
                   uint32_t *out, uint32_t flags) {
    struct sim_file *file = sim_enter(SIM_ModeAddFB2, fd);
    (void)strides, (void)offsets, (void)flags;
    if (!file) return -errno;
    return add_fb(file, width, height, format, handles, DRM_FORMAT_MOD_INVALID, out);
}

static int add_fb2_modifiers(int fd, uint32_t width, uint32_t height, uint32_t format,
                             const uint32_t handles[4], const uint32_t strides[4],
                             const uint32_t offsets[4], const uint64_t modifier[4], uint32_t *out,
                             uint32_t flags) {
    struct sim_file *file = sim_enter(SIM_ModeAddFB2WithModifiers, fd);
    (void)strides, (void)offsets;
    if (!file) return -errno;
    if (!(flags & DRM_MODE_FB_MODIFIERS)) return -EINVAL;
    return add_fb(file, width, height, format, handles, modifier[0], out);
}

/* NULL for a card that is gone; its objects are gone with it. */
static struct sim_card *card_of_fd(int fd, int *file) {
    const struct sim_file *f = sim_find_file(fd);
    *file = f ? sim_index_of(f) : -1;
    return f ? sim_card_of(f) : NULL;
}

static int rm_fb(int fd, uint32_t id) {
    const bool ok = sim_enter(SIM_ModeRmFB, fd);
    const int error = errno;
    int file;
    struct sim_card *card = card_of_fd(fd, &file);
    struct sim_fb *fb = card ? sim_fb_find(card, id) : NULL;
    if (card && (!fb || fb->file != file || fb->asked))
        sim_complain("removes unknown framebuffer %u", id);
    if (fb && !ok) fb->asked = true;
    if (!ok) return -error;
    if (!fb || fb->file != file) return -ENOENT;
    sim_fb_remove(card, fb);
    return 0;
}

/* ---- blobs ---- */

struct sim_blob *sim_blob_find(struct sim_card *card, uint32_t id) {
    for (int i = 0; id && i < SIM_BLOBS; i++)
        if (card->blobs[i].id == id) return &card->blobs[i];
    return NULL;
}

static int create_blob(int fd, const void *data, size_t size, uint32_t *out) {
    struct sim_file *file = sim_enter(SIM_ModeCreatePropertyBlob, fd);
    if (!file) return -errno;
    struct sim_card *card = sim_card_of(file);
    for (int i = 0; i < SIM_BLOBS; i++) {
        struct sim_blob *blob = &card->blobs[i];
        if (blob->id) continue;
        *blob = (struct sim_blob){.id = card->next_id++, .file = sim_index_of(file)};
        memcpy(&blob->mode, data, size < sizeof blob->mode ? size : sizeof blob->mode);
        most(&sim_counts.most_blobs, ++sim_counts.blobs);
        *out = blob->id;
        return 0;
    }
    sim_complain("more than %d blobs", SIM_BLOBS);
    return -ENOMEM;
}

static int destroy_blob(int fd, uint32_t id) {
    const bool ok = sim_enter(SIM_ModeDestroyPropertyBlob, fd);
    const int error = errno;
    int file;
    struct sim_card *card = card_of_fd(fd, &file);
    struct sim_blob *blob = card ? sim_blob_find(card, id) : NULL;
    if (card && (!blob || blob->file != file || blob->asked))
        sim_complain("destroys unknown blob %u", id);
    if (blob && !ok) blob->asked = true;
    if (!ok) return -error;
    if (!blob) return -ENOENT;
    *blob = (struct sim_blob){0};
    sim_counts.blobs--;
    return 0;
}

/* ---- dumb buffers ---- */

static int create_dumb(struct sim_file *file, struct drm_mode_create_dumb *d) {
    struct sim_bo *bo = sim_bo_create(d->width, d->height, true);
    d->pitch = 4 * d->width;
    d->size = bo->size;
    d->handle = sim_handle_add(file, bo, true);
    sim_bo_unref(bo);
    return 0;
}

static int map_dumb(struct sim_file *file, struct drm_mode_map_dumb *d) {
    const struct sim_handle *h = find_handle(file, d->handle);
    if (!h || !h->dumb) sim_complain("maps an unknown dumb buffer");
    d->offset = (uint64_t)d->handle << 12;
    return h ? 0 : ENOENT;
}

static int destroy_dumb(struct sim_file *file, const struct drm_mode_destroy_dumb *d, bool ok) {
    struct sim_handle *h = find_handle(file, d->handle);
    if (!h || !h->dumb || h->asked) sim_complain("destroys an unknown dumb buffer");
    if (h && !ok) h->asked = true;
    if (ok) sim_handle_close(file, d->handle);
    return h ? 0 : ENOENT;
}

static int ioctl_dumb(int fd, unsigned long request, void *arg) {
    struct sim_file *file = sim_enter(SIM_Ioctl, fd);
    int error = file ? EINVAL : errno;
    if (!file && request == DRM_IOCTL_MODE_DESTROY_DUMB && sim_find_file(fd))
        destroy_dumb(sim_find_file(fd), arg, false);
    if (file && request == DRM_IOCTL_MODE_CREATE_DUMB) error = create_dumb(file, arg);
    if (file && request == DRM_IOCTL_MODE_MAP_DUMB) error = map_dumb(file, arg);
    if (file && request == DRM_IOCTL_MODE_DESTROY_DUMB) error = destroy_dumb(file, arg, true);
    errno = error;
    return error == 0 ? 0 : -1;
}

static struct {
    struct sim_bo *bo;
    size_t size;
} maps[16];

static void *map(int fd, uint64_t offset, size_t size) {
    struct sim_file *file = sim_enter(SIM_map, fd);
    const struct sim_handle *h = file ? find_handle(file, (uint32_t)(offset >> 12)) : NULL;
    for (int i = 0; h && i < 16; i++) {
        if (maps[i].bo) continue;
        maps[i].bo = h->bo;
        maps[i].size = size;
        h->bo->refs++;
        sim_counts.maps++;
        return h->bo->pixels;
    }
    if (file) sim_complain("invalid mapping, or more than 16");
    return NULL;
}

static void unmap(void *memory, size_t size) {
    for (int i = 0; i < 16; i++) {
        if (!maps[i].bo || maps[i].bo->pixels != memory) continue;
        if (maps[i].size != size) sim_complain("unmapped size differs from mapped size");
        sim_bo_unref(maps[i].bo);
        maps[i].bo = NULL;
        sim_counts.maps--;
        return;
    }
    sim_complain("unmaps memory that is not mapped");
}

/* ---- files ---- */

/* Returns -1 with errno set. */
static int open_card(const char *path) {
    if (sim_fails(SIM_open)) return -1;
    errno = ENOENT;
    for (int n = 0; n < SIM_CARDS; n++) {
        struct sim_card *card = &sim.cards[n];
        if (!card->present || strcmp(card->path, path) != 0) continue;
        struct sim_file *file = sim_find_file(0);
        errno = EMFILE;
        if (!file) return -1;
        *file = (struct sim_file){.fd = sim.next_fd++, .card = n, .life = card->life};
        if (card->master == SIM_NOBODY) card->master = sim_index_of(file);
        file->was_master = card->master == sim_index_of(file);
        sim_counts.files++;
        return file->fd;
    }
    return -1;
}

static void close_objects(struct sim_card *card, int file) {
    for (int i = 0; i < SIM_CRTCS; i++) {
        if (card->crtcs[i].flip.file == file) card->crtcs[i].flip.file = SIM_NOBODY;
        if (card->crtcs[i].stall == SIM_STALLS_UNTIL_REOPENED)
            sim_stall((int)(card - sim.cards), SIM_FLOWS);
    }
    for (int i = 0; i < SIM_FBS; i++) {
        if (!card->fbs[i].id || card->fbs[i].file != file) continue;
        if (!card->fbs[i].asked) sim_complain("framebuffer leaked at close");
        sim_fb_remove(card, &card->fbs[i]);
    }
    for (int i = 0; i < SIM_BLOBS; i++) {
        if (!card->blobs[i].id || card->blobs[i].file != file) continue;
        if (!card->blobs[i].asked) sim_complain("blob leaked at close");
        card->blobs[i].id = 0;
        sim_counts.blobs--;
    }
}

void sim_file_close(struct sim_file *file) {
    struct sim_card *card = sim_card_of(file);
    const int index = sim_index_of(file);
    if (file->scanouts > 0) sim_complain("card closed while GL uses it");
    if (card) close_objects(card, index);
    for (int i = 0; i < SIM_HANDLES; i++) {
        if (!file->handles[i].number) continue;
        if (!file->handles[i].asked) sim_complain("buffer leaked at close");
        sim_handle_close(file, file->handles[i].number);
    }
    if (card && card->master == index) card->master = SIM_NOBODY;
    if (sim.late.flip.file == index) sim.late.flip.pending = false;
    sim_counts.files--;
    *file = (struct sim_file){0};
}

static void close_card(int fd) {
    struct sim_file *file = fd >= SIM_FIRST_FD ? sim_find_file(fd) : NULL;
    if (file)
        sim_file_close(file);
    else
        sim_complain("closes closed descriptor %d", fd);
}

void sim_fill_memory(struct gn_drm_ops *ops) {
    ops->open = open_card;
    ops->close = close_card;
    ops->map = map;
    ops->unmap = unmap;
    ops->Ioctl = ioctl_dumb;
    ops->ModeAddFB2 = add_fb2;
    ops->ModeAddFB2WithModifiers = add_fb2_modifiers;
    ops->ModeRmFB = rm_fb;
    ops->ModeCreatePropertyBlob = create_blob;
    ops->ModeDestroyPropertyBlob = destroy_blob;
}
