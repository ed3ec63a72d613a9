/* Prepares a plan, then runs it: each pass sets all its state, which the cache turns into the few
 * calls that change something. Running allocates nothing, makes no GL object and uses no string
 * that GL looks at. */
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/hash.h"
#include "gl/private.h"
#include "shadow/lamp.h"

/* ---- preparing ---- */

static bool is_stopped(const struct gn_gl *gl, struct gn_err *err) {
    return gl->stop && gl->stop() && !gn_fail(err, "interrupted while compiling programs");
}

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

/* Releases the driver's compiler between plans. In Mesa it holds 3 MB, 1.4 ms to free and 5
 * to make again; released later, after the first picture, its memory is not returned to the system.
 */
bool gn_gl_prepare(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    const uint64_t made = gl->programs.made;
    if (plan->scene != gl->scene.scene) return gn_fail(err, "the plan's scene is not loaded");
    /* a guard: gn_view_plan() has proved its plan, and without prove_later all was at create */
    if (!gn_gl_prove(gl, plan))
        return gn_fail(err,
                       "this GPU fails at a capability it claims; try again, or use --without");
    bool ok = true;
    grow_plan_programs(gl, plan->program_count);
    gl->pieces.run_ns = gl->pieces.pause ? gn_clock_monotonic_ns() : 0;
    for (uint32_t i = 0; ok && i < plan->program_count; i++) {
        const struct gn_program_key *key = &plan->programs[i];
        const bool is_made = gn_gl_program_find(gl, key) != NULL;
        ok = (is_made || !is_stopped(gl, err)) && gn_gl_program_prepare(gl, key, err) &&
             (is_made || gn_gl_pause_after(gl, 0, err));
    }
    ok = ok && gn_gl_targets_ensure(gl, plan, err) && gn_gl_atlas_ensure(gl, plan->atlas, err) &&
         gn_gl_environment_ensure(gl, &plan->environment, err) &&
         gn_gl_occlusion_ensure(gl, plan, err);
    if (made != gl->programs.made) GL(gl, ReleaseShaderCompiler)();
    return ok;
}

void gn_gl_give(struct gn_gl *gl, const struct gn_plan *plan, uint32_t slot, const float *values) {
    const struct gn_shadow_view *view = &plan->shadows[slot];
    struct gn_gl_map *map = gn_gl_view_find(gl, view, slot, false);
    if (!map || view->encoding != GN_ENCODING_SCREEN) return;
    gn_gl_work_on_texture(gl, map->texture);
    GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, 0, 0, 0, (GLsizei)map->width_px, (GLsizei)map->height_px, GL_RED_INTEGER,
     GL_UNSIGNED_INT, values);
    map->content_hash[0] = view->raster.tiles[0].content_hash;
}

/* ---- running ---- */

static bool holds_content(const struct gn_gl_map *map, uint32_t tile, uint64_t hash) {
    return hash && map->content_hash[tile] == hash;
}

static GLuint framebuffer_of(const struct gn_gl *gl, const struct gn_pass *pass,
                             const struct gn_gl_map *map) {
    if (map) return map->framebuffer;
    const struct gn_gl_output *output = gl->targets.output;
    if (pass->target.kind == GN_TARGET_MEAN) return output->means[pass->target.index];
    if (pass->target.kind == GN_TARGET_SCALED) return output->scaled;
    return pass->target.kind == GN_TARGET_ENCODED ? gn_gl_output_encoded(output)
                                                  : gn_gl_output_drawn(output);
}

/* What a pass is to clear. Clearing a whole map is free on a tiled GPU; clearing one tile of it
 * costs a load and a draw. When all tiles are drawn, the first clears them all: notes that in
 * map->cleared, and that no tile holds anything. */
static enum gn_clear_area begin_clear(const struct gn_plan *plan, struct gn_gl_map *map,
                                      const struct gn_pass *pass) {
    if (!map || pass->clear.area != GN_CLEAR_RECT) return pass->clear.area;
    if (pass->content.tile == 0) {
        const struct gn_shadow_view *view = &plan->shadows[pass->target.slot];
        map->cleared = true;
        for (uint32_t tile = 0; tile < view->map.tile_count; tile++)
            map->cleared &= !holds_content(map, tile, view->raster.tiles[tile].content_hash);
        if (map->cleared) {
            memset(map->content_hash, 0, sizeof map->content_hash);
            return GN_CLEAR_ALL;
        }
    }
    return map->cleared ? GN_CLEAR_NOTHING : GN_CLEAR_RECT;
}

/* The depth buffer shows which texels it has darkened already: `nth` of the pass is nearer than
 * those before it. */
static bool draw_point(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *point,
                       uint32_t nth, bool two_sided, struct gn_err *err) {
    const uint64_t hash =
        gn_hash(GN_HASH_INIT, point->constants, point->constant_count * sizeof *point->constants);
    gn_gl_set_one_depth(gl, 1.0f - (float)(nth + 1) / (GN_LAMP_POINTS_MAX + 1));
    for (uint32_t k = 0; k < point->draw_count; k++) {
        struct gn_draw draw = plan->draws[point->first_draw + k];
        if (two_sided) draw.cull = GN_CULL_NONE;
        if (!gn_gl_draw_in_pieces(gl, point, &draw, hash, err)) return false;
    }
    return true;
}

