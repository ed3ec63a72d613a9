/* The frame plan: what a frame consists of, as plain data. Built from a pose and options without
 * GL, run by gl/, printed and compared as text in tests. A plan points into the scene, the pose and
 * the builder; it is valid until the next build. */
#ifndef GN_FRAME_PLAN_H
#define GN_FRAME_PLAN_H

#include <stdio.h>

#include "caption/run.h"
#include "environment/environment.h"
#include "frame/caps.h"
#include "frame/feature.h"
#include "frame/program.h"
#include "scene/level.h"
#include "scene/pose.h"
#include "shadow/fit.h"
#include "shadow/slide.h"

#define GN_LIGHTS_MAX      8  /* lights in one pass */
#define GN_SHADOWS_MAX     4  /* of them with a map */
#define GN_SLIDES_MAX      4  /* of them with a slide, in one frame too */
#define GN_SAMPLERS_MAX    16 /* of a program: ES 3.0 promises no more */
#define GN_ALL_LIGHTS_MAX  32 /* lights in one frame: passes beyond the first add to the picture */
#define GN_ALL_SHADOWS_MAX 16 /* of them with a map */
#define GN_PLAN_VIEWS_MAX  4  /* that have targets of their own */
#define GN_GROUPS_MAX      4  /* of lights that share a pass */
#define GN_POINT_CONSTANTS 6  /* vec4 of a point of a lamp: PASS_CLIP to PASS_CODE_ADD */

enum gn_tone {               /* what maps the picture's radiance to what a screen shows */
               GN_TONE_AUTO, /* of options only */
               GN_TONE_NONE,
               GN_TONE_NEUTRAL,
               GN_TONE_ACES,
               GN_TONE_AGX,
               GN_TONE_COUNT
};
enum gn_aov {
    GN_AOV_COLOR,
    GN_AOV_VISIBILITY,
    GN_AOV_DISTANCE,
    GN_AOV_NORMAL,
    GN_AOV_OCCLUSION,
    GN_AOV_COUNT
};

/* ---- programs: a variant is a key ---- */

struct gn_program_light { /* one light of a LIT or visibility program */
    uint8_t type;         /* gn_light_type */
    uint8_t technique;    /* gn_technique; NONE: no map */
    uint8_t encoding;     /* gn_encoding, 0 when technique is NONE */
    uint8_t slide;        /* gn_slide */
    uint8_t slide_ends;   /* at a far plane: 0 or 1 */
    uint8_t moments;      /* gn_moments: what is read in the map's place, or beside it */
    uint8_t cascades;     /* its map has some: 0 or 1 */
    uint8_t ranged;       /* it ends at its range: 0 or 1 */
    uint8_t radius_set; /* its filter's radius is read from SHADOW_SLOPE, not compiled in: 0 or 1 */
    uint8_t taps;       /* samples of a technique that takes them, else 0 */
};
enum gn_receiver { /* whose shadows an item receives */
                   GN_RECEIVES_MAPS,
                   GN_RECEIVES_NOTHING,
                   GN_RECEIVES_ALL, /* planar ones, too */
};
struct gn_program_key { /* compared with memcmp: zero it first. Lights with maps come first. */
    uint64_t features;  /* GN_FEATURE(..) */
    uint8_t kind, aov, light_count, shadow_count;
    uint8_t encoding;  /* DISTANCE: what it writes; PANEL: what it shows; FILTER: of the map, where
                          the step reads that, else 0 */
    uint8_t taps_turn; /* LIT, visibility: patterns of samples are rotated per pixel */
    uint8_t receiver;  /* gn_receiver, of LIT, with more than one group of lights */
    uint8_t step;      /* FILTER: gn_filter_step */
    uint8_t technique; /* FILTER: whose moments; 0 where the step makes none of codes */
    uint8_t moments;   /* FILTER: gn_moments of what it reads and writes */
    uint8_t unused[6];
    struct gn_program_light lights[GN_LIGHTS_MAX];
};
_Static_assert(sizeof(struct gn_program_key) == 24 + sizeof(struct gn_program_light[GN_LIGHTS_MAX]),
               "no padding");

/* ---- what a draw reads ---- */

