/* The target of a pass: what is cleared before it, the state that it draws with, what is copied and
 * invalidated. */
#include <string.h>

#include "gl/private.h"

static void clear_output(struct gn_gl *gl, const struct gn_pass *pass) {
    static const float far_depth = 1.0f;
    const bool stencil = gl->targets.output->stencil;
    if (stencil) gn_gl_set_stencil_writes(gl, 255);
    if (gl->targets.output->format == GN_OUTPUT_AOV) {
        GLuint bits[4];
        memcpy(bits, pass->clear.color, sizeof bits);
        GL(gl, ClearBufferuiv)(GL_COLOR, 0, bits);
        if (stencil)
            GL(gl, ClearBufferfi)(GL_DEPTH_STENCIL, 0, far_depth, 0);
        else
            GL(gl, ClearBufferfv)(GL_DEPTH, 0, &far_depth);
        return;
    }
    gn_gl_set_clear_color(gl, pass->clear.color);
    GL(gl, Clear)
    (GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | (stencil ? GL_STENCIL_BUFFER_BIT : 0u));
}

/* Clears to the light's far end, as an encoded distance. A map that is copied from pages needs no
 * depth. */
static void clear_map(struct gn_gl *gl, const struct gn_pass *pass) {
    static const float ones[4] = {1, 1, 1, 1};
    const float far_code[4] = {pass->clear.color[0], 0, 0, 1};
    GLuint bits[4] = {0, 0, 0, 1};
    memcpy(bits, far_code, sizeof bits[0]);
    switch (pass->target.encoding) {
    case GN_ENCODING_R32UI: GL(gl, ClearBufferuiv)(GL_COLOR, 0, bits); break;
    case GN_ENCODING_RGBA8: GL(gl, ClearBufferfv)(GL_COLOR, 0, ones); break;
    case GN_ENCODING_R16F:
    case GN_ENCODING_R16F_RAW:
    case GN_ENCODING_MEAN: GL(gl, ClearBufferfv)(GL_COLOR, 0, far_code); break;
    case GN_ENCODING_MASK: GL(gl, ClearBufferfv)(GL_COLOR, 0, far_code); return; /* no depth */
    default: break;
    }
    if (pass->kind == GN_PASS_COPY && !gn_encoding_is_depth(pass->target.encoding)) return;
    GL(gl, ClearBufferfv)(GL_DEPTH, 0, ones);
}

static struct gn_gl_rect gl_rect(const struct gn_rect *r) {
    return (struct gn_gl_rect){(GLint)r->x, (GLint)r->y, (GLsizei)r->width, (GLsizei)r->height};
}

void gn_gl_pass_begin(struct gn_gl *gl, const struct gn_pass *pass, GLuint framebuffer,
                      enum gn_clear_area area) {
    static const struct gn_stencil no_stencil = {0};
    const struct gn_pass_picture *picture = pass->kind == GN_PASS_PICTURE ? &pass->picture : NULL;
    const bool only_stencil = picture && picture->only_stencil;
    const GLsizei width = (GLsizei)pass->target.width_px, height = (GLsizei)pass->target.height_px;
    const struct gn_gl_rect viewport = pass->viewport.width > 0
                                           ? gl_rect(&pass->viewport)
                                           : (struct gn_gl_rect){0, 0, width, height};
    gn_gl_bind_framebuffer(gl, framebuffer);
    gn_gl_set_viewport(gl, viewport);
    gn_gl_use_program(gl, 0); /* a clear would hold its samplers against what is bound now */
    if (area != GN_CLEAR_NOTHING) {
        gn_gl_set_scissor(gl, area == GN_CLEAR_RECT ? &viewport : NULL);
        gn_gl_set_depth(gl, true, true);
        gn_gl_set_color_write(gl, true);
        if (picture)
            clear_output(gl, pass);
        else
            clear_map(gl, pass);
    }
    if (pass->clear.stencil_bits) {
        gn_gl_set_scissor(gl, NULL);
        gn_gl_set_stencil_writes(gl, pass->clear.stencil_bits);
        GL(gl, Clear)(GL_STENCIL_BUFFER_BIT);
    }
    const GLint border = pass->kind == GN_PASS_MAP ? (GLint)pass->map.border_px : 0;
    const struct gn_gl_rect inner =
        pass->rect.width > 0
            ? gl_rect(&pass->rect)
            : (struct gn_gl_rect){border, border, width - 2 * border, height - 2 * border};
    gn_gl_set_scissor(gl, pass->rect.width > 0 || border > 0 ? &inner : NULL);
    const bool covers_all = pass->target.kind == GN_TARGET_ENCODED ||
                            pass->kind == GN_PASS_FILTER || (picture && gn_pass_is_mean(pass));
    gn_gl_set_depth(gl, !covers_all && !only_stencil, pass->depth_write);
    gn_gl_set_color_write(gl, !only_stencil);
    gn_gl_set_stencil(gl, picture ? &picture->stencil : &no_stencil);
    const bool subtracts = pass->kind == GN_PASS_MAP && pass->map.point_count > 0;
    const bool blends = pass->kind == GN_PASS_FILTER && pass->filter.blends;
    gn_gl_set_blend(gl, picture     ? picture->blend
                        : subtracts ? GN_BLEND_SUBTRACT
                        : blends    ? GN_BLEND_ALPHA
                                    : GN_BLEND_OFF);
    gn_gl_set_one_depth(gl, 0);
}

