/* The targets of passes: for each view an output, and a map per shadow slot. They are made again
 * when a plan of the view wants another size or format; maps of plans that alternate are kept. */
#include <string.h>

#include "gl/private.h"

static GLuint make_renderbuffer(struct gn_gl *gl, GLenum format, GLsizei samples, uint32_t width,
                                uint32_t height) {
    GLuint name = gn_gl_object_create(gl, GN_GL_RENDERBUFFER);
    GL(gl, BindRenderbuffer)(GL_RENDERBUFFER, name);
    if (samples > 1) GL(gl, RenderbufferStorageMultisample)
    (GL_RENDERBUFFER, samples, format, (GLsizei)width, (GLsizei)height);
    else GL(gl, RenderbufferStorage)(GL_RENDERBUFFER, format, (GLsizei)width, (GLsizei)height);
    return name;
}

static void attach_renderbuffer(struct gn_gl *gl, GLenum where, GLuint renderbuffer) {
    GL(gl, FramebufferRenderbuffer)(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, renderbuffer);
}

void gn_gl_set_window(struct gn_gl *gl, const struct gn_gl_window *window) {
    gl->window = window ? *window : (struct gn_gl_window){0};
}

bool gn_gl_framebuffer_check(struct gn_gl *gl, const char *what, struct gn_err *err) {
    GLenum status = GL(gl, CheckFramebufferStatus)(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return true;
    return gn_fail(err, "%s: incomplete framebuffer (0x%x); try a smaller --size or --map", what,
                   status);
}

/* ---- the output ---- */

static const struct {
    GLenum format;
    unsigned bytes;
} output_formats[] = {
    [GN_OUTPUT_SRGB8] = {GL_SRGB8_ALPHA8, 4},
    [GN_OUTPUT_LINEAR8] = {GL_RGBA8, 4},
    [GN_OUTPUT_FLOAT] = {GL_RGBA16F, 8},
    [GN_OUTPUT_AOV] = {GL_RGBA32UI, 16},
};

static void output_finish(struct gn_gl *gl, struct gn_gl_output *o) {
    if (o->resolved == o->framebuffer) o->resolved = o->resolved_color = 0;
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &o->framebuffer);
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &o->resolved);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &o->color);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &o->depth);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &o->resolved_color);
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &o->texture);
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &o->encoded);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &o->encoded_color);
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &o->scaled);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &o->scaled_color);
    for (int i = 0; i < 2; i++) {
        gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &o->means[i]);
        gn_gl_object_destroy(gl, GN_GL_TEXTURE, &o->mean_colors[i]);
    }
    *o = (struct gn_gl_output){0};
}

static void attach_texture(struct gn_gl *gl, const struct gn_gl_output *o, GLuint *texture) {
    *texture =
        gn_gl_texture_make(gl, 1, output_formats[o->format].format, o->width_px, o->height_px);
    GL(gl, FramebufferTexture2D)
    (GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *texture, 0);
}

/* Attaches the colour of the bound framebuffer: a texture if shaders read it, else a renderbuffer.
 */
static void attach_color(struct gn_gl *gl, struct gn_gl_output *o, GLuint *color, GLsizei samples,
                         bool readable) {
    const GLenum format = output_formats[o->format].format;
    if (!readable) {
        *color = make_renderbuffer(gl, format, samples, o->width_px, o->height_px);
        attach_renderbuffer(gl, GL_COLOR_ATTACHMENT0, *color);
        return;
    }
    attach_texture(gl, o, &o->texture);
}

GLuint gn_gl_output_drawn(const struct gn_gl_output *output) {
    const bool direct = output->window && !output->encodes && !output->msaa && !output->scales;
    return direct ? 0 : output->framebuffer;
}

GLuint gn_gl_output_encoded(const struct gn_gl_output *output) {
    return output->window && !output->scales ? 0 : output->encoded;
}

GLuint gn_gl_output_finished(const struct gn_gl_output *output) {
    if (output->window) return 0;
    if (output->scales) return output->scaled;
    return output->encodes ? output->encoded : output->resolved;
}

