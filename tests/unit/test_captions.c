#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "caption/captions.h"
#include "caption/dot_font.h"
#include "core/arena.h"
#include "image/dice.h"
#include "unit/check.h"

enum { WIDTH = 640, HEIGHT = 480, LINE = 30, DOT = 3 /* of a mode's name */ };
#define MS INT64_C(1000000)

static struct gn_captions *captions;
static struct gn_warnings warnings;

/* In the font inside the program: every dot is known. */
static int setup(void **state) {
    (void)state;
    warnings = (struct gn_warnings){0};
    captions = gn_captions_create(&(struct gn_captions_opts){.font = "", .warnings = &warnings});
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_captions_destroy(captions);
    return 0;
}

static const struct gn_caption_run *run_at(int64_t now_ns) {
    return gn_captions_run(captions, WIDTH, HEIGHT, now_ns);
}

/* ---- time ---- */

static void test_frames_are_asked_for_when_they_differ(void **state) {
    (void)state;
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 5000 * MS);
    assert_true(gn_captions_next_ns(captions) == 0);
    assert_non_null(run_at(5001 * MS));
    assert_true(gn_captions_next_ns(captions) == 6600 * MS);
    assert_non_null(run_at(6800 * MS));
    assert_true(gn_captions_next_ns(captions) == 0); /* it fades */
    assert_non_null(run_at(6990 * MS));
    assert_true(gn_captions_next_ns(captions) == 0); /* the last one has still to go */
    assert_null(run_at(7003 * MS));
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
}

static void test_what_stays_asks_for_one_frame(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_TEXT, "No scene", 0);
    assert_true(gn_captions_next_ns(captions) == 0);
    assert_non_null(run_at(1));
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
    gn_captions_set(captions, GN_CAPTION_TEXT, "No scene", 2);
    assert_true(gn_captions_next_ns(captions) == INT64_MAX); /* the same */
    gn_captions_set(captions, GN_CAPTION_TEXT, NULL, 3);
    assert_true(gn_captions_next_ns(captions) == 0);
    assert_null(run_at(4));
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
}

static void test_a_mode_named_again_starts_again(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 0);
    run_at(1900 * MS);
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 1901 * MS);
    assert_true(gn_captions_next_ns(captions) == 0);
    assert_true(run_at(1902 * MS)->alpha[GN_CAPTION_MODE] == 1.0f);
    assert_true(gn_captions_next_ns(captions) == 3501 * MS);
}

/* ---- where ---- */

/* A ground has several rectangles: its corners are round. */
static struct gn_caption_quad ground_of(const struct gn_caption_run *run,
                                        enum gn_caption_kind kind) {
    struct gn_caption_quad all = {.x = WIDTH, .y = HEIGHT};
    int32_t right = 0, bottom = 0;
    for (uint32_t i = 0; i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        if (!q->ground || q->caption != kind) continue;
        if (q->x < all.x) all.x = q->x;
        if (q->y < all.y) all.y = q->y;
        if (q->x + q->width > right) right = q->x + q->width;
        if (q->y + q->height > bottom) bottom = q->y + q->height;
    }
    if (right == 0) fail_msg("no ground");
    all.width = right - all.x;
    all.height = bottom - all.y;
    return all;
}

/* The i-th that is no ground; NULL: there are fewer. */
static const struct gn_caption_quad *glyph_of(const struct gn_caption_run *run, uint32_t i) {
    for (uint32_t k = 0; k < run->quad_count; k++)
        if (!run->quads[k].ground && i-- == 0) return &run->quads[k];
    return NULL;
}

static void test_a_card_ends_and_a_mark_stays(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_CARD, "Wrong\nLine 3\nCorrect it", 0);
    gn_captions_set(captions, GN_CAPTION_MARK, "!", 0);
    const struct gn_caption_run *run = run_at(29500 * MS);
    assert_true(run->alpha[GN_CAPTION_CARD] == 1.0f);
    const struct gn_caption_quad mark = ground_of(run, GN_CAPTION_MARK);
    assert_true(mark.x + mark.width <= WIDTH * 95 / 100 && mark.y >= HEIGHT * 5 / 100);
    assert_in_range(mark.width, 2 * HEIGHT / 100, 3 * HEIGHT / 100);
    assert_true(gn_captions_next_ns(captions) == 29600 * MS);
    assert_true(run_at(30001 * MS)->alpha[GN_CAPTION_CARD] == 0.0f);
    assert_true(run_at(30001 * MS)->alpha[GN_CAPTION_MARK] == 1.0f);
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
}

