/* Runs a plan: each pass sets all its state, which the cache turns into the few calls that change
 * something. Nothing here allocates, makes a GL object or uses a string that GL looks at. */
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/hash.h"
#include "gl/private.h"

/* ---- targets ---- */

static void clear_output(struct gn_gl *gl, const struct gn_pass *pass) {
    static const float far_depth = 1.0f;
    const bool stencil = gl->targets.output.stencil;
    if (gl->targets.output.format == GN_OUTPUT_AOV) {
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
    case GN_ENCODING_R16F_RAW: GL(gl, ClearBufferfv)(GL_COLOR, 0, far_code); break;
    case GN_ENCODING_MASK: GL(gl, ClearBufferfv)(GL_COLOR, 0, far_code); return; /* no depth */
    default: break;
    }
    if (pass->kind == GN_PASS_COPY && pass->target.encoding != GN_ENCODING_DEPTH) return;
    GL(gl, ClearBufferfv)(GL_DEPTH, 0, ones);
}

static struct gn_gl_rect gl_rect(const struct gn_rect *r) {
    return (struct gn_gl_rect){(GLint)r->x, (GLint)r->y, (GLsizei)r->width, (GLsizei)r->height};
}

static struct gn_gl_rect viewport_of(const struct gn_pass *pass) {
    if (pass->viewport.width > 0) return gl_rect(&pass->viewport);
    return (struct gn_gl_rect){0, 0, (GLsizei)pass->target.width_px,
                               (GLsizei)pass->target.height_px};
}

/* The scissor rectangle of a pass; false: it draws to all of the target. */
static bool scissor_of(const struct gn_pass *pass, struct gn_gl_rect *out) {
    const GLint border = pass->kind == GN_PASS_MAP ? (GLint)pass->map.border_px : 0;
    *out = gl_rect(&pass->rect);
    if (pass->rect.width > 0) return true;
    *out = (struct gn_gl_rect){border, border, (GLsizei)pass->target.width_px - 2 * border,
                               (GLsizei)pass->target.height_px - 2 * border};
    return border > 0;
}

/* All of the target, or a tile of a map. */
static void clear_target(struct gn_gl *gl, const struct gn_pass *pass) {
    gn_gl_set_depth(gl, true, true);
    gn_gl_set_color_write(gl, true);
    if (pass->kind != GN_PASS_PICTURE) {
        clear_map(gl, pass);
        return;
    }
    if (gl->targets.output.stencil) gn_gl_set_stencil_writes(gl, 255);
    clear_output(gl, pass);
}

static void clear_stencil(struct gn_gl *gl, uint8_t bits) {
    gn_gl_set_scissor(gl, NULL);
    gn_gl_set_stencil_writes(gl, bits);
    GL(gl, Clear)(GL_STENCIL_BUFFER_BIT);
}

/* area: of pass->clear, or what clear_of() reduces it to. */
static void begin_target(struct gn_gl *gl, const struct gn_pass *pass, GLuint framebuffer,
                         enum gn_clear_area area) {
    static const struct gn_stencil no_stencil = {0};
    const struct gn_pass_picture *picture = pass->kind == GN_PASS_PICTURE ? &pass->picture : NULL;
    const bool only_stencil = picture && picture->only_stencil;
    const struct gn_gl_rect viewport = viewport_of(pass);
    struct gn_gl_rect inner;
    const bool bound = scissor_of(pass, &inner);
    gn_gl_bind_framebuffer(gl, framebuffer);
    gn_gl_set_viewport(gl, viewport);
    if (area != GN_CLEAR_NOTHING) {
        gn_gl_set_scissor(gl, area == GN_CLEAR_RECT ? &viewport : NULL);
        clear_target(gl, pass);
    }
    if (pass->clear.stencil_bits) clear_stencil(gl, pass->clear.stencil_bits);
    gn_gl_set_scissor(gl, bound ? &inner : NULL);
    gn_gl_set_depth(
        gl, pass->target.kind != GN_TARGET_ENCODED && pass->kind != GN_PASS_FILTER && !only_stencil,
        pass->depth_write);
    gn_gl_set_color_write(gl, !only_stencil);
    gn_gl_set_stencil(gl, picture ? &picture->stencil : &no_stencil);
    gn_gl_set_blend(gl, picture ? picture->blend : GN_BLEND_OFF);
}

