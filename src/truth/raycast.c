#include "truth/raycast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

enum { BLOCKERS_MAX = 24, SPIRAL_MAX = 1024 };
enum { SEEN = 1, SEEN_FROM_BEHIND = 2, CASTS = 4, MASKED = 8, MIRRORED = 16 };

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void normalise(double v[3]) {
    double length = sqrt(dot(v, v));
    if (length > 0)
        for (int k = 0; k < 3; k++) v[k] /= length;
}

/* --- the scene as triangles --- */

static uint32_t item_flags(const struct gn_scene *scene, const struct gn_item *item,
                           bool mirrored) {
    const struct gn_material *material = &scene->materials[item->material];
    if (gn_material_is_blended(material) && !material->shadow_catcher) return 0;
    return SEEN | (material->double_sided ? SEEN_FROM_BEHIND : 0) | (item->casts ? CASTS : 0) |
           (material->alpha == GN_ALPHA_MASK ? MASKED : 0) | (mirrored ? MIRRORED : 0);
}

static void place(const mat4 world_from_item, const float p[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = (double)world_from_item[0][k] * p[0] + (double)world_from_item[1][k] * p[1] +
                 (double)world_from_item[2][k] * p[2] + (double)world_from_item[3][k];
}

/* Of a Vogel spiral, the direction to point i. */
static void spiral_at(int i, double out[2]) {
    const double angle = i * M_PI * (3 - sqrt(5)); /* the golden angle */
    out[0] = cos(angle);
    out[1] = sin(angle);
}

static void copy_materials(struct gn_raycast *rays, const struct gn_pose *pose) {
    const struct gn_scene *scene = rays->scene;
    if (pose->materials == scene->materials) return;
    rays->own = gn_xalloc(scene->material_count, sizeof *rays->own);
    memcpy(rays->own, pose->materials, scene->material_count * sizeof *rays->own);
    rays->materials = rays->own;
}

void gn_raycast_init(struct gn_raycast *rays, const struct gn_scene *scene,
                     const struct gn_pose *pose, const atomic_bool *cancel) {
    uint64_t room = 0;
    for (uint32_t i = 0; i < scene->item_count; i++)
        room += scene->geometries[scene->items[i].geometry].index_count / 3;
    struct gn_bvh_triangle *triangles = gn_xalloc(room ? room : 1, sizeof *triangles);
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_pose_item *posed = &pose->items[i];
        const struct gn_geometry *geometry = &scene->geometries[scene->items[i].geometry];
        uint32_t flags = item_flags(scene, &scene->items[i], posed->mirrored);
        if (!posed->visible || !flags) continue;
        for (uint32_t k = 0; k + 2 < geometry->index_count; k += 3) {
            struct gn_bvh_triangle *t = &triangles[count++];
            *t = (struct gn_bvh_triangle){
                .item = i, .index = geometry->first_index + k, .flags = flags};
            for (int c = 0; c < 3; c++) {
                const uint32_t vertex = scene->buffers.indices[t->index + c];
                if (gn_item_is_deformed(&scene->items[i]))
                    gn_pose_vertex(pose, i, vertex, t->p[c], NULL);
                else
                    place(posed->world_from_item, &scene->buffers.positions[3 * (size_t)vertex],
                          t->p[c]);
            }
        }
    }
    *rays = (struct gn_raycast){.scene = scene, .materials = scene->materials};
    copy_materials(rays, pose);
    gn_bvh_build(&rays->bvh, triangles, count, cancel);
    rays->spiral = gn_xalloc(SPIRAL_MAX, sizeof *rays->spiral);
    for (int i = 0; i < SPIRAL_MAX; i++) spiral_at(i, rays->spiral[i]);
}

void gn_raycast_finish(struct gn_raycast *rays) {
    gn_bvh_finish(&rays->bvh);
    free(rays->spiral);
    free(rays->own);
    *rays = (struct gn_raycast){0};
}