static void test_a_mode_is_at_the_lower_left(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Hi", 0);
    const struct gn_caption_run *run = run_at(0);
    assert_true(glyph_of(run, 1) && !glyph_of(run, 2));
    const struct gn_caption_quad g = ground_of(run, GN_CAPTION_MODE);
    assert_int_equal(g.x, WIDTH / 20 + 1);
    assert_int_equal(g.width, 2 * GN_DOT_FONT_WIDTH * DOT + 2 * (LINE * 3 / 5));
    assert_int_equal(g.height, LINE + 2 * (LINE * 7 / 20));
    assert_int_equal(g.y + g.height, HEIGHT - HEIGHT / 20 - 1);
}

/* Dot by dot, as the font has them: H of 17 dots, i of 9. */
static void test_glyphs_are_those_of_the_font(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Hi", 0);
    const struct gn_caption_run *run = run_at(0);
    for (uint32_t i = 1; i <= 2; i++) {
        const struct gn_caption_quad *q = glyph_of(run, i - 1);
        const uint8_t *rows = gn_dot_font_rows((uint32_t) "Hi"[i - 1]);
        uint32_t set = 0;
        assert_int_equal(q->width, GN_DOT_FONT_COLUMNS * DOT);
        assert_int_equal(q->height, GN_DOT_FONT_ROWS * DOT);
        for (int32_t y = 0; y < q->height; y++)
            for (int32_t x = 0; x < q->width; x++) {
                const uint8_t at =
                    run->atlas->coverage[(uint32_t)(q->atlas_y + y) * run->atlas->width_px +
                                         (uint32_t)(q->atlas_x + x)];
                assert_int_equal(at, rows[y / DOT] >> (4 - x / DOT) & 1 ? 255 : 0);
                set += at > 0;
            }
        assert_int_equal(set, (i == 1 ? 17 : 9) * DOT * DOT);
    }
    assert_int_equal(glyph_of(run, 1)->x - glyph_of(run, 0)->x, GN_DOT_FONT_WIDTH * DOT);
}

/* No pixel is darkened twice; corners are, or are not, by a radius of a fifth of the line. */
static void test_grounds_are_round(void **state) {
    (void)state;
    static uint8_t times[HEIGHT][WIDTH];
    gn_captions_set(captions, GN_CAPTION_MODE, "Hi", 0);
    const struct gn_caption_run *run = run_at(0);
    const struct gn_caption_quad g = ground_of(run, GN_CAPTION_MODE);
    memset(times, 0, sizeof times);
    for (uint32_t i = 0; i < run->quad_count; i++)
        for (int32_t y = 0; y < run->quads[i].height && run->quads[i].ground; y++)
            for (int32_t x = 0; x < run->quads[i].width; x++)
                times[run->quads[i].y + y][run->quads[i].x + x] += run->quads[i].faint ? 2 : 1;
    for (int32_t y = 0; y < g.height; y++)
        for (int32_t x = 0; x < g.width; x++) {
            const int32_t r = LINE / 5, in_x = x < g.width - 1 - x ? x : g.width - 1 - x,
                          in_y = y < g.height - 1 - y ? y : g.height - 1 - y;
            const double dx = r - in_x - 0.5, dy = r - in_y - 0.5,
                         out = in_x < r && in_y < r ? sqrt(dx * dx + dy * dy) - r : -1.0;
            const uint8_t found = times[g.y + y][g.x + x];
            assert_true(out > 1.0 ? found == 0 : out < -1.0 ? found == 1 : found <= 2);
        }
}