enum gn_output_format gn_gl_output_format(const struct gn_gl_output *output) {
    return output->encodes ? output->finished : output->format;
}

static bool output_make(struct gn_gl *gl, struct gn_gl_output *o, struct gn_err *err) {
    const bool encoded = o->encodes;
    if (o->window && !encoded && !o->msaa && !o->scales)
        return true; /* the display provides everything */
    o->depth = make_renderbuffer(gl, o->stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT24,
                                 (GLsizei)o->msaa, o->width_px, o->height_px);
    o->framebuffer = gn_gl_framebuffer_make(gl);
    attach_color(gl, o, &o->color, (GLsizei)o->msaa, (encoded && !o->msaa) || o->gathers);
    attach_renderbuffer(gl, o->stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                        o->depth);
    const uint64_t pixels = (uint64_t)o->width_px * o->height_px;
    const unsigned color_bytes = output_formats[o->format].bytes;
    o->bytes = pixels * (color_bytes + 4) * (o->msaa ? o->msaa : 1) +
               (o->msaa ? pixels * color_bytes : 0) + (encoded ? 4 * pixels : 0) +
               (o->gathers ? 2 * pixels * color_bytes : 0);
    if (!gn_gl_framebuffer_check(gl, "output", err)) return false;

    o->resolved = o->framebuffer;
    if (o->msaa) {
        o->resolved = gn_gl_framebuffer_make(gl);
        attach_color(gl, o, &o->resolved_color, 0, encoded);
        if (!gn_gl_framebuffer_check(gl, "resolved output", err)) return false;
    }
    const GLenum finished = output_formats[gn_gl_output_format(o)].format;
    if (encoded && (!o->window || o->scales)) {
        o->encoded_color = make_renderbuffer(gl, finished, 0, o->width_px, o->height_px);
        o->encoded = gn_gl_framebuffer_make(gl);
        attach_renderbuffer(gl, GL_COLOR_ATTACHMENT0, o->encoded_color);
        if (!gn_gl_framebuffer_check(gl, "encoded output", err)) return false;
    }
    if (o->scales && !o->window) {
        o->scaled_color = make_renderbuffer(gl, finished, 0, o->shown_width_px, o->shown_height_px);
        o->scaled = gn_gl_framebuffer_make(gl);
        attach_renderbuffer(gl, GL_COLOR_ATTACHMENT0, o->scaled_color);
        o->bytes += 4ull * o->shown_width_px * o->shown_height_px;
        if (!gn_gl_framebuffer_check(gl, "scaled output", err)) return false;
    }
    for (int i = 0; o->gathers && i < 2; i++) {
        o->means[i] = gn_gl_framebuffer_make(gl);
        attach_texture(gl, o, &o->mean_colors[i]);
        if (!gn_gl_framebuffer_check(gl, "mean of pictures", err)) return false;
    }
    return gn_gl_error_check(gl, "making the output", err);
}

/* A window's picture is scaled in some frames, and by the display in others: what either needs
 * stays. */
static bool holds_enough(const struct gn_gl_output *a, const struct gn_gl_output *b) {
    if (a->window) return !b->scales || (a->framebuffer && (a->encoded || !b->encodes));
    return a->scales == b->scales && a->shown_width_px == b->shown_width_px &&
           a->shown_height_px == b->shown_height_px;
}

static bool has_same_storage(const struct gn_gl_output *a, const struct gn_gl_output *b) {
    return a->window == b->window && a->width_px == b->width_px && a->height_px == b->height_px &&
           a->format == b->format && a->msaa_wanted == b->msaa_wanted && a->stencil == b->stencil &&
           a->encodes == b->encodes && a->finished == b->finished && a->gathers == b->gathers &&
           holds_enough(a, b);
}

