/* Scenes far from the origin of their file: which point becomes that of world space, and what is
 * taken off the positions of meshes. Floats resolve a scene well up to FAR times its size away: to
 * 6e-6 of it there. Anything nearer stays exactly as it is. */
#include <math.h>

#include "scene/exact.h"
#include "scene/private.h"

static const double FAR = 100;
enum { SAMPLES = 4096 }; /* of the positions of an accessor */

struct bounds {
    double min[3], max[3];
};
static const struct bounds NOTHING = {{INFINITY, INFINITY, INFINITY},
                                      {-INFINITY, -INFINITY, -INFINITY}};

struct survey {
    struct gn_gltf *g;
    struct gn_exact *world_from_node;
    double *reach;           /* by node: how far the farthest of it and of those over it stands */
    struct bounds *accessor; /* of its positions, mesh space, where `seen` */
    bool *seen;
    struct bounds all; /* world space */
    bool warned;
};

static void add_point(struct bounds *bounds, const double p[3]) {
    for (int k = 0; k < 3; k++) {
        bounds->min[k] = fmin(bounds->min[k], p[k]);
        bounds->max[k] = fmax(bounds->max[k], p[k]);
    }
}

static double middle_of(const struct bounds *bounds, int k) {
    return (bounds->min[k] + bounds->max[k]) / 2;
}

static double size_of(const struct bounds *bounds) {
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += pow(bounds->max[k] - bounds->min[k], 2);
    return sqrt(sum);
}

/* ---- meshes -------------------------------------------------------------------------------- */

/* Looks at some positions, spread evenly, so that its work does not grow with the accessor, which
 * many meshes of a few triangles may share. */
static void measure_accessor(struct survey *s, int32_t index) {
    const struct gn_accessor *a = gn_gltf_accessor(s->g, index);
    if (!a || s->seen[index]) return;
    s->seen[index] = true;
    s->accessor[index] = NOTHING;
    const size_t count = a->count < SAMPLES ? a->count : SAMPLES;
    for (size_t i = 0; i < count; i++) {
        const uint32_t vertex = (uint32_t)((uint64_t)i * a->count / count);
        float p[3] = {0, 0, 0};
        gn_accessor_gather(a, 3, &vertex, 1, p);
        const double point[3] = {(double)p[0], (double)p[1], (double)p[2]};
        if (fabsf(p[0]) < 1e18f && fabsf(p[1]) < 1e18f && fabsf(p[2]) < 1e18f)
            add_point(&s->accessor[index], point);
    }
}

static const struct gn_shape *shape_of(const struct gn_gltf *g, const struct gn_mesh *mesh,
                                       uint32_t i) {
    return &g->primitives.shapes[g->primitives.list[mesh->first_primitive + i].geometry];
}

/* The corners of the bounds of a mesh in one of its places. */
static void add_box(struct survey *s, const struct gn_exact *world_from_mesh,
                    const struct bounds *box) {
    for (int corner = 0; corner < 8 && box->min[0] <= box->max[0]; corner++) {
        double p[3];
        for (int r = 0; r < 3; r++) {
            p[r] = world_from_mesh->m[3][r];
            for (int k = 0; k < 3; k++)
                p[r] += world_from_mesh->m[k][r] * (corner >> k & 1 ? box->max[k] : box->min[k]);
        }
        add_point(&s->all, p);
    }
}

/* Where the mesh of a node stands: itself, as each of its copies, or by its first joint. */
static struct gn_exact place_of(const struct survey *s, uint32_t node, uint32_t copy) {
    const struct gn_scene *scene = s->g->scene;
    const struct gn_placed *placed = &s->g->placed[node];
    struct gn_exact within;
    if (placed->skin >= 0) {
        const struct gn_joint *joint =
            &scene->deformation.joints[scene->deformation.skins[placed->skin].first_joint];
        within = gn_exact_from((vec4 *)joint->joint_from_mesh);
        return joint->node < 0 ? within : gn_exact_mul(&s->world_from_node[joint->node], &within);
    }
    if (placed->instance_count == 0) return s->world_from_node[node];
    within = gn_exact_from(scene->instances[placed->first_instance + copy]);
    return gn_exact_mul(&s->world_from_node[node], &within);
}

static void add_mesh(struct survey *s, uint32_t node) {
    const struct gn_placed *placed = &s->g->placed[node];
    const struct gn_mesh *mesh = &s->g->file.meshes[placed->mesh];
    const uint32_t copies =
        placed->instance_count > 0 && placed->skin < 0 ? placed->instance_count : 1;
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const int32_t index = shape_of(s->g, mesh, i)->attribute[GN_ATTRIBUTE_POSITION];
        measure_accessor(s, index);
        for (uint32_t k = 0; k < copies && index >= 0 && s->seen[index]; k++) {
            const struct gn_exact place = place_of(s, node, k);
            add_box(s, &place, &s->accessor[index]);
        }
    }
}