static void discard_depth(struct gn_gl *gl, const struct gn_pass *pass) {
    static const GLenum attachment[] = {GL_DEPTH_ATTACHMENT, GL_STENCIL_ATTACHMENT};
    static const GLenum window[] = {GL_DEPTH, GL_STENCIL};
    const GLenum *depth = gl->state.framebuffer ? attachment : window;
    const bool stencil = pass->kind == GN_PASS_PICTURE && gl->targets.output.stencil;
    GL(gl, InvalidateFramebuffer)(GL_FRAMEBUFFER, stencil ? 2 : 1, depth);
}

/* Copies pages into the map; their contents are invalidated afterwards. */
static void copy_pages(struct gn_gl *gl, const struct gn_pass *pass) {
    static const GLenum attachments[] = {GL_DEPTH_ATTACHMENT, GL_COLOR_ATTACHMENT0};
    const struct gn_gl_map *pages = gn_gl_target_find(gl, &pass->copy.from);
    const bool is_depth = pass->target.encoding == GN_ENCODING_DEPTH;
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

/* Copies the picture between framebuffers; the source is invalidated. */
static void blit_output(struct gn_gl *gl, GLuint from, GLuint to) {
    static const GLenum color = GL_COLOR_ATTACHMENT0;
    const GLint w = (GLint)gl->targets.output.width_px, h = (GLint)gl->targets.output.height_px;
    gn_gl_set_scissor(gl, NULL);
    gn_gl_bind_framebuffer(gl, from);
    GL(gl, BindFramebuffer)(GL_DRAW_FRAMEBUFFER, to);
    GL(gl, BlitFramebuffer)(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    GL(gl, InvalidateFramebuffer)(GL_READ_FRAMEBUFFER, 1, &color);
    GL(gl, BindFramebuffer)(GL_FRAMEBUFFER, from); /* as the cache says */
}

/* Averages samples in linear light, in an off-screen target: a multisampled window would average
 * encoded values. */
static void resolve_output(struct gn_gl *gl) {
    const struct gn_gl_output *o = &gl->targets.output;
    if (o->resolved == o->framebuffer) return;
    blit_output(gl, o->framebuffer, o->resolved);
    if (o->window && !o->encodes) blit_output(gl, o->resolved, 0);
}

/* ---- what draws read ---- */

static GLuint map_sampler(const struct gn_gl *gl, const struct gn_shadow_view *view) {
    const GLuint *samplers = gl->targets.map_samplers;
    if (gn_view_has_mipmaps(view)) return samplers[GN_GL_MAP_TRILINEAR];
    if (view->moments)
        return samplers[gn_moments[view->moments].linear ? GN_GL_MAP_LINEAR : GN_GL_MAP_NEAREST];
    if (view->encoding == GN_ENCODING_MASK) return samplers[GN_GL_MAP_LINEAR];
    if (view->encoding != GN_ENCODING_DEPTH || gn_techniques[view->technique].searches)
        return samplers[GN_GL_MAP_NEAREST];
    return samplers[gn_techniques[view->technique].filters ? GN_GL_MAP_COMPARE_LINEAR
                                                           : GN_GL_MAP_COMPARE];
}

static void bind_maps(struct gn_gl *gl, const struct gn_plan *plan,
                      const struct gn_pass_picture *picture) {
    for (uint32_t i = 0; i < picture->shadow_count; i++) {
        const uint32_t slot = picture->first_shadow + i;
        const struct gn_shadow_view *view = &plan->shadows[slot];
        const struct gn_gl_map *map = gn_gl_view_find(gl, view, slot, !picture->reads_codes);
        const GLuint sampler = picture->reads_codes ? gl->targets.map_samplers[GN_GL_MAP_NEAREST]
                                                    : map_sampler(gl, view);
        if (map) gn_gl_bind_texture(gl, GN_GL_UNIT_MAP + i, map->texture, sampler);
    }
}

/* Binds what a filter reads, unfiltered. */
static void bind_reads(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass) {
    const uint32_t slot = pass->target.slot;
    for (GLuint i = 0; i < GN_FILTER_FROM_MAX; i++) {
        const struct gn_read *read = &pass->filter.reads[i];
        if (read->kind == GN_READ_NOTHING) continue;
        struct gn_target target = pass->target;
        target.index = read->index;
        target.mipmaps &= read->index == 0;
        target.width_px = read->width_px;
        target.height_px = read->height_px;
        const struct gn_gl_map *map = read->kind == GN_READ_MOMENTS
                                          ? gn_gl_target_find(gl, &target)
                                          : gn_gl_view_find(gl, &plan->shadows[slot], slot, false);
        if (map)
            gn_gl_bind_texture(gl, GN_GL_UNIT_MAP + i, map->texture,
                               gl->targets.map_samplers[GN_GL_MAP_NEAREST]);
    }
}

/* Binds what a pass reads besides material textures. */
static void bind_sources(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass) {
    const GLuint nearest = gl->targets.map_samplers[GN_GL_MAP_NEAREST];
    const struct gn_pass_picture *picture = &pass->picture;
    if (pass->kind == GN_PASS_FILTER) bind_reads(gl, plan, pass);
    if (pass->kind != GN_PASS_PICTURE) return;
    if (picture->reads_atlas)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, gl->atlas.texture, nearest);
    else if (pass->target.kind == GN_TARGET_ENCODED)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, gl->targets.output.texture, nearest);
    else
        bind_maps(gl, plan, picture);
    for (uint32_t i = 0; i < picture->slide_count; i++) gn_gl_slide_bind(gl, i, picture->slides[i]);
}

