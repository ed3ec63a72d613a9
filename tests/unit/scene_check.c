#include "scene_check.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "scene/pose.h"

#define NEED(what)                                                                                 \
    if (!(what)) return #what

static bool finite_all(const float *values, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i])) return false;
    return true;
}

static bool unit_all(const float *v, size_t count) {
    for (size_t i = 0; i < count; i++, v += 3)
        if (!(fabsf(sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) - 1) < 1e-4f)) return false;
    return true;
}

/* The box is the exact one of the vertices that the triangles use. */
static bool box_right(const struct gn_scene *scene, const struct gn_geometry *geometry) {
    vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < geometry->index_count; i++) {
        const float *p = scene->buffers.positions +
                         3 * (size_t)scene->buffers.indices[geometry->first_index + i];
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], p[k]);
            high[k] = fmaxf(high[k], p[k]);
        }
    }
    for (int k = 0; k < 3; k++)
        if (low[k] != geometry->box.min[k] || high[k] != geometry->box.max[k]) return false;
    return true;
}

static const char *check_geometry(const struct gn_scene *scene,
                                  const struct gn_geometry *geometry) {
    NEED((uint64_t)geometry->first_vertex + geometry->vertex_count <= scene->buffers.vertex_count);
    NEED((uint64_t)geometry->first_index + geometry->index_count <= scene->buffers.index_count);
    NEED(geometry->index_count % 3 == 0);
    for (uint32_t i = 0; i < geometry->index_count; i++) {
        uint32_t index = scene->buffers.indices[geometry->first_index + i];
        NEED(index >= geometry->first_vertex);
        NEED(index < geometry->first_vertex + geometry->vertex_count);
    }
    NEED(geometry->index_count == 0 || box_right(scene, geometry));
    NEED(!geometry->flat || fabsf(glm_vec3_norm((float *)geometry->plane) - 1) < 1e-4f);
    for (int i = 0; i < GN_ATTRIBUTE_COUNT; i++)
        NEED(!gn_geometry_has(geometry, i) || scene->buffers.attributes[i]);
    return NULL;
}

static const char *check_joints(const struct gn_scene *scene, const struct gn_geometry *geometry) {
    const bool eight = gn_geometry_has(geometry, GN_ATTRIBUTE_JOINTS1);
    for (uint32_t v = geometry->first_vertex;
         v < geometry->first_vertex + geometry->vertex_count && geometry->joint_box_count; v++) {
        uint32_t sum = 0;
        for (size_t i = 0; i < 4; i++)
            sum += scene->buffers.weights0[4 * (size_t)v + i] +
                   (eight ? scene->buffers.weights1[4 * (size_t)v + i] : 0u);
        NEED(sum == 65535);
    }
    return NULL;
}

static const char *check_strip(const struct gn_scene *scene, const struct gn_strip *strip,
                               uint32_t rows) {
    NEED((uint32_t)strip->x + GN_STRIP_WIDTH <= scene->deformation.width);
    NEED(strip->y + rows <= scene->deformation.height);
    return NULL;
}

static const char *check_deformation(const struct gn_scene *scene) {
    const struct gn_scene_deformation *d = &scene->deformation;
    const char *wrong = NULL;
    for (uint32_t i = 0; i < d->skin_count && !wrong; i++) {
        NEED(d->skins[i].first_joint + d->skins[i].joint_count <= d->joint_count);
        wrong = check_strip(scene, &d->skins[i].rows, d->skins[i].joint_count);
    }
    for (uint32_t i = 0; i < d->joint_count; i++) {
        NEED(d->joints[i].node >= -1 && d->joints[i].node < (int64_t)scene->node_count);
        NEED(finite_all(d->joints[i].joint_from_mesh[0], 16));
    }
    for (uint32_t i = 0; i < d->morph_count && !wrong; i++) {
        NEED(d->morphs[i].first_weight + d->morphs[i].weight_count <= d->weight_count);
        wrong = check_strip(scene, &d->morphs[i].list, d->morphs[i].weight_count);
    }
    NEED(finite_all(d->weights, d->weight_count));
    for (uint32_t i = 0; i < scene->item_count && !wrong; i++) {
        const struct gn_item *item = &scene->items[i];
        const struct gn_geometry *geometry = &scene->geometries[item->geometry];
        NEED(item->skin >= -1 && item->skin < (int64_t)d->skin_count);
        NEED(item->morph >= -1 && item->morph < (int64_t)d->morph_count);
        NEED(item->morph < 0 || (geometry->targets &&
                                 geometry->targets->count == d->morphs[item->morph].weight_count));
        for (uint32_t k = 0; k < geometry->joint_box_count && item->skin >= 0; k++)
            NEED(geometry->joint_boxes[k].joint < d->skins[item->skin].joint_count);
        if (gn_item_is_deformed(item)) wrong = check_strip(scene, &item->rows, 1);
    }
    for (uint32_t i = 0; i < scene->geometry_count && !wrong; i++) {
        const struct gn_targets *t = scene->geometries[i].targets;
        wrong = check_joints(scene, &scene->geometries[i]);
        if (!t) continue;
        const uint64_t texels = (uint64_t)t->count * t->parts * scene->geometries[i].vertex_count;
        NEED(t->first_texel + texels <= d->delta_texels);
        NEED(finite_all(t->deltas[0], 4 * texels));
    }
    return wrong;
}

