/* The one cache of GL state. Setting what is set already costs no call; nothing is ever restored.
 */
#include <string.h>

#include "gl/private.h"

void gn_gl_bind_framebuffer(struct gn_gl *gl, GLuint name) {
    if (gl->state.framebuffer == name) return;
    gl->state.framebuffer = name;
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, name);
}

void gn_gl_bind_vertex_array(struct gn_gl *gl, GLuint name) {
    if (gl->state.vertex_array == name) return;
    gl->state.vertex_array = name;
    GL(gl, BindVertexArray)(name);
}

void gn_gl_bind_array_buffer(struct gn_gl *gl, GLuint name) {
    if (gl->state.array_buffer == name) return;
    gl->state.array_buffer = name;
    GL(gl, BindBuffer)(GL_ARRAY_BUFFER, name);
}

static void activate_unit(struct gn_gl *gl, GLuint unit) {
    if (gl->state.unit == unit) return;
    gl->state.unit = unit;
    GL(gl, ActiveTexture)(GL_TEXTURE0 + unit);
}

static void bind_to(struct gn_gl *gl, GLenum target, GLuint unit, GLuint texture, GLuint sampler) {
    struct gn_gl_state *s = &gl->state;
    if (s->textures[unit] != texture) {
        activate_unit(gl, unit);
        s->textures[unit] = texture;
        GL(gl, BindTexture)(target, texture);
    }
    if (s->samplers[unit] == sampler) return;
    s->samplers[unit] = sampler;
    GL(gl, BindSampler)(unit, sampler);
}

void gn_gl_bind_texture(struct gn_gl *gl, GLuint unit, GLuint texture, GLuint sampler) {
    bind_to(gl, GL_TEXTURE_2D, unit, texture, sampler);
}

void gn_gl_bind_cube(struct gn_gl *gl, GLuint texture, GLuint sampler) {
    bind_to(gl, GL_TEXTURE_CUBE_MAP, GN_GL_UNIT_ENVIRONMENT, texture, sampler);
}

void gn_gl_bind_volume(struct gn_gl *gl, GLuint texture, GLuint sampler) {
    bind_to(gl, GL_TEXTURE_3D, GN_GL_UNIT_OCCLUSION, texture, sampler);
}

void gn_gl_work_on_texture(struct gn_gl *gl, GLuint texture) {
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, texture, 0);
    activate_unit(gl, GN_GL_UNIT_WORK);
}

void gn_gl_work_on_cube(struct gn_gl *gl, GLuint texture) {
    gn_gl_bind_cube(gl, texture, 0);
    activate_unit(gl, GN_GL_UNIT_ENVIRONMENT);
}

void gn_gl_work_on_volume(struct gn_gl *gl, GLuint texture) {
    gn_gl_bind_volume(gl, texture, 0);
    activate_unit(gl, GN_GL_UNIT_OCCLUSION);
}

void gn_gl_use_program(struct gn_gl *gl, GLuint name) {
    if (gl->state.program == name) return;
    gl->state.program = name;
    GL(gl, UseProgram)(name);
}

static void enable_cached(struct gn_gl *gl, GLenum what, bool *cached, bool on) {
    if (*cached == on) return;
    *cached = on;
    if (on)
        GL(gl, Enable)(what);
    else
        GL(gl, Disable)(what);
}

void gn_gl_set_viewport(struct gn_gl *gl, struct gn_gl_rect rect) {
    if (memcmp(&gl->state.viewport, &rect, sizeof rect) == 0) return;
    gl->state.viewport = rect;
    GL(gl, Viewport)(rect.x, rect.y, rect.width, rect.height);
}

void gn_gl_set_scissor(struct gn_gl *gl, const struct gn_gl_rect *rect) {
    enable_cached(gl, GL_SCISSOR_TEST, &gl->state.scissor_on, rect);
    if (!rect || memcmp(&gl->state.scissor, rect, sizeof *rect) == 0) return;
    gl->state.scissor = *rect;
    GL(gl, Scissor)(rect->x, rect->y, rect->width, rect->height);
}

void gn_gl_set_depth(struct gn_gl *gl, bool test, bool write) {
    enable_cached(gl, GL_DEPTH_TEST, &gl->state.depth_on, test);
    if (gl->state.depth_write == write) return;
    gl->state.depth_write = write;
    GL(gl, DepthMask)(write);
}

