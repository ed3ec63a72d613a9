/* An unseen floor under the made light: what it takes from the picture does not depend on the eye,
 * and is gathered in a texture of alpha. Its mask is the mean of the shadows of points of the lamp,
 * as of planar shadows; a filter step makes alpha of that and of the floor's occlusion; the floor
 * is drawn with one lookup. The light's own map has the model as its only receiver then, and finer
 * texels. Where a caster can move all is done in each frame, with fewer points and texels: on a
 * Pi 4 that costs less than looking the cones up in each of the floor's pixels. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "blocks.glsl"
#include "core/srgb.h"
#include "frame/private.h"

enum {
    POINTS = 128,    /* of the lamp; */
    FEW_POINTS = 64, /* of models with more triangles than this; */
    FEW_ABOVE = 250000,
    MOST_TRIANGLES = 500000, /* with more the floor is drawn with the light's own map */
    LEAST_POINTS = 16,       /* in the first frame; then as many as this many triangles allow */
    FRAME_TRIANGLES = 500000,
    MOVING_POINTS = 64, /* where a caster moves, all in each frame; */
    FEW_MOVING_POINTS = 32,
    FEW_MOVING_ABOVE = 1500,
    MOST_MOVING_TRIANGLES = 8000,
    MOVING_PX = 512, /* side of a mask that is filtered in each frame, too */
};

static bool is_soft_and_made(const struct gn_frame *frame, const struct gn_frame_light *light) {
    const struct gn_technique_row *row = &gn_techniques[light->technique];
    return row->soft && !row->on_plane && !row->on_screen && light->opts.radius > 0.0f &&
           light->slide == GN_SLIDE_NONE && light->light + 1 == frame->scene->light_count &&
           frame->scene->lights[light->light].type == GN_LIGHT_DIRECTIONAL;
}

bool gn_frame_casters_stand(const struct gn_pose *pose) {
    bool any = false;
    for (uint32_t i = 0; i < pose->scene->item_count; i++) {
        if (!gn_shadow_item_casts(pose->scene, i)) continue;
        if (pose->items[i].moves) return false;
        any |= pose->items[i].visible;
    }
    return any;
}

static uint32_t floor_of(const struct gn_scene *scene) {
    uint32_t item = scene->item_count - 1;
    while (item > 0 && !scene->materials[scene->items[item].material].shadow_catcher) item--;
    return item;
}

void gn_frame_take_floor(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts) {
    const struct gn_scene *scene = frame->scene;
    frame->floor.is_apart = false;
    if (!scene->added.light || !scene->added.floor || frame->light_count != 1 ||
        frame->view_count != 1 || scene->triangle_count > MOST_TRIANGLES ||
        (opts->debug.aov != GN_AOV_COLOR && opts->debug.aov != GN_AOV_VISIBILITY) ||
        !is_soft_and_made(frame, &frame->lights[0]))
        return;
    frame->floor.stands = gn_frame_casters_stand(pose);
    if (!frame->floor.stands && scene->triangle_count > MOST_MOVING_TRIANGLES) return;
    frame->floor.item = floor_of(scene);
    frame->floor.is_apart =
        pose->items[frame->floor.item].visible && scene->items[frame->floor.item].plane == 1;
    if (frame->floor.is_apart) frame->floor.slot = frame->view_count++;
}

void gn_frame_want_floor(const struct gn_frame *frame, const struct gn_pose *pose,
                         struct gn_shadow_opts *wanted) {
    const struct gn_scene *scene = frame->scene;
    const uint32_t item = frame->floor.item;
    vec4 *world = pose->items[item].world_from_item;
    const bool occluded =
        scene->materials[scene->items[item].material].textures[GN_TEXTURE_OCCLUSION].texture >= 0;
    const bool color = !wanted->all_receive;
    wanted->technique = color ? GN_TECHNIQUE_FLOOR : GN_TECHNIQUE_PLANAR;
    wanted->encoding = GN_ENCODING_MEAN;
    wanted->moments = color ? GN_MOMENTS_FLOOR : GN_MOMENTS_NONE;
    wanted->plane = 1;
    wanted->points = scene->triangle_count > FEW_ABOVE ? FEW_POINTS : POINTS;
    if (!frame->floor.stands) {
        wanted->points =
            scene->triangle_count > FEW_MOVING_ABOVE ? FEW_MOVING_POINTS : MOVING_POINTS;
        wanted->map_px = MOVING_PX;
    }
    wanted->whole = true;
    wanted->but_floor = false;
    wanted->cascades = 1;
    wanted->square = (struct gn_shadow_square){
        .middle = {world[3][0], world[3][2]},
        .half_m = world[0][0],
        .held_m = occluded ? 0.5f * GN_FLOOR_OCCLUDED * world[0][0] : 0.0f};
}

uint32_t gn_frame_floor_points(const struct gn_frame *frame) {
    const uint64_t each = frame->scene->triangle_count;
    return each > FRAME_TRIANGLES / LEAST_POINTS ? LEAST_POINTS
                                                 : (uint32_t)(FRAME_TRIANGLES / (each + 1));
}

