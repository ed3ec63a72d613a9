#include "shadow/technique.h"

#include <stdio.h>
#include <string.h>

const struct gn_technique_row gn_techniques[GN_TECHNIQUE_COUNT] = {
    [GN_TECHNIQUE_NONE] = {.name = "none", .what = "no shadows"},
    [GN_TECHNIQUE_HARD] = {.name = "hard",
                           .file = "shadow/hard.glsl",
                           .reads_distance = true,
                           .radius_texels = 1,
                           .bias_texels = 0.6f,
                           .what = "one comparison",
                           .source = "Williams 1978"},
    [GN_TECHNIQUE_PCF] = {.name = "pcf",
                          .file = "shadow/pcf.glsl",
                          .filters = true,
                          .radius_texels = 2,
                          .bias_texels = 0.9f,
                          .what = "four hardware-compare taps half a texel away",
                          .source = "Reeves, Salesin, Cook 1987"},
    [GN_TECHNIQUE_PCF2] = {.name = "pcf2",
                           .file = "shadow/pcf2.glsl",
                           .filters = true,
                           .radius_texels = 1,
                           .bias_texels = 0.7f,
                           .what = "one hardware-compare tap",
                           .source = "Reeves, Salesin, Cook 1987"},
    [GN_TECHNIQUE_PCF3] = {.name = "pcf3",
                           .file = "shadow/pcf3.glsl",
                           .filters = true,
                           .radius_texels = 2,
                           .bias_texels = 1.15f,
                           .what = "[1 2 1] squared in four fetches",
                           .source = "Reeves, Salesin, Cook 1987"},
    [GN_TECHNIQUE_PCF5] = {.name = "pcf5",
                           .file = "shadow/pcf5.glsl",
                           .filters = true,
                           .radius_texels = 3,
                           .bias_texels = 1.65f,
                           .what = "[1 3 4 3 1] squared in nine fetches",
                           .source = "Reeves, Salesin, Cook 1987"},
    [GN_TECHNIQUE_DISK] = {.name = "disk",
                           .file = "shadow/disk.glsl",
                           .filters = true,
                           .reads_distance = true,
                           .taps = GN_TAPS_DISK,
                           .radius_texels = 4,
                           .bias_texels = 0.7f,
                           .what = "16 taps over a disk, turned from pixel to pixel",
                           .source = "Vogel 1979"},
    [GN_TECHNIQUE_POISSON] = {.name = "poisson",
                              .file = "shadow/poisson.glsl",
                              .filters = true,
                              .reads_distance = true,
                              .taps = GN_TAPS_POISSON,
                              .radius_texels = 4,
                              .bias_texels = 0.7f,
                              .what = "16 taps over a Poisson disk, turned from pixel to pixel",
                              .source = "Bridson 2007"},
    [GN_TECHNIQUE_PCSS] = {.name = "pcss",
                           .file = "shadow/pcss.glsl",
                           .searches = true,
                           .reads_distance = true,
                           .soft = true,
                           .taps = GN_TAPS_DISK,
                           .radius_texels = 2,
                           .bias_texels = 0.7f,
                           .what = "finds the blockers, then filters as wide as their penumbra is",
                           .source = "Fernando 2005"},
    [GN_TECHNIQUE_VSM] = {.name = "vsm",
                          .file = "shadow/vsm.glsl",
                          .filter = GN_FILTER_BLUR,
                          .moments = "moments/vsm.glsl",
                          .moments_middle = 0.5f,
                          .stores = {GN_MOMENTS_RG32UI, GN_MOMENTS_RGBA16UI, GN_MOMENTS_RGBA16F},
                          .radius_texels = 6,
                          .bias_texels = 1.0f,
                          .what = "two moments of a blurred map, Chebyshev's inequality",
                          .source = "Donnelly, Lauritzen 2006"},
    [GN_TECHNIQUE_EVSM] = {.name = "evsm",
                           .file = "shadow/evsm.glsl",
                           .filter = GN_FILTER_BLUR,
                           .moments = "moments/evsm.glsl",
                           .stores = {GN_MOMENTS_RGBA32F_SHARE},
                           .radius_texels = 6,
                           .bias_texels = 1.0f,
                           .what = "the same of exponents of the distance, from both ends",
                           .source = "Lauritzen, McCool 2008"},
    [GN_TECHNIQUE_MSM] = {.name = "msm",
                          .file = "shadow/msm.glsl",
                          .filter = GN_FILTER_BLUR,
                          .moments = "moments/msm.glsl",
                          .moments_middle = 0.5f,
                          .stores = {GN_MOMENTS_RGBA16UI, GN_MOMENTS_RGBA32F_BITS,
                                     GN_MOMENTS_RGBA16F},
                          .radius_texels = 6,
                          .bias_texels = 1.0f,
                          .what = "four moments of a blurred map, the Hamburger bound",
                          .source = "Peters, Klein 2015"},
    [GN_TECHNIQUE_VSSM] =
        {.name = "vssm",
         .file = "shadow/vssm.glsl",
         .soft = true,
         .filter = GN_FILTER_TABLE,
         .moments = "moments/vsm.glsl",
         .stores = {GN_MOMENTS_TABLE_RGBA32UI},
         .map_px = 512,
         .radius_texels = 2,
         .bias_texels = 0.7f,
         .what = "blockers and penumbra from sums of two moments, at one cost for all widths",
         .source = "Yang et al. 2010"},
    [GN_TECHNIQUE_SMSM] = {.name = "smsm",
                           .file = "shadow/smsm.glsl",
                           .soft = true,
                           .filter = GN_FILTER_TABLE,
                           .moments = "moments/smsm.glsl",
                           .stores = {GN_MOMENTS_TABLE_RGBA32UI},
                           .map_px = 512,
                           .radius_texels = 2,
                           .bias_texels = 0.7f,
                           .what = "the same from four moments",
                           .source = "Peters et al. 2017"},
    [GN_TECHNIQUE_PLANAR] = {.name = "planar",
                             .file = "shadow/planar.glsl",
                             .on_plane = true,
                             .radius_texels = 2,
                             .what = "casters flattened on the scene's plane, nowhere else",
                             .source = "Blinn 1988"},
};

