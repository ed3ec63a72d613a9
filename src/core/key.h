/* Key codes of Linux (linux/input-event-codes.h), for keys of input devices, windows and terminals.
 */
#ifndef GN_CORE_KEY_H
#define GN_CORE_KEY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum gn_key { /* keys that the code names; the table in key.c has more */
              GN_KEY_NONE = 0,
              GN_KEY_ESC = 1,
              GN_KEY_BACKSPACE = 14,
              GN_KEY_TAB = 15,
              GN_KEY_ENTER = 28,
              GN_KEY_N = 49,
              GN_KEY_SPACE = 57,
              GN_KEY_F1 = 59,
              GN_KEY_F5 = 63,
              GN_KEY_F12 = 88,
              GN_KEY_HOME = 102,
              GN_KEY_UP = 103,
              GN_KEY_PAGEUP = 104,
              GN_KEY_LEFT = 105,
              GN_KEY_RIGHT = 106,
              GN_KEY_END = 107,
              GN_KEY_DOWN = 108,
              GN_KEY_PAGEDOWN = 109,
              /* no kernel has keys there: a click of a knob, a tap of a touch screen or a mouse */
              GN_KEY_KNOB_LEFT = 765,
              GN_KEY_KNOB_RIGHT = 766,
              GN_KEY_TAP = 767,
              GN_KEY_COUNT = 768, /* numbers are below */
};

struct gn_key_event {
    uint16_t key; /* enum gn_key */
    bool down;
    int64_t time_ns; /* monotonic */
};

/* "space", "f1", "a", "btn_0"; "key_600" if key.c has no name for it. Never NULL. */
const char *gn_key_name(unsigned key, char *buffer, size_t size);
/* By name, in upper or lower case, or by a number as in "key_600"; GN_KEY_NONE: unknown
 * name. */
unsigned gn_key_find(const char *name);

#endif
