/* Fits a planar shadow. With the plane n.p + d = 0 and the light at L = (xyz, 1), or towards (xyz,
 * 0), the matrix (P.L) I - L P^T of P = (n, d) projects a point to its shadow on the plane, in
 * homogeneous coordinates (Blinn, "Me and My (Fake) Shadow", 1988). Its w is the light's height
 * over the plane minus the point's, so the near plane is laid just below the light and the far
 * plane slightly above the receiver: the rasteriser cuts casters at both, and what stands on the
 * plane or lies in it does not shadow it at the contact. */
#include "shadow/planar.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "core/hash.h"
#include "shadow/lamp.h"
#include "shadow/private.h"
#include "shadow/region.h"

#define HAIR 3e-5f /* of the highest caster: they begin at this height over the plane */
#define LIGHT_SHARE                                                                                \
    (1.0f / 128.0f) /* of the light's height: casters end this far below the light */
#define CONE_MAX_RAD 1.48f
#define LEAST_TEXELS 0.5f /* narrower penumbrae have one point */
#define FOOT_TEXELS                                                                                \
    0.25f /* what lies as near to the plane stands on it: no light is seen below                   \
           */

/* The light as a point, or a point of a lamp. */
struct aim {
    vec4 light; /* its place, 1; or the direction towards it, 0, scaled to plane.light = 1 */
    mat4 fallen_from_world; /* projects onto the plane, world space, homogeneous */
    mat4 shadow_from_world; /* plane coordinates times w; height over the plane; w */
    float light_m;          /* plane.light */
    float low_m, high_m;    /* heights between which casters cast */
};

enum { CORNERS = 8 }; /* of a cube around a lamp; of a sun's disk half as many */

struct planar {
    const struct gn_pose *pose;
    const struct gn_eye *eye;
    struct gn_shadow_view *view;
    vec4 plane;               /* world space; positive on the light's side */
    struct aim aim;           /* the light's middle */
    struct aim aims[CORNERS]; /* between them is all of the lamp; the middle alone where that is all
                               */
    int aim_count;
    float low_m, highest_m; /* where casters begin, and where the highest ends */
    float scene_size_m;
};

/* ---- regions of the plane ---- */

static void add_point(struct gn_shadow_region *r, mat4 to, vec3 p_ws) {
    vec4 p = {p_ws[0], p_ws[1], p_ws[2], 1.0f};
    glm_mat4_mulv(to, p, p);
    float x = p[0] / p[3], y = p[1] / p[3];
    unite(r, &(struct gn_shadow_region){.min = {x, y}, .max = {x, y}});
}

static void add_polygon(struct gn_shadow_region *r, mat4 to, struct gn_polygon *polygon,
                        vec4 *planes, int count) {
    for (int i = 0; i < count && polygon->count; i++) gn_polygon_clip(polygon, planes[i]);
    for (int i = 0; i < polygon->count; i++) add_point(r, to, polygon->at[i]);
}

static void add_body(struct gn_shadow_region *r, mat4 to, vec3 corners[8], vec4 *planes,
                     int count) {
    for (int i = 0; i < 6; i++) {
        struct gn_polygon face;
        gn_box_face(corners, i, &face);
        add_polygon(r, to, &face, planes, count);
    }
}

/* ---- plane and light ---- */

static const struct gn_geometry *geometry_of(const struct planar *f, uint32_t item) {
    return &f->pose->scene->geometries[f->pose->scene->items[item].geometry];
}

bool gn_planar_has_plane(const struct gn_scene *scene) {
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].plane && scene->items[i].receives) return true;
    return false;
}

static bool is_receiver(const struct planar *f, uint32_t item) {
    return f->pose->scene->items[item].plane == f->view->plane &&
           gn_shadow_item_receives(f->pose, item, f->view);
}

/* place: of the light, or the direction towards it. */
static void set_aim(const struct gn_shadow_view *view, const vec3 place, struct aim *aim) {
    vec4 *plane_from_world = (vec4 *)view->raster.tiles[0].light_from_world;
    vec4 plane;
    for (int c = 0; c < 4; c++) plane[c] = plane_from_world[c][2];
    glm_vec4((float *)place, view->perspective ? 1.0f : 0.0f, aim->light);
    if (!view->perspective)
        glm_vec4_scale(aim->light, 1.0f / glm_vec4_dot(plane, aim->light), aim->light);
    aim->light_m = glm_vec4_dot(plane, aim->light);
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            aim->fallen_from_world[c][r] =
                (c == r ? aim->light_m : 0.0f) - aim->light[r] * plane[c];
    glm_mat4_mul(plane_from_world, aim->fallen_from_world, aim->shadow_from_world);
    for (int c = 0; c < 4; c++) aim->shadow_from_world[c][2] = plane[c];
}

