#include "shadow/slide.h"

#include <math.h>

#include "shadow/fit.h"

#define LEAST_M 1e-6f /* what is nearer to the light gets nothing of the slide */

enum gn_slide gn_slide_of(const struct gn_light *light) {
    if (!gn_light_types[light->type].has_cone || light->slide < 0) return GN_SLIDE_NONE;
    return light->slide_lit_outside ? GN_SLIDE_LIT : GN_SLIDE_DARK;
}

void gn_slide_build(const struct gn_pose *pose, uint32_t light, float aspect,
                    struct gn_slide_view *view) {
    const struct gn_light *l = &pose->lights[light];

    /* its distance, and its width and height one metre from the light */
    const float *given = l->slide_size_m;
    const float cone = 2.0f * tanf(fminf(l->outer_rad, GN_SPOT_MAX_RAD));
    float distance = l->slide_distance_m, size[2] = {cone, cone};
    if (given[0] > 0.0f && given[1] > 0.0f) {
        if (distance <= 0.0f) distance = fmaxf(given[0], given[1]) / cone;
        for (int k = 0; k < 2; k++) size[k] = given[k] / distance;
    } else if (aspect > 0.0f) {
        size[0] *= fminf(aspect, 1.0f);
        size[1] /= fmaxf(aspect, 1.0f);
    }
    view->near_m = fmaxf(distance, LEAST_M);

    mat4 light_from_world;
    gn_pose_light_view(pose, light, light_from_world);
    for (int c = 0; c < 4; c++) {
        float x = light_from_world[c][0], y = light_from_world[c][1],
              depth = -light_from_world[c][2];
        view->u[c] = x / size[0] + 0.5f * depth;
        view->v[c] = 0.5f * depth - y / size[1];
        view->w[c] = depth;
    }
}
