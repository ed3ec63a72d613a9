/* Completes a scene: bounds, the plane, a key light and a camera if it has none. */
#include "scene/private.h"

#include <math.h>

#include "scene/pose.h"

/* A node at position whose -Z looks along forward_ws. */
static uint32_t add_node(struct gn_gltf *g, const char *name, vec3 position, vec3 forward_ws) {
    struct gn_scene *scene = g->scene;
    struct gn_node *node = &scene->nodes[scene->node_count];
    g->placed[scene->node_count].mesh = -1;
    *node = (struct gn_node){.name = gn_gltf_strdup(g, name), .parent = -1, .has_matrix = true};
    glm_mat4_identity(node->matrix);
    glm_vec3_normalize_to(forward_ws, node->matrix[2]);
    glm_vec3_negate(node->matrix[2]);
    glm_vec3_crossn(GLM_YUP, node->matrix[2], node->matrix[0]);
    glm_vec3_cross(node->matrix[2], node->matrix[0], node->matrix[1]);
    glm_vec3_copy(position, node->matrix[3]);
    glm_vec3_one(node->scale);
    glm_quat_identity(node->rotation);
    return scene->node_count++;
}

/* A three-quarter view: from the front, the right and above; all of the box is in the picture, in
 * 4:3 and wider. */
static void make_camera(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    const struct gn_box *box = &scene->box;
    const float yfov_rad = glm_rad(35), filled = .92f, slope = tanf(yfov_rad / 2) * filled;
    vec3 axes[3] = {{0}, {0}, {.55f, .5f, 1}}, middle, eye, forward;
    glm_vec3_normalize(axes[2]);
    glm_vec3_crossn(GLM_YUP, axes[2], axes[0]);
    glm_vec3_cross(axes[2], axes[0], axes[1]);
    glm_vec3_center(scene->box.min, scene->box.max, middle);
    float distance = 0, reach[2] = {0}; /* of the eye, and of the box, along axes[2] */
    for (int i = 0; i < 8; i++) {
        vec3 corner;
        for (int k = 0; k < 3; k++) corner[k] = i >> k & 1 ? box->max[k] : box->min[k];
        glm_vec3_sub(corner, middle, corner);
        float x = fabsf(glm_vec3_dot(corner, axes[0])), y = fabsf(glm_vec3_dot(corner, axes[1]));
        float z = glm_vec3_dot(corner, axes[2]);
        distance = fmaxf(distance, z + fmaxf(y, x * 3 / 4) / slope);
        reach[0] = fminf(reach[0], z);
        reach[1] = fmaxf(reach[1], z);
    }
    float size = fmaxf(glm_vec3_distance(scene->box.min, scene->box.max), 1e-3f);
    distance = fmaxf(distance, size * .5f);
    scene->added.camera = true;
    glm_vec3_scale(axes[2], distance, eye);
    glm_vec3_add(eye, middle, eye);
    glm_vec3_negate_to(axes[2], forward);
    scene->cameras[scene->camera_count++] = (struct gn_camera){
        .name = "camera",
        .node = add_node(g, "camera", eye, forward),
        .yfov_rad = yfov_rad,
        .near_m = fmaxf((distance - reach[1]) / 2, distance / 100),
        .far_m = distance - reach[0] + size,
    };
}

bool gn_scene_complete(struct gn_gltf *g) {
    static const char *const missing[GN_MISSING_COUNT] = {
        [GN_MISSING_SKINS] = "skins",
        [GN_MISSING_MORPHS] = "morph targets",
        [GN_MISSING_NORMAL_MAPS] = "normal maps",
        [GN_MISSING_VARIANTS] = "material variants",
        [GN_MISSING_WEBP] = "WebP pictures",
        [GN_MISSING_BASISU] = "KTX2 pictures",
        [GN_MISSING_DRACO] = "Draco-compressed meshes",
        [GN_MISSING_POINTERS] = "animation pointers",
    };
    struct gn_scene *scene = g->scene;
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    scene->box = pose.box_ws;
    if (scene->box.min[0] > scene->box.max[0]) /* nothing is visible in the initial pose */
        scene->box = (struct gn_box){{-1, -1, -1}, {1, 1, 1}};
    gn_scene_find_plane(g, &pose);
    gn_pose_finish(&pose);
    if (scene->light_count == 0) {
        /* A light from above, the front and a little left of the added camera: the three visible
         * sides of a box are lit differently. An unlit white side would have the colour of the
         * background. */
        vec3 middle;
        glm_vec3_center(scene->box.min, scene->box.max, middle);
        scene->added.light = true;
        scene->lights[scene->light_count++] = (struct gn_light){
            .name = "key light",
            .node = add_node(g, "key light", middle, (vec3){-.2f, -1, -.6f}),
            .type = GN_LIGHT_DIRECTIONAL,
            .color = {2.8f, 2.8f * .95f, 2.8f * .87f},
            .radius = gn_light_types[GN_LIGHT_DIRECTIONAL].radius,
            .shadow_strength = 1,
            .shadow_specular = -1,
            .slide = -1,
        };
    }
    if (scene->camera_count == 0) make_camera(g);
    char list[200] = "";
    for (size_t i = 0, at = 0; i < GN_MISSING_COUNT; i++)
        if (g->is_missing[i])
            at += (size_t)snprintf(list + at, sizeof list - at, "%s%s", at > 0 ? ", " : "",
                                   missing[i]);
    if (list[0]) gn_gltf_warn(g, NULL, "shown without %s: not supported yet", list);
    return !g->failed;
}
