/* Finds the receivers of planar shadows: items marked by gnomon_plane, else the largest flat item
 * of the scene if it is large enough to be a floor or a wall, and up to three further ones on which
 * something casts a shadow. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "scene/pose.h"

/* The minimum share of the scene's box, projected along the plane's normal, that it covers. */
static const double LEAST_SHARE = .3;

/* The minimum share of the first plane's area that a further one has, which costs a pass. */
static const double FURTHER_SHARE = .2;

/* Bounds on the search: flat items by their areas, and lights. */
enum { CANDIDATES = 8, LIGHTS = 16 };

static float size_of(const struct gn_box *box) {
    return glm_vec3_distance((float *)box->min, (float *)box->max);
}

/* Whether two flat items lie in one plane: to a share of the smaller one, as a terrace of a city
 * is another plane than its ground. */
static bool lie_together(const struct gn_pose *pose, uint32_t a, uint32_t b) {
    const struct gn_box *p_box = &pose->items[a].box_ws, *q_box = &pose->items[b].box_ws;
    const float size = fminf(size_of(p_box), size_of(q_box));
    vec4 p, q;
    gn_pose_plane(pose, a, p);
    gn_pose_plane(pose, b, q);
    if (glm_vec3_dot(p, q) < 0) glm_vec4_negate(q);
    return glm_vec3_distance(p, q) < 1e-4f &&
           fabsf(p[3] - q[3]) < 1e-4f * size + 2e-6f * fabsf(p[3]);
}

/* Marked items make up planes, in the order of their items, as many as there may be. One that is
 * not visible at first lies in the first plane. */
static bool mark_named_planes(struct gn_gltf *g, const struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    bool named = false;
    uint32_t first[GN_PLANES_MAX]; /* items */
    int count = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        struct gn_item *item = &scene->items[i];
        if (g->placed[item->node].plane != GN_YES) continue;
        named = true;
        item->plane = scene->geometries[item->geometry].flat;
        if (!item->plane)
            gn_gltf_warn(g, NULL, "gnomon_plane: node '%.60s' is not flat; ignored",
                         scene->nodes[item->node].name);
        if (!item->plane || !pose->items[i].visible) continue;
        int at = 0;
        while (at < count && !lie_together(pose, first[at], i)) at++;
        item->plane = at < GN_PLANES_MAX ? (uint8_t)(at + 1) : 0;
        if (at == count && at < GN_PLANES_MAX) first[count++] = i;
        if (!item->plane)
            gn_gltf_warn(g, NULL,
                         "gnomon_plane: node '%.60s' lies in plane %d, of at most %d; ignored",
                         scene->nodes[item->node].name, at + 1, GN_PLANES_MAX);
    }
    return named;
}

/* ---- planes that are found ---- */

struct found {
    uint32_t item;
    double area_m2;
};

/* Of a flat item that may be a floor or a wall; 0: it is too small, or marked as none. */
static double area_of(const struct gn_gltf *g, const struct gn_pose *pose, uint32_t i) {
    const struct gn_item *item = &g->scene->items[i];
    const struct gn_geometry *geometry = &g->scene->geometries[item->geometry];
    if (!geometry->flat || !pose->items[i].visible || !item->receives) return 0;
    if (g->placed[item->node].plane == GN_NO) return 0;
    double s[3]; /* sides of the scene's box */
    for (int k = 0; k < 3; k++) s[k] = (double)pose->box_ws.max[k] - (double)pose->box_ws.min[k];
    /* the cofactor matrix gives the direction of the normal, and by its length how much the area
     * grows */
    mat3 cofactor;
    vec3 n;
    gn_cofactor(pose->items[i].world_from_item, cofactor);
    glm_mat3_mulv(cofactor, (float *)geometry->plane, n);
    const double stretch = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] +
                                (double)n[2] * (double)n[2]);
    double area = g->primitives.shapes[item->geometry].area * stretch;
    gn_unit(n);
    double box_area = fabs((double)n[0]) * s[1] * s[2] + fabs((double)n[1]) * s[2] * s[0] +
                      fabs((double)n[2]) * s[0] * s[1]; /* projected along n */
    return area < LEAST_SHARE * box_area ? 0 : area;
}

/* The largest, first of equal ones, into `to`; returns how many. */
static int find_large(const struct gn_gltf *g, const struct gn_pose *pose,
                      struct found to[CANDIDATES]) {
    int count = 0;
    for (uint32_t i = 0; i < g->scene->item_count; i++) {
        const double area = area_of(g, pose, i);
        int at = count;
        while (at > 0 && to[at - 1].area_m2 < area) at--;
        if (area <= 0 || at == CANDIDATES) continue;
        if (count < CANDIDATES) count++;
        memmove(&to[at + 1], &to[at], (size_t)(count - at - 1) * sizeof *to);
        to[at] = (struct found){i, area};
    }
    return count;
}

