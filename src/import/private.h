/* Shared by the files of one conversion. All of it runs in a child of gnomon-import that may crash
 * at any time: worker.c sets its limits, and its result goes into struct gn_import_report. */
#ifndef GN_IMPORT_PRIVATE_H
#define GN_IMPORT_PRIVATE_H

#include <limits.h> /* needed by assimp's headers, which do not include it */

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
    const char *model, *out; /* out NULL: the model's name with .glb */
    enum gn_import_up up;
    int memory_mb, time_s, file_mb; /* limits: address space, CPU and wall time, size of a file */
};

enum { GN_IMPORT_UNSEEN = -2 };

struct gn_import_report { /* shared between the child and its parent */
    bool done;            /* the .glb is complete */
    struct gn_err err;    /* the reason if not */
    struct gn_warnings warnings;
};

struct gn_import_alpha { /* some texel is not opaque; most of those are semi-transparent */
    bool has_alpha, soft;
};
struct gn_import_texture { /* cache of textures already written, by their files and sampler */
    char *base, *opacity;  /* file names, "" for none */
    int image, index;      /* indices of glTF image and texture, or -1 */
    int wrap[2];           /* glTF wrap modes */
    bool opaque;           /* ignore alpha */
    struct gn_import_alpha alpha;
};

struct gn_import_shape { /* vertices and triangles of one mesh */
    const struct aiMesh *mesh;
    uint32_t vertex_count;
    uint32_t *origin;           /* per vertex: its index in the aiMesh */
    struct aiVector3D *normals; /* per vertex */
    uint32_t *indices;          /* three per triangle */
    size_t index_count;
};

struct gn_import_node { /* in glTF node order */
    const struct aiNode *node;
    struct aiMatrix4x4 world_from_node; /* metres, Y up */
};

struct gn_import {
    const struct gn_import_opts *opts;
    int opener; /* to the parent, which opens files: core/opener.h */
    enum gn_model_format format;
    char folder[PATH_MAX]; /* real path of the model's folder; "" for "/" */
    char name[PATH_MAX];   /* path given to assimp: folder/name */
    const struct aiScene *scene;
    struct gn_glb glb;
    struct gn_warnings *warnings;
    struct gn_err *err;
    bool warned_materials; /* warned of a missing material file */
    bool has_area;         /* some triangle has one */
    json_t **primitives;   /* per aiMesh: its primitive, JSON null if empty, NULL if not made yet */
    int *meshes;           /* per aiMesh: glTF mesh of nodes with only this one, -1 if empty, or
                              GN_IMPORT_UNSEEN */
    int *materials;        /* per aiMaterial: glTF index, or GN_IMPORT_UNSEEN */
    struct gn_import_texture *textures;
    size_t texture_count;
    struct gn_import_node *nodes;
    size_t node_count, node_room;
    float low[3], high[3]; /* world-space bounding box */
};

/* ---- worker.c ---- */

/* Runs in the child: sets limits, gives up its rights, converts into fd, fills the report. opener:
 * a socket to the parent, see core/opener.h. */
void gn_import_work(const struct gn_import_opts *opts, int fd, int opener,
                    struct gn_import_report *report);

/* ---- memory.c ---- */

/* Sets the limits and the report used by the functions below. */
void gn_import_memory_begin(const struct gn_import_opts *opts, struct gn_import_report *report);
/* Returns size bytes, or reports the failure and exits. */
void *gn_import_alloc(size_t size);
void *gn_import_grow(void *old, size_t size); /* as realloc */
void gn_import_no_memory(void) __attribute__((noreturn));

/* ---- folder.c ---- */

/* Fills folder and name. Needs access to files. */
bool gn_import_folder_find(struct gn_import *import);
/* Reads the model itself. */
bool gn_import_model_read(const struct gn_import *import, struct gn_bytes *bytes,
                          struct gn_err *err);
/* Reads a file that the model names, by its path if that lies in the folder, else by its base name.
 * Returns false without a message if there is none. */
bool gn_import_folder_read(const struct gn_import *import, const char *name,
                           struct gn_bytes *bytes);
/* aiFileIO on the folder; warns of missing material files. */
struct aiFileIO gn_import_folder_io(struct gn_import *import);

/* ---- ply.c ---- */

/* Fails for a header that would hang assimp. */
bool gn_import_ply_check(const struct gn_import *import, const struct gn_bytes *model);
/* Keeps assimp from skipping the first byte of a binary body. */
void gn_import_ply_guard(struct gn_bytes *bytes);

/* ---- obj.c ---- */

/* Writes ".5" as "0.5", and "vt U" as "vt U 0"; leaves out comments of such lines. Makes groups of
 * tens of thousands of objects. */
void gn_import_obj_pad(struct gn_bytes *bytes);

/* ---- mtl.c ---- */

/* Blanks the lines of a material file for which assimp would refuse the model. */
void gn_import_mtl_clean(struct gn_bytes *bytes);

/* ---- the scene ---- */

bool gn_import_scene_build(struct gn_import *import);
/* The glTF mesh of an aiNode, or -1 if it is empty. */
int gn_import_mesh(struct gn_import *import, const struct aiNode *node);
/* Adds normals to a shape, splitting vertices as needed. */
void gn_import_normals(struct gn_import_shape *shape);
int gn_import_material(struct gn_import *import, unsigned index);
/* The material's texture of that type, merged with its opacity map if wanted; index -1 if none. */
struct gn_import_texture gn_import_texture(struct gn_import *import,
                                           const struct aiMaterial *material,
                                           enum aiTextureType type, bool with_opacity, int *uv_set);
void gn_import_lights(struct gn_import *import);
void gn_import_cameras(struct gn_import *import);
/* matrix.c: column-major, as in glTF; falls back to the identity if a value is not finite. */
json_t *gn_import_matrix(const struct aiMatrix4x4 *matrix);

/* ---- picture.c: alpha ---- */

/* Classifies the alpha of a PNG; JPEGs and unreadable files have none. */
struct gn_import_alpha gn_import_picture_alpha(const struct gn_bytes *picture);
/* Makes a PNG of the base's colour (white if NULL) and the opacity map's alpha, or its red channel
 * if it has no alpha. Fails if one of them cannot be decoded. */
bool gn_import_picture_merge(const struct gn_bytes *base, const struct gn_bytes *opacity,
                             struct gn_bytes *png);
/* "image/png", "image/jpeg" or NULL, by signature. */
const char *gn_import_picture_type(const struct gn_bytes *picture);

#endif
