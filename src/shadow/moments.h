/* Filtered shadow maps: how the moments of the distribution of distances are stored, and the passes
 * that make them from a map's codes. Three small tables.
 *
 * Moments of neighbouring texels may be averaged, which distances may not: so the map is blurred
 * once, when it has changed, instead of in every pixel that reads it. A code of such a map is the
 * distance itself, 0 at the near end and 1 at the far one; where the map is read beside its moments
 * (cone) it is the depth.
 *
 * A map knows casters alone, and is the far end where there are none, whatever the eye sees there.
 * Two moments cannot distinguish such a gap from a third distance: so vsm, evsm and vssm average
 * casters alone, and keep beside their moments what share of texels they are. */
#ifndef GN_SHADOW_MOMENTS_H
#define GN_SHADOW_MOMENTS_H

#include <stdbool.h>
#include <stdint.h>

/* How a texture stores moments. */
enum gn_moments {
    GN_MOMENTS_NONE,
    GN_MOMENTS_RG32UI,         /* three of 0..1 in 21 bits each */
    GN_MOMENTS_RGBA16UI,       /* four of 0..1 in 16 bits */
    GN_MOMENTS_RGBA16F,        /* filtered by the sampler */
    GN_MOMENTS_RGBA16F_MIPS,   /* the same, not blurred: averaged by mipmaps, for the same programs.
                                  Of maps of one tile */
    GN_MOMENTS_RGBA32F_BITS,   /* bits of floats in integers: drawn to by all of ES 3.0 */
    GN_MOMENTS_RGBA32F_SHARE,  /* the same, and in the last ones of all four how much is covered */
    GN_MOMENTS_TABLE_RGBA32UI, /* sums, in fixed point that wraps round */
    GN_MOMENTS_CONE_RG16F,     /* cone maps, which are no moments: filtered by the sampler */
    GN_MOMENTS_CONE_BITS,      /* bits of two half floats in an integer */
    GN_MOMENTS_CONE_BYTES,     /* in four bytes: core, needs no proof */
    GN_MOMENTS_COUNT,
    GN_MOMENTS_FLOOR = GN_MOMENTS_COUNT, /* alpha of an unseen floor; of no --map-format */
    GN_MOMENTS_ALL,
};
struct gn_moments_row {
    const char *name;    /* as in --map-format */
    const char *file;    /* below shaders_es/ */
    const char *sampler; /* its type in GLSL */
    unsigned texel_bytes;
    bool linear;  /* a sampler weighs texels; else a shader does */
    bool mipmaps; /* they may be averaged: a map of one tile has mipmaps */
};
extern const struct gn_moments_row gn_moments[GN_MOMENTS_ALL];
enum { GN_STORES_MAX = 4 }; /* of a technique */

/* A program that fills all of a target from textures. */
enum gn_filter_step {
    GN_STEP_BLUR_X, /* of codes, which become moments on the way */
    GN_STEP_BLUR_Y,
    GN_STEP_TABLE_ROWS, /* of codes, which become moments in fixed point */
    GN_STEP_TABLE_ROW_SUMS,
    GN_STEP_TABLE_COLUMNS,
    GN_STEP_TABLE_COLUMN_SUMS,
    GN_STEP_TABLE_ADD,
    GN_STEP_CONE_SEEDS, /* of codes, two by two; the others four by four, eight by eight */
    GN_STEP_CONE_SEEDS_4,
    GN_STEP_CONE_SEEDS_8,
    GN_STEP_CONE_EDGES,
    GN_STEP_CONE_FLOOD,
    GN_STEP_FLOOR, /* of codes, and a texture */
    GN_STEP_COUNT,
};
struct gn_filter_step_row {
    const char *name;  /* of passes, for printing */
    const char *file;  /* below shaders_es/ */
    bool reads_map;    /* codes; else moments */
    const char *words; /* for people; steps of one kind have the same */
};
extern const struct gn_filter_step_row gn_filter_steps[GN_STEP_COUNT];

/* The passes that lead from a map to what shaders read, in their order: textures are numbered, 0 is
 * the light's own, which the last pass fills; the others are shared by all lights. */
enum gn_filter {
    GN_FILTER_NONE,
    GN_FILTER_MIPS,  /* moments alone; mipmaps average them */
    GN_FILTER_BLUR,  /* a box, as wide as gn_shadow_view.penumbra.blur_px */
    GN_FILTER_TABLE, /* sums over all texels to the lower left, tile by tile */
    GN_FILTER_CONE,  /* the first cone behind a blocker at each place, tile by tile */
    GN_FILTER_FLOOR, /* what an unseen floor takes from the picture behind it */
    GN_FILTER_COUNT,
};
enum { GN_FILTER_STAGES_MAX = 10, GN_FILTER_TEXTURES_MAX = 4, GN_FILTER_FROM_MAX = 2 };
#define GN_FROM_MAP     (-1) /* the map itself */
#define GN_FROM_NOTHING (-2)
struct gn_filter_stage {
    enum gn_filter_step step;
    int8_t from[GN_FILTER_FROM_MAX]; /* what is behind sampler i: a texture's number, or of these */
    uint8_t to;
    uint8_t reach_px; /* of a step that reads some texels away: how far; else 0 */
};
struct gn_filter_row {
    uint32_t count;
    uint32_t narrow; /* the number of a texture that holds sums of blocks alone; 0: there is none */
    bool halves;     /* textures have a texel for two by two of the map, or more */
    struct gn_filter_stage stages[GN_FILTER_STAGES_MAX];
};
extern const struct gn_filter_row gn_filters[GN_FILTER_COUNT];

/* Of the programs that write and read such moments, in their keys. */
static inline enum gn_moments gn_moments_of_programs(enum gn_moments moments) {
    return moments == GN_MOMENTS_RGBA16F_MIPS ? GN_MOMENTS_RGBA16F : moments;
}
/* The mipmap that averages as a box does which is so many texels wide to each side: a texel of it,
 * and linear weights between them, have the box's variance. */
float gn_mipmap_of_blur(float blur_px);

/* Half the width of a blur, texels: a map is fit for the most. */
#define GN_BLUR_LEAST_PX 1.5f
#define GN_BLUR_MOST_PX  4.5f

/* The first of a technique's `stores` that `proved` (a bit per gn_moments) has, or the wanted one,
 * if it is among them and proved; NONE: there is none. *fell_back: it is not what was wanted.
 * wanted NONE: whatever comes first. */
enum gn_moments gn_moments_choose(const uint8_t stores[GN_STORES_MAX], enum gn_moments wanted,
                                  uint32_t proved, bool *fell_back);

#endif