void gn_gl_depth_discard(struct gn_gl *gl, const struct gn_pass *pass) {
    static const GLenum attachment[] = {GL_DEPTH_ATTACHMENT, GL_STENCIL_ATTACHMENT};
    static const GLenum window[] = {GL_DEPTH, GL_STENCIL};
    const GLenum *depth = gl->state.framebuffer ? attachment : window;
    const bool stencil = pass->kind == GN_PASS_PICTURE && gl->targets.output->stencil;
    GL(gl, InvalidateFramebuffer)(GL_FRAMEBUFFER, stencil ? 2 : 1, depth);
}

void gn_gl_pages_copy(struct gn_gl *gl, const struct gn_pass *pass) {
    static const GLenum attachments[] = {GL_DEPTH_ATTACHMENT, GL_COLOR_ATTACHMENT0};
    const struct gn_gl_map *pages = gn_gl_target_find(gl, &pass->copy.from);
    const bool is_depth = gn_encoding_is_depth(pass->target.encoding);
    if (!pages) return;
    GL(gl, BindFramebuffer)(GL_READ_FRAMEBUFFER, pages->framebuffer);
    for (uint32_t i = 0; i < pass->copy.count; i++) {
        const struct gn_copy *copy = &pass->copy.copies[i];
        const struct gn_gl_rect from = gl_rect(&copy->from);
        const GLint x = (GLint)copy->to_x, y = (GLint)copy->to_y;
        GL(gl, BlitFramebuffer)
        (from.x, from.y, from.x + from.width, from.y + from.height, x, y, x + from.width,
         y + from.height, is_depth ? GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    GL(gl, InvalidateFramebuffer)(GL_READ_FRAMEBUFFER, is_depth ? 1 : 2, attachments);
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, gl->state.framebuffer); /* as the cache says */
}

/* Copies the picture between framebuffers, to that size; the source is invalidated. */
static void blit_output(struct gn_gl *gl, GLuint from, GLuint to, uint32_t width_px,
                        uint32_t height_px) {
    static const GLenum color = GL_COLOR_ATTACHMENT0;
    const struct gn_gl_output *o = gl->targets.output;
    const bool scales = width_px != o->width_px || height_px != o->height_px;
    gn_gl_set_scissor(gl, NULL);
    gn_gl_bind_framebuffer(gl, from);
    GL(gl, BindFramebuffer)(GL_DRAW_FRAMEBUFFER, to);
    GL(gl, BlitFramebuffer)
    (0, 0, (GLint)o->width_px, (GLint)o->height_px, 0, 0, (GLint)width_px, (GLint)height_px,
     GL_COLOR_BUFFER_BIT, scales ? GL_LINEAR : GL_NEAREST);
    GL(gl, InvalidateFramebuffer)(GL_READ_FRAMEBUFFER, 1, &color);
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, from); /* as the cache says */
}

void gn_gl_output_resolve(struct gn_gl *gl) {
    const struct gn_gl_output *o = gl->targets.output;
    if (o->resolved == o->framebuffer) return;
    blit_output(gl, o->framebuffer, o->resolved, o->width_px, o->height_px);
    if (o->window && !o->encodes && !o->scales)
        blit_output(gl, o->resolved, 0, o->width_px, o->height_px);
}

void gn_gl_output_scale(struct gn_gl *gl) {
    const struct gn_gl_output *o = gl->targets.output;
    gn_gl_set_color_write(gl, true);
    blit_output(gl, o->encodes ? o->encoded : o->resolved, o->scaled, o->shown_width_px,
                o->shown_height_px);
    gn_gl_bind_framebuffer(gl, o->scaled);
}
