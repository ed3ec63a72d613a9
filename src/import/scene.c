/* Conversion of one scene: assimp reads it, then nodes, meshes, lights and cameras are written. */
#include <math.h>
#include <string.h>

#include "import/private.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>

/* Up axis. STL, PLY: Z, as Blender and f3d have it; OBJ: Y by convention; Collada: assimp converts;
 * FBX: converted here, since assimp does it only from 5.3 on. */
static const enum gn_import_up up_of[GN_MODEL_FORMAT_COUNT] = {
    [GN_MODEL_OBJ] = GN_IMPORT_UP_Y, [GN_MODEL_FBX] = GN_IMPORT_UP_AUTO,
    [GN_MODEL_STL] = GN_IMPORT_UP_Z, [GN_MODEL_PLY] = GN_IMPORT_UP_Z,
    [GN_MODEL_DAE] = GN_IMPORT_UP_Y,
};

/* ---- reading ---- */

static bool fail_empty(const struct gn_import *import) {
    return gn_fail(import->err, "%s: no triangles; points and lines are not supported",
                   import->opts->model);
}

static bool read_scene(struct gn_import *import) {
    struct aiFileIO io = gn_import_folder_io(import);
    struct aiPropertyStore *p = aiCreatePropertyStore();
    if (!p) gn_import_no_memory();
    bool forced_up = import->opts->up != GN_IMPORT_UP_AUTO;
    aiSetImportPropertyInteger(p, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    aiSetImportPropertyInteger(p, AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, 0);
    aiSetImportPropertyInteger(p, AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, 0);
    aiSetImportPropertyInteger(p, "AI_CONFIG_IMPORT_FBX_IGNORE_UP_DIRECTION",
                               1); /* newer versions of assimp */
    aiSetImportPropertyInteger(p, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, forced_up);
    import->scene = aiImportFileExWithProperties(
        import->name,
        aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FindInvalidData |
            aiProcess_TransformUVCoords | aiProcess_JoinIdenticalVertices |
            aiProcess_GenBoundingBoxes,
        &io, p);
    aiReleasePropertyStore(p);
    if (!import->scene) {
        const char *why = aiGetErrorString();
        if (why && strstr(why, "bad_alloc")) gn_import_no_memory();
        if (why && strcmp(why, "No meshes remaining") == 0) return fail_empty(import);
        return gn_fail(import->err,
                       "%s: cannot be read as %s (%.160s); export it again, or as .glb",
                       import->opts->model, gn_model_formats[import->format].name,
                       why && *why ? why : "no reason given");
    }
    /* assimp's own root; 5.4.3 rotates it unconditionally */
    if (import->format == GN_MODEL_FBX)
        aiIdentityMatrix4(&import->scene->mRootNode->mTransformation);
    return true;
}

/* ---- axes and units ---- */

static float meta_number(const struct gn_import *import, const char *key, float fallback) {
    const struct aiMetadata *meta = import->scene->mMetaData;
    for (unsigned i = 0; meta && i < meta->mNumProperties; i++) {
        const struct aiMetadataEntry *entry = &meta->mValues[i];
        if (strcmp(meta->mKeys[i].data, key) != 0 || !entry->mData) continue;
        if (entry->mType == AI_INT32) return (float)*(const int32_t *)entry->mData;
        if (entry->mType == AI_FLOAT) return *(const float *)entry->mData;
        if (entry->mType == AI_DOUBLE) return (float)*(const double *)entry->mData;
        break;
    }
    return fallback;
}

static float meta_sign(const struct gn_import *import, const char *key) {
    return meta_number(import, key, 1.0f) < 0.0f ? -1.0f : 1.0f;
}

static struct aiMatrix4x4 world_from_model(const struct gn_import *import) {
    enum gn_import_up up =
        import->opts->up == GN_IMPORT_UP_AUTO ? up_of[import->format] : import->opts->up;
    float m[3][3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}, scale = 1.0f;
    if (up == GN_IMPORT_UP_AUTO) {
        /* each row selects the FBX axis that is our X, Y or Z; unchanged if it is no rotation */
        int axis[3] = {(int)meta_number(import, "CoordAxis", 0.0f),
                       (int)meta_number(import, "UpAxis", 1.0f),
                       (int)meta_number(import, "FrontAxis", 2.0f)};
        int seen = 0;
        for (int i = 0; i < 3; i++) seen |= axis[i] >= 0 && axis[i] < 3 ? 1 << axis[i] : 0;
        if (seen == 7) {
            memset(m, 0, sizeof m);
            m[0][axis[0]] = meta_sign(import, "CoordAxisSign");
            m[1][axis[1]] = meta_sign(import, "UpAxisSign");
            m[2][axis[2]] = meta_sign(import, "FrontAxisSign");
            bool even = axis[1] == (axis[0] + 1) % 3;
            float determinant =
                m[0][axis[0]] * m[1][axis[1]] * m[2][axis[2]] * (even ? 1.0f : -1.0f);
            if (determinant < 0.0f) m[2][axis[2]] = -m[2][axis[2]]; /* no mirroring */
        }
    }
    if (up == GN_IMPORT_UP_Z) {
        m[1][1] = m[2][2] = 0.0f;
        m[1][2] = 1.0f;
        m[2][1] = -1.0f;
    }
    if (import->format == GN_MODEL_FBX) /* centimetres per unit */
        scale = 0.01f * meta_number(import, "UnitScaleFactor", 1.0f);
    if (!isfinite(scale) || scale <= 0.0f) scale = 0.01f;
    for (int i = 0; i < 9; i++) m[i / 3][i % 3] *= scale;
    return (struct aiMatrix4x4){m[0][0], m[0][1], m[0][2], 0.0f, m[1][0], m[1][1], m[1][2], 0.0f,
                                m[2][0], m[2][1], m[2][2], 0.0f, 0.0f,    0.0f,    0.0f,    1.0f};
}

/* ---- nodes ---- */

static void grow_box(struct gn_import *import, const struct aiMatrix4x4 *m,
                     const struct aiAABB *box) {
    for (int corner = 0; corner < 8; corner++) {
        struct aiVector3D p = {corner & 1 ? box->mMax.x : box->mMin.x,
                               corner & 2 ? box->mMax.y : box->mMin.y,
                               corner & 4 ? box->mMax.z : box->mMin.z};
        float at[3] = {m->a1 * p.x + m->a2 * p.y + m->a3 * p.z + m->a4,
                       m->b1 * p.x + m->b2 * p.y + m->b3 * p.z + m->b4,
                       m->c1 * p.x + m->c2 * p.y + m->c3 * p.z + m->c4};
        for (int k = 0; k < 3 && isfinite(at[0] + at[1] + at[2]); k++) {
            import->low[k] = fminf(import->low[k], at[k]);
            import->high[k] = fmaxf(import->high[k], at[k]);
        }
    }
}

static void queue_node(struct gn_import *import, const struct aiNode *node,
                       struct aiMatrix4x4 world_from_parent) {
    if (import->node_count == import->node_room) {
        import->node_room = 2 * import->node_room + 64;
        import->nodes = gn_import_grow(import->nodes, import->node_room * sizeof *import->nodes);
    }
    aiMultiplyMatrix4(&world_from_parent, &node->mTransformation);
    import->nodes[import->node_count++] = (struct gn_import_node){node, world_from_parent};
}

/* Breadth first: the index in the queue is the glTF node index, and depth needs no recursion. */
static void add_nodes(struct gn_import *import) {
    queue_node(import, import->scene->mRootNode, world_from_model(import));
    for (size_t i = 0; i < import->node_count; i++) {
        const struct gn_import_node at = import->nodes[i];
        const struct aiNode *node = at.node;
        const struct aiMatrix4x4 *matrix =
            node->mParent ? &node->mTransformation : &at.world_from_node;
        json_t *object = json_pack("{s:o,s:o}", "name", gn_glb_text(node->mName.data), "matrix",
                                   gn_import_matrix(matrix));
        int mesh = gn_import_mesh(import, node);
        if (mesh >= 0) json_object_set_new(object, "mesh", json_integer(mesh));
        for (unsigned k = 0; mesh >= 0 && k < node->mNumMeshes; k++)
            if (node->mMeshes[k] < import->scene->mNumMeshes)
                grow_box(import, &at.world_from_node,
                         &import->scene->mMeshes[node->mMeshes[k]]->mAABB);
        json_t *children = json_array();
        for (unsigned k = 0; k < node->mNumChildren; k++) {
            json_array_append_new(children, json_integer((json_int_t)import->node_count));
            queue_node(import, node->mChildren[k], at.world_from_node);
        }
        if (node->mNumChildren) json_object_set(object, "children", children);
        json_decref(children);
        gn_glb_add(&import->glb, "nodes", object);
    }
}

bool gn_import_scene_build(struct gn_import *import) {
    /* for the reason why it cannot be read, which assimp does not have */
    struct gn_bytes model;
    if (!gn_import_model_read(import, &model, import->err)) return false;
    const bool ok = import->format != GN_MODEL_PLY || gn_import_ply_check(import, &model);
    gn_bytes_finish(&model);
    if (!ok || !read_scene(import)) return false;
    const struct aiScene *scene = import->scene;
    if (!scene->mRootNode)
        return gn_fail(import->err, "%s: no scene in the file", import->opts->model);

    import->primitives = gn_import_alloc((scene->mNumMeshes + 1) * sizeof(json_t *));
    import->meshes = gn_import_alloc((scene->mNumMeshes + 1) * sizeof(int));
    import->materials = gn_import_alloc((scene->mNumMaterials + 1) * sizeof(int));
    for (unsigned i = 0; i < scene->mNumMeshes; i++) import->meshes[i] = GN_IMPORT_UNSEEN;
    for (unsigned i = 0; i < scene->mNumMaterials; i++) import->materials[i] = GN_IMPORT_UNSEEN;
    for (int k = 0; k < 3; k++) {
        import->low[k] = INFINITY;
        import->high[k] = -INFINITY;
    }

    json_object_set_new(import->glb.root, "scene", json_integer(0));
    gn_glb_add(&import->glb, "scenes", json_pack("{s:[i]}", "nodes", 0));
    add_nodes(import);
    if (!json_object_get(import->glb.root, "meshes")) return fail_empty(import);
    if (!import->has_area)
        return gn_fail(import->err,
                       "%s: no triangle has an area: each has its corners on one line; export it "
                       "again",
                       import->opts->model);
    gn_import_lights(import);
    gn_import_cameras(import);
    return true;
}
