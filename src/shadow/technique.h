/* The table of shadow techniques, whose rows are in technique_rows.h, and the table of map
 * encodings.
 */
#ifndef GN_SHADOW_TECHNIQUE_H
#define GN_SHADOW_TECHNIQUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "shadow/moments.h"
#include "shadow/taps.h"

#define ROW(id, ...) GN_TECHNIQUE_##id,
enum gn_technique {
#include "shadow/technique_rows.h"
    GN_TECHNIQUE_COUNT,
    GN_TECHNIQUE_TRUTH = GN_TECHNIQUE_COUNT, /* of stills alone: no mode, and not measured */
    GN_TECHNIQUE_FLOOR, /* the frame's own choice, for an unseen floor: it has no name to choose */
    GN_TECHNIQUE_ALL,
};
#undef ROW

/* How a map stores the distance from the light. Unless map_clear is near, they are
 * cleared to the light's far end. */
enum gn_encoding {
    GN_ENCODING_DEPTH, /* depth texture, hardware compare */
    GN_ENCODING_R32UI, /* bits of the float distance in metres */
    GN_ENCODING_R16F,  /* (d - c) / h over near..far, half float, with its own depth attachment */
    GN_ENCODING_R16F_RAW, /* metres, half float: coarse far off, shown for comparison */
    GN_ENCODING_RGBA8,    /* (d - near) / (far - near) in four bytes */
    GN_ENCODING_DEPTH16,  /* DEPTH in 16 bits, for the same programs */
    GN_ENCODING_MASK, /* on a plane: visibility, 0 or 1. From here on only for techniques that are
                         on_plane; not selectable by name */
    GN_ENCODING_MEAN, /* on a plane: 1 less the weights of the lamp's points that are hidden */
    GN_ENCODING_STENCIL, /* on a plane: no map, but marks in the picture's stencil */
    GN_ENCODING_COUNT,
    GN_ENCODING_AUTO = GN_ENCODING_COUNT,
    GN_ENCODING_SCREEN, /* no map: the visibility at each pixel of the picture, bits of a float,
                           that the caller of gl/ computes. Only for TRUTH */
    GN_ENCODING_ALL,
};

struct gn_technique_row {
    const char *name;
    const char *title;    /* for people who look at the picture; several have the same */
    bool offered;         /* a kiosk without modes goes through these alone */
    int rank;             /* place in the kiosk's order of modes, from 1, best first; 0: last */
    const char *file;     /* below shaders_es/, NULL for none */
    bool compares_linear; /* compares and weighs four texels: needs a LINEAR compare sampler */
    bool searches; /* needs a blocker's distance: samples a depth map without hardware compare */
    bool one_code; /* compares all its texels with the code of the point, not with those of the
                      face's plane: the bias has to be that of the face, not of a smooth normal */
    bool reads_distance; /* `auto` selects a distance map for it; else a depth map */
    bool on_plane;       /* only the scene's plane receives its shadows: planar.h */
    bool on_screen;      /* no map is drawn: encoding SCREEN */
    bool soft;           /* penumbrae by the light's size: the map includes their width */
    enum gn_taps taps;
    enum gn_filter filter; /* passes convert the map into what it reads, here called moments, cone
                              maps too; else NONE */
    bool reads_both;       /* and reads the map beside them, a depth map, with hardware compare */
    const char *moments;   /* below shaders_es/: converts a code to moments; NULL: the filter's
                              steps know */
    float moments_middle;  /* subtracted before storing as half floats: the middle of the range */
    uint8_t stores[GN_STORES_MAX]; /* gn_moments that can store it, best first, then NONE */
    uint8_t fallback;              /* gn_technique in its place where the GPU has none of those;
                                      NONE: pcf */
    unsigned map_px;               /* default resolution, where that is not 1024 */
    unsigned radius_texels; /* reads at most so far from the point, rounded up: margin of the map */
    float filter_radius_px; /* radius of a filter that can have another one; 0: it cannot */
    float filter_most;      /* its largest radius */
    float bias_texels; /* scale of the normal offset and slope. On a flat surface lookups up to 1.7
                          times as far away stay lit; less than 2 % of the filter's weight lies
                          beyond */
    const char *what;  /* one line of help */
    const char *source;
};
extern const struct gn_technique_row gn_techniques[GN_TECHNIQUE_ALL];

struct gn_encoding_row {
    const char *name;     /* as in --map-format */
    const char *file;     /* below shaders_es/; with hardware compare gl/compose.c has another */
    unsigned texel_bytes; /* with its depth attachment */
};
extern const struct gn_encoding_row gn_encodings[GN_ENCODING_ALL];

static inline bool gn_encoding_is_depth(enum gn_encoding encoding) {
    return encoding == GN_ENCODING_DEPTH || encoding == GN_ENCODING_DEPTH16;
}
/* That of the programs that draw and read such a map, in their keys. */
static inline enum gn_encoding gn_encoding_of_programs(enum gn_encoding encoding) {
    return encoding == GN_ENCODING_DEPTH16 ? GN_ENCODING_DEPTH : encoding;
}

/* Whether its visibility has values between 0 and 1: then those of two tiles can be mixed near
 * their common edge. */
bool gn_technique_shades(enum gn_technique technique);

/* What makes its moments of the map. */
static inline const struct gn_filter_row *gn_technique_filter(enum gn_technique technique,
                                                              enum gn_moments moments) {
    return &gn_filters[moments == GN_MOMENTS_RGBA16F_MIPS ? GN_FILTER_MIPS
                                                          : gn_techniques[technique].filter];
}

/* Whether it reads a filtered map. */
static inline bool gn_technique_filters_map(enum gn_technique technique) {
    return gn_techniques[technique].filter != GN_FILTER_NONE;
}

/* Whether it reads that alone, in the map's place. */
static inline bool gn_technique_replaces_map(enum gn_technique technique) {
    return gn_technique_filters_map(technique) && !gn_techniques[technique].reads_both;
}

/* A resolution that its maps can have, at most so many pixels: even where its filter has a texel
 * for four. */
uint32_t gn_technique_map_px(enum gn_technique technique, uint32_t px);
/* Along a side, texels of its map per texel of its filter's textures: 1, cone maps 2. Where things
 * move and the map has one tile, up to 8, if 256 texels of a cone map are left: a flooding step
 * costs as much as it has texels (README.md: what that costs in penumbrae). */
uint32_t gn_technique_cell_px(enum gn_technique technique, uint32_t map_px, bool moves_in_one_tile);

/* All of the table in the order of their ranks. */
void gn_techniques_by_rank(enum gn_technique out[GN_TECHNIQUE_COUNT]);

/* By name, of so many bytes. False: there is none. TRUTH is not found. */
bool gn_technique_find(const char *name, size_t length, enum gn_technique *out);

/* The encoding that a technique gets: the wanted one, or for AUTO the first in the technique's
 * order that `proved` (a bit per encoding) has, else RGBA8. Where the wanted one is missing,
 * *fell_back is set and the automatic one taken. On the plane it is MASK, whatever is wanted; a map
 * that is filtered has one that loses nothing, and it is its moments that can be wanted, but of a
 * technique that reads both a depth format can be;
 * STENCIL is for who draws the picture to choose. */
enum gn_encoding gn_encoding_choose(enum gn_technique technique, enum gn_encoding wanted,
                                    uint32_t proved, bool *fell_back);

#endif
