/* Shared by the files of this room. struct gn_bake is the state of one run; its first failure
 * sticks, as in the loader. */
#ifndef GN_BAKE_PRIVATE_H
#define GN_BAKE_PRIVATE_H

#include <jansson.h>

#include "bake/bake.h"
#include "core/arena.h"
#include "scene/document.h"

/* How the positions of a mesh are written. Its grid has steps of a power of two and begins at a
 * multiple of one, so that what lies on the grid, as most flat walls and floors, stays exact. */
enum gn_grid_kind {
    GN_GRID_NONE,   /* as the file has them: integers, not finite, of no size */
    GN_GRID_FLOATS, /* floats on the grid: of skins, morph targets, instances */
    GN_GRID_SHORTS, /* 16 bits, and the nodes of the mesh undo it */
};
struct gn_grid {
    enum gn_grid_kind kind;
    double step;
    int64_t origin[3]; /* in steps */
};

struct gn_baker {
    const struct gn_bake_opts *opts;
    struct gn_document *in;
    struct gn_bake_report *report;
    struct gn_warnings *warnings;
    struct gn_err *err;
    bool failed;
    json_t *root;              /* of the output: the file's, without what follows */
    json_t *accessors, *views; /* of the file */
    uint8_t *bin;              /* its chunk */
    size_t size, room;
    uint64_t plain_bytes; /* of all that is compressed, before that */
    bool quantized;
    bool keeps_all;              /* accessors and views of the file keep their numbers */
    struct gn_arena whole, step; /* step: reset for each primitive, accessor and picture */
    struct gn_grid *grids;       /* of each mesh */
    bool *is_baked;              /* of each primitive of each mesh, in the order of the file */
    json_t *known;               /* primitives by what they read: what they read now */
};

/* ---- output.c ---- */

/* False. */
bool gn_bake_fail(struct gn_baker *b, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Zeroed memory of the step, within the limit memory_mb over all that the document and the baker
 * hold; NULL fails the run. */
void *gn_bake_alloc(struct gn_baker *b, size_t count, size_t size);
bool gn_bake_has_room(const struct gn_baker *b, uint64_t bytes); /* for so many more */

enum gn_block_kind { GN_BLOCK_VERTICES, GN_BLOCK_TRIANGLES, GN_BLOCK_OTHER, GN_BLOCK_BYTES };
struct gn_block {
    enum gn_block_kind kind;
    const void *data; /* triangles: 32-bit numbers */
    size_t count, stride;
};
/* Adds a bufferView, compressed where that helps (never bytes); its number. Strides: of vertices a
 * multiple of 4, of triangles 2 or 4 as they are written, of bytes 1. */
size_t gn_bake_view(struct gn_baker *b, const struct gn_block *block);
/* Adds to an array of the root, which takes the reference; the number. */
size_t gn_bake_add(struct gn_baker *b, const char *array, json_t *item);
/* Writes the .glb. */
bool gn_bake_write(struct gn_baker *b, struct gn_bytes *out);

/* A whole number of the JSON that is at least 0, else -1. */
int64_t gn_bake_number(const json_t *object, const char *key);
/* object.extensions.name, or NULL */
json_t *gn_bake_extension(const json_t *object, const char *name);
void gn_bake_forget_extension(struct gn_baker *b, const char *name);
void gn_bake_require_extension(struct gn_baker *b, const char *name);
/* A copy of the JSON of an accessor, without where its data is. */
json_t *gn_bake_accessor_json(const struct gn_baker *b, size_t accessor);

/* ---- stream.c: an attribute of the vertices of a primitive ---- */

struct gn_stream {
    uint8_t *data; /* count x stride */
    size_t stride;
    int component;
    bool normalized, is_quantized; /* is_quantized: as only KHR_mesh_quantization allows */
    bool has_bounds;               /* its accessor has min and max */
    size_t accessor;               /* of the file */
    int target;                    /* of a morph target, or -1 */
    const char *semantic;
    double uv_step; /* of texture coordinates; 0: as they are */
};
/* In memory of the step. alone: of weights, no other set has more of them. */
bool gn_stream_read(struct gn_baker *b, const struct gn_grid *grid, bool alone,
                    struct gn_stream *stream);
/* Writes the first count vertices of it; the number of its accessor. */
size_t gn_stream_write(struct gn_baker *b, const struct gn_stream *stream, size_t count);

/* ---- primitive.c, mesh.c, node.c, keep.c, texture.c: the steps of bake.c ---- */

/* By its mode. */
bool gn_bake_has_triangles(const json_t *primitive);
/* One with triangles; *baked is false where it stays as it is. locks_border: its mesh has others.
 */
bool gn_bake_primitive(struct gn_baker *b, json_t *primitive, const struct gn_grid *grid,
                       bool locks_border, bool *baked);
bool gn_bake_meshes(struct gn_baker *b); /* makes grids */
bool gn_bake_nodes(struct gn_baker *b);  /* undoes grids */
/* keep.c: decides keeps_all and copies all then; later copies what is still used. */
bool gn_bake_keep_all(struct gn_baker *b);
bool gn_bake_keep_used(struct gn_baker *b);
bool gn_bake_images(struct gn_baker *b);

#endif
