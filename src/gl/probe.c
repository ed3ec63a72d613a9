/* Proof by drawing: known values into 4 x 4 targets, and back. Extension strings are not asked:
 * either of two brings R16F, and some drivers list neither and can, or list one and cannot.
 *
 * The four colour formats are drawn at once, each an output of one program; only if something is
 * wrong with that, each again alone, so that one that fails takes no other with it. */
#include <math.h>
#include <string.h>

#include "gl/private.h"

enum { SIDE = 4 };

static const char vertex[] = "#version 300 es\n"
                             "void main() {\n"
                             "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == "
                             "2 ? 3.0 : -1.0, 0.0, 1.0);\n"
                             "}\n";
static const char formats_fragment[] = "#version 300 es\n"
                                       "precision highp float;\n"
                                       "precision highp int;\n"
                                       "layout(location = 0) out highp vec4 o_r16f;\n"
                                       "layout(location = 1) out highp uvec4 o_r32ui;\n"
                                       "layout(location = 2) out highp vec4 o_rgba16f;\n"
                                       "layout(location = 3) out highp vec4 o_srgb;\n"
                                       "void main() {\n"
                                       "    o_r16f = vec4(0.3330078125, 0.0, 0.0, 1.0);\n"
                                       "    o_r32ui = uvec4(0x41c80001u, 0u, 0u, 1u);\n"
                                       "    o_rgba16f = vec4(1000.0, 0.3330078125, -2.5, 0.5);\n"
                                       "    o_srgb = vec4(0.5, 0.0, 1.0, 1.0);\n"
                                       "}\n";
static const char compare_fragment[] =
    "#version 300 es\n"
    "precision highp float;\n"
    "uniform highp sampler2DShadow u_map;\n"
    "layout(location = 0) out highp vec4 o_color;\n"
    "void main() {\n"
    "    vec2 uv = gl_FragCoord.xy * 0.25;\n"
    "    o_color = vec4(texture(u_map, vec3(uv, 0.5)), texture(u_map, vec3(uv, 0.1)),\n"
    "                   texture(u_map, vec3(uv, 0.9)), 1.0);\n"
    "}\n";

static const struct {
    enum gn_cap cap;
    GLenum format;
    float expected[4]; /* r32ui: unused */
} formats[] = {
    {GN_CAP_R16F, GL_R16F, {0.3330078125f, 0, 0, 1}},
    {GN_CAP_R32UI, GL_R32UI, {0}},
    {GN_CAP_RGBA16F, GL_RGBA16F, {1000, 0.3330078125f, -2.5f, 0.5f}},
    {GN_CAP_SRGB, GL_SRGB8_ALPHA8, {188, 0, 255, 255}},
};
enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

static void begin(struct gn_gl *gl, GLuint program, GLuint framebuffer) {
    gn_gl_bind_framebuffer(gl, framebuffer);
    gn_gl_set_viewport(gl, (struct gn_gl_rect){0, 0, SIDE, SIDE});
    gn_gl_set_scissor(gl, NULL);
    gn_gl_set_depth(gl, false, true);
    gn_gl_set_blend(gl, GN_BLEND_OFF);
    gn_gl_set_cull(gl, GN_CULL_NONE, false);
    gn_gl_use_program(gl, program);
}

static void attach(struct gn_gl *gl, GLenum where, GLuint renderbuffer) {
    GL(gl, FramebufferRenderbuffer)(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, renderbuffer);
}

