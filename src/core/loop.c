#include "core/loop.h"

#include <assert.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"

enum { READY_MAX = 64 }; /* per call; the rest is ready in the next */

struct list {
    struct gn_loop_link *first, *last;
};
struct gn_loop {
    int epoll, timer;
    int64_t armed_ns;  /* of the timerfd; GN_LOOP_NEVER: disarmed */
    int64_t *clock_ns; /* NULL: the real one */
    struct list watches, timers;
    struct gn_loop_link *cursor; /* the source to be visited next */
    bool runs;
};

/* ---- sources -------------------------------------------------------------------------------- */

static void append_link(struct gn_loop *loop, struct list *list, struct gn_loop_link *link) {
    *link = (struct gn_loop_link){.loop = loop, .previous = list->last};
    *(list->last ? &list->last->next : &list->first) = link;
    list->last = link;
}

static void remove_link(struct list *list, struct gn_loop_link *link) {
    if (link->loop->cursor == link) link->loop->cursor = link->next;
    *(link->previous ? &link->previous->next : &list->first) = link->next;
    *(link->next ? &link->next->previous : &list->last) = link->previous;
    *link = (struct gn_loop_link){0};
}

bool gn_loop_add(struct gn_loop *loop, struct gn_watch *watch) {
    struct epoll_event event = {.events = watch->events, .data.ptr = watch};
    if (epoll_ctl(loop->epoll, EPOLL_CTL_ADD, watch->fd, &event) != 0) return false;
    watch->ready = 0;
    append_link(loop, &loop->watches, &watch->link);
    return true;
}

void gn_loop_remove(struct gn_watch *watch) {
    struct gn_loop *loop = watch->link.loop;
    if (!loop) return;
    epoll_ctl(loop->epoll, EPOLL_CTL_DEL, watch->fd, NULL);
    remove_link(&loop->watches, &watch->link);
}

void gn_loop_add_timer(struct gn_loop *loop, struct gn_timer *timer) {
    append_link(loop, &loop->timers, &timer->link);
}

void gn_loop_remove_timer(struct gn_timer *timer) {
    if (timer->link.loop) remove_link(&timer->link.loop->timers, &timer->link);
}

static void read_signals(void *user, int64_t now_ns) {
    struct gn_signals *signals = user;
    struct signalfd_siginfo info;
    (void)now_ns;
    while (signals->watch.link.loop && read(signals->watch.fd, &info, sizeof info) == sizeof info)
        signals->call(signals->user, (int)info.ssi_signo);
}

bool gn_loop_add_signals(struct gn_loop *loop, struct gn_signals *signals, const sigset_t *set) {
    sigprocmask(SIG_BLOCK, set, NULL);
    signals->watch = (struct gn_watch){
        .fd = signalfd(-1, set, SFD_CLOEXEC | SFD_NONBLOCK),
        .events = EPOLLIN,
        .call = read_signals,
        .user = signals,
    };
    if (signals->watch.fd >= 0 && gn_loop_add(loop, &signals->watch)) return true;
    if (signals->watch.fd >= 0) close(signals->watch.fd);
    signals->watch.fd = -1;
    return false;
}

void gn_loop_remove_signals(struct gn_signals *signals) {
    if (!signals->watch.link.loop) return;
    gn_loop_remove(&signals->watch);
    close(signals->watch.fd);
    signals->watch.fd = -1;
}

/* ---- the loop ------------------------------------------------------------------------------- */

struct gn_loop *gn_loop_open(struct gn_err *err) {
    struct gn_loop *loop = gn_xalloc(1, sizeof *loop);
    struct epoll_event event = {.events = EPOLLIN}; /* data.ptr NULL: the timer */
    loop->armed_ns = GN_LOOP_NEVER;
    loop->epoll = epoll_create1(EPOLL_CLOEXEC);
    loop->timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
    if (loop->epoll >= 0 && loop->timer >= 0 &&
        epoll_ctl(loop->epoll, EPOLL_CTL_ADD, loop->timer, &event) == 0)
        return loop;
    gn_fail(err, "cannot make an event loop: %s", strerror(errno));
    gn_loop_close(loop);
    return NULL;
}