static void test_labels_are_at_the_line_while_it_is_there(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_LEFT, "Soft", 0);
    gn_captions_set(captions, GN_CAPTION_RIGHT, "Sharp", 0);
    assert_true(!run_at(0) || run_at(0)->quad_count == 0);
    gn_captions_set_split(captions, 0.5);
    assert_true(gn_captions_next_ns(captions) == 0);
    const struct gn_caption_run *run = run_at(3600000 * MS);
    const struct gn_caption_quad left = ground_of(run, GN_CAPTION_LEFT);
    assert_in_range(WIDTH / 2 - left.x - left.width, 1, LINE / 2);
    assert_int_equal(run->alpha[GN_CAPTION_LEFT], 1);
    assert_int_equal(run->alpha[GN_CAPTION_RIGHT], 1);
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
    gn_captions_set_split(captions, -1.0);
    assert_true(!run_at(3600001 * MS) || run_at(3600001 * MS)->quad_count == 0);
}

static bool overlap(struct gn_caption_quad a, struct gn_caption_quad b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

static void test_captions_do_not_cover_each_other(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 0);
    gn_captions_set(captions, GN_CAPTION_TEXT,
                    "kiosk.ini:3: an error that is longer than a line of this picture is", 0);
    gn_captions_set(captions, GN_CAPTION_INFO, "gnomon\nMode: Soft\nAddress: none", 0);
    const struct gn_caption_run *run = run_at(0);
    const struct gn_caption_quad mode = ground_of(run, GN_CAPTION_MODE),
                                 error = ground_of(run, GN_CAPTION_TEXT),
                                 info = ground_of(run, GN_CAPTION_INFO);
    assert_false(overlap(mode, error) || overlap(mode, info) || overlap(error, info));
    assert_true(info.y < mode.y && mode.y < error.y);
    assert_true(error.height > 2 * 20); /* it is wrapped */
}

static void test_text_grows_with_the_picture(void **state) {
    (void)state;
    static const uint32_t sizes[][3] = {
        {640, 480, 20}, {1280, 720, 30}, {1920, 1080, 50}, {3840, 2160, 90}, {720, 1280, 30}};
    gn_captions_set(captions, GN_CAPTION_TEXT, "Hi", 0);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const struct gn_caption_run *run = gn_captions_run(captions, sizes[i][0], sizes[i][1], 0);
        assert_int_equal(run->width_px, sizes[i][0]);
        assert_int_equal(run->height_px, sizes[i][1]);
        assert_int_equal(glyph_of(run, 0)->height, sizes[i][2] * GN_DOT_FONT_ROWS / 10);
    }
}

static void test_no_text_is_no_run(void **state) {
    (void)state;
    static const char *const texts[] = {"", " ", "\n\n", "\x01\x02", "\xe2\x80\x8b", " \t "};
    assert_null(run_at(0));
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        gn_captions_set(captions, GN_CAPTION_TEXT, texts[i], 0);
        assert_null(run_at(0));
    }
}

static void test_unknown_characters_are_boxes(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "\xe6\x97\xa5\xff", 0); /* one, and what is none */
    const struct gn_caption_run *run = run_at(0);
    const uint32_t stride = run->atlas->width_px;
    assert_true(glyph_of(run, 1) && !glyph_of(run, 2));
    for (uint32_t i = 0; i < 2; i++) {
        const struct gn_caption_quad *q = glyph_of(run, i);
        const uint8_t *at = run->atlas->coverage + q->atlas_y * stride + q->atlas_x;
        assert_int_equal(at[0], 255);
        assert_int_equal(at[(uint32_t)(q->height - 1) * stride + (uint32_t)q->width - 1], 255);
        assert_int_equal(at[(uint32_t)(q->height / 2) * stride + (uint32_t)q->width / 2], 0);
    }
}

static void test_what_is_missing_is_said_once(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Hi", 0);
    run_at(0);
    assert_string_equal(gn_captions_missing(captions), "");
    for (int i = 0; i < 3; i++) {
        gn_captions_set(captions, GN_CAPTION_MODE, i % 2 ? "ไทย 한" : "한", 0);
        run_at(0);
    }
    assert_string_equal(gn_captions_missing(captions),
                        "Korean (fonts-noto-cjk), Thai (fonts-noto-core)");
    assert_int_equal(warnings.count, 2);
    assert_string_equal(
        warnings.text[1],
        "texts: missing here: Thai (fonts-noto-core); install the packages in brackets");
}

/* ---- work ---- */

