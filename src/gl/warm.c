/* Programs ahead of time: while one plan is shown, what another will want is made, a piece a call.
 * Drivers compile as late as they can, at the first draw, for the state that they then find: so
 * each program is drawn with once as the plan will, on one pixel. */
#include "gl/private.h"

static void swap_outputs(struct gn_gl *gl) {
    const struct gn_gl_output output = gl->targets.output;
    gl->targets.output = gl->targets.pixel;
    gl->targets.pixel = output;
}

/* A window has formats of its own: there the draw goes to a corner of it, if it is about to be
 * painted over. */
static bool goes_to_corner(const struct gn_gl *gl, const struct gn_plan *plan) {
    return gl->window.width_px == plan->width_px && gl->window.height_px == plan->height_px &&
           gl->targets.output.window && gl->targets.output.format == plan->output &&
           gl->targets.output.made;
}

static enum gn_gl_warmth warm_program(struct gn_gl *gl, const struct gn_plan *plan, uint32_t index,
                                      struct gn_err *err) {
    if (!gn_gl_program_prepare(gl, &plan->programs[index], err)) return GN_GL_WARM_FAILED;
    const bool corner = goes_to_corner(gl, plan);
    if (!corner && !gn_gl_pixel_ensure(gl, plan, err)) return GN_GL_WARM_FAILED;
    if (!corner) swap_outputs(gl);
    const bool ok = gn_gl_touch(gl, plan, index, err);
    if (!corner) swap_outputs(gl);
    return ok && gn_gl_error_check(gl, "making programs", err) ? GN_GL_WARM_MORE
                                                               : GN_GL_WARM_FAILED;
}

/* Made before, but with vertices of another scene. */
static bool is_program_ready(struct gn_gl *gl, const struct gn_program_key *key) {
    const struct gn_gl_program *p = gn_gl_program_find(gl, key);
    return p && gn_gl_vertices_known(gl, p->attributes);
}

static enum gn_gl_warmth warm_plan(struct gn_gl *gl, const struct gn_plan *plan,
                                   struct gn_err *err) {
    const uint64_t made = gl->programs.made;
    if (!gn_gl_prove(gl, plan)) return GN_GL_WARM_REBUILD;
    if (made != gl->programs.made) return GN_GL_WARM_MORE; /* proofs compile, too */
    gl->targets.wants_stencil |= plan->stencil;
    if (!gn_gl_maps_ensure(gl, plan, err)) return GN_GL_WARM_FAILED;
    for (uint32_t i = 0; i < plan->program_count; i++)
        if (!is_program_ready(gl, &plan->programs[i])) return warm_program(gl, plan, i, err);
    return GN_GL_WARM_DONE;
}

enum gn_gl_warmth gn_gl_warm(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    if (plan->scene == gl->scene.scene) return warm_plan(gl, plan, err);
    if (!gl->staged || plan->scene != gl->staged->scene) {
        gn_fail(err, "the plan's scene is not loaded");
        return GN_GL_WARM_FAILED;
    }
    gn_gl_stage_swap(gl);
    const enum gn_gl_warmth warmth = warm_plan(gl, plan, err);
    gn_gl_stage_swap(gl);
    return warmth;
}

void gn_gl_warm_end(struct gn_gl *gl) { GL(gl, ReleaseShaderCompiler)(); }
