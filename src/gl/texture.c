/* The scene's pictures and samplers on the GPU. A picture that is read both as colour and as data
 * is there twice, once a format; equal samplers are there once. */
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "gl/private.h"

static bool slot_is_srgb(int slot) {
    return slot == GN_TEXTURE_BASE || slot == GN_TEXTURE_EMISSIVE;
}

/* ---- pictures larger than the GPU takes ---- */

static float decode(uint8_t byte, bool srgb) {
    float x = (float)byte / 255;
    if (!srgb) return x;
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

static uint8_t encode(float x, bool srgb) {
    if (srgb) x = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
    return (uint8_t)(x * 255 + 0.5f);
}

/* One channel of the mean of 2 x 2 texels; a last odd row or column is taken twice. */
static uint8_t mean(const struct gn_image *in, uint32_t x, uint32_t y, int channel, bool srgb) {
    bool curved = srgb && channel < 3;
    float sum = 0;
    for (uint32_t j = 0; j < 2; j++)
        for (uint32_t i = 0; i < 2; i++) {
            uint32_t u = 2 * x + i < in->width_px ? 2 * x + i : in->width_px - 1;
            uint32_t v = 2 * y + j < in->height_px ? 2 * y + j : in->height_px - 1;
            sum += decode(in->rgba[4 * ((size_t)v * in->width_px + u) + (size_t)channel], curved);
        }
    return encode(sum / 4, curved);
}

static uint8_t *halve(struct gn_image *image, bool srgb) {
    struct gn_image half = {.width_px = (image->width_px + 1) / 2,
                            .height_px = (image->height_px + 1) / 2};
    uint8_t *out = gn_xalloc((size_t)half.width_px * half.height_px, 4);
    for (uint32_t y = 0; y < half.height_px; y++)
        for (uint32_t x = 0; x < half.width_px; x++)
            for (int c = 0; c < 4; c++)
                out[4 * ((size_t)y * half.width_px + x) + (size_t)c] = mean(image, x, y, c, srgb);
    half.rgba = out;
    *image = half;
    return out;
}

/* Makes the copy *image small enough; returns what is to be freed, or NULL. */
static uint8_t *shrink(struct gn_gl *gl, uint32_t index, struct gn_image *image, bool srgb) {
    const uint32_t largest = (uint32_t)gl->caps.max_texture_px;
    const struct gn_image before = *image;
    uint8_t *owned = NULL;
    while (image->width_px > largest || image->height_px > largest) {
        uint8_t *old = owned;
        owned = halve(image, srgb);
        free(old);
    }
    if (owned)
        gn_warn(gl->warnings, "image %u: %ux%u pixels are too many for this GPU; shown as %ux%u",
                index, before.width_px, before.height_px, image->width_px, image->height_px);
    return owned;
}

/* ---- textures ---- */

static GLsizei levels_of(const struct gn_image *image) {
    uint32_t side = image->width_px > image->height_px ? image->width_px : image->height_px;
    GLsizei levels = 1;
    for (; side > 1; side /= 2) levels++;
    return levels;
}

static void upload(struct gn_gl *gl, uint32_t index, bool srgb, bool mipmaps) {
    struct gn_image image = gl->scene.scene->images[index];
    uint8_t *owned = shrink(gl, index, &image, srgb);
    const GLsizei width = (GLsizei)image.width_px, height = (GLsizei)image.height_px;
    GLuint name = gl->scene.images[srgb][index] = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, name, 0);
    GL(gl, TexStorage2D)
    (GL_TEXTURE_2D, mipmaps ? levels_of(&image) : 1, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, width,
     height);
    GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba);
    if (mipmaps) GL(gl, GenerateMipmap)(GL_TEXTURE_2D);
    gl->scene.texture_bytes += (uint64_t)width * (uint64_t)height * 4 * (mipmaps ? 4 : 3) / 3;
    free(owned);
}

static bool wants_mipmaps(const struct gn_scene *scene, uint32_t image) {
    for (uint32_t i = 0; i < scene->texture_count; i++)
        if (scene->textures[i].image == image && scene->textures[i].mipmaps) return true;
    return false;
}

