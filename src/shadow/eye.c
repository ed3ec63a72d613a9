#include "shadow/fit.h"
#include "shadow/private.h"

#include <cglm/cglm.h>
#include <math.h>

void gn_eye_build(struct gn_eye *eye, mat4 clip_from_world) {
    glm_mat4_copy(clip_from_world, eye->clip_from_world);
    for (int i = 0; i < 6; i++) { /* row 3 plus or minus row i / 2 (Gribb and Hartmann, 2001) */
        float sign = i % 2 ? -1.0f : 1.0f;
        for (int c = 0; c < 4; c++)
            eye->planes[i][c] = clip_from_world[c][3] + sign * clip_from_world[c][i / 2];
        float length = glm_vec3_norm(eye->planes[i]);
        if (length > 0.0f) glm_vec4_scale(eye->planes[i], 1.0f / length, eye->planes[i]);
    }
    mat4 world_from_clip;
    glm_mat4_inv_precise(clip_from_world, world_from_clip);
    for (int i = 0; i < 8; i++) {
        vec4 p = {i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f, 1.0f};
        glm_mat4_mulv(world_from_clip, p, p);
        glm_vec3_scale(p, 1.0f / p[3], eye->corners[i]);
    }
}

bool gn_eye_sees(const struct gn_eye *eye, const struct gn_box *box) {
    return !gn_planes_miss(eye->planes, 6, box);
}

static bool holds_point(const struct gn_box *box, const vec3 p) {
    bool inside = true;
    for (int k = 0; k < 3; k++) inside &= p[k] >= box->min[k] && p[k] <= box->max[k];
    return inside;
}

void gn_eye_depths(const struct gn_eye *eye, const vec3 start_ws, const struct gn_pose *pose,
                   float depths_m[2]) {
    enum { NEAR = 4 }; /* of the planes; those of the sides come before it */
    const float *near = eye->planes[NEAR];
    depths_m[0] = INFINITY;
    depths_m[1] = 0.0f;
    for (uint32_t i = 0; i < pose->scene->item_count; i++) {
        const struct gn_box *box = &pose->items[i].box_ws;
        if (!pose->items[i].visible || gn_planes_miss(eye->planes, NEAR + 1, box)) continue;
        depths_m[1] = fmaxf(depths_m[1], gn_box_most(near, box));
        if (!(gn_box_least(near, box) < depths_m[0]) || depths_m[0] <= 0.0f) continue;
        if (holds_point(box, start_ws)) depths_m[0] = 0.0f;
        vec3 corners[8];
        gn_box_corners(box, GLM_MAT4_IDENTITY, corners);
        for (int face = 0; face < 6; face++) {
            struct gn_polygon part;
            gn_box_face(corners, face, &part);
            for (int k = 0; k <= NEAR; k++) gn_polygon_clip(&part, eye->planes[k]);
            for (int k = 0; k < part.count; k++)
                depths_m[0] = fminf(depths_m[0], glm_vec3_dot((float *)near, part.at[k]) + near[3]);
        }
    }
}

void gn_eye_depth_plane(const struct gn_eye *eye, vec4 plane) {
    for (int c = 0; c < 4; c++) plane[c] = eye->clip_from_world[c][3];
}

float gn_box_least(const vec4 plane, const struct gn_box *box) {
    float least = plane[3];
    for (int k = 0; k < 3; k++) least += plane[k] * (plane[k] >= 0.0f ? box->min[k] : box->max[k]);
    return least;
}

float gn_box_most(const vec4 plane, const struct gn_box *box) {
    float most = plane[3];
    for (int k = 0; k < 3; k++) most += plane[k] * (plane[k] >= 0.0f ? box->max[k] : box->min[k]);
    return most;
}

bool gn_planes_hold(const vec4 *planes, int count, const struct gn_box *box) {
    for (int i = 0; i < count; i++)
        if (gn_box_least(planes[i], box) < 0.0f) return false;
    return true;
}

