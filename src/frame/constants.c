/* The constants that shaders read of lights and their shadows (shaders_es/blocks.glsl). */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "frame/private.h"
#include "shadow/cascade.h"

_Static_assert(GN_PASS_SIZE == PASS_SIZE, "room for the constants of a pass");
_Static_assert(PASS_LIGHTS + GN_LIGHTS_MAX * LIGHT_SIZE <= PASS_CONES, "lights");
_Static_assert(PASS_SHADOWS + GN_SHADOWS_MAX * SHADOW_SIZE == PASS_SLIDES, "shadows");
_Static_assert(PASS_SLIDES + GN_SLIDES_MAX * SLIDE_SIZE == PASS_CASCADES, "slides");
_Static_assert(PASS_CASCADES + GN_SHADOWS_MAX * CASCADES_SIZE == PASS_ENVIRONMENT, "cascades");
_Static_assert(ENVIRONMENT_TURN == GN_ENVIRONMENT_HARMONICS, "the environment");
_Static_assert(PASS_ENVIRONMENT + ENVIRONMENT_SIZE == PASS_SIZE, "the environment");

_Static_assert(CASCADES_ZONES == GN_CASCADES_MAX && CASCADES_SIZE == CASCADES_ZONES + 2,
               "one vec4 each, and two of them all");

#define NOWHERE 1e9f /* texels from a tile: there is light */

static void put3(float to[4], const float *v) { memcpy(to, v, sizeof(vec3)); }

static bool is_deep(const struct gn_shadow_view *view) {
    return view->perspective && gn_encoding_is_depth(view->encoding);
}

/* SHADOW_SLOPE. A directional light: where u changes by |u| in a metre and the code by |code|, the
 * slope is the tangent of the plane times |code| / |u|. A spot, a tile: the code is a + b / depth,
 * and 1 / depth changes with a tangent by the normal's share of that direction over the height of
 * the light. The rows of a spot are scale * direction + shift * axis. */
static void set_slope(const struct gn_shadow_view *view, float (*to)[4]) {
    const struct gn_shadow_lookup *lookup = &view->lookup;
    const bool deep = is_deep(view);
    if (view->empty || gn_techniques[view->technique].on_plane || (view->perspective && !deep))
        return;
    vec3 rows[4];
    for (int r = 0; r < 4; r++)
        for (int k = 0; k < 3; k++) rows[r][k] = lookup->map_from_world[k][r];
    for (int k = 0; k < 2; k++)
        if (deep && view->map.tile_count > 1) {
            to[0][k] = -lookup->depth_code[1] / lookup->tangent_uv[k];
        } else if (deep) {
            const float shift = glm_vec3_dot(rows[k], rows[3]);
            const float factor = -lookup->depth_code[1] / (glm_vec3_norm2(rows[k]) - shift * shift);
            glm_vec3_scale(rows[k], factor, to[k]);
            glm_vec3_muladds(rows[3], -shift * factor, to[k]);
        } else {
            glm_vec3_scale(rows[k], glm_vec3_norm(rows[2]) / glm_vec3_norm2(rows[k]), to[k]);
        }
}

/* Bias and code of a spot or point light: shadow_code() of lib/shadow_point.glsl. In a map of
 * depths a step of the encoding is the same everywhere, in metres the largest at the far end. */
static void set_code(const struct gn_shadow_view *view, float (*c)[4]) {
    const struct gn_shadow_lookup *lookup = &view->lookup;
    const float slope = lookup->slope_offset * lookup->texel;
    c[SHADOW_BIAS][BIAS_NORMAL] = lookup->normal_offset * lookup->texel;
    c[SHADOW_BIAS][BIAS_SLOPE] = slope;
    c[SHADOW_BIAS][BIAS_LEAST] = 1.0f / lookup->slope_max;
    c[SHADOW_BIAS][BIAS_FOUR] = 4.0f * c[SHADOW_BIAS][BIAS_NORMAL];
    c[SHADOW_PLACE][PLACE_CODE_SCALE] = view->code.scale;
    c[SHADOW_CODE][CODE_OFFSET] = view->code.offset - view->code.ulp_m * view->code.scale;
    if (!is_deep(view) || view->empty) return;
    const float first = lookup->depth_code[0], factor = lookup->depth_code[1];
    const float far_depth = factor / (1.0f - first);
    c[SHADOW_BIAS][BIAS_SLOPE] = factor * slope;
    c[SHADOW_PLACE][PLACE_CODE_SCALE] = factor * (1.0f - BIAS_FLAT * slope);
    c[SHADOW_CODE][CODE_OFFSET] = first + view->code.ulp_m * factor / (far_depth * far_depth);
}

