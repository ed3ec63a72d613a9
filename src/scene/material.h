/* Textures and layers of a material: tables from their names in glTF to those in GLSL.
 *
 * A row of a texture gives the enum below, gn_texture_slots[], the features NAME_TEXTURE and
 * NAME_UV1 of a program (frame/feature.h), a texture unit, the sampler u_texture_name, the varying
 * v_uv_name and TEXEL_NAME (gl/). To add one: a row here, and the shader that reads it.
 *
 * A layer reflects or transmits light beside the base of the material. Its rows give its numbers,
 * which are loaded, animated and passed to programs as FACTOR_NAME, its textures, and the feature
 * NAME of a program, whose shader is made with shaders_es/layer/name.glsl. To add one: its rows
 * here, and that file. */
#ifndef GN_SCENE_MATERIAL_H
#define GN_SCENE_MATERIAL_H

#include <stdbool.h>

#define GN_CLEARCOAT "extensions.KHR_materials_clearcoat"
#define GN_TRANSMITS "extensions.KHR_materials_transmission"

/* From the base upwards; first of each layer L, then its F and T. */
/* L(NAME, "name", amount, reflects): there is none of it where the first `amount` of its numbers
 * are 0. reflects: most of what one sees of it are reflections. */
/* F(layer, NAME, components, path in the JSON of a material, default, least, most): a factor. */
/* T(as X of GN_TEXTURE_SLOTS): a texture that is read for the layer. */
#define GN_LAYERS(L, F, T)                                                                         \
    L(TRANSMISSION, "transmission", 1, true) /* shows what is behind */                            \
    F(TRANSMISSION, TRANSMISSION, 1, GN_TRANSMITS ".transmissionFactor", 0, 0, 1)                  \
    T(TRANSMISSION, transmission, "transmission-texture", GN_TRANSMITS ".transmissionTexture",     \
      LINEAR, TRANSMISSION) /* R: factor */                                                        \
    L(COAT, "coat", 1, true)                                                                       \
    F(COAT, COAT, 1, GN_CLEARCOAT ".clearcoatFactor", 0, 0, 1)                                     \
    F(COAT, COAT_ROUGHNESS, 1, GN_CLEARCOAT ".clearcoatRoughnessFactor", 0, 0, 1)                  \
    T(COAT, coat, "coat-texture", GN_CLEARCOAT ".clearcoatTexture", LINEAR, COAT) /* R: factor */  \
    T(COAT_ROUGHNESS, coat_roughness, "coat-roughness", GN_CLEARCOAT ".clearcoatRoughnessTexture", \
      LINEAR, COAT)       /* G */
#define GN_LEAVE_OUT(...) /* for those kinds of rows that are not wanted */

enum gn_layer {
#define GN_X(NAME, ...) GN_LAYER_##NAME,
    GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
        GN_LAYER_COUNT,
};
/* Index of a factor's first number in gn_material.factors, where those of a layer stand together,
 * and those of all layers without gaps: lib/surface.glsl reads them as vec4. */
