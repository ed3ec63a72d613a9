#include "display/pointer.h"

bool gn_pointer_is_zero(const struct gn_pointer *h) {
    return !h->quit && !h->home && h->key_count == 0 && !h->file && !h->pressed && !h->dragged &&
           !h->released && h->turn[0] == 0.0f && h->turn[1] == 0.0f && h->pan[0] == 0.0f &&
           h->pan[1] == 0.0f && h->wheel == 0.0f;
}

void gn_pointer_add(struct gn_pointer *pointer, const struct gn_pointer *more) {
    if (more->home) gn_pointer_act(pointer, GN_POINTER_HOME);
    if (more->quit) gn_pointer_act(pointer, GN_POINTER_QUIT);
    for (int k = 0; k < 2; k++) {
        pointer->turn[k] += more->turn[k];
        pointer->pan[k] += more->pan[k];
    }
    pointer->wheel += more->wheel;
    for (unsigned i = 0; i < more->key_count; i++) {
        gn_pointer_key(pointer, &more->keys[i]);
        if (more->letters[i]) gn_pointer_letter(pointer, (unsigned char)more->letters[i]);
    }
    if (more->file) pointer->file = more->file;
    for (int k = 0; k < 2; k++) {
        if (more->pressed) pointer->press[k] = more->press[k];
        if (more->dragged) pointer->drag[k] = more->drag[k];
    }
    pointer->pressed |= more->pressed;
    pointer->dragged |= more->dragged;
    pointer->released |= more->released;
}

void gn_pointer_key(struct gn_pointer *pointer, const struct gn_key_event *event) {
    if (pointer->key_count == GN_POINTER_KEYS_MAX) return;
    pointer->letters[pointer->key_count] = 0;
    pointer->keys[pointer->key_count++] = *event;
}

void gn_pointer_letter(struct gn_pointer *p, unsigned letter) {
    static const struct gn_key_event bare = {.key = GN_KEY_NONE, .down = true};
    if (letter <= ' ' || letter >= 127) return;
    const unsigned last = p->key_count - 1;
    if (p->key_count == 0 || !p->keys[last].down || p->letters[last]) gn_pointer_key(p, &bare);
    if (p->letters[p->key_count - 1] == 0) p->letters[p->key_count - 1] = (char)letter;
}

void gn_pointer_act(struct gn_pointer *pointer, enum gn_pointer_key action) {
    if (action == GN_POINTER_QUIT) pointer->quit = true;
    if (action != GN_POINTER_HOME) return;
    pointer->home = true;
    pointer->turn[0] = pointer->turn[1] = pointer->pan[0] = pointer->pan[1] = pointer->wheel = 0.0f;
}

void gn_drag_button(struct gn_drag *p, enum gn_button button, bool down, bool shift) {
    if (!p->drags && down) {
        p->drags = true;
        p->button = button;
        p->pans = shift || button != GN_BUTTON_LEFT;
    } else if (p->drags && !down && button == p->button)
        p->drags = false;
}

void gn_drag_move(struct gn_drag *p, double x, double y, double height,
                  struct gn_pointer *pointer) {
    float *drag = p->pans ? pointer->pan : pointer->turn;
    if (p->drags && height > 0.0) {
        drag[0] += (float)((x - p->x) / height);
        drag[1] -= (float)((y - p->y) / height);
    }
    p->x = x;
    p->y = y;
}
