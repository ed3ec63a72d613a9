#include "kiosk/pointer.h"

static const float NOTCH = 0.1f; /* logarithm of the change of distance per notch of the wheel */

static const float turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}; /* by quarters */

/* Converts a drag in the window to the picture, which is drawn rotated clockwise. */
static void turn_back(const struct gn_screen *screen, const float drag[2], float out[2]) {
    const float *t = turns[screen->rotate_deg / 90 % 4];
    const float height = t[0] == 0.0f ? (float)screen->height_px / (float)screen->width_px : 1.0f;
    out[0] = height * (t[0] * drag[0] - t[1] * drag[1]);
    out[1] = height * (t[1] * drag[0] + t[0] * drag[1]);
}

/* The other way round: the right of a mouse is that of who looks at the picture. */
static void add_turned(const struct gn_screen *screen, const float move[2], float out[2]) {
    const float *t = turns[screen->rotate_deg / 90 % 4];
    const float height = t[0] == 0.0f ? (float)screen->height_px / (float)screen->width_px : 1.0f;
    out[0] += (t[0] * move[0] + t[1] * move[1]) / height;
    out[1] += (t[0] * move[1] - t[1] * move[0]) / height;
}

static void add_on_glass(const struct gn_screen *screen, const float move[2], float out[2]) {
    out[0] += move[0] * (float)screen->width_px / (float)screen->height_px;
    out[1] += move[1];
}

void gn_show_pointer_add(const struct gn_screen *screen, const struct gn_input_moves *m,
                         struct gn_pointer *p) {
    if (screen->width_px == 0 || screen->height_px == 0) return;
    add_on_glass(screen, m->glass.turn, p->turn);
    add_on_glass(screen, m->glass.pan, p->pan);
    add_turned(screen, m->mouse.turn, p->turn);
    add_turned(screen, m->mouse.pan, p->pan);
    p->wheel += m->glass.wheel + m->mouse.wheel + (m->glass.zoom + m->mouse.zoom) / NOTCH;
}

bool gn_show_pointer_turn(struct gn_stage *stage, const struct gn_pointer *p) {
    const struct gn_screen *screen = &stage->display.screen;
    struct gn_frame_opts *f = &stage->shown.opts;
    const bool moved = p->home || p->turn[0] != 0.0f || p->turn[1] != 0.0f || p->pan[0] != 0.0f ||
                       p->pan[1] != 0.0f || p->wheel != 0.0f;
    if (screen->width_px == 0 || screen->height_px == 0 || !moved) return false;
    const float aspect = (float)screen->width_px / (float)screen->height_px;
    struct gn_orbit_hand moves = {.zoom = NOTCH * p->wheel};
    struct gn_framing_opts framing = f->view.framing;
    framing.aspect = screen->rotate_deg / 90 % 2 ? 1.0f / aspect : aspect;
    turn_back(screen, p->turn, moves.turn);
    turn_back(screen, p->pan, moves.pan);
    if (p->home) f->view.orbit = (struct gn_orbit){0};
    f->view.orbit =
        gn_orbit_step(&f->view.orbit, &moves, &stage->pose, (uint32_t)f->view.camera, &framing);
    return true;
}
