/* The row `kms`: a KMS screen with its event sources: card, uevents, VT signals and a timer. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "display/kms/console.h"
#include "display/kms/holder.h"
#include "display/kms/kms.h"
#include "display/kms/uevent.h"
#include "display/private.h"

struct kms_screen {
    const struct gn_drm_ops *drm;
    void *scanout; /* GL context while only drawing off screen; otherwise kms has one */
    int node;      /* descriptor of its card */
    struct gn_screen_opts opts;
    struct gn_kms *kms;
    struct gn_console console;
    struct gn_watch card, uevents; /* fd -1: none */
    struct gn_timer timer;         /* due at the state machine's deadline */
    unsigned events;               /* GN_KMS_EVENT_* since the last dispatch */
};

static void on_card(void *user, int64_t now_ns) {
    struct kms_screen *s = user;
    (void)now_ns;
    s->events |= GN_KMS_EVENT_READABLE;
}

static void on_uevent(void *user, int64_t now_ns) {
    struct kms_screen *s = user;
    (void)now_ns;
    if (gn_uevent_read(s->uevents.fd)) s->events |= GN_KMS_EVENT_HOTPLUG;
}

/* A closed descriptor has left epoll already, and its number may be reused. */
static void watch_card(struct kms_screen *s) {
    const int fd = gn_kms_fd(s->kms);
    if (fd == s->card.fd) return;
    gn_loop_remove(&s->card);
    s->card.fd = fd;
    if (fd < 0 || !gn_loop_add(s->opts.loop, &s->card)) s->card.fd = -1;
}

/* Updates sources and state after every call of the state machine. */
static bool update_screen(struct gn_display *display, bool ok, int64_t now_ns) {
    struct kms_screen *s = display->state;
    display->screen = *gn_kms_screen(s->kms);
    watch_card(s);
    s->timer.due_ns = gn_kms_deadline(s->kms, now_ns);
    return ok;
}

static void kms_close(struct gn_display *display) {
    struct kms_screen *s = display->state;
    if (!s) return;
    gn_loop_remove(&s->card);
    gn_loop_remove(&s->uevents);
    gn_loop_remove_timer(&s->timer);
    gn_kms_destroy(s->kms);
    if (s->scanout) gn_scanout_gbm.close(s->scanout);
    if (s->node >= 0) s->drm->close(s->node);
    gn_console_close(&s->console);
    if (s->uevents.fd >= 0) close(s->uevents.fd);
    free(s);
    display->state = NULL;
}

static struct kms_screen *create_screen(struct gn_display *display, struct gn_err *err) {
    const struct gn_drm_ops *drm = gn_drm_real(err);
    if (!drm) return NULL;
    struct kms_screen *s = display->state = gn_xalloc(1, sizeof *s);
    s->drm = drm;
    s->node = -1;
    s->card = (struct gn_watch){.fd = -1, .events = EPOLLIN, .call = on_card, .user = s};
    s->uevents = (struct gn_watch){.fd = -1, .events = EPOLLIN, .call = on_uevent, .user = s};
    s->console = (struct gn_console){.tty = -1};
    return s;
}

/* Off screen: the first card on which GL starts. */
static bool kms_open(struct gn_display *display, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_kms_node nodes[GN_KMS_CARDS_MAX];
    struct gn_err why = {0};
    (void)warnings;
    struct kms_screen *s = create_screen(display, err);
    if (!s) return false;
    const int count = s->drm->list(nodes, GN_KMS_CARDS_MAX);
    gn_fail(&why, "no card in /dev/dri; load the kernel driver of the display");
    for (int i = 0; i < count; i++) {
        const char *path = nodes[i].path;
        s->node = s->drm->open(path);
        if (s->node < 0) {
            gn_fail(&why, "%s: %s%s", path, strerror(errno),
                    errno == EACCES ? "; add the user to the group video" : "");
            continue;
        }
        s->drm->DropMaster(s->node); /* opening made us master, which would block other programs */
        s->scanout = gn_scanout_gbm.open(s->node, NULL, &why);
        if (s->scanout) return true;
        gn_fail_prefix(&why, "%s", path);
        s->drm->close(s->node);
        s->node = -1;
    }
    *err = why;
    kms_close(display);
    return false;
}

