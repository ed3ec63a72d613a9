/* Glyphs on the GPU: one texture of bytes, uploaded as a whole when a glyph was added. */
#include "gl/private.h"

bool gn_gl_atlas_holds(const struct gn_gl *gl, const struct gn_caption_atlas *atlas) {
    const struct gn_gl_atlas *a = &gl->atlas;
    return !atlas || (a->generation == atlas->generation && a->width_px == atlas->width_px &&
                      a->height_px == atlas->height_px);
}

/* Rows are a multiple of 4 bytes, GL's default alignment. */
bool gn_gl_atlas_ensure(struct gn_gl *gl, const struct gn_caption_atlas *atlas,
                        struct gn_err *err) {
    struct gn_gl_atlas *a = &gl->atlas;
    if (gn_gl_atlas_holds(gl, atlas)) return true;
    if (!a->texture || a->width_px != atlas->width_px || a->height_px != atlas->height_px) {
        gn_gl_atlas_finish(gl);
        a->texture = gn_gl_texture_make(gl, 1, GL_R8, atlas->width_px, atlas->height_px);
        a->width_px = atlas->width_px;
        a->height_px = atlas->height_px;
    }
    gn_gl_work_on_texture(gl, a->texture);
    GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, 0, 0, 0, (GLsizei)atlas->width_px, (GLsizei)atlas->height_px, GL_RED,
     GL_UNSIGNED_BYTE, atlas->coverage);
    a->generation = atlas->generation;
    return gn_gl_error_check(gl, "sending the glyphs", err);
}

void gn_gl_atlas_finish(struct gn_gl *gl) {
    gn_gl_object_destroy(gl, GN_GL_TEXTURE, &gl->atlas.texture);
    gl->atlas = (struct gn_gl_atlas){0};
}
