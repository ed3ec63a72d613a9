/* The scene's pictures and samplers on the GPU. A picture that is read both as colour and as data
 * is there twice, once a format; equal samplers are there once. */
#include <stdlib.h>

#include "core/arena.h"
#include "gl/private.h"

static bool slot_is_srgb(int slot) {
    return slot == GN_TEXTURE_BASE || slot == GN_TEXTURE_EMISSIVE;
}

/* ---- textures ---- */

/* Makes the copy *image small enough; returns what is to be freed, or NULL. */
static uint8_t *shrink(struct gn_gl *gl, const struct gn_gl_curve *curve, uint32_t index,
                       struct gn_image *image, bool srgb) {
    const uint32_t largest = (uint32_t)gl->caps.max_texture_px;
    const struct gn_image before = *image;
    uint8_t *owned = NULL;
    while (image->width_px > largest || image->height_px > largest) {
        uint8_t *old = owned;
        owned = gn_gl_image_halve(curve, image, srgb);
        free(old);
    }
    if (owned)
        gn_warn(gl->warnings, "image %u: %ux%u pixels are too many for this GPU; shown as %ux%u",
                index, before.width_px, before.height_px, image->width_px, image->height_px);
    return owned;
}

static GLsizei levels_of(const struct gn_image *image) {
    uint32_t side = image->width_px > image->height_px ? image->width_px : image->height_px;
    GLsizei levels = 1;
    for (; side > 1; side /= 2) levels++;
    return levels;
}

static void send_level(struct gn_gl *gl, GLint level, const struct gn_image *image) {
    const GLsizei width = (GLsizei)image->width_px, height = (GLsizei)image->height_px;
    GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, level, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image->rgba);
}

static void make_levels(struct gn_gl *gl, const struct gn_gl_curve *curve, struct gn_image image,
                        bool srgb) {
    if (!gl->caps.software) {
        GL(gl, GenerateMipmap)(GL_TEXTURE_2D);
        return;
    }
    const GLsizei count = levels_of(&image);
    uint8_t *owned = NULL;
    for (GLint level = 1; level < count; level++) {
        uint8_t *before = owned;
        owned = gn_gl_image_halve(curve, &image, srgb);
        free(before);
        send_level(gl, level, &image);
    }
    free(owned);
}

static void upload(struct gn_gl *gl, const struct gn_gl_curve *curve, uint32_t index, bool srgb,
                   bool mipmaps) {
    struct gn_image image = gl->scene.scene->images[index];
    uint8_t *owned = shrink(gl, curve, index, &image, srgb);
    GLuint name = gl->scene.images[srgb][index] = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_bind_texture(gl, GN_GL_UNIT_WORK, name, 0);
    GL(gl, TexStorage2D)
    (GL_TEXTURE_2D, mipmaps ? levels_of(&image) : 1, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8,
     (GLsizei)image.width_px, (GLsizei)image.height_px);
    send_level(gl, 0, &image);
    if (mipmaps) make_levels(gl, curve, image, srgb);
    gl->scene.texture_bytes +=
        (uint64_t)image.width_px * image.height_px * 4 * (mipmaps ? 4 : 3) / 3;
    free(owned);
}

static bool wants_mipmaps(const struct gn_scene *scene, uint32_t image) {
    for (uint32_t i = 0; i < scene->texture_count; i++)
        if (scene->textures[i].image == image && scene->textures[i].mipmaps) return true;
    return false;
}

static void upload_once(struct gn_gl *gl, const struct gn_gl_curve *curve, int32_t texture,
                        bool srgb) {
    if (texture < 0) return;
    uint32_t image = gl->scene.scene->textures[texture].image;
    if (!gl->scene.images[srgb][image])
        upload(gl, curve, image, srgb, wants_mipmaps(gl->scene.scene, image));
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
    struct gn_gl_curve curve;
    s->image_count = s->scene->image_count;
    if (s->image_count) gn_gl_curve_init(&curve);
    for (int i = 0; i < 2; i++)
        s->images[i] = gn_xalloc(s->scene->image_count + 1, sizeof *s->images[i]);
    for (uint32_t i = 0; i < s->scene->material_count; i++)
        for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
            upload_once(gl, &curve, s->scene->materials[i].textures[slot].texture,
                        slot_is_srgb(slot));
    for (uint32_t i = 0; i < s->scene->light_count; i++)
        upload_once(gl, &curve, s->scene->lights[i].slide, true);
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

static void bind(struct gn_gl *gl, GLuint unit, uint32_t texture, bool srgb) {
    const struct gn_gl_scene *s = &gl->scene;
    const struct gn_texture *t = &s->scene->textures[texture];
    gn_gl_bind_texture(gl, unit, s->images[srgb][t->image], s->samplers[sampler_kind(t)]);
}

void gn_gl_texture_bind(struct gn_gl *gl, uint32_t slot, const struct gn_texture_ref *ref) {
    bind(gl, GN_GL_UNIT_TEXTURE + slot, (uint32_t)ref->texture, slot_is_srgb((int)slot));
}

void gn_gl_slide_bind(struct gn_gl *gl, uint32_t slide, uint32_t texture) {
    bind(gl, GN_GL_UNIT_SLIDE + slide, texture, true);
}
