/* A good font, broken at random: what is read of it is refused, or glyphs of a moderate size, in
 * time; captions in it stay within their picture and their atlas. The seed is fixed: a failure can
 * be had again by its number.
 *
 *   test_fonts [FIRST [COUNT]]    GN_FULL=1: 20,000 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "caption/atlas.h"
#include "caption/shape.h"
#include "core/clock.h"
#include "core/file.h"
#include "image/dice.h"

static const char path[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
static const char text[] = "The quick brown fox, 0123456789 (jumps) over @#%&/{}[]|~ \x7f";
enum { SECONDS = 2 };

static struct gn_bytes good;

static size_t below(struct gn_dice *dice, size_t n) {
    return (size_t)gn_dice_between(dice, 0, (double)n);
}

/* Half of all changes fall on the directory of tables and what stands first in one. */
static size_t somewhere(struct gn_dice *dice, size_t size) {
    enum { ENTRY = 16, HEAD = 12, TABLES = 18 };
    const size_t entry = HEAD + ENTRY * below(dice, TABLES);
    if (below(dice, 2)) return below(dice, size);
    if (below(dice, 4) == 0) return below(dice, HEAD + ENTRY * TABLES) % size;
    const uint8_t *o = good.data + entry + 8; /* its offset, most significant byte first */
    const size_t table = (size_t)o[0] << 24 | (size_t)o[1] << 16 | (size_t)o[2] << 8 | o[3];
    return (table + below(dice, 64)) % size;
}

static size_t spoil(struct gn_dice *dice, uint8_t *data) {
    size_t size = good.size;
    memcpy(data, good.data, size);
    if (below(dice, 8) == 0) size = 1 + below(dice, size);
    for (size_t i = below(dice, 24); i > 0; i--) {
        static const uint8_t edges[] = {0, 1, 0x7f, 0x80, 0xff};
        data[somewhere(dice, size)] =
            below(dice, 2) ? edges[below(dice, 5)] : (uint8_t)below(dice, 256);
    }
    return size;
}

/* that libraqm shapes, where it is there: through tables of the font that nothing else reads */
static const char letters[] = "A\xcc\x8aVA السلام שָׁלוֹם";
static struct gn_shape shape;

static bool holds(const struct gn_atlas *atlas, const struct gn_atlas_glyph *g) {
    return g->advance_px <= GN_FONT_GLYPH_PX_MAX && g->width_px <= GN_FONT_GLYPH_PX_MAX &&
           g->height_px <= GN_FONT_GLYPH_PX_MAX &&
           (g->width_px == 0 || (g->x + g->width_px <= (int)atlas->picture.width_px &&
                                 g->y + g->height_px <= (int)atlas->picture.height_px));
}

/* NULL, or what is wrong. opened counts those that were. */
static const char *try_font(struct gn_dice *dice, uint8_t *data, unsigned *opened) {
    struct gn_err err = {0};
    const char *wrong = NULL;
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    const size_t size = spoil(dice, data);
    struct gn_atlas atlas = {0};
    struct gn_font *font = gn_font_open_bytes(data, size, &err);
    if (!font && !err.text[0]) wrong = "refused without a word";
    *opened += font != NULL;
    for (uint32_t line = 8; font && line <= 128; line *= 4) {
        if (!gn_font_resize(font, line)) continue;
        if (font->line_px != line || font->ascent_px > line) wrong = "a line of another height";
        for (const char *c = text; *c; c++)
            if (!holds(&atlas, gn_atlas_glyph(&atlas, font, (uint8_t)*c)))
                wrong = "a glyph outside";
        gn_shape_line(&atlas, font, letters, letters + sizeof letters - 1, true, &shape);
        for (uint32_t i = 0; i < shape.count; i++)
            if (!holds(&atlas, gn_atlas_glyph(&atlas, font, shape.places[i].glyph)))
                wrong = "a shaped glyph outside";
    }
    gn_atlas_seal(&atlas);
    gn_atlas_reset(&atlas);
    gn_font_close(font);
    if (gn_clock_process_cpu_ns() - begun_ns > SECONDS * GN_NS_PER_S) wrong = "it took too long";
    return wrong;
}

int main(int argc, char **argv) {
    const unsigned first = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 0;
    const unsigned count = argc > 2            ? (unsigned)strtoul(argv[2], NULL, 10)
                           : getenv("GN_FULL") ? 20000
                                               : 400;
    struct gn_err err = {0};
    unsigned opened = 0;
    if (access(path, R_OK) != 0) {
        puts("skipped: needs fonts-dejavu-core");
        return 77;
    }
    if (!gn_file_read(path, 0, &good, &err)) return puts(err.text), 1;
    struct gn_font *font = gn_font_open_bytes(good.data, good.size, &err);
    if (!font) {
        printf("skipped: %s\n", err.text);
        gn_bytes_finish(&good);
        return 77;
    }
    gn_font_close(font);
    uint8_t *data = malloc(good.size);
    if (!data) return 1;
    const char *wrong = NULL;
    for (unsigned i = first; i < first + count && !wrong; i++) {
        struct gn_dice dice = {i};
        wrong = try_font(&dice, data, &opened);
        if (wrong) printf("FAIL: font %u: %s\n", i, wrong);
    }
    free(data);
    gn_bytes_finish(&good);
    if (!wrong && count >= 100 && (opened < count / 20 || opened > count - count / 20)) {
        printf("FAIL: %u of %u were fonts: it is no test\n", opened, count);
        return 1;
    }
    printf("%u of %u broken fonts were opened\n", opened, count);
    return wrong != NULL;
}
