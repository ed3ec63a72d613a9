/* Fonts from files, by FreeType: one that is chosen, and behind it those of packages. Files are
 * untrusted: gn_font_glyph() checks all that FreeType returns. */
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
/* after ft2build.h */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "caption/font.h"
#include "caption/script.h"
#include "caption/shaper.h"
#include "core/arena.h"
#include "core/file.h"
#include "core/text.h"

enum {
    CHAIN_MAX = 64,      /* fonts; their number is in bits 16 to 23 of a glyph's */
    READ_MAX = 64 << 20, /* bytes of a package's font, which is read by parts */
};

struct link { /* a package's font: its place in the chain is that of the first row with its file */
    bool tried;
    FT_Face face; /* NULL: it is not there */
    FT_StreamRec stream;
};
struct file_font {
    struct gn_font font;
    struct gn_bytes bytes; /* owned; empty: of the caller */
    FT_Library library;
    FT_Face face;
    uint32_t size_px;              /* per em, of all */
    const char *folder;            /* NULL: no chain */
    struct link *chain[CHAIN_MAX]; /* by the row of their script; NULL: not needed so far */
};

/* ---- the chain ---- */

/* Large files stay on the disk; FreeType asks for what a text needs. */
static unsigned long read_stream(FT_Stream stream, unsigned long offset, unsigned char *out,
                                 unsigned long count) {
    unsigned long done = 0;
    if (count == 0) return offset > stream->size; /* a seek: 0 is success */
    while (done < count) {
        const ssize_t n =
            pread((int)stream->descriptor.value, out + done, count - done, (off_t)(offset + done));
        if (n <= 0) break;
        done += (unsigned long)n;
    }
    return done;
}

static void close_stream(FT_Stream stream) {
    if (stream->descriptor.value >= 0) close((int)stream->descriptor.value);
    stream->descriptor.value = -1;
}

static FT_Face open_stream(FT_Library library, const char *path, FT_Stream stream) {
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat info;
    FT_Face face = NULL;
    *stream = (FT_StreamRec){.descriptor.value = fd, .read = read_stream, .close = close_stream};
    if (fd >= 0 && fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && info.st_size < READ_MAX) {
        const FT_Open_Args args = {.flags = FT_OPEN_STREAM, .stream = stream};
        stream->size = (unsigned long)info.st_size;
        if (FT_Open_Face(library, &args, 0, &face)) face = NULL;
    }
    if (face &&
        (!FT_IS_SCALABLE(face) || !face->charmap || face->charmap->encoding != FT_ENCODING_UNICODE))
        FT_Done_Face(face), face = NULL;
    if (!face) close_stream(stream);
    return face;
}

/* Where packages put it: Debian's, Alpine's, Arch's, Fedora's. */
static FT_Face open_package_font(struct file_font *f, const char *file, FT_Stream stream) {
    static const char *const folders[] = {
        "truetype/noto", "opentype/noto",    "truetype/dejavu", "truetype/ancient-scripts",
        "noto",          "noto-cjk",         "google-noto",     "dejavu",
        "TTF",           "dejavu-sans-fonts"};
    char path[512];
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        gn_text_format(path, sizeof path, "%s/%s/%s", f->folder, folders[i], file);
        if (access(path, R_OK) != 0) continue;
        FT_Face face = open_stream(f->library, path, stream);
        if (face && FT_Set_Pixel_Sizes(face, 0, f->size_px) == 0) return face;
        if (face) FT_Done_Face(face);
    }
    return NULL;
}

static uint32_t place_of(const struct gn_script *row) {
    uint32_t i = 0;
    while (strcmp(gn_scripts[i].file, row->file) != 0) i++;
    return i;
}

/* Face 0 is the chosen one, others are 1 + their place. */
static FT_Face face_of(const struct file_font *f, uint32_t number) {
    if (number == 0) return f->face;
    return number <= CHAIN_MAX && f->chain[number - 1] ? f->chain[number - 1]->face : NULL;
}

/* The number of the face that has that character, and its glyph there; glyph 0: none has. */
static uint32_t find_face(struct file_font *f, uint32_t code, FT_UInt *glyph) {
    *glyph = FT_Get_Char_Index(f->face, code);
    if (*glyph || !f->folder) return 0;
    for (const struct gn_script *row = NULL; (row = gn_script_next(row, code));) {
        const uint32_t place = place_of(row);
        if (place >= CHAIN_MAX) continue;
        if (!f->chain[place]) f->chain[place] = gn_xalloc(1, sizeof *f->chain[place]);
        struct link *link = f->chain[place];
        if (!link->tried) link->face = open_package_font(f, row->file, &link->stream);
        link->tried = true;
        *glyph = link->face ? FT_Get_Char_Index(link->face, code) : 0;
        if (*glyph) return 1 + place;
    }
    return 0;
}

static bool has_character(struct gn_font *font, uint32_t code) {
    FT_UInt glyph;
    find_face((struct file_font *)font, code, &glyph);
    return glyph;
}

/* ---- one glyph ---- */

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
    f->size_px = size_px;
    for (uint32_t i = 0; i < CHAIN_MAX; i++)
        if (face_of(f, 1 + i)) FT_Set_Pixel_Sizes(face_of(f, 1 + i), 0, size_px);
    const long descent = (63 - (long)f->face->size->metrics.descender) / 64;
    font->line_px = line_px;
    font->ascent_px =
        line_px - (descent < 0 || descent > (long)line_px / 2 ? line_px / 5 : (uint32_t)descent);
    return true;
}