uint64_t gn_raycast_bytes(const struct gn_scene *scene) {
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < scene->item_count; i++)
        bytes += gn_bvh_bytes(scene->geometries[scene->items[i].geometry].index_count / 3);
    return bytes;
}

bool gn_raycast_casts(const struct gn_bvh_triangle *triangle) { return triangle->flags & CASTS; }

/* --- holes --- */

static uint32_t wrap(int64_t i, uint32_t size, enum gn_wrap how) {
    int64_t n = size;
    if (how == GN_WRAP_CLAMP) return (uint32_t)(i < 0 ? 0 : i >= n ? n - 1 : i);
    int64_t period = how == GN_WRAP_MIRROR ? 2 * n : n;
    int64_t m = ((i % period) + period) % period;
    return (uint32_t)(m < n ? m : period - 1 - m);
}

static double texel_alpha(const struct gn_scene *scene, const struct gn_texture *texture, int64_t x,
                          int64_t y) {
    const struct gn_image *image = &scene->pictures.images[texture->image];
    size_t column = wrap(x, image->width_px, texture->wrap_s);
    size_t row = wrap(y, image->height_px, texture->wrap_t);
    const uint8_t *texels = image->levels ? image->levels : image->rgba;
    return gn_packing_alpha(image->packing, texels, image->width_px, (uint32_t)column,
                            (uint32_t)row) /
           255.0;
}

double gn_ray_sample_alpha(const struct gn_scene *scene, const struct gn_texture *texture, double u,
                           double v) {
    const struct gn_image *image = &scene->pictures.images[texture->image];
    double x = u * image->width_px, y = v * image->height_px;
    if (!(fabs(x) < 1e15 && fabs(y) < 1e15)) return 1;
    if (texture->mag_nearest)
        return texel_alpha(scene, texture, (int64_t)floor(x), (int64_t)floor(y));
    int64_t i = (int64_t)floor(x - .5), j = (int64_t)floor(y - .5);
    double s = x - .5 - (double)i, t = y - .5 - (double)j;
    return (1 - t) * ((1 - s) * texel_alpha(scene, texture, i, j) +
                      s * texel_alpha(scene, texture, i + 1, j)) +
           t * ((1 - s) * texel_alpha(scene, texture, i, j + 1) +
                s * texel_alpha(scene, texture, i + 1, j + 1));
}

static double alpha_at(const struct gn_raycast *rays, const struct gn_bvh_triangle *t,
                       const struct gn_bvh_hit *hit) {
    const struct gn_scene *scene = rays->scene;
    const struct gn_item *item = &scene->items[t->item];
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    const struct gn_material *material = &rays->materials[item->material];
    const struct gn_texture_ref *ref = &material->textures[GN_TEXTURE_BASE];
    const double weight[3] = {1 - hit->u - hit->v, hit->u, hit->v};
    const uint32_t *corner = &scene->buffers.indices[t->index];
    double alpha = material->base_color[3];
    if (gn_geometry_has(geometry, GN_ATTRIBUTE_COLOR) && scene->buffers.colors) {
        double sum = 0;
        for (int c = 0; c < 3; c++)
            sum += weight[c] * scene->buffers.colors[4 * (size_t)corner[c] + 3];
        alpha *= sum / 255;
    }
    if (ref->texture < 0) return alpha;
    const float *set = ref->uv_set ? scene->buffers.uv1 : scene->buffers.uv0;
    double u = 0, v = 0;
    for (int c = 0; set && c < 3; c++) {
        u += weight[c] * set[2 * (size_t)corner[c]];
        v += weight[c] * set[2 * (size_t)corner[c] + 1];
    }
    const float *m = ref->uv_from_uv;
    return alpha * gn_ray_sample_alpha(scene, &scene->pictures.textures[ref->texture],
                                       m[0] * u + m[2] * v + m[4], m[1] * u + m[3] * v + m[5]);
}

