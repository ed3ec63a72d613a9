/* Shared by the files of the loader. struct gn_gltf is the state of one load; its first failure
 * sticks: from then on getters return harmless values. load.c checks `failed` between its steps. */
#ifndef GN_SCENE_PRIVATE_H
#define GN_SCENE_PRIVATE_H

#include "core/arena.h"
#include "core/file.h"
#include "core/hash.h"
#include "image/ktx2.h"
#include "image/scale.h"
#include "scene/document.h"
#include "scene/gltf/json.h"
#include "scene/gltf/table.h"
#include "scene/property.h"
#include "scene/scene.h"

struct gn_blob { /* bytes of a file, a data URI or a part of the model itself */
    const uint8_t *data;
    size_t size;
    struct gn_bytes file; /* owned, if it came from a file */
};

/* A bufferView that lies inside its buffer; data is NULL where the buffer is a placeholder. */
struct gn_buffer_view {
    const uint8_t *data;
    size_t size, stride; /* stride 0: tight */
    int32_t buffer;      /* -1: it names none that is there */
};

enum gn_component { /* glTF's numbers */
                    GN_I8 = 5120,
                    GN_U8 = 5121,
                    GN_I16 = 5122,
                    GN_U16 = 5123,
                    GN_U32 = 5125,
                    GN_F32 = 5126,
};

/* A checked accessor: data + stride * (count - 1) + one element lie inside memory that
 * outlives the load. Stride 0: all elements are the first one (an accessor without a bufferView is
 * one element of zeros); not "tight", as in a view. Elements may be
 * unaligned: read them with the functions below. */
struct gn_accessor {
    const uint8_t *data;
    size_t stride, count;
    enum gn_component component;
    uint8_t components; /* of one element: 1 for SCALAR .. 16 for MAT4 */
    uint8_t columns;    /* of a matrix; else 1 */
    bool normalized;
    bool backed;   /* has a bufferView or sparse values; else it is all zeros */
    bool resolved; /* checked by gn_gltf_accessor() */
};

/* X(NAME, words, extension of materials or NULL): what is not supported yet; the scene is shown
 * without, and missing.c lists it. */
#define GN_MISSING(X)                                                                              \
    X(BASISU, "Basis pictures", NULL)                                                              \
    X(DRACO, "Draco-compressed meshes", NULL)                                                      \
    X(POINTERS, "animation of some properties", NULL)                                              \
    X(COAT_NORMALS, "normal maps of clear coat", NULL)                                             \
    X(VOLUME, "refraction in volumes", NULL)                                                       \
    X(SHEEN, "sheen", "KHR_materials_sheen")                                                       \
    X(IRIDESCENCE, "iridescence", "KHR_materials_iridescence")                                     \
    X(ANISOTROPY, "anisotropy", "KHR_materials_anisotropy")                                        \
    X(DISPERSION, "dispersion", "KHR_materials_dispersion")                                        \
    X(DIFFUSE_TRANSMISSION, "diffuse transmission", "KHR_materials_diffuse_transmission")          \
    X(SPECULAR_TEXTURES, "textures of KHR_materials_specular", NULL)                               \
    X(MORPHED_COLORS, "morphs of colours and texture coordinates", NULL)                           \
    X(GLOSSINESS_TEXTURES, "a specular-glossiness texture with two factors", NULL)

enum gn_missing {
#define GN_X(NAME, ...) GN_MISSING_##NAME,
    GN_MISSING(GN_X)
#undef GN_X
        GN_MISSING_COUNT,
};

struct gn_primitive { /* of a mesh */
    uint32_t geometry;
    int32_t material;   /* the file's number, or -1 */
    uint64_t hidden_in; /* as in gn_item */
};
struct gn_mesh {
    bool used, skinned; /* by a node; by one with a skin */
    uint32_t target_count;
    uint32_t first_primitive, primitive_count;
};

