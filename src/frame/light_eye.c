/* --camera light:NAME: the scene as a light sees it. */
#include <cglm/cglm.h>
#include <math.h>

#include "frame/private.h"

/* Of the half-angle: a wider cone is not seen whole, as its map does not hold it whole. */
#define WIDEST_RAD 1.3962634f /* 80 degrees */

/* However large the scene is, a lamp sees what is a hand away. */
#define NEAREST_M 0.05f

/* A spot's cone touches the shorter sides of the picture. */
static void look_from_spot(const struct gn_light *light, float size_m, float aspect,
                           struct gn_camera *camera) {
    const float slope = tanf(fminf(light->outer_rad, WIDEST_RAD));
    camera->yfov_rad = 2.0f * atanf(slope / fminf(aspect, 1.0f));
    camera->near_m = fminf(1e-3f * size_m, NEAREST_M);
}

/* What casts, without the ground and what moves, so that the picture stands still; or all. */
static struct gn_box find_casters(const struct gn_pose *pose) {
    const struct gn_scene *scene = pose->scene;
    struct gn_box box;
    glm_aabb_invalidate((vec3 *)&box);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        if (!gn_shadow_item_casts(scene, i) || item->plane || !pose->items[i].visible ||
            pose->items[i].moves)
            continue;
        glm_vec3_minv(box.min, (float *)pose->items[i].box_ws.min, box.min);
        glm_vec3_maxv(box.max, (float *)pose->items[i].box_ws.max, box.max);
    }
    return box.min[0] <= box.max[0] ? box : scene->box;
}

/* A directional light sees it from outside the scene. */
static void look_from_afar(const struct gn_box *box, float size_m, struct gn_camera *camera,
                           mat4 view_from_world) {
    vec3 seen[2];
    glm_aabb_invalidate(seen);
    for (int i = 0; i < 8; i++) {
        vec3 corner;
        for (int k = 0; k < 3; k++) corner[k] = i >> k & 1 ? box->max[k] : box->min[k];
        glm_mat4_mulv3(view_from_world, corner, 1.0f, corner);
        glm_vec3_minv(seen[0], corner, seen[0]);
        glm_vec3_maxv(seen[1], corner, seen[1]);
    }
    for (int k = 0; k < 2; k++) view_from_world[3][k] -= 0.5f * (seen[0][k] + seen[1][k]);
    view_from_world[3][2] -= seen[1][2] + size_m;
    camera->orthographic = true;
    camera->xmag_m = fmaxf(0.5f * (seen[1][0] - seen[0][0]), 1e-3f * size_m);
    camera->ymag_m = fmaxf(0.5f * (seen[1][1] - seen[0][1]), 1e-3f * size_m);
}

void gn_frame_light_camera(const struct gn_pose *pose, uint32_t light, float aspect,
                           struct gn_framing *framing) {
    const struct gn_light *l = &pose->lights[light];
    const struct gn_box *all = &pose->scene->box, casters = find_casters(pose);
    const float size_m = fmaxf(glm_vec3_distance((float *)all->min, (float *)all->max), 1e-6f);
    vec4 *view = framing->view_from_world;
    framing->camera = (struct gn_camera){.name = l->name, .node = l->node};
    framing->distance_m = 0.0f;
    gn_pose_light_view(pose, light, view);
    if (gn_light_types[l->type].has_position)
        look_from_spot(l, size_m, aspect, &framing->camera);
    else
        look_from_afar(&casters, size_m, &framing->camera, view);
    for (int k = 0; k < 3; k++) framing->eye_ws[k] = -glm_vec3_dot(view[k], view[3]);
}
