/* The draws of a pass, and what they read. */
#include "gl/private.h"

static GLuint moments_sampler(struct gn_gl *gl, const struct gn_shadow_view *view, GLuint i) {
    const GLuint *samplers = gl->targets.map_samplers;
    if (view->moments == GN_MOMENTS_RGBA16F_MIPS)
        return gn_gl_mipmap_sampler(gl, i, gn_mipmap_of_blur(view->penumbra.blur_px));
    if (gn_view_has_mipmaps(view)) return samplers[GN_GL_MAP_TRILINEAR];
    return samplers[gn_moments[view->moments].linear ? GN_GL_MAP_LINEAR : GN_GL_MAP_NEAREST];
}

static GLuint map_sampler(const struct gn_gl *gl, const struct gn_shadow_view *view) {
    const GLuint *samplers = gl->targets.map_samplers;
    if (gn_techniques[view->technique].on_plane) return samplers[GN_GL_MAP_LINEAR];
    if (!gn_encoding_is_depth(view->encoding) || gn_techniques[view->technique].searches)
        return samplers[GN_GL_MAP_NEAREST];
    return samplers[gn_techniques[view->technique].compares_linear ? GN_GL_MAP_COMPARE_LINEAR
                                                                   : GN_GL_MAP_COMPARE];
}

/* The map of shader slot i, or what is read in its place, or both. */
static void bind_map(struct gn_gl *gl, const struct gn_shadow_view *view, uint32_t slot, GLuint i) {
    const bool replaced = gn_technique_replaces_map(view->technique);
    const struct gn_gl_map *map = gn_gl_view_find(gl, view, slot, replaced);
    const struct gn_gl_map *filtered = gn_gl_view_find(gl, view, slot, true);
    if (map)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP + i, map->texture,
                           replaced ? moments_sampler(gl, view, i) : map_sampler(gl, view));
    if (filtered && filtered != map)
        gn_gl_bind_texture(gl, GN_GL_UNIT_FILTERED + i, filtered->texture,
                           moments_sampler(gl, view, i));
}

void gn_gl_sources_bind(struct gn_gl *gl, const struct gn_plan *plan, const struct gn_pass *pass) {
    const GLuint nearest = gl->targets.map_samplers[GN_GL_MAP_NEAREST];
    const struct gn_pass_picture *picture = &pass->picture;
    for (GLuint i = 0; pass->kind == GN_PASS_FILTER && i < GN_FILTER_FROM_MAX; i++) {
        const struct gn_read *read = &pass->filter.reads[i];
        if (read->kind == GN_READ_NOTHING) continue;
        const uint32_t slot = pass->target.slot;
        struct gn_target target = pass->target;
        target.index = read->index;
        target.mipmaps = read->index == 0 && read->kind == GN_READ_MOMENTS &&
                         gn_view_has_mipmaps(&plan->shadows[slot]);
        target.width_px = read->width_px;
        target.height_px = read->height_px;
        const struct gn_gl_map *map = read->kind == GN_READ_MOMENTS
                                          ? gn_gl_target_find(gl, &target)
                                          : gn_gl_view_find(gl, &plan->shadows[slot], slot, false);
        if (map) gn_gl_bind_texture(gl, GN_GL_UNIT_MAP + i, map->texture, nearest);
    }
    if (pass->kind == GN_PASS_MAP && pass->map.reads_backs) {
        struct gn_target target = pass->target;
        target.kind = GN_TARGET_BACKS;
        const struct gn_gl_map *backs = gn_gl_target_find(gl, &target);
        if (backs) gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, backs->texture, nearest);
    }
    if (pass->kind != GN_PASS_PICTURE) return;
    if (picture->reads_atlas)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, gl->atlas.texture, nearest);
    else if (picture->mean_of)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP,
                           gl->targets.outputs[picture->mean_of - 1].mean_colors[0], nearest);
    else if (pass->target.kind == GN_TARGET_MEAN && pass->target.index == 0)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, gl->targets.output->mean_colors[1], nearest);
    else if (pass->target.kind == GN_TARGET_ENCODED || pass->target.kind == GN_TARGET_MEAN)
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, gl->targets.output->texture, nearest);
    else if (picture->shadow_count == 0) /* no map that compares is left to who does not */
        gn_gl_bind_texture(gl, GN_GL_UNIT_MAP, 0, nearest);
    else
        for (uint32_t i = 0; i < picture->shadow_count; i++) {
            const uint32_t slot = gn_pass_slot(picture, i);
            const struct gn_shadow_view *view = &plan->shadows[slot];
            const struct gn_gl_map *codes =
                picture->reads_codes ? gn_gl_view_find(gl, view, slot, false) : NULL;
            if (!picture->reads_codes)
                bind_map(gl, view, slot, i);
            else if (codes)
                gn_gl_bind_texture(gl, GN_GL_UNIT_MAP + i, codes->texture, nearest);
        }
    for (uint32_t i = 0; i < picture->slide_count; i++) gn_gl_slide_bind(gl, i, picture->slides[i]);
    if (plan->environment.light)
        gn_gl_bind_cube(gl, gl->environment.texture, gl->environment.sampler);
    if (plan->occlusion.on) gn_gl_bind_volume(gl, gl->occlusion.texture, gl->occlusion.sampler);
}

void gn_gl_draw(struct gn_gl *gl, const struct gn_pass *pass, const struct gn_draw *d,
                uint64_t constants_hash, uint32_t first, uint32_t count) {
    struct gn_gl_program *program = gl->plan_programs.at[d->program];
    const bool geometry = d->geometry != GN_NO_GEOMETRY;
    gn_gl_use_program(gl, program->name);
    if (program->constants_hash != constants_hash && program->u_pass >= 0) {
        program->constants_hash = constants_hash;
        GL(gl, Uniform4fv)(program->u_pass, (GLsizei)pass->constant_count, pass->constants[0]);
    }
    if (program->texture_slots) {
        const struct gn_material *material = &gl->scene.scene->materials[d->material];
        for (uint32_t slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
            if (program->texture_slots >> slot & 1) gn_gl_texture_bind(gl, material, slot);
    }
    if (geometry && (program->u_uv >= 0 || program->u_factors >= 0)) {
        const uint32_t number = gl->scene.material_sets[d->material];
        if (program->set != number) {
            const float *set = gl->scene.sets[number][0];
            program->set = number;
            if (program->u_uv >= 0) GL(gl, Uniform4fv)(program->u_uv, GN_GL_TRANSFORMS, set);
            if (program->u_factors >= 0)
                GL(gl, Uniform4fv)(program->u_factors, GN_GL_FACTORS, set + 4 * GN_GL_TRANSFORMS);
        }
    }
    gn_gl_set_cull(gl, geometry ? d->cull : GN_CULL_NONE, geometry && d->mirrored);
    gn_gl_vertices_bind(gl, program->attributes, d->first_instance);
    if (geometry) {
        const size_t at = (gn_gl_first_index(gl, d) + first) * gl->scene.index_size;
        GL(gl, DrawElementsInstanced)
        (GL_TRIANGLES, (GLsizei)count, gl->scene.index_type, (const void *)at,
         (GLsizei)d->instance_count);
    } else {
        GL(gl, DrawArraysInstanced)
        (GL_TRIANGLES, (GLint)first, (GLsizei)count, (GLsizei)d->instance_count);
    }
    gl->stats.draws++;
    gl->stats.shadow_draws += pass->kind != GN_PASS_PICTURE || pass->picture.only_stencil;
    gl->stats.triangles += (uint64_t)count / 3 * d->instance_count;
}
