/* Fitting a shadow view: round the window that window.c finds. */
#include "shadow/fit.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/hash.h"
#include "shadow/cascade.h"
#include "shadow/planar.h"
#include "shadow/private.h"
#include "shadow/region.h"

#define STEPS_PER_OCTAVE 8 /* of the texel's size: the window's width moves in steps of 9 % */
#define RIM_TEXELS       2 /* cleared rim, and the texel that snapping takes */
#define RGBA8_FAR        0.999999f      /* lib/map_rgba8.glsl */
#define SHARED_TEXELS    1.0f           /* to each side of an edge of two tiles */
#define EDGE_TEXELS      0.25f          /* from where the gutter would begin to such an edge */
#define NEAREST_STEP     (1.0f / 64.0f) /* of a sun's depths */
#define LEAST_TANGENT    1e-6f /* side of a spot's window; a sun's: as much of the scene's size */

bool gn_shadow_item_casts(const struct gn_scene *scene, uint32_t item) {
    const struct gn_item *it = &scene->items[item];
    return it->casts && scene->materials[it->material].alpha != GN_ALPHA_BLEND;
}

bool gn_shadow_item_receives(const struct gn_pose *pose, uint32_t item,
                             const struct gn_shadow_view *view) {
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

/* The planes of a pyramid round the cone, that of the range if the light has one. Its near plane is
 * a ten-thousandth of the scene away, by steps: while the scene grows by little, what was measured
 * holds. */
static void set_cone(struct gn_fitter *f, float tan_cone) {
    f->tan_cone = tan_cone;
    f->near_m = gn_shadow_step(1e-4f * f->scene_size_m);
    vec4 planes[6] = {{1, 0, -tan_cone, 0},  {-1, 0, -tan_cone, 0},  {0, 1, -tan_cone, 0},
                      {0, -1, -tan_cone, 0}, {0, 0, -1, -f->near_m}, {0, 0, 1, f->range_m}};
    f->cone_count = isfinite(f->range_m) ? 6 : 5;
    for (int i = 0; i < f->cone_count; i++) /* a plane goes by the transpose: world from light */
        for (int c = 0; c < 4; c++)
            f->cone[i][c] = glm_vec4_dot(planes[i], f->tile->light_from_world[c]);
}

void gn_shadow_snap(struct gn_shadow_view *view, const float min[2], const float max[2],
                    float least, double low[2]) {
    uint32_t margin = gn_techniques[view->technique].radius_texels + RIM_TEXELS;
    uint32_t usable = view->map_px > 2 * margin + 2 ? view->map_px - 2 * margin : 2;
    float span = fmaxf(max[0] - min[0], max[1] - min[1]);
    view->texel = gn_shadow_step(fmaxf(span, least) / (float)(usable - 1));
    for (int k = 0; k < 2; k++)
        low[k] = (floor((double)min[k] / view->texel) - margin) * view->texel;
}

static float half_float_step(float value) {
    return exp2f(floorf(log2f(fmaxf(value, 1e-5f))) - 10.0f);
}

/* The encoding's code of a distance is distance * scale + offset; ulp_m is its coarsest step. */
static void set_code(const struct gn_fitter *f, float near_depth, float far_depth) {
    struct gn_shadow_view *view = f->view;
    float range = view->far_m - view->near_m;
    float float_step = 7e-7f * view->far_m; /* of the interpolation */
    /* A sun's depths may span less than the scene: then places themselves are coarser. */
    if (!view->perspective) float_step = fmaxf(float_step, 2e-7f * gn_scene_reach_m(f->pose));
    view->distance_scale = 1.0f;
    view->distance_offset = 0.0f;
    view->far_code = view->far_m;
    view->ulp_m = float_step;
    switch (view->encoding) {
    case GN_ENCODING_R16F:
        view->distance_scale = 2.0f / range;
        view->distance_offset = -(view->far_m + view->near_m) / range;
        view->far_code = 1.0f;
        view->ulp_m = 0.5f * range * exp2f(-11.0f) + float_step;
        return;
    case GN_ENCODING_R16F_RAW:
        view->ulp_m = half_float_step(view->far_m) + float_step;
        /* a half float itself: what the map is cleared to must be what is compared with */
        view->far_code =
            ceilf(view->far_m / half_float_step(view->far_m)) * half_float_step(view->far_m);
        return;
    case GN_ENCODING_RGBA8:
        view->distance_scale = 1.0f / range;
        view->distance_offset = -view->near_m / range;
        view->far_code = RGBA8_FAR;
        view->ulp_m = range * exp2f(-22.0f) + float_step;
        return;
    case GN_ENCODING_DEPTH:
        view->far_code = 1.0f;
        view->ulp_m += view->perspective ? far_depth * range / near_depth * exp2f(-23.0f)
                                         : range * exp2f(-22.0f);
        return;
    case GN_ENCODING_R32UI:
        if (!gn_technique_filters_map(view->technique)) return;
        view->distance_scale = 1.0f / range; /* 0..1: what moments are made of */
        view->distance_offset = -view->near_m / range;
        view->far_code = 1.0f;
        return;
    case GN_ENCODING_MASK:
    case GN_ENCODING_STENCIL:
    case GN_ENCODING_COUNT: return;
    }
}

/* Of lamps; a sun's: pages.c. */
static void set_clip(struct gn_shadow_view *view, const double low[2], float near_depth,
                     float far_depth) {
    double side = (double)view->texel * view->map_px;
    float left = (float)low[0], right = (float)(low[0] + side), bottom = (float)low[1],
          top = (float)(low[1] + side);
    mat4 clip_from_light;
    glm_frustum(left * near_depth, right * near_depth, bottom * near_depth, top * near_depth,
                near_depth, far_depth, clip_from_light);
    for (uint32_t i = 0; i < view->tile_count; i++)
        glm_mat4_mul(clip_from_light, view->tiles[i].light_from_world,
                     view->tiles[i].clip_from_world);
}

static void set_lookup(struct gn_shadow_view *view, float near_depth) {
    mat4 map_from_clip = {{0.5f, 0, 0, 0}, {0, 0.5f, 0, 0}, {0, 0, 0.5f, 0}, {0.5f, 0.5f, 0.5f, 1}};
    glm_mat4_mul(map_from_clip, view->tiles[0].clip_from_world, view->map_from_world);
    if (view->perspective || view->encoding == GN_ENCODING_DEPTH) return;
    for (int c = 0; c < 4;
         c++) { /* z is the code itself: distance from the near plane is -z_ls - near */
        float depth = -view->tiles[0].light_from_world[c][2] - (c == 3 ? near_depth : 0.0f);
        view->map_from_world[c][2] =
            depth * view->distance_scale + (c == 3 ? view->distance_offset : 0.0f);
    }
}

/* With some room on each side. Of a sun never none: casters in one plane across its light span no
 * depth, and in a plane through the world's origin that depth is 0. */
static void set_depths(const struct gn_fitter *f, const struct gn_shadow_region *depths,
                       float *near_depth, float *far_depth) {
    struct gn_shadow_view *view = f->view;
    float pad = 1e-3f * (depths->far - depths->near) + 1e-5f * fabsf(depths->far);
    if (!view->perspective) pad = fmaxf(pad, 1e-6f * gn_scene_reach_m(f->pose));
    *near_depth =
        view->perspective ? fmaxf(depths->near - pad, 0.5f * depths->near) : depths->near - pad;
    *far_depth = depths->far + pad;
    view->near_m = view->perspective ? *near_depth : 0.0f;
    view->far_m = view->perspective ? depths->far_radial + pad : *far_depth - *near_depth;
}

/* Similar triangles (Fernando, "Percentage-Closer Soft Shadows", 2005): in plane units a blocker at
 * b throws on a receiver at r a penumbra of radius (r - b) tan(sun's radius), or radius (1/b - 1/r)
 * of a lamp. */
static void set_soft(const struct gn_fitter *f, const struct gn_shadow_region *window,
                     float near_depth, float far_depth) {
    struct gn_shadow_view *view = f->view;
    view->soft[0] = f->light_radius / view->texel;
    if (view->perspective && view->encoding == GN_ENCODING_DEPTH) { /* linear in 1 / depth */
        view->soft[1] = -1.0f / near_depth;
        view->soft[2] = 1.0f / near_depth - 1.0f / far_depth;
        view->soft[3] = -1.0f / near_depth;
        return;
    }
    view->soft[1] = -1.0f / near_depth;
    if (!view->perspective) view->soft[1] = most(window->near - near_depth, 0.0f);
    const float part = NEAREST_STEP * view->far_m; /* it stays while the eye moves little */
    if (!view->perspective && !f->is_cascade) view->soft[1] = floorf(view->soft[1] / part) * part;
    view->farthest = window->far - near_depth;
    view->soft[2] = view->encoding == GN_ENCODING_DEPTH ? view->far_m : 1.0f / view->distance_scale;
    view->soft[3] = -view->distance_offset / view->distance_scale;
}

/* A blur cannot know how far blockers are: it is as wide as the penumbra of what stands before the
 * farthest caster by a quarter of what all of them span, within what a map is fit for. */
static void set_blur(const struct gn_fitter *f, float near_depth, float far_depth) {
    struct gn_shadow_view *view = f->view;
    if (gn_techniques[view->technique].filter != GN_FILTER_BLUR) return;
    const float behind = 0.25f * (far_depth - near_depth);
    const float spread =
        view->perspective ? 1.0f / (far_depth - behind) - 1.0f / far_depth : behind;
    float blur = f->light_radius * spread;
    if (f->blur_most_m > 0.0f) blur = least(blur, f->blur_most_m); /* or it jumps at each split */
    const float blur_px = blur / view->texel;
    view->blur_px = least(most(blur_px, GN_BLUR_LEAST_PX), GN_BLUR_MOST_PX);
}

/* Normal offset and slope by the width that the technique averages over; figures measured by `make
 * truth`. */
static void set_bias(struct gn_shadow_view *view) {
    float width = gn_techniques[view->technique].bias_texels;
    view->normal_offset = width;
    view->slope_offset = 0.7f * width;
    view->slope_max = 4.0f;
}

static uint64_t hash_page(uint64_t h, const struct gn_shadow_page *page) {
    h = gn_hash(h, page->corner, sizeof page->corner);
    h = gn_hash(h, page->from_px, sizeof page->from_px);
    return gn_hash(h, page->size_px, sizeof page->size_px);
}

uint64_t gn_shadow_hash(const struct gn_pose *pose, const struct gn_shadow_view *view,
                        const struct gn_shadow_tile *tile, const uint8_t *casts) {
    float code[] = {view->distance_scale, view->distance_offset, view->far_code,
                    (float)view->map_px, (float)view->encoding};
    uint64_t h = gn_hash(GN_HASH_INIT, code, sizeof code);
    if (!tile->empty) h = gn_hash(h, tile->clip_from_world, sizeof tile->clip_from_world);
    for (uint32_t p = 0; p < view->page_count; p++) h = hash_page(h, &view->pages[p]);
    for (uint32_t i = 0; i < pose->scene->item_count && !tile->empty; i++)
        if (casts[i]) {
            uint64_t item[2] = {i, pose->items[i].hash};
            h = gn_hash(h, item, sizeof item);
        }
    return h ? h : 1;
}

/* ---- one tile: directional lights and spots ---- */

static void lay_window(const struct gn_fitter *f, const struct gn_window *found, float near_depth,
                       float far_depth) {
    const struct gn_shadow_region *window = &found->window;
    double low[2];
    if (!f->view->perspective) {
        gn_pages_fit(f, found, near_depth, far_depth);
        return;
    }
    gn_shadow_snap(f->view, window->min, window->max, LEAST_TANGENT, low);
    set_clip(f->view, low, near_depth, far_depth);
}

bool gn_shadow_fit_window(struct gn_fitter *f) {
    const struct gn_light *light = &f->pose->scene->lights[f->view->light];
    struct gn_window found;
    float near_depth, far_depth;
    gn_shadow_look(f->view, f->tile->light_from_world);
    if (light->type == GN_LIGHT_SPOT) set_cone(f, tanf(fminf(light->outer_rad, GN_SPOT_MAX_RAD)));
    gn_fitter_remember(f);
    if (!gn_window_find(f, false, &found)) return false;
    set_depths(f, &found.depths, &near_depth, &far_depth);
    set_code(f, near_depth, far_depth);
    lay_window(f, &found, near_depth, far_depth);
    set_lookup(f->view, near_depth);
    set_soft(f, &found.window, near_depth, far_depth);
    set_blur(f, near_depth, far_depth);
    return true;
}

/* ---- six tiles: point lights ---- */

static void aim_tile(struct gn_fitter *f, uint32_t index) {
    struct gn_shadow_view *view = f->view;
    struct gn_shadow_tile *tile = f->tile = &view->tiles[index];
    uint32_t axis = index / 2, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    float side = index % 2 ? -1.0f : 1.0f;
    vec4 *m = tile->light_from_world;
    glm_mat4_zero(m);
    m[u][0] = m[v][1] = m[3][3] = 1.0f;
    m[axis][2] = -side;
    m[3][0] = -view->light_ws[u];
    m[3][1] = -view->light_ws[v];
    m[3][2] = side * view->light_ws[axis];
    tile->mirrored = (axis == 1) == (side < 0.0f);
    tile->x_px = axis * view->map_px;
    tile->y_px = index % 2 * view->map_px;
    set_cone(f, 0.5f * view->texel * (float)view->map_px);
}

/* Measures all tiles: the depths of the casters in any of them. False when all are empty. */
static bool find_tiles(struct gn_fitter *f, struct gn_shadow_region *depths) {
    struct gn_shadow_memory *memories = f->memory;
    bool found = false;
    *depths = nothing;
    for (uint32_t i = 0; i < f->view->tile_count; i++) {
        struct gn_window own;
        f->memory = &memories[i];
        aim_tile(f, i);
        gn_fitter_remember(f);
        f->tile->empty = !gn_window_find(f, false, &own);
        found |= !f->tile->empty;
        unite(depths, &own.depths);
    }
    f->memory = memories;
    return found;
}

/* What moves shall change the tiles that it is in: near and far, which are for all, go by steps. */
static void widen_depths(struct gn_shadow_region *depths) {
    depths->near = exp2f(floorf(4.0f * log2f(depths->near)) / 4.0f);
    depths->far = exp2f(ceilf(4.0f * log2f(depths->far)) / 4.0f);
    depths->far_radial = exp2f(ceilf(4.0f * log2f(depths->far_radial)) / 4.0f);
}

/* A place beyond the edge is looked up where tiles are shared; pushed off its surface it may lie
 * sqrt(2) normal offsets further: at 45 degrees a tangent grows so much faster. The edge itself
 * lies in no middle and on no border of texels, where two taps opposite each other would change
 * them at once. */
static void set_gutter(struct gn_shadow_view *view) {
    const struct gn_technique_row *row = &gn_techniques[view->technique];
    const bool shared = gn_technique_shades(view->technique);
    const float beyond =
        EDGE_TEXELS + (shared ? SHARED_TEXELS + 1.4142136f * row->bias_texels : 0.0f);
    const uint32_t wanted = (uint32_t)ceilf((float)row->radius_texels + 1.0f + beyond);
    view->gutter_px = row->soft && wanted < view->map_px / 8 ? view->map_px / 8 : wanted;
    if (view->gutter_px > view->map_px / 4) view->gutter_px = view->map_px / 4;
    view->reach_px = (float)view->gutter_px - 1.0f - beyond;
    if (row->filter == GN_FILTER_TABLE) view->reach_px = least(view->reach_px, GN_TABLE_REACH_PX);
    view->texel = 2.0f / ((float)(view->map_px - 2 * view->gutter_px) + 2.0f * EDGE_TEXELS);
    view->shared = SHARED_TEXELS * view->texel;
}

static bool fit_tiles(struct gn_fitter *f) {
    struct gn_shadow_view *view = f->view;
    struct gn_shadow_region depths;
    set_gutter(view);
    if (!find_tiles(f, &depths)) return false;
    float near_depth, far_depth;
    double edge = -0.5 * (double)view->texel * view->map_px;
    widen_depths(&depths);
    set_depths(f, &depths, &near_depth, &far_depth);
    set_code(f, near_depth, far_depth);
    set_clip(view, (double[2]){edge, edge}, near_depth, far_depth);
    set_soft(f, &depths, near_depth, far_depth);
    set_blur(f, near_depth, far_depth);
    view->tangent_uv[0] = 1.0f / (view->texel * (float)view->width_px);
    view->tangent_uv[1] = 1.0f / (view->texel * (float)view->height_px);
    view->depth_code[0] = far_depth / (far_depth - near_depth);
    view->depth_code[1] = -near_depth * far_depth / (far_depth - near_depth);
    return true;
}

/* ---- either ---- */

uint32_t gn_shadow_tile_count(enum gn_light_type type, enum gn_technique technique) {
    return type == GN_LIGHT_POINT && !gn_techniques[technique].on_plane ? GN_SHADOW_TILES_MAX : 1;
}

void gn_shadow_map_size(enum gn_light_type type, enum gn_technique technique, uint32_t map_px,
                        uint32_t size_px[2]) {
    const bool atlas = gn_shadow_tile_count(type, technique) > 1;
    size_px[0] = atlas ? 3 * map_px : map_px;
    size_px[1] = atlas ? 2 * map_px : map_px;
}

/* All that does not depend on what casts or is seen. */
static void begin_view(const struct gn_pose *pose, uint32_t light,
                       const struct gn_shadow_opts *opts, struct gn_shadow_view *view) {
    const enum gn_light_type type = pose->scene->lights[light].type;
    uint32_t size_px[2];
    vec3 direction;
    gn_shadow_map_size(type, opts->technique, opts->map_px, size_px);
    *view = (struct gn_shadow_view){.light = light,
                                    .technique = opts->technique,
                                    .encoding = opts->encoding,
                                    .moments = opts->moments,
                                    .map_px = opts->map_px,
                                    .all_receive = opts->all_receive,
                                    .width_px = size_px[0],
                                    .height_px = size_px[1],
                                    .tile_count = gn_shadow_tile_count(type, opts->technique),
                                    .perspective = type != GN_LIGHT_DIRECTIONAL};
    if (gn_techniques[view->technique].filter == GN_FILTER_TABLE)
        view->reach_px = GN_TABLE_REACH_PX;
    if (opts->cascades > 1 && !view->perspective && !gn_techniques[opts->technique].on_plane)
        gn_cascades_lay(opts->cascades, view);
    gn_pose_light(pose, light, view->light_ws, direction);
    glm_vec3_negate_to(direction, view->to_light_ws);
}

/* All of the map is the far end, so wherever it is read there is light. But techniques ask how the
 * code changes across the map: it must have two directions. It is the light's frame, one unit wide,
 * with a code of 0 everywhere. */
static void make_empty(struct gn_shadow_view *view) {
    mat4 m;
    gn_shadow_look(view, m);
    for (int c = 0; c < 4; c++) {
        vec4 column = {m[c][0], m[c][1], 0.0f, view->perspective ? -m[c][2] : c == 3};
        glm_vec4_copy(column, view->map_from_world[c]);
    }
    for (int k = 0; k < 2; k++) view->tangent_uv[k] = 1.0f, view->depth_code[k] = 0.0f;
    view->distance_scale = view->distance_offset = 0.0f;
    view->texel = view->normal_offset = view->slope_offset = view->ulp_m = 0.0f;
    glm_vec4_copy((vec4){0.0f, -1.0f, 0.0f, 1.0f}, view->soft); /* no penumbra */
    view->far_code = view->encoding == GN_ENCODING_RGBA8 ? RGBA8_FAR : 1.0f;
    view->empty = true;
    view->blur_px =
        gn_techniques[view->technique].filter == GN_FILTER_BLUR ? GN_BLUR_LEAST_PX : 0.0f;
    for (uint32_t i = 0; i < view->tile_count; i++) {
        view->tiles[i].empty = true;
        view->tiles[i].content_hash = 1;
    }
    for (uint32_t i = 0; i < view->cascade_count; i++) view->cascades[i].page_count = 0;
}

static bool fit_one(struct gn_fitter *f) {
    if (f->view->cascade_count > 0) return gn_cascades_fit(f);
    return f->view->tile_count > 1 ? fit_tiles(f) : gn_shadow_fit_window(f);
}

static bool fit_map(const struct gn_pose *pose, const struct gn_eye *eye,
                    struct gn_shadow_memory *memory, struct gn_shadow_view *view) {
    const struct gn_light *light = &pose->scene->lights[view->light];
    struct gn_fitter f = {.pose = pose,
                          .eye = eye,
                          .memory = memory,
                          .view = view,
                          .tile = view->tiles,
                          .scene_size_m = gn_scene_size_m(pose),
                          .light_radius = light->radius,
                          .range_m = light->range_m > 0.0f ? light->range_m : INFINITY};
    if (!fit_one(&f)) return false;
    set_bias(view);
    for (uint32_t i = 0; i < view->tile_count && view->cascade_count == 0; i++)
        view->tiles[i].content_hash = gn_shadow_hash(pose, view, &view->tiles[i], memory[i].casts);
    return true;
}

bool gn_shadow_fit(const struct gn_pose *pose, uint32_t light, const struct gn_eye *eye,
                   const struct gn_shadow_opts *opts, struct gn_shadow_memory *memory,
                   struct gn_shadow_view *view) {
    assert(opts->technique != GN_TECHNIQUE_NONE);
    begin_view(pose, light, opts, view);
    bool found = gn_techniques[opts->technique].on_plane ? gn_planar_fit(pose, eye, memory, view)
                                                         : fit_map(pose, eye, memory, view);
    if (!found) make_empty(view);
    return found;
}
