/* Every screen of `gnomon show` over a white and a black scene, measured in pixels: texts lie
 * within 5 % of each side and not over each other, none is cut, and their contrast is 4.5 at least.
 * SCREENS=DIR: the screens of the default scene, as pictures in DIR, for `make screens`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "caption/layout.h"
#include "core/srgb.h"
#include "image/picture.h"
#include "image/screens.h"
#include "unit/check.h"
#include "unit/gl_help.h"

static const char *const sizes[][2] = {{"1280x720", "0"},  {"1920x1080", "0"}, {"1080x1920", "0"},
                                       {"3840x2160", "0"}, {"800x480", "0"},   {"1280x720", "90"},
                                       {"800x480", "180"}};
enum { SIZES = sizeof sizes / sizeof *sizes, CELL_WIDTH = 480, CELL_HEIGHT = 270 };
static const double LEAST_CONTRAST = 4.5;

static double lowest; /* contrast so far, */
static char lowest_at[100];
static const char *size, *turn, *ground_name;

#define FAIL(s, ...)                                                                               \
    do {                                                                                           \
        print_error("%s at %s by %s over %s: ", screen_names[(s)->state], size, turn,              \
                    ground_name);                                                                  \
        fail_msg(__VA_ARGS__);                                                                     \
    } while (0)

/* ---- contrast: of WCAG 2, (lighter + .05) / (darker + .05) of relative luminances ------------ */

static double luminance(const uint8_t *rgba) {
    float linear[3];
    for (int c = 0; c < 3; c++) linear[c] = gn_srgb_decode((float)rgba[c] / 255);
    return (double)gn_luminance(linear);
}

static void expect_contrast(const struct screen_shown *s, double ink, double ground) {
    const double contrast = (fmax(ink, ground) + .05) / (fmin(ink, ground) + .05);
    if (contrast < lowest) {
        lowest = contrast;
        snprintf(lowest_at, sizeof lowest_at, "%s at %s over %s", screen_names[s->state], size,
                 ground_name);
    }
    if (contrast < LEAST_CONTRAST) FAIL(s, "contrast %.2f", contrast);
}

/* ---- a picture and its quads ------------------------------------------------------------------
 */

static uint8_t *inked; /* a pixel each: 0 no glyph covers it, 1 by less than half, 2 by more */

static const uint8_t *pixel_at(const struct screen_shown *s, int x, int y) {
    return s->rgba + 4 * ((size_t)y * s->width_px + (size_t)x);
}

static uint8_t coverage_of(const struct gn_caption_run *run, const struct gn_caption_quad *q, int x,
                           int y) {
    return run->atlas
        ->coverage[(size_t)(q->atlas_y + y) * run->atlas->width_px + q->atlas_x + (size_t)x];
}

static void add_ink(const struct screen_shown *s, const struct gn_caption_quad *q) {
    for (int y = 0; y < q->height; y++)
        for (int x = 0; x < q->width; x++) {
            const uint8_t coverage = coverage_of(s->run, q, x, y);
            uint8_t *mark = &inked[(size_t)(q->y + y) * s->width_px + (size_t)(q->x + x)];
            if (coverage >= 128 && *mark == 2)
                FAIL(s, "a text lies over another one at %d, %d", q->x + x, q->y + y);
            if (coverage > 0 && *mark < 2) *mark = coverage < 128 ? 1 : 2;
        }
}

/* The darkest pixel that a glyph covers wholly is its ink, the lightest one beside it its ground.
 */
static void measure_glyph(const struct screen_shown *s, const struct gn_caption_quad *q) {
    double ink = INFINITY, ground = -INFINITY;
    for (int y = 0; y < q->height; y++)
        for (int x = 0; x < q->width; x++) {
            const double light = luminance(pixel_at(s, q->x + x, q->y + y));
            if (coverage_of(s->run, q, x, y) == 255) ink = fmin(ink, light);
            if (!inked[(size_t)(q->y + y) * s->width_px + (size_t)(q->x + x)])
                ground = fmax(ground, light);
        }
    if (ink < INFINITY && ground > -INFINITY) expect_contrast(s, ink, ground);
}

static void expect_safe(const struct screen_shown *s, const struct gn_caption_quad *q) {
    const int left = (int)s->width_px / 20, top = (int)s->height_px / 20;
    if (q->x < left || q->y < top || q->x + q->width > (int)s->width_px - left ||
        q->y + q->height > (int)s->height_px - top)
        FAIL(s, "%d, %d, %d x %d is outside of the safe area", q->x, q->y, q->width, q->height);
}

static bool overlap(const struct gn_caption_quad *a, const struct gn_caption_quad *b) {
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
           b->y < a->y + a->height;
}

/* Characters that have ink; *less: of them those that a font may draw as one with the one before.
 */
