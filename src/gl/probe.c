/* Proof by drawing: known values into 4 x 4 targets, and back. Extension strings are not read:
 * either of two brings R16F, and some drivers list neither and can, or list one and cannot.
 *
 * All capabilities wanted are drawn at once, each an output of one program, since with a software
 * driver a program is the most expensive part; only if one of them fails, each is drawn again
 * alone, so that it makes no other fail. */
#include <math.h>
#include <string.h>

#include "gl/private.h"

enum { SIDE = 4, OUTPUTS_MAX = 4 /* at once: ES 3.0 promises as many */ };

static const char fragment_head[] = "#version 300 es\n"
                                    "precision highp float;\n"
                                    "precision highp int;\n"
                                    "uniform highp sampler2DShadow u_map;\n"
                                    "#define LIT(depth) texture(u_map, vec3(0.5, 0.5, depth))\n";

enum kind { BYTES, HALVES, INTEGERS }; /* how a target is read back */

/* What one capability is proved by. */
static const struct row {
    enum gn_cap cap;
    GLenum format;
    enum kind kind;
    int channels;
    const char *value;  /* of its output */
    double expected[4]; /* as read back: halves as they are, bytes 0..255 */
} rows[] = {
#define ROW(NAME, kind, channels, value, ...)                                                      \
    {                                                                                              \
        GN_CAP_##NAME, GL_##NAME, kind, channels, value, { __VA_ARGS__ }                           \
    }
    ROW(R16F, HALVES, 1, "0.3330078125, 0.0, 0.0, 1.0", 0.3330078125),
    ROW(R32UI, INTEGERS, 1, "0x41c80001u, 0u, 0u, 1u", 0x41c80001u),
    ROW(RGBA16F, HALVES, 4, "1000.0, 0.3330078125, -2.5, 0.5", 1000, 0.3330078125, -2.5, 0.5),
    ROW(RGBA16UI, INTEGERS, 4, "65535u, 1u, 0x1234u, 0x8000u", 65535, 1, 0x1234, 0x8000),
    ROW(RG32UI, INTEGERS, 2, "0x41c80000u, 0x7f000000u, 0u, 1u", 0x41c80000u, 0x7f000000u),
    ROW(RGBA32UI, INTEGERS, 4, "0x41c80000u, 0xff000000u, 0x7f000000u, 1u", 0x41c80000u,
        0xff000000u, 0x7f000000u, 1),
    ROW(RG16F, HALVES, 2, "60000.0, -0.3330078125, 0.0, 1.0", 60000, -0.3330078125),
#undef ROW
    {GN_CAP_SRGB, GL_SRGB8_ALPHA8, BYTES, 4, "0.5, 0.0, 1.0, 1.0", {188, 0, 255, 255}},
    /* the texture holds .5; lit where the reference is at most that */
    {GN_CAP_DEPTH_COMPARE,
     GL_RGBA8,
     BYTES,
     4,
     "LIT(0.25), LIT(0.75), LIT(0.45), LIT(0.55)",
     {255, 0, 255, 0}},
};
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

static uint32_t rows_of(uint32_t caps) {
    uint32_t mask = 0;
    for (int i = 0; i < ROW_COUNT; i++)
        if (caps >> rows[i].cap & 1) mask |= 1u << i;
    return mask;
}

static uint32_t caps_of(uint32_t mask) {
    uint32_t caps = 0;
    for (int i = 0; i < ROW_COUNT; i++)
        if (mask >> i & 1) caps |= 1u << rows[i].cap;
    return caps;
}

