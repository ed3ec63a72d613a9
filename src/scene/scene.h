/* A scene: a glTF file, checked, resolved and ready to draw. Immutable after loading; knows no GL
 * and no clock; has all that a new GL context needs. Right-handed, Y up, metres, linear colour.
 * Every index in it has been checked. */
#ifndef GN_SCENE_SCENE_H
#define GN_SCENE_SCENE_H

#include <cglm/types.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"
#include "core/warn.h"
#include "image/packing.h"
#include "scene/attribute.h"
#include "scene/light.h"
#include "scene/material.h"

struct gn_box { /* axis-aligned; empty when min > max */
    vec3 min, max;
};

enum { GN_CUTOFFS_MAX = 4 };
/* Pixels of a decoded picture. Row 0 is the top row, which glTF puts at v = 0. */
struct gn_image {
    uint32_t width_px, height_px;
    const uint8_t *rgba; /* width x height x 4, sRGB-encoded or linear as its use requires; NULL:
                            it is compressed into blocks */
    const uint8_t
        *levels; /* of KTX2, for the GPU as they are, the largest first; NULL: rgba alone */
    enum gn_packing packing; /* of them */
    uint32_t level_count;
    bool has_alpha;                /* some texel is not opaque */
    bool as_data, as_color;        /* materials and lights read it so: a texture of each format */
    bool mipmaps;                  /* of these */
    float cutoffs[GN_CUTOFFS_MAX]; /* of masked materials, as its alpha must reach them: a texture
                                      for each, unless it has levels of its own */
    uint32_t cutoff_count;
};

enum gn_wrap { GN_WRAP_REPEAT, GN_WRAP_CLAMP, GN_WRAP_MIRROR };
struct gn_texture {
    uint32_t image;
    enum gn_wrap wrap_s, wrap_t;
    bool mag_nearest;
    bool min_nearest; /* within a level */
    bool mipmaps;     /* the sampler's min filter uses them; default true */
    bool mip_nearest; /* between levels; false = trilinear */
};

struct gn_texture_ref {
    int32_t texture; /* index, or -1: none */
    uint8_t uv_set;  /* 0 or 1: of the two sets of coordinates that the material reads */
    /* uv' = (m[0] u + m[2] v + m[4], m[1] u + m[3] v + m[5]): KHR_texture_transform, identity
     * without */
    float uv_from_uv[6];
};

#define GN_F0 .04f /* of an index of refraction of 1.5 */
/* What of a material clips may move. Programs are chosen for all that it may become. */
enum gn_material_moves {
    GN_MOVES_BASE = 1,
    GN_MOVES_METAL = 2,
    GN_MOVES_ROUGH = 4,
    GN_MOVES_EMISSIVE = 8,
    GN_MOVES_CUTOFF = 16,
    GN_MOVES_NORMAL = 32,
    GN_MOVES_OCCLUSION = 64,
    GN_MOVES_F0 = 128,
    GN_MOVES_UV = 256, /* transforms of its textures */
    GN_MOVES_FIRST_LAYER = 512,
#define GN_X(NAME, ...) GN_MOVES_##NAME = GN_MOVES_FIRST_LAYER << GN_LAYER_##NAME,
    GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
        GN_MOVES_LAYERS = GN_MOVES_FIRST_LAYER * ((1 << GN_LAYER_COUNT) - 1),
    GN_MOVES_CUT = GN_MOVES_BASE | GN_MOVES_CUTOFF | GN_MOVES_TRANSMISSION | GN_MOVES_UV,
};
enum gn_alpha { GN_ALPHA_OPAQUE, GN_ALPHA_MASK, GN_ALPHA_BLEND };
struct gn_material {
    const char *name; /* never NULL */
    vec4 base_color;  /* linear, factors; alpha last */
    vec3 emissive;    /* linear radiance, KHR_materials_emissive_strength applied */
    float roughness, metalness, occlusion_strength, alpha_cutoff;
    float normal_scale; /* of x and y of the normal map */
    float lightmap_intensity;
    float factors[GN_FACTORS_SIZE]; /* of its layers: [GN_FACTOR_COAT]; 0 if unlit */
    vec3 f0;                        /* reflectance at normal incidence of what is no metal; GN_F0 */
    enum gn_alpha alpha;
    bool double_sided, unlit;
    bool shadow_catcher; /* unseen: black, its alpha the share of light that shadows take from it */
    struct gn_texture_ref textures[GN_TEXTURE_SLOT_COUNT];
    uint32_t moves;  /* enum gn_material_moves */
    uint32_t record; /* its first float in animation.records, plus 1; 0: no clip names it */
};