static void set_constants(struct gn_gl *gl, struct gn_gl_program *program,
                          const struct gn_pass *pass, uint64_t hash) {
    gn_gl_use_program(gl, program->name);
    if (program->constants_hash == hash || program->u_pass < 0) return;
    program->constants_hash = hash;
    GL(gl, Uniform4fv)(program->u_pass, (GLsizei)pass->constant_count, pass->constants[0]);
}

static void set_material(struct gn_gl *gl, struct gn_gl_program *program, uint32_t material) {
    if (!program->texture_slots) return;
    const struct gn_texture_ref *refs = gl->scene.scene->materials[material].textures;
    for (uint32_t slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
        if (program->texture_slots >> slot & 1) gn_gl_texture_bind(gl, slot, &refs[slot]);
    const uint32_t uv = gl->scene.material_uv[material];
    if (program->uv == uv || program->u_uv < 0) return;
    program->uv = uv;
    GL(gl, Uniform4fv)(program->u_uv, 2 * GN_TEXTURE_SLOT_COUNT, gl->scene.uv[uv][0]);
}

static bool is_for_shadows(const struct gn_pass *pass) {
    return pass->kind != GN_PASS_PICTURE || pass->picture.only_stencil;
}

static void draw_bare(struct gn_gl *gl, const struct gn_pass *pass, const struct gn_draw *d,
                      uint64_t constants_hash) {
    struct gn_gl_program *program = gl->plan_programs.at[d->program];
    set_constants(gl, program, pass, constants_hash);
    gn_gl_set_cull(gl, GN_CULL_NONE, false);
    gn_gl_vertices_bind(gl, program->attributes, d->first_instance);
    GL(gl, DrawArraysInstanced)
    (GL_TRIANGLES, 0, (GLsizei)d->vertex_count, (GLsizei)d->instance_count);
    gl->stats.draws++;
    gl->stats.shadow_draws += is_for_shadows(pass);
    gl->stats.triangles += (uint64_t)d->vertex_count / 3 * d->instance_count;
}

static void draw_geometry(struct gn_gl *gl, const struct gn_pass *pass, const struct gn_draw *d,
                          uint64_t constants_hash, uint32_t most_indices) {
    if (d->geometry == GN_NO_GEOMETRY) {
        draw_bare(gl, pass, d, constants_hash);
        return;
    }
    struct gn_gl_program *program = gl->plan_programs.at[d->program];
    const struct gn_geometry *geometry = &gl->scene.scene->geometries[d->geometry];
    const size_t first = geometry->first_index * gl->scene.index_size;
    const uint32_t count =
        geometry->index_count < most_indices ? geometry->index_count : most_indices;
    set_constants(gl, program, pass, constants_hash);
    set_material(gl, program, d->material);
    gn_gl_set_cull(gl, d->cull, d->mirrored);
    gn_gl_vertices_bind(gl, program->attributes, d->first_instance);
    GL(gl, DrawElementsInstanced)
    (GL_TRIANGLES, (GLsizei)count, gl->scene.index_type, (const void *)first,
     (GLsizei)d->instance_count);
    gl->stats.draws++;
    gl->stats.shadow_draws += is_for_shadows(pass);
    gl->stats.triangles += (uint64_t)count / 3 * d->instance_count;
}

/* ---- passes ---- */

static bool holds_content(const struct gn_gl_map *map, uint32_t tile, uint64_t hash) {
    return hash && map->content_hash[tile] == hash;
}

static GLuint framebuffer_of(const struct gn_gl *gl, const struct gn_pass *pass,
                             const struct gn_gl_map *map) {
    if (map) return map->framebuffer;
    return pass->target.kind == GN_TARGET_ENCODED ? gl->targets.output.encoded
                                                  : gl->targets.output.framebuffer;
}

/* Whether any tile of a map, from the `first` on, is still to be drawn in this frame. */
static bool is_any_to_draw(const struct gn_shadow_view *view, const struct gn_gl_map *map,
                           uint32_t first) {
    for (uint32_t tile = first; tile < view->map.tile_count; tile++)
        if (!holds_content(map, tile, view->raster.tiles[tile].content_hash)) return true;
    return false;
}

static bool are_all_to_draw(const struct gn_shadow_view *view, const struct gn_gl_map *map) {
    for (uint32_t tile = 0; tile < view->map.tile_count; tile++)
        if (holds_content(map, tile, view->raster.tiles[tile].content_hash)) return false;
    return true;
}

/* Clearing a whole map is free on a tiled GPU; clearing one tile of it costs a load and a draw.
 * When all tiles are drawn, the first clears them all. */
static enum gn_clear_area clear_of(const struct gn_plan *plan, struct gn_gl_map *map,
                                   const struct gn_pass *pass) {
    if (!map || pass->clear.area != GN_CLEAR_RECT) return pass->clear.area;
    if (pass->content.tile == 0) {
        map->cleared = are_all_to_draw(&plan->shadows[pass->target.slot], map);
        if (map->cleared) return GN_CLEAR_ALL;
    }
    return map->cleared ? GN_CLEAR_NOTHING : GN_CLEAR_RECT;
}

/* The first tile may have cleared the depth of later ones, which is needed until they are drawn. */
static bool is_depth_done(const struct gn_plan *plan, const struct gn_gl_map *map,
                          const struct gn_pass *pass) {
    if (!pass->discard_depth || pass->kind != GN_PASS_MAP) return pass->discard_depth;
    return !is_any_to_draw(&plan->shadows[pass->target.slot], map, pass->content.tile + 1);
}

static bool is_stopped(const struct gn_gl *gl, struct gn_err *err) {
    return gl->stop && gl->stop() && !gn_fail(err, "interrupted while compiling programs");
}

/* map: NULL for passes of the picture. */
static bool draw_pass(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass,
                      struct gn_gl_map *map, struct gn_err *err) {
    const bool grouped = gl->debug.on && gl->caps.has & 1u << GN_CAP_DEBUG;
    const uint64_t hash =
        gn_hash(GN_HASH_INIT, pass->constants, pass->constant_count * sizeof *pass->constants);
    if (grouped) GL(gl, PushDebugGroup)(GL_DEBUG_SOURCE_APPLICATION_KHR, 0, -1, pass->label);
    begin_target(gl, pass, framebuffer_of(gl, pass, map), clear_of(plan, map, pass));
    bind_sources(gl, plan, pass);
    const bool first_time = gl->programs.run != gl->programs.made;
    if (pass->kind == GN_PASS_COPY) copy_pages(gl, pass);
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        if (first_time && is_stopped(gl, err)) return false;
        draw_geometry(gl, pass, &plan->draws[pass->first_draw + i], hash, UINT32_MAX);
    }
    if (is_depth_done(plan, map, pass)) discard_depth(gl, pass);
    if (pass->kind == GN_PASS_PICTURE && pass->picture.resolves) resolve_output(gl);
    if (grouped) GL(gl, PopDebugGroup)();
    return !gl->debug.on || gn_gl_error_check(gl, pass->label, err);
}