static bool render_glyph(struct gn_font *font, uint32_t code, struct gn_glyph *out) {
    struct file_font *f = (struct file_font *)font;
    const bool shaped = code & GN_FONT_SHAPED;
    FT_UInt index = code & 0xffff;
    const uint32_t number = shaped ? code >> 16 & 0xff : find_face(f, code, &index);
    const FT_Face face = face_of(f, number);
    if (!face || index == 0 || FT_Load_Glyph(face, index, FT_LOAD_NO_BITMAP)) return false;
    const FT_GlyphSlot slot = face->glyph;
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

/* ---- several ---- */

static int32_t kern_px(struct gn_font *font, uint32_t left, uint32_t right) {
    const struct file_font *f = (struct file_font *)font;
    const FT_UInt a = FT_Get_Char_Index(f->face, left), b = FT_Get_Char_Index(f->face, right);
    FT_Vector by = {0};
    if (!FT_HAS_KERNING(f->face) || !a || !b ||
        FT_Get_Kerning(f->face, a, b, FT_KERNING_DEFAULT, &by))
        return 0;
    return (int32_t)(by.x / 64);
}

static uint32_t number_of(const struct file_font *f, const void *face) {
    uint32_t number = 0;
    while (number <= CHAIN_MAX && face_of(f, number) != face) number++;
    return number;
}

static int32_t to_px(int32_t in_64ths) { return (in_64ths + 32) >> 6; }

/* A mark, and what only joins, is of the font of the character before it. */
static uint32_t shape_line(struct gn_font *font, const uint32_t *codes, uint32_t count,
                           struct gn_font_place *out, int32_t *width_px) {
    struct file_font *f = (struct file_font *)font;
    void *faces[GN_FONT_PLACES_MAX];
    struct gn_shaper_glyph glyphs[GN_FONT_PLACES_MAX];
    for (uint32_t i = 0; i < count; i++) {
        FT_UInt glyph;
        const uint32_t number = find_face(f, codes[i], &glyph);
        const bool follows = i > 0 && gn_script_is_mark(codes[i]) &&
                             (!glyph || FT_Get_Char_Index(faces[i - 1], codes[i]));
        faces[i] = follows ? faces[i - 1] : face_of(f, number);
    }
    const uint32_t kept =
        (uint32_t)gn_shaper_run(codes, faces, count, glyphs, GN_FONT_PLACES_MAX, width_px);
    for (uint32_t i = 0; i < kept; i++) {
        const uint32_t number = number_of(f, glyphs[i].face);
        out[i] = (struct gn_font_place){.glyph = GN_FONT_SHAPED | number << 16 |
                                                 (glyphs[i].index & 0xffff),
                                        .x_px = to_px(glyphs[i].x),
                                        .y_px = to_px(glyphs[i].y)};
    }
    *width_px = to_px(*width_px);
    return kept;
}

static void close_file(struct gn_font *font) {
    struct file_font *f = (struct file_font *)font;
    if (f->library) FT_Done_FreeType(f->library); /* and the faces, with their streams */
    for (uint32_t i = 0; i < CHAIN_MAX; i++) free(f->chain[i]);
    gn_bytes_finish(&f->bytes);
    free(f);
}

static const struct gn_font_ops ops = {.resize = resize_face,
                                       .glyph = render_glyph,
                                       .close = close_file,
                                       .has = has_character,
                                       .kern_px = kern_px,
                                       .shape = shape_line};

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

struct gn_font *gn_font_open_in(const char *path, const char *folder, struct gn_err *err) {
    static const char *const places[] = {
        /* Debian's, Alpine's, Arch's, Fedora's */
        "truetype/dejavu/DejaVuSans.ttf",
        "dejavu/DejaVuSans.ttf",
        "TTF/DejaVuSans.ttf",
        "dejavu-sans-fonts/DejaVuSans.ttf",
        "truetype/noto/NotoSans-Regular.ttf",
        "noto/NotoSans-Regular.ttf",
        "truetype/liberation/LiberationSans-Regular.ttf",
        "truetype/freefont/FreeSans.ttf",
    };
    char place[512];
    struct gn_bytes bytes = {0};
    for (size_t i = 0; i < sizeof places / sizeof *places && !path; i++) {
        gn_text_format(place, sizeof place, "%s/%s", folder, places[i]);
        if (access(place, R_OK) == 0) path = place;
    }
    if (!path) {
        gn_fail(err, "there is no font; install fonts-dejavu-core");
        return NULL;
    }
    if (!gn_file_read(path, GN_FONT_BYTES_MAX, &bytes, err)) return NULL;
    struct gn_font *font = gn_font_open_bytes(bytes.data, bytes.size, err);
    if (font) {
        ((struct file_font *)font)->bytes = bytes;
        ((struct file_font *)font)->folder = folder;
    } else {
        gn_bytes_finish(&bytes), gn_fail_prefix(err, "%s", path);
    }
    return font;
}

struct gn_font *gn_font_open_file(const char *path, struct gn_err *err) {
    return gn_font_open_in(path, "/usr/share/fonts", err);
}
