/* GLFW keys to Linux key codes: pure. */
#ifndef GN_DISPLAY_WINDOW_KEY_H
#define GN_DISPLAY_WINDOW_KEY_H

#include "core/key.h"

/* GN_KEY_NONE if there is none, or it belongs to the window (escape, home, F11, Q). */
unsigned gn_window_key(int glfw);

#endif
