/* The scene's pictures and samplers on the GPU. A picture that is read both as colour and as data
 * has two textures, one per format; equal samplers are made once. */
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "gl/private.h"

static enum gn_gl_texels texels_of(const struct gn_scene *scene, const struct gn_material *material,
                                   uint32_t slot) {
    const int cutoff = gn_scene_find_cutoff(scene, material, slot);
    if (cutoff >= 0) return GN_GL_MASK + (enum gn_gl_texels)cutoff;
    return gn_texture_slots[slot].texels == GN_TEXELS_SRGB ? GN_GL_COLOR : GN_GL_DATA;
}

/* ---- textures ---- */

static void close_picture(struct gn_gl_picture *p) {
    free(p->owned);
    free(p->half_owned);
    *p = (struct gn_gl_picture){0};
}

/* A few rows of a mask's level, with the alpha that it gets there. */
static void send_mask_rows(struct gn_gl *gl, const struct gn_image *level, uint32_t count) {
    struct gn_gl_picture *p = &gl->scene.upload.picture;
    uint8_t *rows = malloc(4ul * count * level->width_px);
    gl->scene.upload.no_memory = !rows;
    if (!rows) return;
    gn_gl_image_mask_rows(gl->scene.upload.curve, level, p->row, count, p->alpha, rows);
    GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, p->level, 0, (GLint)p->row, (GLsizei)level->width_px, (GLsizei)count, GL_RGBA,
     GL_UNSIGNED_BYTE, rows);
    free(rows);
}

static struct gn_coverage_level level_of(const struct gn_image *image, const uint8_t *alpha) {
    return (struct gn_coverage_level){
        .rgba = image->rgba, .px = {image->width_px, image->height_px}, .alpha = alpha};
}

static void fit_mask(struct gn_gl_picture *p, bool halved) {
    uint8_t before[256];
    memcpy(before, p->alpha, sizeof before);
    const struct gn_coverage_level larger = level_of(&p->image, p->fitted ? before : NULL),
                                   level = level_of(halved ? &p->half : &p->image, NULL);
    const bool mixed = halved && p->level + 1 < p->levels; /* the last one is seen alone */
    gn_coverage_fit(&p->cover, mixed ? &larger : NULL, &level, p->alpha);
    p->fitted = true;
}

/* Uploads some rows of the open picture; returns their bytes. Where mipmaps by the driver are slow,
 * or would take longer than a frame, they are made here, a few rows at a time. */
static size_t send_rows(struct gn_gl *gl, size_t bytes) {
    struct gn_gl_picture *p = &gl->scene.upload.picture;
    const struct gn_image *level = p->level > 0 ? &p->half : &p->image;
    const size_t row = (p->level > 0 ? 16ul : 4ul) * level->width_px; /* a half reads four times */
    const size_t most = bytes / row > 0 ? bytes / row : 1;
    const bool mask = p->texels >= GN_GL_MASK,
               halves = p->level > 0 && p->halved < level->height_px;
    const uint32_t done = halves ? p->halved : p->row, left = level->height_px - done,
                   count = most < left ? (uint32_t)most : left;
    if (halves) {
        gn_gl_image_halve_rows(gl->scene.upload.curve, &p->image, done, count, p->texels,
                               p->half_owned);
        p->halved += count;
        if (mask && p->halved == level->height_px) fit_mask(p, true);
        if (mask) return count * row;
    }
    if (mask && p->fitted)
        send_mask_rows(gl, level, count);
    else
        GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, p->level, 0, (GLint)p->row, (GLsizei)level->width_px, (GLsizei)count, GL_RGBA,
     GL_UNSIGNED_BYTE, level->rgba + 4ul * p->row * level->width_px);
    p->row += count;
    if (p->row < level->height_px) return count * row;
    const bool driver_is_slow =
        gl->caps.software || 4ul * p->image.width_px * p->image.height_px > bytes;
    if (p->level == 0 && p->mipmaps && !driver_is_slow && !mask) {
        GL(gl, GenerateMipmap)(GL_TEXTURE_2D);
        p->levels = 1;
    }

    /* the next smaller level, or none */
    if (p->level > 0) {
        free(p->owned);
        p->owned = p->half_owned;
        p->image = p->half;
        p->half_owned = NULL;
    }
    p->row = p->halved = 0;
    if (++p->level < p->levels) {
        p->half = gn_gl_image_half(&p->image);
        p->half_owned = malloc(4ul * p->half.width_px * p->half.height_px);
        p->half.rgba = p->half_owned;
        gl->scene.upload.no_memory = !p->half_owned;
    }
    if (!p->half_owned) close_picture(p);
    return count * row;
}

