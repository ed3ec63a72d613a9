/* Headless screen, 60 Hz by a timer; used by the kiosk's tests. */
#include <stdlib.h>

#include "core/arena.h"
#include "core/clock.h"
#include "display/kms/flip.h"
#include "display/private.h"

struct headless {
    struct gn_flip flip;
    struct gn_timer timer; /* of the pending flip */
};

static bool update_screen(struct gn_display *display, int64_t now_ns) {
    struct headless *h = display->headless;
    struct gn_flip *flip = &h->flip;
    struct gn_screen *s = &display->screen;
    s->lit = !s->blank;
    s->may_draw = s->lit && gn_flip_may_draw(flip, now_ns);
    s->seen_ns = gn_flip_seen_ns(flip, now_ns);
    s->counts.shown = flip->shown;
    s->counts.missed = flip->missed;
    h->timer.due_ns = gn_flip_deadline(flip, now_ns);
    return true;
}

static bool headless_open(struct gn_display *display, const struct gn_screen_opts *opts,
                          int64_t now_ns, struct gn_warnings *warnings, struct gn_err *err) {
    (void)warnings, (void)err;
    struct gn_screen *s = &display->screen;
    struct headless *h = display->headless = gn_xalloc(1, sizeof *h);
    struct gn_flip *flip = &h->flip;
    flip->no_vblank = true;
    flip->period_ns = GN_NS_PER_S / 60;
    flip->shortest_ns = opts->max_fps > 0 ? GN_NS_PER_S / opts->max_fps : 0;
    *s = (struct gn_screen){
        .has_context = true,
        .generation = 1,
        .lit = true,
        .width_px = opts->width_px ? opts->width_px : 1280,
        .height_px = opts->height_px ? opts->height_px : 720,
        .rotate_deg = opts->rotate_deg,
        .period_ns = flip->period_ns,
    };
    gn_loop_add_timer(opts->loop, &h->timer);
    return update_screen(display, now_ns);
}

static bool headless_step(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    return update_screen(display, now_ns);
}

static bool headless_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    if (!display->screen.may_draw) return false;
    struct headless *h = display->headless;
    gn_flip_begun(&h->flip, now_ns);
    return update_screen(display, now_ns);
}

static bool headless_present(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    (void)err;
    struct headless *h = display->headless;
    gn_flip_committed(&h->flip, now_ns);
    gn_flip_done(&h->flip, now_ns, now_ns);
    return update_screen(display, now_ns);
}

static void headless_blank(struct gn_display *display, bool on, int64_t now_ns) {
    display->screen.blank = on;
    update_screen(display, now_ns);
}

void gn_screen_headless_close(struct gn_display *display) {
    struct headless *h = display->headless;
    if (!h) return;
    gn_loop_remove_timer(&h->timer);
    free(h);
    display->headless = NULL;
}

const struct gn_screen_ops gn_screen_headless = {
    .open = headless_open,
    .dispatch = headless_step,
    .renew = headless_step,
    .begin = headless_begin,
    .present = headless_present,
    .blank = headless_blank,
};
