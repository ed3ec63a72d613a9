/* Shared by all ways of fitting: which items cast and receive, the light's frame, snapping to whole
 * texels, the hash of a map's content. */
#include <cglm/cglm.h>
#include <math.h>

#include "core/hash.h"
#include "shadow/private.h"

#define STEPS_PER_OCTAVE 8 /* of the texel's size: the window's width moves in steps of 9 % */
#define RIM_TEXELS       2 /* cleared rim, and the texel that snapping takes */

bool gn_shadow_item_casts(const struct gn_scene *scene, uint32_t item) {
    const struct gn_item *it = &scene->items[item];
    return it->casts && (!gn_material_is_clear(&scene->materials[it->material]) || it->casts_alpha);
}

bool gn_shadow_item_receives(const struct gn_pose *pose, uint32_t item,
                             const struct gn_shadow_view *view) {
    if (view->but_floor && pose->scene->materials[pose->scene->items[item].material].shadow_catcher)
        return false;
    return pose->items[item].visible && (pose->scene->items[item].receives || view->all_receive);
}

void gn_shadow_look(const struct gn_shadow_view *view, mat4 light_from_world) {
    vec3 up = {0.0f, 1.0f, 0.0f}, across = {0.0f, 0.0f, 1.0f}, origin = {0.0f, 0.0f, 0.0f}, forward;
    glm_vec3_negate_to((float *)view->to_light_ws, forward);
    glm_look(view->perspective ? (float *)view->light_ws : origin, forward,
             fabsf(forward[1]) > 0.99f ? across : up, light_from_world);
}

float gn_shadow_step(float size) {
    return exp2f(ceilf(log2f(size) * STEPS_PER_OCTAVE) / STEPS_PER_OCTAVE);
}

void gn_shadow_snap(struct gn_shadow_view *view, const float min[2], const float max[2],
                    float least, double low[2]) {
    uint32_t margin = view->lookup.margin_px + RIM_TEXELS;
    uint32_t usable = view->map.tile_px > 2 * margin + 2 ? view->map.tile_px - 2 * margin : 2;
    float span = fmaxf(max[0] - min[0], max[1] - min[1]);
    view->lookup.texel = gn_shadow_step(fmaxf(span, least) / (float)(usable - 1));
    for (int k = 0; k < 2; k++)
        low[k] = (floor((double)min[k] / view->lookup.texel) - margin) * view->lookup.texel;
}

void gn_shadow_set_frustums(struct gn_shadow_view *view, const double low[2], float near_depth,
                            float far_depth) {
    double side = (double)view->lookup.texel * view->map.tile_px;
    float left = (float)low[0], right = (float)(low[0] + side), bottom = (float)low[1],
          top = (float)(low[1] + side);
    mat4 clip_from_light;
    view->lookup.depth_code[0] = far_depth / (far_depth - near_depth);
    view->lookup.depth_code[1] = -near_depth * far_depth / (far_depth - near_depth);
    glm_frustum(left * near_depth, right * near_depth, bottom * near_depth, top * near_depth,
                near_depth, far_depth, clip_from_light);
    for (uint32_t i = 0; i < view->map.tile_count; i++)
        glm_mat4_mul(clip_from_light, view->raster.tiles[i].light_from_world,
                     view->raster.tiles[i].clip_from_world);
}

uint64_t gn_shadow_hash(const struct gn_pose *pose, const struct gn_shadow_view *view,
                        const struct gn_shadow_tile *tile, const uint8_t *casts) {
    float code[] = {view->code.scale, view->code.offset, view->code.far_end,
                    (float)view->map.tile_px, (float)view->encoding};
    uint64_t h = gn_hash(GN_HASH_INIT, code, sizeof code);
    if (!tile->empty) h = gn_hash(h, tile->clip_from_world, sizeof tile->clip_from_world);
    if (view->faces_given) h = gn_hash(h, &view->faces, sizeof view->faces);
    for (uint32_t p = 0; p < view->raster.drawn.page_count; p++) {
        const struct gn_shadow_page *page = &view->raster.drawn.pages[p];
        h = gn_hash(h, page->corner, sizeof page->corner);
        h = gn_hash(h, page->from_px, sizeof page->from_px);
        h = gn_hash(h, page->size_px, sizeof page->size_px);
    }
    for (uint32_t i = 0; i < pose->scene->item_count && !tile->empty; i++)
        if (casts[i]) {
            uint64_t item[2] = {i, pose->items[i].hash};
            h = gn_hash(h, item, sizeof item);
        }
    return h ? h : 1;
}
