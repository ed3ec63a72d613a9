/* Texts in twelve scripts: each is drawn, or what is missing is named with its package. A line from
 * right to left against a second opinion, a picture of pango-view. GN_KEEP=FOLDER keeps pictures.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "caption/layout.h"
#include "caption/script.h"
#include "caption/shape.h"
#include "caption/shaper.h"
#include "core/file.h"
#include "image/read.h"
#include "image/write.h"
#include "unit/check.h"

static const char dejavu[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
static const struct {
    const char *name, *text, *package; /* that is named where DejaVu alone is there; NULL: none */
} scripts[] = {
    {"Latin", "\xc3\x84gypten, \xc5\x81\xc3\xb3\x64\xc5\xba", NULL},
    {"Greek", "Σκιά και φως", NULL},
    {"Cyrillic", "Солнечные часы", NULL},
    {"Arabic", "ساعة شمسية", NULL},
    {"Hebrew", "שעון שמש", NULL},
    {"Georgian", "მზის საათი", NULL},
    {"Devanagari", "धूपघड़ी की छाया", "Devanagari (fonts-noto-core)"},
    {"Bengali", "সূর্যঘড়ি", "Bengali (fonts-noto-core)"},
    {"Tamil", "சூரிய கடிகாரம்", "Tamil (fonts-noto-core)"},
    {"Thai", "นาฬิกาแดดที่นี่", "Thai (fonts-noto-core)"},
    {"Chinese", "日晷的影子", "Chinese and Japanese (fonts-noto-cjk)"},
    {"Japanese", "ひどけい", "Japanese (fonts-noto-cjk)"},
    {"Korean", "해시계", "Korean (fonts-noto-cjk)"},
    {"emoji", "🌞🦒", "emoji (fonts-symbola)"},
};
enum { COUNT = sizeof scripts / sizeof *scripts, LINE = 56, WIDE = 1024, TALL = 2 * LINE };

static struct gn_atlas atlas;
static struct gn_shape shape;
static struct gn_err err;

struct picture {
    uint8_t grey[TALL * WIDE]; /* 255 is ink */
    int left, right, top, bottom;
};

static struct gn_font *open_font(const char *folder) {
    struct gn_font *font = gn_font_open_in(dejavu, folder, &err);
    if (!font) fail_msg("%s", err.text);
    assert_true(gn_font_resize(font, LINE));
    return font;
}

static void find_ink(struct picture *p) {
    p->left = WIDE, p->right = 0, p->top = TALL, p->bottom = 0;
    for (int y = 0; y < TALL; y++)
        for (int x = 0; x < WIDE; x++)
            if (p->grey[y * WIDE + x] > 127) {
                if (x < p->left) p->left = x;
                if (x >= p->right) p->right = x + 1;
                if (y < p->top) p->top = y;
                if (y >= p->bottom) p->bottom = y + 1;
            }
}

static void draw(struct gn_font *font, struct picture *p) {
    memset(p, 0, sizeof *p);
    for (uint32_t i = 0; i < shape.count; i++) {
        const struct gn_font_place *place = &shape.places[i];
        const struct gn_atlas_glyph *g = gn_atlas_glyph(&atlas, font, place->glyph);
        const int x = 20 + place->x_px + g->left, y = LINE * 5 / 4 - place->y_px - g->top;
        for (int row = 0; row < g->height_px; row++)
            for (int column = 0; column < g->width_px; column++) {
                const uint8_t ink =
                    atlas.picture.coverage[(uint32_t)(g->y + row) * atlas.picture.width_px +
                                           (uint32_t)(g->x + column)];
                if (y + row < 0 || y + row >= TALL || x + column < 0 || x + column >= WIDE)
                    continue;
                uint8_t *at = &p->grey[(y + row) * WIDE + x + column];
                if (ink > *at) *at = ink;
            }
    }
    find_ink(p);
}