static bool is_complete(struct gn_gl *gl) {
    return GL(gl, CheckFramebufferStatus)(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static void drop_errors(struct gn_gl *gl) {
    while (GL(gl, GetError)() != GL_NO_ERROR) continue;
    gl->debug.text[0] = 0;
}

/* A renderbuffer of its own on the framebuffer that is bound. */
static GLuint attach_new(struct gn_gl *gl, GLenum where, GLenum format, GLsizei samples) {
    GLuint color = gn_gl_object_create(gl, GN_GL_RENDERBUFFER);
    GL(gl, BindRenderbuffer)(GL_RENDERBUFFER, color);
    GL(gl, RenderbufferStorageMultisample)(GL_RENDERBUFFER, samples, format, SIDE, SIDE);
    GL(gl, FramebufferRenderbuffer)(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, color);
    return color;
}

/* ---- what comes back ---- */

static bool read_back(struct gn_gl *gl, const struct row *row, GLenum attachment) {
    GLuint integers[4] = {0};
    GLubyte bytes[4] = {1, 1, 1, 1};
    float halves[4] = {0};
    bool right = true;
    drop_errors(gl);
    GL(gl, ReadBuffer)(attachment);
    switch (row->kind) {
    case INTEGERS:
        GL(gl, ReadPixels)(1, 1, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, integers);
        break;
    case HALVES: gn_gl_read_floats(gl, 1, 1, halves); break;
    case BYTES: GL(gl, ReadPixels)(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes); break;
    }
    for (int i = 0; i < row->channels; i++) {
        const double expected = row->expected[i];
        right &= row->kind == INTEGERS ? integers[i] == (GLuint)expected
                 : row->kind == HALVES ? fabs((double)halves[i] - expected) <= 1e-3 * fabs(expected)
                                       : fabs(bytes[i] - expected) <= 1.5;
    }
    return right && GL(gl, GetError)() == GL_NO_ERROR;
}

/* ---- drawing ---- */

struct proof { /* of the rows of a mask; the n-th of them is color attachment n */
    uint32_t mask;
    GLuint program, framebuffer, colors[OUTPUTS_MAX];
    GLuint depth_framebuffer, depth; /* what is compared with */
};

static const char *type_of(const struct row *row) {
    return row->kind == INTEGERS ? "uvec4" : "vec4";
}

static void make_proof_program(struct gn_gl *gl, struct proof *proof) {
    struct gn_gl_text text = {0};
    int output = 0;
    gn_gl_text_add(&text, "%s", fragment_head);
    for (int i = 0; i < ROW_COUNT; i++)
        if (proof->mask >> i & 1)
            gn_gl_text_add(&text, "layout(location = %d) out highp %s o_%d;\n", output++,
                           type_of(&rows[i]), i);
    gn_gl_text_add(&text, "void main() {\n");
    for (int i = 0; i < ROW_COUNT; i++)
        if (proof->mask >> i & 1)
            gn_gl_text_add(&text, "    o_%d = %s(%s);\n", i, type_of(&rows[i]), rows[i].value);
    gn_gl_text_add(&text, "}\n");
    proof->program = gn_gl_program_link(gl, gn_gl_whole_vertex, text.data, NULL);
    gn_gl_text_finish(&text);
}

/* Cleared without a scissor: with one, software drivers compile a program for it. */
static void make_depth(struct gn_gl *gl, struct proof *proof) {
    static const GLenum none = GL_NONE;
    static const float half = 0.5f;
    proof->depth = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, proof->depth,
                       gl->targets.map_samplers[GN_GL_MAP_COMPARE]);
    GL(gl, TexStorage2D)(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, SIDE, SIDE);
    proof->depth_framebuffer = gn_gl_framebuffer_make(gl);
    GL(gl, FramebufferTexture2D)
    (GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, proof->depth, 0);
    GL(gl, DrawBuffers)(1, &none);
    GL(gl, ReadBuffer)(GL_NONE);
    gn_gl_set_depth(gl, false, true);
    GL(gl, ClearBufferfv)(GL_DEPTH, 0, &half);
}

/* Of at most OUTPUTS_MAX rows, those that are read back as they were drawn. */
static uint32_t prove_at_once(struct gn_gl *gl, uint32_t mask) {
    struct proof proof = {.mask = mask};
    make_proof_program(gl, &proof);
    if (!proof.program) return 0;
    gn_gl_set_whole(gl, SIDE, SIDE, GN_BLEND_OFF);
    if (mask & rows_of(1u << GN_CAP_DEPTH_COMPARE)) make_depth(gl, &proof);
    GLenum buffers[OUTPUTS_MAX];
    GLsizei count = 0;
    proof.framebuffer = gn_gl_framebuffer_make(gl);
    for (int i = 0; i < ROW_COUNT; i++) {
        if (!(mask >> i & 1)) continue;
        buffers[count] = GL_COLOR_ATTACHMENT0 + (GLenum)count;
        proof.colors[count] = attach_new(gl, buffers[count], rows[i].format, 0);
        count++;
    }
    GL(gl, DrawBuffers)(count, buffers);
    uint32_t proved = 0;
    if (is_complete(gl)) {
        GLenum attachment = GL_COLOR_ATTACHMENT0;
        gn_gl_use_program(gl, proof.program);
        const GLint u_map = GL(gl, GetUniformLocation)(proof.program, "u_map");
        if (u_map >= 0) GL(gl, Uniform1i)(u_map, GN_GL_UNIT_WORK);
        GL(gl, DrawArrays)(GL_TRIANGLES, 0, 3);
        for (int i = 0; i < ROW_COUNT; i++)
            if (mask >> i & 1 && read_back(gl, &rows[i], attachment++)) proved |= 1u << i;
    }
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &proof.framebuffer);
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &proof.depth_framebuffer);
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &proof.depth);
    for (int i = 0; i < OUTPUTS_MAX; i++)
        gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &proof.colors[i]);
    gn_gl_use_program(gl, 0);
    GL(gl, DeleteProgram)(proof.program);
    drop_errors(gl);
    return proved;
}

