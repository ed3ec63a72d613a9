/* Attributes of a vertex: one row each, from the semantic in glTF to the input in GLSL. A row gives
 * the enum below, gn_attributes[], an array of struct gn_scene_buffers (scene.h) and, in gl/, its
 * place in the vertex buffer and the input `a_name` at the location of its number. To add one: a
 * row here, and the shader that reads it. */
#ifndef GN_SCENE_ATTRIBUTE_H
#define GN_SCENE_ATTRIBUTE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* X(NAME, name, type and name of the array in gn_scene_buffers, semantic, fewest components in a
 * file, components in the scene, component types in a file, format, value where a file has none) */
#define GN_PLAIN_ATTRIBUTES(X)                                                                     \
    X(POSITION, position, float, positions, "POSITION", 3, 3, ANY, FLOAT, 0)                       \
    X(NORMAL, normal, float, normals, "NORMAL", 3, 3, SIGNED, SNORM16, 0) /* made where missing */ \
    X(UV0, uv0, float, uv0, "TEXCOORD_0", 2, 2, ANY, FLOAT, 0)                                     \
    X(UV1, uv1, float, uv1, "TEXCOORD_1", 2, 2, ANY, FLOAT, 0)                                     \
    X(TANGENT, tangent, float, tangents, "TANGENT", 4, 4, SIGNED, SNORM16, 0) /* as normal maps    \
        need them: made where missing; w: the sign of the bitangent */                             \
    X(JOINTS0, joints0, uint16_t, joints0, "JOINTS_0", 4, 4, UNSIGNED, UINT16, 0)                  \
    X(WEIGHTS0, weights0, uint16_t, weights0, "WEIGHTS_0", 4, 4, UNSIGNED, UNORM16, 0)             \
    X(JOINTS1, joints1, uint16_t, joints1, "JOINTS_1", 4, 4, UNSIGNED, UINT16, 0)                  \
    X(WEIGHTS1, weights1, uint16_t, weights1, "WEIGHTS_1", 4, 4, UNSIGNED, UNORM16, 0) /* all of   \
        meshes with a skin; the weights of a vertex are 1 together */

/* The same, of those that are a feature of a program, VERTEX_NAME (frame/feature.h), where a
 * geometry has them. */
#define GN_FEATURE_ATTRIBUTES(X)                                                                   \
    X(COLOR, color, uint8_t, colors, "COLOR_0", 3, 4, UNSIGNED, UNORM8, 1) /* linear */

#define GN_ATTRIBUTES(X) GN_PLAIN_ATTRIBUTES(X) GN_FEATURE_ATTRIBUTES(X)

enum gn_attribute {
#define GN_X(NAME, ...) GN_ATTRIBUTE_##NAME,
    GN_ATTRIBUTES(GN_X)
#undef GN_X
        GN_ATTRIBUTE_COUNT,
};
#define GN_X(...) +1 /* NOLINT(bugprone-macro-parentheses) */
enum {
    GN_FEATURE_ATTRIBUTE_COUNT = 0 GN_FEATURE_ATTRIBUTES(GN_X),
    GN_PLAIN_ATTRIBUTE_COUNT = GN_ATTRIBUTE_COUNT - GN_FEATURE_ATTRIBUTE_COUNT,
};
#undef GN_X

/* In the scene, and how a GPU gets it. The formats of skins stand last here: their attributes are
 * read by gn_skin_put_vertices(). */
enum gn_attribute_format {
    GN_ATTRIBUTE_FLOAT,   /* floats; the same */
    GN_ATTRIBUTE_SNORM16, /* floats -1..1; four shorts */
    GN_ATTRIBUTE_UNORM8,  /* four bytes that stand for 0..1; the same */
    GN_ATTRIBUTE_UINT16,  /* four numbers; the same */
    GN_ATTRIBUTE_UNORM16, /* four that stand for 0..1; the same */
    GN_ATTRIBUTE_FORMAT_COUNT,
};

#define GN_GPU_BYTES_FLOAT(components)   (4 * (components))
#define GN_GPU_BYTES_SNORM16(components) 8
#define GN_GPU_BYTES_UNORM8(components)  4
#define GN_GPU_BYTES_UINT16(components)  8
#define GN_GPU_BYTES_UNORM16(components) 8
#define GN_X(NAME, name, type, field, semantic, least, components, types, format, ...)             \
    +GN_GPU_BYTES_##format(components)                    /* NOLINT(bugprone-macro-parentheses) */
enum { GN_ATTRIBUTES_GPU_BYTES = 0 GN_ATTRIBUTES(GN_X) }; /* of a vertex that has all */
#undef GN_X

struct gn_attribute_row {
    const char *name, *semantic;
    uint8_t components_min, components;
    uint32_t types; /* bit per component type that a file may have, from GN_I8 on */
    enum gn_attribute_format format;
    bool missing_is_1; /* where others of the scene have it, and of components that a file lacks */
    uint8_t bytes, gpu_bytes; /* of one element */
};
extern const struct gn_attribute_row gn_attributes[GN_ATTRIBUTE_COUNT];

#endif
