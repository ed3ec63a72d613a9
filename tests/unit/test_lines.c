/* Buttons on GPIO lines through all that can happen to chips, as an input sees it. Time is the
 * test's: only the news of nodes that come and go are the kernel's. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "unit/gpio_fake.h"
#include "unit/input_help.h"

#define MS    INT64_C(1000000)
#define S     (1000 * MS)
#define START (100 * S)

static struct fake_gpio gpio;
static struct gn_button_opts buttons[2];
static int64_t now_ns;

static int setup(void **state) {
    (void)state;
    fake_gpio_init(&gpio);
    now_ns = START;
    loop = gn_loop_open(NULL);
    gn_loop_fake_clock(loop, &now_ns);
    for (int i = 0; i < 2; i++)
        buttons[i] = (struct gn_button_opts){
            .name = i ? "prev" : "next",
            .line = i ? NULL : "B",
            .gestures = 1u << GN_GESTURE_PRESS | 1u << GN_GESTURE_CLICK | 1u << GN_GESTURE_HOLD};
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_input_close(input);
    input = NULL;
    gn_loop_close(loop);
    fake_gpio_finish(&gpio);
    return gpio.opened; /* whatever was opened was closed */
}

static void open_input(const struct gn_gpio_ops *ops) {
    const struct gn_input_opts opts = {.loop = loop, .buttons = buttons, .button_count = 2};
    const struct gn_input_world world = {.gpio = ops, .gpio_context = &gpio, .folder = gpio.folder};
    struct gn_err err = {0};
    input = gn_input_open_in(&world, &opts, now_ns, NULL, &err);
    if (!input) fail_msg("%s", err.text);
}

static void assert_usage(const char *says) {
    const struct gn_input_opts opts = {.loop = loop, .buttons = buttons, .button_count = 2};
    const struct gn_input_world world = {
        .gpio = &fake_gpio_ops, .gpio_context = &gpio, .folder = gpio.folder};
    struct gn_err err = {0};
    assert_null(gn_input_open_in(&world, &opts, now_ns, NULL, &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    if (!strstr(err.text, says)) fail_msg("\"%s\" does not say %s", err.text, says);
}

static bool wakes(void) { return gn_loop_step(loop, now_ns) > 0; }

static void wait_ns(int64_t ns) {
    now_ns += ns;
    wakes();
}

/* As a main loop would: only when the timer says so; how often that was. */
static int sleep_until(int64_t until_ns) {
    int count = 0;
    for (; input->timer.due_ns <= until_ns; count++) {
        now_ns = input->timer.due_ns;
        wakes();
        if (count > 100000) fail_msg("does not sleep");
    }
    now_ns = until_ns;
    return count;
}

static void edge(bool high) { fake_gpio_edge(&gpio, 0, 1, high, now_ns, false); }

static void assert_gesture(enum gn_gesture gesture, int64_t time_ns) {
    struct gn_gesture_event event;
    if (!gn_input_next(input, &event)) fail_msg("no %s", gn_gesture_names[gesture]);
    assert_int_equal(event.gesture, gesture);
    assert_int_equal(event.button, 0);
    assert_true(event.time_ns == time_ns);
}

static void assert_silence(void) {
    char text[GN_REPORT_SIZE];
    if (gn_input_report(input, text, sizeof text)) fail_msg("said: %s", text);
}

/* ---- finding lines ------------------------------------------------------------------------- */

static void test_a_press_comes_with_its_edge(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 4, "pinctrl-rp1", 4);
    open_input(&fake_gpio_ops);
    assert_report("button \"next\": B (gpiochip4 line 1)");
    assert_silence();
    assert_int_equal(gpio.chips[0].line[1].bias, GN_BIAS_PULL_UP);
    assert_true(gpio.chips[0].line[1].debounce_ns == 5 * MS);
    const int64_t begun_ns = now_ns += S;
    edge(false);
    assert_true(wakes());
    assert_true(input->timer.due_ns == begun_ns + 20 * MS);
    wait_ns(19 * MS);
    assert_nothing();
    wait_ns(MS);
    assert_gesture(GN_GESTURE_PRESS, begun_ns);
    wait_ns(80 * MS);
    edge(true);
    wait_ns(0);
    wait_ns(20 * MS);
    assert_gesture(GN_GESTURE_CLICK, begun_ns + 100 * MS);
    assert_nothing();
    assert_silence();
}

static void test_a_press_during_a_long_frame_counts(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 4, "pinctrl-rp1", 4);
    open_input(&fake_gpio_ops);
    assert_report("button \"next\": B (gpiochip4 line 1)");
    for (int64_t blocked_ns = S; blocked_ns < 300 * S; blocked_ns *= 4) {
        const int64_t begun_ns = now_ns += 2 * S;
        edge(false);
        now_ns += 50 * MS;
        edge(true);
        now_ns += blocked_ns;
        assert_true(wakes());
        assert_gesture(GN_GESTURE_PRESS, begun_ns);
        assert_gesture(GN_GESTURE_CLICK, begun_ns + 50 * MS);
        assert_nothing();
    }
}

