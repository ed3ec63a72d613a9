#include "kiosk/split.h"

#include <math.h>

#include "core/turn.h"
#include "kiosk/private.h"

enum { REACH_PX = 12, LINE_PX = 2 }; /* of the mouse to each side of the line; the line's half */

void gn_split_end(struct gn_show_screen *s) {
    if (s->truth.on) gn_truth_end(s);
    gn_view_close(&s->split.view, s->stage.gl);
    s->split = (struct gn_show_split){.at = s->split.at};
    s->changed = true;
}

void gn_split_toggle(struct gn_show_screen *s) {
    const struct gn_action next = {.kind = GN_ACTION_NEXT};
    if (s->split.on) {
        gn_split_end(s);
        return;
    }
    if (s->show->modes.count < 2) {
        gn_show_note(s, "There is only this view");
        return;
    }
    s->split = (struct gn_show_split){.on = true, .left = s->kiosk.shown.mode, .at = 0.5f};
    gn_show_act(s, &next, gn_loop_now_ns(s->show->loop));
    s->changed = true;
}

/* The truth of the mode that is on the right, else of the one that is shown. */
void gn_split_toggle_truth(struct gn_show_screen *s) {
    const bool on = s->truth.on;
    if (on)
        gn_truth_end(s);
    else
        gn_truth_begin(s);
    if (on && s->split.left == s->kiosk.shown.mode)
        gn_split_end(s);
    else if (s->truth.on && !s->split.on)
        s->split = (struct gn_show_split){.on = true, .left = s->kiosk.shown.mode, .at = 0.5f};
}

/* A place in the window, right and down, as a share of the upright picture's width. */
static float across_picture(unsigned turn_deg, const float at[2]) {
    switch (turn_deg) {
    case 90: return at[1];
    case 180: return 1.0f - at[0];
    case 270: return 1.0f - at[1];
    default: return at[0];
    }
}

void gn_split_take_pointer(struct gn_show_screen *s, struct gn_pointer *p) {
    struct gn_show_split *split = &s->split;
    const struct gn_screen *screen = &s->stage.display.screen;
    const unsigned turn_deg = screen->rotate_deg;
    const float width = (float)(turn_deg % 180 ? screen->height_px : screen->width_px);
    if (!split->on) return;
    if (p->pressed)
        split->grips = fabsf(across_picture(turn_deg, p->press) - split->at) * width <= REACH_PX;
    if (split->grips && p->dragged) {
        split->at = fminf(fmaxf(across_picture(turn_deg, p->drag), 0.0f), 1.0f);
        s->changed = true;
    }
    if (split->grips) p->turn[0] = p->turn[1] = 0.0f;
    if (p->released) split->grips = false;
}

const struct gn_plan *gn_split_draw_left(struct gn_show_screen *s, int64_t time_ns,
                                         struct gn_err *err) {
    struct gn_view *left = &s->split.view;
    gn_view_share(left, GN_VIEW_LEFT, &s->stage.shown, &s->looks.of[s->split.left].frame_opts);
    const struct gn_plan *plan = gn_view_draw(left, &s->stage, time_ns, s->show->warnings, err);
    return plan && gn_gl_keep(s->stage.gl, err) ? plan : NULL;
}

/* ---- over the right mode's picture; upright, rows from the top ---- */

struct upright {
    struct gn_gl *gl;
    unsigned turn_deg;
    uint32_t width_px, height_px;
};

static struct gn_rect part_of(const struct upright *u, uint32_t left, uint32_t right, uint32_t top,
                              uint32_t bottom) {
    const struct gn_rect part = {left, u->height_px - bottom, right - left, bottom - top};
    return gn_frame_turned_rect(u->turn_deg, u->width_px, u->height_px, part);
}

static void fill_line(const struct upright *u, uint32_t left, uint32_t right, uint32_t top,
                      uint32_t bottom) {
    const struct gn_rect all = part_of(u, left, right, top, bottom);
    gn_gl_fill(u->gl, &all, 0.0f);
    if (right - left <= 2) return;
    const struct gn_rect inside = part_of(u, left + 1, right - 1, top, bottom);
    gn_gl_fill(u->gl, &inside, 1.0f);
}

/* Whether a text has a ground in that row, top row first, of those columns; *end: where that
 * changes. */
static bool find_ground(const struct gn_caption_run *run, uint32_t from, uint32_t to, int32_t row,
                        int32_t *end) {
    for (uint32_t i = 0; run && i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        if (!q->ground || run->alpha[q->caption] == 0 || q->x >= (int32_t)to ||
            q->x + q->width <= (int32_t)from || q->y + q->height <= row)
            continue;
        if (q->y <= row) {
            *end = q->y + q->height;
            return true;
        }
        if (q->y < *end) *end = q->y;
    }
    return false;
}

/* The line lies below texts and its handle, which are drawn already. */
void gn_split_lay_over(struct gn_show_screen *s) {
    const struct gn_frame_output_opts *o = &s->stage.shown.opts.output;
    const struct gn_turned_size size = gn_turned_upright(o->turn_deg, o->width_px, o->height_px);
    const struct upright u = {s->stage.gl, o->turn_deg, size.width_px, size.height_px};
    const uint32_t at = (uint32_t)lroundf(s->split.at * (float)u.width_px),
                   left = at > LINE_PX ? at - LINE_PX : 0,
                   right = at + LINE_PX < u.width_px ? at + LINE_PX : u.width_px;
    const struct gn_rect kept = part_of(&u, 0, at, 0, u.height_px);
    const int32_t height = (int32_t)u.height_px;
    gn_gl_lay_part(u.gl, &kept);
    for (int32_t row = 0, end = height; row < height; row = end, end = height)
        if (!find_ground(s->stage.shown.opts.cover.captions, left, right, row, &end))
            fill_line(&u, left, right, (uint32_t)row, (uint32_t)end);
}
