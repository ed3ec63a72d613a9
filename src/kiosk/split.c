#include "kiosk/split.h"

#include <math.h>

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
        gn_show_note(s, "%s: the only mode", s->show->modes.titles[0]);
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

void gn_split_take_pointer(struct gn_show_screen *s, struct gn_pointer *p) {
    struct gn_show_split *split = &s->split;
    const float width = (float)s->stage.display.screen.width_px;
    if (!split->on) return;
    if (p->pressed) split->grips = fabsf(p->press_x - split->at) * width <= REACH_PX;
    if (split->grips && p->dragged) {
        split->at = p->drag_x < 0.0f ? 0.0f : p->drag_x > 1.0f ? 1.0f : p->drag_x;
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

static void fill_line(struct gn_gl *gl, uint32_t from, uint32_t to, uint32_t y, uint32_t top) {
    gn_gl_fill(gl, &(struct gn_rect){from, y, to - from, top - y}, 0.0f);
    if (to - from > 2) gn_gl_fill(gl, &(struct gn_rect){from + 1, y, to - from - 2, top - y}, 1.0f);
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
    const struct gn_frame_opts *f = &s->stage.shown.opts;
    const uint32_t width = f->output.width_px, at = (uint32_t)lroundf(s->split.at * (float)width),
                   from = at > LINE_PX ? at - LINE_PX : 0,
                   to = at + LINE_PX < width ? at + LINE_PX : width;
    const int32_t height = (int32_t)f->output.height_px;
    gn_gl_lay_beside(s->stage.gl, at);
    for (int32_t row = 0, end = height; row < height; row = end, end = height)
        if (!find_ground(f->output.turn_deg ? NULL : f->cover.captions, from, to, row, &end))
            fill_line(s->stage.gl, from, to, (uint32_t)(height - end), (uint32_t)(height - row));
}
