/* A screenshot: the pixels of one frame, turned upright, encoded and written by a thread of its own
 * while frames go on. One at a time. */
#ifndef GN_KIOSK_SCREENSHOT_H
#define GN_KIOSK_SCREENSHOT_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

/* May a picture be written there? An absolute path that ends in .png, and there is a regular file
 * or nothing: what somebody over a socket names may be no link and no device. */
bool gn_shot_check(const char *path, struct gn_err *err);

struct gn_shot;
struct gn_shot *gn_shot_create(struct gn_err *err);
void gn_shot_destroy(struct gn_shot *shot); /* waits for the thread; NULL is fine */
int gn_shot_fd(const struct gn_shot *shot); /* readable when there is something to take */

/* Begins one: room for RGBA of that size, top row first, which stands turned clockwise by turn_deg
 * (0, 90, 180, 270). The path is copied. NULL: no memory. Whoever has filled it starts the thread.
 */
uint8_t *gn_shot_begin(struct gn_shot *shot, const char *path, uint32_t width_px,
                       uint32_t height_px, unsigned turn_deg, struct gn_err *err);
bool gn_shot_start(struct gn_shot *shot, struct gn_err *err);
void gn_shot_drop(struct gn_shot *shot); /* what was begun and not started */
/* Is it done? Then *ok says how it ended, and another can begin. */
bool gn_shot_take(struct gn_shot *shot, bool *ok, struct gn_err *err);

#endif
