/* The cache of GL state, which is diffed and never restored, and counted GL objects (state.c). */
#ifndef GN_GL_STATE_H
#define GN_GL_STATE_H

#include "gl/table.h"

enum gn_gl_location { /* of inputs in shaders: a vertex's have the numbers of gn_attribute */
                      GN_GL_WORLD = 10, /* an instance's: three rows */
                      GN_GL_BASE_COLOR = GN_GL_WORLD + 3,
                      GN_GL_SURFACE,
                      GN_GL_EMISSIVE,
                      GN_GL_LOCATION_COUNT,
};
_Static_assert((int)GN_ATTRIBUTE_COUNT <= (int)GN_GL_WORLD && GN_GL_LOCATION_COUNT <= 16,
               "ES 3.0 promises 16");
enum { /* texture units: maps first, then one a gn_texture_slot, then slides, one for work of our
          own, and what maps are filtered into, of techniques that read both. ES 3.0 promises 32,
          and 16 to one shader: GN_SAMPLERS_MAX. */
       GN_GL_UNIT_MAP = 0,
       GN_GL_UNIT_TEXTURE = GN_SHADOWS_MAX,
       GN_GL_UNIT_SLIDE = GN_GL_UNIT_TEXTURE + GN_TEXTURE_SLOT_COUNT,
       GN_GL_UNIT_WORK = GN_GL_UNIT_SLIDE + GN_SLIDES_MAX,
       GN_GL_UNIT_FILTERED,
       GN_GL_UNIT_ENVIRONMENT = GN_GL_UNIT_FILTERED + GN_SHADOWS_MAX, /* a cube */
       GN_GL_UNIT_OCCLUSION,                                          /* a volume */
       GN_GL_UNIT_POSE, /* what vertex shaders read of skins and targets */
       GN_GL_UNIT_DELTAS,
       GN_GL_UNIT_COUNT,
};
_Static_assert(GN_GL_UNIT_COUNT <= 32, "texture units that ES 3.0 promises");

/* ---- the cache ---- */

struct gn_gl_rect {
    GLint x, y;
    GLsizei width, height;
};
struct gn_gl_state {
    GLuint framebuffer, program, vertex_array, array_buffer;
    struct gn_gl_rect viewport, scissor;
    bool scissor_on, depth_on, depth_write, blend_on, subtracts, tints, cull_on, mirrored,
        stencil_on, color_write;
    struct gn_stencil stencil;
    uint8_t cull; /* gn_cull, when on */
    GLuint unit;  /* the active one */
    GLuint textures[GN_GL_UNIT_COUNT], samplers[GN_GL_UNIT_COUNT];
    float clear_color[4];
    float depth; /* that all fragments have; 0: their own */
};
void gn_gl_state_init(
    struct gn_gl *gl); /* sets the state common to all passes; initialises the cache */
void gn_gl_bind_framebuffer(struct gn_gl *gl, GLuint name);
void gn_gl_bind_vertex_array(struct gn_gl *gl, GLuint name);
void gn_gl_bind_array_buffer(struct gn_gl *gl, GLuint name);
void gn_gl_bind_texture(struct gn_gl *gl, GLuint unit, GLuint texture, GLuint sampler);
/* Binds the environment's cube, on a unit that has no other textures. */
void gn_gl_bind_cube(struct gn_gl *gl, GLuint texture, GLuint sampler);
/* The same of occlusion's volume. */
void gn_gl_bind_volume(struct gn_gl *gl, GLuint texture, GLuint sampler);
/* Binds a texture for calls that name none (storage, upload), on a unit of its own. */
void gn_gl_work_on_texture(struct gn_gl *gl, GLuint texture);
void gn_gl_work_on_cube(struct gn_gl *gl, GLuint texture); /* on that unit */
void gn_gl_work_on_volume(struct gn_gl *gl, GLuint texture);
void gn_gl_use_program(struct gn_gl *gl, GLuint name);
void gn_gl_set_viewport(struct gn_gl *gl, struct gn_gl_rect rect);
void gn_gl_set_scissor(struct gn_gl *gl, const struct gn_gl_rect *rect); /* NULL: off */
void gn_gl_set_depth(struct gn_gl *gl, bool test, bool write);
void gn_gl_set_blend(struct gn_gl *gl, enum gn_blend blend);
/* All fragments get this depth, 0 to 1, after they were clipped; 0: their own. */
void gn_gl_set_one_depth(struct gn_gl *gl, float depth);
void gn_gl_set_cull(struct gn_gl *gl, enum gn_cull cull, bool mirrored);
void gn_gl_set_color_write(struct gn_gl *gl, bool write); /* affects clears */
void gn_gl_set_stencil(struct gn_gl *gl, const struct gn_stencil *stencil);
void gn_gl_set_stencil_writes(struct gn_gl *gl, uint8_t bits); /* for clears */
void gn_gl_set_clear_color(struct gn_gl *gl, const float rgba[4]);
/* What one triangle over a whole target of that size is drawn with (gn_gl_whole_vertex). */
void gn_gl_set_whole(struct gn_gl *gl, uint32_t width, uint32_t height, enum gn_blend blend);

/* ---- objects: created here, so that they are counted ---- */

enum gn_gl_object {
    GN_GL_BUFFER,
    GN_GL_FRAMEBUFFER,
    GN_GL_RENDERBUFFER,
    GN_GL_SAMPLER,
    GN_GL_TEXTURE,
    GN_GL_VERTEX_ARRAY,
};
GLuint gn_gl_object_create(struct gn_gl *gl, enum gn_gl_object kind);
/* A framebuffer, bound; a texture of so many levels, on the unit of work; a sampler with these
 * filters that clamps. */
GLuint gn_gl_framebuffer_make(struct gn_gl *gl);
GLuint gn_gl_texture_make(struct gn_gl *gl, GLsizei levels, GLenum format, uint32_t width,
                          uint32_t height);
GLuint gn_gl_sampler_make(struct gn_gl *gl, GLint minified, GLint magnified);
/* Also clears *name and what the state cache knows of it; 0 is legal. */
void gn_gl_object_destroy(struct gn_gl *gl, enum gn_gl_object kind, GLuint *name);

#endif