static bool kms_open_screen(struct gn_display *display, const struct gn_screen_opts *opts,
                            int64_t now_ns, struct gn_warnings *warnings, struct gn_err *err) {
    struct kms_screen *s = create_screen(display, err);
    if (!s) return false;
    s->opts = *opts;
    gn_console_open(&s->console, s->opts.loop, opts->locks_keys);
    if (opts->locks_keys && !s->console.locks_keys)
        gn_warn(warnings, "[display] console = locked: there is no text console to lock; start "
                          "gnomon on one, as gnomon.service does");
    s->uevents.fd = gn_uevent_open();
    s->timer.due_ns = GN_LOOP_NEVER;
    gn_loop_add_timer(s->opts.loop, &s->timer);
    if (s->uevents.fd >= 0 && !gn_loop_add(s->opts.loop, &s->uevents)) {
        gn_fail(err, "cannot wait for the display: %s", strerror(errno));
        kms_close(display);
        return false;
    }
    const struct gn_kms_env env = {.drm = s->drm,
                                   .scanout = &gn_scanout_gbm,
                                   .find_holder = gn_kms_find_holder,
                                   .no_uevents = s->uevents.fd < 0};
    s->kms = gn_kms_create(&env, &s->opts, now_ns);
    return update_screen(display, true, now_ns);
}

static bool kms_dispatch(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    const bool leaves = s->console.leaves;
    const unsigned events = s->events | (leaves ? GN_KMS_EVENT_VT_LEFT : 0) |
                            (s->console.entered ? GN_KMS_EVENT_VT_ENTERED : 0);
    s->events = 0;
    s->console.entered = false;
    const bool ok = gn_kms_step(s->kms, events, now_ns, err);
    if (leaves) gn_console_let_go(&s->console);
    return update_screen(display, ok, now_ns);
}

static bool kms_renew(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    watch_card(s); /* before another descriptor gets its number */
    return update_screen(display, gn_kms_renew(s->kms, now_ns, err), now_ns);
}

static bool kms_scale(struct gn_display *display, uint32_t width_px, uint32_t height_px) {
    const struct kms_screen *s = display->state;
    return gn_kms_scale(s->kms, width_px, height_px);
}

static bool kms_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    return update_screen(display, gn_kms_begin(s->kms, now_ns, err), now_ns);
}

static bool kms_present(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    return update_screen(display, gn_kms_present(s->kms, now_ns, err), now_ns);
}

static void kms_lose(struct gn_display *display, int64_t now_ns) {
    struct kms_screen *s = display->state;
    gn_kms_lose(s->kms, now_ns);
    update_screen(display, true, now_ns);
}

static void kms_blank(struct gn_display *display, bool on, int64_t now_ns) {
    struct kms_screen *s = display->state;
    gn_kms_blank(s->kms, on, now_ns);
    update_screen(display, true, now_ns);
}

static bool kms_show_message(struct gn_display *display, const char *text, int64_t now_ns) {
    struct kms_screen *s = display->state;
    gn_kms_show_message(s->kms, text, now_ns);
    return update_screen(display, true, now_ns);
}

static bool is_free(const struct gn_drm_ops *drm, const char *path, struct gn_kms_card *card) {
    const int fd = drm->open(path);
    const bool is = fd >= 0 && gn_kms_card_read(drm, fd, true, card, NULL) &&
                    gn_kms_card_score(card, NULL) > 0 &&
                    (drm->IsMaster(fd) || drm->SetMaster(fd) == 0);
    if (fd >= 0) drm->close(fd);
    return is;
}

static bool kms_is_free(void) {
    struct gn_kms_node nodes[GN_KMS_CARDS_MAX];
    const struct gn_drm_ops *drm = gn_drm_real(NULL);
    struct gn_kms_card *card = gn_xalloc(1, sizeof *card); /* too large for the stack */
    const int count = drm ? drm->list(nodes, GN_KMS_CARDS_MAX) : 0;
    bool found = false;
    for (int i = 0; i < count && !found; i++) found = is_free(drm, nodes[i].path, card);
    free(card);
    return found;
}

static gn_display_proc kms_get_proc(struct gn_display *display, const char *name) {
    struct kms_screen *s = display->state;
    return s->kms ? gn_kms_get_proc(s->kms, name) : gn_scanout_gbm.get_proc(s->scanout, name);
}

static const struct gn_screen_ops kms_screen_ops = {
    .open = kms_open_screen,
    .dispatch = kms_dispatch,
    .renew = kms_renew,
    .begin = kms_begin,
    .scale = kms_scale,
    .present = kms_present,
    .lose = kms_lose,
    .blank = kms_blank,
    .show_message = kms_show_message,
    .is_free = kms_is_free,
};

const struct gn_display_ops gn_display_kms = {
    .name = "kms",
    .is_console = true,
    .what = "full screen without a desktop (kernel modesetting)",
    .open = kms_open,
    .get_proc = kms_get_proc,
    .close = kms_close,
    .screen = &kms_screen_ops,
};