void gn_gl_set_blend(struct gn_gl *gl, enum gn_blend blend) {
    const bool subtracts = blend == GN_BLEND_SUBTRACT;
    enable_cached(gl, GL_BLEND, &gl->state.blend_on, blend != GN_BLEND_OFF);
    const bool tints = blend == GN_BLEND_TINT;
    if (blend != GN_BLEND_OFF && gl->state.tints != tints) {
        gl->state.tints = tints;
        GL(gl, BlendFuncSeparate)
        (tints ? GL_ZERO : GL_ONE, tints ? GL_SRC_COLOR : GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
         GL_ONE_MINUS_SRC_ALPHA);
    }
    if (gl->state.subtracts == subtracts) return;
    gl->state.subtracts = subtracts;
    GL(gl, BlendEquation)(subtracts ? GL_FUNC_REVERSE_SUBTRACT : GL_FUNC_ADD);
    GL(gl, DepthFunc)(subtracts ? GL_LESS : GL_LEQUAL);
}

void gn_gl_set_one_depth(struct gn_gl *gl, float depth) {
    if (gl->state.depth == depth) return;
    gl->state.depth = depth;
    GL(gl, DepthRangef)(depth, depth > 0.0f ? depth : 1.0f);
}

void gn_gl_set_cull(struct gn_gl *gl, enum gn_cull cull, bool mirrored) {
    struct gn_gl_state *s = &gl->state;
    enable_cached(gl, GL_CULL_FACE, &s->cull_on, cull != GN_CULL_NONE);
    if (cull != GN_CULL_NONE && s->cull != cull) {
        s->cull = (uint8_t)cull;
        GL(gl, CullFace)(cull == GN_CULL_BACK ? GL_BACK : GL_FRONT);
    }
    if (s->mirrored == mirrored) return;
    s->mirrored = mirrored;
    GL(gl, FrontFace)(mirrored ? GL_CW : GL_CCW);
}

void gn_gl_set_color_write(struct gn_gl *gl, bool write) {
    if (gl->state.color_write == write) return;
    gl->state.color_write = write;
    GL(gl, ColorMask)(write, write, write, write);
}

void gn_gl_set_stencil_writes(struct gn_gl *gl, uint8_t bits) {
    if (gl->state.stencil.writes == bits) return;
    gl->state.stencil.writes = bits;
    GL(gl, StencilMask)(bits);
}

void gn_gl_set_stencil(struct gn_gl *gl, const struct gn_stencil *stencil) {
    struct gn_stencil *s = &gl->state.stencil;
    enable_cached(gl, GL_STENCIL_TEST, &gl->state.stencil_on, stencil->reads || stencil->writes);
    if (!gl->state.stencil_on) return;
    gn_gl_set_stencil_writes(gl, stencil->writes);
    if (s->value == stencil->value && s->reads == stencil->reads) return;
    s->value = stencil->value;
    s->reads = stencil->reads;
    GL(gl, StencilFunc)(GL_EQUAL, s->value, s->reads); /* of no bits: always */
}

void gn_gl_set_clear_color(struct gn_gl *gl, const float rgba[4]) {
    const float *c = gl->state.clear_color;
    if (c[0] == rgba[0] && c[1] == rgba[1] && c[2] == rgba[2] && c[3] == rgba[3]) return;
    memcpy(gl->state.clear_color, rgba, sizeof gl->state.clear_color);
    GL(gl, ClearColor)(rgba[0], rgba[1], rgba[2], rgba[3]);
}

void gn_gl_set_whole(struct gn_gl *gl, uint32_t width, uint32_t height, enum gn_blend blend) {
    gn_gl_set_viewport(gl, (struct gn_gl_rect){0, 0, (GLsizei)width, (GLsizei)height});
    gn_gl_set_scissor(gl, NULL);
    gn_gl_set_depth(gl, false, false);
    gn_gl_set_blend(gl, blend);
    gn_gl_set_cull(gl, GN_CULL_NONE, false);
    gn_gl_set_color_write(gl, true);
    gn_gl_set_stencil(gl, &(struct gn_stencil){0});
}

