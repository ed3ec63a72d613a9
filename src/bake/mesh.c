/* The grid of each mesh, and its primitives. */
#include <math.h>
#include <string.h>

#include "bake/private.h"

enum { STEPS = 65535 }; /* of a grid that 16 bits hold */
/* What undoes a grid takes 80 bytes of JSON in each node, and shorts save a vertex about 2 more
 * than floats do on the same grid. */
enum { NODE_VERTICES = 40 };

struct bounds {
    double low[3], high[3];
};

/* Which vertices the triangles of a primitive have, one byte each: an accessor may hold those of
 * other meshes, too, or some of no mesh, which lie anywhere. NULL: failed. */
static const uint8_t *find_used(struct gn_baker *b, const json_t *primitive, size_t count) {
    uint8_t *used = gn_bake_alloc(b, count + 1, sizeof *used);
    const int64_t index = gn_bake_number(primitive, "indices");
    struct gn_elements e = {0};
    if (!used) return NULL;
    if (index < 0) return memset(used, 1, count);
    uint32_t *vertices = gn_document_accessor(b->in, (size_t)index, &e)
                             ? gn_bake_alloc(b, e.count + 1, sizeof *vertices)
                             : NULL;
    if (!vertices || !gn_document_indices(b->in, (size_t)index, vertices)) {
        b->failed = true;
        return NULL;
    }
    for (size_t i = 0; i < e.count; i++)
        if (vertices[i] < count) used[vertices[i]] = 1; /* others are an error: primitive.c */
    return used;
}

/* False: not finite, or no positions of floats. */
static bool add_positions(const struct gn_elements *e, const uint8_t *used, struct bounds *bounds) {
    if (e->components != 3 || e->component != GN_COMPONENT_F32) return false;
    for (size_t i = 0; i < e->count; i++) {
        float p[3];
        memcpy(p, e->data + i * e->stride, sizeof p);
        for (int k = 0; used[i] && k < 3; k++) {
            if (!(fabsf(p[k]) < 1e18f)) return false;
            bounds->low[k] = fmin(bounds->low[k], (double)p[k]);
            bounds->high[k] = fmax(bounds->high[k], (double)p[k]);
        }
    }
    return true;
}

/* Whether the nodes of a mesh can undo a grid, by mesh: nodes without a skin or instances; and how
 * many they are. */
static void find_movable(const struct gn_baker *b, bool *movable, size_t *users,
                         size_t mesh_count) {
    const json_t *node;
    size_t i;
    json_array_foreach(json_object_get(b->root, "nodes"), i, node) {
        const int64_t mesh = gn_bake_number(node, "mesh");
        if (mesh < 0 || (uint64_t)mesh >= mesh_count) continue;
        movable[mesh] &=
            !json_object_get(node, "skin") && !gn_bake_extension(node, "EXT_mesh_gpu_instancing");
        users[mesh]++;
    }
}

/* False: of no size, or so far off for its size that the grid's numbers would not be exact. */
static bool fit_grid(struct gn_grid *grid, const struct bounds *bounds) {
    double size = 0, far = 0;
    for (int k = 0; k < 3; k++) {
        size = fmax(size, bounds->high[k] - bounds->low[k]);
        far = fmax(far, fmax(fabs(bounds->low[k]), fabs(bounds->high[k])));
    }
    grid->step = exp2(ceil(log2(size / STEPS)));
    if (!(size > 0) || far / grid->step > 9e15) return false;
    for (bool fits = false; !fits; grid->step *= fits ? 1 : 2) { /* ends may round outwards */
        fits = true;
        for (int k = 0; k < 3; k++) {
            grid->origin[k] = llrint(bounds->low[k] / grid->step);
            fits &= llrint(bounds->high[k] / grid->step) - grid->origin[k] <= STEPS;
        }
    }
    return true;
}