struct gn_vertices { /* a set of attribute accessors; geometries share it that have normals, and no
                        tangents to make */
    int32_t attribute[GN_ATTRIBUTE_COUNT];
    uint32_t first, count;
    bool filled, lacks_normals; /* some normal had no length */
};
/* The source of a geometry. attribute .. targets are the key of a table (gltf/mesh.c). */
struct gn_shape {
    int32_t attribute[GN_ATTRIBUTE_COUNT];
    int32_t indices, mode;
    int32_t tangents;         /* to make (gn_gltf_tangents); 0: none. Until choose_tangents(): that
                                 the normal map needs, though the file may have them */
    int32_t targets;          /* 0: it has none; else no other shape has the same */
    uint32_t vertices;        /* index into primitives.vertices; UINT32_MAX: its own, since normals
                                 or tangents are made */
    uint32_t mesh, primitive; /* the first to use it, for messages */
    uint64_t corner_count;    /* most indices that it can come to */
    double area;              /* of its triangles, if it is flat */
};

enum gn_tristate { GN_UNSET, GN_NO, GN_YES };
struct gn_placed { /* what glTF and its extras attach to a node of the scene */
    size_t json;   /* its number in the file */
    int32_t mesh, skin;
    int32_t morph; /* index in the scene, or -1 */
    uint32_t first_instance, instance_count;
    bool bare; /* not listed by the scene: kept for a descendant that is */
    bool receives, casts, casts_alpha;
    enum gn_tristate plane;
    enum gn_cast_faces cast_faces;
};

struct gn_gltf_memory {
    struct gn_arena *scene;
    struct gn_arena load; /* until the load ends */
    struct gn_arena step; /* "work memory": reset when a geometry or a later step begins */
    size_t other_bytes;   /* an estimate of what lies outside the arenas: files, JSON, and what the
                             GPU will have of pictures, which on a board is the same memory */
    size_t most_bytes;    /* of all these at any time */
};
struct gn_gltf_file { /* what the file declares, by its own numbers */
    json_t *json;
    struct gn_blob bin; /* the BIN chunk of a .glb */
    struct gn_blob *buffers;
    struct gn_buffer_view *views;
    struct gn_accessor *accessors;
    const float **key_times; /* per accessor: times already copied */
    double **origins;        /* far.c; per accessor: what is taken off its positions, or NULL */
    struct gn_mesh *meshes;  /* node.c: which are used; mesh.c: their primitives */
    size_t buffer_count, view_count, accessor_count, mesh_count, material_count, node_count,
        texture_count, image_count, skin_count;
};
struct gn_gltf_primitives { /* of the meshes in use, mesh by mesh, and what they share */
    struct gn_primitive *list;
    struct gn_shape *shapes; /* shapes[i]: what scene->geometries[i] is made of */
    struct gn_vertices *vertices;
    size_t count, vertices_count;
};
/* What a picture takes: pixels and bytes that stay, those of decoding it, those on the GPU. */
enum { GN_HALVINGS = 3 }; /* further ones take no less memory */
struct gn_picture_need {
    uint32_t px[2];
    uint64_t kept, decoding, on_gpu;
    uint64_t halved[GN_HALVINGS]; /* the least of decoding it, by halvings from 1 on; 0: it has no
                                     smaller size */
    uint64_t work;                /* the time of decoding it, as texels */
};
struct gn_picture {  /* the source of images */
    uint64_t key[3]; /* a file: 1, device, inode; a part of a buffer: 2, address, size */
    size_t first;    /* number of the first image in the file that names it */
};
struct gn_glossy { /* what a texture of KHR_materials_pbrSpecularGlossiness became */
    bool made;
    int32_t texture;
    float factor, mean[3];
};
struct gn_gltf_pictures { /* each is read once, whether it can be or not */
    struct gn_picture *list;
    size_t count;
    struct gn_table table;
    struct gn_glossy *glossy;      /* by texture of the scene; NULL: none yet */
    struct gn_picture_need *needs; /* of pictures that may be shown, at their own size */
    size_t need_count, room;       /* bytes left within memory_mb before the first of them */
    uint64_t over_mb;
    const char *over; /* the limit that all at their size are over; NULL: none */
    uint32_t fit_px;  /* longer sides must be halved until they are within this */
    int loads;        /* so many before this one were over */
};
struct gn_gltf_to_scene {             /* from numbers of the file to indices in the scene */
    int32_t *node;                    /* -1: not shown */
    int32_t *texture;                 /* -1: not looked at yet, -2: dropped */
    int32_t *image;                   /* the same */
    int32_t *skin;                    /* -1: not used yet */
    uint32_t *record[GN_THING_COUNT]; /* as in gn_material, by number in the file */
    uint32_t *moves;                  /* of its materials */
    bool *range_moves;                /* of its lights */
};
enum { GN_ADDED_NODES = 3 }; /* at most: a camera, a light, a floor */
struct gn_gltf {
    const char *path; /* names the file in messages */
    char *folder;     /* real path of its folder, or NULL: no other files */
    struct gn_scene_limits limits;
    struct gn_warnings *warnings;
    struct gn_err *err;
    struct gn_hash_key hash_key; /* of the tables of this load */
    int64_t end_ns;              /* of the thread's processor time: the limit on seconds */
    unsigned permille[2];        /* of the load, where its present step begins and ends */
    uint32_t getters;            /* calls since the start; every so often one looks at the clock */
    bool failed, failed_part;    /* part: it has a place (at) */
    struct gn_err spared;        /* the first failure that gn_gltf_spare() took back */
    bool is_missing[GN_MISSING_COUNT];
    struct gn_gltf_memory memory;
    struct gn_gltf_file file;
    struct gn_gltf_primitives primitives;
    struct gn_gltf_pictures pictures;
    struct gn_placed *placed; /* scene->node_count, + GN_ADDED_NODES */
    struct gn_gltf_to_scene to_scene;
    size_t misplaced; /* triangles that are not shown: positions that are not finite */
    uint64_t key_total;
    uint64_t decoded_bytes;  /* of the pictures in memory */
    uint64_t decode_work;    /* of all that were decoded, in loads before this one, too */
    uint64_t read_bytes;     /* of files, this one's among them: time to decode goes by them, too */
    uint64_t damaged_work;   /* of those whose decoding failed */
    uint64_t closed_corners; /* of the geometries so far, tested for being closed or not */
    struct gn_scene *scene;
};