struct gn_instance {     /* instance attributes, locations 10..15 */
    float world[3][4];   /* rows of world_from_item; of a deformed item as in lib/deform.glsl */
    float base_color[4]; /* linear */
    float surface[4];    /* roughness, metalness, occlusion strength, alpha cutoff */
    float emissive[4];   /* linear radiance; w: 1 = casts */
};
#define GN_NO_GEOMETRY UINT32_MAX /* a draw of bare vertices: they have only gl_VertexID */
struct gn_draw {                  /* one instanced call */
    uint32_t program;             /* index into plan->programs */
    uint32_t geometry, material;  /* material: for textures, transforms */
    uint32_t vertex_count;        /* with GN_NO_GEOMETRY; triangles */
    uint32_t first_instance, instance_count;
    uint8_t cull;  /* gn_cull */
    bool mirrored; /* front faces wind clockwise */
    uint8_t level; /* of plan->detail, from 1; 0: the whole mesh */
    float depth_m; /* how far behind the near plane its instances end, on average; a picture is
                      drawn in this order */
};

enum gn_cull { GN_CULL_NONE, GN_CULL_BACK, GN_CULL_FRONT };
enum gn_blend {
    GN_BLEND_OFF,
    GN_BLEND_ALPHA,    /* premultiplied: ONE, ONE_MINUS_SRC_ALPHA */
    GN_BLEND_ADD,      /* the same with an alpha of 0: adds, and leaves the picture's alpha */
    GN_BLEND_TINT,     /* multiplies: ZERO, SRC_COLOR; alpha as GN_BLEND_ALPHA has it */
    GN_BLEND_SUBTRACT, /* of a mask, which holds less then; draws where the depth is LESS */
};

/* ---- passes: each carries all its state ---- */

/* What a pass does with the picture's stencil, all bits: draws where, of those it reads, it holds
 * `value`, and there writes those of `value` that it may. Zeroed: nothing. */
struct gn_stencil {
    uint8_t value, reads, writes;
};

enum gn_target_kind {
    GN_TARGET_OUTPUT,
    GN_TARGET_SHADOW,
    GN_TARGET_ENCODED, /* bytes beside a linear output, which the first pass to it reads */
    GN_TARGET_SCALED,  /* of the size that is shown, when the scene is drawn at another */
    GN_TARGET_MEAN,    /* beside an output that `gathers`. 1: of a part of the pictures, which is
                          drawn from the output; 0: of all, from those */
    GN_TARGET_PAGES,   /* beside a map, of its size, or that of one of its cascades: from here a
                          later pass copies */
    GN_TARGET_MOMENTS, /* what a map is filtered into */
    GN_TARGET_BACKS,   /* beside a map or its pages, of their size: far sides of casters, which the
                          next pass reads */
};
struct gn_rect { /* pixels of a target, first row at the bottom */
    uint32_t x, y, width, height;
};
struct gn_target {
    enum gn_target_kind kind;
    uint32_t slot; /* not of the picture: which of plan->shadows */
    uint32_t width_px, height_px;
    enum gn_encoding encoding; /* SHADOW, PAGES, BACKS */
    enum gn_moments moments;   /* MOMENTS */
    uint32_t index; /* MEAN: as above. MOMENTS: as in gn_filter_stage: 0 is the slot's own; the
                       others are shared, and hold something until the slot's filter ends */
    bool mipmaps;   /* MOMENTS: made of the whole when it is complete */
};
/* What a filter reads. */
struct gn_read {
    enum gn_read_kind { GN_READ_NOTHING, GN_READ_MAP, GN_READ_MOMENTS } kind;
    uint32_t index;               /* MOMENTS */
    uint32_t width_px, height_px; /* MOMENTS */
};
struct gn_copy {
    struct gn_rect from; /* of the pages */
    uint32_t to_x, to_y; /* its lower left corner in the map */
};
/* Whether its moments may be averaged, and no other tile lies beside them. */
static inline bool gn_view_has_mipmaps(const struct gn_shadow_view *view) {
    return gn_moments[view->moments].mipmaps && view->map.tile_count == 1;
}
/* The size of what its map is filtered into. */
void gn_view_filtered_size(const struct gn_shadow_view *view, uint32_t size_px[2]);

