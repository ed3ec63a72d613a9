/* The node tree: checks it, keeps the nodes of the shown scene, and orders them parents first,
 * without recursion. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <inttypes.h>
#include <string.h>

/* A node of the file. */
struct source {
    int32_t parent;
    bool shown; /* the scene lists it or one of its ancestors */
    bool kept;  /* shown, or an ancestor of a shown one */
    bool queued;
    uint8_t mark; /* while looking for cycles */
};

struct tree {
    struct gn_gltf *g;
    struct gn_at array; /* nodes */
    struct source *sources;
    int32_t *stack;
    size_t depth, count;
};

/* -1: none, which is named. */
static int32_t child_at(struct tree *tree, const struct gn_at *children, size_t i) {
    struct gn_at at = gn_at_element(children, i);
    const int32_t child = gn_at_ref_here(tree->g, &at, tree->count, "nodes");
    gn_gltf_spare(tree->g, "ignored");
    return child;
}

/* ---- parents and cycles ---- */

static bool read_tree(struct tree *tree) {
    struct gn_gltf *g = tree->g;
    if (tree->count > g->limits.nodes)
        return gn_gltf_fail(g, &tree->array, "%zu are more than the limit nodes=%" PRIu64,
                            tree->count, g->limits.nodes);
    GN_NEW(g, &g->memory.load, tree->sources, tree->count);
    GN_NEW(g, &g->memory.load, tree->stack, tree->count);
    GN_NEW(g, &g->memory.load, g->to_scene.node, tree->count);
    if (!tree->sources || !tree->stack || !g->to_scene.node) return false;
    for (size_t i = 0; i < tree->count; i++) {
        tree->sources[i].parent = -1;
        g->to_scene.node[i] = -1;
    }
    for (size_t i = 0; i < tree->count && !g->failed; i++) {
        struct gn_at node = gn_at_element(&tree->array, i);
        struct gn_at children = gn_at_array(g, &node, "children");
        gn_gltf_spare(g, "ignored");
        for (size_t k = 0; k < gn_at_size(&children) && !g->failed; k++) {
            int32_t child = child_at(tree, &children, k);
            if (child < 0) continue;
            if (tree->sources[child].parent < 0)
                tree->sources[child].parent = (int32_t)i;
            else
                gn_gltf_warn(g, &children, "node %d has two parents; shown under the first, %d",
                             child, tree->sources[child].parent);
        }
    }
    return !g->failed;
}

/* Follows the parents of each node; mark 1: on the current path, 2: known to reach a root. The
 * first node of a cycle becomes a root. */
static void cut_cycles(struct tree *tree) {
    for (size_t i = 0; tree->sources && i < tree->count; i++) {
        int32_t first = (int32_t)i, n = first;
        for (; first >= 0 && tree->sources[first].mark == 0; first = tree->sources[first].parent)
            tree->sources[first].mark = 1;
        const bool cycle = first >= 0 && tree->sources[first].mark == 1;
        for (; n >= 0 && tree->sources[n].mark == 1; n = tree->sources[n].parent)
            tree->sources[n].mark = 2;
        if (!cycle) continue;
        struct gn_at at = gn_at_element(&tree->array, (size_t)first);
        gn_gltf_warn(tree->g, &at, "is its own ancestor; shown as if it had no parent");
        tree->sources[first].parent = -1;
    }
}

/* ---- walking the tree ---- */

static void push_node(struct tree *tree, int32_t node) {
    if (tree->sources[node].queued) return;
    tree->sources[node].queued = true;
    tree->stack[tree->depth++] = node;
}

/* In reverse, so that the first child is popped first. */
static void push_children(struct tree *tree, int32_t node) {
    struct gn_at at = gn_at_element(&tree->array, (size_t)node);
    struct gn_at children = gn_at_any(&at, "children");
    for (size_t i = gn_at_size(&children); i-- > 0;) {
        int32_t child = child_at(tree, &children, i);
        if (child >= 0 && tree->sources[child].parent == node) push_node(tree, child);
    }
}

/* ---- the nodes of the scene ---- */

/* What the floats of a translation lack of the numbers in the file. */
static void read_rest(const struct gn_at *at, struct gn_node *node) {
    const struct gn_at array = gn_at_any(at, node->has_matrix ? "matrix" : "translation");
    const float *whole = node->has_matrix ? node->matrix[3] : node->translation;
    for (size_t k = 0; k < 3; k++) {
        double value = 0;
        const json_t *number = json_array_get(array.json, (node->has_matrix ? 12 : 0) + k);
        if (gn_json_number(number, &value)) node->rest[k] = (float)(value - (double)whole[k]);
    }
}

static void read_transform(struct gn_gltf *g, const struct gn_at *at, struct gn_node *node) {
    glm_mat4_identity(node->matrix);
    glm_vec3_one(node->scale);
    glm_quat_identity(node->rotation);
    float m[16];
    node->has_matrix = gn_at_floats(g, at, "matrix", 16, m);
    if (node->has_matrix) memcpy(node->matrix, m, sizeof m);
    if (node->has_matrix && (gn_at_any(at, "translation").json || gn_at_any(at, "rotation").json ||
                             gn_at_any(at, "scale").json))
        gn_gltf_warn(g, at, "has a matrix, and translation, rotation or scale: the matrix is used");
    gn_at_floats(g, at, "translation", 3, node->translation);
    gn_at_floats(g, at, "scale", 3, node->scale);
    read_rest(at, node);
    if (!gn_at_floats(g, at, "rotation", 4, node->rotation)) return;
    float length = glm_vec4_norm(node->rotation);
    if (length > 1e-6f && length < 1e18f) {
        glm_vec4_scale(node->rotation, 1 / length, node->rotation);
        return;
    }
    struct gn_at place = gn_at_any(at, "rotation");
    gn_gltf_warn(g, &place, "is not a rotation; ignored");
    glm_quat_identity(node->rotation);
}

