/* Which keys are which buttons, and which are down on whom. */
#ifndef GN_INPUT_KEYS_H
#define GN_INPUT_KEYS_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"
#include "core/key.h"
#include "input/gesture.h"

enum { GN_KEY_BYTES = GN_KEY_COUNT / 8 };

struct gn_keys {
    uint32_t buttons[GN_KEY_COUNT]; /* bits 1 << button */
    uint8_t bound[GN_KEY_BYTES];    /* bit key % 8 of byte key / 8: some button's */
    struct gn_gestures *gestures;   /* where they go */
};
struct gn_key_source { /* a keyboard, the window, .. ; zeroed is ready */
    uint8_t down[GN_KEY_BYTES];
};

/* names: of keys, a space between two. */
bool gn_keys_bind(struct gn_keys *keys, int button, const char *names, struct gn_err *err);

bool gn_key_is_down(const uint8_t *bits, unsigned key);
/* Says where a key is; no news is no event, and keys of no button are none. */
void gn_keys_set(struct gn_keys *keys, struct gn_key_source *source, unsigned key, bool down,
                 int64_t time_ns);
/* These keys (GN_KEY_BYTES) are down, and the others up: what differs happens now. first: they have
 * been so since before anybody listened. */
void gn_keys_set_all(struct gn_keys *keys, struct gn_key_source *source, const uint8_t *bits,
                     bool first, int64_t time_ns);
/* The source is gone. */
void gn_keys_lose(struct gn_keys *keys, struct gn_key_source *source, int64_t time_ns);
/* For those that do not know when it is released. */
void gn_keys_click(struct gn_keys *keys, unsigned key, int64_t time_ns);

#endif