/* What a pass clears at its start: colour or encoded distance, depth, stencil. */
struct gn_clear {
    enum gn_clear_area {
        GN_CLEAR_NOTHING,
        GN_CLEAR_RECT, /* the pass's viewport, a tile. When all tiles of the map are to be drawn,
                          the first may clear all of it instead. */
        GN_CLEAR_ALL,
    } area;
    float color[4];       /* picture: linear; map: the light's far end, encoded, in [0] */
    uint8_t stencil_bits; /* with GN_CLEAR_NOTHING: these are set to 0 in the whole picture */
};
/* What a tile of a map, or of its moments, holds once it is drawn. Zeroed: nothing is kept. */
struct gn_content {
    uint32_t tile;
    uint64_t hash;  /* skip the pass if the tile already holds this */
    bool completes; /* after this pass the tile holds it; earlier ones only lead up to it */
};
enum gn_pass_kind {
    GN_PASS_PICTURE, /* target OUTPUT or ENCODED */
    GN_PASS_MAP,     /* casters: to SHADOW, or to PAGES and BACKS, which complete nothing */
    GN_PASS_COPY,    /* pages to SHADOW, which is cleared; draws nothing */
    GN_PASS_FILTER,  /* a map, or moments, to MOMENTS; one draw, not cleared */
    GN_PASS_GIVEN, /* SHADOW of encoding SCREEN: holds what gn_gl_give() put there; draws nothing */
};
struct gn_pass {
    char label[48]; /* KHR_debug group, timer, error: "shadow 0 Sun", "opaque", "blend" */
    enum gn_pass_kind kind;
    struct gn_target target;
    struct gn_clear clear;
    struct gn_rect viewport;   /* a tile or a page; width 0: all of the target */
    struct gn_rect rect;       /* draws nothing outside (scissor); width 0: no such bound */
    bool depth_write;          /* the depth test is LEQUAL but with GN_BLEND_SUBTRACT */
    bool discard_depth;        /* no later pass reads the depth: invalidate */
    struct gn_content content; /* all but PICTURE */
    uint32_t first_draw, draw_count;
    /* Constants of the pass's programs, laid out by shaders_es/blocks.glsl; counts in vec4. */
    const float (*constants)[4];
    uint32_t constant_count;
    union { /* by kind */
        struct gn_pass_picture {
            enum gn_blend blend;
            bool only_stencil;                   /* draws FLAT programs: no depth test, no colour */
            struct gn_stencil stencil;           /* of a plan with a stencil */
            uint32_t first_light, light_count;   /* of plan->lights: what its LIT programs know */
            uint32_t first_shadow, shadow_count; /* as gn_pass_slot() says */
            uint32_t plane_count,
                first_on_plane; /* the last so many are of planar lights: their
                                   shadows are those on one plane, from that slot */
            uint32_t slide_count, slides[GN_SLIDES_MAX]; /* textures; slide i: sampler i */
            bool reads_codes; /* map samplers do not compare, and are of maps, filtered or not */
            bool reads_atlas; /* plan->atlas is behind sampler 0 */
            uint32_t mean_of; /* the mean of that view's pictures is, from 1; 0: none */
            bool resolves;    /* the last to OUTPUT: its samples are averaged after this pass */
            bool scales; /* to SCALED, which the picture so far fills, by a linear filter; draws
                            nothing */
        } picture;
        struct gn_pass_map {
            uint32_t border_px; /* this many texels at the target's rim stay cleared (scissor) */
            bool reads_backs;   /* BACKS of its target are behind sampler 0 */
            /* Of encoding MEAN: its draws are repeated for each point of the lamp, with constants
             * of its own; in each texel the nearest depth is drawn once per point, and subtracted.
             * Points that the map already has are skipped. */
            uint32_t point_count;     /* that it has after this pass; 0: none, it is only cleared */
            const float (*points)[4]; /* GN_POINT_CONSTANTS each */
            const float (*foot)[4];   /* with the first of them, both sides of all faces; or NULL */
        } map;
        struct gn_pass_copy {
            struct gn_target from; /* undefined afterwards */
            uint32_t count;
            struct gn_copy copies[GN_SHADOW_PAGES_MAX];
        } copy;
        struct gn_pass_filter {
            bool blends;                              /* with what is there, by alpha */
            struct gn_read reads[GN_FILTER_FROM_MAX]; /* sampler i, of the same slot */
        } filter;
    };
};

/* A picture as a whole: into a mean, or a mean over the picture. */
static inline bool gn_pass_is_mean(const struct gn_pass *pass) {
    return pass->target.kind == GN_TARGET_MEAN || pass->picture.mean_of > 0;
}

/* What is behind sampler i: plan->shadows[..]. */
static inline uint32_t gn_pass_slot(const struct gn_pass_picture *picture, uint32_t i) {
    const uint32_t maps = picture->shadow_count - picture->plane_count;
    return i < maps ? picture->first_shadow + i : picture->first_on_plane + i - maps;
}