/* pixel: like the output of the plan, but 1 x 1 and never a window. */
static bool output_ensure(struct gn_gl *gl, struct gn_gl_output *o, bool pixel,
                          const struct gn_plan *plan, struct gn_err *err) {
    const bool fits_window =
        plan->shown_width_px == gl->window.width_px &&
        plan->shown_height_px == gl->window.height_px &&
        (gl->window.srgb ? plan->finished == GN_OUTPUT_SRGB8 : plan->encode_srgb);
    struct gn_gl_output wanted = {
        .width_px = pixel ? 1 : plan->width_px,
        .height_px = pixel ? 1 : plan->height_px,
        .shown_width_px = pixel ? 1 : plan->shown_width_px,
        .shown_height_px = pixel ? 1 : plan->shown_height_px,
        .scales = gn_plan_scales(plan),
        .format = plan->output,
        .stencil = plan->stencil || gl->targets.wants_stencil,
        .msaa_wanted = plan->msaa,
        .window = !pixel && fits_window && !plan->gathers,
        .finished = plan->finished,
        .encodes = plan->finishes,
        .gathers = plan->gathers,
        .made = true,
    };
    if (o->made && has_same_storage(o, &wanted)) {
        o->scales = wanted.scales;
        o->shown_width_px = wanted.shown_width_px;
        o->shown_height_px = wanted.shown_height_px;
        return true;
    }
    output_finish(gl, o);
    if (plan->msaa > 1 && plan->output != GN_OUTPUT_AOV && gl->caps.has & 1u << GN_CAP_MSAA4) {
        GLint most = 0; /* the largest is listed first */
        GL(gl, GetInternalformativ)
        (GL_RENDERBUFFER, output_formats[plan->output].format, GL_SAMPLES, 1, &most);
        const uint32_t samples = plan->msaa < (uint32_t)most ? plan->msaa : (uint32_t)most;
        wanted.msaa = samples > 1 ? samples : 0;
    }
    *o = wanted;
    if (output_make(gl, o, err)) return true;
    output_finish(gl, o);
    return false;
}

bool gn_gl_pixel_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    return output_ensure(gl, &gl->targets.pixel, true, plan, err);
}

/* ---- shadow maps ---- */

static const GLenum map_formats[GN_ENCODING_ALL] = {
    [GN_ENCODING_DEPTH] = GL_DEPTH_COMPONENT24,
    [GN_ENCODING_R32UI] = GL_R32UI,
    [GN_ENCODING_R16F] = GL_R16F,
    [GN_ENCODING_R16F_RAW] = GL_R16F,
    [GN_ENCODING_RGBA8] = GL_RGBA8,
    [GN_ENCODING_DEPTH16] = GL_DEPTH_COMPONENT16,
    [GN_ENCODING_MASK] = GL_R8,
    [GN_ENCODING_MEAN] = GL_R8,      /* blended, which ES 3.0 promises; half floats it does not */
    [GN_ENCODING_STENCIL] = GL_NONE, /* no map */
    [GN_ENCODING_SCREEN] = GL_R32UI,
};

static const GLenum moments_formats[GN_MOMENTS_ALL] = {
    [GN_MOMENTS_NONE] = GL_NONE,
    [GN_MOMENTS_RG32UI] = GL_RG32UI,
    [GN_MOMENTS_RGBA16UI] = GL_RGBA16UI,
    [GN_MOMENTS_RGBA16F] = GL_RGBA16F,
    [GN_MOMENTS_RGBA16F_MIPS] = GL_RGBA16F,
    [GN_MOMENTS_RGBA32F_BITS] = GL_RGBA32UI,
    [GN_MOMENTS_RGBA32F_SHARE] = GL_RGBA32UI,
    [GN_MOMENTS_TABLE_RGBA32UI] = GL_RGBA32UI,
    [GN_MOMENTS_CONE_RG16F] = GL_RG16F,
    [GN_MOMENTS_CONE_BITS] = GL_R32UI,
    [GN_MOMENTS_CONE_BYTES] = GL_RGBA8,
    [GN_MOMENTS_FLOOR] = GL_RG8,
};