/* Where a part of the pose's texels begins: the pose writes them, vertex shaders fetch them. A
 * joint takes the three texels of a row, the rows of its matrix; joints follow downwards. */
struct gn_strip {
    uint16_t x, y;
};
enum {
    GN_STRIP_WIDTH = 3,
    GN_JOINTS_MAX = 1024,      /* of a skin, and targets of a mesh */
    GN_POSE_WIDTH_MAX = 2046,  /* texels, of strips side by side; each GN_JOINTS_MAX high */
    GN_DELTAS_WIDTH = 2048,    /* texels of a row, of the texture of all targets' deltas */
    GN_DELTAS_ROWS_MAX = 4096, /* as large as textures are on every board */
};

struct gn_joint {
    int32_t node; /* -1: none of the shown scene; it stays as in the bind pose */
    mat4 joint_from_mesh;
};
struct gn_skin {                       /* one per skin of the file that is in use */
    uint32_t first_joint, joint_count; /* of deformation.joints */
    struct gn_strip rows;              /* world_from_mesh of each joint */
};
struct gn_morphed {                            /* a node whose mesh has targets */
    uint32_t node, first_weight, weight_count; /* of deformation.weights */
    struct gn_strip list; /* of targets with a weight: (weight, number), a texel each */
};
struct gn_targets { /* of a geometry */
    uint32_t count, first_texel;
    uint8_t parts;        /* 1: positions; 2: and normals; 3: and tangents */
    vec4 *deltas;         /* target by target, part by part, vertex by vertex; w: 0 */
    struct gn_box *boxes; /* of the deltas of positions, by target */
};
struct gn_joint_box { /* of the vertices that a joint moves, mesh space */
    uint32_t joint;
    struct gn_box box;
};

/* One unique set of accessors: a range of the scene's vertices and indices. Triangles only (strips
 * and fans are unrolled). Primitives that name the same accessors share one geometry whatever their
 * materials; geometries with the same vertex accessors share the range of vertices, but for those
 * whose normals or tangents are made. One without
 * indices (nothing of it could be shown) has no items. */
struct gn_geometry {
    uint32_t first_vertex, vertex_count;
    uint32_t first_index,
        index_count;     /* a multiple of 3; indices are absolute, into buffers.positions */
    struct gn_box box;   /* mesh space */
    uint32_t attributes; /* bit per gn_attribute that the file has, and TANGENT where it was made */
    float layers[3]; /* how many of its triangles lie on one another, on average, along each axis
                        of mesh space: their area as seen along it, over that of the box */
    bool flat;       /* all vertices lie in one plane (within 1e-5 of the box's diagonal) */
    bool watertight; /* a line crosses as many front as back faces; false when in doubt */
    bool closed;     /* watertight, the boundary of solid bodies, front faces outward */
    vec4 plane; /* mesh space, if flat: n.p + d = 0, |n| = 1, on the side its front faces look to */
    const double *origin; /* mesh space: taken off its positions, as they lay far off; NULL: 0 */
    struct gn_joint_box *joint_boxes; /* by ascending joint, if it has joints */
    uint32_t joint_box_count;
    struct gn_targets *targets; /* or NULL */
};

static inline bool gn_geometry_has(const struct gn_geometry *geometry,
                                   enum gn_attribute attribute) {
    return geometry->attributes >> attribute & 1;
}

/* One thing to draw: a primitive of a node's mesh, or of one instance of it
 * (EXT_mesh_gpu_instancing). Sorted so that items that can share an instanced call (same geometry,
 * materials that differ only in factors, same flags) stand together. */