static void test_a_line_is_found_by_its_chips_label(void **state) {
    (void)state;
    buttons[0].line = "label:gpio3/2";
    buttons[0].active_high = true;
    buttons[0].bias = GN_BIAS_PULL_DOWN;
    fake_gpio_plug(&gpio, 1, 0, "gpio1", 4);
    fake_gpio_plug(&gpio, 0, 7, "gpio3", 4);
    gpio.chips[0].line[2].name[0] = '\0';
    gpio.chips[0].line[2].high = false;
    open_input(&fake_gpio_ops);
    assert_report("label:gpio3/2 (gpiochip7 line 2)");
    assert_int_equal(gpio.chips[0].line[2].bias, GN_BIAS_PULL_DOWN);
    wait_ns(S);
    fake_gpio_edge(&gpio, 0, 2, true, now_ns, false);
    wait_ns(0);
    wait_ns(20 * MS);
    assert_gesture(GN_GESTURE_PRESS, START + S);
}

static void test_other_kernels_names_of_a_pi_are_known(void **state) {
    (void)state;
    buttons[0].line = "GPIO2";
    buttons[1].line = "SPI_CE0_N";
    fake_gpio_plug(&gpio, 0, 0, "pinctrl-bcm2711", 4);
    strcpy(gpio.chips[0].line[2].name, "SDA1");
    strcpy(gpio.chips[0].line[3].name, "GPIO8");
    open_input(&fake_gpio_ops);
    assert_report("GPIO2 (gpiochip0 line 2)");
    assert_report("SPI_CE0_N (gpiochip0 line 3)");
}

static void test_on_other_boards_those_names_mean_something_else(void **state) {
    (void)state;
    buttons[0].line = "GPIO2";
    fake_gpio_plug(&gpio, 0, 0, "pinctrl-rockchip", 4);
    strcpy(gpio.chips[0].line[2].name, "SDA1");
    open_input(&fake_gpio_ops);
    assert_report("no GPIO line named GPIO2");
}

static void test_a_line_of_that_name_beats_what_other_kernels_call_so(void **state) {
    (void)state;
    buttons[0].line = "GPIO2";
    buttons[1].line = "GPIO3";
    fake_gpio_plug(&gpio, 0, 0, "pinctrl-bcm2711", 4);
    strcpy(gpio.chips[0].line[0].name, "GPIO2");
    strcpy(gpio.chips[0].line[1].name, "SDA1");
    strcpy(gpio.chips[0].line[2].name, "SCL1");
    strcpy(gpio.chips[0].line[3].name, "GPIO3");
    open_input(&fake_gpio_ops);
    assert_report("GPIO2 (gpiochip0 line 0)");
    assert_report("GPIO3 (gpiochip0 line 3)");
}