/* The height over a plane of a box's highest point, of its lowest with `most` -1. */
static float height_of(const struct gn_box *box, vec4 plane, float most) {
    float height_m = plane[3];
    for (int k = 0; k < 3; k++)
        height_m += plane[k] * (most * plane[k] > 0 ? box->max[k] : box->min[k]);
    return height_m;
}

/* Whether the shadow of a box falls on the receiver. plane: positive on the light's side, whose
 * height over it is height_m; light: its place, or the direction towards it. Boxes for all. */
static bool reaches(const struct gn_box *caster, const struct gn_box *receiver, vec4 plane,
                    vec3 light, float height_m, bool has_place) {
    vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    const float hair_m = fminf(1e-3f * size_of(receiver), 1e-2f * size_of(caster));
    if (height_of(caster, plane, 1) < hair_m) return false;
    if (has_place && height_of(caster, plane, 1) >= height_m)
        return height_of(caster, plane, -1) < height_m;
    for (int i = 0; i < 8; i++) {
        vec3 p;
        for (int k = 0; k < 3; k++) p[k] = i >> k & 1 ? caster->max[k] : caster->min[k];
        const float up_m = glm_vec3_dot(plane, p) + plane[3];
        vec3 ray; /* from the light, or along it */
        glm_vec3_copy(light, ray);
        if (has_place) glm_vec3_sub(light, p, ray);
        glm_vec3_muladds(ray, -up_m / (has_place ? height_m - up_m : height_m), p);
        glm_vec3_minv(low, p, low);
        glm_vec3_maxv(high, p, high);
    }
    for (int k = 0; k < 3; k++)
        if (high[k] < receiver->min[k] - hair_m || low[k] > receiver->max[k] + hair_m) return false;
    return true;
}

static bool reaches_from(const struct gn_gltf *g, const struct gn_pose *pose, uint32_t light,
                         uint32_t item, const struct gn_box *caster) {
    const struct gn_scene *scene = g->scene;
    const struct gn_light *l = &scene->lights[light];
    const bool has_place = gn_light_types[l->type].has_position;
    vec4 plane;
    vec3 place, direction;
    gn_pose_plane(pose, item, plane);
    gn_pose_light(pose, light, place, direction);
    if (!has_place) glm_vec3_negate_to(direction, place);
    float height_m = glm_vec3_dot(plane, place) + (has_place ? plane[3] : 0);
    if (height_m < 0 && scene->materials[scene->items[item].material].double_sided) {
        glm_vec4_negate(plane);
        height_m = -height_m;
    }
    const float least = has_place ? 1e-5f * size_of(&pose->items[item].box_ws) : 1e-2f;
    if (height_m <= least || (has_place && l->range_m > 0 && height_m > l->range_m)) return false;
    return reaches(caster, &pose->items[item].box_ws, plane, place, height_m, has_place);
}

/* Whether a light throws the shadow of anything but planes on it. What moves may come to stand in
 * the light: with clips, and before the file's missing light is added, any caster will do. */
static bool catches(const struct gn_gltf *g, const struct gn_pose *pose, uint32_t item,
                    const struct found *planes, int plane_count) {
    const struct gn_scene *scene = g->scene;
    const uint32_t lights = scene->light_count < LIGHTS ? scene->light_count : LIGHTS;
    const bool is_open = scene->animation.clip_count > 0 || lights == 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        bool casts = scene->items[i].casts && pose->items[i].visible;
        for (int k = 0; k < plane_count && casts; k++) casts = planes[k].item != i;
        if (!casts) continue;
        if (is_open) return true;
        for (uint32_t l = 0; l < lights; l++)
            if (reaches_from(g, pose, l, item, &pose->items[i].box_ws)) return true;
    }
    return false;
}

void gn_scene_find_planes(struct gn_gltf *g, const struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    struct found large[CANDIDATES];
    uint32_t chosen[GN_PLANES_MAX]; /* items */
    scene->planes_named = mark_named_planes(g, pose);
    if (scene->planes_named) return;
    const int count = find_large(g, pose, large);
    int planes = 0;
    for (int i = 0; i < count && planes < GN_PLANES_MAX; i++) {
        struct gn_item *item = &scene->items[large[i].item];
        bool apart = true;
        for (int k = 0; k < planes && apart; k++)
            apart = !lie_together(pose, chosen[k], large[i].item);
        /* a further one takes a pass, and what is blended is drawn with the first */
        if (i > 0 && (!apart || large[i].area_m2 < FURTHER_SHARE * large[0].area_m2 ||
                      gn_material_is_blended(&scene->materials[item->material]) ||
                      !catches(g, pose, large[i].item, large, count)))
            continue;
        chosen[planes++] = large[i].item;
        item->plane = (uint8_t)planes;
    }
}
