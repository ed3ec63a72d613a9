/* A script being played: clicks split into down and up, names resolved. */
#ifndef GN_INPUT_PLAY_H
#define GN_INPUT_PLAY_H

#include "core/arena.h"
#include "input/keys.h"

struct gn_play_step {
    int64_t time_ns; /* monotonic */
    bool down;
    int button;   /* -1: a key */
    unsigned key; /* GN_KEY_NONE for a button */
};
struct gn_play { /* ready when zeroed */
    struct gn_arena arena;
    struct gn_play_step *steps;
    int count, next;
    uint32_t buttons; /* bits 1 << button used in the script */
    struct gn_key_source source;
};

/* names: of the buttons, by index. Fails as reading or parsing does. */
bool gn_play_load(struct gn_play *play, const char *path, const char *const *names, int count,
                  int64_t now_ns, struct gn_err *err);

#endif
