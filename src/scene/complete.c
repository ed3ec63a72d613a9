/* Completes a scene: bounds, the plane, a floor, spreads of poses; a key light and a camera if it
 * has none. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>

#include "scene/deform.h"
#include "scene/exact.h"
#include "scene/framing.h"

/* A node at position whose -Z looks along forward_ws. */
static uint32_t add_node(struct gn_gltf *g, const char *name, vec3 position, vec3 forward_ws) {
    struct gn_scene *scene = g->scene;
    struct gn_node *node = &scene->nodes[scene->node_count];
    g->placed[scene->node_count].mesh = -1;
    g->placed[scene->node_count].morph = -1;
    *node = (struct gn_node){.name = gn_gltf_strdup(g, name), .parent = -1, .has_matrix = true};
    glm_mat4_identity(node->matrix);
    glm_vec3_normalize_to(forward_ws, node->matrix[2]);
    glm_vec3_negate(node->matrix[2]);
    glm_vec3_crossn(GLM_YUP, node->matrix[2], node->matrix[0]);
    glm_vec3_cross(node->matrix[2], node->matrix[0], node->matrix[1]);
    gn_exact_put(&scene->place, position, node->matrix[3], node->rest);
    glm_vec3_one(node->scale);
    glm_quat_identity(node->rotation);
    return scene->node_count++;
}

/* A picture's own framing has its direction, and the place for its shape; the node has that for
 * 16:9. */
static void make_camera(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct gn_camera camera = {.name = "camera", .yfov_rad = glm_rad(GN_FRAMING_ADDED_FOV_DEG)};
    vec3 axes[3] = {{0}, {0}, GN_FRAMING_ADDED_BACK}, eye, forward;
    glm_vec3_normalize(axes[2]);
    glm_vec3_crossn(GLM_YUP, axes[2], axes[0]);
    glm_vec3_cross(axes[2], axes[0], axes[1]);
    struct gn_framing_fit fit = {.extent = &scene->extents[GN_POSE_DEFAULT - GN_POSE_NONE],
                                 .aspect = 16.0f / 9};
    glm_vec3_center(scene->box.min, scene->box.max, fit.centre_ws);
    gn_framing_fit(&fit, axes, &camera, eye);
    glm_vec3_negate_to(axes[2], forward);
    camera.node = add_node(g, "camera", eye, forward);
    scene->added.camera = true;
    scene->cameras[scene->camera_count++] = camera;
}

/* Whether a vertex of the item has another alpha than 1. */
static bool has_clear_vertices(const struct gn_scene *scene, const struct gn_item *item) {
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    if (!gn_geometry_has(geometry, GN_ATTRIBUTE_COLOR)) return false;
    const uint8_t *rgba = scene->buffers.colors + 4 * (size_t)geometry->first_vertex;
    for (uint32_t i = 0; i < geometry->vertex_count; i++)
        if (rgba[4 * (size_t)i + 3] < 255) return true;
    return false;
}

/* Whether its alpha is 1 wherever it is used, by factor, texture and vertices. */
static bool is_opaque(const struct gn_scene *scene, uint32_t material) {
    const struct gn_material *m = &scene->materials[material];
    const int32_t texture = m->textures[GN_TEXTURE_BASE].texture;
    if (m->base_color[3] < 1.0f || m->moves & GN_MOVES_BASE ||
        (texture >= 0 && scene->pictures.images[scene->pictures.textures[texture].image].has_alpha))
        return false;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].material == material && has_clear_vertices(scene, &scene->items[i]))
            return false;
    return true;
}

/* Exporters write BLEND for what is opaque: that is drawn, and casts, as such. */
static void make_opaque(struct gn_scene *scene) {
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].alpha == GN_ALPHA_BLEND && is_opaque(scene, i))
            scene->materials[i].alpha = GN_ALPHA_OPAQUE;
}

/* What neither casts nor receives shadows is scenery, as the dome of a sky: the scene's centre and
 * size are those of the rest, if there is any. */
static void leave_scenery_out(struct gn_scene *scene, const struct gn_pose *pose) {
    struct gn_box box = GN_BOX_EMPTY;
    bool is_any = false;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].casts || scene->items[i].receives) {
            const struct gn_box tight = gn_pose_tight_box(pose, i);
            gn_box_join(&box, &tight);
        } else {
            is_any = true;
        }
    if (is_any && box.min[0] <= box.max[0]) scene->box = box;
}

bool gn_scene_complete(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct gn_pose pose;
    make_opaque(scene);
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    scene->box = pose.box_ws;
    if (scene->deformation.width > 0) { /* that box may be larger than what is there */
        scene->box = GN_BOX_EMPTY;
        for (uint32_t i = 0; i < scene->item_count; i++) {
            const struct gn_box box = gn_pose_tight_box(&pose, i);
            gn_box_join(&scene->box, &box);
        }
    }
    leave_scenery_out(scene, &pose);
    if (scene->box.min[0] > scene->box.max[0]) { /* nothing is visible in the initial pose */
        scene->box = (struct gn_box){{-1, -1, -1}, {1, 1, 1}};
        if (scene->animation.clip_count == 0)
            gn_gltf_warn(
                g, NULL,
                "nothing can be seen: all that is shown has a scale of 0, no area, or lies "
                "too far off");
    }
    gn_scene_find_planes(g, &pose);
    gn_gltf_variant_planes(g);
    const bool measured = gn_scene_measure(g, &pose);
    if (measured) gn_scene_add_floor(g, &pose);
    gn_pose_finish(&pose);
    if (!measured || !gn_scene_add_posed_spreads(g)) return false;
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
            .technique = "cone",
            .shadow_strength = 1,
            .shadow_specular = -1,
            .slide = -1,
        };
    }
    if (scene->camera_count == 0) make_camera(g);
    return gn_missing_list(g);
}
