/* Finds the receivers of planar shadows: items marked by gnomon_plane, else the largest flat item
 * of the scene if it is large enough to be a floor or a wall. */
#include "scene/private.h"

#include <math.h>

#include "scene/pose.h"

/* The minimum share of the scene's box, projected along the plane's normal, that it covers. */
static const double LEAST_SHARE = .3;

/* Whether two flat items lie in one plane. */
static bool lie_together(const struct gn_pose *pose, uint32_t a, uint32_t b) {
    const float size = glm_vec3_distance((float *)pose->box_ws.min, (float *)pose->box_ws.max);
    vec4 p, q;
    gn_pose_plane(pose, a, p);
    gn_pose_plane(pose, b, q);
    if (glm_vec3_dot(p, q) < 0) glm_vec4_negate(q);
    return glm_vec3_distance(p, q) < 1e-4f && fabsf(p[3] - q[3]) < 1e-4f * size;
}

/* Marked items make up planes, in the order of their items, as many as there may be. One that is
 * not visible at first lies in the first plane. */
static bool mark_named_planes(struct gn_gltf *g, const struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    bool named = false;
    uint32_t first[GN_PLANES_MAX]; /* items */
    int count = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        struct gn_item *item = &scene->items[i];
        if (g->placed[item->node].plane != GN_YES) continue;
        named = true;
        item->plane = scene->geometries[item->geometry].flat;
        if (!item->plane)
            gn_gltf_warn(g, NULL, "gnomon_plane: node '%.60s' is not flat; ignored",
                         scene->nodes[item->node].name);
        if (!item->plane || !pose->items[i].visible) continue;
        int at = 0;
        while (at < count && !lie_together(pose, first[at], i)) at++;
        item->plane = at < GN_PLANES_MAX ? (uint8_t)(at + 1) : 0;
        if (at == count && at < GN_PLANES_MAX) first[count++] = i;
        if (!item->plane)
            gn_gltf_warn(g, NULL,
                         "gnomon_plane: node '%.60s' lies in plane %d, of at most %d; ignored",
                         scene->nodes[item->node].name, at + 1, GN_PLANES_MAX);
    }
    return named;
}

void gn_scene_find_plane(struct gn_gltf *g, const struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    if (mark_named_planes(g, pose)) return;
    double best = 0, s[3]; /* s: sides of the scene's box */
    for (int k = 0; k < 3; k++) s[k] = (double)pose->box_ws.max[k] - (double)pose->box_ws.min[k];
    struct gn_item *found = NULL;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        struct gn_item *item = &scene->items[i];
        struct gn_geometry *geometry = &scene->geometries[item->geometry];
        bool may = geometry->flat && pose->items[i].visible && item->receives;
        if (!may || g->placed[item->node].plane == GN_NO) continue;
        /* the cofactor matrix gives the direction of the normal, and by its length how much the
         * area grows */
        mat3 cofactor;
        vec3 n;
        gn_cofactor(pose->items[i].world_from_item, cofactor);
        glm_mat3_mulv(cofactor, geometry->plane, n);
        double stretch = (double)glm_vec3_norm(n);
        double area = g->primitives.shapes[item->geometry].area * stretch;
        if (stretch > 0) glm_vec3_scale(n, (float)(1 / stretch), n);
        double box_area = fabs((double)n[0]) * s[1] * s[2] + fabs((double)n[1]) * s[2] * s[0] +
                          fabs((double)n[2]) * s[0] * s[1]; /* projected along n */
        if (area <= best || area < LEAST_SHARE * box_area) continue;
        best = area;
        found = item;
    }
    if (found) found->plane = 1;
}
