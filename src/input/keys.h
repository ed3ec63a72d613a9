/* Maps keys to buttons; tracks which source holds which key. */
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
    uint8_t bound[GN_KEY_BYTES];    /* bit key % 8 of byte key / 8: bound to a button */
    struct gn_gestures *gestures;   /* receives the events */
};
struct gn_key_source { /* a device with keys; ready when zeroed */
    uint8_t down[GN_KEY_BYTES];
};

/* names: keys, separated by spaces. */
bool gn_keys_bind(struct gn_keys *keys, int button, const char *names, struct gn_err *err);

bool gn_key_is_down(const uint8_t *bits, unsigned key);
/* Sets the state of a key; unchanged states and unbound keys are ignored. */
void gn_keys_set(struct gn_keys *keys, struct gn_key_source *source, unsigned key, bool down,
                 int64_t time_ns);
/* Sets the state of all keys (GN_KEY_BYTES); differences become events. first: keys that are down
 * were pressed before the source was opened. */
void gn_keys_set_all(struct gn_keys *keys, struct gn_key_source *source, const uint8_t *bits,
                     bool first, int64_t time_ns);
/* The source is gone. */
void gn_keys_lose(struct gn_keys *keys, struct gn_key_source *source, int64_t time_ns);
/* For sources without release events. */
void gn_keys_click(struct gn_keys *keys, unsigned key, int64_t time_ns);

#endif