enum { GN_PLANES_MAX = 4 }; /* that receive planar shadows */
enum gn_cast_faces { GN_CAST_BOTH, GN_CAST_FRONT, GN_CAST_BACK, GN_CAST_AUTO, GN_CAST_MIDDLE };
struct gn_item {
    uint32_t node, geometry, material;
    int32_t instance;     /* index into scene->instances, or -1 */
    int32_t skin, morph;  /* indices into deformation.skins and .morphs, or -1 */
    struct gn_strip rows; /* of a deformed one: of its skin, or of its own matrix */
    uint32_t batch;       /* equal for items that can share a call; ascending */
    bool casts, receives; /* gnomon_cast, gnomon_receive */
    bool casts_alpha;     /* gnomon_cast_alpha: blended, it casts a shadow by its alpha, dithered */
    uint64_t hidden_in;   /* bit 0: without a variant; bit i + 1: in variant i */
    uint8_t plane;        /* in which it receives planar shadows, from 1; 0: in none */
    bool stays; /* over the clips that play by default it stays where it is, no clip of the file
                   hides it, and it is no shadow catcher */
    enum gn_cast_faces cast_faces;
};

/* Its vertices are posed one by one, by texels of the pose. */
static inline bool gn_item_is_deformed(const struct gn_item *item) {
    return item->skin >= 0 || item->morph >= 0;
}

struct gn_node {
    const char *name; /* never NULL */
    int32_t parent;   /* index < its own, or -1: parents stand before children */
    bool has_matrix;  /* then `matrix`, else translation, rotation (xyzw, unit), scale */
    mat4 matrix;
    vec3 translation, scale;
    versor rotation;
    vec3 rest;       /* what floats lack of the translation, or of that of the matrix */
    bool hidden;     /* with all below it; KHR_node_visibility */
    uint32_t record; /* of that, as of a material */
};

/* One per node that has a light, in the order of a depth-first walk of the scene. */
struct gn_light {
    const char *name;
    uint32_t node; /* shines along its -Z */
    enum gn_light_type type;
    vec3 color;                 /* linear, times intensity: lux (directional) or candela */
    float range_m;              /* 0: unlimited */
    float inner_rad, outer_rad; /* half-angles of a spot, inner < outer */
    float radius;               /* metres, or tangent of the angular radius (directional) */
    const char *technique;      /* gnomon_shadow, or NULL */
    uint32_t map_px;            /* 0: the default */
    float shadow_strength;      /* 1 */
    float
        shadow_specular; /* share of highlights that stays in shadow; -1: as much as of the rest */
    int32_t slide;       /* texture of the gobo, or -1 */
    float slide_size_m[2];  /* 0, 0: fills the cone at its distance */
    float slide_distance_m; /* 0: the distance at which its longer side spans the cone */
    float slide_far_m;      /* depth at which its picture ends; 0: nowhere */
    bool slide_lit_outside; /* light outside the slide: yes (film), no (projector) */
    bool range_moves;       /* by a clip */
    bool is_sun;            /* gnomon_sun; directional */
    uint32_t record;        /* as of a material */
};

struct gn_camera {
    const char *name;
    uint32_t node; /* looks along its -Z */
    bool orthographic;
    float yfov_rad;       /* perspective, of a picture of this aspect or a wider one */
    float aspect;         /* perspective; 0: any. A narrower picture keeps the horizontal angle */
    float xmag_m, ymag_m; /* orthographic half-sizes */
    float near_m, far_m;  /* far 0: infinite */
    uint32_t record;      /* as of a material */
};

