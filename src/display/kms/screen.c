/* The screen on the kernel's modesetting, with its descriptors: the card's, the kernel's messages,
 * the console's signals and one timer, behind one epoll. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "display/kms/console.h"
#include "display/kms/kms.h"
#include "display/kms/uevent.h"
#include "display/kms/who.h"
#include "display/private.h"

struct kms_screen {
    const struct gn_drm_ops *drm;
    void *scanout; /* when it only draws off screen; else kms has one */
    int node;      /* and its card */
    struct gn_screen_opts opts;
    struct gn_kms *kms;
    struct gn_console console;
    int epoll, timer, uevents;
    int card;         /* the one that epoll watches */
    int64_t timer_ns; /* what it is set to */
};

static bool watch(struct kms_screen *s, int fd) {
    struct epoll_event event = {.events = EPOLLIN, .data.fd = fd};
    return fd < 0 || epoll_ctl(s->epoll, EPOLL_CTL_ADD, fd, &event) == 0;
}

/* A descriptor that was closed has left epoll by itself, and its number may be another's by now. */
static void watch_card(struct kms_screen *s) {
    const int card = gn_kms_fd(s->kms);
    if (card == s->card) return;
    if (s->card >= 0) epoll_ctl(s->epoll, EPOLL_CTL_DEL, s->card, NULL);
    s->card = watch(s, card) ? card : -1;
}

static void set_timer(struct kms_screen *s, int64_t at_ns) {
    if (at_ns == s->timer_ns) return;
    s->timer_ns = at_ns;
    const int64_t ns = at_ns == INT64_MAX ? 0 : at_ns > 0 ? at_ns : 1; /* 0 switches it off */
    const struct itimerspec when = {.it_value = {ns / 1000000000, ns % 1000000000}};
    timerfd_settime(s->timer, TFD_TIMER_ABSTIME, &when, NULL);
}

/* After every call into the machine. */
static bool settle(struct gn_display *display, bool ok, int64_t now_ns) {
    struct kms_screen *s = display->state;
    const int fd = display->screen.fd;
    display->screen = *gn_kms_screen(s->kms);
    display->screen.fd = fd;
    watch_card(s);
    set_timer(s, gn_kms_deadline(s->kms, now_ns));
    return ok;
}

static bool open_descriptors(struct kms_screen *s, struct gn_err *err) {
    s->epoll = epoll_create1(EPOLL_CLOEXEC);
    s->timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
    s->uevents = gn_uevent_open();
    if (s->epoll >= 0 && s->timer >= 0 && watch(s, s->timer) && watch(s, s->uevents) &&
        watch(s, s->console.signals))
        return true;
    return gn_fail(err, "cannot wait for the display: %s", strerror(errno));
}

static void kms_close(struct gn_display *display) {
    struct kms_screen *s = display->state;
    if (!s) return;
    gn_kms_destroy(s->kms);
    if (s->scanout) gn_scanout_gbm.close(s->scanout);
    if (s->node >= 0) s->drm->close(s->node);
    gn_console_close(&s->console);
    if (s->uevents >= 0) close(s->uevents);
    if (s->timer >= 0) close(s->timer);
    if (s->epoll >= 0) close(s->epoll);
    free(s);
    display->state = NULL;
}

static struct kms_screen *create(struct gn_display *display, struct gn_err *err) {
    const struct gn_drm_ops *drm = gn_drm_real(err);
    if (!drm) return NULL;
    struct kms_screen *s = display->state = gn_xalloc(1, sizeof *s);
    s->drm = drm;
    s->node = s->epoll = s->timer = s->uevents = s->card = -1;
    s->console = (struct gn_console){-1, -1};
    return s;
}

static bool draw_on(struct kms_screen *s, const char *path, struct gn_err *err) {
    s->node = s->drm->open(path);
    if (s->node < 0)
        return gn_fail(err, "%s: %s%s", path, strerror(errno),
                       errno == EACCES ? "; add the user to the group video" : "");
    s->drm->DropMaster(s->node); /* whoever shows something is not to be kept from it */
    s->scanout = gn_scanout_gbm.open(s->node, NULL, err);
    if (s->scanout) return true;
    s->drm->close(s->node);
    s->node = -1;
    return gn_fail_prefix(err, "%s", path);
}

