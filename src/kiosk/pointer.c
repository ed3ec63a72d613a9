#include "kiosk/pointer.h"

static const float NOTCH = 0.1f; /* of a wheel: log of the change of distance */

/* A drag in the window as a drag on the picture, which is drawn turned clockwise. */
static void turn_back(const struct gn_screen *screen, const float drag[2], float out[2]) {
    static const float turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const float *t = turns[screen->rotate_deg / 90 % 4];
    const float height = t[0] == 0.0f ? (float)screen->height_px / (float)screen->width_px : 1.0f;
    out[0] = height * (t[0] * drag[0] - t[1] * drag[1]);
    out[1] = height * (t[1] * drag[0] + t[0] * drag[1]);
}

static float aspect_of(const struct gn_screen *screen) {
    const float aspect = (float)screen->width_px / (float)screen->height_px;
    return screen->rotate_deg / 90 % 2 ? 1.0f / aspect : aspect;
}

static bool moves_nothing(const struct gn_pointer *h) {
    return !h->home && h->turn[0] == 0.0f && h->turn[1] == 0.0f && h->pan[0] == 0.0f &&
           h->pan[1] == 0.0f && h->wheel == 0.0f;
}

bool gn_show_pointer_turn(struct gn_stage *stage, const struct gn_pointer *pointer) {
    const struct gn_screen *screen = &stage->display.screen;
    struct gn_frame_opts *f = &stage->frame_opts;
    if (screen->width_px == 0 || screen->height_px == 0 || moves_nothing(pointer)) return false;
    struct gn_orbit_hand moves = {.zoom = NOTCH * pointer->wheel, .aspect = aspect_of(screen)};
    turn_back(screen, pointer->turn, moves.turn);
    turn_back(screen, pointer->pan, moves.pan);
    if (pointer->home) f->view.orbit = (struct gn_orbit){0};
    f->view.orbit = gn_orbit_step(&f->view.orbit, &moves, &stage->pose, (uint32_t)f->view.camera);
    return true;
}
