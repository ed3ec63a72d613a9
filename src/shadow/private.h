/* Shared by the files of src/shadow, which stand from the bottom to the top: each calls only those
 * before it. near_depth, far_depth: the clip planes of a map or tile, metres along the light's
 * direction or the tile's axis; for a directional light counted from the world's origin, so either
 * may be negative. */
#ifndef GN_SHADOW_PRIVATE_H
#define GN_SHADOW_PRIVATE_H

#include "shadow/fit.h"

/* ---- eye.c: shapes for fitting, boxes, convex polygons and the eye's frustum ---- */

#define GN_POLYGON_MAX 20 /* a quad or triangle clipped by up to 12 planes */
struct gn_polygon {
    int count;
    vec3 at[GN_POLYGON_MAX];
};
/* Clips to dot(plane, (p,1)) >= 0; may leave nothing. */
void gn_polygon_clip(struct gn_polygon *polygon, const vec4 plane);

/* The eight corners of a box under a transform: bit 0 of the index is x, 1 y, 2 z. */
void gn_box_corners(const struct gn_box *box, mat4 to, vec3 corners[8]);
/* Face 0..5 of eight such corners. */
void gn_box_face(vec3 corners[8], int face, struct gn_polygon *out);
/* The six inward planes of the convex body of eight such corners. A flat body gives planes that cut
 * nothing. */
void gn_box_planes(vec3 corners[8], vec4 planes[6]);
/* Least and greatest of dot(plane, (p,1)) over a box. */
float gn_box_least(const vec4 plane, const struct gn_box *box);
float gn_box_most(const vec4 plane, const struct gn_box *box);
/* Whether a box lies wholly inside all planes, or wholly outside one of them; a plane that is not a
 * number counts as outside. A box may be neither. */
bool gn_planes_hold(const vec4 *planes, int count, const struct gn_box *box);
bool gn_planes_miss(const vec4 *planes, int count, const struct gn_box *box);
/* Whether a box may have a point this near to a place; conservative. range_m may be INFINITY. */
bool gn_box_is_near(const struct gn_box *box, const vec3 place, float range_m);
/* The depth of a point along a perspective's view is dot(plane, (p,1)): the clip coordinate w. */
void gn_eye_depth_plane(const struct gn_eye *eye, vec4 plane);

/* Geometries up to this many triangles are clipped triangle by triangle, larger ones as boxes. */
enum { GN_EXACT_TRIANGLES = 32 };
/* The triangle of an item that begins at this index of its geometry, world space. */
void gn_item_triangle(const struct gn_pose *pose, uint32_t item, uint32_t index,
                      struct gn_polygon *out);

/* The diagonal of all that is visible; never 0. */
float gn_scene_size_m(const struct gn_pose *pose);
/* The largest coordinate in the scene, which determines how positions are rounded. */
float gn_scene_reach_m(const struct gn_pose *pose);

/* ---- view.c ---- */

/* Whether an item receives shadows. */
bool gn_shadow_item_receives(const struct gn_pose *pose, uint32_t item,
                             const struct gn_shadow_view *view);

/* light_from_world along the light's direction, which is -Z; of a directional light about the
 * world's origin. Rigid. */
void gn_shadow_look(const struct gn_shadow_view *view, mat4 light_from_world);
/* Rounds a size up to one of a geometric series. */
float gn_shadow_step(float size);
/* Lays the map round a window in plane coordinates, snapped to whole texels of a size from a
 * geometric series: sets view->lookup.texel and the map's low corner. min, max, low, and least, the
 * window's least side: plane units. */
void gn_shadow_snap(struct gn_shadow_view *view, const float min[2], const float max[2],
                    float least, double low[2]);
/* A hash of everything that determines the map's content; never 0. */
uint64_t gn_shadow_hash(const struct gn_pose *pose, const struct gn_shadow_view *view,
                        const struct gn_shadow_tile *tile, const uint8_t *casts);

/* Sets the perspective of all tiles of a spot or point light: map_px texels from that corner on. */
void gn_shadow_set_frustums(struct gn_shadow_view *view, const double low[2], float near_depth,
                            float far_depth);

/* ---- measure.c ---- */

struct gn_fitter {
    const struct gn_pose *pose;
    const struct gn_eye *eye;
    struct gn_shadow_memory *memory;
    struct gn_shadow_view *view;
    struct gn_shadow_tile *tile; /* of the view; `memory` is of this one */
    vec4 cone[6]; /* spot, point: planes in world space that hold what the tile can show */
    int cone_count;
    float tan_cone, near_m; /* of the cone */
    float range_m;          /* INFINITY: unlimited; not used for a directional light */
    float scene_size_m;
    float light_radius; /* as in gn_light */
    bool is_cascade;    /* a tile of cascades */
    float blur_most_m;  /* of a cascade: the widest blur of the finest one; 0: not a cascade */
};

