#include "shadow/moments.h"

#include <math.h>

const struct gn_moments_row gn_moments[GN_MOMENTS_ALL] = {
    [GN_MOMENTS_NONE] = {.name = "none"},
    [GN_MOMENTS_RG32UI] = {"rg32ui", "lib/moments_thirds.glsl", "usampler2D", 8, false, false},
    [GN_MOMENTS_RGBA16UI] = {"rgba16ui", "lib/moments_16ui.glsl", "usampler2D", 8, false, false},
    [GN_MOMENTS_RGBA16F] = {"rgba16f", "lib/moments_16f.glsl", "sampler2D", 8, true, true},
    [GN_MOMENTS_RGBA16F_MIPS] = {"rgba16f-mips", "lib/moments_16f.glsl", "sampler2D", 8, true,
                                 true},
    [GN_MOMENTS_RGBA32F_BITS] = {"rgba32f-bits", "lib/moments_bits.glsl", "usampler2D", 16, false,
                                 false},
    [GN_MOMENTS_RGBA32F_SHARE] = {"rgba32f-share", "lib/moments_share.glsl", "usampler2D", 16,
                                  false, false},
    [GN_MOMENTS_TABLE_RGBA32UI] = {"rgba32ui", "lib/moments_table.glsl", "usampler2D", 16, false,
                                   false},
    [GN_MOMENTS_CONE_RG16F] = {"rg16f", "lib/cone_16f.glsl", "sampler2D", 4, true, true},
    [GN_MOMENTS_CONE_BITS] = {"rg16f-bits", "lib/cone_bits.glsl", "usampler2D", 4, false, false},
    [GN_MOMENTS_CONE_BYTES] = {"rg16f-bytes", "lib/cone_bytes.glsl", "sampler2D", 4, false, false},
    [GN_MOMENTS_FLOOR] = {"rg8", "lib/floor_8.glsl", "sampler2D", 2, true, true},
};

const struct gn_filter_step_row gn_filter_steps[GN_STEP_COUNT] = {
    [GN_STEP_BLUR_X] = {"blur x", "filter/blur_x.frag", true},
    [GN_STEP_BLUR_Y] = {"blur y", "filter/blur_y.frag", false},
    [GN_STEP_TABLE_ROWS] = {"rows", "filter/table_rows.frag", true},
    [GN_STEP_TABLE_ROW_SUMS] = {"row sums", "filter/table_row_sums.frag", false},
    [GN_STEP_TABLE_COLUMNS] = {"columns", "filter/table_columns.frag", false},
    [GN_STEP_TABLE_COLUMN_SUMS] = {"column sums", "filter/table_column_sums.frag", false},
    [GN_STEP_TABLE_ADD] = {"table", "filter/table_add.frag", false},
    [GN_STEP_CONE_SEEDS] = {"cones", "filter/cone_seeds.frag", true},
    [GN_STEP_CONE_EDGES] = {"edges", "filter/cone_edges.frag", false},
    [GN_STEP_CONE_FLOOD] = {"flood", "filter/cone_flood.frag", false},
    [GN_STEP_FLOOR] = {"alpha", "filter/floor.frag", true},
};

const struct gn_filter_row gn_filters[GN_FILTER_COUNT] = {
    [GN_FILTER_NONE] = {.count = 0},
    [GN_FILTER_MIPS] = {.count = 1,
                        .stages = {{GN_STEP_BLUR_X, {GN_FROM_MAP, GN_FROM_NOTHING}, 0, 0}}},
    [GN_FILTER_BLUR] = {.count = 2,
                        .stages = {{GN_STEP_BLUR_X, {GN_FROM_MAP, GN_FROM_NOTHING}, 1, 0},
                                   {GN_STEP_BLUR_Y, {1, GN_FROM_NOTHING}, 0, 0}}},
    [GN_FILTER_TABLE] = {.count = 5,
                         .narrow = 2,
                         .stages = {{GN_STEP_TABLE_ROWS, {GN_FROM_MAP, GN_FROM_NOTHING}, 0, 0},
                                    {GN_STEP_TABLE_ROW_SUMS, {0, GN_FROM_NOTHING}, 2, 0},
                                    {GN_STEP_TABLE_COLUMNS, {0, 2}, 1, 0},
                                    {GN_STEP_TABLE_COLUMN_SUMS, {1, GN_FROM_NOTHING}, 2, 0},
                                    {GN_STEP_TABLE_ADD, {1, 2}, 0, 0}}},
    [GN_FILTER_CONE] = {.count = 10,
                        .halves = true,
                        .stages = {{GN_STEP_CONE_SEEDS, {GN_FROM_MAP, GN_FROM_NOTHING}, 1, 0},
                                   {GN_STEP_CONE_EDGES, {1, GN_FROM_NOTHING}, 0, 0},
                                   {GN_STEP_CONE_FLOOD, {0, GN_FROM_NOTHING}, 1, 128},
                                   {GN_STEP_CONE_FLOOD, {1, GN_FROM_NOTHING}, 0, 64},
                                   {GN_STEP_CONE_FLOOD, {0, GN_FROM_NOTHING}, 1, 32},
                                   {GN_STEP_CONE_FLOOD, {1, GN_FROM_NOTHING}, 0, 16},
                                   {GN_STEP_CONE_FLOOD, {0, GN_FROM_NOTHING}, 1, 8},
                                   {GN_STEP_CONE_FLOOD, {1, GN_FROM_NOTHING}, 0, 4},
                                   {GN_STEP_CONE_FLOOD, {0, GN_FROM_NOTHING}, 1, 2},
                                   {GN_STEP_CONE_FLOOD, {1, GN_FROM_NOTHING}, 0, 1}}},
    [GN_FILTER_FLOOR] = {.count = 1,
                         .stages = {{GN_STEP_FLOOR, {GN_FROM_MAP, GN_FROM_NOTHING}, 0, 0}}},
};

/* Box of a texel s: s^2 / 12; linear weights: s^2 / 6; the blur's: (2 blur)^2 / 12. */
float gn_mipmap_of_blur(float blur_px) { return log2f(2.0f * blur_px / sqrtf(3.0f)); }

enum gn_moments gn_moments_choose(const uint8_t stores[GN_STORES_MAX], enum gn_moments wanted,
                                  uint32_t proved, bool *fell_back) {
    enum gn_moments first = GN_MOMENTS_NONE;
    *fell_back = false;
    for (int i = GN_STORES_MAX - 1; i >= 0; i--) {
        if (!stores[i] || !(proved >> stores[i] & 1)) continue;
        if (stores[i] == wanted) return wanted;
        first = (enum gn_moments)stores[i];
    }
    *fell_back = wanted != GN_MOMENTS_NONE;
    return first;
}