/* Another gn_gl may have used the context; its bindings ended with its objects. */
void gn_gl_state_init(struct gn_gl *gl) {
    static const GLenum framebuffer_srgb = 0x8DB9; /* desktop GL only: ES always encodes */
    static const GLenum off[] = {GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE,
                                 GL_STENCIL_TEST};
    gl->state = (struct gn_gl_state){
        .depth_write = true, .cull = GN_CULL_BACK, .color_write = true, .stencil = {.writes = 255}};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) GL(gl, Disable)(off[i]);
    GL(gl, DepthMask)(GL_TRUE);
    GL(gl, ColorMask)(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    GL(gl, StencilMask)(255);
    GL(gl, CullFace)(GL_BACK);
    GL(gl, FrontFace)(GL_CCW);
    GL(gl, ClearColor)(0, 0, 0, 0);
    GL(gl, ActiveTexture)(GL_TEXTURE0);
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, 0);
    GL(gl, UseProgram)(0);
    GL(gl, DepthFunc)(GL_LEQUAL);
    GL(gl, DepthRangef)(0, 1);
    GL(gl, BlendEquation)(GL_FUNC_ADD);
    GL(gl, StencilFunc)(GL_EQUAL, 0, 0);
    GL(gl, StencilOp)(GL_KEEP, GL_KEEP, GL_REPLACE);
    GL(gl, BlendFunc)(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (gl->desktop) GL(gl, Enable)(framebuffer_srgb);
}

GLuint gn_gl_object_create(struct gn_gl *gl, enum gn_gl_object kind) {
    GLuint name = 0;
    gl->objects_created++;
    switch (kind) {
    case GN_GL_BUFFER: GL(gl, GenBuffers)(1, &name); break;
    case GN_GL_FRAMEBUFFER: GL(gl, GenFramebuffers)(1, &name); break;
    case GN_GL_RENDERBUFFER: GL(gl, GenRenderbuffers)(1, &name); break;
    case GN_GL_SAMPLER: GL(gl, GenSamplers)(1, &name); break;
    case GN_GL_TEXTURE: GL(gl, GenTextures)(1, &name); break;
    case GN_GL_VERTEX_ARRAY: GL(gl, GenVertexArrays)(1, &name); break;
    }
    return name;
}

GLuint gn_gl_framebuffer_make(struct gn_gl *gl) {
    const GLuint name = gn_gl_object_create(gl, GN_GL_FRAMEBUFFER);
    gn_gl_bind_framebuffer(gl, name);
    return name;
}

GLuint gn_gl_texture_make(struct gn_gl *gl, GLsizei levels, GLenum format, uint32_t width,
                          uint32_t height) {
    const GLuint name = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_work_on_texture(gl, name);
    GL(gl, TexStorage2D)(GL_TEXTURE_2D, levels, format, (GLsizei)width, (GLsizei)height);
    return name;
}

GLuint gn_gl_sampler_make(struct gn_gl *gl, GLint minified, GLint magnified) {
    const GLuint s = gn_gl_object_create(gl, GN_GL_SAMPLER);
    GL(gl, SamplerParameteri)(s, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    GL(gl, SamplerParameteri)(s, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    GL(gl, SamplerParameteri)(s, GL_TEXTURE_MIN_FILTER, minified);
    GL(gl, SamplerParameteri)(s, GL_TEXTURE_MAG_FILTER, magnified);
    return s;
}

void gn_gl_object_destroy(struct gn_gl *gl, enum gn_gl_object kind, GLuint *name) {
    if (!*name) return;
    /* GL unbinds what is deleted; a new object may get the old one's name. */
    struct gn_gl_state *s = &gl->state;
    if (kind == GN_GL_BUFFER && s->array_buffer == *name) s->array_buffer = 0;
    if (kind == GN_GL_FRAMEBUFFER && s->framebuffer == *name) s->framebuffer = 0;
    if (kind == GN_GL_VERTEX_ARRAY && s->vertex_array == *name) s->vertex_array = 0;
    for (int i = 0; i < GN_GL_UNIT_COUNT; i++) {
        if (kind == GN_GL_TEXTURE && s->textures[i] == *name) s->textures[i] = 0;
        if (kind == GN_GL_SAMPLER && s->samplers[i] == *name) s->samplers[i] = 0;
    }
    switch (kind) {
    case GN_GL_BUFFER: GL(gl, DeleteBuffers)(1, name); break;
    case GN_GL_FRAMEBUFFER: GL(gl, DeleteFramebuffers)(1, name); break;
    case GN_GL_RENDERBUFFER: GL(gl, DeleteRenderbuffers)(1, name); break;
    case GN_GL_SAMPLER: GL(gl, DeleteSamplers)(1, name); break;
    case GN_GL_TEXTURE: GL(gl, DeleteTextures)(1, name); break;
    case GN_GL_VERTEX_ARRAY: GL(gl, DeleteVertexArrays)(1, name); break;
    }
    *name = 0;
}
