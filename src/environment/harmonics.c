/* Irradiance by spherical harmonics of nine coefficients: Ramamoorthi, Hanrahan, "An Efficient
 * Representation for Irradiance Environment Maps" (2001). */
#include <string.h>

#include "environment/private.h"

static void polynomials(const float n[3], float out[GN_ENVIRONMENT_HARMONICS]) {
    const float x = n[0], y = n[1], z = n[2];
    const float values[] = {1.0f, y, z, x, x * y, y * z, 3.0f * z * z - 1.0f, x * z, x * x - y * y};
    memcpy(out, values, sizeof values);
}

/* Squares of the harmonics' factors, times the cosine lobe's share of each band: 1, 2/3, 1/4. */
static const float factors[GN_ENVIRONMENT_HARMONICS] = {0.0795775f, 0.1591549f, 0.1591549f,
                                                        0.1591549f, 0.2984155f, 0.2984155f,
                                                        0.0248680f, 0.2984155f, 0.0746039f};

void gn_sphere_harmonics(const struct gn_sphere *sphere, float harmonics[][3]) {
    double sums[GN_ENVIRONMENT_HARMONICS][3] = {0};
    const struct gn_sphere_node *leaves = sphere->levels[GN_SPHERE_LEVELS - 1];
    for (int i = 0; i < GN_SPHERE_LEAVES; i++) {
        float p[GN_ENVIRONMENT_HARMONICS];
        polynomials(leaves[i].direction, p);
        for (int h = 0; h < GN_ENVIRONMENT_HARMONICS; h++)
            for (int k = 0; k < 3; k++) sums[h][k] += (double)(p[h] * leaves[i].sum[k]);
    }
    for (int h = 0; h < GN_ENVIRONMENT_HARMONICS; h++)
        for (int k = 0; k < 3; k++) harmonics[h][k] = factors[h] * (float)sums[h][k];
}

void gn_environment_diffuse(const struct gn_environment_light *light, const float n[3],
                            float rgb[3]) {
    float p[GN_ENVIRONMENT_HARMONICS];
    polynomials(n, p);
    for (int k = 0; k < 3; k++) {
        rgb[k] = 0.0f;
        for (int h = 0; h < GN_ENVIRONMENT_HARMONICS; h++) rgb[k] += p[h] * light->harmonics[h][k];
        if (rgb[k] < 0.0f) rgb[k] = 0.0f;
    }
}