/* The map whose content hash decides whether a pass has to run: the shadow map, or the light's own
 * moments, which may differ in size from the pass's target. */
static struct gn_gl_map *owner_of(struct gn_gl *gl, const struct gn_plan *plan,
                                  const struct gn_pass *pass) {
    const uint32_t slot = pass->target.slot;
    return gn_gl_view_find(gl, &plan->shadows[slot], slot, pass->kind == GN_PASS_FILTER);
}

static bool run_pass(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass,
                     struct gn_err *err) {
    if (pass->kind == GN_PASS_PICTURE) return draw_pass(gl, plan, pass, NULL, err);
    const struct gn_content *content = &pass->content;
    struct gn_gl_map *to = gn_gl_target_find(gl, &pass->target), *owner = owner_of(gl, plan, pass);
    if (!to || !owner) return gn_fail(err, "%s: the plan was not prepared", pass->label);
    if (holds_content(owner, content->tile, content->hash)) {
        owner->cleared = false;
        gl->stats.shadow_passes_skipped += pass->target.kind == GN_TARGET_SHADOW;
        return true;
    }
    if (to == owner)
        owner->content_hash[content->tile] = 0; /* undefined until the pass is complete */
    const bool ok = draw_pass(gl, plan, pass, to, err);
    if (content->completes) owner->content_hash[content->tile] = ok ? content->hash : 0;
    if (ok && content->completes) gn_gl_target_reduce(gl, owner);
    return ok;
}

