/* The split sum's first part (Karis, "Real Shading in Unreal Engine 4", 2013): radiance weighted by
 * GGX with normal and view along the reflection. There the half vector is at half the angle of the
 * light, so that a weight depends on that angle alone: D(cos(angle / 2)) cos(angle). The sum over
 * the sphere walks a tree and stops at nodes that are small beside the scale on which the weight
 * changes (Barnes, Hut 1986): deterministic and free of noise, and uniform light stays exact, since
 * the sum of the weights divides. */
#include <pthread.h>
#include <string.h>

#include "environment/private.h"

#define OPENING 0.15f /* of a node: its radius over the scale of the weight */

struct lobe {
    float normal[3];
    float alpha2; /* roughness to the fourth */
    float sum[3], weight;
};

static float weight_of(const struct lobe *lobe, float cosine) {
    const float half2 = 0.5f + 0.5f * cosine, d = (lobe->alpha2 - 1.0f) * half2 + 1.0f;
    return cosine > 0.0f ? cosine / (d * d) : 0.0f;
}

static void add_node(struct lobe *lobe, const struct gn_sphere *sphere, int level, int face, int x,
                     int y) {
    const struct gn_sphere_node *node = gn_sphere_node(sphere, level, face, x, y);
    const float radius = 1.4142f / (float)(1 << level);
    const float cosine = gn_dot(lobe->normal, node->direction);
    if (cosine < -radius) return;
    const float scale2 = 4.0f * lobe->alpha2 + 2.0f * (1.0f - cosine);
    if (level < GN_SPHERE_LEVELS - 1 && radius * radius > OPENING * OPENING * scale2) {
        for (int c = 0; c < 4; c++)
            add_node(lobe, sphere, level + 1, face, 2 * x + c % 2, 2 * y + c / 2);
        return;
    }
    const float weight = weight_of(lobe, cosine);
    for (int k = 0; k < 3; k++) lobe->sum[k] += weight * node->sum[k];
    lobe->weight += weight * node->solid_angle;
}

void gn_sphere_reflect(const struct gn_sphere *sphere, const float n[3], float roughness,
                       float rgb[3]) {
    const float alpha = roughness * roughness;
    struct lobe lobe = {.normal = {n[0], n[1], n[2]}, .alpha2 = alpha * alpha};
    for (int face = 0; face < 6; face++) add_node(&lobe, sphere, 0, face, 0, 0);
    for (int k = 0; k < 3; k++) rgb[k] = lobe.weight > 0.0f ? lobe.sum[k] / lobe.weight : 0.0f;
}

/* A mirror's texel: the leaves in it. */
static void average_texel(const struct gn_sphere *sphere, int face, int x, int y, float rgb[3]) {
    enum { LEVEL = GN_SPHERE_LEVELS - 2 };
    _Static_assert(1 << LEVEL == GN_ENVIRONMENT_PX, "the level of that size");
    const struct gn_sphere_node *node = gn_sphere_node(sphere, LEVEL, face, x, y);
    for (int k = 0; k < 3; k++)
        rgb[k] = node->solid_angle > 0.0f ? node->sum[k] / node->solid_angle : 0.0f;
}

struct part { /* every so many-th row of texels */
    const struct gn_sphere *sphere;
    uint32_t *texels;
    int first, step;
};

static void *prefilter_part(void *user) {
    const struct part *part = user;
    uint32_t *to = part->texels;
    int row = 0;
    for (int level = 0; level < GN_ENVIRONMENT_LEVELS; level++) {
        const int side = GN_ENVIRONMENT_PX >> level;
        const float roughness = (float)level / (GN_ENVIRONMENT_LEVELS - 1);
        for (int face = 0; face < 6; face++)
            for (int y = 0; y < side; y++, row++, to += side)
                for (int x = 0; x < side && row % part->step == part->first; x++) {
                    float n[3], rgb[3];
                    gn_environment_direction(face, (2.0f * (float)x + 1.0f) / (float)side - 1.0f,
                                             (2.0f * (float)y + 1.0f) / (float)side - 1.0f, n);
                    if (level == 0)
                        average_texel(part->sphere, face, x, y, rgb);
                    else
                        gn_sphere_reflect(part->sphere, n, roughness, rgb);
                    to[x] = gn_environment_pack(rgb);
                }
    }
    return NULL;
}

void gn_sphere_prefilter(const struct gn_sphere *sphere, int threads, uint32_t *texels) {
    struct part parts[2] = {{sphere, texels, 0, 1}, {sphere, texels, 1, 2}};
    pthread_t other;
    const bool two = threads > 1;
    parts[0].step = two ? 2 : 1;
    const bool started = two && pthread_create(&other, NULL, prefilter_part, &parts[1]) == 0;
    prefilter_part(&parts[0]);
    if (started)
        pthread_join(other, NULL);
    else if (two)
        prefilter_part(&parts[1]);
}
