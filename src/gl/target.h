/* What passes draw to: the output, shadow maps, moments of them (target.c). */
#ifndef GN_GL_TARGET_H
#define GN_GL_TARGET_H

#include "gl/table.h"

struct gn_gl_output {
    uint32_t width_px, height_px, msaa, msaa_wanted;
    uint32_t shown_width_px, shown_height_px; /* of the finished picture */
    enum gn_output_format format;
    bool made;
    bool window;  /* the finished picture goes to the display's framebuffer (name 0) */
    bool scales;  /* it has another size than passes draw */
    bool encodes; /* a last pass makes a picture of bytes of it */
    enum gn_output_format finished;
    bool stencil; /* beside the depth, in `depth` */
    GLuint framebuffer, color, depth;
    GLuint resolved, resolved_color; /* without msaa the same as framebuffer, and 0 */
    /* With such a pass: the linear picture as a texture, and the result, in that format. */
    GLuint texture, encoded, encoded_color;
    GLuint scaled, scaled_color; /* 0: the window, or nothing is scaled */
    bool gathers; /* the picture is a texture, and beside it are means, by their index */
    GLuint means[2], mean_colors[2];
    uint64_t bytes;
};
struct gn_gl_map {             /* a shadow map, or moments of one */
    uint32_t slot;             /* view x GN_ALL_SHADOWS_MAX + the plan's, or one of these below */
    enum gn_encoding encoding; /* without moments */
    enum gn_moments moments;   /* then it has no depth */
    uint32_t index;            /* of those with moments; 1: far sides of casters */
    bool mipmaps;              /* as in gn_target */
    uint32_t width_px, height_px;
    GLuint framebuffer, texture, depth;
    uint64_t content_hash[GN_SHADOW_TILES_MAX]; /* by tile; 0: undefined */
    uint32_t points; /* MEAN: of the lamp, that it has, where the hash is defined */
    bool cleared;    /* the first tile of this frame cleared all tiles */
    uint64_t bytes, last_used;
};
enum { /* maps are kept up to these limits, so that alternating plans find theirs again */
       GN_GL_MAPS_MAX = 8 * GN_ALL_SHADOWS_MAX,
       GN_GL_MAPS_MB = 256,
       GN_GL_SLOT_PAGES = GN_PLAN_VIEWS_MAX * GN_ALL_SHADOWS_MAX, /* pages, intermediate moments */
       GN_GL_SLOT_STAND_INS,
};
enum gn_gl_map_sampler {
    GN_GL_MAP_NEAREST,
    GN_GL_MAP_LINEAR,
    GN_GL_MAP_TRILINEAR,
    GN_GL_MAP_COMPARE,
    GN_GL_MAP_COMPARE_LINEAR,
    GN_GL_MAP_SAMPLER_COUNT,
};
struct gn_gl_targets {
    struct gn_gl_output outputs[GN_PLAN_VIEWS_MAX];
    struct gn_gl_output *output; /* of the plan prepared or run last; never NULL */
    uint32_t view;               /* of the same plan */
    struct gn_gl_map maps[GN_GL_MAPS_MAX];
    GLuint map_samplers[GN_GL_MAP_SAMPLER_COUNT];
    GLuint mipmap_samplers[GN_SHADOWS_MAX]; /* by unit: of a mipmap of their own */
    uint64_t prepares;
    bool stand_ins;            /* maps, pages and moments are a few texels: for warm-up draws */
    bool wants_stencil;        /* some plan will need one: avoids creating the output twice */
    struct gn_gl_output pixel; /* 1 x 1, otherwise like a plan's output: target of warm-up draws */
};
bool gn_gl_targets_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* Those of that view, from now on. */
void gn_gl_targets_choose(struct gn_gl *gl, uint32_t view);
/* Only the maps of a plan, for one that is not drawn yet. */
bool gn_gl_maps_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* gl->targets.pixel as the plan's output. */
bool gn_gl_pixel_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* The framebuffers that passes to the output, and to its encoded copy, draw to; 0: the window's. */
GLuint gn_gl_output_drawn(const struct gn_gl_output *output);
GLuint gn_gl_output_encoded(const struct gn_gl_output *output);
/* The framebuffer that holds the finished picture, of shown_width_px, and its format. */
GLuint gn_gl_output_finished(const struct gn_gl_output *output);
enum gn_output_format gn_gl_output_format(const struct gn_gl_output *output);
/* The map, pages or moments of a target; NULL: not created. */
struct gn_gl_map *gn_gl_target_find(struct gn_gl *gl, const struct gn_target *target);
/* Samples no finer mipmaps than that, which may lie between two; for that unit. */
GLuint gn_gl_mipmap_sampler(struct gn_gl *gl, uint32_t unit, float mipmap);
/* Generates mipmaps, if it has any, after the base level was drawn. */
void gn_gl_target_reduce(struct gn_gl *gl, const struct gn_gl_map *map);
/* The map of a light; or_moments: its moments where it has some, which shaders then sample. */
struct gn_gl_map *gn_gl_view_find(struct gn_gl *gl, const struct gn_shadow_view *view,
                                  uint32_t slot, bool or_moments);
struct gn_gl_map *gn_gl_map_of_slot(struct gn_gl *gl,
                                    uint32_t slot); /* most recently used; NULL: none */
void gn_gl_targets_forget(struct gn_gl *gl);        /* invalidates all cached map contents */
uint64_t gn_gl_targets_bytes(const struct gn_gl *gl);
void gn_gl_targets_init(struct gn_gl *gl);
void gn_gl_targets_finish(struct gn_gl *gl);
/* Checks the bound framebuffer for completeness. */
bool gn_gl_framebuffer_check(struct gn_gl *gl, const char *what, struct gn_err *err);

#endif