static void test_frames_with_the_same_text_do_no_work(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 0);
    gn_captions_set(captions, GN_CAPTION_TEXT, "kiosk.ini:3: no such mode", 0);
    const struct gn_caption_run *first = run_at(0);
    const uint64_t generation = first->atlas->generation;
    const uint32_t count = first->quad_count;
    const unsigned long allocations = gn_alloc_count();
    for (int64_t ms = 0; ms < 2500; ms += 16) {
        const struct gn_caption_run *run = run_at(ms * MS);
        assert_ptr_equal(run, first);
        assert_int_equal(run->quad_count < count, ms >= 2000); /* the mode's name is gone */
        assert_int_equal(run->atlas->generation, generation);
    }
    assert_int_equal(gn_alloc_count(), allocations);
}

static void test_known_glyphs_are_not_made_again(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_INFO, "0123456789: frames", 0);
    const uint64_t generation = run_at(0)->atlas->generation;
    gn_captions_set(captions, GN_CAPTION_INFO, "59.8 frames: 3", 0);
    assert_true(run_at(0)->atlas->generation != generation); /* the full stop */
    const uint64_t more = run_at(0)->atlas->generation;
    const unsigned long allocations = gn_alloc_count();
    gn_captions_set(captions, GN_CAPTION_INFO, "60.1 frames: 5", 0);
    assert_int_equal(run_at(0)->atlas->generation, more);
    assert_int_equal(gn_alloc_count(), allocations);
}

/* What a GPU holds of one is good for the other. */
static void test_equal_atlases_have_equal_generations(void **state) {
    (void)state;
    struct gn_captions *other = gn_captions_create(&(struct gn_captions_opts){.font = ""});
    gn_captions_set(captions, GN_CAPTION_TEXT, "one", 0);
    gn_captions_set(other, GN_CAPTION_TEXT, "two", 0);
    const uint64_t a = run_at(0)->atlas->generation;
    assert_true(a != gn_captions_run(other, WIDTH, HEIGHT, 0)->atlas->generation);
    gn_captions_destroy(other);
    other = gn_captions_create(&(struct gn_captions_opts){.font = ""});
    gn_captions_set(other, GN_CAPTION_TEXT, "one", 0);
    assert_true(a == gn_captions_run(other, WIDTH, HEIGHT, 0)->atlas->generation);
    gn_captions_destroy(other);
}

static void check_run(const struct gn_caption_run *run, uint32_t width, uint32_t height) {
    if (!run) return;
    assert_true(run->atlas->width_px % 4 == 0);
    for (uint32_t i = 0; i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        assert_true(q->x >= 0 && q->y >= 0 && q->width > 0 && q->height > 0);
        assert_true((uint32_t)(q->x + q->width) <= width);
        assert_true((uint32_t)(q->y + q->height) <= height);
        if (q->ground) continue;
        assert_true((uint32_t)(q->atlas_x + q->width) <= run->atlas->width_px);
        assert_true((uint32_t)(q->atlas_y + q->height) <= run->atlas->height_px);
    }
}

/* Any text on any picture: nothing outside either. */
static void test_any_text_on_any_picture(void **state) {
    (void)state;
    struct gn_dice dice = {3};
    for (int round = 0; round < 600; round++) {
        char text[3000];
        const size_t length = (size_t)gn_dice_between(&dice, 0, round % 10 ? 60 : sizeof text);
        for (size_t i = 0; i < length; i++) {
            const double kind = gn_dice_between(&dice, 0, 3);
            text[i] = (char)(kind < 1   ? gn_dice_between(&dice, 1, 256)
                             : kind < 2 ? gn_dice_between(&dice, 'a', '{')
                                        : " \n\xe6\x97\xa5"[(int)gn_dice_between(&dice, 0, 5)]);
        }
        text[length] = '\0';
        const uint32_t width = (uint32_t)gn_dice_between(&dice, 1, round % 7 ? 900 : 9000);
        const uint32_t height = (uint32_t)gn_dice_between(&dice, 1, round % 7 ? 900 : 9000);
        gn_captions_set(captions, round % GN_CAPTION_KIND_COUNT, text, 0);
        check_run(gn_captions_run(captions, width, height, 0), width, height);
    }
}

