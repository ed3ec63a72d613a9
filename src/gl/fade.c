/* Cross-fades and split screens: a finished picture is kept and laid over later ones. */
#include "gl/private.h"

/* Premultiplied: the kept picture times its share. */
static const char fade_fragment[] = "#version 300 es\n"
                                    "precision mediump float;\n"
                                    "uniform lowp sampler2D u_kept;\n"
                                    "uniform highp vec4 u_share;\n"
                                    "layout(location = 0) out mediump vec4 o_color;\n"
                                    "void main() {\n"
                                    "    o_color = vec4(texelFetch(u_kept, ivec2(gl_FragCoord.xy), "
                                    "0).rgb * u_share.x, u_share.x);\n"
                                    "}\n";

static bool is_srgb(const struct gn_gl_output *o) {
    return gn_gl_output_format(o) == GN_OUTPUT_SRGB8;
}

static bool fits(const struct gn_gl_kept *k, uint32_t width_px, uint32_t height_px, bool srgb) {
    return k->framebuffer && k->width_px == width_px && k->height_px == height_px &&
           k->srgb == srgb;
}

static bool fits_output(const struct gn_gl_kept *k, const struct gn_gl_output *o) {
    return fits(k, o->shown_width_px, o->shown_height_px, is_srgb(o));
}

void gn_gl_kept_finish(struct gn_gl *gl) {
    struct gn_gl_kept *k = &gl->kept;
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &k->framebuffer);
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &k->texture);
    gn_gl_object_destroy(gl, GN_GL_VERTEX_ARRAY, &k->vertices);
    if (k->program && gl->state.program == k->program) gn_gl_use_program(gl, 0);
    if (k->program) GL(gl, DeleteProgram)(k->program);
    *k = (struct gn_gl_kept){0};
}

bool gn_gl_keep_prepare(struct gn_gl *gl, uint32_t width_px, uint32_t height_px,
                        struct gn_err *err) {
    struct gn_gl_kept *k = &gl->kept;
    const struct gn_gl_output *o = gl->targets.output;
    const enum gn_output_format format = gn_gl_output_format(o);
    if (!o->made || (format != GN_OUTPUT_SRGB8 && format != GN_OUTPUT_LINEAR8))
        return gn_fail(err, "the last picture is not 8 bits per channel: cannot keep a copy");
    if (fits(k, width_px, height_px, is_srgb(o))) return true;
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &k->framebuffer);
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &k->texture);
    k->width_px = width_px;
    k->height_px = height_px;
    k->srgb = is_srgb(o);
    k->texture =
        gn_gl_texture_make(gl, 1, k->srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, k->width_px, k->height_px);
    k->framebuffer = gn_gl_framebuffer_make(gl);
    GL(gl, FramebufferTexture2D)
    (GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, k->texture, 0);
    if (!gn_gl_framebuffer_check(gl, "kept picture", err)) return false;
    if (!k->program) {
        k->program = gn_gl_program_link(gl, gn_gl_whole_vertex, fade_fragment, err);
        if (!k->program) return false;
        gn_gl_use_program(gl, k->program);
        const GLint u_kept = GL(gl, GetUniformLocation)(k->program, "u_kept");
        GL(gl, Uniform1i)(u_kept, GN_GL_UNIT_WORK);
        k->u_share = GL(gl, GetUniformLocation)(k->program, "u_share");
        k->vertices = gn_gl_object_create(gl, GN_GL_VERTEX_ARRAY);
    }
    return gn_gl_error_check(gl, "keeping a picture", err);
}

bool gn_gl_keep(struct gn_gl *gl, struct gn_err *err) {
    const struct gn_gl_output *o = gl->targets.output;
    if (!gn_gl_keep_prepare(gl, o->shown_width_px, o->shown_height_px, err)) return false;
    const struct gn_gl_kept *k = &gl->kept;
    const GLuint from = gn_gl_output_finished(o);
    const GLint w = (GLint)k->width_px, h = (GLint)k->height_px;
    gn_gl_set_scissor(gl, NULL);
    gn_gl_bind_framebuffer(gl, from);
    GL(gl, BindFramebuffer)(GL_DRAW_FRAMEBUFFER, k->framebuffer);
    GL(gl, BlitFramebuffer)(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, from); /* as the cache says */
    return gn_gl_error_check(gl, "keeping a picture", err);
}

void gn_gl_lay_over(struct gn_gl *gl, float share) {
    const struct gn_gl_kept *k = &gl->kept;
    const struct gn_gl_output *o = gl->targets.output;
    if (!fits_output(k, o) || !k->program) return;
    gn_gl_bind_framebuffer(gl, gn_gl_output_finished(o));
    gn_gl_set_whole(gl, o->shown_width_px, o->shown_height_px, GN_BLEND_ALPHA);
    gn_gl_use_program(gl, k->program);
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, k->texture,
                       gl->targets.map_samplers[GN_GL_MAP_NEAREST]);
    GL(gl, Uniform4fv)(k->u_share, 1, (const float[4]){share, 0, 0, 0});
    gn_gl_bind_vertex_array(gl, k->vertices);
    GL(gl, DrawArrays)(GL_TRIANGLES, 0, 3);
}

void gn_gl_lay_part(struct gn_gl *gl, const struct gn_rect *part) {
    const struct gn_gl_kept *k = &gl->kept;
    const struct gn_gl_output *o = gl->targets.output;
    const GLuint to = gn_gl_output_finished(o);
    const GLint x = (GLint)part->x, y = (GLint)part->y, right = x + (GLint)part->width,
                top = y + (GLint)part->height;
    if (!fits_output(k, o) || right == x || top == y) return;
    gn_gl_set_scissor(gl, NULL);
    gn_gl_set_color_write(gl, true);
    gn_gl_bind_framebuffer(gl, to);
    GL(gl, BindFramebuffer)(GL_READ_FRAMEBUFFER, k->framebuffer);
    GL(gl, BlitFramebuffer)
    (x, y, right, top, x, y, right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, to); /* as the cache says */
}

void gn_gl_fill(struct gn_gl *gl, const struct gn_rect *part, float grey) {
    const struct gn_gl_rect rect = {(GLint)part->x, (GLint)part->y, (GLsizei)part->width,
                                    (GLsizei)part->height};
    gn_gl_bind_framebuffer(gl, gn_gl_output_finished(gl->targets.output));
    gn_gl_set_scissor(gl, &rect);
    gn_gl_set_color_write(gl, true);
    gn_gl_set_clear_color(gl, (const float[4]){grey, grey, grey, 1});
    GL(gl, Clear)(GL_COLOR_BUFFER_BIT);
    gn_gl_set_scissor(gl, NULL);
}