/* users: nodes that can undo a grid, or 0. *finite: whether its primitives can be made anew. */
static struct gn_grid choose_grid(struct gn_baker *b, const json_t *mesh, size_t users,
                                  bool *finite) {
    struct gn_grid grid = {.kind = users ? GN_GRID_SHORTS : GN_GRID_FLOATS, .step = 1};
    struct bounds bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    bool floats = true, any = false;
    size_t vertices = 0;
    const json_t *primitive;
    size_t i;
    *finite = true;
    json_array_foreach(json_object_get(mesh, "primitives"), i, primitive) {
        const int64_t position =
            gn_bake_number(json_object_get(primitive, "attributes"), "POSITION");
        struct gn_elements e = {0};
        if (position < 0 || !gn_bake_has_triangles(primitive)) continue;
        any = true;
        if (!gn_document_accessor(b->in, (size_t)position, &e)) b->failed = true;
        const uint8_t *used = b->failed ? NULL : find_used(b, primitive, e.count);
        if (!used) return grid;
        floats &= add_positions(&e, used, &bounds);
        gn_arena_reset(&b->step);
        vertices += e.count;
        *finite &= floats || e.component != GN_COMPONENT_F32;
        if (json_object_get(primitive, "targets") && grid.kind == GN_GRID_SHORTS)
            grid.kind = GN_GRID_FLOATS;
    }
    if (vertices / NODE_VERTICES < users) grid.kind = GN_GRID_FLOATS;
    if (!floats || !any || bounds.low[0] > bounds.high[0] || !fit_grid(&grid, &bounds))
        grid.kind = GN_GRID_NONE;
    return grid;
}

/* Draco-compressed data is decoded by gnomon-import; where that was not asked, since the file does
 * not require the extension, the plain data must be there. */
static bool has_data(struct gn_baker *b, const json_t *primitive, size_t mesh) {
    const int64_t position = gn_bake_number(json_object_get(primitive, "attributes"), "POSITION");
    const json_t *accessor = position < 0 ? NULL : json_array_get(b->accessors, (size_t)position);
    if (!gn_bake_extension(primitive, "KHR_draco_mesh_compression") ||
        json_object_get(accessor, "bufferView"))
        return true;
    return gn_bake_fail(b,
                        "meshes[%zu]: Draco-compressed, but not listed in extensionsRequired; "
                        "decompress it first (gltf-transform can)",
                        mesh);
}

static bool bake_mesh(struct gn_baker *b, json_t *mesh, size_t index, bool movable, size_t users,
                      size_t *primitive_number) {
    bool finite = true, locks_border;
    json_t *primitive, *primitives = json_object_get(mesh, "primitives");
    size_t i, triangles = 0;
    json_array_foreach(primitives, i, primitive) {
        if (!has_data(b, primitive, index)) return false;
        triangles += gn_bake_has_triangles(primitive);
    }
    locks_border = json_array_size(primitives) > 1;
    /* lines and points of a mesh would need the grid, too */
    movable &= triangles == json_array_size(primitives);
    struct gn_grid *grid = &b->grids[index];
    *grid = choose_grid(b, mesh, movable ? users : 0, &finite);
    json_array_foreach(primitives, i, primitive) {
        bool *is_baked = &b->is_baked[(*primitive_number)++];
        if (b->failed || (finite && !gn_bake_primitive(b, primitive, grid, locks_border, is_baked)))
            return false;
        b->report->primitives++;
        b->report->kept_primitives += !*is_baked;
    }
    /* of a mesh of shorts only primitives that show nothing can be left */
    return true;
}

bool gn_bake_meshes(struct gn_baker *b) {
    json_t *mesh, *meshes = json_object_get(b->root, "meshes");
    const size_t mesh_count = json_array_size(meshes);
    size_t i, primitives = 0;
    json_array_foreach(meshes, i, mesh) primitives +=
        json_array_size(json_object_get(mesh, "primitives"));
    b->grids = gn_arena_alloc(&b->whole, mesh_count, sizeof *b->grids);
    b->is_baked = gn_arena_alloc(&b->whole, primitives, sizeof *b->is_baked);
    bool *movable = gn_arena_alloc(&b->whole, mesh_count, sizeof *movable);
    size_t *users = gn_arena_alloc(&b->whole, mesh_count, sizeof *users);
    if (!b->grids || !b->is_baked || !movable || !users) return gn_bake_fail(b, "out of memory");
    memset(movable, true, mesh_count);
    find_movable(b, movable, users, mesh_count);
    primitives = 0;
    json_array_foreach(meshes, i, mesh) if (!bake_mesh(b, mesh, i, movable[i], users[i],
                                                       &primitives)) return false;
    return true;
}
