/* Levels of KTX2 to the GPU as the file has them, a few rows of texels or blocks at a time. */
#include "gl/private.h"

/* By what the texture is read as: data, then colour. EAC has no form in sRGB. */
static const GLenum formats[GN_PACKING_COUNT][2] = {
    [GN_PACKING_RGBA8] = {GL_RGBA8, GL_SRGB8_ALPHA8},
    [GN_PACKING_ETC2_RGB] = {GL_COMPRESSED_RGB8_ETC2, GL_COMPRESSED_SRGB8_ETC2},
    [GN_PACKING_ETC2_RGBA1] = {GL_COMPRESSED_RGB8_PUNCHTHROUGH_ALPHA1_ETC2,
                               GL_COMPRESSED_SRGB8_PUNCHTHROUGH_ALPHA1_ETC2},
    [GN_PACKING_ETC2_RGBA] = {GL_COMPRESSED_RGBA8_ETC2_EAC, GL_COMPRESSED_SRGB8_ALPHA8_ETC2_EAC},
    [GN_PACKING_EAC_R] = {GL_COMPRESSED_R11_EAC, GL_COMPRESSED_R11_EAC},
    [GN_PACKING_EAC_R_SIGNED] = {GL_COMPRESSED_SIGNED_R11_EAC, GL_COMPRESSED_SIGNED_R11_EAC},
    [GN_PACKING_EAC_RG] = {GL_COMPRESSED_RG11_EAC, GL_COMPRESSED_RG11_EAC},
    [GN_PACKING_EAC_RG_SIGNED] = {GL_COMPRESSED_SIGNED_RG11_EAC, GL_COMPRESSED_SIGNED_RG11_EAC},
};

bool gn_gl_levels_open(struct gn_gl *gl, uint32_t index) {
    static const uint8_t white[4] = {255, 255, 255, 255};
    struct gn_gl_picture *p = &gl->scene.upload.picture;
    const struct gn_image whole = p->image;
    const uint32_t px[2] = {whole.width_px, whole.height_px};
    const uint32_t longer = px[0] > px[1] ? px[0] : px[1];
    const char *name = gn_packing_names[whole.packing];
    const bool can_read = whole.packing == GN_PACKING_RGBA8 || gl->caps.etc2;
    uint32_t first = 0;
    while (first + 1 < whole.level_count &&
           gn_level_px(longer, first) > (uint32_t)gl->caps.max_texture_px)
        first++;
    const bool fits = gn_level_px(longer, first) <= (uint32_t)gl->caps.max_texture_px;
    if (!can_read || !fits) {
        gn_warn(gl->warnings,
                can_read
                    ? "image %u: %ux%u pixels of %s exceed the texture size of this GPU; shown "
                      "in white"
                    : "image %u: %ux%u pixels of %s, which this OpenGL does not read; shown "
                      "in white",
                index, px[0], px[1], name);
        p->image = (struct gn_image){.width_px = 1, .height_px = 1, .rgba = white};
        return false;
    }
    if (first > 0)
        gn_warn(gl->warnings,
                "image %u: %ux%u pixels exceed the texture size of this GPU; reduced to %ux%u",
                index, px[0], px[1], gn_level_px(px[0], first), gn_level_px(px[1], first));
    p->next = whole.levels + gn_packing_all_bytes(whole.packing, px, first);
    p->image.width_px = gn_level_px(px[0], first);
    p->image.height_px = gn_level_px(px[1], first);
    p->mipmaps = whole.mipmaps;
    p->levels = whole.mipmaps ? (GLsizei)(whole.level_count - first) : 1;
    GL(gl, TexStorage2D)
    (GL_TEXTURE_2D, p->levels, formats[whole.packing][p->texels != GN_GL_DATA],
     (GLsizei)p->image.width_px, (GLsizei)p->image.height_px);
    gl->scene.texture_bytes += gn_packing_all_bytes(
        whole.packing, (uint32_t[]){p->image.width_px, p->image.height_px}, (uint32_t)p->levels);
    return true;
}

/* Rows `first` to `end` of blocks or texels of the level, which has so many pixels. */
static void send_part(struct gn_gl *gl, const struct gn_gl_picture *p, const uint32_t px[2],
                      uint32_t first, uint32_t end) {
    const enum gn_packing packing = p->image.packing;
    const uint32_t side = packing == GN_PACKING_RGBA8 ? 1 : 4;
    const uint64_t row = gn_packing_row_bytes(packing, px[0]);
    const GLint y = (GLint)(first * side);
    const GLsizei height = (GLsizei)((end * side < px[1] ? end * side : px[1]) - first * side);
    if (packing == GN_PACKING_RGBA8) GL(gl, TexSubImage2D)
    (GL_TEXTURE_2D, p->level, 0, y, (GLsizei)px[0], height, GL_RGBA, GL_UNSIGNED_BYTE,
     p->next + row * first);
    else GL(gl, CompressedTexSubImage2D)(GL_TEXTURE_2D, p->level, 0, y, (GLsizei)px[0], height,
                                         formats[packing][p->texels != GN_GL_DATA],
                                         (GLsizei)(row * (end - first)), p->next + row * first);
}

size_t gn_gl_levels_send(struct gn_gl *gl, size_t bytes) {
    struct gn_gl_picture *p = &gl->scene.upload.picture;
    const enum gn_packing packing = p->image.packing;
    const uint32_t px[2] = {gn_level_px(p->image.width_px, (uint32_t)p->level),
                            gn_level_px(p->image.height_px, (uint32_t)p->level)};
    const uint64_t row = gn_packing_row_bytes(packing, px[0]);
    const uint32_t rows = gn_packing_rows(packing, px[1]), left = rows - p->row;
    const uint64_t most = bytes / row > 0 ? bytes / row : 1;
    const uint32_t count = most < left ? (uint32_t)most : left;
    send_part(gl, p, px, p->row, p->row + count);
    p->row += count;
    if (p->row < rows) return count * row;
    p->next += row * rows;
    p->row = 0;
    if (++p->level == p->levels) *p = (struct gn_gl_picture){0};
    return count * row;
}