/* Draws the points of a lamp that its mask lacks, from so many on, and first what stands on it. */
static bool draw_points(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass,
                        uint32_t first, struct gn_err *err) {
    static const float farthest = 1.0f;
    struct gn_pass point = *pass;
    point.constant_count = GN_POINT_CONSTANTS;
    if (first > 0) GL(gl, ClearBufferfv)(GL_DEPTH, 0, &farthest);
    point.constants = pass->map.foot;
    if (first == 0 && point.constants && !draw_point(gl, plan, &point, 0, true, err)) return false;
    for (uint32_t i = first; i < pass->map.point_count; i++) {
        point.constants = pass->map.points + i * GN_POINT_CONSTANTS;
        if (!draw_point(gl, plan, &point, i - first, false, err)) return false;
    }
    gn_gl_set_one_depth(gl, 0);
    return true;
}

/* map: NULL for passes of the picture. points: that it has already, of the right content. */
static bool draw_pass(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass,
                      struct gn_gl_map *map, uint32_t points, struct gn_err *err) {
    const bool grouped = gl->debug.on && gl->caps.has & 1u << GN_CAP_DEBUG;
    const uint64_t hash =
        gn_hash(GN_HASH_INIT, pass->constants, pass->constant_count * sizeof *pass->constants);
    if (grouped) GL(gl, PushDebugGroup)(GL_DEBUG_SOURCE_APPLICATION_KHR, 0, -1, pass->label);
    const enum gn_clear_area area = points > 0 ? GN_CLEAR_NOTHING : begin_clear(plan, map, pass);
    gn_gl_pass_begin(gl, pass, framebuffer_of(gl, pass, map), area);
    gn_gl_sources_bind(gl, plan, pass);
    const bool first_time = gl->programs.made_at_run != gl->programs.made;
    if (pass->kind == GN_PASS_COPY) gn_gl_pages_copy(gl, pass);
    const bool by_points = pass->kind == GN_PASS_MAP && pass->map.point_count > 0;
    if (by_points && !draw_points(gl, plan, pass, points, err)) return false;
    for (uint32_t i = 0; i < pass->draw_count && !by_points; i++) {
        if (first_time && is_stopped(gl, err)) return false;
        const int64_t begun_ns = first_time ? gn_clock_monotonic_ns() : 0;
        if (!gn_gl_draw_in_pieces(gl, pass, &plan->draws[pass->first_draw + i], hash, err))
            return false;
        if (first_time && !gn_gl_pause_after(gl, begun_ns, err)) return false;
    }
    /* The first tile may have cleared the depth of later ones, which is needed until those are
     * drawn. */
    bool depth_done = pass->discard_depth;
    if (depth_done && map && pass->kind == GN_PASS_MAP) {
        const struct gn_shadow_view *view = &plan->shadows[pass->target.slot];
        for (uint32_t tile = pass->content.tile + 1; tile < view->map.tile_count; tile++)
            depth_done &= holds_content(map, tile, view->raster.tiles[tile].content_hash);
    }
    if (depth_done) gn_gl_depth_discard(gl, pass);
    if (pass->kind == GN_PASS_PICTURE && pass->picture.resolves) gn_gl_output_resolve(gl);
    if (pass->kind == GN_PASS_PICTURE && pass->picture.scales) gn_gl_output_scale(gl);
    if (grouped) GL(gl, PopDebugGroup)();
    return !gl->debug.on || gn_gl_error_check(gl, pass->label, err);
}

static bool run_pass(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass,
                     struct gn_err *err) {
    if (pass->kind == GN_PASS_PICTURE) return draw_pass(gl, plan, pass, NULL, 0, err);
    const struct gn_content *content = &pass->content;
    const uint32_t slot = pass->target.slot;
    struct gn_gl_map *to = gn_gl_target_find(gl, &pass->target);
    /* The map whose content hash decides whether the pass has to run: the shadow map, or the
     * light's own moments, which may differ in size from the pass's target. */
    struct gn_gl_map *owner =
        gn_gl_view_find(gl, &plan->shadows[slot], slot, pass->kind == GN_PASS_FILTER);
    if (!to || !owner) return gn_fail(err, "%s: the plan was not prepared", pass->label);
    if (pass->kind == GN_PASS_GIVEN)
        return owner->content_hash[0] || gn_fail(err, "%s: no values were given", pass->label);
    const bool holds = holds_content(owner, content->tile, content->hash);
    const uint32_t wanted = pass->kind == GN_PASS_MAP ? pass->map.point_count : 0;
    if (holds && owner->points == wanted) {
        owner->cleared = false; /* if it is tile 0: it clears nothing in this frame */
        gl->stats.shadow_passes_skipped += pass->target.kind == GN_TARGET_SHADOW;
        return true;
    }
    if (to == owner)
        owner->content_hash[content->tile] = 0; /* undefined until the pass is complete */
    const uint32_t points = holds && owner->points < wanted ? owner->points : 0;
    const bool ok = draw_pass(gl, plan, pass, to, points, err);
    if (pass->kind == GN_PASS_MAP) owner->points = wanted;
    if (content->completes) owner->content_hash[content->tile] = ok ? content->hash : 0;
    if (ok && content->completes) gn_gl_target_reduce(gl, owner);
    return ok;
}

