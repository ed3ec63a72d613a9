/* Ambient occlusion: which share of the light of a sky a point of a surface sees, by rays; and the
 * texels of a scene's volume, fitted to such shares.
 *
 * What stays where it is (gn_item.stays), over the clips that are shown, too, occludes as it casts
 * shadows, with its holes, from both sides, without variants; all else neither occludes nor counts.
 * Two parallel faces that nearly touch, as a label and the bottle under it, are one: neither is in
 * the way of the other. Nobody sees between them, and which is the outer one is left to rounding.
 * A ray that meets the scene's unseen floor sees as much of its light as the floor there sees of
 * the sky. */
#ifndef GN_TRUTH_OCCLUSION_H
#define GN_TRUTH_OCCLUSION_H

#include "scene/pose.h"
#include "truth/raycast.h"

enum { GN_SKY_TERMS = 9 };
/* Radiance by direction d: the sum of radiance[i] times 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy of
 * d turned about +Y, but at least an eighth of radiance[0]. Zeroed: the same from everywhere. */
struct gn_sky {
    float radiance[GN_SKY_TERMS];
    float turn[2]; /* cosine and sine, as shaders have them */
};

struct gn_occlusion {
    struct gn_raycast rays; /* of what stays */
    struct gn_pose pose;    /* in which all else is hidden */
    bool *leaves;           /* by item: hidden in it, since these clips move it away */
    struct gn_sky sky;
    const struct gn_image *floor; /* of the unseen floor, or NULL */
    double floor_m, floor_corner_m[2], floor_side_m;
};
/* at: the moment, of which a fade does not count; NULL: without clips. Another thread sets *cancel
 * to end it; then it may only be finished. NULL: none. The scene must outlive it. */
void gn_occlusion_init(struct gn_occlusion *occlusion, const struct gn_scene *scene,
                       const struct gn_moment *at, const struct gn_sky *sky,
                       const atomic_bool *cancel);
void gn_occlusion_finish(struct gn_occlusion *occlusion);

/* A point of a surface. */
struct gn_occlusion_site {
    double point_ws[3];
    float normal_ws[3]; /* unit, of the mesh: weighs light by its cosine */
    float face_ws[3]; /* unit, of the triangle, on that side: light from below it does not count */
    float side_m;     /* root of twice the triangle's area; 0: not known */
    float turn[2];    /* 0 to 1, by which the directions of its rays are shifted */
};
/* Of what an eye sees of the posed scene. turn: in it. */
void gn_occlusion_site_of(const struct gn_pose *pose, const struct gn_ray_surface *surface,
                          struct gn_occlusion_site *site);
/* Light that arrives by rays first to last - 1 of an endless even sequence, whose parts of 4, 8 and
 * 16 from a multiple of that on are even, too. Adds what would without anything in the way to
 * *whole. */
double gn_occlusion_cast(const struct gn_occlusion *occlusion, const struct gn_occlusion_site *site,
                         uint32_t first, uint32_t last, double *whole);

/* ---- occlusion_fit.c ---- */

enum { GN_OCCLUSION_RAYS = 2 << 20 }; /* about so many make a volume */

struct gn_occlusion_work {
    uint32_t rays; /* 0: GN_OCCLUSION_RAYS */
    int threads;   /* of the rays; 0: one for each processor that this process may use */
    const atomic_bool *cancel; /* another thread sets it to end the work early; or NULL */
};
struct gn_occlusion_made {
    int8_t (*texels)[4]; /* by cube of scene->occlusion: x, y, z, w times 127. malloc'ed; NULL: the
                            scene has no room for it, the work was cancelled, or the cubes are too
                            coarse for what they would show, as of a street */
    float error; /* how far off the measured shares it is, root mean square, noise of the rays taken
                    off */
};
/* Of the clips, as gn_pose_init() has them: fitted to some poses of them at once, since in each the
 * volume is looked up at the same places; what of it these clips move away gets none. The same bits
 * with any number of threads. */
struct gn_occlusion_made gn_occlusion_make(const struct gn_scene *scene, int clips,
                                           const struct gn_sky *sky,
                                           const struct gn_occlusion_work *work);
/* A hash of all that it is made of with GN_OCCLUSION_RAYS, sources of this program included. */
uint64_t gn_occlusion_key(const struct gn_scene *scene, int clips, const struct gn_sky *sky);
/* What a shader reads of it, 0 to 1. */
float gn_occlusion_read(const struct gn_scene_occlusion *grid, const int8_t (*texels)[4],
                        const double point_ws[3], const float normal_ws[3]);

#endif