static bool run_passes(struct gn_gl *gl, const struct gn_plan *plan, double *pass_ms,
                       struct gn_err *err) {
    if (pass_ms) gn_gl_wait(gl);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const int64_t start_ns = pass_ms ? gn_clock_monotonic_ns() : 0;
        if (!run_pass(gl, plan, &plan->passes[i], err)) return false;
        if (!pass_ms) continue;
        gn_gl_wait(gl);
        pass_ms[i] = (double)(gn_clock_monotonic_ns() - start_ns) * 1e-6;
    }
    return true;
}

static bool find_programs(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    if (plan->program_count > gl->plan_programs.room || plan->scene != gl->scene.scene ||
        !gn_gl_atlas_holds(gl, plan->atlas))
        return gn_fail(err, "the plan was not prepared");
    for (uint32_t i = 0; i < plan->program_count; i++) {
        const struct gn_gl_program *p = gl->plan_programs.at[i] =
            gn_gl_program_find(gl, &plan->programs[i]);
        if (!p || !gn_gl_vertices_known(gl, p->attributes))
            return gn_fail(err, "program %u was not prepared", i);
    }
    return true;
}

bool gn_gl_run(struct gn_gl *gl, const struct gn_plan *plan, double *pass_ms, struct gn_err *err) {
    const uint32_t calls_before = gl->calls;
    gl->stats = (struct gn_gl_stats){0};
    if (!find_programs(gl, plan, err)) return false;
    gn_gl_instances_upload(gl, plan->instances, plan->instance_count);
    bool ok = run_passes(gl, plan, pass_ms, err);
    if (ok) gl->programs.run = gl->programs.made;
    gl->stats.gl_calls = gl->calls - calls_before;
    return ok;
}