static const char *check_vertices(const struct gn_scene *scene) {
    size_t n = scene->buffers.vertex_count;
    NEED(finite_all(scene->buffers.positions, 3 * n));
    NEED(unit_all(scene->buffers.normals, n));
    NEED(!scene->buffers.uv0 || finite_all(scene->buffers.uv0, 2 * n));
    NEED(!scene->buffers.uv1 || finite_all(scene->buffers.uv1, 2 * n));
    for (uint32_t i = 0; i < scene->geometry_count; i++) {
        const char *wrong = check_geometry(scene, &scene->geometries[i]);
        if (wrong) return wrong;
    }
    return NULL;
}

static const char *check_material(const struct gn_scene *scene,
                                  const struct gn_material *material) {
    NEED(material->name);
    NEED(finite_all(material->base_color, 4) && finite_all(material->emissive, 3));
    NEED(material->roughness >= 0 && material->roughness <= 1);
    NEED(material->metalness >= 0 && material->metalness <= 1);
    NEED(material->occlusion_strength >= 0 && material->occlusion_strength <= 1);
    NEED(isfinite(material->alpha_cutoff) && material->alpha <= GN_ALPHA_BLEND);
    for (int i = 0; i < GN_TEXTURE_SLOT_COUNT; i++) {
        const struct gn_texture_ref *ref = &material->textures[i];
        NEED(ref->texture >= -1 && ref->texture < (int64_t)scene->pictures.texture_count);
        NEED(ref->uv_set <= 1 && finite_all(ref->uv_from_uv, 6));
    }
    return NULL;
}

static const char *check_looks(const struct gn_scene *scene) {
    NEED(scene->material_count >= 1);
    for (uint32_t i = 0; i < scene->pictures.texture_count; i++)
        NEED(scene->pictures.textures[i].image < scene->pictures.image_count);
    for (uint32_t i = 0; i < scene->pictures.image_count; i++) {
        const struct gn_image *image = &scene->pictures.images[i];
        NEED(image->width_px > 0 && image->height_px > 0 && (image->rgba || image->levels));
        NEED(!image->levels || image->level_count > 0);
        NEED(!image->rgba ||
             image->rgba[4 * (size_t)image->width_px * image->height_px - 1] == 255 ||
             image->has_alpha);
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const char *wrong = check_material(scene, &scene->materials[i]);
        if (wrong) return wrong;
    }
    return NULL;
}

static const char *check_items(const struct gn_scene *scene) {
    NEED(scene->item_count > 0);
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i], *before = i > 0 ? item - 1 : item;
        NEED(item->node < scene->node_count && item->geometry < scene->geometry_count);
        NEED(item->material < scene->material_count);
        NEED(item->instance >= -1 && item->instance < (int64_t)scene->instance_count);
        NEED(item->batch < scene->batch_count);
        NEED(item->batch == before->batch || item->batch == before->batch + 1);
        NEED(item->batch != before->batch || item->geometry == before->geometry);
        NEED(scene->geometries[item->geometry].index_count > 0);
        NEED(!item->plane || scene->geometries[item->geometry].flat);
        if (!(item->hidden_in & 1)) triangles += scene->geometries[item->geometry].index_count / 3;
    }
    NEED(scene->items[0].batch == 0);
    NEED(scene->items[scene->item_count - 1].batch == scene->batch_count - 1);
    NEED(scene->triangle_count == triangles);
    return NULL;
}

static const char *check_light(const struct gn_scene *scene, const struct gn_light *light) {
    NEED(light->name && light->node < scene->node_count);
    NEED(light->type < GN_LIGHT_TYPE_COUNT && finite_all(light->color, 3));
    NEED(light->color[0] >= 0 && light->color[1] >= 0 && light->color[2] >= 0);
    NEED(light->range_m >= 0 && light->radius >= 0 && isfinite(light->radius));
    NEED(!gn_light_types[light->type].has_cone ||
         (light->inner_rad >= 0 && light->inner_rad < light->outer_rad));
    NEED(light->outer_rad <= GLM_PI_2f);
    NEED(light->shadow_strength >= 0 && light->shadow_strength <= 1);
    NEED(light->slide >= -1 && light->slide < (int64_t)scene->pictures.texture_count);
    return NULL;
}

