/* Derived from the triangles of a geometry: missing normals, tangents of length 0, spreads of
 * normals, bounds, and whether it is flat. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

/* The normal of a counter-clockwise triangle, of twice its area as length; in double, since edges
 * may be short and far from the origin. */
static void cross_of(const float *a, const float *b, const float *c, double out[3]) {
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - (double)a[i];
        v[i] = (double)c[i] - (double)a[i];
    }
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* +Y for a triangle without area. */
static void face_normal(const float *a, const float *b, const float *c, float out[3]) {
    double n[3];
    cross_of(a, b, c, n);
    double length = length_of(n);
    for (int i = 0; i < 3; i++) out[i] = length > 0 ? (float)(n[i] / length) : (float)(i == 1);
}

/* ---- normals ---- */

/* glTF requires flat normals where a file has none: a vertex is duplicated for each face around it
 * with another normal. */
bool gn_geometry_flat_normals(struct gn_gltf *g, const float *positions, uint32_t *corners,
                              size_t corner_count, size_t vertex_count, uint32_t **source,
                              float *normals, size_t *made) {
    uint32_t *latest =
        gn_gltf_alloc(g, &g->memory.step, vertex_count, sizeof *latest); /* made + 1 */
    *source = gn_gltf_alloc(g, &g->memory.step, corner_count, sizeof **source);
    if (g->failed) return false;
    size_t count = 0;
    float normal[3] = {0, 1, 0};
    for (size_t i = 0; i < corner_count; i++) {
        const uint32_t *t = corners + i;
        if (i % 3 == 0)
            face_normal(positions + 3 * (size_t)t[0], positions + 3 * (size_t)t[1],
                        positions + 3 * (size_t)t[2], normal);
        uint32_t vertex = corners[i], known = latest[vertex];
        const float *other = normals + 3 * (size_t)(known ? known - 1 : 0);
        bool same =
            known && normal[0] * other[0] + normal[1] * other[1] + normal[2] * other[2] > 1 - 1e-6f;
        if (!same) {
            memcpy(normals + 3 * count, normal, sizeof normal);
            (*source)[count] = vertex;
            latest[vertex] = (uint32_t)++count;
        }
        corners[i] = latest[vertex] - 1;
    }
    *made = count;
    return true;
}

size_t gn_normals_repair(const float *positions, float *normals, const uint32_t *corners,
                         size_t corner_count) {
    size_t repaired = 0;
    for (size_t i = 0; i < corner_count; i++) {
        float *n = normals + 3 * (size_t)corners[i];
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) continue;
        const uint32_t *face = corners + i - i % 3;
        face_normal(positions + 3 * (size_t)face[0], positions + 3 * (size_t)face[1],
                    positions + 3 * (size_t)face[2], n);
        repaired++;
    }
    return repaired;
}

void gn_geometry_repair_tangents(struct gn_scene *scene, size_t first, size_t count) {
    for (size_t i = first; i < first + count; i++) {
        float *t = scene->buffers.tangents + 4 * i, *n = scene->buffers.normals + 3 * i;
        vec3 any = {n[1], n[2], n[0]}, across;
        glm_vec3_cross(any, n, across); /* 0 only where n is along (1, 1, 1) */
        if (glm_vec3_norm(across) < 1e-3f) glm_vec3_cross((vec3){1, 0, 0}, n, across);
        const float length = glm_vec3_norm(t);
        const bool right = length > 1e-6f && length < 1e18f;
        if (right)
            glm_vec3_scale(t, 1 / length, t);
        else if (glm_vec3_norm(across) > 0)
            glm_vec3_normalize_to(across, t);
        else /* of a vertex without a normal: no triangle has it */
            glm_vec3_copy((vec3){1, 0, 0}, t);
        t[3] = t[3] < 0 ? -1 : 1;
    }
}

/* Angles under half a degree are rounding errors of the file's normals. */
#define SPREAD_LEAST .01

