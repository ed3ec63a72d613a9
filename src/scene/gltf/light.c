/* KHR_lights_punctual: lights, in the order of the nodes that have one. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void read_cone(struct gn_gltf *g, const struct gn_at *at, struct gn_light *light) {
    struct gn_at spot = gn_at_object(g, at, "spot");
    light->inner_rad = gn_at_float(g, &spot, "innerConeAngle", 0);
    light->outer_rad = gn_at_float(g, &spot, "outerConeAngle", GLM_PI_4f);
    bool wide = !(light->outer_rad > 0 && light->outer_rad <= GLM_PI_2f + 1e-4f);
    if (wide) {
        light->outer_rad = light->outer_rad > 0 ? GLM_PI_2f : GLM_PI_4f;
        gn_gltf_warn(g, &spot, "outerConeAngle is not between 0 and 90 degrees; taken as %g",
                     (double)glm_deg(light->outer_rad));
    }
    light->outer_rad = fminf(light->outer_rad, GLM_PI_2f);
    if (light->inner_rad >= 0 && light->inner_rad < light->outer_rad) return;
    gn_gltf_warn(g, &spot, "innerConeAngle is not between 0 and outerConeAngle; clamped");
    light->inner_rad = light->inner_rad < 0 ? 0 : .99f * light->outer_rad;
}

/* As a clip changes it. */
static void fill_record(struct gn_gltf *g, int32_t index, const struct gn_at *at,
                        struct gn_light *light) {
    struct gn_light_record *r = gn_gltf_record(g, GN_THING_LIGHT, (size_t)index, &light->record);
    light->range_moves = g->to_scene.range_moves[index];
    if (!r) return;
    glm_vec3_one(r->color);
    gn_at_floats(g, at, "color", 3, r->color);
    r->intensity = gn_at_float(g, at, "intensity", 1);
    r->range_m = light->range_m > 0 ? light->range_m : 1e18f;
    r->inner_rad = light->inner_rad;
    r->outer_rad = light->outer_rad;
}

static bool read_light(struct gn_gltf *g, const struct gn_at *at, struct gn_light *light) {
    const char *type = gn_at_text(g, at, "type");
    struct gn_at type_at = gn_at_any(at, "type"), range_at = gn_at_any(at, "range");
    char names[80] = "";
    bool known = false;
    for (int i = 0; i < GN_LIGHT_TYPE_COUNT; i++) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", gn_light_types[i].name);
        if (!type || strcmp(type, gn_light_types[i].name) != 0) continue;
        light->type = (enum gn_light_type)i;
        known = true;
    }
    if (!known && !g->failed)
        gn_gltf_warn(g, &type_at, "'%.20s' is none of %s; light ignored", type ? type : "", names);
    if (!known) return false;

    glm_vec3_one(light->color);
    gn_at_floats(g, at, "color", 3, light->color);
    float intensity = gn_at_float(g, at, "intensity", 1);
    bool negative = !(intensity >= 0);
    for (int k = 0; k < 3; k++) {
        negative |= !(light->color[k] >= 0);
        light->color[k] = fminf(fmaxf(light->color[k], 0) * fmaxf(intensity, 0), 1e18f);
    }
    if (negative) gn_gltf_warn(g, at, "negative colour or intensity; taken as 0");
    light->range_m = gn_at_float(g, at, "range", 0);
    if (range_at.json && !(light->range_m > 0)) {
        gn_gltf_warn(g, &range_at, "must be greater than 0; taken as unlimited");
        light->range_m = 0;
    }
    light->radius = gn_light_types[light->type].radius;
    light->shadow_strength = 1;
    light->shadow_specular = -1;
    light->slide = -1;
    if (gn_light_types[light->type].has_cone) read_cone(g, at, light);
    return !g->failed;
}

bool gn_gltf_lights(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), nodes = gn_at_array(g, &root, "nodes");
    struct gn_at definitions = gn_at_array(g, &root, "extensions.KHR_lights_punctual.lights");
    struct gn_scene *scene = g->scene;
    gn_gltf_spare(g, "ignored");
    GN_NEW(g, g->memory.scene, scene->lights, (uint64_t)scene->node_count + 1);
    for (uint32_t i = 0; i < scene->node_count && !g->failed; i++) {
        if (g->placed[i].bare) continue;
        struct gn_at node = gn_at_element(&nodes, g->placed[i].json);
        int32_t index = gn_at_spare_ref(g, &node, "extensions.KHR_lights_punctual.light",
                                        gn_at_size(&definitions), "lights");
        if (index < 0) continue;
        struct gn_at definition = gn_at_item(g, &definitions, (size_t)index);
        struct gn_light light = {.node = i, .name = scene->nodes[i].name};
        const bool read = !g->failed && read_light(g, &definition, &light);
        if (gn_gltf_spare(g, "light ignored") || !read) continue;
        fill_record(g, index, &definition, &light);
        gn_extras_light(g, &definition, &light);
        gn_extras_light(g, &node, &light);
        const char *own = gn_at_name(g, &definition);
        char number[32];
        snprintf(number, sizeof number, "light %u", scene->light_count);
        if (own && *own)
            light.name = gn_gltf_strdup(g, own);
        else if (!*light.name)
            light.name = gn_gltf_strdup(g, number);
        if (!g->failed) scene->lights[scene->light_count++] = light;
    }
    return !g->failed;
}
