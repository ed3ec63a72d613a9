/* What passes draw to: the output, shadow maps, moments of them (target.c). */
#ifndef GN_GL_TARGET_H
#define GN_GL_TARGET_H

#include "gl/table.h"

struct gn_gl_output {
    uint32_t width_px, height_px, msaa, msaa_wanted;
    enum gn_output_format format;
    bool made;
    bool window;  /* the finished picture goes to the display's framebuffer, whose name is 0 */
    bool encodes; /* a last pass does */
    bool stencil; /* beside the depth, in `depth` */
    GLuint framebuffer, color, depth;
    GLuint resolved, resolved_color; /* without msaa the same as framebuffer, and 0 */
    /* Of a linear picture that is encoded at the end: itself, to be read by a shader, and its
     * bytes. */
    GLuint texture, encoded, encoded_color;
    uint64_t bytes;
};
struct gn_gl_map { /* or what one is filtered into */
    uint32_t slot;
    enum gn_encoding encoding; /* without moments */
    enum gn_moments moments;   /* then it has no depth */
    uint32_t index;            /* of those with moments */
    bool mipmaps;              /* as in gn_target */
    uint32_t width_px, height_px;
    GLuint framebuffer, texture, depth;
    uint64_t content_hash[GN_SHADOW_TILES_MAX]; /* of each tile; 0: nothing */
    bool cleared; /* all of it, before the tiles that are being drawn */
    uint64_t bytes, last_used;
};
enum { /* kept: plans that take turns find their maps again, until they are too much */
       GN_GL_MAPS_MAX = 8 * GN_ALL_SHADOWS_MAX,
       GN_GL_MAPS_MB = 256,
       GN_GL_SLOT_PAGES = GN_ALL_SHADOWS_MAX, /* whose pages all maps of its kind share */
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
    struct gn_gl_output output;
    struct gn_gl_map maps[GN_GL_MAPS_MAX];
    GLuint map_samplers[GN_GL_MAP_SAMPLER_COUNT];
    uint64_t prepares;
    bool wants_stencil;        /* some plan will: the output is not made twice for it */
    struct gn_gl_output pixel; /* 1 x 1, else as a plan's output: what warm draws go to */
};
bool gn_gl_targets_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* The maps of a plan alone, for one that is not drawn yet. */
bool gn_gl_maps_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* gl->targets.pixel as the plan's output. */
bool gn_gl_pixel_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err);
/* Where the finished picture is to be read, and what of. */
GLuint gn_gl_output_finished(const struct gn_gl_output *output);
enum gn_output_format gn_gl_output_format(const struct gn_gl_output *output);
/* What a target that is no picture is drawn to, the pages of a map among them; NULL: not made. */
struct gn_gl_map *gn_gl_target_find(struct gn_gl *gl, const struct gn_target *target);
/* Its smaller levels, if it has such, after the largest was drawn. */
void gn_gl_target_reduce(struct gn_gl *gl, const struct gn_gl_map *map);
/* What shaders read of a light: moments of the map, or the map itself. */
struct gn_gl_map *gn_gl_view_find(struct gn_gl *gl, const struct gn_shadow_view *view,
                                  uint32_t slot, bool moments);
struct gn_gl_map *gn_gl_map_of_slot(struct gn_gl *gl, uint32_t slot); /* used last; NULL if none */
void gn_gl_targets_forget(struct gn_gl *gl); /* maps hold nothing any more */
uint64_t gn_gl_targets_bytes(const struct gn_gl *gl);
void gn_gl_targets_init(struct gn_gl *gl);
void gn_gl_targets_finish(struct gn_gl *gl);
/* The framebuffer that is bound; false if the driver will not have it. */
bool gn_gl_framebuffer_check(struct gn_gl *gl, const char *what, struct gn_err *err);

#endif