bool gn_planes_miss(const vec4 *planes, int count, const struct gn_box *box) {
    for (int i = 0; i < count; i++)
        if (!(gn_box_most(planes[i], box) >= 0.0f)) return true;
    return false;
}

bool gn_box_is_near(const struct gn_box *box, const vec3 place, float range_m) {
    float d2 = 0.0f;
    for (int k = 0; k < 3; k++) {
        float d = fmaxf(fmaxf(box->min[k] - place[k], place[k] - box->max[k]), 0.0f);
        d2 += d * d;
    }
    return d2 <= range_m * range_m * 1.0001f;
}

void gn_item_triangle(const struct gn_pose *pose, uint32_t item, uint32_t index,
                      struct gn_polygon *out) {
    const struct gn_scene *scene = pose->scene;
    const uint32_t *indices =
        scene->buffers.indices + scene->geometries[scene->items[item].geometry].first_index + index;
    out->count = 3;
    for (int k = 0; k < 3; k++) gn_pose_corner(pose, item, indices[k], out->at[k]);
}

void gn_polygon_clip(struct gn_polygon *polygon, const vec4 plane) {
    struct gn_polygon kept = {0};
    for (int i = 0; i < polygon->count; i++) {
        float *a = polygon->at[i], *b = polygon->at[(i + 1) % polygon->count];
        float da = a[0] * plane[0] + a[1] * plane[1] + a[2] * plane[2] + plane[3];
        float db = b[0] * plane[0] + b[1] * plane[1] + b[2] * plane[2] + plane[3];
        if (da >= 0.0f && kept.count < GN_POLYGON_MAX) glm_vec3_copy(a, kept.at[kept.count++]);
        if ((da < 0.0f) != (db < 0.0f) && kept.count < GN_POLYGON_MAX)
            glm_vec3_lerp(a, b, da / (da - db), kept.at[kept.count++]);
    }
    *polygon = kept;
}

void gn_box_corners(const struct gn_box *box, mat4 to, vec3 corners[8]) {
    for (int i = 0; i < 8; i++) {
        vec3 p = {i & 1 ? box->max[0] : box->min[0], i & 2 ? box->max[1] : box->min[1],
                  i & 4 ? box->max[2] : box->min[2]};
        glm_mat4_mulv3(to, p, 1.0f, corners[i]);
    }
}

static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

void gn_box_face(vec3 corners[8], int face, struct gn_polygon *out) {
    out->count = 4;
    for (int i = 0; i < 4; i++) glm_vec3_copy(corners[faces[face][i]], out->at[i]);
}

void gn_box_planes(vec3 corners[8], vec4 planes[6]) {
    vec3 middle = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < 8; i++) glm_vec3_muladds(corners[i], 0.125f, middle);
    for (int i = 0; i < 6; i++) {
        vec3 a, b;
        glm_vec3_sub(corners[faces[i][2]], corners[faces[i][0]],
                     a); /* diagonals: they work for a face with a side of length 0 */
        glm_vec3_sub(corners[faces[i][3]], corners[faces[i][1]], b);
        glm_vec3_cross(a, b, planes[i]);
        gn_unit(planes[i]); /* a zero vector stays zero: such a plane cuts nothing */
        planes[i][3] = -glm_vec3_dot(planes[i], corners[faces[i][0]]);
        float inside = glm_vec3_dot(planes[i], middle) + planes[i][3];
        if (inside < 0.0f) glm_vec4_negate(planes[i]);
    }
}

float gn_scene_size_m(const struct gn_pose *pose) {
    return fmaxf(glm_vec3_distance((float *)pose->box_ws.min, (float *)pose->box_ws.max), 1e-6f);
}

float gn_scene_reach_m(const struct gn_pose *pose) {
    float reach = 0.0f;
    for (int k = 0; k < 3; k++)
        reach = fmaxf(reach, fmaxf(fabsf(pose->box_ws.min[k]), fabsf(pose->box_ws.max[k])));
    return fmaxf(reach, 1e-6f);
}