static void test_two_lines_of_one_name_are_refused_with_both_chips(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "brcmstb", 4);
    fake_gpio_plug(&gpio, 1, 1, "rp1", 4);
    open_input(&fake_gpio_ops);
    char text[GN_REPORT_SIZE];
    assert_true(gn_input_report(input, text, sizeof text));
    assert_non_null(strstr(text, "2 lines are named B"));
    assert_non_null(strstr(text, "gpiochip0 (brcmstb) line 1, gpiochip1 (rp1) line 1"));
    assert_false(gpio.chips[0].line[1].requested || gpio.chips[1].line[1].requested);
    fake_gpio_unplug(&gpio, 0); /* now there is one */
    wait_ns(S);
    assert_report("B (gpiochip1 line 1)");
}

static void test_numbers_of_chips_and_wrong_specs_are_wrong_usage(void **state) {
    (void)state;
    static const char *const wrong[] = {"17",       "gpiochip0/17", "/dev/gpiochip0",
                                        "",         "label:a",      "label:/3",
                                        "label:a/", "label:a/b",    "label:a/-1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        buttons[0].line = wrong[i];
        assert_usage("button \"next\": line: ");
    }
    buttons[0].line = buttons[1].line = "B";
    assert_usage("line B is used by button \"next\"");
}

static void test_a_build_without_a_library_says_so(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    open_input(&fake_gpio_none);
    assert_report("need libgpiod");
    assert_int_equal(sleep_until(START + 3600 * S), 0);
    assert_silence();
}

/* ---- what is refused ----------------------------------------------------------------------- */

static void test_a_line_in_use_names_its_user_and_is_taken_when_free(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    strcpy(gpio.chips[0].line[1].consumer, "spi0 CS0");
    open_input(&fake_gpio_ops);
    assert_report("in use by \"spi0 CS0\"");
    sleep_until(START + 25 * S);
    assert_silence();
    gpio.chips[0].line[1].consumer[0] = '\0';
    sleep_until(START + 28 * S);
    assert_report("B (gpiochip0 line 1)");
}

static void test_no_permission_is_retried_for_half_a_minute_then_each_minute(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    gpio.chips[0].open_error = EACCES;
    open_input(&fake_gpio_ops);
    assert_report("add the user to group gpio");
    assert_int_equal(sleep_until(START + 30 * S), 15);
    assert_in_range(sleep_until(START + 630 * S), 10, 10);
    assert_silence();
    gpio.chips[0].open_error = 0;
    sleep_until(START + 700 * S);
    assert_report("B (gpiochip0 line 1)");
}

static void test_a_chip_without_a_pull_up_is_used_without_and_said_once(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    gpio.chips[0].no_bias = true;
    open_input(&fake_gpio_ops);
    assert_report("no internal pull-up");
    assert_silence();
    assert_true(gpio.chips[0].line[1].requested);
    assert_int_equal(gpio.chips[0].line[1].bias, GN_BIAS_NONE);
}

static void test_other_errors_are_named_and_retried(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    gpio.chips[0].request_error = EIO;
    open_input(&fake_gpio_ops);
    assert_report("Input/output error");
    gpio.chips[0].request_error = 0;
    sleep_until(START + 3 * S);
    assert_report("B (gpiochip0 line 1)");
}

/* ---- coming and going ---------------------------------------------------------------------- */

static void test_a_chip_that_comes_later_is_waited_for_asleep(void **state) {
    (void)state;
    open_input(&fake_gpio_ops);
    assert_report("no GPIO chip found for B");
    assert_int_equal(sleep_until(START + 3600 * S), 0);
    fake_gpio_plug(&gpio, 0, 3, "chip", 4);
    assert_true(wakes());
    assert_report("B (gpiochip3 line 1)");
    assert_silence();
}

