/* Capabilities of a GPU: those that the driver claims, and, once a plan needs them, those that a
 * draw and a read-back proved. Plain data. */
#ifndef GN_FRAME_CAPS_H
#define GN_FRAME_CAPS_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"
#include "shadow/technique.h"

enum gn_cap {                       /* named in --without and by doctor: see gn_cap_names */
              GN_CAP_DEPTH_COMPARE, /* depth texture read through a comparing sampler; every ES 3.0
                                       has it, but some drivers break it */
              GN_CAP_R32UI,
              GN_CAP_R16F, /* half-float colour target, by either extension, drawn and read back */
              GN_CAP_RGBA16F, /* linear colour target for PFM */
              GN_CAP_SRGB,    /* SRGB8_ALPHA8 target that encodes */
              GN_CAP_MSAA4,
              GN_CAP_RGBA16UI, /* targets of filtered maps, from here on: drawn and read back */
              GN_CAP_RG32UI,
              GN_CAP_RGBA32UI,
              GN_CAP_RG16F, /* cone maps */
              GN_CAP_TIMER, /* EXT_disjoint_timer_query */
              GN_CAP_DEBUG, /* KHR_debug */
              GN_CAP_COUNT,
};
extern const char *const gn_cap_names[GN_CAP_COUNT]; /* "depth-compare", "r32ui", "r16f", "rgba16f",
                                                        "srgb", "msaa4", "rgba16ui", "rg32ui",
                                                        "rgba32ui", "rg16f", "timer", "debug" */

struct gn_caps {
    uint32_t has; /* bit per gn_cap */
    int max_texture_px, max_texture_units;
    char vendor[64], renderer[96], version[96];
    bool software; /* llvmpipe, softpipe, swrast, SwiftShader */
    bool etc2;     /* it reads ETC2 and EAC, as every OpenGL ES 3.0 does */
};
/* The encodings that caps claim, and prove once gn_gl_prove() has tried them; for
 * gn_encoding_choose. */
uint32_t gn_caps_encodings(const struct gn_caps *caps);
/* The capability that a format of moments needs; COUNT: none, every GPU renders to it. */
enum gn_cap gn_cap_of_moments(enum gn_moments moments);
/* The formats of moments that caps prove, for gn_moments_choose. */
uint32_t gn_caps_moments(const struct gn_caps *caps);
/* A comma list of names to bits of gn_cap; NULL and "" are none. An unknown name is a usage error
 * that lists the known ones. */
bool gn_caps_parse(const char *list, uint32_t *out, struct gn_err *err);

#endif