/* The heights between which casters cast. */
static void set_heights(const struct gn_shadow_view *view, float low_m, float highest_m,
                        struct aim *aim) {
    aim->low_m = low_m;
    aim->high_m = 1.01f * highest_m + 2.0f * low_m;
    if (view->perspective)
        aim->high_m =
            aim->light_m - fmaxf(0.5f * (aim->light_m - highest_m), LIGHT_SHARE * aim->light_m);
}

/* The plane and the light's middle. False: there is no plane, or the light lies in it or shines
 * along it. */
static bool set_plane(struct planar *f) {
    struct gn_shadow_view *view = f->view;
    uint32_t item = 0;
    while (item < f->pose->scene->item_count && !is_receiver(f, item)) item++;
    if (item == f->pose->scene->item_count) return false;
    gn_pose_plane(f->pose, item, f->plane);
    vec4 light;
    glm_vec4(view->perspective ? view->light_ws : view->to_light_ws,
             view->perspective ? 1.0f : 0.0f, light);
    float height = glm_vec4_dot(f->plane, light);
    if (height < 0.0f) glm_vec4_negate(f->plane);
    height = fabsf(height);
    if (height < (view->perspective ? 4e-6f * gn_scene_reach_m(f->pose) : 1e-3f)) return false;

    /* axes in the plane, right-handed with its normal: seen from the light, front faces keep their
     * winding */
    vec3 x, y, up = {0.0f, 1.0f, 0.0f}, across = {0.0f, 0.0f, -1.0f};
    glm_vec3_crossn(fabsf(f->plane[1]) > 0.99f ? across : up, f->plane, x);
    glm_vec3_cross(f->plane, x, y);
    vec4 *plane_from_world = view->raster.tiles[0].light_from_world;
    for (int c = 0; c < 4; c++) {
        vec4 column = {c < 3 ? x[c] : 0.0f, c < 3 ? y[c] : 0.0f, f->plane[c], c == 3};
        glm_vec4_copy(column, plane_from_world[c]);
    }
    set_aim(view, light, &f->aim);
    return true;
}

/* ---- the lamp ---- */

/* A ball over the plane, or a disk of directions. */
static void set_axes(struct planar *f, float radius) {
    struct gn_shadow_view *view = f->view;
    float(*axes)[3] = view->lamp.axes;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) axes[k][c] = view->raster.tiles[0].light_from_world[c][k];
    if (!view->perspective) {
        glm_vec3_crossn(fabsf(glm_vec3_dot(axes[0], view->to_light_ws)) > 0.9f ? axes[1] : axes[0],
                        view->to_light_ws, axes[1]);
        glm_vec3_cross(axes[1], view->to_light_ws, axes[0]);
    }
    for (int k = 0; k < 3; k++)
        glm_vec3_scale(axes[k], k == 2 && !view->perspective ? 0.0f : radius, axes[k]);
}

/* The light at a place of the lamp, in units of its axes. What reaches down to the plane, or below
 * it, is taken from just over it. */
static void aim_from(const struct gn_shadow_view *view, const float at[3], struct aim *aim) {
    vec4 *plane_from_world = (vec4 *)view->raster.tiles[0].light_from_world;
    const float *middle = view->perspective ? view->light_ws : view->to_light_ws;
    vec3 place, normal;
    float heights[2]; /* of the middle, of the place */
    glm_vec3_copy((float *)middle, place);
    for (int k = 0; k < 3; k++) {
        glm_vec3_muladds((float *)view->lamp.axes[k], at[k], place);
        normal[k] = plane_from_world[k][2];
    }
    const float plane_m = view->perspective ? plane_from_world[3][2] : 0.0f;
    heights[0] = glm_vec3_dot(normal, (float *)middle) + plane_m;
    heights[1] = glm_vec3_dot(normal, place) + plane_m;
    glm_vec3_muladds(normal, fmaxf(heights[0] / 16.0f - heights[1], 0.0f), place);
    set_aim(view, place, aim);
    set_heights(view, view->lamp.low_m, view->lamp.highest_m, aim);
}