static void map_finish(struct gn_gl *gl, struct gn_gl_map *map) {
    gn_gl_object_destroy(gl, GN_GL_FRAMEBUFFER, &map->framebuffer);
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &map->texture);
    gn_gl_object_destroy(gl, GN_GL_RENDERBUFFER, &map->depth);
    *map = (struct gn_gl_map){0};
}

static bool make_map(struct gn_gl *gl, struct gn_gl_map *map, struct gn_err *err) {
    static const GLenum none = GL_NONE;
    const bool is_depth = !map->moments && gn_encoding_is_depth(map->encoding);
    const uint32_t side = map->width_px > map->height_px ? map->width_px : map->height_px;
    GLsizei levels = 1;
    while (map->mipmaps && side >> levels > 0) levels++;
    const GLenum format = map->moments ? moments_formats[map->moments] : map_formats[map->encoding];
    map->texture = gn_gl_texture_make(gl, levels, format, map->width_px, map->height_px);
    map->framebuffer = gn_gl_framebuffer_make(gl);
    GL(gl, FramebufferTexture2D)
    (GL_FRAMEBUFFER, is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
     map->texture, 0);
    if (is_depth) {
        GL(gl, DrawBuffers)(1, &none);
        GL(gl, ReadBuffer)(GL_NONE);
    } else if (!map->moments && map->encoding != GN_ENCODING_MASK &&
               map->encoding != GN_ENCODING_SCREEN) {           /* which need no depth test */
        const bool is_mean = map->encoding == GN_ENCODING_MEAN; /* whose depths count points */
        map->depth = make_renderbuffer(gl, is_mean ? GL_DEPTH_COMPONENT16 : GL_DEPTH_COMPONENT24, 0,
                                       map->width_px, map->height_px);
        attach_renderbuffer(gl, GL_DEPTH_ATTACHMENT, map->depth);
    }
    if (gn_gl_framebuffer_check(gl, "shadow map", err) &&
        gn_gl_error_check(gl, "making a shadow map", err))
        return true;
    gn_fail_prefix(err, "%s",
                   map->moments ? gn_moments[map->moments].name : gn_encodings[map->encoding].name);
    map_finish(gl, map);
    return false;
}

/* t: normalised by kept_target(). */
static struct gn_gl_map *map_find(struct gn_gl *gl, const struct gn_target *t) {
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) {
        struct gn_gl_map *m = &gl->targets.maps[i];
        if (m->framebuffer && m->slot == t->slot && m->encoding == t->encoding &&
            m->moments == t->moments && m->index == t->index && m->mipmaps == t->mipmaps &&
            m->width_px == t->width_px && m->height_px == t->height_px)
            return m;
    }
    return NULL;
}

/* The side of a stand-in. Drivers compile for sides that are powers of two, and for others, and for
 * textures with mipmaps. */
static uint32_t stand_in_px(uint32_t px) { return px & (px - 1) ? 3 : 4; }

static uint32_t slot_of_view(const struct gn_gl *gl, uint32_t slot) {
    return gl->targets.view * GN_ALL_SHADOWS_MAX + slot;
}

/* Normalises a target for lookup: pages, far sides and intermediate moments are shared by all
 * lights of all views with the same format and size; stand-ins are shared by all lights. */
static struct gn_target kept_target(const struct gn_gl *gl, const struct gn_target *target) {
    struct gn_target kept = *target;
    kept.slot = slot_of_view(gl, kept.slot);
    if (kept.kind == GN_TARGET_BACKS) kept.index = 1; /* beside the pages */
    if (kept.kind == GN_TARGET_PAGES || kept.index > 0) kept.slot = GN_GL_SLOT_PAGES;
    if (!gl->targets.stand_ins) return kept;
    kept.slot = GN_GL_SLOT_STAND_INS;
    kept.width_px = stand_in_px(kept.width_px);
    kept.height_px = stand_in_px(kept.height_px);
    return kept;
}