/* Sets the planes of a pyramid round the cone, and of the range if the light has one. The near
 * plane is at a ten-thousandth of the scene's size, in steps, so that measurements stay valid while
 * the scene grows by little. */
void gn_fitter_set_cone(struct gn_fitter *f, float tan_cone);
/* Brings the memory up to this pose, light and eye. */
void gn_fitter_remember(const struct gn_fitter *f);
/* The region of an item within the light's cone; and the part that the eye sees, which must not be
 * called when it sees nothing of the item. */
const struct gn_shadow_region *gn_fitter_whole(const struct gn_fitter *f, uint32_t item);
const struct gn_shadow_region *gn_fitter_seen(const struct gn_fitter *f, uint32_t item);
/* For a directional light: the region of an item within up to 6 planes, world space; not cached. */
struct gn_shadow_region gn_fitter_within(const struct gn_fitter *f, uint32_t item,
                                         const vec4 *planes, int count);
enum { GN_SEEN_NOT, GN_SEEN_PARTLY, GN_SEEN_WHOLE }; /* gn_shadow_memory.seen */

/* ---- window.c ---- */

struct gn_window { /* plane coordinates */
    /* before snapping: the extent that the map must hold; near is that of the nearest caster in it,
     * far that of the farthest receiver */
    struct gn_shadow_region window;
    struct gn_shadow_region depths; /* near and far of all casters, independent of the eye */
    struct gn_shadow_region most;   /* encloses the window of any eye */
};
/* False: nothing visible is in shadow. Marks the casters in memory->casts; for a spot light those
 * in the window. everything: for an eye that sees all. */
bool gn_window_find(const struct gn_fitter *f, bool everything, struct gn_window *found);
/* How much penumbra depth lies between a caster and a receiver at these depths: times the light's
 * radius it is the penumbra's, plane units, as in gn_fitter_set_penumbra(). */
float gn_fitter_spread(const struct gn_fitter *f, float near, float far);
/* Whether this eye sees all receivers. */
bool gn_window_is_all(const struct gn_fitter *f);

/* ---- depth.c ---- */

#define GN_RGBA8_FAR 0.999999f /* the code of the far end: lib/map_rgba8.glsl */

/* Sets the view's near_m and far_m from the depths of the casters. */
void gn_fitter_set_depths(const struct gn_fitter *f, const struct gn_shadow_region *depths,
                          float *near_depth, float *far_depth);
/* Sets how the encoding stores a distance; after near_m and far_m. */
void gn_fitter_set_code(const struct gn_fitter *f, float near_depth, float far_depth);
/* Set the width of penumbrae, and the blur of a filtered map; after the texel and the code. */
void gn_fitter_set_penumbra(const struct gn_fitter *f, const struct gn_shadow_region *window,
                            float near_depth, float far_depth);
void gn_fitter_set_blur(const struct gn_fitter *f, float near_depth, float far_depth);

/* ---- pages.c ---- */

/* Lays a directional light's map round a window: the texel, the pages with their matrices,
 * tiles[0].clip_from_world, and for each item that memory->casts marks the pages that it casts
 * into. */
void gn_pages_fit(const struct gn_fitter *f, const struct gn_window *found, float near_depth,
                  float far_depth);

/* ---- single.c ---- */

/* Fits a view of one tile, of a directional or spot light: all of it except bias and hash. */
bool gn_single_fit(struct gn_fitter *f);

/* ---- cube.c ---- */

/* Fits a point light's six tiles: all of the view except bias and hashes; six memories. */
bool gn_cube_fit(struct gn_fitter *f);

/* ---- distances.c ---- */

struct gn_distances { /* along the view */
    float near_m, far_m;
};
/* The distances of the nearest and the farthest visible place that can be in a directional light's
 * shadow. False: there is none. */
bool gn_distances_find(const struct gn_fitter *f, struct gn_distances *seen);
/* The nearest distance that cascades are fitted to. */
float gn_distances_nearest(const struct gn_distances *seen);

/* ---- cascade.c ---- */

/* Fits a view with cascades: all of it except the bias; memories: GN_CASCADE_MEMORIES. */
bool gn_cascades_fit(const struct gn_fitter *f);

#endif
