/* From a light, a pose and a camera to a shadow view: what a shadow map shows and how it is read.
 * Pure.
 *
 * Plane coordinates: for a directional light metres across the light's direction, for a spot
 * tangents (x/z, y/z). The map is an extent in them: the smallest that holds every place where a
 * caster can darken something visible, of a width from a geometric series and with its corner on a
 * whole texel, so that it moves by whole texels when the camera moves, and a directional one then
 * holds the same bits (shadow/pages.h). A `fixed` map holds what is not visible, too, and stays as
 * it is wherever the camera goes.
 *
 * A point light has six such maps, the tiles of an atlas: each looks along an axis of the world, 45
 * degrees to each side and a gutter more, as wide as the technique's filter, so that what is read
 * beside a place near a tile's edge is right and techniques are independent of tiles. Tile 2 a + s
 * looks along axis a, to its negative end if s is 1, and lies in column a and row s of the atlas.
 * The texels of two tiles have different grids, so a filter gives different values on either side
 * of their edge: near it both tiles are sampled and the results are mixed.
 */
#ifndef GN_SHADOW_FIT_H
#define GN_SHADOW_FIT_H

#include "scene/pose.h"
#include "shadow/light_opts.h"

#define GN_SHADOW_STEP  1.0905077f /* from one size of texel to the next: 8 an octave */
#define GN_SPOT_MAX_RAD 1.3962634f /* 80 degrees: a spot's map does not reach beyond */

struct gn_shadow_opts {
    enum gn_technique technique; /* not NONE */
    enum gn_encoding encoding;   /* a proved one, never AUTO */
    enum gn_moments moments;     /* of a technique that filters its map: proved ones */
    uint32_t map_px;             /* side of the map, or of a tile; with STENCIL 0 */
    bool all_receive;            /* ignore gnomon_receive: for pictures of visibility */
    uint32_t plane;              /* on_plane: which of the scene, from 1; 0: the first */
    uint32_t points;             /* with MEAN: of the lamp (lamp.h) */
    bool whole;                  /* on_plane: the window is all of the shadow, seen or not */
    struct gn_shadow_square {
        float middle[2], half_m; /* world x and z; 0: there is none */
        float held_m;            /* half of its middle part that the window holds in any case */
    } square;                    /* technique FLOOR: of the floor, whose rim has no shadow */
    bool but_floor;              /* the unseen floor does not receive from this map */
    bool fixed; /* the same map for every eye: of all that casts and receives, seen or not. Not of
                   cascades, nor on a plane, where `whole` says so */
    bool moves; /* the light, or what casts: the map is drawn and filtered in each frame */
    struct gn_light_opts light; /* what holds for the light; what is not given is the scene's, or
                                   the technique's. The fields above are already chosen by it */
    uint32_t cascades; /* directional, not on a plane: of as many tiles; 0, 1: one map. More than
                          one need an eye with a perspective */
};

/* A summed-area table (SAT, GN_FILTER_TABLE) is read at most this many texels from a place, so the
 * widest penumbra is about twice that. The fixed point of its sums (shaders_es/blocks.glsl) gets
 * coarser with the square of it: with this value they are right to a millionth. */
#define GN_TABLE_REACH_PX 90

enum { GN_SHADOW_TILES_MAX = 6 };
struct gn_shadow_tile {
    mat4 light_from_world; /* rigid, but mirrored where it says so; looks along -Z */
    mat4 clip_from_world;  /* draws the tile */
    uint32_t x_px, y_px;   /* its corner in the map */
    bool mirrored;
    bool empty;            /* nothing in view can be in its shadow: it holds the far end */
    uint64_t content_hash; /* of all that decides what it holds, casters included; never 0 */
};

/* A part of a directional map as it is drawn (shadow/pages.h); px: x, y. */
enum { GN_SHADOW_PAGES_MAX = 4 };
struct gn_shadow_page {
    mat4 clip_from_world; /* draws the page, as wide as the map or the tile's inner part, whatever
                             the camera sees */
    double corner[2];     /* its lower left texel, counted from the light's axis */
    uint32_t from_px[2], to_px[2], size_px[2]; /* the part that is needed: where it is drawn and
                                                  where it goes in the map */
};

/* What a directional map, or the inner part of a cascade, holds; outside of it the map is cleared.
 */
struct gn_shadow_drawn {
    double
        corner_texels[2]; /* the lower left texel of what is drawn, counted from the light's axis */
    uint32_t px[2], size_px[2]; /* in the map; at least a texel from its edge */
    bool paged; /* drawn in pages, then copied; else the one page is the map. Cascades: always */
    uint32_t page_count; /* 0: nothing is drawn in pages (spot, point, on a plane, empty) */
    struct gn_shadow_page pages[GN_SHADOW_PAGES_MAX];
};

