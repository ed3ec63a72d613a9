/* Cascades: a directional light's map in up to four tiles, each for the view between two distances
 * from the camera, so that near parts get small texels. Pure.
 *
 * They lie side by side in one map, two in a row. A tile's inner part is a map like any other: its
 * extent is found from pairs, casters and visible receivers within those distances, it is
 * drawn in pages, and moves by whole texels (pages.h). It is always copied from there to its tile,
 * so a texel holds the same bits wherever the camera is. Round it lies a gutter that stays cleared,
 * as wide as a technique may read: a place beside what is drawn, whose filter reaches in, is in its
 * own tile's, and what it reads on its other side in the next one's, or past the map's edge, which
 * goes on as it is. So of three cascades the map has a fourth tile, which is empty. A soft
 * technique reads as far as the widest penumbra that may be seen, by powers of two; one that reads
 * a table knows where its tile ends, and needs no more than a few texels. All tiles span the same
 * depths and have the same codes, which do not depend on the camera; moments alone are of what lies
 * between a tile's nearest caster and the farthest place visible in its shadow, since they tell
 * depths apart the better the fewer there are.
 *
 * The splits go by equal ratios of distance (Lloyd et al., "Warping and Partitioning for Low Error
 * Shadow Maps", 2006) between the nearest and the farthest place that can be in a seen shadow, both
 * by steps: they do not change while the camera moves little. Before each split lies a zone that
 * two cascades serve, which shaders mix (shaders_es/lib/shadow_cascade.glsl).
 */
#ifndef GN_SHADOW_CASCADE_H
#define GN_SHADOW_CASCADE_H

#include "shadow/fit.h"

#define GN_CASCADE_FADE 0.1f /* the zone's width, as a share of the split's distance */
/* Memories of a view with cascades: one for each tile, and one for all that is seen. */
enum { GN_CASCADE_MEMORIES = GN_CASCADES_MAX + 1, GN_CASCADE_LEAST_PX = 64 };

/* Whether there can be any: not for spot and point lights, on a plane, in a map smaller than
 * GN_CASCADE_LEAST_PX, or with an orthographic camera, whose pixels all have one size. */
bool gn_cascade_can(const struct gn_light *light, const struct gn_eye *eye,
                    const struct gn_shadow_opts *opts);

/* The largest apparent size of a texel of such a view: metres per metre of distance from the
 * camera; of a spot, whatever the camera sees of it, per metre of distance from the light; on a
 * plane metres. 0 when nothing visible is in shadow, and the map is not fixed. Allocates nothing;
 * memory: one where opts->cascades is 0 or 1, else GN_CASCADE_MEMORIES. */
float gn_cascade_tangent(const struct gn_pose *pose, uint32_t light, const struct gn_eye *eye,
                         const struct gn_shadow_opts *opts, struct gn_shadow_memory *memory);

/* The size of a map with that many tiles of map_px. */
void gn_cascade_map_size(uint32_t cascades, uint32_t map_px, uint32_t size_px[2]);

/* Private to src/shadow: begins such a view. */
void gn_cascades_lay(uint32_t cascades, struct gn_shadow_view *view);

#endif
