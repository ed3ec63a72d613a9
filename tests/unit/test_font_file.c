/* Glyphs out of a font's file, against what FreeType says itself. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "caption/font.h"
#include "core/file.h"
#include "unit/check.h"

#if __has_include(<ft2build.h>)
#include <ft2build.h>
#include FT_FREETYPE_H

static const char path[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
static struct gn_font *font;
static FT_Library library;
static FT_Face face;
static struct gn_err err;

static int setup(void **state) {
    (void)state;
    font = gn_font_open_in(path, "/nowhere", &err); /* alone */
    if (!font) return -1;
    return FT_Init_FreeType(&library) || FT_New_Face(library, path, 0, &face) ? -1 : 0;
}

static int teardown(void **state) {
    (void)state;
    gn_font_close(font);
    return FT_Done_FreeType(library);
}

/* The size that it chose, by what it says of the em: an M is about as wide as FreeType's. */
static uint32_t size_for(uint32_t line_px) {
    return (line_px * face->units_per_EM + (uint32_t)(face->ascender - face->descender) / 2) /
           (uint32_t)(face->ascender - face->descender);
}

static void test_glyphs_are_freetypes(void **state) {
    (void)state;
    static const uint32_t lines[] = {8, 20, 30, 45, 90, 128};
    static const uint32_t codes[] = {'A', 'g', 'j', '@', '.', 0xe4, 0x20ac, 0x3a9, 0x416};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        assert_true(gn_font_resize(font, lines[i]));
        assert_int_equal(font->line_px, lines[i]);
        assert_int_equal(FT_Set_Pixel_Sizes(face, 0, size_for(lines[i])), 0);
        for (size_t k = 0; k < sizeof codes / sizeof *codes; k++) {
            struct gn_glyph g;
            assert_true(gn_font_glyph(font, codes[k], &g));
            assert_int_equal(FT_Load_Char(face, codes[k], FT_LOAD_RENDER), 0);
            const FT_Bitmap *b = &face->glyph->bitmap;
            assert_int_equal(g.width_px, b->width);
            assert_int_equal(g.height_px, b->rows);
            assert_int_equal(g.left, face->glyph->bitmap_left);
            assert_int_equal(g.top, face->glyph->bitmap_top);
            assert_int_equal(g.advance_px, face->glyph->advance.x / 64);
            for (uint32_t y = 0; y < b->rows; y++)
                assert_memory_equal(g.coverage + y * g.stride, b->buffer + (long)y * b->pitch,
                                    b->width);
        }
    }
}

/* Lines of text do not touch: letters are within their line, but for a row of some at the top. */
static void test_letters_are_within_their_line(void **state) {
    (void)state;
    for (uint32_t line = 8; line <= 128; line++) {
        assert_true(gn_font_resize(font, line));
        for (uint32_t code = '!'; code <= '~'; code++) {
            struct gn_glyph g;
            assert_true(gn_font_glyph(font, code, &g));
            assert_true(g.top <= (int32_t)font->ascent_px + 1);
            assert_true((int32_t)font->ascent_px - g.top + (int32_t)g.height_px <= (int32_t)line);
        }
    }
}

static void test_a_space_has_room_and_no_dots(void **state) {
    (void)state;
    struct gn_glyph g;
    assert_true(gn_font_resize(font, 30));
    assert_true(gn_font_glyph(font, ' ', &g));
    assert_true(g.advance_px > 3 && g.width_px * g.height_px == 0);
}

static void test_a_character_that_it_lacks(void **state) {
    (void)state;
    struct gn_glyph g;
    assert_false(gn_font_glyph(font, 0x4e00, &g)); /* Chinese */
    assert_false(gn_font_glyph(font, 0x10fffd, &g));
}

static void expect_refused(const char *name, const char *why) {
    struct gn_font *none = gn_font_open_file(name, &err);
    assert_null(none);
    if (!strstr(err.text, name) || !strstr(err.text, why)) fail_msg("%s", err.text);
    err = (struct gn_err){0};
}

static void test_what_is_no_font_is_refused(void **state) {
    (void)state;
    char name[] = "/tmp/gnomon-font-XXXXXX";
    const int fd = mkstemp(name);
    assert_true(fd >= 0);
    expect_refused("/nowhere/font.ttf", "No such file");
    expect_refused("/tmp", "a folder");
    expect_refused(name, "not a scalable Unicode font");
    assert_true(write(fd, "\0\1\0\0 a font?", 13) == 13);
    expect_refused(name, "not a scalable Unicode font");
    assert_int_equal(ftruncate(fd, GN_FONT_BYTES_MAX + 1), 0);
    expect_refused(name, "larger than the limit");
    close(fd);
    unlink(name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_glyphs_are_freetypes),
        cmocka_unit_test(test_letters_are_within_their_line),
        cmocka_unit_test(test_a_space_has_room_and_no_dots),
        cmocka_unit_test(test_a_character_that_it_lacks),
        cmocka_unit_test(test_what_is_no_font_is_refused),
    };
    if (access(path, R_OK) != 0) {
        puts("skipped: needs fonts-dejavu-core");
        return 77;
    }
    return cmocka_run_group_tests(tests, setup, teardown);
}

#else

int main(void) {
    struct gn_err err = {0};
    if (gn_font_open_file(NULL, &err)) return 1;
    puts("skipped: built without FreeType");
    return 77;
}

#endif
