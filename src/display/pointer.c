#include "display/pointer.h"

bool gn_hand_is_zero(const struct gn_hand *h) {
    return !h->quit && !h->home && h->key_count == 0 && h->turn[0] == 0.0f && h->turn[1] == 0.0f &&
           h->pan[0] == 0.0f && h->pan[1] == 0.0f && h->wheel == 0.0f;
}

void gn_hand_add(struct gn_hand *hand, const struct gn_hand *more) {
    if (more->home) gn_hand_act(hand, GN_HAND_HOME);
    if (more->quit) gn_hand_act(hand, GN_HAND_QUIT);
    for (int k = 0; k < 2; k++) {
        hand->turn[k] += more->turn[k];
        hand->pan[k] += more->pan[k];
    }
    hand->wheel += more->wheel;
    for (unsigned i = 0; i < more->key_count; i++) gn_hand_key(hand, &more->keys[i]);
}

void gn_hand_key(struct gn_hand *hand, const struct gn_key_event *event) {
    if (hand->key_count < GN_HAND_KEYS_MAX) hand->keys[hand->key_count++] = *event;
}

void gn_hand_act(struct gn_hand *hand, enum gn_hand_key action) {
    if (action == GN_HAND_QUIT) hand->quit = true;
    if (action != GN_HAND_HOME) return;
    hand->home = true;
    hand->turn[0] = hand->turn[1] = hand->pan[0] = hand->pan[1] = hand->wheel = 0.0f;
}

void gn_pointer_button(struct gn_pointer *p, enum gn_button button, bool down, bool shift) {
    if (!p->drags && down) {
        p->drags = true;
        p->button = button;
        p->pans = shift || button != GN_BUTTON_LEFT;
    } else if (p->drags && !down && button == p->button)
        p->drags = false;
}

void gn_pointer_move(struct gn_pointer *p, double x, double y, double height,
                     struct gn_hand *hand) {
    float *drag = p->pans ? hand->pan : hand->turn;
    if (p->drags && height > 0.0) {
        drag[0] += (float)((x - p->x) / height);
        drag[1] -= (float)((y - p->y) / height);
    }
    p->x = x;
    p->y = y;
}