enum gn_anim_path {
    GN_ANIM_TRANSLATION,
    GN_ANIM_ROTATION,
    GN_ANIM_SCALE,
    GN_ANIM_WEIGHTS,
    GN_ANIM_RECORD
};
enum gn_anim_interpolation { GN_ANIM_LINEAR, GN_ANIM_STEP, GN_ANIM_CUBIC };
struct gn_channel {
    uint32_t node; /* not of RECORD */
    enum gn_anim_path path;
    enum gn_anim_interpolation interpolation;
    uint32_t key_count;
    uint32_t components;  /* 3, 4, or of WEIGHTS as many as the node's mesh has targets */
    int32_t morph;        /* of WEIGHTS: index into deformation.morphs */
    uint32_t record;      /* of RECORD: its first float in animation.records */
    const char *pointer;  /* the same: as the file names it */
    const float *times_s; /* ascending, finite, >= 0 */
    const float *values;  /* key_count x components, x 3 for cubic (in-tangents, values,
                             out-tangents) */
};
struct gn_clip {
    const char *name;
    uint32_t first_channel, channel_count;
    int64_t duration_ns; /* time of the last key; 0 for one key */
    bool on_by_default;  /* its channels do not collide with an earlier clip's */
};

struct gn_scene_buffers { /* vertices and indices of all geometries */
    union { /* the rows of scene/attribute.h, an array each; NULL if no geometry has any */
        struct {
#define GN_X(NAME, name, type, field, ...) type *field;
            GN_ATTRIBUTES(GN_X) /* positions, normals, uv0 .. joints1, weights1, colors */
#undef GN_X
        };
        void *attributes[GN_ATTRIBUTE_COUNT];
    };
    /* Of each vertex: sine of the largest angle between its normal and those of its faces, as
     * SNORM16. NULL: all 0. */
    int16_t *spreads;
    uint32_t *indices;
    uint32_t vertex_count, index_count;
};
struct gn_scene_pictures {
    struct gn_image *images;
    struct gn_texture *textures; /* images and how they are sampled */
    uint32_t image_count, texture_count;
};
/* Kinds of things that clips move (scene/property.h). */
enum gn_thing { GN_THING_LIGHT, GN_THING_CAMERA, GN_THING_MATERIAL, GN_THING_NODE, GN_THING_COUNT };
struct gn_scene_animation {
    struct gn_clip *clips;
    struct gn_channel *channels; /* of all clips, clip by clip */
    uint32_t clip_count, channel_count;
    float *records; /* of what clips move beside nodes, as the file has it (scene/property.h) */
    uint32_t record_floats;
    bool names[GN_THING_COUNT]; /* whether some of that kind have records */
    bool has_hidden;            /* nodes, or some may be hidden */
};
struct gn_scene_deformation { /* skins and targets of meshes */
    struct gn_skin *skins;
    struct gn_joint *joints;
    struct gn_morphed *morphs;
    float *weights; /* as the file has them */
    uint32_t skin_count, joint_count, morph_count, weight_count;
    uint32_t width, height;         /* of the pose's texels; 0: nothing is deformed */
    uint64_t delta_texels;          /* of all targets */
    uint32_t column, column_height; /* of the loader: where the next strip goes */
};
/* Points that stand for all that is drawn: it lies within their convex hull, except for 2 % of its
 * radius. World space. */
struct gn_extent {
    vec3 *points;
    uint32_t count; /* 1 to 128 */
};
struct gn_scene_environment { /* linear, after exposure */
    vec3 sky, ground;         /* radiance of the hemispheres */
    vec3 background;
    bool has_background; /* the file names one */
    float north_deg; /* gnomon_north: north is -Z turned by this about +Y, counter-clockwise seen
                        from above */
};
/* KHR_materials_variants: of a primitive with several materials there is an item for each, which
 * the pose hides in the variants of the others. */
enum { GN_VARIANTS_MAX = 63 };
struct gn_scene_variants {
    const char **names;
    uint32_t count;
};
/* Where ambient occlusion of what stays where it is has room: a grid of cubes whose middles enclose
 * it, without clips and over those that play by default. Of a uniform sky a point of its surface,
 * of normal n, sees the share w + (x, y, z).n, between 0 and 1; x, y, z and w are of the cubes'
 * middles, linear between them. The texels of the grid are made by truth/occlusion.h. */
