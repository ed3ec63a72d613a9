/* The screen bounds are those of a convex body with eight corners that encloses the light's reach:
 * the cube round its sphere, and for a spot light also the pyramid round its cone. The visible part
 * of such a body is bounded by its faces clipped by the eye's planes, and by the eye's faces
 * clipped by the body's planes. */
#include "shadow/reach.h"

#include <cglm/cglm.h>
#include <math.h>

#include "shadow/private.h"

#define PYRAMID_MAX_TAN 3.0f /* for a wider cone the sphere is as good a bound */

void gn_reach_build(struct gn_reach *reach, const struct gn_pose *pose, uint32_t light) {
    const struct gn_light *l = &pose->lights[light];
    *reach = (struct gn_reach){.everywhere = !gn_light_types[l->type].has_position,
                               .cone = gn_light_types[l->type].has_cone,
                               .sin_cone = sinf(l->outer_rad),
                               .cos_cone = cosf(l->outer_rad)};
    gn_pose_light(pose, light, reach->place_ws, reach->axis_ws);
    vec3 reaches;
    for (int k = 0; k < 3; k++)
        reaches[k] = fmaxf(fabsf(pose->box_ws.min[k] - reach->place_ws[k]),
                           fabsf(pose->box_ws.max[k] - reach->place_ws[k]));
    reach->range_m = glm_vec3_norm(reaches) * 1.001f + 1e-6f;
    if (l->range_m > 0.0f) reach->range_m = fminf(reach->range_m, l->range_m);
}

bool gn_reach_touches(const struct gn_reach *reach, const struct gn_box *box_ws) {
    if (reach->everywhere) return true;
    if (!gn_box_is_near(box_ws, reach->place_ws, reach->range_m)) return false;
    if (!reach->cone) return true;

    /* the sphere round the box: its centre's distance from the cone's surface */
    vec3 centre, v;
    glm_vec3_center((float *)box_ws->min, (float *)box_ws->max, centre);
    float radius = 0.5001f * glm_vec3_distance((float *)box_ws->min, (float *)box_ws->max);
    glm_vec3_sub(centre, (float *)reach->place_ws, v);
    float along = glm_vec3_dot(v, (float *)reach->axis_ws);
    float across = sqrtf(fmaxf(glm_vec3_norm2(v) - along * along, 0.0f));
    return across * reach->cos_cone - along * reach->sin_cone <= radius;
}

/* ---- screen bounds ---- */

struct bounds { /* -1..1 */
    float min[2], max[2];
};

/* Adds the faces, each clipped by six planes. */
static void add_faces(struct bounds *b, const vec3 corners[8], const vec4 planes[6],
                      const struct gn_eye *eye) {
    for (int face = 0; face < 6; face++) {
        struct gn_polygon polygon;
        gn_box_face((vec3 *)corners, face, &polygon);
        for (int i = 0; i < 6; i++) gn_polygon_clip(&polygon, planes[i]);
        for (int i = 0; i < polygon.count; i++) {
            vec4 p = {polygon.at[i][0], polygon.at[i][1], polygon.at[i][2], 1.0f};
            glm_mat4_mulv((vec4 *)eye->clip_from_world, p, p);
            for (int k = 0; k < 2; k++) {
                float at = p[3] > 0.0f ? p[k] / p[3] : (p[k] < 0.0f ? -1.0f : 1.0f);
                b->min[k] = fminf(b->min[k], at);
                b->max[k] = fmaxf(b->max[k], at);
            }
        }
    }
}

static struct bounds body_bounds(const vec3 corners[8], const struct gn_eye *eye) {
    struct bounds b = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    vec4 planes[6];
    gn_box_planes((vec3 *)corners, planes);
    add_faces(&b, corners, eye->planes, eye);
    add_faces(&b, eye->corners, planes, eye);
    return b;
}

static int pixel_edge(float at, uint32_t size, float pad) {
    float px = (0.5f * at + 0.5f) * (float)size + pad;
    return (int)fminf(fmaxf(pad < 0.0f ? floorf(px) : ceilf(px), 0.0f), (float)size);
}

struct gn_reach_rect gn_reach_rect(const struct gn_reach *reach, const struct gn_eye *eye,
                                   uint32_t width_px, uint32_t height_px) {
    if (reach->everywhere) return (struct gn_reach_rect){0, 0, (int)width_px, (int)height_px};

    /* the cube round the sphere */
    vec3 corners[8];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            corners[i][k] = reach->place_ws[k] + (i >> k & 1 ? reach->range_m : -reach->range_m);
    struct bounds b = body_bounds(corners, eye);

    /* the pyramid round the cone: four of its eight corners are close to the light, not at it,
     * since a face that is a point has no plane */
    if (reach->cone && reach->sin_cone < PYRAMID_MAX_TAN * reach->cos_cone) {
        vec3 side[2], axis;
        glm_vec3_copy((float *)reach->axis_ws, axis);
        glm_vec3_ortho(axis, side[0]);
        glm_vec3_normalize(side[0]);
        glm_vec3_cross(axis, side[0], side[1]);
        for (int i = 0; i < 8; i++) {
            float depth = i & 4 ? reach->range_m : 0.0f;
            float half =
                (i & 4 ? 1.0f : 1e-3f) * reach->range_m * reach->sin_cone / reach->cos_cone;
            glm_vec3_copy((float *)reach->place_ws, corners[i]);
            glm_vec3_muladds(axis, depth, corners[i]);
            glm_vec3_muladds(side[0], i & 1 ? half : -half, corners[i]);
            glm_vec3_muladds(side[1], i & 2 ? half : -half, corners[i]);
        }
        const struct bounds p = body_bounds(corners, eye);
        for (int k = 0; k < 2; k++) {
            b.min[k] = fmaxf(b.min[k], p.min[k]);
            b.max[k] = fminf(b.max[k], p.max[k]);
        }
    }

    /* a pixel more on each side: for rounding, and for samples that are not in a pixel's middle */
    if (!(b.min[0] <= b.max[0])) return (struct gn_reach_rect){0};
    return (struct gn_reach_rect){
        pixel_edge(b.min[0], width_px, -1.0f), pixel_edge(b.min[1], height_px, -1.0f),
        pixel_edge(b.max[0], width_px, 1.0f), pixel_edge(b.max[1], height_px, 1.0f)};
}

struct gn_reach_rect gn_reach_rect_unite(struct gn_reach_rect a, struct gn_reach_rect b) {
    if (a.x0 >= a.x1 || a.y0 >= a.y1) return b;
    if (b.x0 >= b.x1 || b.y0 >= b.y1) return a;
    return (struct gn_reach_rect){a.x0 < b.x0 ? a.x0 : b.x0, a.y0 < b.y0 ? a.y0 : b.y0,
                                  a.x1 > b.x1 ? a.x1 : b.x1, a.y1 > b.y1 ? a.y1 : b.y1};
}
