/* What doctor says of GPIO chips and input devices. */
#include "cli/doctor_input.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

static const struct gn_input_line lines[] = {
    {.name = "ID_SDA"},
    {.name = "GPIO8", .used = true, .consumer = "spi0 CS0"},
    {.used = true},
    {.used = false}};

static void fill(struct gn_doctor_report *report) {
    memset(report, 0, sizeof *report);
    report->machine.device_count = 2;
    report->machine.devices[0].kind = report->machine.devices[1].kind = GN_DEVICE_GPIO;
    strcpy(report->machine.user, "kiosk");
    report->input = (struct gn_input_list){
        .library = "libgpiod 9", .chip_count = 3, .devices = 5, .devices_denied = 2};
    report->input.pointer_count = 2;
    report->input.pointers[0] =
        (struct gn_input_pointer){"/dev/input/event3", "ft5x06", GN_TOUCH_SCREEN};
    report->input.pointers[1] =
        (struct gn_input_pointer){"/dev/input/event5", "A Mouse", GN_TOUCH_MOUSE};
    report->input.chips[0] = (struct gn_input_chip){.path = "/dev/gpiochip0",
                                                    .name = "gpiochip0",
                                                    .label = "pinctrl-rp1",
                                                    .lines = lines,
                                                    .line_count = 4};
    report->input.chips[1] = (struct gn_input_chip){.path = "/dev/gpiochip1",
                                                    .name = "gpiochip1",
                                                    .label = "gpio3",
                                                    .lines = lines + 3,
                                                    .line_count = 1};
    report->input.chips[2] = (struct gn_input_chip){.path = "/dev/gpiochip2", .error = EIO};
}

static void test_people_read_names_and_users(void **state) {
    (void)state;
    static struct gn_doctor_report report;
    char *text = NULL;
    size_t size = 0;
    fill(&report);
    FILE *to = open_memstream(&text, &size);
    gn_doctor_print_input(&report, to);
    fclose(to);
    assert_string_equal(
        text, "  gpiochip0: 4 lines, label pinctrl-rp1\n"
              "     ID_SDA GPIO8 (in use by spi0 CS0) line 2 (in use)\n"
              "  gpiochip1: 1 line, label gpio3; without names: write label:gpio3/NUMBER\n"
              "  read by libgpiod 9\n"
              "\nKeys\n  5 input devices, 2 of them not to be read\n"
              "  touch screen: ft5x06, /dev/input/event3\n"
              "  mouse: A Mouse, /dev/input/event5\n");
    free(text);
}

static void test_programs_read_the_same(void **state) {
    (void)state;
    static struct gn_doctor_report report;
    fill(&report);
    json_t *chip = json_object(), *none = json_object();
    gn_doctor_describe_chip(&report, "/dev/gpiochip0", chip);
    gn_doctor_describe_chip(&report, "/dev/gpiochip2", none);
    json_t *all = json_pack("[ooo]", chip, none, gn_doctor_input_json(&report));
    char *text = json_dumps(all, JSON_COMPACT);
    assert_string_equal(
        text, "[{\"label\":\"pinctrl-rp1\",\"lines\":["
              "{\"name\":\"ID_SDA\",\"used\":false,\"consumer\":null},"
              "{\"name\":\"GPIO8\",\"used\":true,\"consumer\":\"spi0 CS0\"},"
              "{\"name\":null,\"used\":true,\"consumer\":null},"
              "{\"name\":null,\"used\":false,\"consumer\":null}]},"
              "{\"label\":null,\"lines\":null},"
              "{\"gpio_library\":\"libgpiod 9\",\"devices\":5,\"devices_denied\":2,"
              "\"pointers\":["
              "{\"kind\":\"touch screen\",\"name\":\"ft5x06\",\"path\":\"/dev/input/event3\"},"
              "{\"kind\":\"mouse\",\"name\":\"A Mouse\",\"path\":\"/dev/input/event5\"}]}]");
    free(text);
    json_decref(all);
}

static void test_each_problem_has_its_cure(void **state) {
    (void)state;
    static struct gn_doctor_report report;
    fill(&report);
    gn_doctor_diagnose_input(&report);
    assert_int_equal(report.problems.count, 2);
    assert_string_equal(report.problems.items[0].what,
                        "/dev/gpiochip2 cannot be opened: Input/output error");
    assert_string_equal(report.problems.items[1].what,
                        "2 of 5 input devices may not be read: keys and touches there are ignored");
    assert_string_equal(report.problems.items[1].cure,
                        "sudo usermod -aG input kiosk, then log in again");
    fill(&report);
    report.input.library = NULL;
    report.input.chip_count = report.input.devices_denied = 0;
    gn_doctor_diagnose_input(&report);
    assert_int_equal(report.problems.count, 1);
    assert_non_null(strstr(report.problems.items[0].cure, "libgpiod-dev"));
}

static void test_a_window_needs_no_devices(void **state) {
    (void)state;
    static struct gn_doctor_report report;
    fill(&report);
    report.input.chip_count = 0;
    report.backends[0] = (struct gn_doctor_backend){
        .name = "window", .built = true, .opens = true, .is_window = true};
    report.backend_count = 1;
    gn_doctor_diagnose_input(&report);
    assert_int_equal(report.problems.count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_people_read_names_and_users),
        cmocka_unit_test(test_programs_read_the_same),
        cmocka_unit_test(test_each_problem_has_its_cure),
        cmocka_unit_test(test_a_window_needs_no_devices),
    };
    return RUN(tests);
}
