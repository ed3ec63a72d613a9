/* What the files that know assimp share. */
#ifndef GN_IMPORT_PRIVATE_H
#define GN_IMPORT_PRIVATE_H

#include <limits.h> /* needed by assimp's headers, which do not include it */

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>

#include "import/import.h"

enum { GN_IMPORT_UNSEEN = -2 };

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

/* ---- folder_io.c ---- */

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

/* Blanks the lines of a material file for which assimp would refuse the model; warns of those whose
 * number cannot be read. */
void gn_import_mtl_clean(const struct gn_import *import, const char *name, struct gn_bytes *bytes);

/* ---- the scene ---- */

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

/* Pictures are decoded until 10 of the largest, of 67108864 texels, are; further ones cannot be.
 *
 * Classifies the alpha of a PNG; JPEGs and those that cannot be decoded have none. */
struct gn_import_alpha gn_import_picture_alpha(struct gn_import *import,
                                               const struct gn_bytes *picture);
/* Makes a PNG of the base's colour (white if NULL) and the opacity map's alpha, or its red channel
 * if it has no alpha; halved until there is memory for it. Fails if one of them cannot be decoded.
 */
bool gn_import_picture_merge(struct gn_import *import, const struct gn_bytes *base,
                             const struct gn_bytes *opacity, struct gn_bytes *png);
/* "image/png", "image/jpeg" or NULL, by signature. */
const char *gn_import_picture_type(const struct gn_bytes *picture);

#endif
