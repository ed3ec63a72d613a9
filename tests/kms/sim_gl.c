/* A GPU whose frames are colours: contexts, surfaces of four buffers, frames. */
#include <drm_fourcc.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim_state.h"

enum { BUFFERS = 4 };
struct buffer {
    struct sim_bo *bo;
    uint32_t handle;
    bool locked;
};
struct context {
    int fd;
    bool has_surface;
    struct gn_surface_opts opts;
    struct buffer buffers[BUFFERS];
};
static struct context *current;

static void *open_context(int fd, const char *render_node, struct gn_err *err) {
    struct sim_file *f = sim_enter(SIM_gl_open, fd);
    if (render_node && strcmp(render_node, SIM_RENDER_NODE) != 0) {
        gn_fail(err, "render node %s: No such file or directory", render_node);
        return NULL;
    }
    if (!f || sim.gpu.no_gl) {
        gn_fail(err, "GL does not start");
        return NULL;
    }
    if (current) sim_complain("second GL context");
    current = calloc(1, sizeof *current);
    if (!current) abort();
    current->fd = fd;
    f->scanouts++;
    return current;
}

static gn_display_proc get_proc(void *state, const char *name) {
    (void)state, (void)name;
    return NULL;
}

static struct context *check(void *state, const char *what) {
    if (state && state == current) return current;
    sim_complain("%s without a context", what);
    return NULL;
}

static void drop_surface(void *state) {
    struct context *c = check(state, "drop_surface");
    if (!c || !c->has_surface) return;
    struct sim_file *f = sim_find_file(c->fd);
    if (!f) sim_complain("surface outlives its card");
    for (int i = 0; i < BUFFERS; i++) {
        if (c->buffers[i].locked) sim_complain("surface destroyed with a locked buffer");
        if (f) sim_handle_close(f, c->buffers[i].handle);
        sim_bo_unref(c->buffers[i].bo);
        c->buffers[i] = (struct buffer){0};
    }
    c->has_surface = false;
}

static bool set_surface(void *state, const struct gn_surface_opts *o, struct gn_surface *out,
                        struct gn_err *err) {
    struct context *c = check(state, "set_surface");
    if (!c) return gn_fail(err, "no context");
    drop_surface(c);
    if (o->fallback >= GN_FALLBACK_COPY || o->width_px == 0 || o->format_count == 0)
        sim_complain("surface without size or format");
    struct sim_file *f = sim_enter(SIM_gl_surface, c->fd);
    const bool unlisted = o->fallback == GN_FALLBACK_MODIFIERS && o->modifier_count == 0;
    if (!f || unlisted || sim.gpu.no_surface[o->fallback]) return gn_fail(err, "no such surface");
    for (int i = 0; i < BUFFERS; i++) {
        c->buffers[i].bo = sim_bo_create(o->width_px, o->height_px, false);
        c->buffers[i].handle = sim_handle_add(f, c->buffers[i].bo, false);
    }
    c->opts = *o;
    c->has_surface = true;
    *out = (struct gn_surface){.format = o->formats[0]};
    return true;
}

static struct buffer *back_buffer(struct context *c) {
    for (int i = 0; c->has_surface && i < BUFFERS; i++)
        if (!c->buffers[i].locked) return &c->buffers[i];
    return NULL;
}

static uint64_t modifier_of(const struct gn_surface_opts *o) {
    if (o->fallback == GN_FALLBACK_MODIFIERS) return o->modifiers[0];
    return o->fallback == GN_FALLBACK_LINEAR ? DRM_FORMAT_MOD_LINEAR : DRM_FORMAT_MOD_INVALID;
}

static bool swap(void *state, bool want_fence, struct gn_buffer *out, int *fence,
                 struct gn_err *err) {
    struct context *c = check(state, "swap");
    struct buffer *b = c ? back_buffer(c) : NULL;
    *fence = -1;
    if (!b) sim_complain("frame without a buffer");
    if (sim_fails(SIM_gl_swap) || !b) return gn_fail(err, "eglSwapBuffers failed");
    b->locked = true;
    *out = (struct gn_buffer){.key = b,
                              .width_px = c->opts.width_px,
                              .height_px = c->opts.height_px,
                              .format = c->opts.formats[0],
                              .modifier = modifier_of(&c->opts),
                              .plane_count = 1,
                              .handles = {b->handle},
                              .strides = {4 * c->opts.width_px}};
    if (want_fence) *fence = open("/dev/null", O_RDWR | O_CLOEXEC);
    sim_counts.fences_given += want_fence;
    return true;
}

static void release(void *state, void *key) {
    struct context *c = check(state, "release");
    for (int i = 0; c && i < BUFFERS; i++) {
        if (key != &c->buffers[i] || !c->buffers[i].locked) continue;
        c->buffers[i].locked = false;
        return;
    }
    sim_complain("released buffer was not locked");
}

static bool has_free(void *state) {
    struct context *c = check(state, "has_free");
    return c && back_buffer(c);
}

static void close_context(void *state) {
    struct context *c = check(state, "close");
    if (!c) return;
    drop_surface(c);
    struct sim_file *f = sim_find_file(c->fd);
    if (f) f->scanouts--;
    current = NULL;
    free(c);
}

const struct gn_scanout_ops sim_gl = {
    .open = open_context,
    .get_proc = get_proc,
    .set_surface = set_surface,
    .drop_surface = drop_surface,
    .swap = swap,
    .release = release,
    .has_free = has_free,
    .close = close_context,
};

void sim_gl_reset(void) {
    free(current);
    current = NULL;
}

/* ---- painting ---- */

/* While flips are stalled, the visible buffer is undefined. */
static bool is_stalled(const struct sim_crtc *c) {
    return c->stall != SIM_FLOWS ||
           (c->flip.pending && sim.now_ns - c->flip.committed_ns > 250 * SIM_MS);
}

/* The buffer must not be scanned out or queued. */
static void check_unseen(const struct sim_bo *bo) {
    for (int n = 0; n < SIM_CARDS; n++)
        for (int i = 0; i < SIM_CRTCS; i++) {
            const struct sim_crtc *c = &sim.cards[n].crtcs[i];
            if (!sim.cards[n].state.crtcs[i].active || is_stalled(c)) continue;
            if (c->shown && c->shown->bo == bo) sim_complain("draws into the visible buffer");
            if (c->flip.pending && c->flip.fb && c->flip.fb->bo == bo)
                sim_complain("draws into a queued buffer");
        }
}

void sim_paint_part(uint32_t colour, uint32_t width_px, uint32_t height_px) {
    struct buffer *b = current ? back_buffer(current) : NULL;
    if (!b) {
        sim_complain("draws without a buffer");
        return;
    }
    check_unseen(b->bo);
    b->bo->colour = colour;
    b->bo->painted[0] = width_px, b->bo->painted[1] = height_px;
}

void sim_paint(uint32_t colour) { sim_paint_part(colour, 0, 0); }

void sim_paint_copy(uint8_t *pixels, uint32_t colour) {
    for (int i = 0; i < SIM_FILES; i++)
        for (int k = 0; sim.files[i].fd && k < SIM_HANDLES; k++) {
            const struct sim_handle *h = &sim.files[i].handles[k];
            if (!h->number || h->bo->pixels != pixels) continue;
            check_unseen(h->bo);
            memcpy(pixels, &colour, sizeof colour);
            memcpy(pixels + h->bo->size - sizeof colour, &colour, sizeof colour);
            return;
        }
    sim_complain("copy into unmapped memory");
}
