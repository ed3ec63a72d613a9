/* Planar shadows: the map lies in the receiver's plane, and casters are drawn into it as they fall
 * on it, seen from the light. Each texel says whether light arrives, so that a pixel is darkened
 * once however many casters overlap, and only what stands between light and plane is drawn. Pure.
 *
 * The other way needs no map: casters are drawn into the picture's stencil as the eye sees them
 * fallen on the plane, each sample marked once. Edges are exact at any distance.
 *
 * Of a lamp that has a size the mask is the mean: each of its points subtracts its weight from the
 * texels that it does not see (P. Heckbert, M. Herf, "Simulating Soft Shadows with Graphics
 * Hardware", 1997).
 *
 * Plane coordinates are metres in the plane, from where the world's origin stands over it. */
#ifndef GN_SHADOW_PLANAR_H
#define GN_SHADOW_PLANAR_H

#include "shadow/fit.h"

/* Whether anything in the scene receives planar shadows. */
bool gn_planar_has_plane(const struct gn_scene *scene);

/* gn_shadow_fit for a technique that is on_plane: every kind of light. The view is as gn_shadow_fit
 * has begun it, with the light's place. In it light_from_world leads to plane coordinates and
 * height over the plane, map_from_world is affine and right for points of the plane only, and codes
 * are visibilities. With encoding STENCIL the map's size is 0, clip_from_world leads to where a
 * point's shadow falls, in world space and times a w that is 0 or less behind the light, and near_m
 * and far_m are the heights over the plane between which a point casts; the rest is not set. With
 * MEAN the view has a lamp of so many points, or of one where no penumbra is as wide as a texel. */
struct gn_fitter;
bool gn_planar_fit(const struct gn_fitter *fitter, uint32_t points);

/* Draws the shadows that a point of the lamp throws, of view->lamp.count; encoding MEAN. */
void gn_planar_point(const struct gn_shadow_view *view, uint32_t index, mat4 clip_from_world);
/* Draws, from straight above, what stands on the plane. Technique FLOOR. */
void gn_planar_footprint(const struct gn_shadow_view *view, mat4 clip_from_world);

#endif
