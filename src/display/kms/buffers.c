/* Buffer ownership: at most one is scanned out, one pending, one waiting. */
#include <unistd.h>

#include "display/kms/state.h"

bool gn_kms_is_copy(const struct gn_kms *k) { return k->buffers.opts.fallback == GN_FALLBACK_COPY; }

static void close_fence(struct gn_kms_frame *frame) {
    if (frame->fb && frame->fence >= 0) close(frame->fence);
    frame->fence = -1;
}

/* Returns the buffer to its owner: GL's by its key, since the fallback level may have changed. */
static void release_buffer(struct gn_kms *k, struct gn_kms_frame *frame) {
    const bool is_copy = frame->key == &k->buffers.copies[0] || frame->key == &k->buffers.copies[1];
    close_fence(frame);
    if (frame->fb && frame->key && !is_copy && k->device.scanout)
        k->env.scanout->release(k->device.scanout, frame->key);
    *frame = (struct gn_kms_frame){.fence = -1};
}

void gn_kms_drop_surface(struct gn_kms *k) {
    if (k->frames.pending.fb == k->frames.front.fb)
        k->frames.pending = (struct gn_kms_frame){.fence = -1};
    if (k->frames.waiting.fb == k->frames.front.fb)
        k->frames.waiting = (struct gn_kms_frame){.fence = -1};
    release_buffer(k, &k->frames.waiting);
    release_buffer(k, &k->frames.pending);
    release_buffer(k, &k->frames.front);
    if (k->output.drm) gn_kms_output_orphan_fbs(&k->output);
    if (k->device.scanout) k->env.scanout->drop_surface(k->device.scanout);
    for (int i = 0; i < 2 && k->device.fd >= 0; i++)
        gn_dumb_destroy(&k->buffers.copies[i], k->env.drm, k->device.fd);
    k->buffers.surface = (struct gn_surface){0};
    k->screen.copy_to = NULL;
}

bool gn_kms_make_copies(struct gn_kms *k) {
    for (int i = 0; i < 2; i++)
        if (gn_dumb_create(&k->buffers.copies[i], k->env.drm, k->device.fd,
                           k->buffers.opts.width_px, k->buffers.opts.height_px) != 0)
            return false;
    return true;
}

struct gn_dumb *gn_kms_free_copy(struct gn_kms *k) {
    return k->frames.front.key == &k->buffers.copies[0] ? &k->buffers.copies[1]
                                                        : &k->buffers.copies[0];
}

/* ---- frames ---- */

/* `frame` replaces the front; it may be the same buffer. */
void gn_kms_take_front(struct gn_kms *k, struct gn_kms_frame frame, int64_t now_ns) {
    if (frame.fb != k->frames.front.fb) release_buffer(k, &k->frames.front);
    if (frame.fb == k->frames.front.fb) k->screen.counts.again++;
    close_fence(&frame);
    k->frames.front = frame;
    k->losses = 0;
    k->due.starved_ns = 0;
    k->due.again_ns = now_ns + (k->opts->again_ns > 0 ? k->opts->again_ns : 10 * GN_KMS_S);
}

/* Also clears `waiting`, which is this frame or empty. */
void gn_kms_discard(struct gn_kms *k, struct gn_kms_frame *frame) {
    k->frames.waiting = (struct gn_kms_frame){.fence = -1};
    if (frame->fb == k->frames.front.fb)
        close_fence(frame);
    else
        release_buffer(k, frame);
}

void gn_kms_flip_is_lost(struct gn_kms *k) {
    const struct gn_kms_frame frame = k->frames.pending;
    gn_flip_forget(&k->flip);
    k->frames.pending = (struct gn_kms_frame){.fence = -1};
    k->lit = false;
    if (!frame.fb) return;
    k->frames.ticket++; /* a late event must not match the next flip */
    if (frame.fb != k->frames.front.fb) release_buffer(k, &k->frames.front);
    k->frames.front = frame; /* the kernel may still scan it out */
    close_fence(&k->frames.front);
}
