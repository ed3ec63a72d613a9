/* Meshes to glTF. Each is written once, however many nodes use it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/srgb.h"
#include "import/private.h"

static float finite_or_0(float value) { return isfinite(value) ? value : 0.0f; }

static int add_vectors(struct gn_import *import, const struct gn_import_shape *shape,
                       bool positions) {
    float *values = gn_import_alloc(3 * (size_t)shape->vertex_count * sizeof *values);
    for (size_t i = 0; i < shape->vertex_count; i++) {
        struct aiVector3D v =
            positions ? shape->mesh->mVertices[shape->origin[i]] : shape->normals[i];
        values[3 * i] = finite_or_0(v.x);
        values[3 * i + 1] = finite_or_0(v.y);
        values[3 * i + 2] = finite_or_0(v.z);
    }
    int index =
        gn_glb_accessor(&import->glb, &(struct gn_glb_accessor){.data = values,
                                                                .count = shape->vertex_count,
                                                                .width = 3,
                                                                .component = GN_GLB_F32,
                                                                .bounds = positions});
    free(values);
    return index;
}

/* assimp's v axis points up, glTF's down. */
static int add_uvs(struct gn_import *import, const struct gn_import_shape *shape, int set) {
    float *values = gn_import_alloc(2 * (size_t)shape->vertex_count * sizeof *values);
    for (size_t i = 0; i < shape->vertex_count; i++) {
        struct aiVector3D uv = shape->mesh->mTextureCoords[set][shape->origin[i]];
        values[2 * i] = finite_or_0(uv.x);
        values[2 * i + 1] = 1.0f - finite_or_0(uv.y);
    }
    int index = gn_glb_accessor(
        &import->glb,
        &(struct gn_glb_accessor){
            .data = values, .count = shape->vertex_count, .width = 2, .component = GN_GLB_F32});
    free(values);
    return index;
}

static float clamp_unit(float value) { return value > 0.0f ? fminf(value, 1.0f) : 0.0f; }

/* Colours of the other formats are sRGB, glTF's linear (IEC 61966-2-1). */
static uint16_t linear_from_srgb(float value) {
    return (uint16_t)lrintf(65535.0f * gn_srgb_decode(clamp_unit(value)));
}

static int add_colors(struct gn_import *import, const struct gn_import_shape *shape) {
    uint16_t *values = gn_import_alloc(4 * (size_t)shape->vertex_count * sizeof *values);
    for (size_t i = 0; i < shape->vertex_count; i++) {
        struct aiColor4D color = shape->mesh->mColors[0][shape->origin[i]];
        values[4 * i] = linear_from_srgb(color.r);
        values[4 * i + 1] = linear_from_srgb(color.g);
        values[4 * i + 2] = linear_from_srgb(color.b);
        values[4 * i + 3] = (uint16_t)lrintf(65535.0f * clamp_unit(color.a));
    }
    int index =
        gn_glb_accessor(&import->glb, &(struct gn_glb_accessor){.data = values,
                                                                .count = shape->vertex_count,
                                                                .width = 4,
                                                                .component = GN_GLB_U16,
                                                                .normalized = true});
    free(values);
    return index;
}

static int add_indices(struct gn_import *import, const struct gn_import_shape *shape) {
    struct gn_glb_accessor a = {.data = shape->indices,
                                .count = shape->index_count,
                                .width = 1,
                                .component = GN_GLB_U32,
                                .indices = true};
    if (shape->vertex_count > 65535) return gn_glb_accessor(&import->glb, &a);
    uint16_t *narrow = gn_import_alloc(a.count * sizeof *narrow);
    for (size_t i = 0; i < a.count; i++) narrow[i] = (uint16_t)shape->indices[i];
    a.data = narrow;
    a.component = GN_GLB_U16;
    int index = gn_glb_accessor(&import->glb, &a);
    free(narrow);
    return index;
}