/* Off screen: the first card with which GL starts. */
static bool kms_open(struct gn_display *display, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_kms_node nodes[GN_KMS_CARDS_MAX];
    struct gn_err why = {0};
    (void)warnings;
    struct kms_screen *s = create(display, err);
    if (!s) return false;
    const int count = s->drm->list(nodes, GN_KMS_CARDS_MAX);
    gn_fail(&why, "there is no card; load the kernel driver of the display");
    for (int i = 0; i < count; i++)
        if (draw_on(s, nodes[i].path, &why)) return true;
    *err = why;
    kms_close(display);
    return false;
}

static bool kms_open_screen(struct gn_display *display, const struct gn_screen_opts *opts,
                            int64_t now_ns, struct gn_warnings *warnings, struct gn_err *err) {
    (void)warnings;
    struct kms_screen *s = create(display, err);
    if (!s) return false;
    s->opts = *opts;
    gn_console_open(&s->console);
    if (!open_descriptors(s, err)) {
        kms_close(display);
        return false;
    }
    const struct gn_kms_env env = {
        .drm = s->drm, .scanout = &gn_scanout_gbm, .who = gn_kms_who, .deaf = s->uevents < 0};
    display->screen.fd = s->epoll;
    s->kms = gn_kms_create(&env, &s->opts, now_ns);
    return settle(display, true, now_ns);
}

static unsigned console_events(struct kms_screen *s) {
    bool left, entered;
    gn_console_read(&s->console, &left, &entered);
    return (left ? GN_KMS_EVENT_VT_LEFT : 0) | (entered ? GN_KMS_EVENT_VT_ENTERED : 0);
}

static unsigned events_of(struct kms_screen *s, int fd) {
    uint64_t ticks;
    if (fd == s->card) return GN_KMS_EVENT_READABLE;
    if (fd == s->console.signals) return console_events(s);
    if (fd == s->uevents) return gn_uevent_read(fd) ? GN_KMS_EVENT_HOTPLUG : 0;
    if (fd == s->timer && read(fd, &ticks, sizeof ticks) == sizeof ticks) s->timer_ns = 0;
    return 0;
}

static bool kms_dispatch(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    struct epoll_event ready[8];
    unsigned events = 0;
    const int count = epoll_wait(s->epoll, ready, 8, 0);
    for (int i = 0; i < count; i++) events |= events_of(s, ready[i].data.fd);
    const bool ok = gn_kms_step(s->kms, events, now_ns, err);
    if (events & GN_KMS_EVENT_VT_LEFT) gn_console_let_go(&s->console);
    return settle(display, ok, now_ns);
}

static bool kms_renew(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    watch_card(s); /* before another descriptor gets its number */
    return settle(display, gn_kms_renew(s->kms, now_ns, err), now_ns);
}

static bool kms_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    return settle(display, gn_kms_begin(s->kms, now_ns, err), now_ns);
}

static bool kms_present(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct kms_screen *s = display->state;
    return settle(display, gn_kms_present(s->kms, now_ns, err), now_ns);
}

static void kms_lose(struct gn_display *display, int64_t now_ns) {
    struct kms_screen *s = display->state;
    gn_kms_lose(s->kms, now_ns);
    settle(display, true, now_ns);
}

static void kms_blank(struct gn_display *display, bool on, int64_t now_ns) {
    struct kms_screen *s = display->state;
    gn_kms_blank(s->kms, on, now_ns);
    settle(display, true, now_ns);
}

static bool kms_say(struct gn_display *display, const char *text, int64_t now_ns) {
    struct kms_screen *s = display->state;
    gn_kms_say(s->kms, text, now_ns);
    return settle(display, true, now_ns);
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
    .present = kms_present,
    .lose = kms_lose,
    .blank = kms_blank,
    .say = kms_say,
    .is_free = kms_is_free,
};

const struct gn_display_ops gn_display_kms = {
    .name = "kms",
    .is_console = true,
    .what = "full screen without a desktop (the kernel's modesetting)",
    .open = kms_open,
    .get_proc = kms_get_proc,
    .close = kms_close,
    .screen = &kms_screen_ops,
};
