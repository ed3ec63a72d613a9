/* The key light of an environment: the excess of its brightest lobe over the brightest of all the
 * rest. The excess becomes a directional light, and the environment keeps what is below: together
 * they have the energy of the whole, and the lobe is still seen in reflections, as bright as the
 * brightest of the others. */
#include <math.h>

#include "environment/private.h"

enum { CELL_LEVEL = 5 };       /* cells of 3 degrees: what is compared */
#define LOBE_COSINE 0.8191520f /* 35 degrees around its brightest cell */

static float mean_luminance(const struct gn_sphere_node *node) {
    return node->solid_angle > 0.0f ? gn_luminance(node->sum) / node->solid_angle : 0.0f;
}

/* Of the brightest lobe and the brightest of the rest. */
static const struct gn_sphere_node *find_peak(const struct gn_sphere *sphere, float *rest) {
    const struct gn_sphere_node *cells = sphere->levels[CELL_LEVEL], *peak = cells;
    const int count = 6 << 2 * CELL_LEVEL;
    for (int i = 1; i < count; i++)
        if (mean_luminance(&cells[i]) > mean_luminance(peak)) peak = &cells[i];
    *rest = 0.0f;
    for (int i = 0; i < count; i++)
        if (gn_dot(cells[i].direction, peak->direction) < LOBE_COSINE)
            *rest = fmaxf(*rest, mean_luminance(&cells[i]));
    return peak;
}

void gn_sphere_take_key(struct gn_sphere *sphere, struct gn_environment_key *key) {
    float rest, toward[3] = {0}, light = 0.0f, spread = 0.0f;
    const struct gn_sphere_node *peak = find_peak(sphere, &rest);
    const float middle[3] = {peak->direction[0], peak->direction[1], peak->direction[2]};
    struct gn_sphere_node *leaves = sphere->levels[GN_SPHERE_LEVELS - 1];
    *key = (struct gn_environment_key){.direction = {middle[0], middle[1], middle[2]}};
    for (int pass = 0; pass < 2; pass++) { /* first its direction, then its light as seen there */
        for (int i = 0; i < GN_SPHERE_LEAVES; i++) {
            struct gn_sphere_node *leaf = &leaves[i];
            const float share = 1.0f - rest / fmaxf(mean_luminance(leaf), 1e-20f);
            if (share <= 0.0f || gn_dot(leaf->direction, middle) < LOBE_COSINE) continue;
            const float excess = share * gn_luminance(leaf->sum);
            const float cosine = gn_dot(leaf->direction, key->direction);
            for (int k = 0; k < 3 && pass == 0; k++) toward[k] += excess * leaf->direction[k];
            if (pass == 0) continue;
            light += excess;
            spread += excess * (1.0f / fmaxf(cosine * cosine, 0.1f) - 1.0f);
            for (int k = 0; k < 3; k++) {
                key->color[k] += share * leaf->sum[k] * cosine;
                leaf->sum[k] *= 1.0f - share;
            }
        }
        const float length = sqrtf(gn_dot(toward, toward));
        for (int k = 0; k < 3 && length > 0.0f; k++) key->direction[k] = toward[k] / length;
    }
    /* squares of tangents over a disc are half that of its rim on average */
    key->radius = light > 0.0f ? sqrtf(2.0f * spread / light) : 0.0f;
    gn_sphere_sum(sphere);
}
