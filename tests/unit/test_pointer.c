/* Keys and a mouse, summed up. */
#include "check.h"

#include "display/pointer.h"

static void assert_drag(const float drag[2], double right, double up) {
    assert_float_equal((double)drag[0], right, 1e-6);
    assert_float_equal((double)drag[1], up, 1e-6);
}

static void test_left_turns_and_the_others_pan(void **state) {
    (void)state;
    for (int button = GN_BUTTON_LEFT; button <= GN_BUTTON_MIDDLE; button++)
        for (int shift = 0; shift < 2; shift++) {
            struct gn_drag p = {0};
            struct gn_pointer h = {0};
            const bool pans = shift || button != GN_BUTTON_LEFT;
            gn_drag_move(&p, 300, 40, 400, &h);
            gn_drag_button(&p, (enum gn_button)button, true, shift);
            gn_drag_move(&p, 400, 80, 400, &h);
            gn_drag_move(&p, 500, 40, 400, &h);
            gn_drag_move(&p, 400, 0, 400, &h);
            assert_drag(pans ? h.pan : h.turn, .25, .1);
            assert_drag(pans ? h.turn : h.pan, 0, 0);
        }
}

static void test_a_pointer_without_a_button_does_nothing(void **state) {
    (void)state;
    struct gn_drag p = {0};
    struct gn_pointer h = {0};
    gn_drag_move(&p, 10, 10, 100, &h);
    gn_drag_button(&p, GN_BUTTON_LEFT, true, false);
    gn_drag_button(&p, GN_BUTTON_LEFT, false, false);
    gn_drag_move(&p, 90, 90, 100, &h);
    assert_true(gn_pointer_is_zero(&h));
}

static void test_the_button_that_began_a_drag_ends_it(void **state) {
    (void)state;
    struct gn_drag p = {0};
    struct gn_pointer h = {0};
    gn_drag_button(&p, GN_BUTTON_RIGHT, true, false);
    gn_drag_button(&p, GN_BUTTON_LEFT, true, false);
    gn_drag_button(&p, GN_BUTTON_LEFT, false, false);
    gn_drag_move(&p, 10, 0, 100, &h);
    assert_drag(h.pan, .1, 0);
    gn_drag_button(&p, GN_BUTTON_RIGHT, false, false);
    gn_drag_move(&p, 20, 0, 100, &h);
    assert_drag(h.pan, .1, 0);
}

static void test_letters_files_and_handles_are_summed_up(void **state) {
    (void)state;
    struct gn_pointer sum = {0}, more = {0};
    const struct gn_key_event n = {.key = GN_KEY_N, .down = true}, up = {.key = GN_KEY_N};
    gn_pointer_key(&more, &n);
    gn_pointer_letter(&more, 'n');
    gn_pointer_key(&more, &up);
    gn_pointer_letter(&more, 0x20ac); /* not ASCII */
    gn_pointer_letter(&more, '?');
    more.file = "a.glb";
    more.pressed = more.dragged = true;
    more.press[0] = .25f;
    more.drag[1] = .5f;
    assert_false(gn_pointer_is_zero(&more));
    gn_pointer_add(&sum, &more);
    gn_pointer_add(&sum,
                   &(struct gn_pointer){.dragged = true, .drag = {0, .75f}, .released = true});
    assert_int_equal(sum.key_count, 3);
    assert_true(sum.keys[0].key == GN_KEY_N && sum.letters[0] == 'n');
    assert_true(sum.keys[1].key == GN_KEY_N && !sum.keys[1].down && !sum.letters[1]);
    assert_true(sum.keys[2].key == GN_KEY_NONE && sum.letters[2] == '?');
    for (int i = 0; i < 100; i++) gn_pointer_letter(&sum, 'a');
    assert_int_equal(sum.key_count, GN_POINTER_KEYS_MAX);
    assert_int_equal(sum.letters[GN_POINTER_KEYS_MAX - 1], 'a');
    assert_string_equal(sum.file, "a.glb");
    assert_true(sum.pressed && sum.dragged && sum.released);
    assert_float_equal((double)sum.press[0], .25, 0);
    assert_float_equal((double)sum.drag[1], .75, 0);
}

static void test_a_window_without_height_has_no_drags(void **state) {
    (void)state;
    struct gn_drag p = {0};
    struct gn_pointer h = {0};
    gn_drag_button(&p, GN_BUTTON_LEFT, true, false);
    gn_drag_move(&p, 10, 0, 0, &h);
    assert_true(gn_pointer_is_zero(&h));
}

static void test_what_was_done_adds_up(void **state) {
    (void)state;
    struct gn_pointer h = {.turn = {1, 2}, .wheel = 1};
    gn_pointer_add(&h, &(struct gn_pointer){.turn = {1, 1}, .pan = {3, 4}, .wheel = -3});
    assert_drag(h.turn, 2, 3);
    assert_drag(h.pan, 3, 4);
    assert_float_equal((double)h.wheel, -2, 0);
}

static void test_home_forgets_what_was_done_before_but_not_after(void **state) {
    (void)state;
    struct gn_pointer h = {.turn = {1, 2}, .quit = true};
    gn_pointer_add(&h, &(struct gn_pointer){.home = true, .pan = {3, 4}});
    assert_true(h.home && h.quit);
    assert_drag(h.turn, 0, 0);
    assert_drag(h.pan, 3, 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_left_turns_and_the_others_pan),
        cmocka_unit_test(test_a_pointer_without_a_button_does_nothing),
        cmocka_unit_test(test_the_button_that_began_a_drag_ends_it),
        cmocka_unit_test(test_letters_files_and_handles_are_summed_up),
        cmocka_unit_test(test_a_window_without_height_has_no_drags),
        cmocka_unit_test(test_what_was_done_adds_up),
        cmocka_unit_test(test_home_forgets_what_was_done_before_but_not_after),
    };
    return RUN(tests);
}
