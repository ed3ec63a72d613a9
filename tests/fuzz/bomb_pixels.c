/* By rasterizing in homogeneous coordinates, which needs no clipping (Olano, Greer, "Triangle Scan
 * Conversion using 2D Homogeneous Coordinates", 1997): a sample (x, y) is inside where the three
 * weights u of x = sum u_i x_i, y = sum u_i y_i, 1 = sum u_i w_i are positive. */
#include "fuzz/bomb_pixels.h"

#include <cglm/cglm.h>

#include "blocks.glsl"

enum { SIDE = 16, TRIANGLES_MAX = 40000 };

static uint64_t count_triangles(const struct gn_plan *plan, const struct gn_draw *draw) {
    return draw->geometry == GN_NO_GEOMETRY
               ? 0
               : (uint64_t)draw->instance_count *
                     (plan->scene->geometries[draw->geometry].index_count / 3);
}

/* x, y and w of a corner, where the pass draws it. */
static void project(const float (*clip)[4], const struct gn_instance *instance, const float *at,
                    double out[3]) {
    static const int rows[3] = {0, 1, 3};
    double world[3];
    for (int k = 0; k < 3; k++)
        world[k] = (double)(instance->world[k][0] * at[0] + instance->world[k][1] * at[1] +
                            instance->world[k][2] * at[2] + instance->world[k][3]);
    for (int k = 0; k < 3; k++) {
        out[k] = (double)clip[3][rows[k]];
        for (int i = 0; i < 3; i++) out[k] += (double)clip[i][rows[k]] * world[i];
    }
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* The share of the target's samples inside a triangle. */
static double share_of(const struct gn_plan *plan, const struct gn_pass *pass,
                       const struct gn_draw *draw, uint64_t number) {
    const struct gn_scene_buffers *buffers = &plan->scene->buffers;
    const struct gn_geometry *geometry = &plan->scene->geometries[draw->geometry];
    const uint64_t each = geometry->index_count / 3;
    const uint32_t *index = buffers->indices + geometry->first_index + 3 * (number % each);
    const struct gn_instance *instance = &plan->instances[draw->first_instance + number / each];
    double corner[3][3], weight[3][3], area = 0;
    for (int i = 0; i < 3; i++)
        project(pass->constants + PASS_CLIP, instance, buffers->positions + 3 * (size_t)index[i],
                corner[i]);
    for (int i = 0; i < 3; i++) cross(corner[(i + 1) % 3], corner[(i + 2) % 3], weight[i]);
    for (int k = 0; k < 3; k++) area += corner[0][k] * weight[0][k];
    const double least = 1e-6 * fabs(corner[0][2] * corner[1][2] * corner[2][2]);
    int inside = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const double at[3] = {(2 * x + 1.0) / SIDE - 1, (2 * y + 1.0) / SIDE - 1, 1};
            bool in = fabs(area) > least; /* else thinner than a GPU's steps */
            for (int i = 0; i < 3; i++)
                in &=
                    (weight[i][0] * at[0] + weight[i][1] * at[1] + weight[i][2] * at[2]) * area > 0;
            inside += in;
        }
    return (double)inside / (SIDE * SIDE);
}

double gn_bomb_overdraw(const struct gn_plan *plan) {
    uint64_t all = 0, seen = 0;
    double layers = 0;
    for (uint32_t i = 0; i < plan->pass_count; i++)
        for (uint32_t k = 0; k < plan->passes[i].draw_count; k++)
            if (plan->passes[i].kind == GN_PASS_PICTURE)
                all += count_triangles(plan, &plan->draws[plan->passes[i].first_draw + k]);
    const uint64_t step = 1 + all / TRIANGLES_MAX;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        const double cost = pass->picture.blend == GN_BLEND_OFF ? 0.25 : 1;
        for (uint32_t k = 0; k < pass->draw_count && pass->kind == GN_PASS_PICTURE; k++) {
            const struct gn_draw *draw = &plan->draws[pass->first_draw + k];
            const uint64_t count = count_triangles(plan, draw);
            const uint64_t features = plan->programs[draw->program].features;
            const bool posed = features & (GN_FEATURE(SKIN) | GN_FEATURE(MORPH));
            for (uint64_t t = (step - seen % step) % step; t < count && !posed; t += step)
                layers += cost * (double)step * share_of(plan, pass, draw, t);
            seen += count;
        }
    }
    return layers;
}