bool gn_gl_run(struct gn_gl *gl, const struct gn_plan *plan, double *pass_ms, struct gn_err *err) {
    const uint32_t calls_before = gl->calls;
    gl->stats = (struct gn_gl_stats){0};
    if (plan->program_count > gl->plan_programs.room || plan->scene != gl->scene.scene ||
        !gn_gl_atlas_holds(gl, plan->atlas) || !gn_gl_environment_holds(gl, &plan->environment) ||
        !gn_gl_occlusion_holds(gl, plan))
        return gn_fail(err, "the plan was not prepared");
    for (uint32_t i = 0; i < plan->program_count; i++) {
        const struct gn_gl_program *p = gl->plan_programs.at[i] =
            gn_gl_program_find(gl, &plan->programs[i]);
        if (!p || !gn_gl_vertices_known(gl, p->attributes))
            return gn_fail(err, "program %u was not prepared", i);
    }
    gn_gl_targets_choose(gl, plan->view);
    gl->programs.runs++;
    for (uint32_t i = 0; i < plan->program_count; i++) {
        gl->plan_programs.at[i]->used = gl->programs.runs;
        gl->plan_programs.at[i]->drawn = true;
    }
    gn_gl_instances_upload(gl, plan->instances, plan->instance_count);
    gn_gl_pose_upload(gl, plan);
    gn_gl_detail_upload(gl, plan);
    gn_gl_materials_update(gl, plan);
    gn_gl_pieces_begin(gl, plan->scene);
    bool ok = true;
    if (pass_ms) gn_gl_wait(gl);
    for (uint32_t i = 0; ok && i < plan->pass_count; i++) {
        const int64_t start_ns = pass_ms ? gn_clock_monotonic_ns() : 0;
        ok = run_pass(gl, plan, &plan->passes[i], err);
        if (!ok || !pass_ms) continue;
        gn_gl_wait(gl);
        pass_ms[i] = (double)(gn_clock_monotonic_ns() - start_ns) * 1e-6;
    }
    if (ok) gl->programs.made_at_run = gl->programs.made;
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

/* ---- warm-up draws ---- */

enum { TOUCHES_MAX = 32 }; /* of a program in a pass */

/* Drivers compile for how textures are read, too: wrapping, mipmaps, sides of powers of two. */
static bool has_other_textures(const struct gn_gl *gl, const struct gn_gl_program *program,
                               const struct gn_draw *a, const struct gn_draw *b) {
    const struct gn_material *materials = gl->scene.scene->materials;
    bool other = false;
    for (uint32_t slot = 0; program->texture_slots && slot < GN_TEXTURE_SLOT_COUNT; slot++)
        other |= (program->texture_slots >> slot & 1) &&
                 materials[a->material].textures[slot].texture !=
                     materials[b->material].textures[slot].texture;
    return other;
}

bool gn_gl_touch(struct gn_gl *gl, const struct gn_plan *plan, uint32_t program,
                 struct gn_err *err) {
    static const struct gn_gl_rect pixel = {0, 0, 1, 1};
    struct gn_gl_program *p = gn_gl_program_find(gl, &plan->programs[program]);
    grow_plan_programs(gl, plan->program_count);
    gl->plan_programs.at[program] = p;
    if (!gn_gl_atlas_ensure(gl, plan->atlas, err)) return false;
    p->constants_hash = ~UINT64_C(0); /* forces an upload now and at the next frame */
    gn_gl_instances_upload(gl, plan->instances, plan->instance_count);
    gn_gl_pose_upload(gl, plan);
    gn_gl_detail_upload(gl, plan);
    gn_gl_materials_update(gl, plan);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        const struct gn_draw *d = &plan->draws[pass->first_draw], *end = d + pass->draw_count;
        while (d < end && d->program != program) d++;
        if (d == end) continue;
        const bool is_map = pass->kind != GN_PASS_PICTURE;
        struct gn_gl_map *map = is_map ? gn_gl_target_find(gl, &pass->target) : NULL;
        if (is_map && !map) return gn_fail(err, "%s: the plan was not prepared", pass->label);
        gn_gl_pass_begin(gl, pass, framebuffer_of(gl, pass, map), GN_CLEAR_NOTHING);
        gn_gl_set_scissor(gl, &pixel);
        gn_gl_sources_bind(gl, plan, pass);
        const struct gn_draw *last = NULL;
        for (int drawn = 0; d < end && drawn < TOUCHES_MAX; d++) {
            if (d->program != program || (last && !has_other_textures(gl, p, last, d))) continue;
            struct gn_draw one = *d;
            one.instance_count = 1;
            gn_gl_draw(gl, pass, &one, 0, 0, 3);
            last = d;
            drawn++;
        }
        if (map) memset(map->content_hash, 0, sizeof map->content_hash);
    }
    return true;
}
