/* The first surface on a line of sight, without a tree: for one ray now and then. */
#include <cglm/cglm.h>
#include <math.h>

#include "scene/pose.h"

enum { WORK = 1 << 22 }; /* triangles at most: a tenth of a second on a small board */

/* Whether the line is in the box somewhere nearer than most_m. */
static bool meets_box(const struct gn_box *box, const vec3 from_ws, const vec3 along,
                      float most_m) {
    float enter = 0, leave = most_m;
    for (int k = 0; k < 3; k++) {
        const float inverse = 1 / along[k]; /* infinite along a side: that of a NaN is no limit */
        const float a = (box->min[k] - from_ws[k]) * inverse,
                    b = (box->max[k] - from_ws[k]) * inverse;
        enter = fmaxf(enter, fminf(a, b));
        leave = fminf(leave, fmaxf(a, b));
    }
    return enter <= leave;
}

/* Moeller, Trumbore 1997. The distance; INFINITY: beside the triangle, or of its back face, which
 * is not seen. */
static float triangle_m(vec3 corner[3], const vec3 from_ws, const vec3 along, bool mirrored,
                        bool both_sides) {
    vec3 u, v, p, q, to;
    glm_vec3_sub(corner[1], corner[0], u);
    glm_vec3_sub(corner[2], corner[0], v);
    glm_vec3_cross((float *)along, v, p);
    const float det = glm_vec3_dot(u, p);
    if (det == 0 || (!both_sides && (det < 0) != mirrored)) return INFINITY;
    glm_vec3_sub((float *)from_ws, corner[0], to);
    glm_vec3_cross(to, u, q);
    const float a = glm_vec3_dot(to, p) / det, b = glm_vec3_dot((float *)along, q) / det;
    return a >= 0 && b >= 0 && a + b <= 1 ? glm_vec3_dot(v, q) / det : INFINITY;
}

float gn_pose_surface_m(const struct gn_pose *pose, const vec3 from_ws, const vec3 along,
                        float least_m) {
    const struct gn_scene *scene = pose->scene;
    float nearest_m = INFINITY;
    uint32_t work = WORK;
    for (uint32_t i = 0; i < scene->item_count && work > 0; i++) {
        const struct gn_pose_item *posed = &pose->items[i];
        const struct gn_material *material = &pose->materials[scene->items[i].material];
        if (!posed->visible || material->shadow_catcher ||
            !meets_box(&posed->box_ws, from_ws, along, nearest_m))
            continue;
        const struct gn_geometry *geometry = &scene->geometries[scene->items[i].geometry];
        const uint32_t *index = scene->buffers.indices + geometry->first_index;
        for (uint32_t t = 0; t + 2 < geometry->index_count && work > 0; t += 3, work--) {
            vec3 corner[3];
            for (int k = 0; k < 3; k++) gn_pose_corner(pose, i, index[t + (uint32_t)k], corner[k]);
            const float m =
                triangle_m(corner, from_ws, along, posed->mirrored, material->double_sided);
            if (m >= least_m && m < nearest_m) nearest_m = m;
        }
    }
    return nearest_m;
}
