#include "truth/occlusion.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "scene/poses.h"

#define LEAST_SKY  .125f   /* of the mean: harmonics of a bright spot are negative opposite to it */
#define LEAST_DOWN (-1e-6) /* a ray that falls less does not reach the floor */
#define TOUCHING   2e-3    /* nearer faces are one: of the root of twice the smaller one's area, */
#define PARALLEL   .99     /* when the cosine between them is at least this */

static double radiance(const struct gn_sky *sky, const double d[3]) {
    const float *c = sky->radiance;
    if (!(c[0] > 0)) return 1;
    const float x = sky->turn[0] * (float)d[0] - sky->turn[1] * (float)d[2], y = (float)d[1],
                z = sky->turn[1] * (float)d[0] + sky->turn[0] * (float)d[2];
    const float sum = c[0] + c[1] * y + c[2] * z + c[3] * x + c[4] * x * y + c[5] * y * z +
                      c[6] * (3 * z * z - 1) + c[7] * x * z + c[8] * (x * x - y * y);
    return (double)fmaxf(sum, LEAST_SKY * c[0]);
}

static void find_floor(struct gn_occlusion *o, const struct gn_scene *scene) {
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_material *m = &scene->materials[scene->items[i].material];
        const int32_t texture = m->textures[GN_TEXTURE_OCCLUSION].texture;
        if (!m->shadow_catcher || texture < 0) continue;
        vec4 *place = o->pose.items[i].world_from_item;
        o->floor = &scene->pictures.images[scene->pictures.textures[texture].image];
        o->floor_m = (double)place[3][1];
        o->floor_side_m = (double)(place[0][0] * GN_FLOOR_OCCLUDED);
        for (int k = 0; k < 2; k++)
            o->floor_corner_m[k] = (double)place[3][2 * k] - o->floor_side_m / 2;
    }
}

void gn_occlusion_init(struct gn_occlusion *o, const struct gn_scene *scene,
                       const struct gn_moment *at, const struct gn_sky *sky,
                       const atomic_bool *cancel) {
    struct gn_poses_place *places = gn_xalloc(scene->item_count, sizeof *places);
    *o = (struct gn_occlusion){.sky = *sky};
    gn_pose_init(&o->pose, scene, at ? at->clips : GN_POSE_NONE);
    gn_poses_occlusion(&o->pose, places);
    if (at && at->over >= 0) gn_pose_choose_over(&o->pose, at->clips, at->over);
    if (at) o->pose.at.run = at->run;
    if (at) o->pose.at.begun_ns = at->begun_ns;
    gn_pose_step(&o->pose, at ? at->time_ns : 0);
    find_floor(o, scene);
    o->leaves = gn_xalloc(scene->item_count, sizeof *o->leaves);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        bool *visible = &o->pose.items[i].visible;
        o->leaves[i] = *visible && scene->items[i].stays && !places[i].stays;
        *visible &= places[i].stays;
    }
    free(places);
    gn_raycast_init(&o->rays, scene, &o->pose, cancel);
}

void gn_occlusion_finish(struct gn_occlusion *o) {
    gn_raycast_finish(&o->rays);
    gn_pose_finish(&o->pose);
    free(o->leaves);
    *o = (struct gn_occlusion){.floor = NULL};
}

/* Share of light that comes along a ray on which nothing is. */
static double open_share(const struct gn_occlusion *o, const struct gn_ray *ray) {
    const double *d = ray->direction;
    if (!o->floor || d[1] >= LEAST_DOWN) return 1;
    const double t = (o->floor_m - ray->origin[1]) / d[1];
    if (t < 0) return 0;
    size_t texel[2];
    const double px[2] = {o->floor->width_px, o->floor->height_px};
    for (int k = 0; k < 2; k++) {
        const double at =
            (ray->origin[2 * k] + t * d[2 * k] - o->floor_corner_m[k]) / o->floor_side_m * px[k];
        if (!(at >= 0 && at < px[k])) return 1;
        texel[k] = (size_t)at;
    }
    return o->floor->rgba[4 * (texel[1] * o->floor->width_px + texel[0])] / 255.0;
}

/* Point i of the first two dimensions of Sobol's sequence, shifted: Sobol 1967. */
static void sobol_point(uint32_t i, const float shift[2], double out[2]) {
    uint32_t bits[2] = {0, 0};
    for (uint32_t n = i, a = 1u << 31, b = 1u << 31; n; n >>= 1, a >>= 1, b ^= b >> 1)
        if (n & 1) {
            bits[0] ^= a;
            bits[1] ^= b;
        }
    for (int k = 0; k < 2; k++) {
        const double at = bits[k] * 0x1p-32 + 0x1p-33 + (double)shift[k];
        out[k] = at - floor(at);
    }
}

