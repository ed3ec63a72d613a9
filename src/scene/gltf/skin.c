/* Skins of the nodes that are shown, the weights of morph targets, and where the pose writes what
 * vertex shaders fetch of them. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { UNSEEN = -1, DROPPED = -2 };
enum { COPIES = 4 }; /* of its texels: the pose's, and three on the GPU */

/* ---- strips -------------------------------------------------------------------------------- */

bool gn_gltf_strip(struct gn_gltf *g, const struct gn_at *at, uint32_t rows, struct gn_strip *out) {
    struct gn_scene_deformation *d = &g->scene->deformation;
    if (d->column_height + rows > GN_JOINTS_MAX) {
        d->column++;
        d->column_height = 0;
    }
    if ((d->column + 1) * GN_STRIP_WIDTH > GN_POSE_WIDTH_MAX)
        return gn_gltf_fail(g, at, "more joints and morph targets than %d in all",
                            GN_POSE_WIDTH_MAX / GN_STRIP_WIDTH * GN_JOINTS_MAX);
    *out = (struct gn_strip){(uint16_t)(d->column * GN_STRIP_WIDTH), (uint16_t)d->column_height};
    d->column_height += rows;
    d->width = (d->column + 1) * GN_STRIP_WIDTH;
    if (d->column_height > d->height) d->height = d->column_height;
    return gn_gltf_count(g, (uint64_t)rows * GN_STRIP_WIDTH * COPIES * sizeof(vec4));
}

/* ---- skins --------------------------------------------------------------------------------- */

/* The file's inverse bind matrices of a skin; identities where it has none, or no finite ones. */
static bool read_bind_matrices(struct gn_gltf *g, const struct gn_at *skin, struct gn_joint *joints,
                               uint32_t count) {
    const int32_t index =
        gn_at_ref(g, skin, "inverseBindMatrices", g->file.accessor_count, "accessors");
    const struct gn_accessor *a = gn_gltf_accessor(g, index);
    struct gn_at at = gn_at_any(skin, "inverseBindMatrices");
    for (uint32_t i = 0; i < count; i++) glm_mat4_identity(joints[i].joint_from_mesh);
    if (g->failed || !a) return !g->failed;
    if (a->components != 16 || a->component != GN_F32)
        return gn_gltf_fail(g, &at, "accessor %d must be MAT4 of floats", index);
    if (a->count < count)
        return gn_gltf_fail(g, &at, "%zu matrices, but there are %" PRIu32 " joints", a->count,
                            count);
    bool finite = true;
    for (uint32_t i = 0; i < count; i++) {
        mat4 m;
        gn_accessor_gather(a, 16, &i, 1, m[0]);
        bool right = true;
        for (int k = 0; k < 16; k++) right &= fabsf(m[k / 4][k % 4]) < 1e18f;
        if (right) glm_mat4_copy(m, joints[i].joint_from_mesh);
        finite &= right;
    }
    if (!finite) gn_gltf_warn(g, &at, "some are not finite; taken as identity");
    return true;
}

/* Adds a skin of the file to the scene, whole or not at all. */
static bool add_skin(struct gn_gltf *g, const struct gn_at *at) {
    struct gn_scene_deformation *d = &g->scene->deformation;
    struct gn_skin *skin = &d->skins[d->skin_count];
    struct gn_at list = gn_at_array(g, at, "joints");
    const size_t count = gn_at_size(&list);
    if (g->failed) return false;
    if (count == 0) return gn_gltf_fail(g, at, "has no joints");
    if (count > GN_JOINTS_MAX)
        return gn_gltf_fail(g, &list, "%zu are more than %d joints", count, GN_JOINTS_MAX);
    *skin = (struct gn_skin){.first_joint = d->joint_count, .joint_count = (uint32_t)count};
    struct gn_joint *joints = &d->joints[d->joint_count];
    bool outside = false;
    for (size_t i = 0; i < count; i++) {
        struct gn_at joint = gn_at_element(&list, i);
        const int32_t node = gn_at_ref_here(g, &joint, g->file.node_count, "nodes");
        if (g->failed) return false;
        joints[i].node = node < 0 ? -1 : g->to_scene.node[node];
        outside |= joints[i].node < 0;
    }
    if (outside)
        gn_gltf_warn(g, &list, "some are not in the scene that is shown; they do not move");
    if (!read_bind_matrices(g, at, joints, (uint32_t)count) ||
        !gn_gltf_strip(g, &list, (uint32_t)count, &skin->rows))
        return false;
    d->joint_count += (uint32_t)count;
    d->skin_count++;
    return true;
}

static bool find_skin(struct gn_gltf *g, struct gn_placed *placed) {
    struct gn_at root = gn_at_root(g), skins = gn_at_array(g, &root, "skins");
    int32_t *known = &g->to_scene.skin[placed->skin];
    if (*known == UNSEEN) {
        struct gn_at at = gn_at_element(&skins, (size_t)placed->skin);
        *known = (int32_t)g->scene->deformation.skin_count;
        add_skin(g, &at);
        if (gn_gltf_spare(g, "shown without it")) *known = DROPPED;
    }
    placed->skin = *known < 0 ? -1 : *known;
    return !g->failed;
}

/* ---- weights ------------------------------------------------------------------------------- */

