/* The rows of the table of displays, one a file, and the screen that nobody sees. */
#ifndef GN_DISPLAY_PRIVATE_H
#define GN_DISPLAY_PRIVATE_H

#include "display/display.h"

#define X(file, name) extern const struct gn_display_ops gn_display_##file;
GN_DISPLAY_TABLE(X)
#undef X

/* A screen for displays that have none: lit from the start, its frames are shown at once, a timer
 * paces them. */
extern const struct gn_screen_ops gn_screen_headless; /* headless.c */
void gn_screen_headless_close(struct gn_display *display);

#endif
