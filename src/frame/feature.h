/* Features of a program: one row each. A row is a bit of gn_program_key.features, a `const bool`
 * and, where it is set, a WITH_ macro of that name in GLSL, and a word where keys are printed.
 * Layers and textures (scene/material.h) and vertex attributes (scene/attribute.h) bring theirs
 * along. */
#ifndef GN_FRAME_FEATURE_H
#define GN_FRAME_FEATURE_H

#include <stdint.h>

#include "scene/attribute.h"
#include "scene/material.h"

/* X(NAME, printed name, ..): what is no texture and no attribute. TRANSMISSION of LIT with UNLIT:
 * its tint alone; of ENCODE: there is such. */
#define GN_FEATURES(X)                                                                             \
    X(ALPHA_MASK, "mask")                                                                          \
    X(ALPHA_BLEND, "blend")                                                                        \
    X(DOUBLE_SIDED, "double-sided")                                                                \
    X(UNLIT, "unlit")                                                                              \
    X(SPECULAR, "specular")                                                                        \
    X(EMISSIVE, "emissive")                                                                        \
    X(HEMISPHERE, "hemisphere")         /* sky and ground differ */                                \
    X(ENCODE_SRGB, "encode-srgb")       /* no sRGB target: encode in the shader */                 \
    X(PERSPECTIVE, "perspective")       /* DISTANCE: radial distance from a point, not along a     \
                                           direction */                                            \
    X(FLAT_CONSTANTS, "flat-constants") /* software drivers: the first light's constants come as   \
                                           flat varyings */                                        \
    X(ADDITIVE,                                                                                    \
      "additive") /* LIT: light alone, to be added: no ambient, emission, alpha; MEAN: a sum */    \
    X(SHADOW_SPECULAR, "shadow-specular") /* shadows leave a share of highlights of their own */   \
    X(REFLECTANCE, "f0")                  /* its reflectance is not that of an IOR of 1.5 */       \
    X(METAL, "metal")                     /* the material may be a metal in places */              \
    X(TONE_NEUTRAL, "neutral")            /* LIT, ENCODE: maps the tone */                         \
    X(TONE_ACES, "aces")                                                                           \
    X(TONE_AGX, "agx")                                                                             \
    X(CATCHER,                                                                                     \
      "catcher") /* LIT: a shadow catcher: alpha is the share of light that shadows take */        \
    X(TRANSPARENT,                                                                                 \
      "transparent") /* ENCODE: keeps alpha; AOV: goes into a mean, so it writes floats */         \
    X(ALPHA_DITHER, "dither")     /* DEPTH, DISTANCE, FLAT: a mask with that share of texels */    \
    X(BLENDED_REST, "rest")       /* LIT: leaves out texels that were drawn as opaque ones */      \
    X(ENVIRONMENT, "environment") /* reflects it */                                                \
    X(ENVIRONMENT_DIFFUSE, "environment-diffuse") /* in place of the hemispheres */                \
    X(ENVIRONMENT_SCALED, "environment-scaled")   /* by a factor other than 1 */                   \
    X(ENVIRONMENT_TURNED, "environment-turned")                                                    \
    GN_LAYERS(X, GN_LEAVE_OUT, GN_LEAVE_OUT)                                                       \
    X(TINTED, "tinted") /* LIT: in colour, which a draw before has multiplied in; this one adds */ \
    X(ENVIRONMENT_KEY, "environment-key") /* smooth surfaces reflect it with its key light */      \
    X(MIDDLE, "middle")     /* DEPTH, DISTANCE: writes what lies between front and back face */    \
    X(SKIN, "skin")         /* vertices follow up to four joints */                                \
    X(SKIN_8, "skin-8")     /* or up to eight */                                                   \
    X(MORPH, "morph")       /* the mesh has targets */                                             \
    X(OCCLUDED, "occluded") /* LIT, AOV: its ambient light is looked up in the scene's volume */   \
    X(FACED,                                                                                       \
      "faced") /* AOV: what is turned away from the light is dark, also if it casts nothing */

enum gn_feature_bit {
#define GN_X(NAME, ...) GN_BIT_##NAME##_TEXTURE, /* that slot has a texture */
    GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
#define GN_X(NAME, ...) GN_BIT_##NAME##_UV1, /* and reads TEXCOORD_1 */
        GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
#define GN_X(NAME, ...) GN_BIT_VERTEX_##NAME, /* the geometry has it */
            GN_FEATURE_ATTRIBUTES(GN_X)
#undef GN_X
#define GN_X(NAME, ...) GN_BIT_##NAME,
                GN_FEATURES(GN_X)
#undef GN_X
                    GN_FEATURE_COUNT,
    GN_FEATURE_FIRST_TEXTURE = 0,
    GN_FEATURE_FIRST_UV1 = GN_TEXTURE_SLOT_COUNT,
    GN_FEATURE_FIRST_ATTRIBUTE = 2 * GN_TEXTURE_SLOT_COUNT,
};
_Static_assert(GN_FEATURE_COUNT < 64, "bits of gn_program_key.features");

/* The bit as a mask: GN_FEATURE(ALPHA_MASK). */
#define GN_FEATURE(NAME)  (UINT64_C(1) << GN_BIT_##NAME)
#define GN_FEATURES_ALL   ((UINT64_C(1) << GN_FEATURE_COUNT) - 1)
/* Of items whose vertices are posed: an instance has no matrix (lib/deform.glsl). */
#define GN_FEATURES_POSED (GN_FEATURE(SKIN) | GN_FEATURE(SKIN_8) | GN_FEATURE(MORPH))

struct gn_feature_row {
    const char *glsl, *name;
};
extern const struct gn_feature_row gn_features[GN_FEATURE_COUNT]; /* by bit */

#endif
