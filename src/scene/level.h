/* Levels of detail: meshes with fewer triangles over the same vertices, each with its error. A
 * frame chooses one by how large that is in its picture (frame/detail.c). */
#ifndef GN_SCENE_LEVEL_H
#define GN_SCENE_LEVEL_H

#include <stdatomic.h>

#include "scene/scene.h"

enum {
    GN_LEVELS_MAX = 8,
    GN_LEVEL_TRIANGLES = 2000, /* meshes of fewer have no levels */
};
struct gn_level {
    uint32_t first_index, index_count; /* of gn_detail.indices; as in gn_geometry */
    uint32_t vertex_count;             /* that they use */
    /* How far what is on its surface is from where the whole mesh has it: mesh space; of a deformed
     * item world space, over its clips. Half of what a texture slides counts, and of what normals,
     * tangents and colours differ by a quarter times the width of the triangle: an outline is seen
     * more. Of twenty samples one may be further off, up to four times. */
    float error_m;
};
struct gn_levels { /* of a geometry, the finest first */
    struct gn_level at[GN_LEVELS_MAX];
    uint32_t count;
};
struct gn_detail {                /* of a scene */
    struct gn_levels *geometries; /* scene->geometry_count */
    uint32_t *indices;
    uint32_t index_count;
    uint64_t id; /* of all scenes */
};

/* Simplifies each geometry that has GN_LEVEL_TRIANGLES, unless a material that it is drawn with
 * blends: that shows its triangles in their order. Open edges and seams stay whole, so no crack
 * opens between parts of different levels. NULL: no level has fewer triangles than what it is made
 * of, the build has no libmeshoptimizer, or *cancel became true, which may be NULL. */
struct gn_detail *gn_detail_make(const struct gn_scene *scene, const atomic_bool *cancel);
void gn_detail_destroy(struct gn_detail *detail); /* NULL is legal */

/* level_error.c: gn_level.error_m of a geometry's level, by samples of its vertices that are in it
 * no more, each at most most_m off. known_m: what it is at least, in mesh space. INFINITY: a sample
 * of a deformed mesh is further off than most_m, or *cancel became true, which may be NULL. */
struct gn_level_measure;
struct gn_level_measure *gn_level_measure_create(const struct gn_scene *scene,
                                                 const atomic_bool *cancel);
void gn_level_measure_destroy(struct gn_level_measure *measure);
float gn_level_error(struct gn_level_measure *measure, uint32_t geometry, const uint32_t *corners,
                     size_t count, float known_m, float most_m);

#endif
