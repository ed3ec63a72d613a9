/* The scene on the GPU: buffers, vertex arrays, instances, textures (upload.c, texture.c,
 * mipmap.c). */
#ifndef GN_GL_SCENE_H
#define GN_GL_SCENE_H

#include "gl/coverage.h"
#include "gl/state.h"

struct gn_gl_curve {   /* sRGB by table (mipmap.c) */
    float decode[256]; /* of a byte: its light, in quarter steps of encode */
    uint8_t encode[8192];
};
void gn_gl_curve_init(struct gn_gl_curve *curve);
enum gn_gl_texels { /* a picture has a texture for each */
                    GN_GL_DATA,
                    GN_GL_COLOR, /* sRGB */
                    GN_GL_MASK,  /* and those after it, sRGB: of a cutoff of it, which levels reach
                                    as much */
                    GN_GL_TEXELS_COUNT = GN_GL_MASK + GN_CUTOFFS_MAX,
};
/* Makes *image half as large, in new memory that is also returned: the caller frees it. NULL: there
 * is none. */
uint8_t *gn_gl_image_halve(const struct gn_gl_curve *curve, struct gn_image *image,
                           enum gn_gl_texels texels);
/* The same row by row: the size of the half, then some of its rows. */
struct gn_image gn_gl_image_half(const struct gn_image *image);
void gn_gl_image_halve_rows(const struct gn_gl_curve *curve, const struct gn_image *image,
                            uint32_t first, uint32_t count, enum gn_gl_texels texels, uint8_t *out);
/* Rows of a mask with their alpha by a curve; what is clear has the colour of what is beside it. */
void gn_gl_image_mask_rows(const struct gn_gl_curve *curve, const struct gn_image *image,
                           uint32_t first, uint32_t count, const uint8_t alpha[256], uint8_t *out);

