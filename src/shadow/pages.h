/* A directional light's map under a moving camera: bit for bit the same, shifted by whole texels.
 *
 * A rasteriser's depth of a texel depends, in its last bits, on where in its target the texel lies.
 * So each texel of the light's lattice has one place for good: the lattice is cut into pages as
 * large as the map, each drawn by a projection of its own that does not depend on the camera. A map
 * holds a window of the lattice. What of it lies in a page is drawn there and nowhere else, and is
 * then copied to where it stands in the map: so shaders read a map like any other. A window is
 * narrower than a page, so its parts in up to four of them would overlap nowhere if the pages lay
 * on each other: one target holds them all. A window that lies in one page needs no copy: the page
 * is the map.
 *
 * The pages begin where the map of an eye that sees all begins: that map is one page. An eye that
 * sees nearly all, whose texel would be one step finer, takes the same map. Pure.
 */
#ifndef GN_SHADOW_PAGES_H
#define GN_SHADOW_PAGES_H

#include "shadow/fit.h"

/* Lays pages round a window (texels of the lattice, first and last, both in it): all of `drawn` but
 * each page's clip_from_world. anchor: the lower left texel of any page. No window is wider than
 * map_px - 2; map_px is at least 3. */
void gn_pages_lay(const double anchor[2], const double first[2], const double last[2],
                  uint32_t map_px, struct gn_shadow_drawn *drawn);

#endif