static const char *check_camera(const struct gn_scene *scene, const struct gn_camera *camera) {
    NEED(camera->name && camera->node < scene->node_count);
    NEED(camera->far_m == 0 || camera->far_m > camera->near_m);
    NEED(camera->orthographic
             ? camera->xmag_m > 0 && camera->ymag_m > 0 && camera->near_m >= 0
             : camera->yfov_rad > 0 && camera->yfov_rad < GLM_PIf && camera->near_m > 0);
    NEED(isfinite(camera->far_m));
    return NULL;
}

static const char *check_nodes(const struct gn_scene *scene) {
    const char *wrong = NULL;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const struct gn_node *node = &scene->nodes[i];
        NEED(node->name && node->parent >= -1 && node->parent < (int64_t)i);
        NEED(finite_all(node->translation, 3) && finite_all(node->scale, 3));
        NEED(fabsf(glm_vec4_norm((float *)node->rotation) - 1) < 1e-3f);
        NEED(finite_all(node->matrix[0], 16));
    }
    NEED(scene->light_count > 0 && scene->camera_count > 0);
    for (uint32_t i = 0; i < scene->light_count && !wrong; i++)
        wrong = check_light(scene, &scene->lights[i]);
    for (uint32_t i = 0; i < scene->camera_count && !wrong; i++)
        wrong = check_camera(scene, &scene->cameras[i]);
    NEED(scene->box.min[0] <= scene->box.max[0] && finite_all(scene->box.min, 6));
    return wrong;
}

static const char *check_clips(const struct gn_scene *scene) {
    for (uint32_t c = 0; c < scene->animation.clip_count; c++) {
        const struct gn_clip *clip = &scene->animation.clips[c];
        NEED(clip->name && clip->duration_ns >= 0);
        NEED((uint64_t)clip->first_channel + clip->channel_count <= scene->animation.channel_count);
    }
    for (uint32_t c = 0; c < scene->animation.channel_count; c++) {
        const struct gn_channel *channel = &scene->animation.channels[c];
        size_t per_key =
            channel->components * (size_t)(channel->interpolation == GN_ANIM_CUBIC ? 3 : 1);
        NEED(channel->node < scene->node_count && channel->key_count > 0);
        NEED(channel->path == GN_ANIM_WEIGHTS || !scene->nodes[channel->node].has_matrix);
        NEED(finite_all(channel->times_s, channel->key_count));
        NEED(finite_all(channel->values, channel->key_count * per_key));
        for (uint32_t k = 1; k < channel->key_count; k++)
            NEED(channel->times_s[k] >= channel->times_s[k - 1]);
    }
    return NULL;
}

static const char *check_pose(const struct gn_pose *pose) {
    mat4 view;
    vec3 eye, position, direction;
    for (uint32_t i = 0; i < pose->scene->item_count; i++) {
        const struct gn_pose_item *item = &pose->items[i];
        NEED(!item->visible || finite_all(item->world_from_item[0], 16));
        NEED(!item->visible || finite_all(item->box_ws.min, 6));
        NEED(!item->visible || item->box_ws.min[0] <= item->box_ws.max[0]);
    }
    for (uint32_t i = 0; i < pose->scene->camera_count; i++) {
        gn_pose_view(pose, i, view, eye);
        NEED(finite_all(view[0], 16) && finite_all(eye, 3));
    }
    for (uint32_t i = 0; i < pose->scene->light_count; i++) {
        gn_pose_light(pose, i, position, direction);
        NEED(finite_all(position, 3) && unit_all(direction, 1));
    }
    return NULL;
}

static const char *check_poses(const struct gn_scene *scene) {
    static const int64_t times[] = {0, 1, 333333333, 1000000000, -77, INT64_MAX, INT64_MIN};
    const char *wrong = NULL;
    for (int clips = GN_POSE_NONE; clips < 2 && !wrong; clips++) {
        struct gn_pose pose;
        gn_pose_init(&pose, scene, clips);
        for (size_t i = 0; i < sizeof times / sizeof times[0] && !wrong; i++) {
            gn_pose_step(&pose, times[i]);
            wrong = check_pose(&pose);
        }
        gn_pose_finish(&pose);
    }
    return wrong;
}

const char *gn_scene_check(const struct gn_scene *scene) {
    static const char *(*const checks[])(const struct gn_scene *) = {
        check_vertices, check_looks,       check_items, check_nodes,
        check_clips,    check_deformation, check_poses};
    for (size_t i = 0; i < sizeof checks / sizeof checks[0]; i++) {
        const char *wrong = checks[i](scene);
        if (wrong) return wrong;
    }
    return NULL;
}