/* Half of the widest penumbra, nearly. */
static float penumbra_of(const struct planar *f, float radius) {
    const float *to = f->view->to_light_ws;
    const float cosine =
        f->view->perspective ? 1.0f : fabsf(glm_vec3_dot((float *)f->plane, (float *)to));
    const float room =
        f->view->perspective ? f->aim.light_m - fminf(f->highest_m, f->aim.high_m) : 1.0f;
    return radius * f->highest_m / (room * cosine * cosine);
}

static void set_lamp(struct planar *f, float radius) {
    struct gn_shadow_view *view = f->view;
    f->aims[0] = f->aim;
    f->aim_count = 1;
    if (view->encoding != GN_ENCODING_MEAN || radius <= 0.0f) return;
    view->lamp.low_m = f->low_m;
    view->lamp.highest_m = f->highest_m;
    set_axes(f, radius);
    f->aim_count = view->perspective ? CORNERS : CORNERS / 2;
    for (int i = 0; i < f->aim_count; i++)
        aim_from(view, (float[3]){i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f},
                 &f->aims[i]);
}

/* ---- casters and receivers ---- */

static bool is_caster(const struct planar *f, uint32_t item) {
    return f->pose->items[item].visible && f->pose->scene->items[item].plane != f->view->plane &&
           gn_shadow_item_casts(f->pose->scene, item);
}

/* Where the shadow of an item falls; empty if it has none. */
static struct gn_shadow_region shadow_of(const struct planar *f, uint32_t item) {
    struct gn_shadow_region r = nothing;
    vec3 corners[8];
    const struct gn_box *box = &f->pose->items[item].box_ws;
    const float lowest = gn_box_least(f->plane, box), highest = gn_box_most(f->plane, box);
    gn_box_corners(&f->pose->items[item].box, f->pose->items[item].world_from_item, corners);
    for (const struct aim *aim = f->aims; aim < f->aims + f->aim_count; aim++) {
        vec4 *shadow_from_world = (vec4 *)aim->shadow_from_world;
        if (highest <= aim->low_m || lowest >= aim->high_m) continue;
        if (lowest >= aim->low_m && highest <= aim->high_m) {
            for (int i = 0; i < 8; i++) add_point(&r, shadow_from_world, corners[i]);
            continue;
        }
        vec4 slab[2];
        for (int k = 0; k < 4; k++) {
            slab[0][k] = f->plane[k] - (k == 3 ? aim->low_m : 0.0f);
            slab[1][k] = -f->plane[k] + (k == 3 ? aim->high_m : 0.0f);
        }
        add_body(&r, shadow_from_world, corners, slab, 2);
    }
    return r;
}

/* The part of the plane where a shadow can be seen. */
static struct gn_shadow_region receivers_of(const struct planar *f, const struct gn_light *light) {
    struct gn_shadow_region r = nothing, in_range = nothing;
    vec4 *plane_from_world = f->view->raster.tiles[0].light_from_world;

    /* it lies within the eye's planes, and within a pyramid round a spot light's cone (left, right,
     * bottom, top; near and far are not used) */
    vec4 planes[12];
    int count = f->view->whole ? 0 : 6;
    memcpy(planes, f->eye->planes, (size_t)count * sizeof *planes);
    if (gn_light_types[light->type].has_cone) {
        mat4 look, lens;
        gn_shadow_look(f->view, look);
        glm_perspective(2.0f * fminf(light->outer_rad, CONE_MAX_RAD), 1.0f, 1e-3f * f->scene_size_m,
                        f->scene_size_m, lens);
        glm_mat4_mul(lens, look, look);
        glm_frustum_planes(look, planes + count);
        count += 4;
    }
    for (uint32_t i = 0; i < f->pose->scene->item_count; i++) {
        if (!is_receiver(f, i)) continue;
        const struct gn_geometry *g = geometry_of(f, i);
        if (g->index_count > 3 * GN_EXACT_TRIANGLES) {
            vec3 corners[8];
            gn_box_corners(&f->pose->items[i].box, f->pose->items[i].world_from_item, corners);
            add_body(&r, plane_from_world, corners, planes, count);
            continue;
        }
        for (uint32_t k = 0; k < g->index_count; k += 3) {
            struct gn_polygon triangle;
            gn_item_triangle(f->pose, i, k, &triangle);
            add_polygon(&r, plane_from_world, &triangle, planes, count);
        }
    }
    if (light->range_m <= 0.0f || !f->view->perspective) return r;
    vec3 foot; /* the light's foot on the plane, the centre of its range there */
    glm_mat4_mulv3(plane_from_world, f->view->light_ws, 1.0f, foot);
    float radius = sqrtf(fmaxf(light->range_m * light->range_m - foot[2] * foot[2], 0.0f));
    for (int k = 0; k < 2; k++) {
        in_range.min[k] = foot[k] - radius;
        in_range.max[k] = foot[k] + radius;
    }
    return intersect(&r, &in_range);
}

