/* Who holds which buffer: at most one is on the screen, one on its way, one waits. */
#include <unistd.h>

#include "display/kms/state.h"

bool gn_kms_is_copy(const struct gn_kms *k) { return k->surface_opts.rung == GN_RUNG_COPY; }

/* By the buffer, not by the rung: that may have changed since. */
static bool is_gpus(const struct gn_kms *k, const void *key) {
    return k->scanout && key && key != &k->copies[0] && key != &k->copies[1];
}

static void close_fence(struct gn_kms_shot *shot) {
    if (shot->fb && shot->fence >= 0) close(shot->fence);
    shot->fence = -1;
}

/* Nobody reads it any more. */
static void retire(struct gn_kms *k, struct gn_kms_shot *shot) {
    close_fence(shot);
    if (shot->fb && is_gpus(k, shot->key)) k->env.scanout->release(k->scanout, shot->key);
    *shot = (struct gn_kms_shot){.fence = -1};
}

static void forget_shots(struct gn_kms *k) {
    if (k->pending.fb == k->front.fb) k->pending = (struct gn_kms_shot){.fence = -1};
    if (k->waiting.fb == k->front.fb) k->waiting = (struct gn_kms_shot){.fence = -1};
    retire(k, &k->waiting);
    retire(k, &k->pending);
    retire(k, &k->front);
}

void gn_kms_drop_surface(struct gn_kms *k) {
    forget_shots(k);
    if (k->output.drm) gn_kms_output_orphan_fbs(&k->output);
    if (k->scanout) k->env.scanout->drop_surface(k->scanout);
    for (int i = 0; i < 2 && k->fd >= 0; i++) gn_dumb_destroy(&k->copies[i], k->env.drm, k->fd);
    k->surface = (struct gn_surface){0};
    k->screen.copy_to = NULL;
}

bool gn_kms_make_copies(struct gn_kms *k) {
    for (int i = 0; i < 2; i++)
        if (gn_dumb_create(&k->copies[i], k->env.drm, k->fd, k->surface_opts.width_px,
                           k->surface_opts.height_px) != 0)
            return false;
    return true;
}

struct gn_dumb *gn_kms_free_copy(struct gn_kms *k) {
    return k->front.key == &k->copies[0] ? &k->copies[1] : &k->copies[0];
}

/* ---- pictures on their way ---- */

/* From now on the front is another; `shot` may be the same once more. */
void gn_kms_take_front(struct gn_kms *k, struct gn_kms_shot shot, int64_t now_ns) {
    if (shot.fb != k->front.fb) retire(k, &k->front);
    if (shot.fb == k->front.fb) k->screen.counts.again++;
    close_fence(&shot);
    k->front = shot;
    k->losses = 0;
    k->starved_ns = 0;
    k->again_ns = now_ns + (k->opts->again_ns > 0 ? k->opts->again_ns : 10 * GN_KMS_S);
}

/* It may be the one that waits, which it does no more. */
void gn_kms_discard(struct gn_kms *k, struct gn_kms_shot *shot) {
    k->waiting = (struct gn_kms_shot){.fence = -1};
    if (shot->fb == k->front.fb)
        close_fence(shot);
    else
        retire(k, shot);
}

void gn_kms_flip_is_lost(struct gn_kms *k) {
    const struct gn_kms_shot shot = k->pending;
    gn_flip_forget(&k->flip);
    k->pending = (struct gn_kms_shot){.fence = -1};
    k->lit = false;
    if (!shot.fb) return;
    k->ticket++; /* its event may come yet, whenever */
    if (shot.fb != k->front.fb) retire(k, &k->front);
    k->front = shot; /* the kernel may be reading it */
    close_fence(&k->front);
}