static bool complete(struct gn_gl *gl) {
    return GL(gl, CheckFramebufferStatus)(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static void drop_errors(struct gn_gl *gl) {
    while (GL(gl, GetError)() != GL_NO_ERROR) continue;
    gl->debug_text[0] = 0;
}

/* ---- colour formats ---- */

static bool read_r32ui(struct gn_gl *gl) {
    GLuint pixel[4] = {0};
    GL(gl, ReadPixels)(1, 1, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, pixel);
    return pixel[0] == 0x41c80001u;
}

static bool read_srgb(struct gn_gl *gl, const float expected[4]) {
    GLubyte pixel[4] = {0};
    GL(gl, ReadPixels)(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    for (int i = 0; i < 4; i++)
        if (fabsf((float)pixel[i] - expected[i]) > 1.5f) return false;
    return true;
}

static bool read_halves(struct gn_gl *gl, int channels, const float expected[4]) {
    float pixel[4] = {0};
    gn_gl_read_floats(gl, 1, 1, pixel);
    for (int i = 0; i < channels; i++)
        if (fabsf(pixel[i] - expected[i]) > 1e-3f * fabsf(expected[i])) return false;
    return true;
}

static bool read_back(struct gn_gl *gl, int i) {
    const float *expected = formats[i].expected;
    drop_errors(gl);
    GL(gl, ReadBuffer)(GL_COLOR_ATTACHMENT0 + (GLenum)i);
    bool right = false;
    switch (formats[i].cap) {
    case GN_CAP_R32UI: right = read_r32ui(gl); break;
    case GN_CAP_SRGB: right = read_srgb(gl, expected); break;
    case GN_CAP_R16F: right = read_halves(gl, 1, expected); break;
    default: right = read_halves(gl, 4, expected); break;
    }
    return right && GL(gl, GetError)() == GL_NO_ERROR;
}

/* Draws to the formats of the mask (a bit per row of `formats`); a mask of those that came back. */
static uint32_t draw_formats(struct gn_gl *gl, GLuint program, uint32_t mask) {
    GLuint framebuffer = gn_gl_object_create(gl, GN_GL_FRAMEBUFFER);
    GLuint colors[FORMAT_COUNT] = {0};
    GLenum buffers[FORMAT_COUNT] = {GL_NONE, GL_NONE, GL_NONE, GL_NONE};
    uint32_t proved = 0;
    begin(gl, program, framebuffer);
    for (int i = 0; i < FORMAT_COUNT; i++) {
        if (!(mask >> i & 1)) continue;
        buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        colors[i] = gn_gl_object_create(gl, GN_GL_RENDERBUFFER);
        GL(gl, BindRenderbuffer)(GL_RENDERBUFFER, colors[i]);
        GL(gl, RenderbufferStorage)(GL_RENDERBUFFER, formats[i].format, SIDE, SIDE);
        attach(gl, buffers[i], colors[i]);
    }
    GL(gl, DrawBuffers)(FORMAT_COUNT, buffers);
    bool drawn = complete(gl);
    if (drawn) GL(gl, DrawArrays)(GL_TRIANGLES, 0, 3);
    for (int i = 0; drawn && i < FORMAT_COUNT; i++)
        if (mask >> i & 1 && read_back(gl, i)) proved |= 1u << i;
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &framebuffer);
    for (int i = 0; i < FORMAT_COUNT; i++) gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &colors[i]);
    drop_errors(gl);
    return proved;
}

static uint32_t probe_formats(struct gn_gl *gl, uint32_t wanted) {
    uint32_t mask = 0, caps = 0;
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (wanted >> formats[i].cap & 1) mask |= 1u << i;
    GLuint program = mask ? gn_gl_program_link(gl, vertex, formats_fragment, NULL) : 0;
    if (!program) return 0;
    uint32_t proved = draw_formats(gl, program, mask);
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (mask & ~proved & 1u << i) proved |= draw_formats(gl, program, 1u << i);
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (proved >> i & 1) caps |= 1u << formats[i].cap;
    gn_gl_use_program(gl, 0);
    GL(gl, DeleteProgram)(program);
    return caps;
}

/* ---- depth compare ---- */

/* The left half holds .25, the right half .75. */
static GLuint make_depth(struct gn_gl *gl, GLuint framebuffer) {
    static const GLenum none = GL_NONE;
    static const float quarter = 0.25f, three_quarters = 0.75f;
    const struct gn_gl_rect left = {0, 0, SIDE / 2, SIDE};
    GLuint depth = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, depth, gl->targets.map_samplers[GN_GL_MAP_COMPARE]);
    GL(gl, TexStorage2D)(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, SIDE, SIDE);
    begin(gl, 0, framebuffer);
    GL(gl, FramebufferTexture2D)(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    GL(gl, DrawBuffers)(1, &none);
    GL(gl, ReadBuffer)(GL_NONE);
    GL(gl, ClearBufferfv)(GL_DEPTH, 0, &three_quarters);
    gn_gl_set_scissor(gl, &left);
    GL(gl, ClearBufferfv)(GL_DEPTH, 0, &quarter);
    gn_gl_set_scissor(gl, NULL);
    return depth;
}

/* 1 where the reference is at most what the texture holds. */
static bool compares(struct gn_gl *gl) {
    GLubyte p[SIDE * SIDE * 4] = {0};
    GL(gl, ReadPixels)(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, p);
    const GLubyte *left = p, *right = p + 4ul * (SIDE - 1);
    return left[0] == 0 && right[0] == 255 && left[1] == 255 && right[1] == 255 && left[2] == 0 &&
           right[2] == 0;
}

static bool probe_compare(struct gn_gl *gl) {
    GLuint program = gn_gl_program_link(gl, vertex, compare_fragment, NULL);
    if (!program) return false;
    GLuint framebuffers[2] = {gn_gl_object_create(gl, GN_GL_FRAMEBUFFER),
                              gn_gl_object_create(gl, GN_GL_FRAMEBUFFER)};
    GLuint depth = make_depth(gl, framebuffers[0]);
    GLuint color = gn_gl_object_create(gl, GN_GL_RENDERBUFFER);
    GL(gl, BindRenderbuffer)(GL_RENDERBUFFER, color);
    GL(gl, RenderbufferStorage)(GL_RENDERBUFFER, GL_RGBA8, SIDE, SIDE);
    begin(gl, program, framebuffers[1]);
    attach(gl, GL_COLOR_ATTACHMENT0, color);
    const GLint u_map = GL(gl, GetUniformLocation)(program, "u_map");
    GL(gl, Uniform1i)(u_map, GN_GL_UNIT_WORK);
    bool right = complete(gl);
    if (right) GL(gl, DrawArrays)(GL_TRIANGLES, 0, 3);
    right = right && compares(gl);
    for (int i = 0; i < 2; i++) gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &framebuffers[i]);
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &depth);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &color);
    gn_gl_use_program(gl, 0);
    GL(gl, DeleteProgram)(program);
    return right && GL(gl, GetError)() == GL_NO_ERROR;
}