static void keep(const struct picture *p, const char *name) {
    static uint8_t rgba[TALL * WIDE * 4];
    char path[300];
    if (!getenv("GN_KEEP")) return;
    for (int i = 0; i < TALL * WIDE; i++)
        memset(rgba + 4 * i, 255 - p->grey[i], 3), rgba[4 * i + 3] = 255;
    snprintf(path, sizeof path, "%s/%s.png", getenv("GN_KEEP"), name);
    if (!gn_picture_write_png8(path, rgba, WIDE, TALL, true, &err)) fail_msg("%s", err.text);
}

static void shape_text(struct gn_font *font, const char *text) {
    gn_shape_line(&atlas, font, text, text + strlen(text), false, &shape);
}

/* With all that this machine has: no box, or the package is named. */
static void test_each_script_is_drawn_or_named(void **state) {
    (void)state;
    struct gn_font *font = open_font("/usr/share/fonts");
    for (int i = 0; i < COUNT; i++) {
        static struct picture picture;
        char missing[300] = "";
        const bool named = gn_shape_find_missing(font, scripts[i].text, missing, sizeof missing);
        shape_text(font, scripts[i].text);
        assert_true(shape.count > 0);
        struct gn_glyph glyph;
        bool boxes = false;
        for (uint32_t k = 0; k < shape.count; k++)
            boxes |= !gn_font_glyph(font, shape.places[k].glyph, &glyph);
        if (boxes && !named) fail_msg("%s: boxes, and nothing is named", scripts[i].name);
        if (named) printf("%s: missing: %s\n", scripts[i].name, missing);
        draw(font, &picture);
        assert_true(picture.right > picture.left);
        assert_true(abs(picture.right - 20 - shape.width_px) < LINE / 2);
        keep(&picture, scripts[i].name);
    }
    gn_atlas_reset(&atlas);
    gn_font_close(font);
}

static void test_what_is_missing_is_named_once(void **state) {
    (void)state;
    struct gn_font *font = open_font("/nowhere");
    char all[1024] = "";
    for (int i = 0; i < COUNT; i++) {
        char missing[300] = "";
        gn_shape_find_missing(font, scripts[i].text, missing, sizeof missing);
        char *joins = strstr(missing, "letters that join (libraqm0)");
        if (joins) joins[joins > missing ? -2 : 0] = '\0';
        assert_string_equal(missing, scripts[i].package ? scripts[i].package : "");
        gn_shape_find_missing(font, scripts[i].text, all, sizeof all);
        gn_shape_find_missing(font, scripts[i].text, all, sizeof all);
    }
    const char *thai = strstr(all, "Thai");
    assert_non_null(thai);
    assert_null(strstr(thai + 1, "Thai"));
    char other[100] = "";
    assert_true(gn_shape_find_missing(font, "\xf0\x92\x80\x80", other, sizeof other));
    assert_string_equal(other, "U+12000 (no package is known)");
    gn_font_close(font);
}

static bool is_shaped(void) {
    if (gn_shaper_open(&err)) return true;
    printf("not tested: %s\n", err.text);
    return false;
}

/* Marks stand on their letters, and joined letters take less room than apart. */
static void test_letters_join_and_stack(void **state) {
    (void)state;
    struct gn_font *font = open_font("/usr/share/fonts");
    if (is_shaped()) {
        shape_text(font, "A\xcc\x8a"); /* A and a ring */
        const int32_t ring = shape.width_px;
        shape_text(font, "A");
        assert_int_equal(ring, shape.width_px);
        shape_text(font, "سلام");
        assert_true(shape.count > 0 && shape.count < 5);
        const int32_t together = shape.width_px;
        int32_t apart = 0;
        static const char *const letters[] = {"س", "ل", "ا", "م"};
        for (int i = 0; i < 4; i++) shape_text(font, letters[i]), apart += shape.width_px;
        assert_true(together < apart * 9 / 10);
        /* a Persian word whose parts do not join: U+200C keeps them apart */
        shape_text(font, "می\xe2\x80\x8cخواهم");
        const int32_t kept_apart = shape.width_px;
        shape_text(font, "میخواهم");
        assert_true(kept_apart > shape.width_px);
    }
    gn_atlas_reset(&atlas);
    gn_font_close(font);
}

