/* A screenshot: the pixels of one frame, turned upright, encoded and written by a thread of its own
 * while frames go on. One at a time: asked for, filled by the next frame, taken when it is done. */
#ifndef GN_KIOSK_SCREENSHOT_H
#define GN_KIOSK_SCREENSHOT_H

#include <stdbool.h>
#include <stdint.h>

#include "core/loop.h"

/* For the client: may a picture be written there? An absolute path that ends in .png; there is a
 * regular file or nothing. */
bool gn_screenshot_check(const char *path, struct gn_err *err);
/* For the kiosk: may it write there for a client? With a descriptor: that is a memory file, which
 * no write waits for. Without one (-1): the path is that of a file in the folder of --screenshots
 * (NULL: there is none), since it is written with the kiosk's rights; target (PATH_MAX bytes) gets
 * its real path. What is there is looked at when it is written: gn_file_replace(). */
bool gn_screenshot_permits(const char *path, int fd, const char *folder, char *target,
                           struct gn_err *err);

struct gn_screenshot;
/* call: when one can be taken. NULL: fails. */
struct gn_screenshot *gn_screenshot_create(struct gn_loop *loop,
                                           void (*call)(void *user, int64_t now_ns), void *user,
                                           struct gn_err *err);
void gn_screenshot_destroy(struct gn_screenshot *shot); /* waits for the thread; NULL is legal */

/* The next frame is to be written into fd, which stays the caller's and open until it is done, or
 * (-1) to the path, which is copied. Not while another one is under way. */
void gn_screenshot_ask(struct gn_screenshot *shot, const char *path, int fd);
bool gn_screenshot_is_asked(const struct gn_screenshot *shot); /* and no frame has filled it */
bool gn_screenshot_is_busy(const struct gn_screenshot *shot);  /* asked, or not taken yet */
/* Memory for the frame: RGBA of that size, top row first, turned clockwise by turn_deg (0, 90, 180,
 * 270). Whoever has filled it starts the thread. NULL: no memory. */
uint8_t *gn_screenshot_begin(struct gn_screenshot *shot, uint32_t width_px, uint32_t height_px,
                             unsigned turn_deg, struct gn_err *err);
bool gn_screenshot_start(struct gn_screenshot *shot, struct gn_err *err);
/* In place of a frame, where there is none: a picture of that size, as it is seen, with that text
 * in that font (as in struct gn_captions_opts), and starts the thread. */
bool gn_screenshot_say(struct gn_screenshot *shot, uint32_t width_px, uint32_t height_px,
                       const char *font, const char *text, struct gn_err *err);
/* What was asked for cannot be had; gn_screenshot_take() returns the reason. */
void gn_screenshot_fail(struct gn_screenshot *shot, const struct gn_err *err);
/* True: it is done, *ok and err say how it ended, and another can be asked for. */
bool gn_screenshot_take(struct gn_screenshot *shot, bool *ok, struct gn_err *err);

#endif