static bool is_hole(const struct gn_raycast *rays, const struct gn_bvh_triangle *t,
                    const struct gn_bvh_hit *hit) {
    return (t->flags & MASKED) &&
           alpha_at(rays, t, hit) <
               gn_material_least_alpha(&rays->materials[rays->scene->items[t->item].material]);
}

/* --- the eye --- */

void gn_ray_eye_look(struct gn_ray_eye *eye, const struct gn_framing *framing, int width_px,
                     int height_px) {
    const struct gn_camera *camera = &framing->camera;
    *eye = (struct gn_ray_eye){.orthographic = camera->orthographic,
                               .width_px = width_px,
                               .height_px = height_px,
                               .near_m = camera->near_m,
                               .far_m = camera->far_m > 0 ? camera->far_m : INFINITY};
    for (int k = 0; k < 3; k++) { /* rows of a rigid matrix are the axes */
        eye->position_ws[k] = framing->eye_ws[k];
        eye->right[k] = framing->view_from_world[k][0];
        eye->up[k] = framing->view_from_world[k][1];
        eye->forward[k] = -framing->view_from_world[k][2];
    }
    eye->half_height = camera->orthographic ? camera->ymag_m : tan(camera->yfov_rad / 2);
    eye->half_width = eye->half_height * width_px / height_px;
}

void gn_ray_eye_init(struct gn_ray_eye *eye, const struct gn_pose *pose, uint32_t camera,
                     int width_px, int height_px) {
    const struct gn_framing_opts opts = {.aspect = (float)width_px / (float)height_px};
    struct gn_framing framing;
    gn_framing_build(pose, camera, &opts, &framing);
    gn_ray_eye_look(eye, &framing, width_px, height_px);
}

double gn_ray_eye_pixel_m(const struct gn_ray_eye *eye, const double point_ws[3]) {
    double pixel = 2 * eye->half_height / eye->height_px;
    if (eye->orthographic) return pixel;
    double v[3];
    for (int k = 0; k < 3; k++) v[k] = point_ws[k] - eye->position_ws[k];
    return pixel * fabs(dot(v, eye->forward));
}

static bool seen_by_eye(const void *context, const struct gn_bvh_triangle *t,
                        const struct gn_bvh_hit *hit) {
    const struct gn_raycast *rays = context;
    if (!(t->flags & SEEN)) return false;
    bool front = (hit->facing > 0) != ((t->flags & MIRRORED) != 0);
    if (!front && !(t->flags & SEEN_FROM_BEHIND)) return false;
    return !is_hole(rays, t, hit);
}

bool gn_raycast_eye(const struct gn_raycast *rays, const struct gn_ray_eye *eye, int x, int y,
                    struct gn_ray_surface *surface) {
    double sx = ((x + .5) / eye->width_px * 2 - 1) * eye->half_width;
    double sy = (1 - (y + .5) / eye->height_px * 2) * eye->half_height;
    struct gn_ray ray = {.t_min = eye->near_m, .t_max = eye->far_m}; /* t is depth along forward */
    for (int k = 0; k < 3; k++) {
        double aside = sx * eye->right[k] + sy * eye->up[k];
        ray.origin[k] = eye->position_ws[k] + (eye->orthographic ? aside : 0);
        ray.direction[k] = eye->forward[k] + (eye->orthographic ? 0 : aside);
    }
    struct gn_bvh_hit hit;
    if (!gn_bvh_hit(&rays->bvh, &ray, false, seen_by_eye, rays, &hit)) return false;

    const struct gn_bvh_triangle *t = &rays->bvh.triangles[hit.triangle];
    double a[3], b[3], away[3];
    *surface = (struct gn_ray_surface){.item = t->item, .index = t->index, .u = hit.u, .v = hit.v};
    for (int k = 0; k < 3; k++) {
        surface->point_ws[k] = ray.origin[k] + hit.t * ray.direction[k];
        away[k] = surface->point_ws[k] - eye->position_ws[k];
        a[k] = t->p[1][k] - t->p[0][k];
        b[k] = t->p[2][k] - t->p[0][k];
    }
    surface->distance_m = sqrt(dot(away, away));
    cross(a, b, surface->normal_ws);
    normalise(surface->normal_ws);
    if (dot(surface->normal_ws, ray.direction) > 0)
        for (int k = 0; k < 3; k++) surface->normal_ws[k] = -surface->normal_ws[k];
    return true;
}

