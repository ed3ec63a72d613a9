/* Against burn-in the picture wanders by whole pixels, one a minute, and passes through all places
 * around its own. Pure. */
#ifndef GN_KIOSK_SHIFT_H
#define GN_KIOSK_SHIFT_H

#include <stdint.h>

/* After so many minutes, to the right and up, in pixels from -most to most. Begins at 0, 0; the
 * next minute differs by at most one pixel in each. most >= 0. */
void gn_shift_at(int64_t minute, int most, int out_px[2]);

#endif