struct gn_gl_vertices { /* one vertex array per set of attributes in use */
    GLuint name;
    uint32_t attributes;
    GLuint instances; /* the buffer and the byte that its instance attributes point to */
    size_t offset;
};
enum { GN_GL_VERTICES_MAX = 32, GN_GL_INSTANCE_RING = 3, GN_GL_SAMPLER_KINDS = 144 };
struct gn_gl_picture { /* being uploaded, a few rows at a time */
    struct gn_image image;
    uint8_t *owned; /* its pixels, if they are ours; freed when it is uploaded */
    enum gn_gl_texels texels;
    bool open, mipmaps;
    GLint level;
    GLsizei levels;
    uint32_t row;        /* of the level, of texels or blocks: uploaded so far */
    const uint8_t *next; /* of KTX2: the level that is uploaded as it is */
    struct gn_image half;
    uint8_t *half_owned; /* the next level, in progress */
    /* of a mask: */
    struct gn_coverage cover; /* of the whole picture */
    uint32_t halved;          /* rows of that level: all are made before the first is uploaded */
    uint8_t alpha[256];       /* what takes the place of each alpha of a smaller level */
    bool fitted;              /* alpha is set: the level is not the whole picture */
};
enum gn_gl_upload_phase {
    GN_GL_UPLOAD_POSITIONS,
    GN_GL_UPLOAD_ATTRIBUTES,
    GN_GL_UPLOAD_INDICES,
    GN_GL_UPLOAD_DELTAS,
    GN_GL_UPLOAD_PICTURES,
    GN_GL_UPLOAD_DONE,
};
struct gn_gl_upload {
    enum gn_gl_upload_phase phase;
    uint32_t first; /* vertex, index, geometry or use of a texture that comes next */
    uint32_t texel; /* of the deltas of that geometry */
    struct gn_gl_curve *curve;
    struct gn_gl_picture picture;
    bool no_memory; /* for a picture's smaller levels */
};
enum { /* vectors of a material in uniforms: u_uv, then u_factors (lib/vertex.glsl, surface.glsl) */
       GN_GL_TRANSFORMS = 2 * GN_TEXTURE_SLOT_COUNT,
       GN_GL_FACTORS = 1 + GN_FACTORS_VECTORS,
       GN_GL_SET_VECTORS = GN_GL_TRANSFORMS + GN_GL_FACTORS,
};
struct gn_gl_scene {
    const struct gn_scene *scene;
    struct gn_gl_upload upload;
    GLuint positions, attributes, indices;
    const struct gn_detail *detail; /* of the plan that runs: its indices follow the scene's */
    uint64_t detail_id;             /* whose are there; 0: none */
    GLenum index_type;
    size_t index_size;
    GLsizei attribute_stride;
    GLint attribute_at[GN_ATTRIBUTE_COUNT]; /* byte offsets; -1: no such in this scene, or the
                                               position */
    uint32_t image_count;                   /* kept: the scene may be gone when we finish */
    GLuint *images[GN_GL_TEXELS_COUNT];     /* by image; 0 where not used so */
    GLuint samplers[GN_GL_SAMPLER_KINDS];
    float (*sets)[GN_GL_SET_VECTORS][4]; /* different sets of transforms and factors */
    uint32_t *material_sets;             /* by material: index into sets */
    uint32_t set_count;
    uint64_t buffer_bytes, texture_bytes;
    struct gn_gl_vertices vertices[GN_GL_VERTICES_MAX];
    uint32_t vertices_count;
    struct { /* of skins and targets; names 0: there are none */
        GLuint deltas, pose[GN_GL_INSTANCE_RING];
        uint32_t current; /* of the ring, as that of instances */
        uint64_t hash;    /* of what the current one holds */
    } deformation;
};
void gn_gl_scene_begin(struct gn_gl *gl, const struct gn_scene *scene);
/* Uploads about so many bytes; *done: the scene is complete. On failure all of it is freed. */
bool gn_gl_scene_step(struct gn_gl *gl, size_t bytes, bool *done, struct gn_err *err);
/* Swaps the staged scene and the current one. */
void gn_gl_staged_swap(struct gn_gl *gl);
void gn_gl_scene_finish(struct gn_gl *gl);
/* The vertex array for a set of attributes, made if missing; false when there are too many. */
bool gn_gl_vertices_ensure(struct gn_gl *gl, uint32_t attributes, struct gn_err *err);
bool gn_gl_vertices_known(struct gn_gl *gl, uint32_t attributes);
void gn_gl_vertices_bind(struct gn_gl *gl, uint32_t attributes, uint32_t first_instance);
/* Uploads about so many bytes; true: all textures are complete. */
bool gn_gl_textures_step(struct gn_gl *gl, size_t bytes);
void gn_gl_textures_finish(struct gn_gl *gl);
void gn_gl_texture_bind(struct gn_gl *gl, const struct gn_material *material, uint32_t slot);
void gn_gl_slide_bind(struct gn_gl *gl, uint32_t slide, uint32_t texture);

/* levels.c: for a picture with levels from its file, the texture of the open picture; false: it
 * cannot be had, and the picture has become a white texel, with a warning. */
bool gn_gl_levels_open(struct gn_gl *gl, uint32_t index);
/* Uploads some rows; returns their bytes. Closes the picture behind its last level. */
size_t gn_gl_levels_send(struct gn_gl *gl, size_t bytes);

/* deform.c: makes the textures, and uploads the deltas of one geometry; true: of all. */
bool gn_gl_deltas_step(struct gn_gl *gl, size_t bytes);
void gn_gl_deformation_finish(struct gn_gl *gl);
/* Uploads the plan's texels of the pose if they changed, and binds what vertex shaders read. */
void gn_gl_pose_upload(struct gn_gl *gl, const struct gn_plan *plan);
/* upload.c: uploads the indices of the plan's levels of detail if they changed. */
void gn_gl_detail_upload(struct gn_gl *gl, const struct gn_plan *plan);
/* upload.c: of a draw of a geometry, in the buffer of indices. */
uint32_t gn_gl_first_index(const struct gn_gl *gl, const struct gn_draw *draw);
/* upload.c: uploads the uniforms of materials that clips move if they changed. */
void gn_gl_materials_update(struct gn_gl *gl, const struct gn_plan *plan);

struct gn_gl_instances { /* a ring, so that a frame does not wait for the one before */
    GLuint buffers[GN_GL_INSTANCE_RING];
    size_t room[GN_GL_INSTANCE_RING];
    uint32_t current;
    uint64_t hash; /* of what the current one holds */
};
void gn_gl_instances_upload(struct gn_gl *gl, const struct gn_instance *instances, size_t count);

#endif
