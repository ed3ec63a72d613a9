/* For tests that step a kiosk by hand. */
#ifndef GN_TESTS_SHOW_HELP_H
#define GN_TESTS_SHOW_HELP_H

#include "kiosk/show.h"

/* A kiosk without a screen, of `gnomon show --backend egl` and these arguments, NULL behind the
 * last, which shows its first scene; no configuration of the user's is read. Fails the test, or
 * skips it where EGL is not there. */
struct gn_show *help_show(const char *const more[]);
/* The same of 64x64 pixels, with that text as its configuration and these arguments. */
struct gn_show *help_show_of(const char *config, const char *const more[]);
/* As help_show(), but perhaps before the first scene is there, as any kiosk on a slow machine. */
struct gn_show *help_show_begun(const char *const more[]);
/* As in a window: next and prev go through all techniques, whose programs are all made ahead. */
void help_show_all_modes(struct gn_show *show);
void help_show_step(struct gn_show *show);
/* Does it and wakes the kiosk, as what a button is behind would. */
void help_show_act(struct gn_show *show, enum gn_action_kind kind);
/* Steps until so many frames more are drawn, for at most a minute of the clock. */
void help_show_frames(struct gn_show *show, unsigned count);
/* Steps until a frame is drawn and nothing is made ahead any more, for at most three minutes of
 * processor time. */
void help_show_until_warm(struct gn_show *show);
/* Whether a frame is wanted, or can be only once the display takes one, or a text is still to fall:
 * what is read before that is not the last picture. */
bool help_show_changes(const struct gn_show *show);
/* The frame that was drawn last: 4 bytes a pixel. */
void help_show_picture(const struct gn_show *show, uint8_t *out);

#endif
