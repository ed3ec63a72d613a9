/* A glTF file made ready for boards: one .glb with indexed, ordered, quantized and compressed
 * meshes, and textures of limited size. All else of its JSON stays as it is. No GL, no clock but
 * the limit on seconds. */
#ifndef GN_BAKE_BAKE_H
#define GN_BAKE_BAKE_H

#include "core/file.h"
#include "scene/scene.h"

struct gn_bake_opts {
    const char *path; /* names the file in messages; other files are beside it */
    const struct gn_scene_limits *limits;
    double share; /* of the triangles to keep: 1: all, nothing moves */
    int texture_limit_px;
};
struct gn_bake_report {
    size_t vertices_before, vertices_after; /* of what primitives read, those that share counted
                                               once */
    size_t triangles_before, triangles_after;
    size_t primitives, kept_primitives; /* those that stay as they are: lines, points, and what has
                                           positions that are not finite */
    double error; /* of the simplification: the largest move, in sizes of its mesh */
    size_t images, scaled_images;
    uint64_t other_bytes; /* of the files that the file names */
    size_t image_bytes_before, image_bytes_after;
    char unknown[64]; /* an extension for whose sake all data of the file is kept, or "" */
};

/* False: this build has no libmeshoptimizer. */
bool gn_bake_is_built(void);
/* The bytes of a .glb or .gltf into those of a .glb, which gn_bytes_finish() frees. */
bool gn_bake(const struct gn_bake_opts *opts, const void *data, size_t size, struct gn_bytes *out,
             struct gn_bake_report *report, struct gn_warnings *warnings, struct gn_err *err);

enum { GN_BAKE_TEXTURE_PX = 2048 }; /* the command's limit by itself */
struct gn_bake_estimate {           /* of attributes and indices that are not compressed */
    double bytes, bytes_baked;
};
/* Reads only the headers of accessors. False: the file is refused, as Draco-compressed ones are. */
bool gn_bake_estimate(const struct gn_bake_opts *opts, const void *data, size_t size,
                      struct gn_bake_estimate *out);

#endif
