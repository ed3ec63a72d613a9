/* An X server that nobody sees (Xvfb), a program in a window on it, and a hand on keys and mouse.
 */
#ifndef GN_IMAGE_XSERVER_H
#define GN_IMAGE_XSERVER_H

#include <stdbool.h>
#include <sys/types.h>

#include "core/err.h"
#include "image/picture.h"

enum { GN_XSERVER_WIDTH_PX = 1024, GN_XSERVER_HEIGHT_PX = 768 };

struct gn_xserver;
/* Starts the only one and makes it DISPLAY of this process and of those it starts. Where there is
 * none the process ends: with 77 if a package is missing. */
struct gn_xserver *gn_xserver_start(void);
void gn_xserver_stop(struct gn_xserver *x);
pid_t gn_xserver_pid(const struct gn_xserver *x);

typedef unsigned long gn_xwindow; /* 0: none */
/* The window of that name, once it is on the screen; 0 after seconds. */
gn_xwindow gn_xserver_find(struct gn_xserver *x, const char *name, int seconds);
/* What is in it now, as 3 channels. False while it is not, or not wholly, on the screen. */
bool gn_xserver_grab(struct gn_xserver *x, gn_xwindow window, struct gn_picture *picture);
bool gn_xserver_title(struct gn_xserver *x, gn_xwindow window, char *out, size_t size);
/* Width, height, that many ARGB pixels; again for each icon. How many numbers; the caller frees. */
size_t gn_xserver_icon(struct gn_xserver *x, gn_xwindow window, unsigned long **out);
/* A file let go over it. False: the window did not ask for it. */
bool gn_xserver_drop(struct gn_xserver *x, gn_xwindow window, const char *path);
void gn_xserver_resize(struct gn_xserver *x, gn_xwindow window, int width_px, int height_px);
/* A window over everything, and away again. */
void gn_xserver_cover(struct gn_xserver *x);
void gn_xserver_close(struct gn_xserver *x, gn_xwindow window); /* as its frame's button does */
void gn_xserver_key(struct gn_xserver *x, gn_xwindow window, unsigned long keysym);
/* Button 1 left, 2 middle, 3 right, 4 and 5 the wheel: pressed, moved by x, y pixels, let go. */
void gn_xserver_drag(struct gn_xserver *x, gn_xwindow window, unsigned button, int right_px,
                     int down_px);

#endif
