/* A writer of binary glTF 2.0, for programs that make scenes: gnomon dial and those of assets/.
 *
 * Objects are identified by handles; handle 0 means "none", so a zeroed description is legal.
 * Floats are stored in the shortest decimal form that reads back as the same float, and the same
 * calls give the same bytes. Out of memory aborts; an invalid description is a bug (assert). */
#ifndef GN_SHAPE_GLB_H
#define GN_SHAPE_GLB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/file.h"

struct gn_glb;
struct gn_shape;

enum gn_glb_alpha { GN_GLB_OPAQUE, GN_GLB_MASK, GN_GLB_BLEND };
enum gn_glb_wrap { GN_GLB_REPEAT, GN_GLB_CLAMP, GN_GLB_MIRROR };
enum gn_glb_light_kind { GN_GLB_DIRECTIONAL, GN_GLB_POINT, GN_GLB_SPOT };
enum gn_glb_path { GN_GLB_TRANSLATION, GN_GLB_ROTATION, GN_GLB_SCALE };
enum gn_glb_interpolation { GN_GLB_LINEAR, GN_GLB_STEP, GN_GLB_CUBICSPLINE };

struct gn_glb_material {
    const char *name;
    float rgba[4];      /* linear base colour; alpha 0 means 1 */
    float metal, rough; /* 0..1 */
    float emissive[3];  /* linear */
    int texture;        /* base colour */
    int rough_texture;  /* G: roughness, B: metalness */
    int emissive_texture, normal_texture, occlusion_texture;
    enum gn_glb_alpha alpha; /* MASK cuts at .5 */
    bool double_sided;
    /* material extensions, left out where 0 */
    float coat, coat_rough; /* KHR_materials_clearcoat */
    float transmission;     /* KHR_materials_transmission */
    float ior;              /* KHR_materials_ior */
    float glow;             /* KHR_materials_emissive_strength */
};

struct gn_glb_node {
    const char *name;
    int parent; /* 0: a root of the scene */
    int mesh, camera, light;
    float move[3];       /* metres */
    float turn[4];       /* quaternion x y z w; all 0 means none */
    float scale[3];      /* all 0 means 1 */
    const float *matrix; /* 16, column major; replaces the three above */
    const char *extras;  /* a JSON object */
};

struct gn_glb_camera {
    const char *name;
    float aspect;      /* width / height of its picture, perspective only; 0 means not said */
    float yfov;        /* radians; 0 means orthographic */
    float xmag, ymag;  /* orthographic: half width, half height in metres */
    float znear, zfar; /* metres; zfar 0 means infinite (perspective only) */
};

struct gn_glb_light {
    const char *name;
    enum gn_glb_light_kind kind;
    float rgb[3];       /* linear; all 0 means white */
    float intensity;    /* lux (directional) or candela */
    float range;        /* metres; 0 means unlimited */
    float inner, outer; /* spot: half angles in radians */
    const char *extras; /* a JSON object */
};

struct gn_glb_channel {
    int node;
    enum gn_glb_path path;
    enum gn_glb_interpolation interpolation;
    int keys;
    const float *times; /* of the keys, seconds, ascending */
    const float
        *values; /* keys x 3 or 4; CUBICSPLINE: in-tangent, value, out-tangent of each key */
};

/* `generator` is the program that makes it; `copyright` may be NULL. */
struct gn_glb *gn_glb_create(const char *generator, const char *copyright);
void gn_glb_destroy(struct gn_glb *glb);

/* Copies the shape's vertices and triangles into the file; any number of meshes may share the
 * result. */
int gn_glb_geometry(struct gn_glb *glb, const struct gn_shape *shape);
/* A texture of a PNG file, which is copied; filtering is trilinear. */
int gn_glb_picture(struct gn_glb *glb, const char *name, const void *png, size_t size,
                   enum gn_glb_wrap wrap);
int gn_glb_material(struct gn_glb *glb, const struct gn_glb_material *material);
int gn_glb_mesh(struct gn_glb *glb, const char *name, int geometry, int material);
/* Adds a primitive to an existing mesh. */
void gn_glb_mesh_add(struct gn_glb *glb, int mesh, int geometry, int material);
int gn_glb_camera(struct gn_glb *glb, const struct gn_glb_camera *camera);
int gn_glb_light(struct gn_glb *glb, const struct gn_glb_light *light);
int gn_glb_node(struct gn_glb *glb, const struct gn_glb_node *node);
int gn_glb_animation(struct gn_glb *glb, const char *name);
void gn_glb_channel(struct gn_glb *glb, int animation, const struct gn_glb_channel *channel);
void gn_glb_scene_extras(struct gn_glb *glb, const char *json);

/* The whole file; free with gn_bytes_finish. */
void gn_glb_build(struct gn_glb *glb, struct gn_bytes *out);

/* The rotation that makes a camera or light (both look along their -Z) at `eye` look at `target`, Y
 * up. */
void gn_glb_look(const float eye[3], const float target[3], float turn[4]);
/* The rotation about +Y. */
void gn_glb_turn_y(float degrees, float turn[4]);

#endif