/* ---- the scene ----------------------------------------------------------------------------- */

static void survey_nodes(struct survey *s) {
    const struct gn_scene *scene = s->g->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const struct gn_node *node = &scene->nodes[i];
        struct gn_exact *world = &s->world_from_node[i];
        *world = gn_exact_of(node);
        if (node->parent >= 0) *world = gn_exact_mul(&s->world_from_node[node->parent], world);
        for (int k = 0; k < 3; k++) s->reach[i] = fmax(s->reach[i], fabs(world->m[3][k]));
        if (node->parent >= 0) s->reach[i] = fmax(s->reach[i], s->reach[node->parent]);
    }
}

/* A round number near the middle along an axis, if that is far off: small whole offsets stay what
 * they are. */
static double choose_origin(const struct bounds *bounds, int k) {
    const double size = size_of(bounds), middle = middle_of(bounds, k);
    if (!(fabs(middle) > FAR * size) || !(fabs(middle) < 1e18)) return 0;
    if (!(size > 0)) return middle;
    const double step = exp2(floor(log2(size)));
    return step * round(middle / step);
}

/* A mesh whose joints bring it back from far off: they would have to know of an origin that was
 * taken off, so it stays, in steps of floats. */
static void warn_of_skin(struct survey *s, uint32_t node, const struct bounds *box) {
    const struct gn_placed *placed = &s->g->placed[node];
    struct gn_at root = gn_at_root(s->g), meshes = gn_at_any(&root, "meshes");
    struct gn_at mesh = gn_at_element(&meshes, (size_t)placed->mesh);
    double away = 0;
    for (int k = 0; k < 3; k++) away = fmax(away, fabs(middle_of(box, k)));
    if (s->warned || !(away > FAR * size_of(box)) || !(away < 1e18)) return;
    s->warned = true;
    gn_gltf_warn(s->g, &mesh,
                 "is %.3g m large and lies %.3g m off in its own coordinates, from where its skin "
                 "brings it back: its vertices are in steps of %.2g m. Apply its transform before "
                 "it is bound",
                 size_of(box), away, exp2(floor(log2(away)) - 23));
}

/* Takes something off the positions of the meshes of a node that its own transform brings back,
 * or moves further off. Those of skins stay. */
static bool choose_mesh_origins(struct survey *s, uint32_t node, double size) {
    struct gn_gltf *g = s->g;
    const struct gn_mesh *mesh = &g->file.meshes[g->placed[node].mesh];
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const struct gn_shape *shape = shape_of(g, mesh, i);
        const int32_t index = shape->attribute[GN_ATTRIBUTE_POSITION];
        if (index < 0 || !s->seen[index] || g->file.origins[index]) continue;
        if (shape->attribute[GN_ATTRIBUTE_JOINTS0] >= 0) {
            if (g->placed[node].skin >= 0) warn_of_skin(s, node, &s->accessor[index]);
            continue;
        }
        const struct gn_exact place = place_of(s, node, 0);
        bool far = false;
        for (int r = 0; r < 3; r++) {
            double away = 0;
            for (int k = 0; k < 3; k++) away += place.m[k][r] * middle_of(&s->accessor[index], k);
            far |= fabs(away) > FAR * size;
        }
        if (!far) continue;
        double *origin = gn_gltf_alloc(g, g->memory.scene, 3, sizeof *origin);
        if (!origin) return false;
        for (int k = 0; k < 3; k++) origin[k] = choose_origin(&s->accessor[index], k);
        g->file.origins[index] = origin;
        g->scene->place.exact = true;
    }
    return true;
}

bool gn_gltf_far(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct survey s = {.g = g, .all = NOTHING};
    GN_NEW(g, &g->memory.load, s.world_from_node, scene->node_count);
    GN_NEW(g, &g->memory.load, s.reach, scene->node_count);
    GN_NEW(g, &g->memory.load, s.accessor, g->file.accessor_count);
    GN_NEW(g, &g->memory.load, s.seen, g->file.accessor_count);
    GN_NEW(g, &g->memory.load, g->file.origins, g->file.accessor_count);
    if (g->failed) return false;
    survey_nodes(&s);
    for (uint32_t i = 0; i < scene->node_count && !g->failed; i++)
        if (g->placed[i].mesh >= 0 && gn_gltf_check_time(g)) add_mesh(&s, i);
    const double size = size_of(&s.all);
    if (g->failed || !(size > 0) || !(size < 1e18)) return !g->failed;
    for (int k = 0; k < 3; k++) {
        scene->place.origin[k] = choose_origin(&s.all, k);
        scene->place.exact |= scene->place.origin[k] != 0;
    }
    for (uint32_t i = 0; i < scene->node_count && !g->failed; i++) {
        if (g->placed[i].mesh < 0) continue;
        scene->place.exact |= s.reach[i] > FAR * size;
        choose_mesh_origins(&s, i, size);
    }
    return !g->failed;
}
