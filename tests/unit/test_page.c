/* Pages as rectangles: within 5 % of each side, no line over another, none cut where there is room,
 * at eight sizes, upright and turned. */
#include <math.h>
#include <string.h>

#include "caption/layout.h"
#include "caption/page.h"
#include "core/text.h"
#include "kiosk/problems.h"
#include "options/viewer_keys.h"
#include "unit/check.h"

static const uint32_t sizes[][2] = {{1280, 720}, {1920, 1080}, {3840, 2160}, {800, 480},
                                    {640, 480},  {3840, 1080}, {1024, 768},  {1366, 768}};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* Half as wide as it is high, as most letters are. */
static int32_t letter_px;
static struct gn_page_size resize(void *data, uint32_t line_px) {
    (void)data;
    letter_px = (int32_t)(line_px / 2);
    return (struct gn_page_size){line_px, line_px * 4 / 5};
}
static int32_t advance(void *data, uint32_t code) {
    (void)data, (void)code;
    return letter_px;
}
static const struct gn_page_font font = {.resize = resize, .advance_px = advance};
static struct gn_page page;

static bool is_within(struct gn_page_rect a, struct gn_page_rect b) {
    return a.x >= b.x && a.y >= b.y && a.x + a.width <= b.x + b.width &&
           a.y + a.height <= b.y + b.height;
}
static bool overlap(struct gn_page_rect a, struct gn_page_rect b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

static void expect_readable(uint32_t width, uint32_t height, bool whole) {
    const struct gn_page_rect safe = {(int32_t)width / 20, (int32_t)height / 20,
                                      (int32_t)(width - width / 10),
                                      (int32_t)(height - height / 10)};
    if (!is_within(page.ground, safe)) fail_msg("%ux%u: outside of the safe area", width, height);
    assert_true(page.count > 0);
    for (uint32_t i = 0; i < page.count; i++) {
        const struct gn_page_line *line = &page.lines[i];
        if (!is_within(line->rect, page.ground))
            fail_msg("%ux%u: \"%.*s\" leaves its ground", width, height,
                     (int)(line->end - line->begin), line->begin);
        if (whole && line->cut)
            fail_msg("%ux%u: \"%.*s\" is cut", width, height, (int)(line->end - line->begin),
                     line->begin);
        for (uint32_t k = 0; k < i; k++)
            if (overlap(line->rect, page.lines[k].rect))
                fail_msg("%ux%u: \"%.20s\" lies over \"%.20s\"", width, height, line->begin,
                         page.lines[k].begin);
    }
}

static void expect_at_all_sizes(enum gn_caption_kind kind, const char *text, bool whole) {
    for (int i = 0; i < 2 * SIZES; i++) {
        const uint32_t width = sizes[i / 2][i % 2], height = sizes[i / 2][1 - i % 2];
        gn_page_build(&gn_page_styles[kind], &font, text, width, height, 0, false, &page);
        expect_readable(width, height, whole);
        assert_ptr_equal(page.lines[0].begin, text);
        const struct gn_page_line *last = &page.lines[page.count - 1];
        if (whole && *last->end && last->end[strspn(last->end, "\n")])
            fail_msg("%ux%u: \"%.30s\" is left out", width, height, last->end);
    }
}

static void test_a_card_of_every_problem(void **state) {
    (void)state;
    for (int kind = 0; kind < GN_PROBLEM_COUNT; kind++) {
        char text[400] = "";
        gn_text_add(text, sizeof text, "%s\n%s\n%s", gn_problem_words[kind].title,
                    "Line 12 of kiosk.ini: \"animation_restart\" cannot be \"often, if at all\". "
                    "Did you mean yes, no or so?",
                    gn_problem_words[kind].advice);
        expect_at_all_sizes(GN_CAPTION_CARD, text, true);
    }
}

static void test_the_information(void **state) {
    (void)state;
    expect_at_all_sizes(
        GN_CAPTION_INFO,
        "The power supply is too weak\nWhat to do\tUse the board's own power supply and a short, "
        "thick cable.\nScene\tThe long hall of the east wing\nMode\tSoft shadows\n"
        "Screen\tHDMI-A-1 1920x1080@60.00 atomic\nSpeed\t60 frames/s, 0.2 % late\n"
        "Address\t192.168.100.100 (wlan0)\nAddress\tfd00:1234:5678:9abc::1 (wlan0)\n"
        "Temperature\t62 C\nRunning for\t400 days 03:25:07\nGPU\tV3D 4.2\n"
        "Driver\tOpenGL ES 3.1 Mesa 22.3.6\nSystem\tLinux 6.1.0-rpi7-rpi-v8 aarch64\n"
        "Program\tgnomon 0.2.0\n",
        true);
}

static void test_the_help(void **state) {
    (void)state;
    char text[2000] = "Keys\n";
    for (const struct gn_viewer_key *row = gn_viewer_keys; row->name; row++) {
        if (row->group)
            gn_text_add(text, sizeof text, "%s%s\n", row == gn_viewer_keys ? "" : "\n", row->group);
        gn_text_add(text, sizeof text, "%s\t%s\n", row->name, row->meaning);
    }
    expect_at_all_sizes(GN_CAPTION_INFO, text, true);
    int32_t least = INT32_MAX, most = 0; /* of labels: two columns where it is wide */
    gn_page_build(&gn_page_styles[GN_CAPTION_INFO], &font, text, 1920, 1080, 0, false, &page);
    for (uint32_t i = 0; i < page.count; i++) {
        if (!page.lines[i].is_label) continue;
        const int32_t right = page.lines[i].rect.x + page.lines[i].rect.width;
        least = right < least ? right : least;
        most = right > most ? right : most;
    }
    assert_true(most - least > 1920 / 4);
}

static void test_names_of_modes(void **state) {
    (void)state;
    expect_at_all_sizes(GN_CAPTION_MODE, "Soft shadows", true);
    expect_at_all_sizes(GN_CAPTION_MODE, "Smooth shadows - poisson | Soft shadows - pcss ..",
                        false);
}

static void test_sizes_are_shares_of_the_shorter_side(void **state) {
    (void)state;
    for (int i = 0; i < 2 * SIZES; i++) {
        const uint32_t width = sizes[i / 2][i % 2], height = sizes[i / 2][1 - i % 2],
                       side = width < height ? width : height;
        gn_page_build(&gn_page_styles[GN_CAPTION_CARD], &font, "Title\nText", width, height, 0,
                      false, &page);
        assert_in_range(page.lines[0].rect.height, side / 18 - 2, side / 18);
        assert_int_equal(page.lines[1].rect.height, side / 30);
    }
}

/* Labels hug the line and keep clear of it, of its handle's middle, of each other and of the edges,
 * wherever it is; both are there in the middle half. */
static void test_labels_hug_the_line(void **state) {
    (void)state;
    for (int i = 0; i < 2 * SIZES; i++)
        for (int at = 0; at <= 100; at += 5) {
            const uint32_t width = sizes[i / 2][i % 2], height = sizes[i / 2][1 - i % 2];
            const int32_t line = (int32_t)lround(at * .01 * width),
                          reach = (int32_t)height / 12 + 12;
            const struct gn_page_rect handle = gn_page_handle(width, height, at * .01);
            assert_int_equal(handle.width, handle.height);
            assert_int_equal(handle.x + handle.width / 2, line);
            assert_in_range(handle.y + handle.height / 2, height / 2 - 1, height / 2 + 1);
            for (int side = 0; side < 2; side++) {
                const struct gn_page_style style = gn_page_beside(
                    side ? GN_CAPTION_RIGHT : GN_CAPTION_LEFT, width, height, at * .01);
                gn_page_build(&style, &font, "Soft shadows - cone", width, height, 0, false, &page);
                if (at >= 25 && at <= 75) assert_true(page.count > 0);
                if (page.count == 0) {
                    assert_int_equal(page.ground.width, 0);
                    continue;
                }
                expect_readable(width, height, false);
                const int32_t right = page.ground.x + page.ground.width;
                assert_true(side ? page.ground.x >= line + 2 : right <= line - 2);
                const int32_t gap = side ? page.ground.x - line : line - right,
                              margin = (int32_t)width / 20 + 2;
                if (line > margin && line < (int32_t)width - margin) assert_true(gap < reach);
            }
        }
}

static void test_a_bar_alone(void **state) {
    (void)state;
    for (int i = 0; i < 2 * SIZES; i++) {
        const uint32_t width = sizes[i / 2][i % 2], height = sizes[i / 2][1 - i % 2];
        gn_page_build(&gn_page_styles[GN_CAPTION_TEXT], &font, "", width, height, 0, true, &page);
        assert_int_equal(page.count, 0);
        assert_true(is_within(page.bar, page.ground));
        assert_true(page.ground.x >= (int32_t)width / 20);
        assert_true(page.ground.y + page.ground.height <= (int32_t)(height - height / 20));
    }
}

static void test_lines_from_right_to_left_begin_at_the_right(void **state) {
    (void)state;
    expect_at_all_sizes(GN_CAPTION_CARD, "A long title in Latin letters\nשעון\n12 ساعة\nEnd", true);
    const struct gn_page_rect title = page.lines[0].rect;
    for (uint32_t i = 1; i < page.count; i++) {
        const struct gn_page_rect line = page.lines[i].rect;
        assert_true(line.width < title.width);
        if (i == page.count - 1)
            assert_int_equal(line.x, title.x);
        else
            assert_int_equal(line.x + line.width, title.x + title.width);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_card_of_every_problem),
        cmocka_unit_test(test_the_information),
        cmocka_unit_test(test_the_help),
        cmocka_unit_test(test_names_of_modes),
        cmocka_unit_test(test_sizes_are_shares_of_the_shorter_side),
        cmocka_unit_test(test_labels_hug_the_line),
        cmocka_unit_test(test_a_bar_alone),
        cmocka_unit_test(test_lines_from_right_to_left_begin_at_the_right),
    };
    return RUN(tests);
}