static void set_shadow(const struct gn_shadow_view *view, float (*c)[4]) {
    const struct gn_shadow_lookup *lookup = &view->lookup;
    const bool cascades = view->map.cascade_count > 0;
    c[SHADOW_CODE][CODE_FAR_END] = view->code.far_end;
    if (view->encoding == GN_ENCODING_STENCIL) return; /* where it is not marked, all arrives */
    memcpy(c[SHADOW_MAP], lookup->map_from_world, sizeof lookup->map_from_world);
    if (view->map.tile_count > 1 && !cascades)
        memcpy(c[SHADOW_TILES], lookup->tangent_uv, sizeof lookup->tangent_uv);
    const float texel = cascades ? 1.0f : lookup->texel;
    c[SHADOW_BIAS][BIAS_NORMAL] = lookup->normal_offset * texel;
    c[SHADOW_BIAS][BIAS_SLOPE] = lookup->slope_offset * texel;
    c[SHADOW_BIAS][BIAS_SLOPE_MAX] = lookup->slope_max;
    c[SHADOW_BIAS][BIAS_ULP] = view->code.ulp_m;
    set_slope(view, c + SHADOW_SLOPE);
    c[SHADOW_SLOPE][SLOPE_FILTER] = lookup->filter_radius_px;
    const float lamp = view->penumbra.radius * (cascades ? 1.0f : lookup->texel);
    c[SHADOW_SLOPE + 1][SLOPE_HORIZON] = HORIZON_SLOPE / fmaxf(lamp, 1e-6f);
    put3(c[SHADOW_PLACE], view->light_ws);
    c[SHADOW_PLACE][PLACE_CODE_SCALE] = view->code.scale;
    const float size[2] = {(float)view->map.width_px, (float)view->map.height_px};
    for (int k = 0; k < 2; k++) {
        c[SHADOW_MAP_SIZE][k] = size[k];
        c[SHADOW_MAP_SIZE][k + 2] = 1.0f / size[k];
    }
    c[SHADOW_CODE][CODE_OFFSET] = view->code.offset;
    if (view->perspective && !gn_techniques[view->technique].on_plane) set_code(view, c);
    c[SHADOW_CODE][CODE_REACH] = lookup->reach_px;
    if (cascades)
        c[SHADOW_CODE][CODE_HELD] = lookup->held_px;
    else
        c[SHADOW_CODE][CODE_SHARED] = 1.0f - lookup->shared;
    const struct gn_shadow_penumbra *penumbra = &view->penumbra;
    c[SHADOW_PENUMBRA][PENUMBRA_RADIUS] = penumbra->radius;
    if (cascades)
        c[SHADOW_PENUMBRA][PENUMBRA_GROWTH] = penumbra->growth;
    else
        c[SHADOW_PENUMBRA][PENUMBRA_NEAREST] = penumbra->nearest;
    c[SHADOW_PENUMBRA][PENUMBRA_SCALE] = penumbra->scale;
    c[SHADOW_PENUMBRA][PENUMBRA_BIAS] = penumbra->bias;
}

static void set_cascades(const struct gn_shadow_view *view, float (*constants)[4]) {
    const double middle = 0.5 * (double)view->map.inner_px;
    if (view->map.cascade_count == 0) return;
    for (uint32_t i = 0; i < GN_CASCADES_MAX; i++) {
        const struct gn_shadow_cascade *cascade = &view->cascades[i];
        const bool empty =
            i >= view->map.cascade_count || view->empty || view->raster.tiles[i].empty;
        float *c = constants[i];
        for (int k = 0; k < 2; k++)
            c[k] = empty ? NOWHERE : (float)(-cascade->drawn.corner_texels[k] - middle);
        c[CASCADE_TEXEL] = empty ? 1.0f : cascade->texel;
        c[CASCADE_NEAREST] = empty ? 0.0f : cascade->nearest;
        constants[CASCADES_SPANS][i] = empty ? 1.0f : cascade->span;
        if (i + 1 < GN_CASCADES_MAX)
            constants[CASCADES_ZONES][i] = view->empty || i + 1 >= view->map.cascade_count
                                               ? 0.0f
                                               : 1.0f / (GN_CASCADE_FADE * cascade->end_m);
    }
}

void gn_frame_reader_constants(const struct gn_shadow_view *view, uint32_t i,
                               float (*constants)[4]) {
    set_shadow(view, constants + PASS_SHADOWS + i * SHADOW_SIZE);
    set_cascades(view, constants + PASS_CASCADES + i * CASCADES_SIZE);
}

void gn_frame_light_constants(const struct gn_frame *frame, const struct gn_pose *pose,
                              const struct gn_light_group *group, float (*constants)[4]) {
    for (uint32_t i = 0; i < group->count; i++) {
        const struct gn_frame_light *chosen = &frame->lights[group->first + i];
        const struct gn_light *light = &pose->lights[chosen->light];
        float(*c)[4] = constants + PASS_LIGHTS + i * LIGHT_SIZE;
        vec3 place, direction;
        gn_pose_light(pose, chosen->light, place, direction);
        for (int k = 0; k < 3; k++) {
            c[LIGHT_COLOR][k] = chosen->opts.color[k] * frame->plan.exposure / GLM_PIf;
            c[LIGHT_PLACE][k] = gn_light_types[light->type].has_position ? place[k] : -direction[k];
        }
        c[LIGHT_COLOR][3] = chosen->opts.strength;
        if (frame->shadow_specular)
            c[LIGHT_COLOR][3] += 2.0f * roundf(255.0f * chosen->opts.specular);
        c[LIGHT_PLACE][3] = light->range_m > 0.0f ? 1.0f / light->range_m : 0.0f;
        put3(c[LIGHT_AXIS], direction);
        float outer = cosf(light->outer_rad), inner = cosf(light->inner_rad);
        c[LIGHT_AXIS][3] = outer;
        constants[PASS_CONES + i / 4][i % 4] = 1.0f / fmaxf(inner - outer, 1e-4f);
        if (i >= group->shadow_count) continue;
        gn_frame_reader_constants(&frame->shadows[group->first_shadow + i], i, constants);
    }
}

void gn_frame_shadow_constants(const struct gn_shadow_view *view, mat4 clip_from_world,
                               float (*constants)[4]) {
    memcpy(constants[PASS_CLIP], clip_from_world, sizeof(mat4));
    put3(constants[PASS_CODE], view->light_ws);
    constants[PASS_CODE][3] =
        view->perspective ? view->code.scale : view->code.scale * view->code.far_m;
    constants[PASS_CODE_ADD][0] = view->code.offset;
    constants[PASS_CODE_ADD][1] = view->code.far_end;
    constants[PASS_CODE_ADD][2] = view->lookup.depth_code[0];
}
