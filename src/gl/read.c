/* Reading back: pictures, maps, and one pixel to wait until drawing has ended. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "gl/private.h"

static bool has_output(struct gn_gl *gl, struct gn_err *err) {
    if (!gl->targets.output->made) return gn_fail(err, "no picture was drawn yet");
    gn_gl_bind_framebuffer(gl, gn_gl_output_finished(gl->targets.output));
    return true;
}

static void flip_rows(void *pixels, size_t row_bytes, uint32_t rows) {
    uint8_t *top = pixels, *bottom = top + row_bytes * (rows - 1), piece[1024];
    for (; top < bottom; top += row_bytes, bottom -= row_bytes)
        for (size_t at = 0, n; at < row_bytes; at += n) {
            n = row_bytes - at < sizeof piece ? row_bytes - at : sizeof piece;
            memcpy(piece, top + at, n);
            memcpy(top + at, bottom + at, n);
            memcpy(bottom + at, piece, n);
        }
}

/* RGBA of the framebuffer that is bound, first row at the bottom. */
static void read_pixels(struct gn_gl *gl, uint32_t width, uint32_t height, GLenum format,
                        GLenum type, void *out) {
    GL(gl, ReadPixels)(0, 0, (GLsizei)width, (GLsizei)height, format, type, out);
}

bool gn_gl_read_rgba8(struct gn_gl *gl, uint8_t *out, struct gn_err *err) {
    const struct gn_gl_output *o = gl->targets.output;
    const enum gn_output_format format = gn_gl_output_format(o);
    if (!has_output(gl, err)) return false;
    if (format == GN_OUTPUT_FLOAT || format == GN_OUTPUT_AOV)
        return gn_fail(err, "the picture is not 8 bits per channel");
    read_pixels(gl, o->shown_width_px, o->shown_height_px, GL_RGBA, GL_UNSIGNED_BYTE, out);
    flip_rows(out, 4ul * o->shown_width_px, o->shown_height_px);
    return gn_gl_error_check(gl, "reading the picture", err);
}

bool gn_gl_read_xrgb8888(struct gn_gl *gl, uint8_t *out, size_t stride, struct gn_err *err) {
    const struct gn_gl_output *o = gl->targets.output;
    const size_t row = 4ul * o->shown_width_px, size = row * o->shown_height_px;
    if (gl->read_buffer.size < size) {
        gl->read_buffer.data = gn_xrealloc(gl->read_buffer.data, size, 1);
        gl->read_buffer.size = size;
    }
    if (!gn_gl_read_rgba8(gl, gl->read_buffer.data, err)) return false;
    for (uint32_t y = 0; y < o->shown_height_px; y++) {
        const uint8_t *from = gl->read_buffer.data + y * row;
        for (uint8_t *to = out + y * stride, *end = to + row; to < end; to += 4, from += 4) {
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
            to[3] = 255;
        }
    }
    return true;
}

/* A driver with only EXT_color_buffer_half_float may read only half floats. */
void gn_gl_read_floats(struct gn_gl *gl, uint32_t width, uint32_t height, float *out) {
    gn_gl_error_keep(gl); /* an earlier error is not about floats */
    read_pixels(gl, width, height, GL_RGBA, GL_FLOAT, out);
    if (GL(gl, GetError)() == GL_NO_ERROR) return;
    read_pixels(gl, width, height, GL_RGBA, GL_HALF_FLOAT, out);
    /* The halves fill the first half of out: convert them from the end. */
    const uint8_t *halves = (const uint8_t *)out;
    for (size_t i = 4 * (size_t)width * height; i-- > 0;) {
        uint16_t h;
        memcpy(&h, halves + 2 * i, sizeof h);
        const int exponent = h >> 10 & 31;
        const float fraction = (float)(h & 1023);
        float x = exponent ? ldexpf(1024 + fraction, exponent - 25) : ldexpf(fraction, -24);
        if (exponent == 31) x = fraction > 0 ? NAN : INFINITY;
        out[i] = h & 0x8000 ? -x : x;
    }
}

bool gn_gl_read_f32(struct gn_gl *gl, float *out, struct gn_err *err) {
    const struct gn_gl_output *o = gl->targets.output;
    const enum gn_output_format format = gn_gl_output_format(o);
    if (!has_output(gl, err)) return false;
    if (format == GN_OUTPUT_AOV)
        read_pixels(gl, o->shown_width_px, o->shown_height_px, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                    out);
    else if (format == GN_OUTPUT_FLOAT)
        gn_gl_read_floats(gl, o->shown_width_px, o->shown_height_px, out);
    else
        return gn_fail(err, "the picture is not floats");
    flip_rows(out, 4ul * sizeof *out * o->shown_width_px, o->shown_height_px);
    return gn_gl_error_check(gl, "reading the picture", err);
}

/* ---- means ---- */

static bool has_means(const struct gn_gl_output *o, struct gn_err *err) {
    return (o->made && o->gathers) || gn_fail(err, "no mean of pictures is there");
}

bool gn_gl_read_part(struct gn_gl *gl, uint32_t view, float *out, struct gn_err *err) {
    const struct gn_gl_output *o = &gl->targets.outputs[view];
    if (!has_means(o, err)) return false;
    gn_gl_bind_framebuffer(gl, o->means[1]);
    gn_gl_read_floats(gl, o->width_px, o->height_px, out);
    flip_rows(out, 4ul * sizeof *out * o->width_px, o->height_px);
    return gn_gl_error_check(gl, "reading a mean", err);
}