static void test_without_news_of_nodes_it_looks_every_two_seconds(void **state) {
    (void)state;
    open_input(&fake_gpio_ops);
    assert_report("no GPIO chip found for B");
    input->lines.watched = false;
    gn_lines_search(&input->lines, now_ns);
    input->timer.due_ns = now_ns;
    wait_ns(0);
    assert_in_range(sleep_until(START + 20 * S), 9, 10);
    assert_silence();
}

static void test_a_chip_that_goes_and_comes_under_another_number_works_on(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    open_input(&fake_gpio_ops);
    assert_report("B (gpiochip0 line 1)");
    wait_ns(S);
    edge(false);
    wait_ns(0);
    wait_ns(20 * MS);
    assert_gesture(GN_GESTURE_PRESS, START + S);
    fake_gpio_unplug(&gpio, 0); /* while it is pressed */
    assert_true(wakes());
    wait_ns(100 * MS);
    assert_report("disappeared");
    sleep_until(now_ns + 100 * S);
    assert_nothing(); /* no hold, no click */
    assert_silence();
    fake_gpio_plug(&gpio, 0, 1, "chip", 4);
    assert_true(wakes());
    assert_report("B (gpiochip1 line 1)");
    const int64_t begun_ns = now_ns += S;
    edge(false);
    wait_ns(0);
    wait_ns(20 * MS);
    assert_gesture(GN_GESTURE_PRESS, begun_ns);
}

static void test_a_button_held_as_it_is_found_waits_for_its_release(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    gpio.chips[0].line[1].high = false;
    open_input(&fake_gpio_ops);
    assert_report("B (gpiochip0 line 1)");
    sleep_until(START + 60 * S);
    assert_nothing();
    assert_report("held for 30 s; ignored until released");
    assert_silence();
    edge(true);
    wait_ns(0);
    wait_ns(S);
    assert_nothing();
    edge(false);
    wait_ns(0);
    wait_ns(20 * MS);
    assert_gesture(GN_GESTURE_PRESS, now_ns - 20 * MS);
}

/* ---- lost edges, and sleep ----------------------------------------------------------------- */

static void test_a_gap_in_the_numbers_is_healed_by_the_level(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    open_input(&fake_gpio_ops);
    wait_ns(S);
    edge(false);
    fake_gpio_edge(&gpio, 0, 1, true, now_ns + 30 * MS, true); /* lost */
    fake_gpio_edge(&gpio, 0, 1, false, now_ns + 31 * MS, false);
    fake_gpio_edge(&gpio, 0, 1, true, now_ns + 32 * MS, true); /* lost, and nothing after */
    const int64_t begun_ns = now_ns;
    const int reads = gpio.level_reads;
    wait_ns(40 * MS);
    assert_int_equal(gpio.level_reads, reads + 1);
    wait_ns(S);
    assert_gesture(GN_GESTURE_PRESS, begun_ns);
    assert_gesture(GN_GESTURE_CLICK, begun_ns + 31 * MS);
    assert_nothing();
    assert_true(gn_gestures_at_rest(&input->gestures, 0));
}

static void test_a_full_buffer_is_healed_without_numbers(void **state) {
    (void)state;
    gpio.counts = false;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    open_input(&fake_gpio_ops);
    for (int pressed = 1; pressed >= 0; pressed--) {
        wait_ns(S);
        for (int i = 0; i < 240; i++) /* a burst of .2 s that nobody reads: 16 are kept */
            fake_gpio_edge(&gpio, 0, 1, i % 2 != pressed, now_ns + i * 833333, false);
        wait_ns(200 * MS);
        wait_ns(300 * MS);
        assert_int_equal(input->gestures.buttons[0].line.settled, pressed);
    }
}

static void test_a_lost_release_is_no_long_press(void **state) {
    (void)state;
    buttons[0].hold_ns = 1500 * MS;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    open_input(&fake_gpio_ops);
    wait_ns(S);
    edge(false);
    wait_ns(0);
    fake_gpio_edge(&gpio, 0, 1, true, now_ns + 100 * MS, true);
    sleep_until(now_ns + 10 * S);
    assert_gesture(GN_GESTURE_PRESS, START + S);
    assert_gesture(GN_GESTURE_CLICK, START + 2 * S); /* seen at the next look, a second later */
    assert_nothing();
}

