/* Finds the receivers of planar shadows: items marked by gnomon_plane, else the largest flat item
 * of the scene if it is large enough to be a floor or a wall. */
#include "scene/private.h"

#include <math.h>

#include "scene/pose.h"

/* The minimum share of the scene's box, projected along the plane's normal, that it covers. */
static const double LEAST_SHARE = .3;

/* All marked items must lie in the plane of the first. */
static bool mark_named_planes(struct gn_gltf *g, const struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    const float size = glm_vec3_distance((float *)pose->box_ws.min, (float *)pose->box_ws.max);
    bool named = false;
    int64_t first = -1;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        struct gn_item *item = &scene->items[i];
        if (g->placed[item->node].plane != GN_YES) continue;
        named = true;
        item->plane = scene->geometries[item->geometry].flat;
        if (!item->plane)
            gn_gltf_warn(g, NULL, "gnomon_plane: node '%.60s' is not flat; ignored",
                         scene->nodes[item->node].name);
        if (!item->plane || !pose->items[i].visible) continue;
        if (first < 0) first = i;
        vec4 p, q;
        gn_pose_plane(pose, (uint32_t)first, p);
        gn_pose_plane(pose, i, q);
        if (glm_vec3_dot(p, q) < 0) glm_vec4_negate(q);
        item->plane = glm_vec3_distance(p, q) < 1e-4f && fabsf(p[3] - q[3]) < 1e-4f * size;
        if (!item->plane)
            gn_gltf_warn(
                g, NULL, "gnomon_plane: node '%.60s' lies in another plane than '%.60s'; ignored",
                scene->nodes[item->node].name, scene->nodes[scene->items[first].node].name);
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
    if (found) found->plane = true;
}
