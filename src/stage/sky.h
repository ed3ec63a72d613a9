/* The light of a clear sky, by where the sun stands. */
#ifndef GN_STAGE_SKY_H
#define GN_STAGE_SKY_H

#include "environment/daylight.h"
#include "frame/frame.h"

/* Sets e->of and what belongs to it. A sky is made for the middle of a cell of the sun's places, 2
 * degrees of azimuth by .5 of altitude, and kept while the sun is in it; its brightness is exact.
 * Making one takes a tenth of a second and more. behind: while the sun goes on, as in a kiosk, a
 * thread makes it, and until then the sky of a place at most 30 and 7.5 degrees away stays.
 * For one thread; e->of is valid until the call after the next. */
void gn_stage_sky_set(struct gn_frame_environment_opts *e, const struct gn_daylight *daylight,
                      double azimuth_deg, float north_deg, bool behind);

#endif
