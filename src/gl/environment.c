/* The cube that ENVIRONMENT programs read: one texture, uploaded when the environment changes. */
#include "gl/private.h"

bool gn_gl_environment_holds(const struct gn_gl *gl,
                             const struct gn_plan_environment *environment) {
    return !environment->light || gl->environment.id == environment->id;
}

static void make_cube(struct gn_gl *gl) {
    struct gn_gl_environment *e = &gl->environment;
    e->texture = gn_gl_object_create(gl, GN_GL_TEXTURE);
    e->sampler = gn_gl_sampler_make(gl, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
    gn_gl_work_on_cube(gl, e->texture);
    GL(gl, TexStorage2D)
    (GL_TEXTURE_CUBE_MAP, GN_ENVIRONMENT_LEVELS, GL_R11F_G11F_B10F, GN_ENVIRONMENT_PX,
     GN_ENVIRONMENT_PX);
}

bool gn_gl_environment_ensure(struct gn_gl *gl, const struct gn_plan_environment *environment,
                              struct gn_err *err) {
    struct gn_gl_environment *e = &gl->environment;
    if (gn_gl_environment_holds(gl, environment)) return true;
    if (e->texture)
        gn_gl_work_on_cube(gl, e->texture);
    else
        make_cube(gl);
    const uint32_t *texels = environment->light->texels;
    for (int level = 0; level < GN_ENVIRONMENT_LEVELS; level++) {
        const GLsizei side = GN_ENVIRONMENT_PX >> level;
        for (GLenum face = 0; face < 6; face++, texels += side * side) GL(gl, TexSubImage2D)
        (GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, 0, 0, side, side, GL_RGB,
         GL_UNSIGNED_INT_10F_11F_11F_REV, texels);
    }
    e->id = environment->id;
    return gn_gl_error_check(gl, "sending the environment", err);
}

void gn_gl_environment_finish(struct gn_gl *gl) {
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &gl->environment.texture);
    gn_gl_object_destroy(gl, GN_GL_SAMPLER, &gl->environment.sampler);
    gl->environment = (struct gn_gl_environment){0};
}
