#include <stdlib.h>
#include <string.h>

#include "caption/message.h"
#include "unit/check.h"

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

static uint32_t upright[PIXELS], turned[PIXELS];

static void draw(uint32_t *pixels, unsigned turn_deg, const char *text) {
    const uint32_t width = turn_deg % 180 ? HEIGHT : WIDTH;
    const struct gn_message_picture p = {.pixels = (uint8_t *)pixels,
                                         .stride = 4ul * width,
                                         .width_px = width,
                                         .height_px = PIXELS / width,
                                         .turn_deg = turn_deg,
                                         .font = ""};
    gn_message_draw(&p, text);
}

static unsigned count_ink(const uint32_t *pixels) {
    unsigned count = 0;
    for (int i = 0; i < PIXELS; i++) count += pixels[i] != pixels[0];
    return count;
}

/* By the dots of the font: 17 in H, 9 in i. */
static void test_text_is_below_on_the_left(void **state) {
    (void)state;
    draw(upright, 0, "Hi");
    assert_int_equal(count_ink(upright), 17 + 9);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if (upright[y * WIDTH + x] != upright[0])
                assert_true(x >= WIDTH / 20 && x < WIDTH / 4 && y > HEIGHT * 3 / 4 &&
                            y < HEIGHT * 19 / 20);
}

static void test_turned_text(void **state) {
    (void)state;
    draw(upright, 0, "no monitor");
    draw(turned, 90, "no monitor");
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_int_equal(upright[y * WIDTH + x], turned[x * HEIGHT + HEIGHT - 1 - y]);
    draw(turned, 270, "no monitor");
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_int_equal(upright[y * WIDTH + x], turned[(WIDTH - 1 - x) * HEIGHT + y]);
    draw(turned, 180, "no monitor");
    for (int i = 0; i < PIXELS; i++) assert_int_equal(upright[i], turned[PIXELS - 1 - i]);
}

static void test_any_text_on_any_picture(void **state) {
    (void)state;
    static char text[4000];
    uint32_t small[12];
    memset(text, 'x', sizeof text - 1);
    for (size_t i = 50; i < 2000; i += 7) text[i] = i % 3 ? ' ' : '\xc3';
    draw(upright, 0, text);
    draw(turned, 90, text);
    const struct gn_message_picture p = {.pixels = (uint8_t *)small,
                                         .stride = 16,
                                         .width_px = 4,
                                         .height_px = 3,
                                         .turn_deg = 270,
                                         .font = ""};
    assert_false(gn_message_draw(&p, text));
    assert_false(gn_message_draw(&p, ""));
    draw(upright, 0, "");
    assert_int_equal(count_ink(upright), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_is_below_on_the_left),
        cmocka_unit_test(test_turned_text),
        cmocka_unit_test(test_any_text_on_any_picture),
    };
    return RUN(tests);
}
