/* What clips move beside nodes: properties of lights, cameras and materials, and whether nodes are
 * shown (KHR_animation_pointer, KHR_node_visibility). A thing that a clip names has a record of
 * numbers as a file has them; a pose makes the thing of it. To add a property: a row here, its
 * field in a record, and what is made of it in property.c. */
#ifndef GN_SCENE_PROPERTY_H
#define GN_SCENE_PROPERTY_H

#include "scene/scene.h"

/* Records: floats alone, so that a clip writes any of them. */
struct gn_light_record {
    float color[3], intensity, range_m, inner_rad, outer_rad;
};
struct gn_camera_record {
    float yfov_rad, aspect, xmag_m, ymag_m, near_m, far_m;
};
struct gn_uv_record { /* KHR_texture_transform */
    float offset[2], scale[2], rotation_rad;
};
struct gn_material_record {
    float base_color[4], metalness, roughness;
    float emissive[3], emissive_strength;
    float alpha_cutoff, normal_scale, occlusion_strength;
    float ior, specular, specular_color[3];
    float factors[GN_FACTORS_SIZE]; /* of layers */
    float tint[3];                  /* of the volume: of what is transmitted; no property */
    struct gn_uv_record uv[GN_TEXTURE_SLOT_COUNT];
};
struct gn_node_record {
    float visible; /* 0: no */
};

/* X(THING, path in its JSON, record, field, components, least, most) */
#define GN_PROPERTIES(X)                                                                           \
    X(LIGHT, "color", light, color, 3, 0, 1e18f)                                                   \
    X(LIGHT, "intensity", light, intensity, 1, 0, 1e18f)                                           \
    X(LIGHT, "range", light, range_m, 1, 1e-6f, 1e18f)                                             \
    X(LIGHT, "spot.innerConeAngle", light, inner_rad, 1, 0, GLM_PI_2f)                             \
    X(LIGHT, "spot.outerConeAngle", light, outer_rad, 1, 1e-3f, GLM_PI_2f)                         \
    X(CAMERA, "perspective.yfov", camera, yfov_rad, 1, 1.1e-3f, 3.14f)                             \
    X(CAMERA, "perspective.aspectRatio", camera, aspect, 1, 1e-3f, 1e3f)                           \
    X(CAMERA, "perspective.znear", camera, near_m, 1, 1e-6f, 1e15f)                                \
    X(CAMERA, "perspective.zfar", camera, far_m, 1, 2e-6f, 1e18f)                                  \
    X(CAMERA, "orthographic.xmag", camera, xmag_m, 1, 1e-6f, 1e15f)                                \
    X(CAMERA, "orthographic.ymag", camera, ymag_m, 1, 1e-6f, 1e15f)                                \
    X(CAMERA, "orthographic.znear", camera, near_m, 1, 0, 1e15f)                                   \
    X(CAMERA, "orthographic.zfar", camera, far_m, 1, 1e-6f, 1e18f)                                 \
    X(NODE, "extensions.KHR_node_visibility.visible", node, visible, 1, 0, 1e18f)

/* Of materials, which are also loaded by this table, beside the factors of layers: X(path in its
 * JSON, field of the record, components, bit of gn_material.moves, default, least, most) */
#define GN_MATERIAL_PROPERTIES(X)                                                                  \
    X("pbrMetallicRoughness.baseColorFactor", base_color, 4, BASE, 1, 0, 1e4f)                     \
    X("pbrMetallicRoughness.metallicFactor", metalness, 1, METAL, 1, 0, 1)                         \
    X("pbrMetallicRoughness.roughnessFactor", roughness, 1, ROUGH, 1, 0, 1)                        \
    X("emissiveFactor", emissive, 3, EMISSIVE, 0, 0, 1e9f)                                         \
    X("extensions.KHR_materials_emissive_strength.emissiveStrength", emissive_strength, 1,         \
      EMISSIVE, 1, 0, 1e9f)                                                                        \
    X("alphaCutoff", alpha_cutoff, 1, CUTOFF, .5f, 0, 2)                                           \
    X("normalTexture.scale", normal_scale, 1, NORMAL, 1, -1e4f, 1e4f)                              \
    X("occlusionTexture.strength", occlusion_strength, 1, OCCLUSION, 1, 0, 1)                      \
    X("extensions.KHR_materials_ior.ior", ior, 1, F0, 1.5f, 0, 1e4f)                               \
    X("extensions.KHR_materials_specular.specularFactor", specular, 1, F0, 1, 0, 1)                \
    X("extensions.KHR_materials_specular.specularColorFactor", specular_color, 3, F0, 1, 0, 1e4f)

struct gn_property {
    enum gn_thing thing;
    const char *path;           /* dots for slashes */
    uint32_t first, components; /* floats of the record */
    uint32_t moves;             /* bit of gn_material.moves */
    float fallback;             /* of a material: where the file has none */
    float least, most;          /* of each number; a pose clamps */
};
extern const struct gn_property gn_material_properties[];
extern const size_t gn_material_property_count;

/* The property of a kind of thing that a pointer names after the thing's number, from "/" on; also
 * the transforms of textures. False: none that can be played. */
bool gn_property_find(enum gn_thing thing, const char *pointer, struct gn_property *out);
/* Floats of a record. */
uint32_t gn_record_size(enum gn_thing thing);

/* What a record makes of a thing. */
void gn_light_make(const struct gn_light_record *record, struct gn_light *light);
void gn_camera_make(const struct gn_camera_record *record, struct gn_camera *camera);
/* moves: bits of what is made; the material keeps the rest. */
void gn_material_make(const struct gn_material_record *record, uint32_t moves,
                      struct gn_material *material);
/* The record of a material whose JSON is empty. */
void gn_material_record_init(struct gn_material_record *record);
void gn_uv_make(const struct gn_uv_record *record, float uv_from_uv[6]);

#endif