enum gn_output_format {
    GN_OUTPUT_SRGB8,   /* SRGB8_ALPHA8: encodes on write */
    GN_OUTPUT_LINEAR8, /* RGBA8; with encode_srgb the shaders encode */
    GN_OUTPUT_FLOAT,   /* RGBA16F */
    GN_OUTPUT_AOV,     /* RGBA32UI: bits of four floats; not blended, not antialiased */
};
struct gn_plan {
    uint32_t view;                /* whose output and maps it draws to: those of other views stay */
    uint32_t width_px, height_px; /* that the scene is drawn at */
    uint32_t shown_width_px, shown_height_px; /* of the finished picture */
    enum gn_output_format output;
    bool encode_srgb; /* sRGB wanted of a GPU without such a target: shaders encode, or, where
                         the picture is finished last, the last pass does */
    bool finishes;    /* output is FLOAT, and a last pass makes a picture of bytes of it */
    enum gn_output_format finished; /* the format of that: SRGB8, or LINEAR8 */
    enum gn_tone tone;              /* never AUTO */
    bool tones_sum;                 /* the last pass maps it */
    bool transparent;               /* the last pass keeps alpha, and divides colours by it */
    bool gathers;                   /* output is FLOAT, and goes into a mean of pictures */
    uint32_t msaa;                  /* samples: 0, 2, 4 */
    bool stencil;                   /* the output has one */
    enum gn_aov aov;
    const struct gn_scene *scene;
    struct gn_pass *passes;
    struct gn_draw *draws;
    struct gn_instance *instances;
    struct gn_program_key *programs; /* those that the draws use, each once, and those that they
                                        need when an added light comes near */
    struct gn_shadow_view *shadows;  /* one per slot: a map each */
    const uint32_t *lights;          /* of the scene: the lights of the frame, group by group */
    const struct gn_caption_atlas *atlas; /* what captions read; NULL: there are none */
    struct gn_plan_environment {
        const struct gn_environment_light *light; /* what ENVIRONMENT programs read, or NULL */
        uint64_t id;                              /* of its content */
    } environment;
    struct gn_plan_occlusion { /* what OCCLUDED programs read */
        bool on;
        const int8_t (*texels)[4]; /* as gn_frame_occlusion_opts has them */
        uint64_t id;
    } occlusion;
    const struct gn_detail *detail;      /* whose levels draws name; NULL: none does */
    const struct gn_material *materials; /* the scene's, or as clips make them */
    const float (*pose_texels)[4];       /* of the pose: as many as scene->deformation says */
    uint32_t pass_count, draw_count, instance_count, program_count, shadow_count, light_count;
    uint32_t culled; /* items that the camera does not see */
    bool is_behind;  /* wants another frame: a filtered map is older than the pose (filter_texels),
                        or a planar mask lacks points of its lamp (gather_points) */
    uint64_t maps_bytes; /* the limit that its maps hold; 0: none */
    float exposure;
};

/* What a draw of a geometry draws: so many corners from there on. */
struct gn_corners {
    const uint32_t *indices;
    uint32_t count, vertex_count;
};
static inline struct gn_corners gn_draw_corners(const struct gn_scene *scene,
                                                const struct gn_detail *detail,
                                                const struct gn_draw *draw) {
    const struct gn_geometry *whole = &scene->geometries[draw->geometry];
    if (draw->level == 0)
        return (struct gn_corners){scene->buffers.indices + whole->first_index, whole->index_count,
                                   whole->vertex_count};
    const struct gn_level *level = &detail->geometries[draw->geometry].at[draw->level - 1];
    return (struct gn_corners){detail->indices + level->first_index, level->index_count,
                               level->vertex_count};
}
/* Whether the scene is drawn at another size than the picture has. */
static inline bool gn_plan_scales(const struct gn_plan *plan) {
    return plan->shown_width_px != plan->width_px || plan->shown_height_px != plan->height_px;
}
/* What its shadows take on the GPU: maps, their pages, what they are filtered into. */
uint64_t gn_plan_map_bytes(const struct gn_plan *plan);
/* The plan as text: stable, readable, for diffs. */
void gn_plan_print(const struct gn_plan *plan, FILE *to);
/* All preconditions that gl/ relies on, in one list; NULL when the plan holds them, else the first
 * one broken. */
const char *gn_plan_check(const struct gn_plan *plan);

#endif