/* False for three corners on one line: a sine below the precision of floats. */
static bool has_area(const struct aiMesh *mesh, const uint32_t corners[3]) {
    double edges[2][3], lengths[2] = {0.0, 0.0}, area = 0.0;
    const struct aiVector3D *a = &mesh->mVertices[corners[0]];
    for (int i = 0; i < 2; i++) {
        const struct aiVector3D *b = &mesh->mVertices[corners[1 + i]];
        const double edge[3] = {(double)b->x - (double)a->x, (double)b->y - (double)a->y,
                                (double)b->z - (double)a->z};
        for (int k = 0; k < 3; k++) {
            edges[i][k] = edge[k];
            lengths[i] += edge[k] * edge[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double part = edges[0][u] * edges[1][v] - edges[0][v] * edges[1][u];
        area += part * part;
    }
    return area > 1e-13 * lengths[0] * lengths[1];
}

/* JSON null if the mesh has no triangles. */
static json_t *make_primitive(struct gn_import *import, const struct aiMesh *mesh) {
    struct gn_import_shape shape = {.mesh = mesh};
    json_t *object = NULL;
    shape.indices = gn_import_alloc(3 * (size_t)mesh->mNumFaces * sizeof *shape.indices);
    for (unsigned i = 0; i < mesh->mNumFaces && mesh->mVertices; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        bool is_triangle = face->mNumIndices == 3;
        for (int k = 0; k < 3 && is_triangle; k++)
            is_triangle = face->mIndices[k] < mesh->mNumVertices;
        for (int k = 0; k < 3 && is_triangle; k++)
            shape.indices[shape.index_count++] = face->mIndices[k];
        if (is_triangle && !import->has_area)
            import->has_area = has_area(mesh, &shape.indices[shape.index_count - 3]);
    }
    if (shape.index_count && mesh->mNormals) {
        size_t count = shape.vertex_count = mesh->mNumVertices;
        shape.origin = gn_import_alloc(count * sizeof *shape.origin);
        shape.normals = gn_import_alloc(count * sizeof *shape.normals);
        for (uint32_t i = 0; i < count; i++) shape.origin[i] = i;
        memcpy(shape.normals, mesh->mNormals, count * sizeof *shape.normals);
    } else if (shape.index_count)
        gn_import_normals(&shape);

    if (shape.index_count) {
        static const char *const sets[] = {"TEXCOORD_0", "TEXCOORD_1"};
        int normals = add_vectors(import, &shape, false),
            positions = add_vectors(import, &shape, true);
        json_t *attributes = json_pack("{s:i,s:i}", "POSITION", positions, "NORMAL", normals);
        for (int i = 0; i < 2 && mesh->mTextureCoords[i]; i++)
            json_object_set_new(attributes, sets[i], json_integer(add_uvs(import, &shape, i)));
        if (mesh->mColors[0])
            json_object_set_new(attributes, "COLOR_0", json_integer(add_colors(import, &shape)));
        object = json_pack("{s:o,s:i}", "attributes", attributes, "indices",
                           add_indices(import, &shape));
        int material = gn_import_material(import, mesh->mMaterialIndex);
        if (material >= 0) json_object_set_new(object, "material", json_integer(material));
    }
    free(shape.indices);
    free(shape.origin);
    free(shape.normals);
    return object ? object : json_null();
}

static int add_mesh(struct gn_import *import, const struct aiNode *node) {
    json_t *primitives = json_array();
    const char *name = "";
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        unsigned index = node->mMeshes[i];
        if (index >= import->scene->mNumMeshes) continue;
        json_t **one = &import->primitives[index];
        if (!*one) *one = make_primitive(import, import->scene->mMeshes[index]);
        if (json_is_null(*one)) continue;
        json_array_append(primitives, *one);
        name = import->scene->mMeshes[index]->mName.data;
    }
    if (json_array_size(primitives))
        return gn_glb_add(
            &import->glb, "meshes",
            json_pack("{s:o,s:o}", "name", gn_glb_text(name), "primitives", primitives));
    json_decref(primitives);
    return -1;
}

/* Nodes with the same single mesh share one glTF mesh; nodes with several share primitives. */
int gn_import_mesh(struct gn_import *import, const struct aiNode *node) {
    if (node->mNumMeshes == 0) return -1;
    if (node->mNumMeshes > 1 || node->mMeshes[0] >= import->scene->mNumMeshes)
        return add_mesh(import, node);
    int *known = &import->meshes[node->mMeshes[0]];
    if (*known == GN_IMPORT_UNSEEN) *known = add_mesh(import, node);
    return *known;
}