/* ---- its light ---- */

/* Radiance of a white floor in the ambient light: lib/environment.glsl at a normal of +Y, which no
 * turn of the environment moves. */
static float ambient_of(const struct gn_frame *frame, const float (*c)[4]) {
    const struct gn_environment_light *light = frame->plan.environment.light;
    vec3 sum;
    if (!light || frame->environment.reflected_only) return gn_luminance(c[PASS_SKY]);
    for (int k = 0; k < 3; k++) {
        const float(*h)[3] = light->harmonics;
        const float even = fmaxf(h[0][k] - h[6][k] - h[8][k], 0.0f);
        sum[k] = even + glm_clamp(h[1][k], -even, even);
    }
    return gn_luminance(sum) * c[PASS_SKY][3];
}

void gn_frame_light_floor(struct gn_frame *frame, const struct gn_pose *pose) {
    if (!frame->floor.is_apart) return;
    const float(*c)[4] = (const float(*)[4])gn_frame_constants(frame, GN_CONSTANTS_PICTURE);
    const float(*light)[4] = c + PASS_LIGHTS;
    vec4 plane;
    gn_pose_plane(pose, frame->floor.item, plane);
    const float cosine = fmaxf(glm_vec3_dot(plane, (float *)light[LIGHT_PLACE]), 0.0f),
                key = gn_luminance(light[LIGHT_COLOR]) * cosine, ambient = ambient_of(frame, c),
                all = fmaxf(key + ambient, 1e-6f);
    struct gn_shadow_floor *floor = &frame->shadows[frame->floor.slot].floor;
    floor->ambient = ambient / all;
    floor->key = frame->lights[0].opts.strength * key / all;
}

/* ---- its passes ---- */

/* Clip space of the mask's corner, and per unit of u and v: from plane coordinates. */
static void place_mask(const struct gn_frame *frame, const struct gn_shadow_view *view,
                       float (*to)[4]) {
    const struct gn_shadow_raster *raster = &view->raster;
    const float side = view->lookup.texel * (float)view->map.tile_px;
    mat4 world_from_plane, clip_from_plane;
    glm_mat4_inv((vec4 *)raster->tiles[0].light_from_world, world_from_plane);
    glm_mat4_mul((vec4 *)frame->eye.clip_from_world, world_from_plane, clip_from_plane);
    glm_mat4_mulv(clip_from_plane, (vec4){view->lamp.corner[0], view->lamp.corner[1], 0.0f, 1.0f},
                  to[0]);
    for (int k = 0; k < 2; k++) glm_vec4_scale(clip_from_plane[k], side, to[1 + k]);
}

/* Whether the eye is on the upper side. */
static bool is_seen(const struct gn_frame *frame, const struct gn_pose *pose) {
    vec4 plane;
    const float *eye = gn_frame_constants(frame, GN_CONSTANTS_PICTURE)[PASS_EYE];
    gn_pose_plane(pose, frame->floor.item, plane);
    return glm_vec4_dot(plane, (float *)eye) > 0.0f;
}

static void draw_alpha(struct gn_frame *frame, const struct gn_pose *pose,
                       const struct gn_frame_opts *opts) {
    const struct gn_shadow_view *view = &frame->shadows[frame->floor.slot];
    if (!opts->all_seen && (view->empty || !is_seen(frame, pose))) return;
    struct gn_program_key key = gn_key_of(GN_PROGRAM_FLOOR);
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_FLOOR);
    place_mask(frame, view, c + FLOOR_PLACE);
    memcpy(c[FLOOR_SHOWN], view->floor.shown, sizeof view->floor.shown);
    struct gn_pass *pass = gn_frame_picture_pass(frame, "floor");
    pass->picture.blend = GN_BLEND_ALPHA;
    pass->picture.shadow_count = pass->picture.plane_count = 1;
    pass->picture.first_on_plane = frame->floor.slot;
    pass->depth_write = false;
    pass->constants = c;
    pass->constant_count = FLOOR_SIZE;
    gn_frame_draw_bare(frame, &key, 6, 0, 1);
    gn_frame_end_pass(frame);
}

static void draw_visibility(struct gn_frame *frame, const struct gn_pose *pose,
                            const struct gn_frame_opts *opts) {
    const struct gn_selection seen = {.opts = opts};
    bool open = false;
    struct gn_pass *pass = gn_frame_lit_pass(frame, "floor", 0);
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_FLOOR);
    memcpy(c, pass->constants, GN_PASS_SIZE * sizeof *c);
    gn_frame_reader_constants(&frame->shadows[frame->floor.slot], 0, c);
    pass->constants = (const float(*)[4])c;
    pass->picture.plane_count = 1;
    pass->picture.first_on_plane = frame->floor.slot;
    gn_frame_draw_item(frame, pose, &seen, frame->floor.item, &open);
    gn_frame_end_pass(frame);
}

void gn_frame_draw_floor(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts) {
    if (opts->debug.aov == GN_AOV_COLOR)
        draw_alpha(frame, pose, opts);
    else if (frame->floor.is_apart)
        draw_visibility(frame, pose, opts);
}