/* Of the node, else of its mesh, else 0. */
static void read_weights(struct gn_gltf *g, const struct gn_placed *placed, uint32_t count,
                         float *out) {
    struct gn_at root = gn_at_root(g), nodes = gn_at_any(&root, "nodes"),
                 meshes = gn_at_any(&root, "meshes");
    struct gn_at node = gn_at_element(&nodes, placed->json),
                 mesh = gn_at_element(&meshes, (size_t)placed->mesh);
    struct gn_at list = gn_at_array(g, &node, "weights");
    if (!list.json) list = gn_at_array(g, &mesh, "weights");
    gn_gltf_spare(g, "ignored");
    if (g->failed || gn_at_size(&list) == 0) return;
    const size_t given = gn_at_size(&list);
    if (given != count)
        gn_gltf_warn(g, &list, "%zu weights, but there are %" PRIu32 " morph targets; %s", given,
                     count, given > count ? "the others are ignored" : "0 for the others");
    gn_at_first_floats(g, &list, count, out);
}

static bool add_morph(struct gn_gltf *g, uint32_t node) {
    struct gn_scene_deformation *d = &g->scene->deformation;
    struct gn_placed *placed = &g->placed[node];
    const uint32_t count = g->file.meshes[placed->mesh].target_count;
    struct gn_morphed *morph = &d->morphs[d->morph_count];
    struct gn_at root = gn_at_root(g), meshes = gn_at_any(&root, "meshes");
    *morph =
        (struct gn_morphed){.node = node, .first_weight = d->weight_count, .weight_count = count};
    read_weights(g, placed, count, &d->weights[d->weight_count]);
    if (g->failed || !gn_gltf_strip(g, &meshes, count, &morph->list)) return false;
    placed->morph = (int32_t)d->morph_count++;
    d->weight_count += count;
    return true;
}

/* ---- all ----------------------------------------------------------------------------------- */

static bool allocate_deformation(struct gn_gltf *g) {
    struct gn_scene_deformation *d = &g->scene->deformation;
    struct gn_at root = gn_at_root(g), skins = gn_at_array(g, &root, "skins");
    uint64_t joints = 0, morphs = 0, weights = 0;
    GN_NEW(g, &g->memory.load, g->to_scene.skin, g->file.skin_count);
    bool *wanted = gn_gltf_alloc(g, &g->memory.load, g->file.skin_count, sizeof *wanted);
    if (g->failed) return false;
    for (uint32_t i = 0; i < g->scene->node_count; i++) {
        const struct gn_placed *placed = &g->placed[i];
        if (placed->mesh < 0) continue;
        const uint32_t targets = g->file.meshes[placed->mesh].target_count;
        if (placed->skin >= 0) wanted[placed->skin] = true;
        morphs += targets > 0;
        weights += targets;
    }
    for (size_t i = 0; i < g->file.skin_count; i++) {
        struct gn_at at = gn_at_element(&skins, i), list = gn_at_any(&at, "joints");
        const size_t count = gn_at_size(&list);
        g->to_scene.skin[i] = UNSEEN;
        if (wanted[i]) joints += count < GN_JOINTS_MAX ? count : GN_JOINTS_MAX;
    }
    GN_NEW(g, g->memory.scene, d->skins, g->file.skin_count);
    GN_NEW(g, g->memory.scene, d->joints, joints);
    GN_NEW(g, g->memory.scene, d->morphs, morphs);
    GN_NEW(g, g->memory.scene, d->weights, weights);
    return !g->failed;
}

bool gn_gltf_skins(struct gn_gltf *g) {
    if (!allocate_deformation(g)) return false;
    for (uint32_t i = 0; i < g->scene->node_count; i++) {
        struct gn_placed *placed = &g->placed[i];
        if (placed->mesh < 0) continue;
        if (placed->skin >= 0 && !find_skin(g, placed)) return false;
        if (g->file.meshes[placed->mesh].target_count > 0 && !add_morph(g, i)) return false;
    }
    return true;
}

bool gn_gltf_deform_item(struct gn_gltf *g, struct gn_item *item) {
    const struct gn_placed *placed = &g->placed[item->node];
    struct gn_geometry *geometry = &g->scene->geometries[item->geometry];
    struct gn_at root = gn_at_root(g), nodes = gn_at_any(&root, "nodes");
    struct gn_at at = gn_at_element(&nodes, placed->json);
    item->skin = geometry->joint_box_count > 0 ? placed->skin : -1;
    item->morph = geometry->targets ? placed->morph : -1;
    if (item->skin >= 0) {
        const struct gn_skin *skin = &g->scene->deformation.skins[item->skin];
        const uint32_t last = geometry->joint_boxes[geometry->joint_box_count - 1].joint;
        item->rows = skin->rows;
        if (last >= skin->joint_count) {
            gn_gltf_warn(g, &at,
                         "a vertex of its mesh is of joint %" PRIu32 ", but its skin has %" PRIu32
                         " joints; shown without it",
                         last, skin->joint_count);
            item->skin = -1;
        }
    }
    if (!gn_item_is_deformed(item)) return true;
    geometry->flat = false;
    return item->skin >= 0 || gn_gltf_strip(g, &at, 1, &item->rows);
}
