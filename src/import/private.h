/* The parts of one conversion. All of it runs in a child of gnomon-import that may die at any time:
 * its limits are those of worker.c, and what it has to say stands in struct gn_import_report. */
#ifndef GN_IMPORT_PRIVATE_H
#define GN_IMPORT_PRIVATE_H

#include <limits.h> /* before assimp's, which need it and do not say so */

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>

#include "config.h"
#include "core/err.h"
#include "core/file.h"
#include "core/model.h"
#include "core/warn.h"
#include "import/glb.h"

enum gn_import_up { GN_IMPORT_UP_AUTO, GN_IMPORT_UP_Y, GN_IMPORT_UP_Z };
struct gn_import_opts {
    const char *model, *out; /* out NULL: model's name with .glb */
    enum gn_import_up up;
    int memory_mb, time_s, file_mb; /* most: address space, seconds, bytes of any one file */
};

enum { GN_IMPORT_UNSEEN = -2 };

struct gn_import_report { /* shared between the child and its parent */
    bool done;            /* the .glb is whole */
    struct gn_err err;    /* else why not */
    struct gn_warnings warnings;
};

struct gn_import_alpha { /* some texel is not opaque; many are neither opaque nor clear */
    bool has_alpha, soft;
};
struct gn_import_texture { /* seen before: a base picture with an opacity picture, and its use */
    char *base, *opacity;  /* names, "" for none */
    int image, index;      /* in the file: of the picture, of the texture; or -1 */
    int wrap[2];           /* as glTF has it */
    bool opaque;           /* its alpha is to be ignored */
    struct gn_import_alpha alpha;
};

struct gn_import_shape { /* what is written of a mesh */
    const struct aiMesh *mesh;
    uint32_t vertex_count;
    uint32_t *origin;           /* per vertex: which of the mesh it is */
    struct aiVector3D *normals; /* per vertex */
    uint32_t *indices;          /* triangles */
    size_t index_count;
};

struct gn_import_node { /* of the file, in the order in which they are written */
    const struct aiNode *node;
    struct aiMatrix4x4 world_from_node; /* metres, Y up */
};

struct gn_import {
    const struct gn_import_opts *opts;
    enum gn_model_format format;
    char folder[PATH_MAX]; /* the model's, real; nothing outside it is read */
    char name[PATH_MAX];   /* the model's in it, as assimp is told it: folder/name */
    const struct aiScene *scene;
    struct gn_glb glb;
    struct gn_warnings *warnings;
    struct gn_err *err;
    bool warned_materials; /* of a material file that is not there */
    json_t **primitives;   /* per aiMesh: made already (null: nothing to show), or NULL */
    int *meshes;           /* per aiMesh: of nodes with it alone; -1: none, or GN_IMPORT_UNSEEN */
    int *materials;        /* per aiMaterial: index in the file, or GN_IMPORT_UNSEEN */
    struct gn_import_texture *textures;
    size_t texture_count;
    struct gn_import_node *nodes;
    size_t node_count, node_room;
    float low[3], high[3]; /* world-space box of all that is shown */
};

/* ---- worker.c ---- */

/* The child's work: sets the limits, converts into fd, fills the report. */
void gn_import_work(const struct gn_import_opts *opts, int fd, struct gn_import_report *report);

/* ---- memory.c ---- */

/* Whose limits and report the functions below use. */
void gn_import_memory_begin(const struct gn_import_opts *opts, struct gn_import_report *report);
/* size bytes, or the end of this process with a report that says so. */
void *gn_import_alloc(size_t size);
void *gn_import_grow(void *old, size_t size); /* as realloc */
void gn_import_no_memory(void) __attribute__((noreturn));

/* ---- folder.c: the model's folder, and nothing else ---- */

bool gn_import_folder_open(struct gn_import *import);
/* A file that the model names, by any kind of path: as it is if that stays in the folder, else by
 * its last part alone. False when there is none; nothing is said. */
bool gn_import_folder_read(const struct gn_import *import, const char *name,
                           struct gn_bytes *bytes);
/* The same for assimp; warns of material files that are not there. */
struct aiFileIO gn_import_folder_io(struct gn_import *import);

/* ---- ply.c ---- */

/* False, with err filled, where the file's header would hang the reader. */
bool gn_import_ply_check(const struct gn_import *import);

/* ---- the scene ---- */

bool gn_import_scene_build(struct gn_import *import);
/* The glTF mesh of an aiNode, or -1 if it shows nothing. */
int gn_import_mesh(struct gn_import *import, const struct aiNode *node);
/* Gives a shape normals, and as many vertices as these need. */
void gn_import_normals(struct gn_import_shape *shape);
int gn_import_material(struct gn_import *import, unsigned index);
/* The texture of that kind, with that opacity picture if any; index -1 without. */
struct gn_import_texture gn_import_texture(struct gn_import *import,
                                           const struct aiMaterial *material,
                                           enum aiTextureType type, bool with_opacity, int *uv_set);
void gn_import_lights(struct gn_import *import);
void gn_import_cameras(struct gn_import *import);
/* matrix.c: column-major, as in glTF; values that are not finite become the identity's. */
json_t *gn_import_matrix(const struct aiMatrix4x4 *matrix);

/* ---- picture.c: alpha ---- */

/* What a PNG's alpha is like; JPEGs and what cannot be read have none. */
struct gn_import_alpha gn_import_picture_alpha(const struct gn_bytes *picture);
/* A PNG with the base's colour (white if NULL) and the other's alpha, or its red where it has none.
 * False when one cannot be read. */
bool gn_import_picture_merge(const struct gn_bytes *base, const struct gn_bytes *opacity,
                             struct gn_bytes *png);
/* "image/png", "image/jpeg" or NULL, by the first bytes. */
const char *gn_import_picture_type(const struct gn_bytes *picture);

#endif
