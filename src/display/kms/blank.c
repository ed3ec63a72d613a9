/* Screen blanking: the CRTC is switched off until unblanked, also after hotplug, VT switches and
 * card changes; a lost flip is no failure while blanked. The last frame is kept and shown first
 * when the screen comes back. */
#include "display/kms/state.h"

bool gn_kms_may_sleep(const struct gn_kms *k) {
    return k->blank && k->device.fd >= 0 && !k->screen.lost && k->output.drm &&
           k->monitor.connected && k->master && !k->away && !k->flip.pending;
}

void gn_kms_sleep(struct gn_kms *k, int64_t now_ns) {
    if (!gn_kms_may_sleep(k) || now_ns < k->due.sleep_ns) return;
    const int error = gn_kms_output_sleep(&k->output);
    k->lit = false;
    /* another program may switch it on meanwhile */
    k->due.sleep_ns = now_ns + (error == 0 ? 10 * GN_KMS_S : GN_KMS_S / 10);
    if (error == 0) return;
    switch (gn_flip_error_of(error)) {
    case GN_FLIP_BUSY:
    case GN_FLIP_NO_MEMORY: return;
    case GN_FLIP_NO_MASTER: gn_kms_lose_master(k, now_ns); return;
    case GN_FLIP_CARD_GONE: gn_kms_leave_card(k, false, now_ns); return;
    case GN_FLIP_CHANGED: break;
    }
    k->due.sleep_ns = now_ns + GN_KMS_S;
    if (k->due.scan_ns > k->due.sleep_ns) k->due.scan_ns = k->due.sleep_ns;
}

void gn_kms_set_blank(struct gn_kms *k, bool on, int64_t now_ns) {
    if (k->blank == on) return;
    k->blank = on;
    k->due.sleep_ns = now_ns;
    struct gn_kms_frame waiting = k->frames.waiting;
    if (on && waiting.fb) gn_kms_discard(k, &waiting);
    if (!on && k->frames.front.fb && !k->lit && k->monitor.connected && k->master && !k->away &&
        !k->screen.lost && !k->flip.pending && !k->text.message[0])
        gn_kms_send(k, k->frames.front, now_ns);
}