/* A cascade is a tile for what the camera sees from one distance to another (cascade.h). */
enum { GN_CASCADES_MAX = 4 };
struct gn_shadow_cascade {
    float begin_m, end_m; /* along the view; the last one's end: INFINITY */
    float texel;          /* metres */
    float blur_px;        /* as in gn_shadow_penumbra */
    float nearest;        /* penumbra depth of the nearest caster, as in gn_shadow_penumbra */
    float span;           /* what its moments cover, from there on: 0 to 1 */
    struct gn_shadow_drawn drawn; /* of its inner part */
};

/* The parts of a view. map: the texture that is allocated. */
struct gn_shadow_map {
    uint32_t tile_px;             /* side of a tile; on a plane without a map 0 */
    uint32_t width_px, height_px; /* all tiles */
    uint32_t tile_count;          /* 1, point: 6, cascades: 2 or 4 */
    uint32_t cascade_count;       /* 0, or 2 to 4 */
    uint32_t gutter_px;           /* point, cascades: of a tile, to each side */
    uint32_t inner_px;            /* cascades: of a tile, without its gutters */
    uint32_t cell_px; /* along a side, texels of the map per texel of its filter's textures */
};

/* How the encoding keeps a distance d: code = scale * d + offset (but not DEPTH, see lookup). */
struct gn_shadow_code {
    float scale, offset;
    float far_end; /* the far end's code: what the map is cleared to .. */
    float clear;   /* .. but in the lesson about clearing; the frame's choice */
    /* What the codes cover: directional 0 and the depth between the clip planes; spot and point the
     * near plane's depth and the greatest distance from the light; on a plane 0 and 1, encoding
     * STENCIL heights over the plane. */
    float near_m, far_m;
    float ulp_m; /* added towards the light: the encoding's rounding at the far end */
};

/* raster: what is drawn into the map. */
struct gn_shadow_raster {
    struct gn_shadow_tile tiles[GN_SHADOW_TILES_MAX];
    struct gn_shadow_drawn drawn; /* directional, not on a plane, without cascades */
    float screen_ndc[2][2]; /* encoding STENCIL: least and greatest place in view that can be dark
                             */
};

/* lookup: where shaders read the map. */
struct gn_shadow_lookup {
    /* Directional, spot: xy / w is 0..1 over the map; z / w is the code for a directional light,
     * and for a spot with encoding DEPTH. Cascades: metres across the light, and the code. */
    mat4 map_from_world;
    /* Point: a tangent from a tile's middle times tangent_uv is uv. Spot, point: with encoding
     * DEPTH the code at depth d along the axis is depth_code[0] + depth_code[1] / d. */
    float tangent_uv[2], depth_code[2];
    float texel;            /* plane units: metres, or metres per metre of depth */
    float bias_texels;      /* the technique's, or as given */
    float filter_radius_px; /* radius of the filter, if one is given; else 0 */
    uint32_t margin_px;     /* texels round a place that are read for it: of the filter, and of what
                               the bias is larger than the technique's */
    float normal_offset;    /* texels (cascades: each one's), times sin(theta) */
    float slope_offset;     /* texels towards the light, times tan(theta) clamped at slope_max */
    float slope_max;
    float reach_px; /* tiles, SAT: how far beside a place may be read */
    float shared;   /* point: tangent, to each side of a tile's edge, where two tiles are mixed */
    float held_px;  /* cascades: how far from a tile's middle it may be read */
};

/* How wide penumbrae are. A penumbra depth grows linearly with the width of penumbrae: a blocker at
 * b throws on a receiver at r one of radius * (r - b) texels. It is the distance from the near
 * plane, or -1 / d for a spot and a point light (shaders_es/lib/shadow_place.glsl). */
struct gn_shadow_penumbra {
    float radius;      /* the emitter's, texels per unit of penumbra depth; cascades: metres */
    float nearest;     /* penumbra depth of the nearest caster; without cascades */
    float scale, bias; /* penumbra depth = scale * code + bias, or its negative inverse for
                          distances from a spot or point light */
    float growth;      /* cascades: how much penumbra depth they may span per metre along the view,
                          where a tile has no room for more; else 1e9 */
    float widest_px;   /* spot, directional without cascades: the widest radius that can be seen */
    float farthest;    /* directional: penumbra depth of the farthest place in a visible shadow */
    float blur_px; /* of a map that is blurred, without cascades: half the width of the blur; else 0
                    */
};

/* The points of a lamp whose shadows a planar mask is the mean of; encoding MEAN. */
struct gn_shadow_lamp {
    uint32_t count;   /* 0: none; 1: its middle; else as in lamp.h */
    uint32_t bytes;   /* of 255, that all points take from a texel */
    uint32_t drawn;   /* those whose shadows the mask has after this frame; the frame's choice */
    float axes[3][3]; /* world space, to where lamp.h has 1 on x, y and z; z of a sun: 0 */
    float corner[2];  /* of the mask, plane coordinates */
    float low_m, highest_m; /* over the plane: where casters begin, and the top of the highest */
};