void gn_gl_black(struct gn_gl *gl) {
    static const float black[4] = {0, 0, 0, 1};
    gn_gl_bind_framebuffer(gl, 0);
    gn_gl_set_scissor(gl, NULL);
    gn_gl_set_color_write(gl, true);
    gn_gl_set_clear_color(gl, black);
    GL(gl, Clear)(GL_COLOR_BUFFER_BIT);
}

/* ---- preparing ---- */

static void grow_plan_programs(struct gn_gl *gl, uint32_t count) {
    if (count <= gl->plan_programs.room) return;
    gl->plan_programs.room = 2 * count;
    gl->plan_programs.at =
        gn_xrealloc(gl->plan_programs.at, gl->plan_programs.room, sizeof(struct gn_gl_program *));
}

bool gn_gl_program_prepare(struct gn_gl *gl, const struct gn_program_key *key, struct gn_err *err) {
    if (!gn_gl_program_ensure(gl, key, err)) return false;
    return gn_gl_vertices_ensure(gl, gn_gl_program_find(gl, key)->attributes, err);
}

static bool make_programs(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    grow_plan_programs(gl, plan->program_count);
    for (uint32_t i = 0; i < plan->program_count; i++) {
        if (!gn_gl_program_find(gl, &plan->programs[i]) && is_stopped(gl, err)) return false;
        if (!gn_gl_program_prepare(gl, &plan->programs[i], err)) return false;
    }
    return true;
}

/* Releases the driver's compiler between plans. In Mesa it holds 3 MB, 1.4 ms to free and 5
 * to make again; released later, after the first picture, its memory is not given back any more. */
bool gn_gl_prepare(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    const uint64_t made = gl->programs.made;
    if (plan->scene != gl->scene.scene) return gn_fail(err, "the plan's scene is not loaded");
    if (!gn_gl_prove(gl, plan))
        return gn_fail(err,
                       "this GPU fails at a capability it claims; try again, or use --without");
    const bool ok = make_programs(gl, plan, err) && gn_gl_targets_ensure(gl, plan, err) &&
                    gn_gl_atlas_ensure(gl, plan->atlas, err);
    if (made != gl->programs.made) GL(gl, ReleaseShaderCompiler)();
    return ok;
}

/* ---- warm-up draws ---- */

static const struct gn_draw *first_draw_of(const struct gn_plan *plan, const struct gn_pass *pass,
                                           uint32_t program) {
    for (uint32_t i = 0; i < pass->draw_count; i++)
        if (plan->draws[pass->first_draw + i].program == program)
            return &plan->draws[pass->first_draw + i];
    return NULL;
}

static bool touch_pass(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass,
                       const struct gn_draw *d, struct gn_err *err) {
    static const struct gn_gl_rect pixel = {0, 0, 1, 1};
    const bool is_map = pass->kind != GN_PASS_PICTURE;
    struct gn_gl_map *map = is_map ? gn_gl_target_find(gl, &pass->target) : NULL;
    struct gn_draw one = *d;
    one.instance_count = 1;
    if (is_map && !map) return gn_fail(err, "%s: the plan was not prepared", pass->label);
    begin_target(gl, pass, framebuffer_of(gl, pass, map), GN_CLEAR_NOTHING);
    gn_gl_set_scissor(gl, &pixel);
    bind_sources(gl, plan, pass);
    draw_geometry(gl, pass, &one, 0, 3);
    if (map) memset(map->content_hash, 0, sizeof map->content_hash);
    return true;
}

bool gn_gl_touch(struct gn_gl *gl, const struct gn_plan *plan, uint32_t program,
                 struct gn_err *err) {
    struct gn_gl_program *p = gn_gl_program_find(gl, &plan->programs[program]);
    grow_plan_programs(gl, plan->program_count);
    gl->plan_programs.at[program] = p;
    p->constants_hash = ~UINT64_C(0); /* forces an upload now and at the next frame */
    gn_gl_instances_upload(gl, plan->instances, plan->instance_count);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_draw *d = first_draw_of(plan, &plan->passes[i], program);
        if (d && !touch_pass(gl, plan, &plan->passes[i], d, err)) return false;
    }
    return true;
}
