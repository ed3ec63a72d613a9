/* The window library's keys as Linux numbers them: pure. */
#ifndef GN_DISPLAY_WINDOW_KEY_H
#define GN_DISPLAY_WINDOW_KEY_H

#include "core/key.h"

/* GN_KEY_NONE: there is none, or it is the window's own (escape, home, F11, Q). */
unsigned gn_window_key(int glfw);

#endif