static unsigned count_inked(const char *text, unsigned *less) {
    unsigned count = 0;
    const char *end = text + strlen(text);
    *less = 0;
    for (uint32_t code, before = 0; (code = gn_layout_next(&text, end)) != 0; before = code) {
        count += code > ' ';
        *less += before == 'f' && (code == 'f' || code == 'i' || code == 'l');
    }
    return count;
}

static void expect_whole(const struct screen_shown *s, enum gn_caption_kind kind) {
    const struct gn_caption_run *run = s->run;
    unsigned drawn = 0, less = 0;
    if (!s->texts[kind] || run->alpha[kind] == 0) return;
    for (uint32_t i = 0; i < run->quad_count; i++)
        drawn += run->quads[i].caption == kind && !run->quads[i].ground;
    const unsigned count = count_inked(s->texts[kind], &less);
    if (drawn == 0) return; /* another page is in its place */
    if (drawn < count - less || drawn > count)
        FAIL(s, "%u characters of %u are drawn of \"%s\"", drawn, count, s->texts[kind]);
}

static void measure_run(const struct screen_shown *s) {
    const struct gn_caption_run *run = s->run;
    assert_true(run->width_px == s->width_px && run->height_px == s->height_px);
    inked = calloc((size_t)s->width_px * s->height_px, 1);
    assert_non_null(inked);
    for (uint32_t i = 0; i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        if (run->alpha[q->caption] == 0) continue;
        expect_safe(s, q);
        if (!q->ground) add_ink(s, q);
        for (uint32_t k = 0; q->ground && k < run->quad_count; k++)
            if (run->quads[k].caption != q->caption && run->alpha[run->quads[k].caption] > 0 &&
                overlap(q, &run->quads[k]))
                FAIL(s, "caption %d lies over caption %d", q->caption, run->quads[k].caption);
    }
    for (uint32_t i = 0; i < run->quad_count; i++)
        if (run->alpha[run->quads[i].caption] > 0 && !run->quads[i].ground)
            measure_glyph(s, &run->quads[i]);
    for (int kind = 0; kind < GN_CAPTION_KIND_COUNT; kind++)
        expect_whole(s, (enum gn_caption_kind)kind);
    free(inked);
}

/* Two greys, of which the one that the corner has is the ground. */
static void measure_message(const struct screen_shown *s) {
    const double ground = luminance(pixel_at(s, 0, 0));
    struct gn_caption_quad all = {.x = (int)s->width_px, .y = (int)s->height_px};
    int right = 0, bottom = 0;
    double ink = ground;
    for (int y = 0; y < (int)s->height_px; y++)
        for (int x = 0; x < (int)s->width_px; x++) {
            const uint8_t *p = pixel_at(s, x, y);
            if (memcmp(p, pixel_at(s, 0, 0), 3) == 0) continue;
            ink = fmax(ink, luminance(p));
            all.x = x < all.x ? x : all.x;
            all.y = y < all.y ? y : all.y;
            right = x >= right ? x + 1 : right;
            bottom = y + 1;
        }
    all.width = right - all.x;
    all.height = bottom - all.y;
    expect_safe(s, &all);
    expect_contrast(s, ink, ground);
}

/* White with a dark rim, from the upper edge to the lower one. */
static void expect_line(const struct screen_shown *s) {
    const int x = (int)s->width_px / 2, rows[2] = {0, (int)s->height_px - 1};
    for (int i = 0; i < 2; i++)
        if (luminance(pixel_at(s, x, rows[i])) < 1 || luminance(pixel_at(s, x - 2, rows[i])) > 0)
            FAIL(s, "no line at %d, %d", x, rows[i]);
}

static bool is_message(enum screen_state state) {
    return state == SCREEN_DARK || state == SCREEN_NO_CARD || state == SCREEN_NO_MONITOR;
}

static bool seen[SCREEN_STATES];
static void measure(const struct screen_shown *s) {
    const bool texts[SCREEN_STATES] = {
        [SCREEN_MODE] = 1,      [SCREEN_INFORMATION] = 1, [SCREEN_HELP] = 1,
        [SCREEN_SPLIT] = 1,     [SCREEN_LOADING] = 1,     [SCREEN_PROBLEM] = 1,
        [SCREEN_WRONG_KEY] = 1, [SCREEN_WRONG_FILE] = 1,  [SCREEN_STICK_REFUSED] = 1,
        [SCREEN_NO_SCENE] = 1,  [SCREEN_TRUTH] = 1,       [SCREEN_SPLIT_HELP] = 1};
    seen[s->state] = true;
    if (is_message(s->state)) {
        measure_message(s);
        return;
    }
    if (texts[s->state] && !s->run) FAIL(s, "no text");
    if (s->state == SCREEN_SPLIT || s->state == SCREEN_SPLIT_HELP) expect_line(s);
    if (s->run) measure_run(s);
    for (uint32_t i = 0; s->run && i < s->run->quad_count; i++)
        if (s->state == SCREEN_PROBLEM_INFORMATION && s->run->quads[i].caption == GN_CAPTION_CARD)
            FAIL(s, "the card repeats what the page has");
}