bool gn_gl_give_mean(struct gn_gl *gl, uint32_t view, float *rgba, struct gn_err *err) {
    const struct gn_gl_output *o = &gl->targets.outputs[view];
    if (!has_means(o, err)) return false;
    flip_rows(rgba, 4ul * sizeof *rgba * o->width_px, o->height_px);
    gn_gl_work_on_texture(gl, o->mean_colors[0]);
    GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, 0, 0, 0, (GLsizei)o->width_px, (GLsizei)o->height_px, GL_RGBA, GL_FLOAT, rgba);
    return gn_gl_error_check(gl, "filling a mean", err);
}

/* ---- one pixel ---- */

void gn_gl_finish_frame(struct gn_gl *gl) {
    const struct gn_gl_output *o = gl->targets.output;
    uint32_t pixel[4];
    const enum gn_output_format format = gn_gl_output_format(o);
    if (!o->made) return;
    gn_gl_bind_framebuffer(gl, gn_gl_output_finished(o));
    if (format == GN_OUTPUT_AOV)
        read_pixels(gl, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, pixel);
    else if (format == GN_OUTPUT_FLOAT)
        gn_gl_read_floats(gl, 1, 1, (float *)pixel);
    else
        read_pixels(gl, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
}

void gn_gl_wait(struct gn_gl *gl) {
    GL(gl, Finish)(); /* of maps too, some of which cannot be read */
    gn_gl_finish_frame(gl);
}

/* ---- maps ---- */

/* GLES cannot read depth: a triangle copies it, as it does every other encoding of one number. */
static const char copy_fragment[] =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "uniform highp sampler2D u_map;\n"
    "layout(location = 0) out highp uvec4 o_bits;\n"
    "void main() {\n"
    "    o_bits = floatBitsToUint(texelFetch(u_map, ivec2(gl_FragCoord.xy), 0));\n"
    "}\n";

static bool read_by_copy(struct gn_gl *gl, const struct gn_gl_map *map, uint32_t *rgba,
                         struct gn_err *err) {
    GLuint program = gn_gl_program_link(gl, gn_gl_whole_vertex, copy_fragment, err);
    if (!program) return false;
    GLuint framebuffer = gn_gl_framebuffer_make(gl);
    GLuint color = gn_gl_object_create(gl, GN_GL_RENDERBUFFER);
    GL(gl, BindRenderbuffer)(GL_RENDERBUFFER, color);
    GL(gl, RenderbufferStorage)
    (GL_RENDERBUFFER, GL_RGBA32UI, (GLsizei)map->width_px, (GLsizei)map->height_px);
    GL(gl, FramebufferRenderbuffer)
    (GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    bool ok = gn_gl_framebuffer_check(gl, "copy of a shadow map", err);
    if (ok) {
        GLuint array = gn_gl_object_create(gl, GN_GL_VERTEX_ARRAY);
        gn_gl_bind_vertex_array(gl, array);
        gn_gl_use_program(gl, program);
        const GLint u_map = GL(gl, GetUniformLocation)(program, "u_map");
        GL(gl, Uniform1i)(u_map, GN_GL_UNIT_WORK);
        gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, map->texture,
                           gl->targets.map_samplers[GN_GL_MAP_NEAREST]);
        gn_gl_set_whole(gl, map->width_px, map->height_px, GN_BLEND_OFF);
        GL(gl, DrawArrays)(GL_TRIANGLES, 0, 3);
        gn_gl_object_destroy(gl, GN_GL_VERTEX_ARRAY, &array);
        read_pixels(gl, map->width_px, map->height_px, GL_RGBA_INTEGER, GL_UNSIGNED_INT, rgba);
    }
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &framebuffer);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &color);
    gn_gl_use_program(gl, 0);
    GL(gl, DeleteProgram)(program);
    return ok;
}

bool gn_gl_read_map(struct gn_gl *gl, uint32_t slot, float *out, struct gn_err *err) {
    const struct gn_gl_map *map = gn_gl_map_of_slot(gl, slot);
    if (!map) return gn_fail(err, "no shadow map %u", slot);
    const size_t count = (size_t)map->width_px * map->height_px;
    const bool bytes = map->encoding == GN_ENCODING_RGBA8;
    uint32_t *rgba = gn_xalloc(count, 4 * sizeof *rgba);
    bool ok = true;
    gn_gl_bind_framebuffer(gl, map->framebuffer);
    if (map->encoding == GN_ENCODING_R32UI)
        read_pixels(gl, map->width_px, map->height_px, GL_RGBA_INTEGER, GL_UNSIGNED_INT, rgba);
    else if (bytes)
        read_pixels(gl, map->width_px, map->height_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    else
        ok = read_by_copy(gl, map, rgba, err);
    ok = ok && gn_gl_error_check(gl, "reading a shadow map", err);
    for (size_t i = 0; ok && i < count; i++) {
        /* Most significant byte first, as shaders_es/lib/map_rgba8.glsl packs it. */
        const uint8_t *b = (const uint8_t *)rgba + 4 * i;
        if (bytes)
            out[i] =
                (float)(b[0] / 256.0 + b[1] / 65536.0 + b[2] / 16777216.0 + b[3] / 4294967296.0);
        else
            memcpy(&out[i], &rgba[4 * i], sizeof out[i]);
    }
    free(rgba);
    return ok;
}