/* --- lights --- */

void gn_ray_lamp_init(struct gn_ray_lamp *lamp, const struct gn_pose *pose, uint32_t light) {
    const struct gn_light *l = &pose->lights[light];
    vec3 position, direction;
    gn_pose_light(pose, light, position, direction);
    *lamp = (struct gn_ray_lamp){.type = l->type,
                                 .range_m = l->range_m > 0 ? l->range_m : INFINITY,
                                 .cos_cone = cos(fmin(l->outer_rad, 80 * M_PI / 180)),
                                 .radius = l->radius};
    for (int k = 0; k < 3; k++) {
        lamp->position_ws[k] = position[k];
        lamp->direction_ws[k] = direction[k];
    }
    normalise(lamp->direction_ws);
}

/* The vector from the surface to the lamp's middle; its length is the distance, or 1 for a
 * directional lamp. */
static void towards(const struct gn_ray_lamp *lamp, const struct gn_ray_surface *surface,
                    double to[3]) {
    for (int k = 0; k < 3; k++)
        to[k] = lamp->type == GN_LIGHT_DIRECTIONAL ? -lamp->direction_ws[k]
                                                   : lamp->position_ws[k] - surface->point_ws[k];
}

/* Does the lamp not shine here at all? Then nothing takes its light away. */
static bool out_of_reach(const struct gn_ray_lamp *lamp, const double to[3]) {
    if (lamp->type == GN_LIGHT_DIRECTIONAL) return false;
    double distance = sqrt(dot(to, to));
    if (distance > lamp->range_m || distance == 0) return true;
    return lamp->type == GN_LIGHT_SPOT && -dot(to, lamp->direction_ws) <= lamp->cos_cone * distance;
}

bool gn_raycast_blocks(const void *context, const struct gn_bvh_triangle *t,
                       const struct gn_bvh_hit *hit) {
    const struct gn_raycast *rays = context;
    return (t->flags & CASTS) && !is_hole(rays, t, hit);
}

double gn_raycast_lift_m(const struct gn_raycast *rays, const double point_ws[3],
                         const double normal_ws[3]) {
    double along_m = 0;
    for (int k = 0; k < 3; k++) along_m += fabs(point_ws[k] * normal_ws[k]);
    return 0x1p-22 * along_m + 0x1p-40 * rays->bvh.diagonal;
}

static bool casts_itself(const struct gn_raycast *rays, const struct gn_ray_surface *surface) {
    return surface->item == GN_RAY_NO_ITEM || rays->scene->items[surface->item].casts;
}

/* What may be in the way of many rays from one surface to one lamp. */
struct blockers {
    uint32_t at[BLOCKERS_MAX], count; /* triangles; the one that was met last is the first */
    bool complete;                    /* there is no other */
};

static bool is_blocked(const struct gn_raycast *rays, const struct gn_ray *ray,
                       struct blockers *blockers) {
    uint32_t which;
    struct gn_bvh_hit hit;
    if (gn_bvh_hit_some(&rays->bvh, ray, blockers->at, blockers->count, gn_raycast_blocks, rays,
                        &which)) {
        const uint32_t met = blockers->at[which];
        blockers->at[which] = blockers->at[0];
        blockers->at[0] = met;
        return true;
    }
    if (blockers->complete || !gn_bvh_hit(&rays->bvh, ray, true, gn_raycast_blocks, rays, &hit))
        return false;
    blockers->at[0] = hit.triangle;
    blockers->count = 1;
    return true;
}