const struct gn_encoding_row gn_encodings[GN_ENCODING_COUNT] = {
    [GN_ENCODING_DEPTH] = {"depth", "lib/map_depth_code.glsl", 4},
    [GN_ENCODING_R32UI] = {"r32ui", "lib/map_r32ui.glsl", 8},
    [GN_ENCODING_R16F] = {"r16f", "lib/map_r16f.glsl", 6},
    [GN_ENCODING_R16F_RAW] = {"r16f-raw", "lib/map_r16f.glsl", 6},
    [GN_ENCODING_RGBA8] = {"rgba8", "lib/map_rgba8.glsl", 8},
    [GN_ENCODING_MASK] = {"mask", "lib/map_mask.glsl", 1},
    [GN_ENCODING_STENCIL] = {"stencil", "lib/map_stencil.glsl", 0},
};

bool gn_technique_shades(enum gn_technique technique) {
    return gn_techniques[technique].filters || gn_techniques[technique].soft ||
           gn_technique_filters_map(technique);
}

bool gn_technique_find(const char *name, enum gn_technique *out, struct gn_err *err) {
    char names[160] = "";
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) {
        if (strcmp(name, gn_techniques[i].name) == 0) {
            *out = (enum gn_technique)i;
            return true;
        }
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", gn_techniques[i].name);
    }
    return gn_fail_usage(err, "there is no shadow technique '%s'; there are %s", name, names);
}

bool gn_encoding_find(const char *name, enum gn_encoding *out, struct gn_err *err) {
    if (strcmp(name, "auto") == 0) {
        *out = GN_ENCODING_AUTO;
        return true;
    }
    char names[160] = "auto";
    for (int i = 0; i < GN_ENCODING_MASK; i++) {
        if (strcmp(name, gn_encodings[i].name) == 0) {
            *out = (enum gn_encoding)i;
            return true;
        }
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, ", %s", gn_encodings[i].name);
    }
    return gn_fail_usage(err, "there is no map format '%s'; there are %s", name, names);
}

bool gn_map_format_find(const char *name, enum gn_encoding *encoding, enum gn_moments *moments,
                        struct gn_err *err) {
    *moments = GN_MOMENTS_NONE;
    if (!gn_moments_find(name, moments)) return gn_encoding_find(name, encoding, err);
    *encoding = GN_ENCODING_AUTO;
    return true;
}

enum gn_encoding gn_encoding_choose(enum gn_technique technique, enum gn_encoding wanted,
                                    uint32_t proved, bool *fell_back) {
    static const enum gn_encoding by_distance[] = {GN_ENCODING_R16F, GN_ENCODING_R32UI,
                                                   GN_ENCODING_DEPTH};
    static const enum gn_encoding by_depth[] = {GN_ENCODING_DEPTH, GN_ENCODING_R32UI,
                                                GN_ENCODING_R16F};
    *fell_back = false;
    if (gn_techniques[technique].on_plane) return GN_ENCODING_MASK;
    if (gn_technique_filters_map(technique)) {
        *fell_back = wanted != GN_ENCODING_AUTO;
        return proved & 1u << GN_ENCODING_R32UI ? GN_ENCODING_R32UI : GN_ENCODING_RGBA8;
    }
    if (wanted != GN_ENCODING_AUTO && proved & 1u << wanted) return wanted;
    *fell_back = wanted != GN_ENCODING_AUTO;
    const enum gn_encoding *order =
        gn_techniques[technique].reads_distance ? by_distance : by_depth;
    for (int i = 0; i < 3; i++)
        if (proved & 1u << order[i]) return order[i];
    return GN_ENCODING_RGBA8; /* core, needs no proof */
}