static void test_a_still_kiosk_sleeps(void **state) {
    (void)state;
    fake_gpio_plug(&gpio, 0, 0, "chip", 4);
    open_input(&fake_gpio_ops);
    assert_int_equal(sleep_until(START + 3600 * S), 0);
    edge(false);
    assert_true(wakes());
    assert_in_range(sleep_until(now_ns + 10 * S), 10, 13); /* down: every second */
    sleep_until(now_ns + 100 * S);
    assert_in_range(sleep_until(now_ns + 600 * S), 10, 10); /* stuck: every minute */
    edge(true);
    assert_true(wakes());
    sleep_until(now_ns + S);
    assert_int_equal(sleep_until(now_ns + 3600 * S), 0);
}

static void test_doctor_is_told_of_chips_lines_and_users(void **state) {
    (void)state;
    const struct gn_input_world world = {
        .gpio = &fake_gpio_ops, .gpio_context = &gpio, .folder = gpio.folder};
    struct gn_input_list list;
    fake_gpio_plug(&gpio, 0, 10, "pinctrl-rp1", 3);
    fake_gpio_plug(&gpio, 1, 2, "locked", 3);
    gpio.chips[1].open_error = EACCES;
    strcpy(gpio.chips[0].line[2].consumer, "spi0 CS0");
    gpio.chips[0].line[0].name[0] = '\0';
    gn_input_list_in(&world, &list);
    assert_int_equal(list.chip_count, 2);
    assert_int_equal(list.chips[0].error, EACCES); /* by number: 2 before 10 */
    const struct gn_input_chip *chip = &list.chips[1];
    assert_int_equal(chip->error, 0);
    assert_string_equal(chip->label, "pinctrl-rp1");
    assert_int_equal(chip->line_count, 3);
    assert_string_equal(chip->lines[0].name, "");
    assert_string_equal(chip->lines[1].name, "B");
    assert_false(chip->lines[1].used);
    assert_true(chip->lines[2].used);
    assert_string_equal(chip->lines[2].consumer, "spi0 CS0");
    gn_input_list_finish(&list);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_a_press_comes_with_its_edge),
        TEST(test_a_press_during_a_long_frame_counts),
        TEST(test_a_line_is_found_by_its_chips_label),
        TEST(test_other_kernels_names_of_a_pi_are_known),
        TEST(test_on_other_boards_those_names_mean_something_else),
        TEST(test_a_line_of_that_name_beats_what_other_kernels_call_so),
        TEST(test_two_lines_of_one_name_are_refused_with_both_chips),
        TEST(test_numbers_of_chips_and_wrong_specs_are_wrong_usage),
        TEST(test_a_build_without_a_library_says_so),
        TEST(test_a_line_in_use_names_its_user_and_is_taken_when_free),
        TEST(test_no_permission_is_retried_for_half_a_minute_then_each_minute),
        TEST(test_a_chip_without_a_pull_up_is_used_without_and_said_once),
        TEST(test_other_errors_are_named_and_retried),
        TEST(test_a_chip_that_comes_later_is_waited_for_asleep),
        TEST(test_without_news_of_nodes_it_looks_every_two_seconds),
        TEST(test_a_chip_that_goes_and_comes_under_another_number_works_on),
        TEST(test_a_button_held_as_it_is_found_waits_for_its_release),
        TEST(test_a_gap_in_the_numbers_is_healed_by_the_level),
        TEST(test_a_full_buffer_is_healed_without_numbers),
        TEST(test_a_lost_release_is_no_long_press),
        TEST(test_a_still_kiosk_sleeps),
        TEST(test_doctor_is_told_of_chips_lines_and_users),
    };
    return RUN(tests);
}