struct gn_scene_occlusion {
    uint32_t size[3]; /* cubes, 2 at least; 0: nothing stays */
    float cell_m;     /* side of a cube */
    float origin[3];  /* middle of the first, world space; x changes first from cube to cube */
};
struct gn_scene_added {        /* by the loader, as the last one, because the file has none */
    bool light, camera, floor; /* the floor: an item whose material is a shadow catcher */
};
struct gn_scene_memory {
    size_t bytes;         /* of the scene */
    size_t loading_bytes; /* at most while it was loaded: with the file and what the GPU will have
                             of its pictures; what memory_mb limits */
    void *arena;          /* private */
};

/* World space has its origin where the file has this point: 0, unless all is far from the file's
 * own. What a user names or reads in the file's coordinates is converted where it comes in. */
struct gn_scene_place {
    double origin[3];
    bool exact; /* something lies, or is moved, so far off that poses are made in doubles */
};

struct gn_scene {
    const char *name;
    const char *missing; /* what the file asks for and is shown without: "skins, sheen", or "" */
    struct gn_scene_buffers buffers;
    struct gn_geometry *geometries;
    struct gn_material *materials; /* after those of the file glTF's default material */
    struct gn_node *nodes;         /* of the shown scene only */
    mat4 *instances;               /* node_from_instance */
    struct gn_item *items;
    struct gn_light *lights;
    struct gn_camera *cameras;
    uint32_t geometry_count, material_count, node_count, instance_count, item_count, light_count,
        camera_count, batch_count;
    uint32_t material_textures; /* of the material with most */
    struct gn_scene_pictures pictures;
    struct gn_scene_animation animation;
    struct gn_scene_deformation deformation;
    struct gn_scene_environment environment;
    struct gn_scene_occlusion occlusion;
    struct gn_scene_added added;
    struct gn_scene_variants variants;
    struct gn_extent *extents; /* over the time of all clips that a pose plays: at its `clips` minus
                                  GN_POSE_NONE */

    struct gn_scene_place place;
    struct gn_box
        box; /* of everything visible, world space, nodes as the file places them; never empty */
    uint64_t triangle_count; /* of all items that are shown without a variant */
    bool planes_named;       /* by gnomon_plane; else those that there are were found */
    struct gn_scene_memory memory;
};

/* An unseen floor that catches shadows; the zero value: none. */
struct gn_scene_floor {
    enum gn_floor {
        GN_FLOOR_NONE,
        GN_FLOOR_AUTO, /* under the model, where the scene has no floor of its own */
        GN_FLOOR_HEIGHT,
    } kind;
    double height_m; /* HEIGHT: y, as the file has it */
};

/* Side of the square that its occlusion texture covers, in halves of the floor's side. */
#define GN_FLOOR_OCCLUDED .375f

/* Limits on what a file may use; 0 = the default beside each, which in megabytes is less on a
 * machine with little memory. The names are those of --limit. */
struct gn_scene_limits {
    uint64_t file_mb;             /* 512: any one file read */
    uint64_t memory_mb;           /* 1024: all that the scene holds: geometry, decoded pictures
                                     with what the GPU will have of them, the file, and what a
                                     pose and a frame take */
    uint64_t nodes;               /* 100000 */
    uint64_t instances;           /* 1000000 */
    uint64_t vertices;            /* 20000000 */
    uint64_t texels;              /* 67108864 per picture (8192 x 8192), 10 times that in all */
    uint64_t keys;                /* 4000000 animation keys */
    uint64_t json_depth;          /* 512 */
    uint64_t seconds;             /* 60: processor time that the load takes, and time that the
                                     import of another format takes before it */
    uint64_t gpu_mb;              /* 1024: its textures and buffers on the GPU */
    uint64_t maps_mb;             /* 384: what shadows take on the GPU in one frame */
    uint64_t triangles_per_frame; /* 100000000: of all nodes and their instances, in the picture and
                                     in the maps of lights; an item counts as 100 there */
    uint64_t overdraw;      /* 100: how often a frame draws a pixel, on average; opaque ones count a
                               quarter */
    uint64_t decoded_mb;    /* 1024: decoded pictures, with what decoding one takes. Over it,
                               or gpu_mb or memory_mb, the largest pictures are halved until
                               all fit, with a warning; what still does not is left out */
    uint64_t ahead_percent; /* 10: programs of modes that were not shown yet, of the memory
                               that is in use without them */
    const atomic_bool *cancel;   /* another thread sets it to end the load, which fails; or NULL */
    atomic_uint *progress;       /* gets how much of the load is done, per mille; or NULL */
    struct gn_scene_floor floor; /* no limit: what is added to the file */
    uint32_t texture_px;         /* pictures of longer sides become smaller; 0: none does */
};
/* Sets a limit by name; false and a usage error that lists the names if it is unknown. */
bool gn_scene_limits_set(struct gn_scene_limits *limits, const char *name, uint64_t value,
                         struct gn_err *err);
