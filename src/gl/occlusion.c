/* The volume that OCCLUDED programs read: one texture of the size of the scene's grid, made before
 * there is anything to show, so that no frame makes it. */
#include <string.h>

#include "gl/private.h"

bool gn_gl_occlusion_holds(const struct gn_gl *gl, const struct gn_plan *plan) {
    const struct gn_gl_occlusion *o = &gl->occlusion;
    return !plan->occlusion.on ||
           (memcmp(o->size, plan->scene->occlusion.size, sizeof o->size) == 0 &&
            o->id == plan->occlusion.id);
}

static void make_volume(struct gn_gl *gl, const uint32_t size[3]) {
    struct gn_gl_occlusion *o = &gl->occlusion;
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &o->texture);
    if (!o->sampler) o->sampler = gn_gl_sampler_make(gl, GL_LINEAR, GL_LINEAR);
    o->texture = gn_gl_object_create(gl, GN_GL_TEXTURE);
    gn_gl_work_on_volume(gl, o->texture);
    GL(gl, TexStorage3D)
    (GL_TEXTURE_3D, 1, GL_RGBA8_SNORM, (GLsizei)size[0], (GLsizei)size[1], (GLsizei)size[2]);
    memcpy(o->size, size, sizeof o->size);
}

/* Row by row where nothing is occluded: 1 for each normal. */
static void send_open(struct gn_gl *gl, const uint32_t size[3]) {
    int8_t row[256][4] = {{0}};
    for (int i = 0; i < 256; i++) row[i][3] = 127;
    for (uint32_t z = 0; z < size[2]; z++)
        for (uint32_t y = 0; y < size[1]; y++)
            for (uint32_t x = 0; x < size[0]; x += 256) GL(gl, TexSubImage3D)
    (GL_TEXTURE_3D, 0, (GLint)x, (GLint)y, (GLint)z,
     (GLsizei)(size[0] - x < 256 ? size[0] - x : 256), 1, 1, GL_RGBA, GL_BYTE, row);
}

bool gn_gl_occlusion_ensure(struct gn_gl *gl, const struct gn_plan *plan, struct gn_err *err) {
    struct gn_gl_occlusion *o = &gl->occlusion;
    const uint32_t *size = plan->scene->occlusion.size;
    if (gn_gl_occlusion_holds(gl, plan)) return true;
    if (memcmp(o->size, size, sizeof o->size) != 0)
        make_volume(gl, size);
    else
        gn_gl_work_on_volume(gl, o->texture);
    if (plan->occlusion.texels) GL(gl, TexSubImage3D)
    (GL_TEXTURE_3D, 0, 0, 0, 0, (GLsizei)size[0], (GLsizei)size[1], (GLsizei)size[2], GL_RGBA,
     GL_BYTE, plan->occlusion.texels);
    else send_open(gl, size);
    o->id = plan->occlusion.id;
    return gn_gl_error_check(gl, "sending occlusion", err);
}

void gn_gl_occlusion_finish(struct gn_gl *gl) {
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &gl->occlusion.texture);
    gn_gl_object_destroy(gl, GN_GL_SAMPLER, &gl->occlusion.sampler);
    gl->occlusion = (struct gn_gl_occlusion){0};
}
