/* Inside the shadow room: shapes for fitting - boxes, convex polygons and the eye's frustum - what
 * items cover of what a light can show, and what fits of all kinds share. */
#ifndef GN_SHADOW_PRIVATE_H
#define GN_SHADOW_PRIVATE_H

#include "shadow/fit.h"

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

/* Geometries up to this many triangles are clipped triangle by triangle, larger ones as boxes. */
enum { GN_EXACT_TRIANGLES = 32 };
/* Three corners of an item, from this index of its geometry on, world space. */
void gn_item_triangle(const struct gn_pose *pose, uint32_t item, uint32_t index,
                      struct gn_polygon *out);

/* The diagonal of all that is visible; never 0. */
float gn_scene_size_m(const struct gn_pose *pose);
/* The largest coordinate in it, which says how fine places are. */
float gn_scene_reach_m(const struct gn_pose *pose);

/* ---- fit.c ---- */

/* Whether shadows on an item matter. */
bool gn_shadow_item_receives(const struct gn_pose *pose, uint32_t item,
                             const struct gn_shadow_view *view);

/* light_from_world along the light's direction, which is -Z; of a directional light about the
 * world's origin. Rigid. */
void gn_shadow_look(const struct gn_shadow_view *view, mat4 light_from_world);
/* The least size of a geometric series that is not smaller. */
float gn_shadow_step(float size);
/* Lays the map round a window in plane coordinates, on whole texels of a size from a geometric
 * series: sets view->texel and the map's low corner. min, max, least (of the window's side), low:
 * plane units. */
void gn_shadow_snap(struct gn_shadow_view *view, const float min[2], const float max[2],
                    float least, double low[2]);
/* Of all that decides the map's content; never 0. */
uint64_t gn_shadow_hash(const struct gn_pose *pose, const struct gn_shadow_view *view,
                        const struct gn_shadow_tile *tile, const uint8_t *casts);

struct gn_fitter;
/* Lays one tile round what its eye sees: all of a view of one tile but its bias and hash.
 * Directional lights and spots. */
bool gn_shadow_fit_window(struct gn_fitter *f);

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

/* ---- cascade.c ---- */

/* A view with cascades, all but its bias; memories: GN_CASCADE_MEMORIES. */
bool gn_cascades_fit(const struct gn_fitter *f);

/* ---- pages.c ---- */

/* Lays a directional light's map round a window: texel, pages and what draws them,
 * tiles[0].clip_from_world, and which items cast into which page, of those that memory->casts
 * marks. */
void gn_pages_fit(const struct gn_fitter *f, const struct gn_window *found, float near_depth,
                  float far_depth);

#endif
