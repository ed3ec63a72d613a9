/* Programs ahead of time: while one plan is shown, the programs of another are made, one per call.
 * Drivers compile as late as they can, at the first draw, for the state that is set then: so each
 * program draws one pixel with the state of the plan, in a call of its own. Its maps are stand-ins
 * of a few texels, so that a kiosk does not hold the maps of every mode; the first picture of a
 * mode makes them. */
#include "core/memory.h"
#include "gl/private.h"

/* Since so many bytes were allocated. */
static void took(struct gn_gl *gl, struct gn_gl_program *program, uint64_t since) {
    const uint64_t bytes = gn_memory_allocated();
    if (bytes > since) gn_gl_program_took(gl, program, bytes - since);
}

static enum gn_gl_warmth warm_next(struct gn_gl *gl, const struct gn_plan *plan, bool again,
                                   struct gn_err *err) {
    const uint64_t made = gl->programs.made;
    if (!gn_gl_prove(gl, plan)) return GN_GL_WARM_REBUILD;
    if (made != gl->programs.made) return GN_GL_WARM_MORE; /* proofs compile, too */
    gl->targets.wants_stencil |= plan->stencil;
    if (!gn_gl_maps_ensure(gl, plan, err)) return GN_GL_WARM_FAILED;
    uint32_t index = 0; /* of the first not made or drawn yet, or with another scene's vertices */
    for (; index < plan->program_count; index++) {
        if (!again && gn_gl_program_is_dropped(gl, &plan->programs[index])) continue;
        const struct gn_gl_program *p = gn_gl_program_find(gl, &plan->programs[index]);
        if (!p || !p->drawn || !gn_gl_vertices_known(gl, p->attributes)) break;
    }
    if (index == plan->program_count) return GN_GL_WARM_DONE;
    const uint64_t bytes = gn_memory_allocated();
    if (!gn_gl_program_prepare(gl, &plan->programs[index], err)) return GN_GL_WARM_FAILED;
    struct gn_gl_program *p = gn_gl_program_find(gl, &plan->programs[index]);
    if (made != gl->programs.made) { /* its draw is a piece of its own */
        p->bytes = 0;
        took(gl, p, bytes);
        return gn_gl_error_check(gl, "making programs", err) ? GN_GL_WARM_MORE : GN_GL_WARM_FAILED;
    }
    /* A window has formats of its own: the draw goes to a corner of it, if the next picture covers
     * that. */
    struct gn_gl_output *const o = gl->targets.output;
    const bool corner = gl->window.width_px == plan->shown_width_px &&
                        gl->window.height_px == plan->shown_height_px && o->window &&
                        o->scales == gn_plan_scales(plan) && o->format == plan->output && o->made;
    if (!corner && !gn_gl_pixel_ensure(gl, plan, err)) return GN_GL_WARM_FAILED;
    if (!corner) gl->targets.output = &gl->targets.pixel;
    const bool ok = gn_gl_touch(gl, plan, index, err);
    gl->targets.output = o;
    if (!p->drawn) took(gl, p, bytes);
    p->drawn = true;
    return ok && gn_gl_error_check(gl, "making programs", err) ? GN_GL_WARM_MORE
                                                               : GN_GL_WARM_FAILED;
}

static enum gn_gl_warmth warm_plan(struct gn_gl *gl, const struct gn_plan *plan, bool again,
                                   struct gn_err *err) {
    gl->targets.stand_ins = true;
    const enum gn_gl_warmth warmth = warm_next(gl, plan, again, err);
    gl->targets.stand_ins = false;
    return warmth;
}

enum gn_gl_warmth gn_gl_warm(struct gn_gl *gl, const struct gn_plan *plan, bool again,
                             struct gn_err *err) {
    if (plan->scene == gl->scene.scene) return warm_plan(gl, plan, again, err);
    if (!gl->staged || plan->scene != gl->staged->scene) {
        gn_fail(err, "the plan's scene is not loaded");
        return GN_GL_WARM_FAILED;
    }
    gn_gl_staged_swap(gl);
    const enum gn_gl_warmth warmth = warm_plan(gl, plan, again, err);
    gn_gl_staged_swap(gl);
    return warmth;
}

void gn_gl_warm_end(struct gn_gl *gl) { GL(gl, ReleaseShaderCompiler)(); }
