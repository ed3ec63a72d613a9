#include <stdlib.h>
#include <string.h>

#include "display/message.h"
#include "unit/check.h"

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

static uint32_t upright[PIXELS], turned[PIXELS];

static void draw(uint32_t *pixels, unsigned turn_deg, const char *text) {
    const uint32_t width = turn_deg % 180 ? HEIGHT : WIDTH;
    const struct gn_message_picture p = {(uint8_t *)pixels, 4ul * width, width, PIXELS / width,
                                         turn_deg};
    gn_message_draw(&p, text);
}

static unsigned count_ink(const uint32_t *pixels) {
    unsigned count = 0;
    for (int i = 0; i < PIXELS; i++) count += pixels[i] != pixels[0];
    return count;
}

/* By the dots of the font: 17 in H, 9 in i. */
static void test_text_is_in_the_middle(void **state) {
    (void)state;
    draw(upright, 0, "Hi");
    assert_int_equal(count_ink(upright), 17 + 9);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if (upright[y * WIDTH + x] != upright[0])
                assert_true(abs(x - WIDTH / 2) <= 6 && abs(y - HEIGHT / 2) <= 5);
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
    const struct gn_message_picture p = {(uint8_t *)small, 16, 4, 3, 270};
    gn_message_draw(&p, text);
    gn_message_draw(&p, "");
    draw(upright, 0, "");
    assert_int_equal(count_ink(upright), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_is_in_the_middle),
        cmocka_unit_test(test_turned_text),
        cmocka_unit_test(test_any_text_on_any_picture),
    };
    return RUN(tests);
}
