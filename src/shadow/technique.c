#include "shadow/technique.h"

#include <string.h>

enum {
    CELL_MOST_PX = 8,
    MOVING_CONES_PX = 256, /* side of a cone map that is made in each frame */
};

#define ROW(id, ...) [GN_TECHNIQUE_##id] = {__VA_ARGS__},
const struct gn_technique_row gn_techniques[GN_TECHNIQUE_ALL] = {
#include "shadow/technique_rows.h"
    [GN_TECHNIQUE_TRUTH] = {.name = "truth",
                            .title = "Ray tracing",
                            .file = "shadow/truth.glsl",
                            .on_screen = true,
                            .what = "rays to points of the light, on the CPU",
                            .source = "Cook, Porter, Carpenter 1984"},
    [GN_TECHNIQUE_FLOOR] = {.name = "floor",
                            .on_plane = true,
                            .filter = GN_FILTER_FLOOR,
                            .stores = {GN_MOMENTS_FLOOR},
                            .radius_texels = 2,
                            .what = "planar from points of the lamp, with occlusion, as alpha",
                            .source = "Blinn 1988"},
};
#undef ROW

const struct gn_encoding_row gn_encodings[GN_ENCODING_ALL] = {
    [GN_ENCODING_DEPTH] = {"depth", "lib/map_depth_code.glsl", 4},
    [GN_ENCODING_R32UI] = {"r32ui", "lib/map_r32ui.glsl", 8},
    [GN_ENCODING_R16F] = {"r16f", "lib/map_r16f.glsl", 6},
    [GN_ENCODING_R16F_RAW] = {"r16f-raw", "lib/map_r16f.glsl", 6},
    [GN_ENCODING_RGBA8] = {"rgba8", "lib/map_rgba8.glsl", 8},
    [GN_ENCODING_DEPTH16] = {"depth16", "lib/map_depth_code.glsl", 2},
    [GN_ENCODING_MASK] = {"mask", "lib/map_mask.glsl", 1},
    [GN_ENCODING_MEAN] = {"mean", "lib/map_mean.glsl", 3},
    [GN_ENCODING_STENCIL] = {"stencil", "lib/map_stencil.glsl", 0},
    [GN_ENCODING_SCREEN] = {"screen", "lib/map_screen.glsl", 4},
};

bool gn_technique_shades(enum gn_technique technique) {
    return gn_techniques[technique].compares_linear || gn_techniques[technique].soft ||
           gn_technique_filters_map(technique);
}

static int rank_of(enum gn_technique technique) {
    return gn_techniques[technique].rank ? gn_techniques[technique].rank : GN_TECHNIQUE_COUNT + 1;
}

void gn_techniques_by_rank(enum gn_technique out[GN_TECHNIQUE_COUNT]) {
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) { /* insertion sort: stable; there are few */
        const enum gn_technique technique = (enum gn_technique)i;
        int at = i;
        for (; at > 0 && rank_of(out[at - 1]) > rank_of(technique); at--) out[at] = out[at - 1];
        out[at] = technique;
    }
}

uint32_t gn_technique_map_px(enum gn_technique technique, uint32_t px) {
    return gn_filters[gn_techniques[technique].filter].halves ? px & ~1u : px;
}

uint32_t gn_technique_cell_px(enum gn_technique technique, uint32_t map_px,
                              bool moves_in_one_tile) {
    uint32_t px = gn_filters[gn_techniques[technique].filter].halves ? 2 : 1;
    if (px == 1 || !moves_in_one_tile) return px;
    while (px < CELL_MOST_PX && map_px % (2 * px) == 0 && map_px >= 2 * px * MOVING_CONES_PX)
        px *= 2;
    return px;
}

bool gn_technique_find(const char *name, size_t length, enum gn_technique *out) {
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++)
        if (strlen(gn_techniques[i].name) == length &&
            memcmp(gn_techniques[i].name, name, length) == 0) {
            *out = (enum gn_technique)i;
            return true;
        }
    return false;
}

enum gn_encoding gn_encoding_choose(enum gn_technique technique, enum gn_encoding wanted,
                                    uint32_t proved, bool *fell_back) {
    static const enum gn_encoding by_distance[] = {GN_ENCODING_R16F, GN_ENCODING_R32UI,
                                                   GN_ENCODING_DEPTH};
    static const enum gn_encoding by_depth[] = {GN_ENCODING_DEPTH, GN_ENCODING_R32UI,
                                                GN_ENCODING_R16F};
    *fell_back = false;
    if (gn_techniques[technique].on_plane) return GN_ENCODING_MASK;
    if (gn_techniques[technique].on_screen) return GN_ENCODING_SCREEN;
    if (gn_techniques[technique].reads_both) {
        *fell_back = wanted != GN_ENCODING_AUTO && !gn_encoding_is_depth(wanted);
        return wanted == GN_ENCODING_DEPTH16 ? wanted : GN_ENCODING_DEPTH;
    }
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