/* ---- gltf/message.c ---- */

/* "PATH: nodes[3].mesh: text". The first failure stays; both return false. at NULL:
 * of the whole load (memory, time, a limit): gn_gltf_spare() leaves it. */
bool gn_gltf_fail(struct gn_gltf *g, const struct gn_at *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void gn_gltf_warn(struct gn_gltf *g, const struct gn_at *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* For a part of the file that a scene can do without, right after it was read by a load that had
 * not failed before: where it is at fault, its failure becomes a warning that ends in `without`,
 * the load goes on, and the answer is true. Failures without a place (at NULL) stay. */
bool gn_gltf_spare(struct gn_gltf *g, const char *without);

/* Nothing is left to be shown: for the first part that was done without, or else for that reason.
 */
bool gn_gltf_fail_empty(struct gn_gltf *g, const struct gn_at *at, const char *why);

/* ---- gltf/memory.c ---- */

/* Zeroed memory within memory_mb over all arenas; NULL fails the load. */
void *gn_gltf_alloc(struct gn_gltf *g, struct gn_arena *arena, uint64_t count, size_t size);
/* The same for a pointer: so many of what it points to. */
#define GN_NEW(g, arena, pointer, count)                                                           \
    ((pointer) = gn_gltf_alloc(g, arena, count, sizeof *(pointer)))
/* Counts memory that lies elsewhere, as of the GPU, within memory_mb; false fails the load. */
bool gn_gltf_count(struct gn_gltf *g, uint64_t bytes);
char *gn_gltf_strdup(struct gn_gltf *g, const char *text); /* "" for NULL; into the scene */
/* Bytes left within memory_mb. */
size_t gn_gltf_room(const struct gn_gltf *g);

/* ---- gltf/time.c ---- */

/* Fails the load when its limit on seconds is over or it is cancelled. Reads a clock: once for each
 * geometry, picture and clip, and in one of many getters of gltf/json.h. */
bool gn_gltf_check_time(struct gn_gltf *g);
/* How much of the present step of the load is done, for limits.progress. */
void gn_gltf_progress(const struct gn_gltf *g, uint64_t done, uint64_t all);

/* ---- the steps of load.c, in order ---- */

bool gn_gltf_open(struct gn_gltf *g, const uint8_t *data, size_t size); /* gltf/file.c */
/* The version and required extensions; makes each list of the file an array of objects. */
bool gn_gltf_check_support(struct gn_gltf *g);
bool gn_gltf_supports(const char *extension); /* a reader knows it */
bool gn_gltf_uses(const struct gn_gltf *g, const char *extension);
bool gn_gltf_requires(const struct gn_gltf *g, const char *extension);
bool gn_gltf_buffers(struct gn_gltf *g);        /* gltf/buffers.c */
bool gn_gltf_list_accessors(struct gn_gltf *g); /* gltf/accessor.c */
bool gn_gltf_nodes(struct gn_gltf *g);          /* gltf/node.c */
bool gn_gltf_variants(struct gn_gltf *g);       /* gltf/variant.c */
bool gn_gltf_meshes(struct gn_gltf *g);         /* gltf/mesh.c */
bool gn_gltf_instances(struct gn_gltf *g);      /* gltf/instance.c */
bool gn_gltf_skins(struct gn_gltf *g);          /* gltf/skin.c */
bool gn_gltf_far(struct gn_gltf *g);            /* gltf/far.c */
bool gn_gltf_geometries(struct gn_gltf *g);     /* geometry.c */
bool gn_gltf_items(struct gn_gltf *g);          /* gltf/item.c */
bool gn_gltf_pointers(struct gn_gltf *g);       /* gltf/pointer.c */
bool gn_gltf_materials(struct gn_gltf *g);      /* gltf/material.c */
bool gn_gltf_lights(struct gn_gltf *g);         /* gltf/light.c */
bool gn_gltf_cameras(struct gn_gltf *g);        /* gltf/camera.c */
bool gn_gltf_animations(struct gn_gltf *g);     /* gltf/anim.c */
bool gn_scene_complete(struct gn_gltf *g);      /* complete.c */
bool gn_scene_lay_occlusion(
    struct gn_gltf *g);                     /* occlusion.c: items that are still, before batches */
bool gn_scene_batch(struct gn_gltf *g);     /* batch.c */
bool gn_scene_count_gpu(struct gn_gltf *g); /* gpu.c */

/* ---- helpers ---- */

/* gltf/mesh.c: the accessor of an attribute, or of its part of a target, checked against the row
 * and the number of vertices. -1: there is none, or it is at fault; this is a warning, but a
 * failure where count is 0, as for positions. */
int32_t gn_gltf_attribute(struct gn_gltf *g, const struct gn_at *of, const char *semantic,
                          const struct gn_attribute_row *row, size_t count);

/* load.c: of the file; NULL: none that can be reached. To be freed. */
char *gn_scene_folder(const char *path);

/* missing.c: notes the extensions of a material that is shown; then the list of all that the file
 * has and the scene has not: also each name of extensionsUsed that no reader knows. */
void gn_missing_of_material(struct gn_gltf *g, const struct gn_at *material);
bool gn_missing_list(struct gn_gltf *g);

/* gltf/compressed.c: where the view is compressed by meshoptimizer, and this build has the decoder,
 * sets view->data, which else stays NULL. False: failed, which gn_gltf_buffers() may spare. */
bool gn_gltf_decompress(struct gn_gltf *g, const struct gn_at *view_at,
                        struct gn_buffer_view *view);

/* uri.c: data: URIs and files in the model's folder or below. err has no path before its
 * text. */
bool gn_uri_fetch(struct gn_gltf *g, const char *uri, struct gn_blob *out, struct gn_err *err);
/* The two steps of it for a file: a descriptor of a regular file, or -1; its bytes. The second
 * closes the descriptor. */
int gn_uri_open(struct gn_gltf *g, const char *uri, struct gn_err *err);
bool gn_uri_read(struct gn_gltf *g, int fd, const char *uri, struct gn_blob *out,
                 struct gn_err *err);
void gn_blob_finish(struct gn_gltf *g, struct gn_blob *blob);

/* gltf/accessor.c. The file's accessor of that number, checked, or NULL (-1 or failed); sparse ones
 * are made dense here. */
const struct gn_accessor *gn_gltf_accessor(struct gn_gltf *g, int32_t index);
/* Bytes of an element, with the padding between the columns of a matrix. */
size_t gn_accessor_element_size(const struct gn_accessor *a);
/* All elements as floats, normalised as the accessor says, into out: components x count of them;
 * missing components stay as they are. */
void gn_accessor_floats(const struct gn_accessor *a, size_t components, float *out);
/* The same for the elements that source names, count of them; NULL: for the first ones. */
void gn_accessor_gather(const struct gn_accessor *a, size_t components, const uint32_t *source,
                        size_t count, float *out);
/* All elements as numbers, into out: count of them. The accessor is of unsigned scalars. */
void gn_accessor_indices(const struct gn_accessor *a, uint32_t *out);

/* geometry.c: of two uint32_t, for qsort(). */
int gn_compare_indices(const void *a, const void *b);

/* geometry_finish.c: steps of making a geometry that need only its vertices and triangles. */
/* Flat normals for triangles that have none. positions: 3 x vertex_count. corners: corner_count
 * indices into them, which become indices into the *made vertices, at most corner_count; of these
 * *source[i], in work memory, is the position, and 3 floats of normals are the normal. */
bool gn_geometry_flat_normals(struct gn_gltf *g, const float *positions, uint32_t *corners,
                              size_t corner_count, size_t vertex_count, uint32_t **source,
                              float *normals, size_t *made);
/* Replaces normals of length 0 by the normal of a face; returns their number. */
size_t gn_normals_repair(const float *positions, float *normals, const uint32_t *corners,
                         size_t corner_count);
/* Of the vertices first .. first + count: tangents of length 0 become any in the surface, and w
 * becomes -1 or 1. */
void gn_geometry_repair_tangents(struct gn_scene *scene, size_t first, size_t count);
/* Of the vertices of a geometry, whose triangles may share them with others. */
void gn_geometry_add_spreads(struct gn_scene *scene, const struct gn_geometry *geometry);
/* Of one vertex, by one face around it; neither need be of unit length. */
void gn_geometry_add_spread(struct gn_scene *scene, uint32_t vertex, const double face[3],
                            const double normal[3]);
/* spread.c: of what is deformed, by poses of all clips. After gn_scene_measure(). */
bool gn_scene_add_posed_spreads(struct gn_gltf *g);
/* closed.c. Sets watertight and closed; neither where memory_mb leaves too little memory. */
void gn_geometry_test_closed(const struct gn_gltf *g, struct gn_geometry *geometry);
/* Sets box, layers, flat and plane; *area: of all triangles, square units of mesh space. */
void gn_geometry_measure(const struct gn_scene *scene, struct gn_geometry *geometry, double *area);

/* skin.c */
/* Joints and weights of vertices, first .. first + count of the scene's, each that of the file's
 * named by source, or the same number if source is NULL. Weights become 1 together. */
bool gn_skin_put_vertices(struct gn_gltf *g, const int32_t *attribute, const uint32_t *source,
                          size_t first, size_t count);
/* Sets joint_boxes of a geometry with joints, of the primitive at `at`. */
bool gn_skin_measure(struct gn_gltf *g, const struct gn_at *at, struct gn_geometry *geometry);

/* morph.c: reads the targets of a geometry whose vertices are there; source as above. None where
 * there is no room for their deltas, with a warning. */
bool gn_morph_build(struct gn_gltf *g, const struct gn_at *primitive, const struct gn_shape *shape,
                    const uint32_t *source, struct gn_geometry *geometry);

/* gltf/skin.c: a strip of so many rows among the pose's texels. */
bool gn_gltf_strip(struct gn_gltf *g, const struct gn_at *at, uint32_t rows, struct gn_strip *out);
/* Sets skin, morph and rows of an item, as its geometry has joints and targets. */
bool gn_gltf_deform_item(struct gn_gltf *g, struct gn_item *item);

/* tangent.c: tangents for normal maps, as MikkTSpace defines them. */
struct gn_tangent_mesh {
    const float *positions, *normals, *uv; /* of vertices: 3, 3 and 2 each, finite */
    uint32_t *corners;                     /* of triangles; become indices into what is made */
    size_t corner_count, vertex_count;
};
struct gn_tangents {  /* in work memory */
    uint32_t *source; /* by vertex: its number before; those there were keep theirs */
    vec4 *tangents;
    size_t count; /* of vertices; at most corner_count, if each is that of a corner */
};
bool gn_tangents_make(struct gn_gltf *g, const struct gn_tangent_mesh *mesh,
                      struct gn_tangents *out);
size_t gn_tangents_bytes(size_t corner_count, size_t vertex_count); /* of work memory, about */

/* gltf/material.c: the sets of coordinates that a material's textures read (TEXCOORD_n): the first
 * two of them, or 0 and 1 where it names no other. The scene numbers them 0 and 1. material -1:
 * glTF's default. */
enum { GN_UV_SETS = 2 };
void gn_gltf_uv_sets(struct gn_gltf *g, int32_t material, uint64_t sets[GN_UV_SETS]);

/* gltf/material.c: what a material's normal map needs of a vertex. */
enum { GN_TANGENTS_NONE, GN_TANGENTS_UV, GN_TANGENTS_MATERIAL = 16 };
/* GN_TANGENTS_NONE without a normal map; GN_TANGENTS_UV + the set of its coordinates; or, where
 * they are transformed, GN_TANGENTS_MATERIAL + the material's number. */
int32_t gn_gltf_tangents(struct gn_gltf *g, int32_t material);
/* The coordinates that tangents are made for. */
struct gn_texture_ref gn_gltf_tangents_uv(struct gn_gltf *g, int32_t tangents);

/* gltf/image.c: the scene's texture for one of the file, created at its first use; -1: none, or
 * dropped with a warning. kind: of its picture, where that is made smaller. */
int32_t gn_gltf_texture(struct gn_gltf *g, int32_t texture, enum gn_scale_kind kind);
/* gltf/memory.c: how often sides must be halved to be within most_px; 0: that is no limit. */
uint32_t gn_gltf_halvings(const uint32_t px[2], uint32_t most_px);
/* Bytes that a picture may take beside what stays of it on the GPU. */
uint64_t gn_gltf_picture_room(const struct gn_gltf *g);
/* Fails where the picture is over a limit. whole: the same at its largest size, to which halvings
 * are counted. Where pictures would fit if they were halved, all that follow fail, too: what they
 * need is noted, and the scene is loaded again with smaller ones (gn_gltf_fit_pictures). */
bool gn_gltf_picture_fits(struct gn_gltf *g, const struct gn_picture_need *need,
                          const struct gn_picture_need *whole, struct gn_err *err);
/* At the end of a load: the longest side with which all pictures are within the limits; 0: they are
 * as they were loaded, or will not be. */
uint32_t gn_gltf_fit_pictures(const struct gn_gltf *g);
/* They are over that limit. False: they have been loaded again for that often enough. */
bool gn_gltf_halve_pictures(struct gn_gltf *g, const char *limit, uint64_t mb);

/* The time of decoding one of that size, as texels. */
uint64_t gn_gltf_picture_work(const uint32_t px[2]);
/* What is left of it for pictures. */
uint64_t gn_gltf_picture_time(const struct gn_gltf *g);
/* Counts a picture that was decoded. */
void gn_gltf_picture_count(struct gn_gltf *g, const struct gn_picture_need *need);

/* The levels of a KTX2 file that texture_px allows. */
bool gn_gltf_levels(struct gn_gltf *g, const struct gn_blob *blob, const struct gn_ktx2 *ktx2,
                    struct gn_image *image, struct gn_err *err);

/* gltf/glossiness.c: replaces a texture of the scene by one of roughness, 1 - factor x its alpha;
 * mean: of its colours, linear. False if it was made with another factor before, or failed. */
bool gn_gltf_glossiness(struct gn_gltf *g, float factor, int32_t *texture, float mean[3]);

/* gltf/extras.c: the gnomon_ keys. A wrong type or value gives a warning with the key, and the
 * default is kept. */
void gn_extras_node(struct gn_gltf *g, const struct gn_at *node, struct gn_placed *placed);
void gn_extras_light(struct gn_gltf *g, const struct gn_at *holder, struct gn_light *light);
/* lightmap_set: the number that the scene gives TEXCOORD_1, or -1. */
void gn_extras_material(struct gn_gltf *g, const struct gn_at *material, int lightmap_set,
                        struct gn_material *m);
void gn_extras_scene(struct gn_gltf *g, const struct gn_at *scene);

/* gltf/pointer.c: the property that a pointer names, if a pose can play it, and the number of the
 * thing in the file. */
bool gn_gltf_find_property(struct gn_gltf *g, const char *pointer, struct gn_property *property,
                           uint32_t *index);
/* Where the numbers of that thing go, if a clip names it, else NULL; *record: for the thing. */
void *gn_gltf_record(struct gn_gltf *g, enum gn_thing thing, size_t index, uint32_t *record);

/* gltf/variant.c */
/* A material of a primitive, where other variants have others. */
struct gn_variant_material {
    int32_t material; /* the file's number, or -1 */
    uint64_t in;      /* the same bits as those of gn_item.hidden_in: where it is shown */
};
/* How many there may be at most, and those that there are, the one without a variant first. */
size_t gn_gltf_variant_most(struct gn_gltf *g, const struct gn_at *primitive);
size_t gn_gltf_variant_materials(struct gn_gltf *g, const struct gn_at *primitive,
                                 struct gn_variant_material *out);
/* Puts items that variants hide at first into the planes of those in their place. */
void gn_gltf_variant_planes(struct gn_gltf *g);

/* plane.c: sets item->plane, by gnomon_plane or by finding large flat faces. pose: as the file
 * places the nodes. */
struct gn_pose;
void gn_scene_find_planes(struct gn_gltf *g, const struct gn_pose *pose);

/* extent.c: scene->extents, by poses of all clips. */
bool gn_scene_measure(struct gn_gltf *g, struct gn_pose *pose);
/* How long it takes until all that a pose plays has been seen together, 0 if nothing moves: clips
 * of different length meet differently each time. */
int64_t gn_scene_period_ns(const struct gn_pose *pose);
/* floor.c: adds the shadow catcher that limits.floor asks for. After gn_scene_measure(). */
void gn_scene_add_floor(struct gn_gltf *g, struct gn_pose *pose);

/* floor_occlusion.c: a new texture: in R the share of a uniform sky that a square of the floor sees
 * past the items that stay where they are, on average over the clips of the pose, which is stepped;
 * X to the right, Z down; 1 along its rim. middle: of the square. -1: out of memory, and the load
 * fails. */
int32_t gn_floor_occlusion(struct gn_gltf *g, struct gn_pose *pose, const float middle[3],
                           float side_m);

/* gltf/material.c: glTF's default material, and the defaults of every other. */
void gn_material_init(struct gn_material *material);

/* pose_anim.c: the value of a channel at a time, its components. */
void gn_channel_sample(const struct gn_channel *channel, double time_s, float *out);
/* It hides and shows its node. */
bool gn_channel_hides(const struct gn_scene *scene, const struct gn_channel *channel);

/* deform.c: of the upper 3x3; returns the determinant */
double gn_cofactor(mat4 m, mat3 out);

#endif