struct looking {
    const struct gn_occlusion *from;
    const struct gn_occlusion_site *site;
};

static bool is_touching(const struct gn_occlusion_site *site, const struct gn_bvh_triangle *face) {
    double a[3], b[3], up[3], along = 0, facing = 0;
    for (int k = 0; k < 3; k++) {
        a[k] = face->p[1][k] - face->p[0][k];
        b[k] = face->p[2][k] - face->p[0][k];
    }
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        up[k] = a[l] * b[m] - a[m] * b[l];
        along += up[k] * (face->p[0][k] - site->point_ws[k]);
        facing += up[k] * (double)site->face_ws[k];
    }
    const double twice_m2 = sqrt(up[0] * up[0] + up[1] * up[1] + up[2] * up[2]);
    const double side_m = fmin(sqrt(twice_m2), (double)site->side_m);
    return fabs(facing) > PARALLEL * twice_m2 && fabs(along) < TOUCHING * side_m * twice_m2;
}

static bool is_in_the_way(const void *context, const struct gn_bvh_triangle *face,
                          const struct gn_bvh_hit *hit) {
    const struct looking *looking = context;
    return gn_raycast_blocks(&looking->from->rays, face, hit) && !is_touching(looking->site, face);
}

double gn_occlusion_cast(const struct gn_occlusion *o, const struct gn_occlusion_site *site,
                         uint32_t first, uint32_t last, double *whole) {
    vec3 n, side, up;
    glm_vec3_copy((float *)site->normal_ws, n);
    glm_vec3_ortho(n, side);
    glm_vec3_normalize(side);
    glm_vec3_cross(n, side, up);
    struct gn_ray ray = {.t_min = 0, .t_max = INFINITY};
    const double face[3] = {site->face_ws[0], site->face_ws[1], site->face_ws[2]},
                 lift_m = gn_raycast_lift_m(&o->rays, site->point_ws, face);
    for (int k = 0; k < 3; k++) ray.origin[k] = site->point_ws[k] + lift_m * face[k];
    const struct looking looking = {o, site};
    double light = 0;
    for (uint32_t i = first; i < last; i++) {
        double at[2], facing = 0;
        sobol_point(i, site->turn, at);
        const double radius = sqrt(at[0]), turn = 2 * M_PI * at[1];
        const double x = radius * cos(turn), y = radius * sin(turn), z = sqrt(1 - at[0]);
        for (int k = 0; k < 3; k++) {
            ray.direction[k] = x * (double)side[k] + y * (double)up[k] + z * (double)n[k];
            facing += ray.direction[k] * (double)site->face_ws[k];
        }
        if (!(facing > 0)) continue;
        const double arrives = radiance(&o->sky, ray.direction);
        struct gn_bvh_hit hit;
        *whole += arrives;
        if (!gn_bvh_hit(&o->rays.bvh, &ray, true, is_in_the_way, &looking, &hit))
            light += arrives * open_share(o, &ray);
    }
    return light;
}

void gn_occlusion_site_of(const struct gn_pose *pose, const struct gn_ray_surface *surface,
                          struct gn_occlusion_site *site) {
    const double share[3] = {1 - surface->u - surface->v, surface->u, surface->v};
    double sum[3] = {0}, p[3][3];
    vec3 a, b, up;
    for (int i = 0; i < 3; i++) {
        const uint32_t vertex = pose->scene->buffers.indices[surface->index + (uint32_t)i];
        double n[3] = {0};
        gn_pose_vertex(pose, surface->item, vertex, p[i], n);
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3 && length > 0; k++) sum[k] += share[i] * n[k] / length;
    }
    for (int k = 0; k < 3; k++) {
        site->point_ws[k] = surface->point_ws[k];
        site->face_ws[k] = (float)surface->normal_ws[k];
        site->normal_ws[k] = (float)sum[k];
        a[k] = (float)(p[1][k] - p[0][k]);
        b[k] = (float)(p[2][k] - p[0][k]);
    }
    glm_vec3_cross(a, b, up);
    site->side_m = sqrtf(glm_vec3_norm(up));
    gn_unit(site->normal_ws);
    if (glm_vec3_norm2(site->normal_ws) < .5f) glm_vec3_copy(site->face_ws, site->normal_ws);
    if (glm_vec3_dot(site->normal_ws, site->face_ws) < 0) glm_vec3_negate(site->normal_ws);
}