enum gn_factor {
#define GN_LAYER_BEGIN(NAME, ...) GN_FACTORS_OF_##NAME, GN_BEFORE_##NAME = GN_FACTORS_OF_##NAME - 1,
#define GN_X(LAYER, NAME, components, ...)                                                         \
    GN_FACTOR_##NAME, GN_FACTOR_END_##NAME = GN_FACTOR_##NAME + (components)-1,
    GN_LAYERS(GN_LAYER_BEGIN, GN_X, GN_LEAVE_OUT)
#undef GN_X
#undef GN_LAYER_BEGIN
        GN_FACTORS_SIZE,
    GN_FACTORS_VECTORS = (GN_FACTORS_SIZE + 3) / 4, /* vec4 that hold them */
};
#define GN_X(LAYER, NAME, components, ...)                                                         \
    _Static_assert(GN_FACTOR_##NAME % 4 + (components) <= 4, "lies in one vec4: order its layer");
GN_LAYERS(GN_LEAVE_OUT, GN_X, GN_LEAVE_OUT)
#undef GN_X

struct gn_layer_row {
    int first;  /* of its numbers in gn_material.factors; the next row's first is their end */
    int amount; /* how many of them say whether there is any of it */
    bool reflects;
};
extern const struct gn_layer_row gn_layers[GN_LAYER_COUNT + 1];

/* X(NAME, name, printed name, path in the JSON of a material, texels, read for) */
#define GN_TEXTURE_SLOTS(X)                                                                        \
    X(BASE, base, "base", "pbrMetallicRoughness.baseColorTexture", SRGB, COLOR) /* and alpha */    \
    X(ROUGHNESS, roughness, "roughness", "pbrMetallicRoughness.metallicRoughnessTexture", LINEAR,  \
      SPECULAR) /* G: roughness, B: metalness */                                                   \
    X(EMISSIVE, emissive, "emissive-texture", "emissiveTexture", SRGB, EMISSION)                   \
    X(OCCLUSION, occlusion, "occlusion", "occlusionTexture", LINEAR, AMBIENT) /* R */              \
    X(NORMAL, normal, "normal-map", "normalTexture", LINEAR, LIGHT) /* with vertex tangents */     \
    X(LIGHTMAP, lightmap, "light-map", "extensions.MOZ_lightmap", SRGB, AMBIENT)                   \
    GN_LAYERS(GN_LEAVE_OUT, GN_LEAVE_OUT, X)

/* Of one material: with two samplers for each of four lights and the environment these fill the 16
 * that ES 3.0 promises. The last ones of the table are left out with a warning. */
enum { GN_MATERIAL_TEXTURES_MAX = 7 };

enum gn_texture_slot {
#define GN_X(NAME, ...) GN_TEXTURE_##NAME,
    GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
        GN_TEXTURE_SLOT_COUNT,
};

enum gn_texels { GN_TEXELS_LINEAR, GN_TEXELS_SRGB };

/* What a texture is read for, and so which programs read it. */
enum gn_shading {
    GN_SHADING_COLOR,    /* everything; of casters with holes, its alpha */
    GN_SHADING_LIGHT,    /* lit materials */
    GN_SHADING_SPECULAR, /* lit materials with a highlight */
    GN_SHADING_EMISSION, /* lit materials that emit; not where only light is added */
    GN_SHADING_AMBIENT,  /* lit materials; not where only light is added */
    GN_SHADING_LAYERS,   /* materials with that layer */
#define GN_X(NAME, ...) GN_SHADING_##NAME = GN_SHADING_LAYERS + GN_LAYER_##NAME,
    GN_LAYERS(GN_X, GN_LEAVE_OUT, GN_LEAVE_OUT)
#undef GN_X
};

struct gn_texture_slot_row {
    const char *glsl, *name; /* SLOT_BASE, BASE_UV1 ..; u_texture_base, v_uv_base */
    const char *path;        /* in the JSON of a material */
    enum gn_texels texels;
    enum gn_shading shading;
};
extern const struct gn_texture_slot_row gn_texture_slots[GN_TEXTURE_SLOT_COUNT];

struct gn_material;
bool gn_material_is_specular(const struct gn_material *material); /* has a highlight, if lit */
/* Blended, but opaque where its texture is, as most are that call themselves blended; or opaque
 * where its transmission texture is 0. */
bool gn_material_has_opaque_texels(const struct gn_material *material);
#define GN_OPAQUE_ALPHA 0.99f
/* Alpha below which a masked material has a hole: its cutoff, less half a step of 8 bits, so that
 * an alpha equal to the cutoff is opaque (glTF 2.0, 3.9.4) however the product of texture, factor
 * and vertex is rounded. A cutoff over 1 leaves nothing. */
float gn_material_least_alpha(const struct gn_material *material);
bool gn_material_is_metal(const struct gn_material *material); /* in places */
/* Has the layer, in places; unlit materials have none. */
bool gn_material_has(const struct gn_material *material, enum gn_layer layer);
bool gn_material_is_transmissive(const struct gn_material *material); /* has TRANSMISSION */
/* What lies behind it shows: by alpha, or by transmission. Drawn after all that is opaque. */
bool gn_material_is_blended(const struct gn_material *material);
/* Mostly clear, so that it casts no shadow unless gnomon_cast_alpha asks for one. */
bool gn_material_is_clear(const struct gn_material *material);
/* What it transmits has another colour in other places or channels, vertex colours apart. */
bool gn_material_is_tinted(const struct gn_material *material);
/* Whether it looks wrong without an environment: most of what one sees of it are reflections. */
bool gn_material_needs_reflections(const struct gn_material *material);
bool gn_material_is_emissive(const struct gn_material *material);
bool gn_material_has_f0(const struct gn_material *material); /* other than GN_F0 */
/* Whether a picture of the material reads the slot, if it has such a texture. */
bool gn_material_reads(const struct gn_material *material, enum gn_texture_slot slot);

#endif