/* Is the way along `to` free (as far as its length, or without end)? */
static bool is_free(const struct gn_raycast *rays, const struct gn_ray_surface *surface,
                    const double to[3], bool endless, struct blockers *blockers) {
    if (dot(surface->normal_ws, to) <= 0 && casts_itself(rays, surface)) return false;
    struct gn_ray ray = {.t_min = 0, .t_max = endless ? INFINITY : 1};
    const double lift_m = gn_raycast_lift_m(rays, surface->point_ws, surface->normal_ws);
    for (int k = 0; k < 3; k++) {
        double lift = lift_m * surface->normal_ws[k];
        ray.origin[k] = surface->point_ws[k] + lift;
        ray.direction[k] = to[k] - (endless ? 0 : lift);
    }
    return !is_blocked(rays, &ray, blockers);
}

int gn_raycast_visible(const struct gn_raycast *rays, const struct gn_ray_lamp *lamp,
                       const struct gn_ray_surface *surface) {
    double to[3];
    struct blockers unknown = {.count = 0};
    towards(lamp, surface, to);
    if (out_of_reach(lamp, to)) return 1;
    return is_free(rays, surface, to, lamp->type == GN_LIGHT_DIRECTIONAL, &unknown);
}

/* Looks once for what may be in the way of any ray to the lamp's disk, which u and v span. */
static void find_blockers(const struct gn_raycast *rays, const struct gn_ray_lamp *lamp,
                          const struct gn_ray_surface *surface, const double to[3],
                          const double u[3], const double v[3], struct blockers *blockers) {
    const bool endless = lamp->type == GN_LIGHT_DIRECTIONAL;
    struct gn_beam beam = {.t_max = endless ? INFINITY : 1};
    const double lift_m = gn_raycast_lift_m(rays, surface->point_ws, surface->normal_ws);
    for (int k = 0; k < 3; k++) {
        const double lift = lift_m * surface->normal_ws[k], middle = to[k] - (endless ? 0 : lift),
                     spread = 1.000001 * lamp->radius * sqrt(u[k] * u[k] + v[k] * v[k]);
        beam.origin[k] = surface->point_ws[k] + lift;
        beam.low[k] = middle - spread;
        beam.high[k] = middle + spread;
    }
    const uint32_t found = gn_bvh_gather(&rays->bvh, &beam, blockers->at, BLOCKERS_MAX);
    blockers->complete = found <= BLOCKERS_MAX;
    blockers->count = blockers->complete ? found : 0;
}

double gn_raycast_share(const struct gn_raycast *rays, const struct gn_ray_lamp *lamp,
                        const struct gn_ray_surface *surface, int samples) {
    double to[3], axis[3], u[3], v[3];
    towards(lamp, surface, to);
    if (out_of_reach(lamp, to)) return 1;
    for (int k = 0; k < 3; k++) axis[k] = to[k];
    normalise(axis);
    cross(axis, fabs(axis[1]) < .9 ? (double[3]){0, 1, 0} : (double[3]){1, 0, 0}, u);
    normalise(u);
    cross(axis, u, v);
    struct blockers blockers;
    find_blockers(rays, lamp, surface, to, u, v, &blockers);
    int free_ways = 0;
    for (int i = 0; i < samples; i++) {
        double radius = lamp->radius * sqrt((i + .5) / samples);
        double direction[2], way[3];
        if (i < SPIRAL_MAX)
            memcpy(direction, rays->spiral[i], sizeof direction);
        else
            spiral_at(i, direction);
        double a = radius * direction[0], b = radius * direction[1];
        for (int k = 0; k < 3; k++) way[k] = to[k] + a * u[k] + b * v[k];
        free_ways += is_free(rays, surface, way, lamp->type == GN_LIGHT_DIRECTIONAL, &blockers);
    }
    return (double)free_ways / samples;
}