/* Adds the kept nodes of the tree of a node to the scene, parents first. roots: of the nodes above
 * which the root is known, else -1. */
static void add_tree(struct tree *tree, int32_t listed, int32_t *roots) {
    struct gn_gltf *g = tree->g;
    int32_t root = listed;
    while (tree->sources[root].parent >= 0 && roots[root] < 0) root = tree->sources[root].parent;
    if (roots[root] >= 0) root = roots[root];
    for (int32_t n = listed; n >= 0 && roots[n] < 0; n = tree->sources[n].parent) roots[n] = root;
    push_node(tree, root);
    while (tree->depth > 0 && !g->failed) {
        int32_t source = tree->stack[--tree->depth], parent = tree->sources[source].parent;
        if (!tree->sources[source].kept) continue;
        struct gn_at at = gn_at_element(&tree->array, (size_t)source);
        uint32_t index = g->scene->node_count++;
        struct gn_node *node = &g->scene->nodes[index];
        struct gn_placed *placed = &g->placed[index];
        g->to_scene.node[source] = (int32_t)index;
        node->parent = parent < 0 ? -1 : g->to_scene.node[parent];
        node->name = gn_gltf_strdup(g, gn_at_name(g, &at));
        read_transform(g, &at, node);
        placed->json = (size_t)source;
        placed->bare = !tree->sources[source].shown;
        placed->mesh = gn_at_spare_ref(g, &at, "mesh", g->file.mesh_count, "meshes");
        if (placed->bare) placed->mesh = -1;
        if (placed->mesh >= 0) g->file.meshes[placed->mesh].used = true;
        placed->skin = gn_at_spare_ref(g, &at, "skin", g->file.skin_count, "skins");
        placed->morph = -1;
        if (placed->mesh >= 0 && placed->skin >= 0) g->file.meshes[placed->mesh].skinned = true;
        gn_extras_node(g, &at, placed);
        push_children(tree, source);
    }
}

/* The nodes that the scene lists, or all roots, each once, in this order. Marks them and their
 * descendants as shown, their ancestors as kept. */
static size_t find_listed(struct tree *tree, const struct gn_at *list, bool all, int32_t *out) {
    size_t count = 0;
    for (size_t i = 0; !all && i < gn_at_size(list); i++) {
        int32_t node = child_at(tree, list, i);
        if (node < 0 || tree->sources[node].queued) continue;
        tree->sources[node].queued = true;
        if (tree->sources[node].parent >= 0)
            gn_gltf_warn(tree->g, list, "node %d has a parent; shown in its place under it", node);
        out[count++] = node;
    }
    for (size_t i = 0; all && i < tree->count; i++)
        if (tree->sources[i].parent < 0) out[count++] = (int32_t)i;

    for (size_t i = 0; i < tree->count; i++) tree->sources[i].queued = false;
    for (size_t i = 0; i < count; i++) {
        push_node(tree, out[i]);
        while (tree->depth > 0) {
            int32_t node = tree->stack[--tree->depth];
            tree->sources[node].shown = tree->sources[node].kept = true;
            push_children(tree, node);
        }
        for (int32_t n = tree->sources[out[i]].parent; n >= 0 && !tree->sources[n].kept;
             n = tree->sources[n].parent)
            tree->sources[n].kept = true;
    }
    return count;
}

bool gn_gltf_nodes(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), scenes = gn_at_array(g, &root, "scenes");
    struct tree tree = {.g = g, .array = gn_at_array(g, &root, "nodes")};
    tree.count = gn_at_size(&tree.array);
    if (g->failed) return false;
    struct gn_at meshes = gn_at_array(g, &root, "meshes"), skins = gn_at_array(g, &root, "skins");
    g->file.skin_count = gn_at_size(&skins);
    g->file.mesh_count = gn_at_size(&meshes);
    g->file.node_count = tree.count;
    GN_NEW(g, &g->memory.load, g->file.meshes, g->file.mesh_count);
    GN_NEW(g, g->memory.scene, g->scene->nodes, tree.count + GN_ADDED_NODES);
    GN_NEW(g, &g->memory.load, g->placed, tree.count + GN_ADDED_NODES);
    if (g->failed || !read_tree(&tree)) return false;
    cut_cycles(&tree);

    int32_t *listed = gn_gltf_alloc(g, &g->memory.load, tree.count, sizeof *listed);
    int32_t *roots = gn_gltf_alloc(g, &g->memory.load, tree.count, sizeof *roots);
    int32_t shown = gn_at_spare_ref(g, &root, "scene", gn_at_size(&scenes), "scenes");
    struct gn_at scene = {0};
    if (gn_at_size(&scenes) > 0) scene = gn_at_element(&scenes, shown < 0 ? 0 : (size_t)shown);
    struct gn_at list = gn_at_array(g, &scene, "nodes");
    gn_gltf_spare(g, "ignored");
    if (g->failed || !tree.sources || !listed || !roots) return false;
    g->scene->name = gn_gltf_strdup(g, gn_at_name(g, &scene));
    gn_extras_scene(g, &scene);
    size_t count = find_listed(&tree, &list, scene.json == NULL, listed);
    for (size_t i = 0; i < tree.count; i++) {
        tree.sources[i].queued = false;
        roots[i] = -1;
    }
    for (size_t i = 0; i < count && !g->failed; i++) add_tree(&tree, listed[i], roots);
    if (!g->failed && g->scene->node_count == 0)
        return gn_gltf_fail_empty(g, scene.json ? &scene : &tree.array, "there is no node");
    return !g->failed;
}