/* A scene of that colour alone: a triangle that has no width, before a background. */
static void write_scene(const char *folder, const char *name, const char *colour) {
    char text[900];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0],\"extras\":"
             "{\"gnomon_background\":[%s]}}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":"
             "[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":[{\"byteLength\":36,\"uri\":"
             "\"data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,"
             "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
             "\"max\":[1,0,1]}]}",
             colour);
    help_write(folder, name, text);
}

static void texts_can_be_read(void **state) {
    (void)state;
    static const char *const grounds[][2] = {{"white.gltf", "1,1,1"}, {"black.gltf", "0,0,0"}};
    const bool full = getenv("GN_FULL");
    char folder[80], path[100];
    snprintf(folder, sizeof folder, "%s", help_folder());
    lowest = INFINITY;
    for (int i = 0; i < SIZES * 2; i++) {
        if (!full && i != 0 && i != 9 && i != 10) continue; /* white, black, on its side */
        size = sizes[i / 2][0];
        turn = sizes[i / 2][1];
        ground_name = grounds[i % 2][0];
        write_scene(folder, ground_name, grounds[i % 2][1]);
        snprintf(path, sizeof path, "%s/%s", folder, ground_name);
        memset(seen, 0, sizeof seen);
        screens_draw(&(struct screen_opts){.scene = path, .size = size, .rotate = turn}, measure);
        for (int k = 0; k < SCREEN_STATES; k++)
            if (!seen[k]) fail_msg("no picture of %s", screen_names[k]);
    }
    help_remove(folder);
    printf("the lowest contrast is %.2f: %s\n", lowest, lowest_at);
}

/* ---- pictures to look at ------------------------------------------------------------------- */

static const char *out;

/* The mean of the pixels that lie in a cell's one, as they are encoded. */
static void shrink(const struct screen_shown *s, int count_x, int count_y, struct gn_picture *to) {
    const int left = (to->width_px - count_x) / 2, top = (to->height_px - count_y) / 2,
              width = (int)s->width_px, height = (int)s->height_px;
    for (int v = 0; v < count_y; v++)
        for (int u = 0; u < count_x; u++) {
            float *rgb = gn_picture_at(to, left + u, top + v), count = 0;
            for (int y = v * height / count_y; y < (v + 1) * height / count_y; y++)
                for (int x = u * width / count_x; x < (u + 1) * width / count_x; x++, count++)
                    for (int c = 0; c < 3; c++) rgb[c] += (float)pixel_at(s, x, y)[c] / 255;
            for (int c = 0; c < 3; c++) rgb[c] /= count;
        }
}

static void write_cell(const struct screen_shown *s) {
    struct gn_picture cell;
    struct gn_err err = {0};
    char path[400];
    const double scale = fmin((double)CELL_WIDTH / s->width_px, (double)CELL_HEIGHT / s->height_px);
    gn_picture_init(&cell, CELL_WIDTH, CELL_HEIGHT, 3);
    shrink(s, (int)(s->width_px * scale), (int)(s->height_px * scale), &cell);
    snprintf(path, sizeof path, "%s/%02d-%s-%s-%s.png", out, (int)s->state, screen_names[s->state],
             size, turn);
    if (!gn_picture_write_png(&cell, path, &err)) fail_msg("%s", err.text);
    gn_picture_finish(&cell);
    if (s->width_px > 1920) return; /* the same as at half the size */
    gn_picture_init(&cell, (int)s->width_px, (int)s->height_px, 3);
    shrink(s, (int)s->width_px, (int)s->height_px, &cell);
    snprintf(path, sizeof path, "%s/whole/%02d-%s-%s-%s.png", out, (int)s->state,
             screen_names[s->state], size, turn);
    if (!gn_picture_write_png(&cell, path, &err)) fail_msg("%s", err.text);
    gn_picture_finish(&cell);
}

static void pictures_of_the_default_scene(void **state) {
    (void)state;
    for (int i = 0; i < SIZES - 1; i++) {
        if (getenv("ONLY") && !strstr(getenv("ONLY"), sizes[i][0])) continue;
        size = sizes[i][0];
        turn = sizes[i][1];
        screens_draw(&(struct screen_opts){.scene = "assets/sundial.glb",
                                           .size = size,
                                           .rotate = turn,
                                           .traces = strcmp(size, "800x480") == 0},
                     write_cell);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(texts_can_be_read)},
                            pictures[] = {cmocka_unit_test(pictures_of_the_default_scene)};
    out = getenv("SCREENS");
    return out ? RUN(pictures) : RUN(tests);
}
