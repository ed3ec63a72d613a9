#include <math.h>
#include <string.h>

#include "environment/daylight.h"
#include "environment/private.h"

/* Radiance at the middle of a texel of the first level goes to the four leaves in it. */
static void add_texel(struct gn_sphere *sphere, const struct gn_daylight *daylight,
                      const float to_sun[3], int face, const float middle[2]) {
    const float half = 0.5f / GN_ENVIRONMENT_PX, side = 2.0f * half;
    float to[3], rgb[3];
    gn_environment_direction(face, middle[0], middle[1], to);
    gn_daylight_sky(daylight, to_sun, to, rgb);
    for (int i = 0; i < 4; i++) {
        const float s = middle[0] + (i % 2 ? half : -half), t = middle[1] + (i / 2 ? half : -half);
        gn_environment_direction(face, s, t, to);
        gn_sphere_add(sphere, to, rgb, side * side / powf(1.0f + s * s + t * t, 1.5f));
    }
}

void gn_environment_make_sky(const struct gn_daylight *daylight, const float to_sun[3], int threads,
                             struct gn_environment *out) {
    enum { PX = GN_ENVIRONMENT_PX };
    struct gn_sphere *sphere = gn_sphere_create();
    for (int i = 0; i < 6 * PX * PX; i++) {
        const float middle[2] = {(2.0f * (float)(i % PX) + 1.0f) / PX - 1.0f,
                                 (2.0f * (float)(i / PX % PX) + 1.0f) / PX - 1.0f};
        add_texel(sphere, daylight, to_sun, i / (PX * PX), middle);
    }
    gn_sphere_complete(sphere);
    memset(out, 0, sizeof *out);
    gn_sphere_prefilter(sphere, threads, out->whole.texels);
    gn_sphere_harmonics(sphere, out->whole.harmonics);
    gn_sphere_destroy(sphere);
}

void gn_environment_scale(const struct gn_environment_light *of, float factor,
                          struct gn_environment_light *out) {
    for (int i = 0; i < GN_ENVIRONMENT_TEXELS; i++) {
        float rgb[3];
        gn_environment_unpack(of->texels[i], rgb);
        for (int k = 0; k < 3; k++) rgb[k] *= factor;
        out->texels[i] = gn_environment_pack(rgb);
    }
    for (int i = 0; i < GN_ENVIRONMENT_HARMONICS; i++)
        for (int k = 0; k < 3; k++) out->harmonics[i][k] = factor * of->harmonics[i][k];
}