/* ---- samplers ---- */

static uint32_t sampler_kind(const struct gn_texture *t) {
    uint32_t kind = (uint32_t)t->wrap_s * 3 + (uint32_t)t->wrap_t;
    return kind * 16 + t->mag_nearest * 8u + t->min_nearest * 4u + t->mipmaps * 2u + t->mip_nearest;
}
_Static_assert(GN_GL_SAMPLER_KINDS == 3 * 3 * 16, "two wraps of three, four switches");

static void make_sampler(struct gn_gl *gl, const struct gn_texture *t) {
    static const GLint wraps[] = {
        [GN_WRAP_REPEAT] = GL_REPEAT,
        [GN_WRAP_CLAMP] = GL_CLAMP_TO_EDGE,
        [GN_WRAP_MIRROR] = GL_MIRRORED_REPEAT,
    };
    static const GLint plain[2] = {GL_LINEAR, GL_NEAREST};
    static const GLint mipmapped[2][2] = {
        /* by mip_nearest, then min_nearest */
        {GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST_MIPMAP_LINEAR},
        {GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_NEAREST},
    };
    GLuint *sampler = &gl->scene.samplers[sampler_kind(t)];
    if (*sampler) return;
    *sampler = gn_gl_sampler_make(
        gl, t->mipmaps ? mipmapped[t->mip_nearest][t->min_nearest] : plain[t->min_nearest],
        plain[t->mag_nearest]);
    GL(gl, SamplerParameteri)(*sampler, GL_TEXTURE_WRAP_S, wraps[t->wrap_s]);
    GL(gl, SamplerParameteri)(*sampler, GL_TEXTURE_WRAP_T, wraps[t->wrap_t]);
}

/* ---- all of them ---- */

/* A texture costs as much time as so many bytes, however small its picture is. */
enum { PICTURE_BYTES = 16 << 10, LEAST_MASK_PX = 16 };

/* The uses of pictures, by number: slots of materials, then lights' slides. */
static bool use_of(const struct gn_scene *scene, uint32_t use, int32_t *texture,
                   enum gn_gl_texels *texels) {
    const uint32_t slots = scene->material_count * GN_TEXTURE_SLOT_COUNT;
    const uint32_t slot = use % GN_TEXTURE_SLOT_COUNT;
    if (use >= slots + scene->light_count) return false;
    if (use >= slots) {
        *texels = GN_GL_COLOR;
        *texture = scene->lights[use - slots].slide;
        return true;
    }
    const struct gn_material *material = &scene->materials[use / GN_TEXTURE_SLOT_COUNT];
    *texels = texels_of(scene, material, slot);
    *texture = material->textures[slot].texture;
    return true;
}

/* Opens the picture of the next use that has no texture yet; false: there is none. */
static bool open_next_picture(struct gn_gl *gl) {
    struct gn_gl_scene *s = &gl->scene;
    const struct gn_scene_pictures *pictures = &s->scene->pictures;
    uint32_t index;
    int32_t texture;
    enum gn_gl_texels texels;
    for (;; s->upload.first++) {
        if (!use_of(s->scene, s->upload.first, &texture, &texels)) return false;
        if (texture < 0) continue;
        index = pictures->textures[texture].image;
        if (!s->images[texels][index]) break;
    }
    struct gn_gl_picture *p = &s->upload.picture;
    *p = (struct gn_gl_picture){.image = pictures->images[index], .texels = texels, .open = true};

    s->images[texels][index] = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_work_on_texture(gl, s->images[texels][index]);
    if (p->image.levels && gn_gl_levels_open(gl, index)) return true;

    if (texels >= GN_GL_MASK) {
        const struct gn_coverage_level picture = level_of(&p->image, NULL);
        p->cover = gn_coverage_measure(p->image.cutoffs[texels - GN_GL_MASK], &picture);
    }

    /* halved until it fits the GPU */
    const struct gn_image *whole = &pictures->images[index];
    const uint32_t largest = (uint32_t)gl->caps.max_texture_px;
    while (p->image.width_px > largest || p->image.height_px > largest) {
        uint8_t *old = p->owned;
        p->owned = gn_gl_image_halve(s->upload.curve, &p->image, texels);
        free(old);
        if (!p->owned) {
            s->upload.no_memory = true;
            close_picture(p);
            return false;
        }
    }
    if (p->owned)
        gn_warn(gl->warnings,
                "image %u: %ux%u pixels exceed the texture size of this GPU; reduced to %ux%u",
                index, whole->width_px, whole->height_px, p->image.width_px, p->image.height_px);

    if (texels >= GN_GL_MASK && p->owned) fit_mask(p, false);
    p->mipmaps = p->image.mipmaps;
    const uint32_t width = p->image.width_px, height = p->image.height_px;
    /* a mask of a few texels would be whole, or empty: it is sampled sparsely instead */
    const uint32_t shorter = width < height ? width : height,
                   longer = width > height ? width : height;
    const uint32_t side = texels >= GN_GL_MASK ? shorter / LEAST_MASK_PX : longer;
    p->levels = 1;
    while (p->mipmaps && side >> p->levels > 0) p->levels++;
    GL(gl, TexStorage2D)
    (GL_TEXTURE_2D, p->levels, texels == GN_GL_DATA ? GL_RGBA8 : GL_SRGB8_ALPHA8, (GLsizei)width,
     (GLsizei)height);
    s->texture_bytes += (uint64_t)width * height * 4 * (p->mipmaps ? 4 : 3) / 3;
    return true;
}

