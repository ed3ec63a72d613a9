/* The oracle: what a scene looks like and what its lights see, by rays over the same triangles that
 * the renderer draws. All in double precision; no map, no bias, no texel.
 *
 * Rules, and where they come from (the contract's words in quotes):
 * - The eye sees the front faces of single-sided surfaces only, both faces of the others.
 * Alpha-masked surfaces have their holes. The eye looks through blended surfaces: an AOV is of the
 * first opaque or masked one.
 * - Opaque and masked surfaces cast, "from both sides"; masked ones "cast their holes". Blended
 * surfaces cast nothing. Nothing whose gnomon_cast is false casts. gnomon_cast_faces chooses how a
 * map is drawn, not what is true: ignored.
 * - Visibility is "only what the geometry says": cone, range, N.L and gnomon_receive are not in it,
 * so it is 1 outside the cone, beyond the range, behind the light and on the background. Cones are
 * cut at 80 degrees, as the maps are.
 * - A casting surface seen from the side turned away from the light is dark: it stands in its own
 * light.
 * - A hole is where texture alpha x vertex alpha x factor < cutoff; the texture at level 0, nearest
 * or bilinear with its wrap, as OpenGL ES 3.0 section 3.8.10 has it. The renderer minifies with
 * mip-maps, so rims of far holes may differ. */
#ifndef GN_TRUTH_RAYCAST_H
#define GN_TRUTH_RAYCAST_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include "scene/framing.h"
#include "truth/bvh.h"

struct gn_raycast {
    const struct gn_scene *scene;
    const struct gn_material *materials; /* as the pose has them */
    struct gn_material *own;             /* the same, if they are not the scene's */
    struct gn_bvh bvh;
    double (*spiral)[2]; /* directions of the first points of gn_raycast_share() */
};

/* Copies the triangles of all visible items to where the pose has them; scene must outlive it, pose
 * need not. Another thread sets *cancel to end it; then `rays` may only be finished. NULL: none. */
void gn_raycast_init(struct gn_raycast *rays, const struct gn_scene *scene,
                     const struct gn_pose *pose, const atomic_bool *cancel);
void gn_raycast_finish(struct gn_raycast *rays);
/* What gn_raycast_init() takes at most for a scene. */
uint64_t gn_raycast_bytes(const struct gn_scene *scene);
/* Alpha of a texture at level 0, 0..1, as the rules above have it. */
double gn_ray_sample_alpha(const struct gn_scene *scene, const struct gn_texture *texture, double u,
                           double v);
bool gn_raycast_casts(const struct gn_bvh_triangle *triangle); /* one of rays->bvh.triangles */
/* The same where the hit is in no hole: a gn_bvh_accept whose context are the rays. */
bool gn_raycast_blocks(const void *rays, const struct gn_bvh_triangle *triangle,
                       const struct gn_bvh_hit *hit);

/* A camera at a pose, framed for a picture size (scene/framing.h). An orthographic one keeps its
 * vertical half-size; the picture's shape gives the horizontal one. Every
 * pixel is square. */
struct gn_ray_eye {
    double position_ws[3], right[3], up[3], forward[3];
    double half_width, half_height; /* at distance 1 (perspective) or in metres (orthographic) */
    double near_m, far_m;           /* along forward; far_m INFINITY if unlimited */
    bool orthographic;
    int width_px, height_px;
};
void gn_ray_eye_init(struct gn_ray_eye *eye, const struct gn_pose *pose, uint32_t camera,
                     int width_px, int height_px);
/* The same of a camera that is framed already. */
void gn_ray_eye_look(struct gn_ray_eye *eye, const struct gn_framing *framing, int width_px,
                     int height_px);
/* Size of one pixel in metres for a surface facing the eye at this point. */
double gn_ray_eye_pixel_m(const struct gn_ray_eye *eye, const double point_ws[3]);

struct gn_ray_surface {
    double point_ws[3];
    double normal_ws[3]; /* unit, of the triangle, towards the side it is seen from */
    double distance_m;   /* from the eye */
    uint32_t item;       /* GN_RAY_NO_ITEM: a bare point, taken as part of something that casts */
    uint32_t index;      /* with an item: first index of the triangle in buffers.indices */
    double u, v;         /* the same: as in gn_bvh_hit, by its corners */
};
#define GN_RAY_NO_ITEM UINT32_MAX

/* What the eye sees through the middle of pixel x, y (row 0 on top); false on the background. */
bool gn_raycast_eye(const struct gn_raycast *rays, const struct gn_ray_eye *eye, int x, int y,
                    struct gn_ray_surface *surface);

/* How far off a surface rays from it start: two units in the last place of the float coordinates
 * of the triangles there, as in Waechter, Binder 2019, "A Fast and Robust Method for Avoiding
 * Self-Intersection", along the unit normal: how far off a floor lies sideways is not in it. And of
 * the doubles that the point was computed from, which are as large as the scene. */
double gn_raycast_lift_m(const struct gn_raycast *rays, const double point_ws[3],
                         const double normal_ws[3]);

/* A light at a pose. */
struct gn_ray_lamp {
    enum gn_light_type type;
    double position_ws[3], direction_ws[3]; /* direction: unit, along which it shines */
    double range_m;                         /* INFINITY: unlimited */
    double cos_cone;                        /* of the spot's outer half-angle or 80 degrees */
    double radius;                          /* metres, or tangent of the angular radius */
};
void gn_ray_lamp_init(struct gn_ray_lamp *lamp, const struct gn_pose *pose, uint32_t light);

/* Is the lamp's middle seen from the surface? 1 lit, 0 dark. */
int gn_raycast_visible(const struct gn_raycast *rays, const struct gn_ray_lamp *lamp,
                       const struct gn_ray_surface *surface);
/* Share of the lamp's area that is seen, 0..1: a disk of `radius` that faces the surface (point,
 * spot) or of that tangent about the direction (directional). `samples` points on a Vogel spiral
 * (256-1024 are plenty), the same every time. Of what lies below the surface's horizon nothing is
 * seen. */
double gn_raycast_share(const struct gn_raycast *rays, const struct gn_ray_lamp *lamp,
                        const struct gn_ray_surface *surface, int samples);

#endif