/* Whether it is over what holds now, a default included; false of what is no limit's name. */
bool gn_scene_limits_raise(const struct gn_scene_limits *limits, const char *name, size_t length,
                           uint64_t value);
/* The limits with defaults filled in; limits may be NULL. */
struct gn_scene_limits gn_scene_limits_or_default(const struct gn_scene_limits *limits);
/* "file_mb=512, memory_mb=1024, ..": the limits with their defaults filled in. NULL: all defaults
 * on this machine. */
void gn_scene_limits_print(const struct gn_scene_limits *limits, char *out, size_t size);
/* The same as documents have it, on any machine: all names with their defaults. */
void gn_scene_limits_list(char *out, size_t size);

/* Loads a .glb or .gltf (by content, not by name) with the files it names, which must be in its
 * folder or below. On failure NULL, and one line with the file and the JSON path or byte offset.
 * limits and warnings may be NULL. */
struct gn_scene *gn_scene_load(const char *path, const struct gn_scene_limits *limits,
                               struct gn_warnings *warnings, struct gn_err *err);
/* The same from memory; external files are refused. label names the file in messages. */
struct gn_scene *gn_scene_load_bytes(const char *label, const void *data, size_t size,
                                     const struct gn_scene_limits *limits,
                                     struct gn_warnings *warnings, struct gn_err *err);
/* The same for the bytes of a glTF file that stands for the one at path: URIs are relative to its
 * folder. */
struct gn_scene *gn_scene_load_converted(const char *path, const void *data, size_t size,
                                         const struct gn_scene_limits *limits,
                                         struct gn_warnings *warnings, struct gn_err *err);
/* Whether a file that cannot be loaded lists that extension of glTF. Reads the file. */
bool gn_scene_uses(const char *path, const struct gn_scene_limits *limits, const char *extension);
void gn_scene_destroy(struct gn_scene *scene);

/* Whether the light from all around that an item gets is looked up in the scene's volume of
 * occlusion. Materials with all textures that one may have leave no sampler for it. */
bool gn_item_is_occluded(const struct gn_scene *scene, const struct gn_item *item);

/* What the GPU will have of a picture, with mipmaps, and of all indices, which have 16 bits where
 * that is enough. */
uint64_t gn_scene_image_bytes(const struct gn_image *image);
uint64_t gn_scene_index_bytes(const struct gn_scene *scene);
/* The cutoff of its picture by which a masked material reads this slot, of a texture whose levels
 * are at or over it as much as the picture is; -1: it reads the picture as it is. */
int gn_scene_find_cutoff(const struct gn_scene *scene, const struct gn_material *material,
                         enum gn_texture_slot slot);
/* What the GPU will have of morph targets, and of the texels of poses. */
uint64_t gn_scene_deformation_bytes(const struct gn_scene *scene);
/* Size of a vertex in GPU memory. */
uint32_t gn_scene_vertex_bytes(const struct gn_scene *scene);
uint64_t gn_scene_gpu_bytes(const struct gn_scene *scene); /* all of these of a scene */

/* By name, else by number; -1 and a usage error that lists all. NULL or "" finds the first. */
int gn_scene_find_camera(const struct gn_scene *scene, const char *what, struct gn_err *err);
int gn_scene_find_light(const struct gn_scene *scene, const char *what, struct gn_err *err);
int gn_scene_find_variant(const struct gn_scene *scene, const char *what, struct gn_err *err);
int gn_scene_find_clip(const struct gn_scene *scene, const char *what, struct gn_err *err);

#endif
