/* Terminal bytes to keys. Pure. A terminal does not report releases, so each key is a click. */
#ifndef GN_INPUT_TERMINAL_KEYS_H
#define GN_INPUT_TERMINAL_KEYS_H

#include <stdbool.h>
#include <stdint.h>

#define GN_TERMINAL_ESC_NS INT64_C(50000000) /* timeout of a lone ESC */

struct gn_terminal_keys { /* ready when zeroed */
    int state;            /* state of the parser: an enum of terminal_keys.c */
    int number;           /* its first parameter, at most 99 */
    bool more;            /* parameters after the first */
    int64_t esc_ns;       /* when the sequence began */
};

/* Returns the key completed by this byte, or GN_KEY_NONE. Characters map to a US keyboard; shift,
 * control and alt are ignored. */
unsigned gn_terminal_keys_step(struct gn_terminal_keys *keys, uint8_t byte, int64_t now_ns);
/* GN_KEY_ESC once the timeout of a lone ESC is over, once; else GN_KEY_NONE. */
unsigned gn_terminal_keys_wait(struct gn_terminal_keys *keys, int64_t now_ns);
int64_t gn_terminal_keys_deadline(const struct gn_terminal_keys *keys); /* INT64_MAX: none */

#endif