/* Technique FLOOR: what the mask becomes (filter/floor.frag), and where that is drawn. */
struct gn_shadow_floor {
    float shown[2][2]; /* its window without the rest of the map: least and greatest uv */
    /* the frame's choice: shares of the light there that occlusion and shadows can take (0 to 1);
     * weight of what is drawn now over what is there (0 to 1), and for how many frames more */
    float ambient, key, weight;
    uint32_t left;
};

/* All there is to know of a light's map: see the figure in README.md. */
struct gn_shadow_view {
    uint32_t light;
    enum gn_technique technique;
    enum gn_encoding encoding;
    enum gn_moments moments; /* what shaders read in the map's place, or beside it; NONE: the map */
    uint32_t plane;          /* as in gn_shadow_opts */
    bool all_receive;        /* as in gn_shadow_opts */
    bool whole, but_floor, fixed;   /* likewise */
    struct gn_shadow_square square; /* likewise */
    bool faces_given;
    enum gn_cast_faces faces; /* given: of all casters, in place of their own */
    bool perspective;         /* spot, point */
    bool empty;       /* nothing in view can be in this light's shadow: the map holds the far end */
    vec3 light_ws;    /* position (spot, point) */
    vec3 to_light_ws; /* unit (directional) */
    struct gn_shadow_map map;
    struct gn_shadow_code code;
    struct gn_shadow_raster raster;
    struct gn_shadow_lookup lookup;
    struct gn_shadow_penumbra penumbra;
    struct gn_shadow_lamp lamp;
    struct gn_shadow_floor floor;
    struct gn_shadow_cascade cascades[GN_CASCADES_MAX]; /* map.cascade_count */
};

/* The camera's frustum, for fitting. */
struct gn_eye {
    mat4 clip_from_world;
    vec4 planes[6]; /* inside: dot(plane, (p,1)) >= 0 */
    vec3 corners[8];
};
void gn_eye_build(struct gn_eye *eye, mat4 clip_from_world);
bool gn_eye_sees(const struct gn_eye *eye, const struct gn_box *box); /* conservative */
/* Depths beyond the near plane, whose middle is start_ws, between which boxes of visible items are
 * seen: clipped at the sides, but not at the far plane. INFINITY and 0: nothing is. */
void gn_eye_depths(const struct gn_eye *eye, const vec3 start_ws, const struct gn_pose *pose,
                   float depths_m[2]);

/* A cache of what items cover, kept for a light from frame to frame, so that what stands still is
 * measured once; and the casters found. One per tile, of one scene, for any light at any pose: a
 * view does not depend on earlier ones. */
struct gn_shadow_region { /* in plane coordinates and depth along the light's axis; empty when min >
                             max */
    float min[2], max[2];
    float near, far;
    float far_radial; /* farthest point from the light's origin */
};
struct gn_shadow_memory {
    uint32_t item_count;
    uint8_t *casts;                 /* per item: bit p = draw it into page p, or into the tile */
    uint8_t *seen;                  /* per item: how much of it is visible; private */
    struct gn_shadow_region *whole; /* per item: all that it covers; private */
    struct gn_shadow_region *part;  /* per item partly visible: the visible part; private */
    uint64_t *pose_hash;            /* per item: of the pose that `whole` is of; private */
    uint64_t light_hash, eye_hash;  /* private */
};
void gn_shadow_memory_init(struct gn_shadow_memory *memory, uint32_t item_count);
void gn_shadow_memory_finish(struct gn_shadow_memory *memory);

/* Whether an item is drawn into maps at all: blended items cast no shadow unless they are to cast
 * one by their alpha. */
bool gn_shadow_item_casts(const struct gn_scene *scene, uint32_t item);

/* How many tiles a light's map without cascades has, and the size of the map for a tile of so many
 * pixels. */
uint32_t gn_shadow_tile_count(enum gn_light_type type, enum gn_technique technique);
void gn_shadow_map_size(enum gn_light_type type, enum gn_technique technique, uint32_t map_px,
                        uint32_t size_px[2]);

/* Fits the light's view and fills memory->casts, for each tile (as many memories; of cascades
 * GN_CASCADE_MEMORIES). False: nothing
 * visible can be in this light's shadow; the view is empty: its size is right, and a map that holds
 * only code.far_end is read as lit. Allocates nothing. */
bool gn_shadow_fit(const struct gn_pose *pose, uint32_t light, const struct gn_eye *eye,
                   const struct gn_shadow_opts *opts, struct gn_shadow_memory *memory,
                   struct gn_shadow_view *view);

#endif
