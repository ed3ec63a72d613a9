/* What a terminal sends, as keys: bytes in, one key after another out. Pure. A terminal does not
 * tell when a key is released, so each is a click. */
#ifndef GN_INPUT_TERMINAL_KEYS_H
#define GN_INPUT_TERMINAL_KEYS_H

#include <stdbool.h>
#include <stdint.h>

#define GN_TERMINAL_ESC_NS INT64_C(50000000) /* an ESC after which nothing comes is the key */

struct gn_terminal_keys { /* zeroed is ready */
    int state;            /* where in an escape sequence: an enum of terminal_keys.c */
    int number;           /* its first parameter, at most 99 */
    bool more;            /* parameters after the first */
    int64_t esc_ns;       /* when it began */
};

/* The key that this byte completes, or GN_KEY_NONE. Keys are where an American keyboard has what
 * was typed; shift, control and alt are not told apart. */
unsigned gn_terminal_keys_step(struct gn_terminal_keys *keys, uint8_t byte, int64_t now_ns);
/* GN_KEY_ESC when the time of a lone ESC is over, once; else GN_KEY_NONE. */
unsigned gn_terminal_keys_wait(struct gn_terminal_keys *keys, int64_t now_ns);
int64_t gn_terminal_keys_deadline(const struct gn_terminal_keys *keys); /* INT64_MAX: none */

#endif
