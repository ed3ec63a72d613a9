/* Inside the shadow room: what its files share. In the order in which they call each other: a file
 * calls only those above its own section. */
#ifndef GN_SHADOW_PRIVATE_H
#define GN_SHADOW_PRIVATE_H

#include "shadow/fit.h"

/* ---- eye.c: shapes for fitting, boxes, convex polygons and the eye's frustum ---- */

#define GN_POLYGON_MAX 20 /* a quad or triangle clipped by up to 12 planes */
struct gn_polygon {
    int count;
    vec3 at[GN_POLYGON_MAX];
};
/* Keeps the part where dot(plane, (p,1)) >= 0; may leave nothing. */
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
/* Whether a box lies wholly inside all planes, or wholly outside one of them (or one that is not a
 * number); may be neither. */
bool gn_planes_hold(const vec4 *planes, int count, const struct gn_box *box);
bool gn_planes_miss(const vec4 *planes, int count, const struct gn_box *box);
/* Whether anything in a box is this near to a place; errs towards yes. range_m may be INFINITY. */
bool gn_box_is_near(const struct gn_box *box, const vec3 place, float range_m);
/* The depth of a point along a perspective's view is dot(plane, (p,1)): the clip coordinate w. */
void gn_eye_depth_plane(const struct gn_eye *eye, vec4 plane);

/* Geometries up to this many triangles are clipped triangle by triangle, larger ones as boxes. */
enum { GN_EXACT_TRIANGLES = 32 };
/* Three corners of an item, from this index of its geometry on, world space. */
void gn_item_triangle(const struct gn_pose *pose, uint32_t item, uint32_t index,
                      struct gn_polygon *out);

/* The diagonal of all that is visible; never 0. */
float gn_scene_size_m(const struct gn_pose *pose);
/* The largest coordinate in it, which says how fine places are. */
float gn_scene_reach_m(const struct gn_pose *pose);

/* ---- view.c ---- */

/* Whether shadows on an item matter. */
bool gn_shadow_item_receives(const struct gn_pose *pose, uint32_t item,
                             const struct gn_shadow_view *view);

/* light_from_world along the light's direction, which is -Z; of a directional light about the
 * world's origin. Rigid. */
void gn_shadow_look(const struct gn_shadow_view *view, mat4 light_from_world);
/* The least size of a geometric series that is not smaller. */
float gn_shadow_step(float size);
/* Lays the map round a window in plane coordinates, on whole texels of a size from a geometric
 * series: sets view->lookup.texel and the map's low corner. min, max, least (of the window's side),
 * low: plane units. */
void gn_shadow_snap(struct gn_shadow_view *view, const float min[2], const float max[2],
                    float least, double low[2]);
/* Of all that decides the map's content; never 0. */
uint64_t gn_shadow_hash(const struct gn_pose *pose, const struct gn_shadow_view *view,
                        const struct gn_shadow_tile *tile, const uint8_t *casts);

/* The perspective of all tiles of a spot or point light: draws map_px texels from that corner on.
 */
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
    float range_m;          /* INFINITY: unlimited; not asked of a directional light */
    float scene_size_m;
    float light_radius; /* as in gn_light */
    bool is_cascade;    /* a tile of cascades */
    float blur_most_m;  /* of a cascade: what the finest one blurs at most; 0: of no other map */
};

/* The planes of a pyramid round the cone, that of the range if the light has one. Its near plane is
 * a ten-thousandth of the scene away, by steps: while the scene grows by little, what was measured
 * holds. */
void gn_fitter_set_cone(struct gn_fitter *f, float tan_cone);
/* Brings the memory up to this pose, light and eye. */
void gn_fitter_remember(const struct gn_fitter *f);
/* All that an item covers of what the light can show; and of that what the eye sees, unless it sees
 * nothing of the item. */
const struct gn_shadow_region *gn_fitter_whole(const struct gn_fitter *f, uint32_t item);
const struct gn_shadow_region *gn_fitter_seen(const struct gn_fitter *f, uint32_t item);
/* Of a directional light: what it covers of what lies within up to 6 planes, world space; not
 * remembered. */
struct gn_shadow_region gn_fitter_within(const struct gn_fitter *f, uint32_t item,
                                         const vec4 *planes, int count);
enum { GN_SEEN_NOT, GN_SEEN_PARTLY, GN_SEEN_WHOLE }; /* gn_shadow_memory.seen */

/* ---- window.c ---- */

struct gn_window {                  /* plane coordinates */
    struct gn_shadow_region window; /* before snapping: what the map must hold; near is the nearest
                                       caster's there, far the farthest receiver's */
    struct gn_shadow_region depths; /* near and far of all casters, whatever the eye sees */
    struct gn_shadow_region most;   /* holds any eye's window */
};
/* False: nothing that is seen is in shadow. Marks in memory->casts what casts, of a spot's map what
 * is in the window. everything: of an eye that sees all. */
bool gn_window_find(const struct gn_fitter *f, bool everything, struct gn_window *found);
/* Whether this eye sees all that receives. */
bool gn_window_is_all(const struct gn_fitter *f);

/* ---- depth.c ---- */

#define GN_RGBA8_FAR 0.999999f /* the far end's code: lib/map_rgba8.glsl */

/* Where a map begins and ends, from the depths of what casts: sets the view's near_m and far_m. */
void gn_fitter_set_depths(const struct gn_fitter *f, const struct gn_shadow_region *depths,
                          float *near_depth, float *far_depth);
/* How the encoding keeps a distance, once near_m and far_m are known. */
void gn_fitter_set_code(const struct gn_fitter *f, float near_depth, float far_depth);
/* How wide penumbrae are, and the blur of a map that is filtered, once texel and code are known. */
void gn_fitter_set_penumbra(const struct gn_fitter *f, const struct gn_shadow_region *window,
                            float near_depth, float far_depth);
void gn_fitter_set_blur(const struct gn_fitter *f, float near_depth, float far_depth);

/* ---- pages.c ---- */

/* Lays a directional light's map round a window: texel, pages and what draws them,
 * tiles[0].clip_from_world, and which items cast into which page, of those that memory->casts
 * marks. */
void gn_pages_fit(const struct gn_fitter *f, const struct gn_window *found, float near_depth,
                  float far_depth);

/* ---- single.c ---- */

/* Lays one tile round what its eye sees: all of a view of one tile but its bias and hash.
 * Directional lights and spots. */
bool gn_single_fit(struct gn_fitter *f);

/* ---- cube.c ---- */

/* A point light's six tiles: all of the view but its bias and hashes; six memories. */
bool gn_cube_fit(struct gn_fitter *f);

/* ---- distances.c ---- */

struct gn_distances { /* along the view */
    float near_m, far_m;
};
/* From the nearest to the farthest place that can be in a shadow of a directional light that is
 * seen. False: there is none. */
bool gn_distances_find(const struct gn_fitter *f, struct gn_distances *seen);
/* The nearest place that counts. */
float gn_distances_nearest(const struct gn_distances *seen);

/* ---- cascade.c ---- */

/* A view with cascades, all but its bias; memories: GN_CASCADE_MEMORIES. */
bool gn_cascades_fit(const struct gn_fitter *f);

#endif