static void add_held(const struct planar *f, struct gn_shadow_region *window) {
    const struct gn_shadow_square *s = &f->view->square;
    for (int i = 0; i < 4; i++) {
        const float x = s->middle[0] + (i & 1 ? s->held_m : -s->held_m),
                    z = s->middle[1] + (i & 2 ? s->held_m : -s->held_m);
        add_point(window, f->view->raster.tiles[0].light_from_world, (vec3){x, 0, z});
    }
}

/* ---- the view ---- */

/* Clip z is linear in the height over the plane: -w where casters end, w where they begin. */
static void clip_from(const struct gn_shadow_view *view, const struct aim *aim,
                      const float corner[2], mat4 clip_from_world) {
    const vec4 *m = aim->shadow_from_world;
    const float side = view->lookup.texel * (float)view->map.tile_px;
    const float w_low = view->perspective ? aim->light_m - aim->low_m : 1.0f;
    const float w_high = view->perspective ? aim->light_m - aim->high_m : 1.0f;
    const float slope = -(w_high + w_low) / (aim->high_m - aim->low_m);
    const float at_0 = w_low - slope * aim->low_m;
    for (int c = 0; c < 4; c++) {
        for (int k = 0; k < 2; k++)
            clip_from_world[c][k] =
                (2.0f * (m[c][k] - corner[k] * m[c][3]) - side * m[c][3]) / side;
        clip_from_world[c][2] = slope * m[c][2] + (c == 3 ? at_0 : 0.0f);
        clip_from_world[c][3] = m[c][3];
    }
}

static void set_lookup(struct gn_shadow_view *view, const float corner[2]) {
    const float side = view->lookup.texel * (float)view->map.tile_px;
    for (int c = 0; c < 4; c++) {
        for (int k = 0; k < 2; k++)
            view->lookup.map_from_world[c][k] =
                (view->raster.tiles[0].light_from_world[c][k] - (c == 3 ? corner[k] : 0.0f)) / side;
        view->lookup.map_from_world[c][2] = 0.0f;
        view->lookup.map_from_world[c][3] = c == 3 ? 1.0f : 0.0f;
    }
}

void gn_planar_point(const struct gn_shadow_view *view, uint32_t index, mat4 clip_from_world) {
    float at[3];
    struct aim aim;
    if (view->lamp.count <= 1) {
        glm_mat4_copy((vec4 *)view->raster.tiles[0].clip_from_world, clip_from_world);
        return;
    }
    gn_lamp_point(index, view->lamp.count, at);
    aim_from(view, at, &aim);
    clip_from(view, &aim, view->lamp.corner, clip_from_world);
}

void gn_planar_footprint(const struct gn_shadow_view *view, mat4 clip_from_world) {
    vec4 *plane_from_world = (vec4 *)view->raster.tiles[0].light_from_world;
    const float thick_m = fmaxf(view->lamp.low_m, FOOT_TEXELS * view->lookup.texel);
    vec3 up;
    struct aim aim;
    for (int k = 0; k < 3; k++) up[k] = plane_from_world[k][2];
    set_aim(view, up, &aim);
    aim.low_m = -thick_m;
    aim.high_m = thick_m;
    clip_from(view, &aim, view->lamp.corner, clip_from_world);
}

/* The mask's content is decided by the lamp, too. */
static uint64_t hash_lamp(const struct gn_shadow_view *view, uint64_t hash) {
    const struct gn_shadow_lamp *lamp = &view->lamp;
    if (lamp->count == 0) return hash;
    hash = gn_hash(hash, &lamp->count, sizeof lamp->count);
    hash = gn_hash(hash, lamp->axes, sizeof lamp->axes);
    hash = gn_hash(hash, &lamp->highest_m, sizeof lamp->highest_m);
    return hash ? hash : 1;
}

/* The stencil is drawn from the eye, with casters projected onto the plane. The rasteriser cannot
 * cut at the two heights here, since w also grows with the distance from the eye: the shader gets
 * them. */
