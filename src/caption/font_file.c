/* Fonts from files, by FreeType. The file is untrusted: gn_font_glyph() checks all that FreeType
 * returns. */
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
/* after ft2build.h */
#include <stdlib.h>
#include <unistd.h>

#include "caption/font.h"
#include "core/arena.h"
#include "core/file.h"

struct file_font {
    struct gn_font font;
    struct gn_bytes bytes; /* owned; empty: of the caller */
    FT_Library library;
    FT_Face face;
};

/* Pixels per em so that ascender and descender fit the line; at least half the line's height,
 * whatever the font says about its ascender. */
static bool resize_face(struct gn_font *font, uint32_t line_px) {
    struct file_font *f = (struct file_font *)font;
    const uint32_t tall = (uint32_t)(f->face->ascender > 0 ? f->face->ascender : 0) +
                          (uint32_t)(f->face->descender < 0 ? -f->face->descender : 0);
    const uint32_t em = f->face->units_per_EM;
    uint32_t size_px = tall > em ? (line_px * em + tall / 2) / tall : line_px * 5 / 6;
    if (size_px < line_px / 2) size_px = line_px / 2;
    if (size_px < 1) size_px = 1;
    if (FT_Set_Pixel_Sizes(f->face, 0, size_px)) return false;
    const long descent = (63 - (long)f->face->size->metrics.descender) / 64;
    font->line_px = line_px;
    font->ascent_px =
        line_px - (descent < 0 || descent > (long)line_px / 2 ? line_px / 5 : (uint32_t)descent);
    return true;
}

static bool render_glyph(struct gn_font *font, uint32_t code, struct gn_glyph *out) {
    struct file_font *f = (struct file_font *)font;
    const FT_UInt index = FT_Get_Char_Index(f->face, code);
    if (index == 0 || FT_Load_Glyph(f->face, index, FT_LOAD_NO_BITMAP)) return false;
    const FT_GlyphSlot slot = f->face->glyph;
    if (slot->format != FT_GLYPH_FORMAT_OUTLINE) return false;
    FT_BBox box; /* checked before rendering: an outline may need more memory than there is */
    FT_Outline_Get_CBox(&slot->outline, &box);
    if (box.xMax - box.xMin >= 64 * GN_FONT_GLYPH_PX_MAX ||
        box.yMax - box.yMin >= 64 * GN_FONT_GLYPH_PX_MAX ||
        FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL))
        return false;
    if (slot->bitmap.pixel_mode != FT_PIXEL_MODE_GRAY || slot->bitmap.pitch < 0 ||
        slot->bitmap.num_grays != 256)
        return false;
    out->advance_px = (int32_t)((slot->advance.x + 32) / 64);
    out->left = slot->bitmap_left;
    out->top = slot->bitmap_top;
    out->width_px = slot->bitmap.buffer ? slot->bitmap.width : 0;
    out->height_px = slot->bitmap.buffer ? slot->bitmap.rows : 0;
    out->stride = (size_t)slot->bitmap.pitch;
    out->coverage = slot->bitmap.buffer;
    return true;
}

static void close_file(struct gn_font *font) {
    struct file_font *f = (struct file_font *)font;
    if (f->library) FT_Done_FreeType(f->library); /* and the face */
    gn_bytes_finish(&f->bytes);
    free(f);
}

static const struct gn_font_ops ops = {resize_face, render_glyph, close_file};

struct gn_font *gn_font_open_bytes(const uint8_t *data, size_t size, struct gn_err *err) {
    struct file_font *f = gn_xalloc(1, sizeof *f);
    f->font.ops = &ops;
    const bool opened = size <= GN_FONT_BYTES_MAX && FT_Init_FreeType(&f->library) == 0 &&
                        FT_New_Memory_Face(f->library, data, (FT_Long)size, 0, &f->face) == 0;
    if (opened && FT_IS_SCALABLE(f->face) && f->face->charmap &&
        f->face->charmap->encoding == FT_ENCODING_UNICODE && f->face->units_per_EM > 0 &&
        resize_face(&f->font, 20))
        return &f->font;
    close_file(&f->font);
    gn_fail(err, "not a scalable Unicode font that FreeType can read");
    return NULL;
}

struct gn_font *gn_font_open_file(const char *path, struct gn_err *err) {
    static const char *const places[] = {
        /* Debian's, Alpine's, Arch's, Fedora's */
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
        "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
    };
    struct gn_bytes bytes = {0};
    for (size_t i = 0; i < sizeof places / sizeof *places && !path; i++)
        if (access(places[i], R_OK) == 0) path = places[i];
    if (!path) {
        gn_fail(err, "there is no font; install fonts-dejavu-core");
        return NULL;
    }
    if (!gn_file_read(path, GN_FONT_BYTES_MAX, &bytes, err)) return NULL;
    struct gn_font *font = gn_font_open_bytes(bytes.data, bytes.size, err);
    if (font)
        ((struct file_font *)font)->bytes = bytes;
    else
        gn_bytes_finish(&bytes), gn_fail_prefix(err, "%s", path);
    return font;
}