struct gn_gl_map *gn_gl_target_find(struct gn_gl *gl, const struct gn_target *target) {
    const struct gn_target kept = kept_target(gl, target);
    return map_find(gl, &kept);
}

void gn_gl_target_reduce(struct gn_gl *gl, const struct gn_gl_map *map) {
    if (!map->mipmaps) return;
    gn_gl_work_on_texture(gl, map->texture);
    GL(gl, GenerateMipmap)(GL_TEXTURE_2D);
}

struct gn_gl_map *gn_gl_view_find(struct gn_gl *gl, const struct gn_shadow_view *view,
                                  uint32_t slot, bool or_moments) {
    const bool map = !or_moments || !view->moments;
    uint32_t size_px[2] = {view->map.width_px, view->map.height_px};
    if (!map) gn_view_filtered_size(view, size_px);
    const struct gn_target target = {.slot = slot,
                                     .width_px = size_px[0],
                                     .height_px = size_px[1],
                                     .encoding = map ? view->encoding : (enum gn_encoding)0,
                                     .moments = map ? GN_MOMENTS_NONE : view->moments,
                                     .mipmaps = !map && gn_view_has_mipmaps(view)};
    return gn_gl_target_find(gl, &target);
}

struct gn_gl_map *gn_gl_map_of_slot(struct gn_gl *gl, uint32_t slot) {
    struct gn_gl_map *latest = NULL;
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) {
        struct gn_gl_map *m = &gl->targets.maps[i];
        if (m->framebuffer && !m->moments && m->slot == slot_of_view(gl, slot) &&
            (!latest || m->last_used > latest->last_used))
            latest = m;
    }
    return latest;
}

/* Frees least recently used maps that the current plan does not use, until there is room for so
 * many bytes more. */
static void make_room(struct gn_gl *gl, uint64_t most_bytes, uint64_t more_bytes) {
    for (;;) {
        struct gn_gl_map *oldest = NULL;
        uint64_t bytes = more_bytes;
        for (int i = 0; i < GN_GL_MAPS_MAX; i++) {
            struct gn_gl_map *m = &gl->targets.maps[i];
            bytes += m->bytes;
            if (m->framebuffer && m->last_used < gl->targets.prepares &&
                (!oldest || m->last_used < oldest->last_used))
                oldest = m;
        }
        if (!oldest || bytes <= most_bytes) return;
        map_finish(gl, oldest);
    }
}

/* ---- all of them ---- */

void gn_gl_targets_choose(struct gn_gl *gl, uint32_t view) {
    gl->targets.view = view;
    gl->targets.output = &gl->targets.outputs[view];
}

void gn_gl_drop_view(struct gn_gl *gl, uint32_t view) {
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) {
        struct gn_gl_map *map = &gl->targets.maps[i];
        if (map->slot < GN_GL_SLOT_PAGES && map->slot / GN_ALL_SHADOWS_MAX == view)
            map_finish(gl, map);
    }
    output_finish(gl, &gl->targets.outputs[view]);
    if (gl->targets.view == view) gn_gl_targets_choose(gl, 0);
}

bool gn_gl_targets_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    gl->targets.prepares++;
    gn_gl_targets_choose(gl, plan->view);
    return output_ensure(gl, gl->targets.output, false, plan, err) &&
           gn_gl_maps_ensure(gl, plan, err);
}