void gn_geometry_add_spread(struct gn_scene *scene, uint32_t vertex, const double face[3],
                            const double normal[3]) {
    const double length = length_of(face) * length_of(normal);
    int16_t *spread = &scene->buffers.spreads[vertex];
    double along = 0;
    if (!(length > 0)) return;
    for (int c = 0; c < 3; c++) along += face[c] * normal[c] / length;
    const double sine = sqrt(fmax(1 - along * along, 0));
    if (sine > SPREAD_LEAST && sine * 32767 > *spread) *spread = (int16_t)(sine * 32767);
}

void gn_geometry_add_spreads(struct gn_scene *scene, const struct gn_geometry *geometry) {
    const struct gn_scene_buffers *buffers = &scene->buffers;
    const uint32_t *index = buffers->indices + geometry->first_index;
    for (size_t i = 0; i + 2 < geometry->index_count; i += 3) {
        double face[3];
        cross_of(buffers->positions + 3 * (size_t)index[i],
                 buffers->positions + 3 * (size_t)index[i + 1],
                 buffers->positions + 3 * (size_t)index[i + 2], face);
        for (int k = 0; k < 3; k++) {
            const float *n = buffers->normals + 3 * (size_t)index[i + k];
            gn_geometry_add_spread(scene, index[i + k], face,
                                   (const double[3]){(double)n[0], (double)n[1], (double)n[2]});
        }
    }
}

/* ---- bounds ---- */

/* The normal of the largest triangle, oriented to the side that most of the area faces. */
static bool guess_normal(const struct gn_scene *scene, const struct gn_geometry *geometry,
                         double out[3], double *area, double along[3]) {
    const uint32_t *index = scene->buffers.indices + geometry->first_index;
    double sum[3] = {0}, best = 0;
    *area = 0;
    for (size_t i = 0; i + 2 < geometry->index_count; i += 3) {
        double n[3];
        cross_of(scene->buffers.positions + 3 * (size_t)index[i],
                 scene->buffers.positions + 3 * (size_t)index[i + 1],
                 scene->buffers.positions + 3 * (size_t)index[i + 2], n);
        double length = length_of(n);
        *area += length / 2;
        for (int k = 0; k < 3; k++) {
            sum[k] += n[k];
            along[k] += fabs(n[k]) / 2;
        }
        if (length <= best) continue;
        best = length;
        memcpy(out, n, sizeof n);
    }
    double sign = sum[0] * out[0] + sum[1] * out[1] + sum[2] * out[2] < 0 ? -1 : 1;
    for (int k = 0; k < 3 && best > 0; k++) out[k] *= sign / best;
    return best > 0;
}

void gn_geometry_measure(const struct gn_scene *scene, struct gn_geometry *geometry, double *area) {
    const uint32_t *index = scene->buffers.indices + geometry->first_index;
    const float *positions = scene->buffers.positions;
    *area = 0;
    if (geometry->index_count == 0) return;
    struct gn_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < geometry->index_count; i++) {
        const float *p = positions + 3 * (size_t)index[i];
        for (int k = 0; k < 3; k++) {
            if (p[k] < box.min[k]) box.min[k] = p[k];
            if (p[k] > box.max[k]) box.max[k] = p[k];
        }
    }
    geometry->box = box;

    const uint32_t triangles = geometry->index_count / 3;
    double n[3] = {0}, along[3] = {0}, size[3], d = 0;
    if (!guess_normal(scene, geometry, n, area, along)) return;
    const float *on = positions + 3 * (size_t)index[0];
    for (int k = 0; k < 3; k++) {
        size[k] = (double)box.max[k] - (double)box.min[k];
        d -= n[k] * (double)on[k];
    }
    for (int k = 0; k < 3; k++) {
        const double face = size[(k + 1) % 3] * size[(k + 2) % 3];
        if (face > 0) geometry->layers[k] = (float)fmin(along[k] / face, triangles);
    }
    const double tolerance = 1e-5 * length_of(size);
    for (size_t i = 0; i < geometry->index_count; i++) {
        const float *p = positions + 3 * (size_t)index[i];
        double distance = n[0] * (double)p[0] + n[1] * (double)p[1] + n[2] * (double)p[2] + d;
        if (!(fabs(distance) <= tolerance)) return;
    }
    geometry->flat = true;
    for (int k = 0; k < 3; k++) geometry->plane[k] = (float)n[k];
    geometry->plane[3] = (float)d;
}
