/* An environment: the light that arrives from all directions, prefiltered for shaders. Pure: no GL,
 * no clock, no files. World space, Y up; linear radiance. */
#ifndef GN_ENVIRONMENT_ENVIRONMENT_H
#define GN_ENVIRONMENT_ENVIRONMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

enum {
    GN_ENVIRONMENT_PX = 64,    /* side of a face of the cube's first level */
    GN_ENVIRONMENT_LEVELS = 5, /* 64 to 4: of roughness 0, 1/4, 1/2, 3/4, 1 */
    GN_ENVIRONMENT_TEXELS = 6 * (64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4),
    GN_ENVIRONMENT_HARMONICS = 9,
};

/* What shaders read. All words of 4 bytes. */
struct gn_environment_light {
    /* GL_R11F_G11F_B10F; level by level, in it face by face in GL's order (+X -X +Y -Y +Z -Z) and
     * with GL's directions, row by row. Radiance, weighted by GGX with the normal along the
     * reflection (Karis 2013) */
    uint32_t texels[GN_ENVIRONMENT_TEXELS];
    /* Radiance of a white diffuse surface by its normal n: the sum of harmonics[i] times 1, y, z,
     * x, xy, yz, 3zz - 1, xz, xx - yy (Ramamoorthi, Hanrahan 2001) */
    float harmonics[GN_ENVIRONMENT_HARMONICS][3];
};

/* The brightest lobe, as a directional light: what of it is brighter than all the rest. */
struct gn_environment_key {
    float direction[3]; /* unit, to the light */
    float color[3];     /* lux on a surface that faces it; 0: no lobe is brighter than the rest */
    float radius;       /* tangent of its angular radius */
};

struct gn_environment {
    struct gn_environment_light whole, rest; /* rest: without the key */
    struct gn_environment_key key;
    struct gn_environment_light shown; /* rest, but smooth surfaces reflect what the key's highlight
                                          lacks of it: gn_environment_key_share() */
};
/* Share of the key that its highlight has, beside `shown`: its shape in a mirror is that of the
 * environment, and what rough surfaces reflect can be shadowed. */
float gn_environment_key_share(float roughness);

/* ---- the light of a sphere, gathered ---- */

struct gn_sphere;
struct gn_sphere *gn_sphere_create(void);
void gn_sphere_destroy(struct gn_sphere *sphere);
/* Radiance from a solid angle (steradian) around a direction, which need not be of unit length.
 * What is not a finite number of at least 0 counts as 0. */
void gn_sphere_add(struct gn_sphere *sphere, const float direction[3], const float radiance[3],
                   float solid_angle);
/* A row of an equirectangular picture of that size: row 0 is the zenith's; columns turn from -X by
 * -Z, +X (the middle) and +Z. */
void gn_sphere_add_row(struct gn_sphere *sphere, uint32_t y, const uint32_t px[2],
                       const float (*radiance)[3]);
/* Prefilters what was added, with so many threads at most. The same input gives the same bits. */
void gn_environment_make(struct gn_sphere *sphere, int threads, struct gn_environment *out);
/* From a Radiance picture. */
struct gn_environment_work {
    int threads;                                /* at most */
    void (*progress)(void *user, double share); /* after each row, of all rows; or NULL */
    void *user;
};
bool gn_environment_read_hdr(const uint8_t *data, size_t size,
                             const struct gn_environment_work *work, struct gn_environment *out,
                             struct gn_err *err);

/* ---- the sky ---- */

/* The light of a clear sky and of the ground below, with the sun in a unit direction that has the
 * daylight's altitude: `whole`; the rest is zero, for the sun is a light of its own. With so many
 * threads at most; the same input gives the same bits. */
struct gn_daylight;
void gn_environment_make_sky(const struct gn_daylight *daylight, const float to_sun[3], int threads,
                             struct gn_environment *out);
/* The same light, so many times as bright. */
void gn_environment_scale(const struct gn_environment_light *of, float factor,
                          struct gn_environment_light *out);

/* ---- kept in a file ---- */

enum { GN_ENVIRONMENT_FILE_BYTES = 8 + (int)offsetof(struct gn_environment, shown) + 8 };
void gn_environment_write(const struct gn_environment *environment,
                          uint8_t out[GN_ENVIRONMENT_FILE_BYTES]);
/* False: it is broken, or of another version. */
bool gn_environment_read(const uint8_t *data, size_t size, struct gn_environment *out);

/* ---- on the CPU, for tests ---- */

uint32_t gn_environment_pack(const float rgb[3]);
void gn_environment_unpack(uint32_t texel, float rgb[3]);
/* As a shader computes it: diffuse by the normal; a texel's centre as a direction. */
void gn_environment_diffuse(const struct gn_environment_light *light, const float n[3],
                            float rgb[3]);
void gn_environment_direction(int face, float s, float t, float direction[3]); /* s, t: -1..1 */

#endif