static void test_a_font_that_is_none_is_said_once(void **state) {
    (void)state;
    gn_captions_destroy(captions);
    captions = gn_captions_create(
        &(struct gn_captions_opts){.font = "/nowhere/x.ttf", .warnings = &warnings});
    assert_int_equal(warnings.count, 0); /* nobody has asked for text yet */
    gn_captions_set(captions, GN_CAPTION_TEXT, "Hi", 0);
    assert_non_null(glyph_of(run_at(0), 1));
    gn_captions_set(captions, GN_CAPTION_TEXT, "Ho", 0);
    assert_non_null(glyph_of(run_at(0), 1));
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "/nowhere/x.ttf"));
}

/* Widths of the bar's filled part and of its thin rest, which are below the text. */
static void measure_bar(int32_t out[2]) {
    const struct gn_caption_run *run = gn_captions_run(captions, 400, 300, 0);
    int32_t lowest = 0, tallest = 0;
    out[0] = out[1] = 0;
    for (uint32_t i = 0; i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        if (!q->ground && q->y + q->height > lowest) lowest = q->y + q->height;
    }
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < run->quad_count; i++) {
            const struct gn_caption_quad *q = &run->quads[i];
            if (q->ground || q->y + q->height != lowest) continue;
            if (!pass && q->height > tallest) tallest = q->height;
            if (pass) out[q->height < tallest] += q->width;
        }
}

static void test_a_bar_is_filled_to_its_share_and_as_wide_as_the_page(void **state) {
    (void)state;
    int32_t half[2], most[2];
    gn_captions_set(captions, GN_CAPTION_TEXT, "loading a ..", 0);
    gn_captions_run(captions, 400, 300, 0);
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
    gn_captions_set_bar(captions, .5, 0);
    assert_true(gn_captions_next_ns(captions) == 0);
    measure_bar(half);
    assert_in_range(half[0], 150, 200);
    assert_in_range(half[1] - half[0], 0, 1);
    gn_captions_set_bar(captions, .504, 0); /* the same percent */
    assert_true(gn_captions_next_ns(captions) == INT64_MAX);
    gn_captions_set_bar(captions, 1, 0);
    measure_bar(most);
    assert_int_equal(most[0], half[0] + half[1]);
    gn_captions_set_bar(captions, -1, 0);
    measure_bar(half);
    assert_true(half[0] + half[1] < most[0]); /* only letters are left */
}

/* As in a kiosk, whose visitors read no names of files. */
static void test_a_bar_needs_no_text(void **state) {
    (void)state;
    assert_null(run_at(0));
    gn_captions_set_bar(captions, .25, 0);
    const struct gn_caption_run *run = run_at(0);
    assert_non_null(run);
    assert_int_equal(run->alpha[GN_CAPTION_TEXT], 1);
    const struct gn_caption_quad ground = ground_of(run, GN_CAPTION_TEXT);
    assert_in_range(ground.width, WIDTH * 85 / 100, WIDTH * 90 / 100);
    assert_true(glyph_of(run, 0)->y > ground.y);
    gn_captions_set_bar(captions, -1, 0);
    assert_null(run_at(0));
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_a_card_ends_and_a_mark_stays),
        TEST(test_frames_are_asked_for_when_they_differ),
        TEST(test_what_stays_asks_for_one_frame),
        TEST(test_a_mode_named_again_starts_again),
        TEST(test_a_mode_is_at_the_lower_left),
        TEST(test_glyphs_are_those_of_the_font),
        TEST(test_captions_do_not_cover_each_other),
        TEST(test_text_grows_with_the_picture),
        TEST(test_a_bar_is_filled_to_its_share_and_as_wide_as_the_page),
        TEST(test_no_text_is_no_run),
        TEST(test_a_bar_needs_no_text),
        TEST(test_grounds_are_round),
        TEST(test_labels_are_at_the_line_while_it_is_there),
        TEST(test_what_is_missing_is_said_once),
        TEST(test_unknown_characters_are_boxes),
        TEST(test_frames_with_the_same_text_do_no_work),
        TEST(test_known_glyphs_are_not_made_again),
        TEST(test_equal_atlases_have_equal_generations),
        TEST(test_any_text_on_any_picture),
        TEST(test_a_font_that_is_none_is_said_once),
    };
    return RUN(tests);
}