/* ---- antialiasing ---- */

static bool prove_samples(struct gn_gl *gl) {
    static const float color[4] = {1, 0, 1, 0};
    GLuint framebuffers[2], colors[2];
    for (int i = 0; i < 2; i++) {
        framebuffers[i] = gn_gl_framebuffer_make(gl);
        colors[i] = attach_new(gl, GL_COLOR_ATTACHMENT0, GL_RGBA8, i == 0 ? 4 : 0);
    }
    bool right = false;
    gn_gl_bind_framebuffer(gl, framebuffers[0]);
    if (is_complete(gl)) {
        gn_gl_set_scissor(gl, NULL);
        gn_gl_set_color_write(gl, true);
        GL(gl, ClearBufferfv)(GL_COLOR, 0, color);
        GL(gl, BindFramebuffer)(GL_DRAW_FRAMEBUFFER, framebuffers[1]);
        GL(gl, BlitFramebuffer)
        (0, 0, SIDE, SIDE, 0, 0, SIDE, SIDE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        gn_gl_bind_framebuffer(gl, framebuffers[1]);
        GLubyte p[4] = {0};
        GL(gl, ReadPixels)(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
        right = p[0] == 255 && p[1] == 0 && p[2] == 255 && p[3] == 0 &&
                GL(gl, GetError)() == GL_NO_ERROR;
    }
    for (int i = 0; i < 2; i++) {
        gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &framebuffers[i]);
        gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &colors[i]);
    }
    drop_errors(gl);
    return right;
}

/* ---- all of them ---- */

uint32_t gn_gl_probe_claims(struct gn_gl *gl) {
    uint32_t mask = 0;
    for (int i = 0; i < ROW_COUNT; i++) {
        GLuint framebuffer = gn_gl_framebuffer_make(gl);
        GLuint color = attach_new(gl, GL_COLOR_ATTACHMENT0, rows[i].format, 0);
        if (is_complete(gl)) mask |= 1u << i;
        gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &framebuffer);
        gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &color);
    }
    GLint most_samples = 0;
    GL(gl, GetInternalformativ)(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, GL_SAMPLES, 1, &most_samples);
    drop_errors(gl);
    return caps_of(mask) | (most_samples >= 4 ? 1u << GN_CAP_MSAA4 : 0);
}

uint32_t gn_gl_probe(struct gn_gl *gl, uint32_t wanted) {
    GLuint array = gn_gl_object_create(gl, GN_GL_VERTEX_ARRAY);
    gn_gl_bind_vertex_array(gl, array);
    uint32_t left = rows_of(wanted), right = 0;
    while (left) {
        uint32_t batch = 0; /* the first rows left, as many as one program outputs */
        for (int i = 0; i < OUTPUTS_MAX; i++) batch |= (left & ~batch) & -(left & ~batch);
        right |= prove_at_once(gl, batch);
        for (int i = 0; i < ROW_COUNT; i++)
            if (batch & ~right & 1u << i && batch != 1u << i) right |= prove_at_once(gl, 1u << i);
        left &= ~batch;
    }
    gn_gl_object_destroy(gl, GN_GL_VERTEX_ARRAY, &array);
    uint32_t proved = caps_of(right);
    if (wanted >> GN_CAP_MSAA4 & 1 && prove_samples(gl)) proved |= 1u << GN_CAP_MSAA4;
    return proved;
}
