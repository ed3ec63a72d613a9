/* Which level of detail the picture has of each item: the coarsest whose error is small enough in
 * this picture's pixels. By this camera alone, without memory, so that equal cameras have equal
 * pictures; no change of level is seen, as each is within the same bound of the whole mesh. Maps
 * have whole meshes: they stay as they are while only the camera moves. */
#include <cglm/cglm.h>
#include <math.h>

#include "blocks.glsl"
#include "frame/private.h"

/* Error that --detail auto allows. */
#define AUTO_PX        1.0f
/* Texels of the finest map that a surface may lie below what the map has of it. The bias of all
 * that reads maps grows by so much, else surfaces that face the light would shade themselves. */
#define RECEIVE_TEXELS .5f
/* Pixels of a triangle, about, from which on few lanes are shaded twice. */
#define PAYS_PX        64.0f

/* Pixels of a metre across the view at the nearest part of a box, at most; INFINITY: it reaches the
 * eye. m: clip_from_world, column by column. */
static float px_of_metre(const float (*m)[4], const struct gn_box *box,
                         const struct gn_plan *plan) {
    float w = m[3][3], rows2[4] = {0};
    for (int k = 0; k < 3; k++) {
        w += fminf(m[k][3] * box->min[k], m[k][3] * box->max[k]);
        for (int r = 0; r < 4; r++) rows2[r] += m[k][r] * m[k][r];
    }
    if (!(w > 0)) return INFINITY;
    const float across = (float)plan->width_px * sqrtf(rows2[0] + rows2[3]),
                up = (float)plan->height_px * sqrtf(rows2[1] + rows2[3]);
    return .5f * fmaxf(across, up) / w;
}

static float scale_of(mat4 m) {
    float scale = 0;
    for (int k = 0; k < 3; k++) scale = fmaxf(scale, glm_vec3_norm(m[k]));
    return scale;
}

static bool reads_texels(const struct gn_shadow_view *view) {
    return !gn_techniques[view->technique].on_plane && view->encoding != GN_ENCODING_SCREEN &&
           !view->empty;
}

/* A texel of the finest map, where a box may receive its shadow. */
static float least_texel(const struct gn_frame *frame, const struct gn_box *box) {
    float least = INFINITY;
    for (uint32_t i = 0; i < frame->view_count; i++) {
        const struct gn_shadow_view *view = &frame->shadows[i];
        float texel = view->lookup.texel, nearest2 = 0;
        if (!reads_texels(view)) continue;
        for (int k = 0; k < 3; k++) {
            const float x = view->light_ws[k], off = fmaxf(box->min[k] - x, x - box->max[k]);
            nearest2 += off > 0 ? off * off : 0;
        }
        if (view->perspective) texel *= sqrtf(nearest2);
        if (view->map.cascade_count > 0) texel = view->cascades[0].texel;
        least = fminf(least, texel);
    }
    return least;
}

/* *off_m: how far its surface is off, at most. */
static uint8_t level_of(const struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_frame_opts *opts, uint32_t index, float *off_m) {
    const struct gn_item *item = &frame->scene->items[index];
    const struct gn_levels *levels = &frame->plan.detail->geometries[item->geometry];
    const float(*clip)[4] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE) + PASS_CLIP;
    const struct gn_box *box = &pose->items[index].box_ws;
    *off_m = 0;
    if (levels->count == 0 || !pose->items[index].visible) return 0;
    const float px = px_of_metre(clip, box, &frame->plan),
                size_px = px * glm_vec3_distance((float *)box->min, (float *)box->max),
                triangles = (float)frame->scene->geometries[item->geometry].index_count / 3,
                scale =
                    gn_item_is_deformed(item) ? 1 : scale_of(pose->items[index].world_from_item),
                allowed_px = opts->detail.px > 0 ? opts->detail.px : AUTO_PX,
                most_m = fminf(allowed_px / px, RECEIVE_TEXELS * least_texel(frame, box));
    if (size_px * size_px > PAYS_PX * triangles) return 0;
    uint8_t level = 0;
    while (level < levels->count && levels->at[level].error_m * scale <= most_m) level++;
    if (level > 0) *off_m = levels->at[level - 1].error_m * scale;
    return level;
}

void gn_frame_choose_levels(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts) {
    float most_m = 0, off_m;
    frame->items.levels.count = 0;
    for (uint32_t i = 0; frame->plan.detail && i < frame->scene->item_count; i++) {
        GN_LIST_PUSH(&frame->items.levels) = level_of(frame, pose, opts, i, &off_m);
        most_m = fmaxf(most_m, off_m);
    }
    for (uint32_t i = 0; i < frame->view_count; i++)
        if (reads_texels(&frame->shadows[i])) frame->shadows[i].code.ulp_m += most_m;
}
