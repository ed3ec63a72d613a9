/* Normals for meshes without them: smooth, except where faces meet at a sharp angle. Neighbours are
 * weighted by their angle at the vertex (Thuermer and Wuethrich 1998), so the triangulation of a
 * polygon does not matter. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "import/private.h"

static const float CREASE_COS =
    0.766f; /* cos 40 degrees: a ten-sided cylinder is smooth, a box is not */

/* Of a place with more corners, the faces around it are grouped by the direction of their normals:
 * GROUPS along each axis. Up to there, each corner is compared with each. */
enum { MOST_CORNERS = 256, GROUPS = 6, GROUP_COUNT = GROUPS * GROUPS * GROUPS };

struct group {
    struct aiVector3D sum;  /* of the normals, weighted by angle */
    struct aiVector3D unit; /* its direction, or 0 */
};

struct place {           /* groups vertices by position, across texture seams */
    uint32_t *of_vertex; /* per vertex: its place */
    uint32_t *first;     /* per place: its first entry in `corners`; one more at the end */
    uint32_t *corners;   /* index numbers: 3 x face + 0, 1 or 2 */
    uint32_t *groups;    /* per place: its first group + 1, or 0: none */
    struct group *all_groups;
    size_t count, group_count;
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

static struct aiVector3D add_weighted(struct aiVector3D sum, struct aiVector3D v, float weight) {
    return (struct aiVector3D){sum.x + weight * v.x, sum.y + weight * v.y, sum.z + weight * v.z};
}

/* ---- groups: n faces around a place would cost n x n ---- */

static int group_along(float component) {
    const int i = (int)((component + 1.0f) / 2.0f * (float)GROUPS);
    return i < 0 ? 0 : i >= GROUPS ? GROUPS - 1 : i;
}

static void make_groups(struct place *place, const struct faces *faces) {
    place->groups = gn_import_alloc(place->count * sizeof *place->groups);
    for (size_t p = 0; p < place->count; p++) {
        const bool is_large = place->first[p + 1] - place->first[p] > MOST_CORNERS;
        place->groups[p] = is_large ? (uint32_t)place->group_count + 1 : 0;
        place->group_count += is_large ? GROUP_COUNT : 0;
    }
    place->all_groups = gn_import_alloc(place->group_count * sizeof *place->all_groups);
    for (size_t p = 0; p < place->count; p++) {
        if (!place->groups[p]) continue;
        struct group *groups = &place->all_groups[place->groups[p] - 1];
        for (uint32_t i = place->first[p]; i < place->first[p + 1]; i++) {
            const struct aiVector3D n = faces->normals[place->corners[i] / 3];
            struct group *group =
                &groups[(group_along(n.x) * GROUPS + group_along(n.y)) * GROUPS + group_along(n.z)];
            group->sum = add_weighted(group->sum, n, faces->angles[place->corners[i]]);
        }
        for (int k = 0; k < GROUP_COUNT; k++) groups[k].unit = unit_vector(groups[k].sum);
    }
}

static struct aiVector3D corner_normal(const struct place *place, const struct faces *faces,
                                       uint32_t at, struct aiVector3D own) {
    struct aiVector3D sum = {0.0f, 0.0f, 0.0f};
    const struct group *groups =
        place->groups[at] ? &place->all_groups[place->groups[at] - 1] : NULL;
    for (int k = 0; groups && k < GROUP_COUNT; k++)
        if (dot_product(own, groups[k].unit) >= CREASE_COS)
            sum = add_weighted(sum, groups[k].sum, 1.0f);
    for (uint32_t i = place->first[at]; !groups && i < place->first[at + 1]; i++) {
        struct aiVector3D n = faces->normals[place->corners[i] / 3];
        float weight = dot_product(own, n) >= CREASE_COS ? faces->angles[place->corners[i]] : 0.0f;
        sum = add_weighted(sum, n, weight);
    }
    sum = unit_vector(sum);
    return dot_product(sum, sum) > 0.0f ? sum : (struct aiVector3D){0.0f, 1.0f, 0.0f};
}

/* ---- vertices ---- */

struct vertex_key {
    uint32_t origin; /* the vertex of the mesh */
    struct aiVector3D normal;
};
_Static_assert(sizeof(struct vertex_key) == 16, "no padding: it is hashed");

/* One vertex for each vertex of the mesh and normal. */
static void split_vertices(struct gn_import_shape *shape, const struct place *place,
                           const struct faces *faces) {
    size_t size = 16;
    while (size < 2 * shape->index_count) size *= 2;
    uint32_t *slots = gn_import_alloc(size * sizeof *slots); /* vertex + 1, or 0 */
    const struct gn_hash_key hash_key = gn_hash_key_make();
    shape->origin = gn_import_alloc(shape->index_count * sizeof *shape->origin);
    shape->normals = gn_import_alloc(shape->index_count * sizeof *shape->normals);
    shape->vertex_count = 0;
    for (size_t i = 0; i < shape->index_count; i++) {
        const uint32_t vertex = shape->indices[i];
        const struct vertex_key key = {
            vertex, corner_normal(place, faces, place->of_vertex[vertex], faces->normals[i / 3])};
        size_t at = (size_t)gn_hash_keyed(&hash_key, &key, sizeof key) & (size - 1);
        for (; slots[at]; at = (at + 1) & (size - 1))
            if (shape->origin[slots[at] - 1] == vertex &&
                memcmp(&shape->normals[slots[at] - 1], &key.normal, sizeof key.normal) == 0)
                break;
        if (!slots[at]) {
            shape->origin[shape->vertex_count] = vertex;
            shape->normals[shape->vertex_count] = key.normal;
            slots[at] = ++shape->vertex_count;
        }
        shape->indices[i] = slots[at] - 1;
    }
    free(slots);
}

void gn_import_normals(struct gn_import_shape *shape) {
    const struct aiMesh *mesh = shape->mesh;
    struct place place = {0};
    uint32_t *order = gn_import_alloc(mesh->mNumVertices * sizeof *order);
    place.of_vertex = gn_import_alloc(mesh->mNumVertices * sizeof *order);
    for (uint32_t i = 0; i < mesh->mNumVertices; i++) order[i] = i;
    qsort_r(order, mesh->mNumVertices, sizeof *order, compare_positions, mesh->mVertices);
    for (uint32_t i = 0; i < mesh->mNumVertices; i++) {
        if (i == 0 || compare_positions(&order[i - 1], &order[i], mesh->mVertices) != 0)
            place.count++;
        place.of_vertex[order[i]] = (uint32_t)place.count - 1;
    }
    free(order);

    /* a counting sort of the corners by place */
    uint32_t *next = place.first = gn_import_alloc((place.count + 2) * sizeof *next);
    place.corners = gn_import_alloc(shape->index_count * sizeof *place.corners);
    for (size_t i = 0; i < shape->index_count; i++) next[place.of_vertex[shape->indices[i]] + 2]++;
    for (size_t i = 2; i < place.count + 2; i++) next[i] += next[i - 1];
    for (size_t i = 0; i < shape->index_count; i++)
        place.corners[next[place.of_vertex[shape->indices[i]] + 1]++] = (uint32_t)i;

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
    make_groups(&place, &faces);
    split_vertices(shape, &place, &faces);
    free(faces.normals);
    free(faces.angles);
    free(place.of_vertex);
    free(place.first);
    free(place.corners);
    free(place.groups);
    free(place.all_groups);
}
