/* Frames: one flip in flight, at most two buffers held. */
#include <errno.h>
#include <stdio.h>
#include <unistd.h>

#include "caption/message.h"
#include "display/kms/state.h"

#define STARVED_NS (5 * GN_KMS_S) /* no framebuffer for so long: try other buffers */

/* ---- flips ---- */

static void on_flip(int fd, unsigned sequence, unsigned s, unsigned us, unsigned crtc, void *user) {
    (void)fd, (void)sequence, (void)crtc;
    const struct gn_kms_ticket *ticket = user;
    struct gn_kms *k = ticket->kms;
    if (ticket->number == k->frames.ticket) k->frames.event_ns = s * GN_KMS_S + us * INT64_C(1000);
}

void gn_kms_drain(struct gn_kms *k, int64_t now_ns) {
    drmEventContext context = {.version = 3, .page_flip_handler2 = on_flip};
    for (int i = 0; i < 8; i++) { /* until nothing is left to read, within bounds */
        k->frames.event_ns = -1;
        errno = 0;
        const int result = k->env.drm->HandleEvent(k->device.fd, &context);
        const int error = errno;
        if (k->frames.event_ns >= 0 && k->flip.pending) {
            const struct gn_kms_frame frame = k->frames.pending;
            k->frames.pending = (struct gn_kms_frame){.fence = -1};
            gn_flip_done(&k->flip, k->frames.event_ns, now_ns);
            gn_kms_take_front(k, frame, now_ns);
        }
        if (result == 0) continue;
        if (error == ENODEV || error == EIO || error == EBADF) gn_kms_leave_card(k, false, now_ns);
        return;
    }
}

/* ---- commits ---- */

static void wait_a_frame(struct gn_kms *k, const struct gn_kms_frame *frame, int64_t now_ns) {
    if (!k->frames.waiting.fb) k->frames.waiting_ns = now_ns;
    k->frames.waiting = *frame;
    k->screen.counts.retried++;
    gn_flip_refused(&k->flip, now_ns);
}

void gn_kms_lose_master(struct gn_kms *k, int64_t now_ns) {
    k->master = k->lit = false;
    k->due.master_ns = now_ns + GN_KMS_S;
    k->text.holder[0] = 0;
    if (k->env.find_holder)
        k->env.find_holder(k->device.node.path, k->text.holder, sizeof k->text.holder);
}

static void handle_commit_error(struct gn_kms *k, struct gn_kms_frame *frame, int error,
                                int64_t now_ns) {
    const bool was_lit = k->lit;
    switch (gn_flip_error_of(error)) {
    case GN_FLIP_BUSY:
    case GN_FLIP_NO_MEMORY: wait_a_frame(k, frame, now_ns); return;
    case GN_FLIP_NO_MASTER:
        gn_kms_discard(k, frame);
        gn_kms_lose_master(k, now_ns);
        return;
    case GN_FLIP_CARD_GONE:
        gn_kms_discard(k, frame);
        gn_kms_leave_card(k, false, now_ns);
        return;
    case GN_FLIP_CHANGED: break;
    }
    if (frame->part.width_px > 0) { /* whatever the test said: another frame, drawn at full size */
        k->scaling.can = false;
        gn_kms_discard(k, frame);
        k->screen.damaged = true;
        k->due.again_ns = GN_KMS_NEVER;
        gn_flip_refused(&k->flip, now_ns);
        return;
    }
    k->lit = false;
    if (was_lit) { /* mode or connector changed: retry with a modeset */
        wait_a_frame(k, frame, now_ns);
        k->due.scan_ns = k->due.probe_ns = now_ns;
        return;
    }
    gn_kms_discard(k, frame);
    gn_kms_next_try(k, error, now_ns);
}

void gn_kms_send(struct gn_kms *k, struct gn_kms_frame frame, int64_t now_ns) {
    struct gn_kms_flip flip = {.fb = frame.fb, .part = frame.part, .fence = frame.fence};
    int error;
    if (k->blank) { /* blanking was requested while it was drawn */
        gn_kms_discard(k, &frame);
        return;
    }
    if (k->lit) {
        struct gn_kms_ticket *ticket = &k->frames.tickets[k->frames.ticket % GN_KMS_TICKETS];
        *ticket = (struct gn_kms_ticket){k, k->frames.ticket};
        flip.user = ticket;
        error = gn_kms_output_flip(&k->output, &flip);
    } else {
        const drmModeModeInfo *mode = &k->monitor.candidates[k->monitor.mode];
        error = gn_kms_output_light(&k->output, mode, &flip);
    }
    if (error != 0) {
        handle_commit_error(k, &frame, error, now_ns);
        return;
    }
    if (k->lit) {
        k->frames.pending = frame;
        gn_flip_committed(&k->flip, now_ns);
    } else {
        k->lit = true;
        k->monitor.lit_for = k->monitor.id;
        k->scaling.part = (struct gn_kms_part){0};
        k->screen.counts.relit++;
        k->flip.no_vblank = gn_kms_output_lacks_vblank(&k->output);
        gn_flip_committed(&k->flip, now_ns);
        k->flip.due_ns = now_ns; /* a modeset misses no refresh */
        gn_flip_done(&k->flip, 0, now_ns);
        gn_kms_take_front(k, frame, now_ns);
    }
    /* `waiting` was this frame or empty: none is drawn or repeated while one waits */
    k->frames.waiting = (struct gn_kms_frame){.fence = -1};
}