bool gn_gl_textures_step(struct gn_gl *gl, size_t bytes) {
    struct gn_gl_scene *s = &gl->scene;
    struct gn_gl_picture *p = &s->upload.picture;
    size_t sent = 0;
    if (!s->images[0]) {
        s->image_count = s->scene->pictures.image_count;
        for (int i = 0; i < GN_GL_TEXELS_COUNT; i++)
            s->images[i] = gn_xalloc(s->image_count + 1, sizeof *s->images[i]);
        if (s->image_count > 0) {
            s->upload.curve = gn_xalloc(1, sizeof *s->upload.curve);
            gn_gl_curve_init(s->upload.curve);
        }
    }
    while (sent < bytes && !s->upload.no_memory) {
        int32_t texture = 0;
        enum gn_gl_texels texels = GN_GL_DATA;
        if (!p->open && !open_next_picture(gl)) break;
        if (p->level == 0 && p->row == 0) sent += PICTURE_BYTES;
        use_of(s->scene, s->upload.first, &texture, &texels);
        gn_gl_work_on_texture(gl, s->images[texels][s->scene->pictures.textures[texture].image]);
        const size_t left = sent < bytes ? bytes - sent : 1;
        sent += p->image.levels ? gn_gl_levels_send(gl, left) : send_rows(gl, left);
    }
    if (p->open || sent >= bytes) return false;
    for (uint32_t i = 0; i < s->scene->pictures.texture_count; i++)
        make_sampler(gl, &s->scene->pictures.textures[i]);
    free(s->upload.curve);
    s->upload.curve = NULL;
    return true;
}

void gn_gl_textures_finish(struct gn_gl *gl) {
    struct gn_gl_scene *s = &gl->scene;
    close_picture(&s->upload.picture);
    free(s->upload.curve);
    s->upload.curve = NULL;
    for (int i = 0; i < GN_GL_TEXELS_COUNT; i++) {
        for (uint32_t k = 0; s->images[i] && k < s->image_count; k++)
            gn_gl_object_destroy(gl, GN_GL_TEXTURE, &s->images[i][k]);
        free(s->images[i]);
        s->images[i] = NULL;
    }
    for (int i = 0; i < GN_GL_SAMPLER_KINDS; i++)
        gn_gl_object_destroy(gl, GN_GL_SAMPLER, &s->samplers[i]);
}

static void bind_texture(struct gn_gl *gl, GLuint unit, uint32_t texture,
                         enum gn_gl_texels texels) {
    const struct gn_gl_scene *s = &gl->scene;
    const struct gn_texture *t = &s->scene->pictures.textures[texture];
    gn_gl_bind_texture(gl, unit, s->images[texels][t->image], s->samplers[sampler_kind(t)]);
}

void gn_gl_texture_bind(struct gn_gl *gl, const struct gn_material *material, uint32_t slot) {
    bind_texture(gl, GN_GL_UNIT_TEXTURE + slot, (uint32_t)material->textures[slot].texture,
                 texels_of(gl->scene.scene, material, slot));
}

void gn_gl_slide_bind(struct gn_gl *gl, uint32_t slide, uint32_t texture) {
    bind_texture(gl, GN_GL_UNIT_SLIDE + slide, texture, GN_GL_COLOR);
}
