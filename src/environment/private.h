/* Inside the environment room: a tree over the sphere. Its leaves are the texels of a cube, and
 * each node of a level is the sum of the four below it. */
#ifndef GN_ENVIRONMENT_PRIVATE_H
#define GN_ENVIRONMENT_PRIVATE_H

#include "core/srgb.h"
#include "environment/environment.h"

enum {
    GN_SPHERE_LEVELS = 8, /* sides of 1 to 128 */
    GN_SPHERE_PX = 1 << (GN_SPHERE_LEVELS - 1),
    GN_SPHERE_LEAVES = 6 * GN_SPHERE_PX * GN_SPHERE_PX,
};
struct gn_sphere_node {
    float sum[3];       /* radiance times solid angle */
    float solid_angle;  /* steradian */
    float direction[3]; /* unit: the middle of what light it has */
};
struct gn_sphere {
    struct gn_sphere_node *levels[GN_SPHERE_LEVELS]; /* of 6 x side x side nodes */
};

static inline struct gn_sphere_node *gn_sphere_node(const struct gn_sphere *sphere, int level,
                                                    int face, int x, int y) {
    const int side = 1 << level;
    return &sphere->levels[level][(face * side + y) * side + x];
}
static inline float gn_dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* sphere.c: fills leaves that nothing was added to, and makes the levels above the leaves. */
void gn_sphere_complete(struct gn_sphere *sphere);
void gn_sphere_sum(struct gn_sphere *sphere);
/* key.c: takes the key out of the leaves and completes the sphere again. */
void gn_sphere_take_key(struct gn_sphere *sphere, struct gn_environment_key *key);
/* prefilter.c, harmonics.c: of a complete sphere. */
void gn_sphere_prefilter(const struct gn_sphere *sphere, int threads, uint32_t *texels);
void gn_sphere_harmonics(const struct gn_sphere *sphere, float harmonics[][3]);
/* One direction, a roughness: what a texel of that level holds. */
void gn_sphere_reflect(const struct gn_sphere *sphere, const float n[3], float roughness,
                       float rgb[3]);

#endif