/* ---- message without GL ---- */

/* ENOMEM: retry; memory may be freed, and other or smaller buffers may fit. */
static void handle_fb_error(struct gn_kms *k, int error, int64_t now_ns) {
    const enum gn_flip_error kind = gn_flip_error_of(error);
    const bool waits = kind == GN_FLIP_BUSY || kind == GN_FLIP_NO_MEMORY;
    if (waits && k->due.starved_ns == 0) k->due.starved_ns = now_ns;
    if (kind == GN_FLIP_CARD_GONE) {
        gn_kms_leave_card(k, false, now_ns);
    } else if (waits && now_ns - k->due.starved_ns < STARVED_NS) {
        k->lit = false; /* draw the discarded content again */
        k->screen.counts.retried++;
        gn_flip_refused(&k->flip, now_ns);
    } else {
        gn_kms_next_try(k, error, now_ns);
    }
}

void gn_kms_send_message(struct gn_kms *k, int64_t now_ns) {
    struct gn_dumb *copy = gn_kms_free_copy(k);
    struct gn_kms_frame frame = {.key = copy, .fence = -1};
    const struct gn_buffer buffer = gn_dumb_buffer(copy);
    const struct gn_message_picture picture = {.pixels = copy->pixels,
                                               .stride = copy->stride,
                                               .width_px = copy->width_px,
                                               .height_px = copy->height_px,
                                               .turn_deg = k->screen.rotate_deg};
    gn_message_draw(&picture, k->device.scanout ? k->text.message : GN_DISPLAY_NO_GL);
    const int error = gn_kms_output_fb(&k->output, &buffer, &frame.fb);
    if (error == 0)
        gn_kms_send(k, frame, now_ns);
    else
        handle_fb_error(k, error, now_ns);
}

/* ---- drawing ---- */

bool gn_kms_begin(struct gn_kms *k, int64_t now_ns, struct gn_err *err) {
    (void)err;
    if (!k->screen.may_draw) return false;
    if (gn_kms_is_copy(k)) {
        struct gn_dumb *copy = gn_kms_free_copy(k);
        k->screen.copy_to = copy->pixels;
        k->screen.copy_stride = copy->stride;
    }
    k->scaling.fills = k->screen.damaged = false;
    gn_flip_begun(&k->flip, now_ns);
    return true;
}

/* By a test with the frame that is shown: the first one after a modeset is drawn at full size. */
bool gn_kms_scale(struct gn_kms *k, uint32_t width_px, uint32_t height_px) {
    struct gn_kms_scaling *s = &k->scaling;
    const struct gn_kms_flip flip = {
        .fb = k->frames.front.fb, .part = {width_px, height_px}, .fence = -1};
    const bool tested = s->part.width_px == width_px && s->part.height_px == height_px;
    if (gn_kms_is_copy(k) || !k->lit || !flip.fb) return false;
    if (!tested) {
        const int error = gn_kms_output_test(&k->output, &flip);
        if (error != 0 && gn_flip_error_of(error) != GN_FLIP_CHANGED) return false; /* for now */
        s->part = flip.part;
        s->can = error == 0;
    }
    s->fills = s->can;
    return s->can;
}

void gn_kms_send_drawn(struct gn_kms *k, int64_t now_ns) {
    struct gn_buffer buffer;
    struct gn_kms_frame frame = {.fence = -1};
    struct gn_err why = {0};
    k->screen.may_draw = false;
    k->screen.copy_to = NULL;
    if (gn_kms_is_copy(k)) {
        buffer = gn_dumb_buffer(gn_kms_free_copy(k));
    } else if (!k->env.scanout->swap(k->device.scanout, gn_kms_output_takes_fence(&k->output),
                                     &buffer, &frame.fence, &why)) {
        snprintf(k->text.reason, sizeof k->text.reason, "%s", why.text);
        gn_kms_leave_card(k, true, now_ns); /* the context is lost */
        return;
    }
    frame.key = buffer.key;
    if (k->scaling.fills) frame.part = k->scaling.part;
    const int error = gn_kms_output_fb(&k->output, &buffer, &frame.fb);
    if (error == 0) {
        gn_kms_send(k, frame, now_ns);
        return;
    }
    if (frame.fence >= 0) close(frame.fence);
    if (!gn_kms_is_copy(k)) k->env.scanout->release(k->device.scanout, frame.key);
    handle_fb_error(k, error, now_ns);
}