bool gn_gl_maps_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    const uint64_t kept_bytes = UINT64_C(1048576) * GN_GL_MAPS_MB;
    const uint64_t most_bytes =
        plan->maps_bytes > 0 && plan->maps_bytes < kept_bytes ? plan->maps_bytes : kept_bytes;
    /* those that are there first: they must not make room for others */
    for (int missing = 0; missing < 2; missing++)
        for (uint32_t i = 0; i < plan->pass_count; i++) {
            const struct gn_target *target = &plan->passes[i].target,
                                   kept = kept_target(gl, target);
            if (plan->passes[i].kind == GN_PASS_PICTURE) continue;
            struct gn_gl_map *map = map_find(gl, &kept);
            if (!map && !missing) continue;
            if (!map) {
                struct gn_gl_map made = {.slot = kept.slot,
                                         .encoding = kept.encoding,
                                         .moments = kept.moments,
                                         .index = kept.index,
                                         .mipmaps = kept.mipmaps,
                                         .width_px = kept.width_px,
                                         .height_px = kept.height_px};
                const unsigned texel_bytes = made.moments ? gn_moments[made.moments].texel_bytes
                                                          : gn_encodings[made.encoding].texel_bytes;
                made.bytes = (uint64_t)made.width_px * made.height_px * texel_bytes;
                if (made.mipmaps) made.bytes += made.bytes / 3;
                make_room(gl, most_bytes, made.bytes);
                /* A free slot, else the least recently used map. Never one of this plan, which has
                 * far fewer. */
                map = &gl->targets.maps[0];
                for (int k = 1; k < GN_GL_MAPS_MAX; k++)
                    if (gl->targets.maps[k].last_used < map->last_used) map = &gl->targets.maps[k];
                map_finish(gl, map);
                *map = made;
                if (!make_map(gl, map, err)) return false;
            }
            map->last_used = gl->targets.prepares;
        }
    return true;
}

void gn_gl_targets_forget(struct gn_gl *gl) {
    for (int i = 0; i < GN_GL_MAPS_MAX; i++)
        memset(gl->targets.maps[i].content_hash, 0, sizeof gl->targets.maps[i].content_hash);
}

uint64_t gn_gl_targets_bytes(const struct gn_gl *gl) {
    uint64_t bytes = gl->targets.output->bytes;
    for (int i = 0; i < GN_GL_MAPS_MAX; i++)
        if (gl->targets.maps[i].last_used == gl->targets.prepares)
            bytes += gl->targets.maps[i].bytes;
    return bytes;
}

void gn_gl_targets_init(struct gn_gl *gl) {
    gn_gl_targets_choose(gl, 0);
    for (enum gn_gl_map_sampler kind = 0; kind < GN_GL_MAP_SAMPLER_COUNT; kind++) {
        const bool nearest = kind == GN_GL_MAP_COMPARE || kind == GN_GL_MAP_NEAREST;
        const GLint filter = nearest ? GL_NEAREST : GL_LINEAR;
        const GLuint s = gl->targets.map_samplers[kind] = gn_gl_sampler_make(
            gl, kind == GN_GL_MAP_TRILINEAR ? GL_LINEAR_MIPMAP_LINEAR : filter, filter);
        if (kind < GN_GL_MAP_COMPARE) continue;
        GL(gl, SamplerParameteri)(s, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        GL(gl, SamplerParameteri)(s, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    for (int i = 0; i < GN_SHADOWS_MAX; i++)
        gl->targets.mipmap_samplers[i] = gn_gl_sampler_make(gl, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
}

GLuint gn_gl_mipmap_sampler(struct gn_gl *gl, uint32_t unit, float mipmap) {
    const GLuint s = gl->targets.mipmap_samplers[unit];
    GL(gl, SamplerParameterf)(s, GL_TEXTURE_MIN_LOD, mipmap);
    return s;
}

void gn_gl_targets_finish(struct gn_gl *gl) {
    for (int i = 0; i < GN_PLAN_VIEWS_MAX; i++) output_finish(gl, &gl->targets.outputs[i]);
    output_finish(gl, &gl->targets.pixel);
    for (int i = 0; i < GN_GL_MAPS_MAX; i++) map_finish(gl, &gl->targets.maps[i]);
    for (int i = 0; i < GN_GL_MAP_SAMPLER_COUNT; i++)
        gn_gl_object_destroy(gl, GN_GL_SAMPLER, &gl->targets.map_samplers[i]);
    for (int i = 0; i < GN_SHADOWS_MAX; i++)
        gn_gl_object_destroy(gl, GN_GL_SAMPLER, &gl->targets.mipmap_samplers[i]);
}
