/* Rows of the table of displays, and the headless screen. */
#ifndef GN_DISPLAY_PRIVATE_H
#define GN_DISPLAY_PRIVATE_H

#include "display/display.h"

#define X(file, name) extern const struct gn_display_ops gn_display_##file;
GN_DISPLAY_TABLE(X)
#undef X

/* Screen for displays without one: lit from the start; a timer paces frames, which end at once. */
extern const struct gn_screen_ops gn_screen_headless; /* headless.c */
void gn_screen_headless_close(struct gn_display *display);

#endif
