/* Normals for meshes without them: smooth, except where faces meet at a sharp angle. Neighbours are
 * weighted by their angle at the vertex (Thuermer and Wuethrich 1998), so the triangulation of a
 * polygon does not matter. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/private.h"

static const float CREASE_COS =
    0.766f; /* cos 40 degrees: a ten-sided cylinder is smooth, a box is not */

struct place {           /* groups vertices by position, across texture seams */
    uint32_t *of_vertex; /* per vertex: its place */
    uint32_t *first;     /* per place: its first entry in `corners`; one more at the end */
    uint32_t *corners;   /* index numbers: 3 x face + 0, 1 or 2 */
    size_t count;
};

struct faces {
    struct aiVector3D *normals; /* per face: unit length, or 0 */
    float *angles;              /* per corner, radians */
};

static int compare_positions(const void *a, const void *b, void *positions) {
    const struct aiVector3D *p = (struct aiVector3D *)positions + *(const uint32_t *)a,
                            *q = (struct aiVector3D *)positions + *(const uint32_t *)b;
    const float from[3] = {p->x + 0.0f, p->y + 0.0f, p->z + 0.0f}; /* turns -0 into 0 */
    const float to[3] = {q->x + 0.0f, q->y + 0.0f, q->z + 0.0f};
    return memcmp(from, to, sizeof from);
}

static void find_places(struct place *place, const struct gn_import_shape *shape) {
    const struct aiMesh *mesh = shape->mesh;
    uint32_t *order = gn_import_alloc(mesh->mNumVertices * sizeof *order);
    place->of_vertex = gn_import_alloc(mesh->mNumVertices * sizeof *order);
    for (uint32_t i = 0; i < mesh->mNumVertices; i++) order[i] = i;
    qsort_r(order, mesh->mNumVertices, sizeof *order, compare_positions, mesh->mVertices);
    for (uint32_t i = 0; i < mesh->mNumVertices; i++) {
        if (i == 0 || compare_positions(&order[i - 1], &order[i], mesh->mVertices) != 0)
            place->count++;
        place->of_vertex[order[i]] = (uint32_t)place->count - 1;
    }
    free(order);

    /* a counting sort of the corners by place */
    uint32_t *next = gn_import_alloc((place->count + 2) * sizeof *next);
    place->first = next;
    place->corners = gn_import_alloc(shape->index_count * sizeof *place->corners);
    memset(next, 0, (place->count + 2) * sizeof *next);
    for (size_t i = 0; i < shape->index_count; i++) next[place->of_vertex[shape->indices[i]] + 2]++;
    for (size_t i = 2; i < place->count + 2; i++) next[i] += next[i - 1];
    for (size_t i = 0; i < shape->index_count; i++)
        place->corners[next[place->of_vertex[shape->indices[i]] + 1]++] = (uint32_t)i;
}

static float dot_product(struct aiVector3D a, struct aiVector3D b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct aiVector3D unit_vector(struct aiVector3D v) {
    float length = sqrtf(dot_product(v, v));
    if (!isfinite(length) || length <= 0.0f) return (struct aiVector3D){0.0f, 0.0f, 0.0f};
    return (struct aiVector3D){v.x / length, v.y / length, v.z / length};
}

static struct aiVector3D direction_to(const struct gn_import_shape *shape, size_t from, size_t to) {
    const struct aiVector3D *a = &shape->mesh->mVertices[shape->indices[from]],
                            *b = &shape->mesh->mVertices[shape->indices[to]];
    return unit_vector((struct aiVector3D){b->x - a->x, b->y - a->y, b->z - a->z});
}

static struct aiVector3D corner_normal(const struct place *place, const struct faces *faces,
                                       uint32_t at, struct aiVector3D own) {
    struct aiVector3D sum = {0.0f, 0.0f, 0.0f};
    for (uint32_t i = place->first[at]; i < place->first[at + 1]; i++) {
        struct aiVector3D n = faces->normals[place->corners[i] / 3];
        float weight = dot_product(own, n) >= CREASE_COS ? faces->angles[place->corners[i]] : 0.0f;
        sum = (struct aiVector3D){sum.x + weight * n.x, sum.y + weight * n.y, sum.z + weight * n.z};
    }
    sum = unit_vector(sum);
    return dot_product(sum, sum) > 0.0f ? sum : (struct aiVector3D){0.0f, 1.0f, 0.0f};
}

/* One vertex for each vertex and normal. next chains the copies of a vertex of the mesh. */
static void split_vertices(struct gn_import_shape *shape, const struct place *place,
                           const struct faces *faces) {
    uint32_t *heads = gn_import_alloc(shape->mesh->mNumVertices * sizeof *heads);
    uint32_t *next = gn_import_alloc(shape->index_count * sizeof *next);
    memset(heads, 0xff, shape->mesh->mNumVertices * sizeof *heads);
    shape->origin = gn_import_alloc(shape->index_count * sizeof *shape->origin);
    shape->normals = gn_import_alloc(shape->index_count * sizeof *shape->normals);
    shape->vertex_count = 0;
    for (size_t i = 0; i < shape->index_count; i++) {
        uint32_t vertex = shape->indices[i], copy = heads[vertex];
        struct aiVector3D normal =
            corner_normal(place, faces, place->of_vertex[vertex], faces->normals[i / 3]);
        while (copy != UINT32_MAX && memcmp(&shape->normals[copy], &normal, sizeof normal) != 0)
            copy = next[copy];
        if (copy == UINT32_MAX) {
            copy = shape->vertex_count++;
            shape->origin[copy] = vertex;
            shape->normals[copy] = normal;
            next[copy] = heads[vertex];
            heads[vertex] = copy;
        }
        shape->indices[i] = copy;
    }
    free(heads);
    free(next);
}

void gn_import_normals(struct gn_import_shape *shape) {
    struct place place = {0};
    find_places(&place, shape);
    struct faces faces = {
        .normals = gn_import_alloc(shape->index_count / 3 * sizeof *faces.normals),
        .angles = gn_import_alloc(shape->index_count * sizeof *faces.angles),
    };
    for (size_t i = 0; i < shape->index_count; i += 3) {
        struct aiVector3D u = direction_to(shape, i, i + 1), v = direction_to(shape, i, i + 2),
                          w = direction_to(shape, i + 1, i + 2);
        faces.normals[i / 3] = unit_vector((struct aiVector3D){
            u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x});
        faces.angles[i] = acosf(fminf(fmaxf(dot_product(u, v), -1.0f), 1.0f));
        faces.angles[i + 1] = acosf(fminf(fmaxf(-dot_product(u, w), -1.0f), 1.0f));
        faces.angles[i + 2] = acosf(fminf(fmaxf(dot_product(v, w), -1.0f), 1.0f));
    }
    split_vertices(shape, &place, &faces);
    free(faces.normals);
    free(faces.angles);
    free(place.of_vertex);
    free(place.first);
    free(place.corners);
}
