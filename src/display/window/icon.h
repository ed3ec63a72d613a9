/* The icon of the window: a sundial, drawn. Pure. */
#ifndef GN_DISPLAY_WINDOW_ICON_H
#define GN_DISPLAY_WINDOW_ICON_H

#include <stdint.h>

/* RGBA, straight alpha, side x side pixels, top row first. */
void gn_window_icon(uint8_t *rgba, int side);

#endif