/* ---- antialiasing ---- */

static void attach_new(struct gn_gl *gl, GLuint framebuffer, GLuint color, GLsizei samples) {
    gn_gl_bind_framebuffer(gl, framebuffer);
    GL(gl, BindRenderbuffer)(GL_RENDERBUFFER, color);
    GL(gl, RenderbufferStorageMultisample)(GL_RENDERBUFFER, samples, GL_RGBA8, SIDE, SIDE);
    attach(gl, GL_COLOR_ATTACHMENT0, color);
}

static bool resolves(struct gn_gl *gl, const GLuint framebuffers[2]) {
    static const float color[4] = {1, 0, 1, 0};
    GLubyte p[4] = {0};
    gn_gl_bind_framebuffer(gl, framebuffers[0]);
    if (!complete(gl)) return false;
    gn_gl_set_scissor(gl, NULL);
    GL(gl, ClearBufferfv)(GL_COLOR, 0, color);
    GL(gl, BindFramebuffer)(GL_DRAW_FRAMEBUFFER, framebuffers[1]);
    GL(gl, BlitFramebuffer)(0, 0, SIDE, SIDE, 0, 0, SIDE, SIDE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gn_gl_bind_framebuffer(gl, framebuffers[1]);
    GL(gl, ReadPixels)(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
    return p[0] == 255 && p[1] == 0 && p[2] == 255 && p[3] == 0;
}

bool gn_gl_has_samples(struct gn_gl *gl) {
    GLint most = 0;
    GL(gl, GetInternalformativ)(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, GL_SAMPLES, 1, &most);
    return most >= 4;
}

bool gn_gl_probe_msaa(struct gn_gl *gl) {
    if (!gn_gl_has_samples(gl)) return false;
    GLuint framebuffers[2], colors[2];
    for (int i = 0; i < 2; i++) {
        framebuffers[i] = gn_gl_object_create(gl, GN_GL_FRAMEBUFFER);
        colors[i] = gn_gl_object_create(gl, GN_GL_RENDERBUFFER);
        attach_new(gl, framebuffers[i], colors[i], i == 0 ? 4 : 0);
    }
    bool right = resolves(gl, framebuffers) && GL(gl, GetError)() == GL_NO_ERROR;
    for (int i = 0; i < 2; i++) {
        gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &framebuffers[i]);
        gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &colors[i]);
    }
    return right;
}

uint32_t gn_gl_probe(struct gn_gl *gl, uint32_t wanted) {
    GLuint array = gn_gl_object_create(gl, GN_GL_VERTEX_ARRAY);
    gn_gl_bind_vertex_array(gl, array);
    uint32_t proved = probe_formats(gl, wanted);
    if (wanted >> GN_CAP_DEPTH_COMPARE & 1 && probe_compare(gl))
        proved |= 1u << GN_CAP_DEPTH_COMPARE;
    gn_gl_object_destroy(gl, GN_GL_VERTEX_ARRAY, &array);
    drop_errors(gl);
    return proved;
}