static void read_pango(const char *text, struct picture *p) {
    char path[] = "/tmp/gnomon-pango-XXXXXX", command[600];
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    close(fd);
    snprintf(command, sizeof command,
             "pango-view --dpi=72 --font='DejaVu Sans 48' --margin=0 --hinting=full "
             "--hint-metrics=on -q -o %s.png --text='%s' 2> /dev/null",
             path, text);
    assert_int_equal(system(command), 0);
    strcpy(command, path);
    strcat(command, ".png");
    struct gn_bytes bytes = {0};
    uint32_t px[2];
    if (!gn_file_read(command, 0, &bytes, &err) || !gn_png_size(bytes.data, bytes.size, px, &err))
        fail_msg("%s", err.text);
    assert_true(px[0] <= WIDE && px[1] <= TALL);
    uint8_t *rgba = malloc((size_t)px[0] * px[1] * 4);
    assert_true(gn_png_read(bytes.data, bytes.size, px, 0, rgba, &err));
    memset(p, 0, sizeof *p);
    for (uint32_t y = 0; y < px[1]; y++)
        for (uint32_t x = 0; x < px[0]; x++)
            p->grey[y * WIDE + x] = (uint8_t)(255 - rgba[(y * px[0] + x) * 4]);
    find_ink(p);
    free(rgba);
    gn_bytes_finish(&bytes);
    unlink(command);
    unlink(path);
}

/* Root mean square of the difference, 0..1, with both inks' upper left corners on each other. */
static double difference(const struct picture *a, const struct picture *b) {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < a->bottom - a->top; y++)
        for (int x = 0; x < a->right - a->left; x++, count++) {
            const int other = y + b->top < TALL && x + b->left < WIDE
                                  ? b->grey[(y + b->top) * WIDE + x + b->left]
                                  : 0;
            const double by = (a->grey[(y + a->top) * WIDE + x + a->left] - other) / 255.0;
            sum += by * by;
        }
    return sqrt(sum / count);
}

static void test_a_line_from_right_to_left_is_pangos(void **state) {
    (void)state;
    static const char *const texts[] = {"السلام عليكم", "שעון שמש", "Café 12"};
    static struct picture ours, pangos, plain;
    if (!is_shaped() || system("pango-view --version > /dev/null 2>&1") != 0) {
        puts("not tested: needs pango1.0-tools and libraqm0");
        return;
    }
    struct gn_font *font = open_font("/usr/share/fonts");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        read_pango(texts[i], &pangos);
        shape_text(font, texts[i]);
        draw(font, &ours);
        keep(&ours, "ours");
        keep(&pangos, "pangos");
        const int wide = pangos.right - pangos.left;
        const double by = difference(&pangos, &ours);
        printf("%s: %d pixels wide, pango-view's %d; difference %.3f\n", texts[i],
               ours.right - ours.left, wide, by);
        assert_in_range(ours.right - ours.left, wide - wide / 100 - 1, wide + wide / 100 + 1);
        assert_in_range(ours.bottom - ours.top, pangos.bottom - pangos.top - 1,
                        pangos.bottom - pangos.top + 1);
        assert_true(by < 0.05);
        if (i == 2) continue;
        /* the same letters one behind the other are another picture */
        uint32_t count = 0;
        const char *at = texts[i], *end = at + strlen(at);
        shape.width_px = 0;
        for (uint32_t code; (code = gn_layout_next(&at, end)) != 0;) {
            shape.places[count++] = (struct gn_font_place){code, shape.width_px, 0};
            shape.width_px += gn_atlas_glyph(&atlas, font, code)->advance_px;
        }
        shape.count = count;
        draw(font, &plain);
        assert_true(difference(&pangos, &plain) > 2.0 * by);
    }
    gn_atlas_reset(&atlas);
    gn_font_close(font);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_script_is_drawn_or_named),
        cmocka_unit_test(test_what_is_missing_is_named_once),
        cmocka_unit_test(test_letters_join_and_stack),
        cmocka_unit_test(test_a_line_from_right_to_left_is_pangos),
    };
    struct gn_font *font = gn_font_open_file(dejavu, &err);
    if (!font) {
        printf("skipped: %s\n", err.text);
        return 77;
    }
    gn_font_close(font);
    return RUN(tests);
}
