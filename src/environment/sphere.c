/* Gathers the light of a sphere in the texels of a cube: every piece goes wholly to the texel at
 * its middle, so that no energy is lost, and a sun of one pixel stays one. */
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "environment/private.h"

#define PI 3.14159265358979f

struct gn_sphere *gn_sphere_create(void) {
    struct gn_sphere *sphere = gn_xalloc(1, sizeof *sphere);
    for (int level = 0; level < GN_SPHERE_LEVELS; level++)
        sphere->levels[level] = gn_xalloc((size_t)6 << 2 * level, sizeof(struct gn_sphere_node));
    return sphere;
}

void gn_sphere_destroy(struct gn_sphere *sphere) {
    if (!sphere) return;
    for (int level = 0; level < GN_SPHERE_LEVELS; level++) free(sphere->levels[level]);
    free(sphere);
}

/* Axes of GL's cube faces: of s, of t, and of the face. */
static const int8_t faces[6][3][3] = {
    {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
    {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
};

void gn_environment_direction(int face, float s, float t, float direction[3]) {
    const float scale = 1.0f / sqrtf(1.0f + s * s + t * t);
    for (int k = 0; k < 3; k++)
        direction[k] = scale * ((float)faces[face][0][k] * s + (float)faces[face][1][k] * t +
                                (float)faces[face][2][k]);
}

static int texel_of(float s) {
    const int i = (int)((0.5f * s + 0.5f) * GN_SPHERE_PX);
    return i < 0 ? 0 : i >= GN_SPHERE_PX ? GN_SPHERE_PX - 1 : i;
}

void gn_sphere_add(struct gn_sphere *sphere, const float direction[3], const float radiance[3],
                   float solid_angle) {
    int axis = fabsf(direction[0]) >= fabsf(direction[1]) ? 0 : 1;
    if (fabsf(direction[2]) > fabsf(direction[axis])) axis = 2;
    const int face = 2 * axis + (direction[axis] < 0.0f);
    const float scale = 1.0f / fabsf(direction[axis]);
    float st[2];
    for (int i = 0; i < 2; i++)
        st[i] = scale *
                ((float)faces[face][i][0] * direction[0] + (float)faces[face][i][1] * direction[1] +
                 (float)faces[face][i][2] * direction[2]);
    struct gn_sphere_node *leaf =
        gn_sphere_node(sphere, GN_SPHERE_LEVELS - 1, face, texel_of(st[0]), texel_of(st[1]));
    for (int k = 0; k < 3; k++)
        leaf->sum[k] +=
            isfinite(radiance[k]) && radiance[k] > 0.0f ? radiance[k] * solid_angle : 0.0f;
    leaf->solid_angle += solid_angle;
}

/* Directions over a picture: at the corners of the cube a leaf is .3 degrees wide. */
enum { WIDTH_LEAST = 2048 };

void gn_sphere_add_row(struct gn_sphere *sphere, uint32_t y, const uint32_t px[2],
                       const float (*radiance)[3]) {
    const uint32_t times = (WIDTH_LEAST + px[0] - 1) / px[0];
    const uint32_t rows = (WIDTH_LEAST / 2 + px[1] - 1) / px[1];
    const float step = PI / (float)(px[1] * rows), turn = 2.0f * PI / (float)(px[0] * times);
    for (uint32_t i = 0; i < px[0] * times; i++) {
        const float around = turn * ((float)i + 0.5f) - PI;
        const float x = cosf(around), z = sinf(around);
        for (uint32_t k = 0; k < rows; k++) {
            const float down = step * ((float)(y * rows + k) + 0.5f), level = sinf(down);
            const float direction[3] = {level * x, cosf(down), level * z};
            gn_sphere_add(sphere, direction, radiance[i / times],
                          turn * 2.0f * sinf(0.5f * step) * level);
        }
    }
}

/* A leaf that nothing was added to gets a little of what is around it. */
static void fill_leaf(const struct gn_sphere *sphere, struct gn_sphere_node *leaf, int face, int x,
                      int y) {
    for (int level = GN_SPHERE_LEVELS - 2; level >= 0 && leaf->solid_angle <= 0.0f; level--) {
        const int shift = GN_SPHERE_LEVELS - 1 - level;
        const struct gn_sphere_node *above =
            gn_sphere_node(sphere, level, face, x >> shift, y >> shift);
        if (above->solid_angle <= 0.0f) continue;
        leaf->solid_angle = 1e-6f;
        for (int k = 0; k < 3; k++) leaf->sum[k] = above->sum[k] / above->solid_angle * 1e-6f;
    }
}

void gn_sphere_sum(struct gn_sphere *sphere) {
    for (int level = GN_SPHERE_LEVELS - 2; level >= 0; level--)
        for (int face = 0; face < 6; face++)
            for (int i = 0; i < 1 << 2 * level; i++) {
                const int x = i & ((1 << level) - 1), y = i >> level;
                struct gn_sphere_node *node = gn_sphere_node(sphere, level, face, x, y);
                float toward[3] = {0};
                *node = (struct gn_sphere_node){0};
                for (int c = 0; c < 4; c++) {
                    const struct gn_sphere_node *child =
                        gn_sphere_node(sphere, level + 1, face, 2 * x + c % 2, 2 * y + c / 2);
                    const float light = gn_luminance(child->sum) + 1e-6f * child->solid_angle;
                    node->solid_angle += child->solid_angle;
                    for (int k = 0; k < 3; k++) {
                        node->sum[k] += child->sum[k];
                        toward[k] += light * child->direction[k];
                    }
                }
                const float length = sqrtf(gn_dot(toward, toward));
                for (int k = 0; k < 3; k++)
                    node->direction[k] = length > 0.0f ? toward[k] / length : 0.0f;
            }
}

void gn_sphere_complete(struct gn_sphere *sphere) {
    const int level = GN_SPHERE_LEVELS - 1, side = GN_SPHERE_PX;
    gn_sphere_sum(sphere);
    for (int face = 0; face < 6; face++)
        for (int i = 0; i < side * side; i++) {
            const int x = i % side, y = i / side;
            struct gn_sphere_node *leaf = gn_sphere_node(sphere, level, face, x, y);
            gn_environment_direction(face, (2.0f * (float)x + 1.0f) / (float)side - 1.0f,
                                     (2.0f * (float)y + 1.0f) / (float)side - 1.0f,
                                     leaf->direction);
            fill_leaf(sphere, leaf, face, x, y);
        }
    gn_sphere_sum(sphere);
}