static void upload_once(struct gn_gl *gl, const struct gn_texture_ref *ref, bool srgb) {
    if (ref->texture < 0) return;
    uint32_t image = gl->scene.scene->textures[ref->texture].image;
    if (!gl->scene.images[srgb][image])
        upload(gl, image, srgb, wants_mipmaps(gl->scene.scene, image));
}

/* ---- samplers ---- */

static uint32_t sampler_kind(const struct gn_texture *t) {
    uint32_t kind = (uint32_t)t->wrap_s * 3 + (uint32_t)t->wrap_t;
    return kind * 16 + t->mag_nearest * 8u + t->min_nearest * 4u + t->mipmaps * 2u + t->mip_nearest;
}
_Static_assert(GN_GL_SAMPLER_KINDS == 3 * 3 * 16, "two wraps of three, four switches");

static GLint min_filter(const struct gn_texture *t) {
    if (!t->mipmaps) return t->min_nearest ? GL_NEAREST : GL_LINEAR;
    if (t->mip_nearest)
        return t->min_nearest ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_NEAREST;
    return t->min_nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR;
}

static void make_sampler(struct gn_gl *gl, const struct gn_texture *t) {
    static const GLint wraps[] = {
        [GN_WRAP_REPEAT] = GL_REPEAT,
        [GN_WRAP_CLAMP] = GL_CLAMP_TO_EDGE,
        [GN_WRAP_MIRROR] = GL_MIRRORED_REPEAT,
    };
    GLuint *sampler = &gl->scene.samplers[sampler_kind(t)];
    if (*sampler) return;
    *sampler = gn_gl_object_create(gl, GN_GL_SAMPLER);
    GL(gl, SamplerParameteri)(*sampler, GL_TEXTURE_WRAP_S, wraps[t->wrap_s]);
    GL(gl, SamplerParameteri)(*sampler, GL_TEXTURE_WRAP_T, wraps[t->wrap_t]);
    GL(gl, SamplerParameteri)(*sampler, GL_TEXTURE_MIN_FILTER, min_filter(t));
    GL(gl, SamplerParameteri)
    (*sampler, GL_TEXTURE_MAG_FILTER, t->mag_nearest ? GL_NEAREST : GL_LINEAR);
}

/* ---- all of them ---- */

bool gn_gl_textures_upload(struct gn_gl *gl, struct gn_err *err) {
    struct gn_gl_scene *s = &gl->scene;
    s->image_count = s->scene->image_count;
    for (int i = 0; i < 2; i++)
        s->images[i] = gn_xalloc(s->scene->image_count + 1, sizeof *s->images[i]);
    for (uint32_t i = 0; i < s->scene->material_count; i++)
        for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
            upload_once(gl, &s->scene->materials[i].textures[slot], slot_is_srgb(slot));
    for (uint32_t i = 0; i < s->scene->texture_count; i++) make_sampler(gl, &s->scene->textures[i]);
    return gn_gl_error_check(gl, "uploading the pictures", err);
}

void gn_gl_textures_finish(struct gn_gl *gl) {
    struct gn_gl_scene *s = &gl->scene;
    for (int i = 0; i < 2; i++) {
        for (uint32_t k = 0; s->images[i] && k < s->image_count; k++)
            gn_gl_object_destroy(gl, GN_GL_TEXTURE, &s->images[i][k]);
        free(s->images[i]);
        s->images[i] = NULL;
    }
    for (int i = 0; i < GN_GL_SAMPLER_KINDS; i++)
        gn_gl_object_destroy(gl, GN_GL_SAMPLER, &s->samplers[i]);
}

void gn_gl_texture_bind(struct gn_gl *gl, uint32_t slot, const struct gn_texture_ref *ref) {
    const struct gn_gl_scene *s = &gl->scene;
    const struct gn_texture *t = &s->scene->textures[ref->texture];
    gn_gl_bind_texture(gl, GN_GL_UNIT_TEXTURE + slot, s->images[slot_is_srgb((int)slot)][t->image],
                       s->samplers[sampler_kind(t)]);
}