void gn_loop_close(struct gn_loop *loop) {
    if (!loop) return;
    assert(!loop->runs);
    while (loop->watches.first) gn_loop_remove((struct gn_watch *)loop->watches.first);
    while (loop->timers.first) gn_loop_remove_timer((struct gn_timer *)loop->timers.first);
    if (loop->timer >= 0) close(loop->timer);
    if (loop->epoll >= 0) close(loop->epoll);
    free(loop);
}

void gn_loop_fake_clock(struct gn_loop *loop, int64_t *clock_ns) { loop->clock_ns = clock_ns; }

int64_t gn_loop_now_ns(const struct gn_loop *loop) {
    return loop->clock_ns ? *loop->clock_ns : gn_clock_monotonic_ns();
}

/* Collects what is ready into the watches; returns how many are. */
static int collect_events(struct gn_loop *loop, int timeout_ms) {
    struct epoll_event events[READY_MAX];
    int count, ready = 0;
    while ((count = epoll_wait(loop->epoll, events, READY_MAX, timeout_ms)) < 0)
        if (errno != EINTR) abort(); /* the supervisor restarts */
    for (int i = 0; i < count; i++) {
        struct gn_watch *watch = events[i].data.ptr;
        if (!watch) continue;
        watch->ready |= events[i].events;
        ready++;
    }
    return ready;
}

static int call_watches(struct gn_loop *loop, int64_t now_ns) {
    int calls = 0;
    for (loop->cursor = loop->watches.first; loop->cursor;) {
        struct gn_watch *watch = (struct gn_watch *)loop->cursor;
        loop->cursor = watch->link.next;
        watch->came = watch->ready;
        watch->ready = 0;
        if (!watch->came) continue;
        calls++;
        if (watch->call) watch->call(watch->user, now_ns);
    }
    return calls;
}

static int call_timers(struct gn_loop *loop, int64_t now_ns) {
    int calls = 0;
    for (loop->cursor = loop->timers.first; loop->cursor;) {
        struct gn_timer *timer = (struct gn_timer *)loop->cursor;
        loop->cursor = timer->link.next;
        if (timer->due_ns > now_ns) continue;
        timer->due_ns = GN_LOOP_NEVER;
        calls++;
        if (timer->call) timer->call(timer->user, now_ns);
    }
    return calls;
}

int gn_loop_step(struct gn_loop *loop, int64_t until_ns) {
    assert(!loop->runs);
    for (const struct gn_loop_link *at = loop->timers.first; at; at = at->next) {
        const int64_t due_ns = ((const struct gn_timer *)at)->due_ns;
        if (due_ns < until_ns) until_ns = due_ns;
    }
    int ready = 0;
    if (!loop->clock_ns && until_ns > gn_clock_monotonic_ns()) {
        /* an expired timerfd stays readable until it is armed again, so it is never read */
        if (until_ns != loop->armed_ns) {
            const int64_t ns = until_ns == GN_LOOP_NEVER ? 0 : until_ns; /* 0 disarms it */
            const struct itimerspec when = {.it_value = {ns / GN_NS_PER_S, ns % GN_NS_PER_S}};
            loop->armed_ns = until_ns;
            timerfd_settime(loop->timer, TFD_TIMER_ABSTIME, &when, NULL);
        }
        ready = collect_events(loop, -1);
    }
    int64_t now_ns = gn_loop_now_ns(loop);
    ready +=
        collect_events(loop, 0); /* what came between the wait and now_ns is from before now_ns */
    if (!ready && loop->clock_ns && until_ns > now_ns && until_ns < GN_LOOP_NEVER)
        now_ns = *loop->clock_ns = until_ns;
    loop->runs = true;
    int calls = ready ? call_watches(loop, now_ns) : 0;
    calls += call_timers(loop, now_ns);
    loop->runs = false;
    return calls;
}