static bool set_stencil(struct planar *f, const struct gn_shadow_region *window) {
    /* the window's bounds on the screen */
    struct gn_shadow_region screen = nothing;
    struct gn_polygon quad = {.count = 4};
    mat4 world_from_plane;
    glm_mat4_inv(f->view->raster.tiles[0].light_from_world, world_from_plane);
    for (int i = 0; i < 4; i++) {
        vec3 corner = {i == 1 || i == 2 ? window->max[0] : window->min[0],
                       i >= 2 ? window->max[1] : window->min[1], 0.0f};
        glm_mat4_mulv3(world_from_plane, corner, 1.0f, quad.at[i]);
    }
    add_polygon(&screen, (vec4 *)f->eye->clip_from_world, &quad, (vec4 *)f->eye->planes, 6);
    if (region_is_empty(&screen)) return false;

    glm_mat4_copy(f->aim.fallen_from_world, f->view->raster.tiles[0].clip_from_world);
    f->view->code.near_m = f->aim.low_m;
    f->view->code.far_m = f->aim.high_m;
    for (int k = 0; k < 2; k++) {
        f->view->raster.screen_ndc[0][k] = screen.min[k];
        f->view->raster.screen_ndc[1][k] = screen.max[k];
    }
    return true;
}

bool gn_planar_fit(const struct gn_fitter *fitter, uint32_t points) {
    const struct gn_pose *pose = fitter->pose;
    const struct gn_shadow_memory *memory = fitter->memory;
    struct gn_shadow_view *view = fitter->view;
    struct planar f = {
        .pose = pose, .eye = fitter->eye, .view = view, .scene_size_m = fitter->scene_size_m};
    view->code.scale = view->code.far_end = view->code.far_m = 1.0f;
    if (!set_plane(&f)) return false;

    /* the heights between which casters cast */
    for (uint32_t i = 0; i < pose->scene->item_count; i++)
        if (is_caster(&f, i))
            f.highest_m = fmaxf(f.highest_m, gn_box_most(f.plane, &pose->items[i].box_ws));
    f.low_m = HAIR * f.highest_m + 1e-6f * gn_scene_reach_m(pose);
    set_heights(view, f.low_m, f.highest_m, &f.aim);
    if (f.aim.high_m <= f.low_m) return false;
    const float radius = fitter->light_radius;
    set_lamp(&f, radius);

    /* the window: the part of the plane that is both seen and reached by shadows */
    struct gn_shadow_region window = nothing;
    const struct gn_shadow_region receivers = receivers_of(&f, &pose->lights[view->light]);
    memset(memory->casts, 0, pose->scene->item_count);
    if (region_is_empty(&receivers)) return false;
    for (uint32_t i = 0; i < pose->scene->item_count; i++) {
        if (!is_caster(&f, i)) continue;
        const struct gn_shadow_region shadow = shadow_of(&f, i);
        if (region_is_empty(&shadow) || !regions_meet(&shadow, &receivers)) continue;
        memory->casts[i] = 1;
        unite(&window, &shadow);
    }
    if (view->square.held_m > 0.0f) add_held(&f, &window);
    window = intersect(&window, &receivers);
    if (region_is_empty(&window)) return false;
    if (view->encoding == GN_ENCODING_STENCIL) return set_stencil(&f, &window);

    /* the mask: its window on whole texels, and its matrices */
    double low[2];
    gn_shadow_snap(view, window.min, window.max, 1e-6f * f.scene_size_m, low);
    const float corner[2] = {(float)low[0], (float)low[1]};
    clip_from(view, &f.aim, corner, view->raster.tiles[0].clip_from_world);
    set_lookup(view, corner);
    const float side = view->lookup.texel * (float)view->map.tile_px;
    for (int k = 0; k < 2; k++) {
        view->floor.shown[0][k] = (window.min[k] - corner[k] - 2 * view->lookup.texel) / side;
        view->floor.shown[1][k] = (window.max[k] - corner[k] + 2 * view->lookup.texel) / side;
    }
    if (view->encoding == GN_ENCODING_MEAN) {
        const bool is_sharp = 2.0f * penumbra_of(&f, radius) < LEAST_TEXELS * view->lookup.texel;
        memcpy(view->lamp.corner, corner, sizeof corner);
        view->lamp.count = is_sharp ? 1 : points;
        view->lamp.bytes = view->technique == GN_TECHNIQUE_FLOOR ? 128 : 256;
        view->code.scale = 0.0f; /* casters write the weight of a point */
        view->code.offset = fminf((float)view->lamp.bytes / 255.0f / (float)view->lamp.count, 1.0f);
    }
    view->raster.tiles[0].content_hash =
        hash_lamp(view, gn_shadow_hash(pose, view, view->raster.tiles, memory->casts));
    return true;
}
