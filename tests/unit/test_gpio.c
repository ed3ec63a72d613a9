/* The library that this build has, where there is no chip: what it does with one needs a kernel
 * (tests/board/buttons.guest). */
#include "unit/check.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "input/gpio.h"

static struct gn_gpio_chip info;
static void *chip;

static int opens(const char *path) { return gn_gpio_library.open(NULL, path, &chip, &info); }

static void what_is_not_there_is_told_from_what_is_no_chip(void **state) {
    char path[] = "/tmp/gn-gpio-XXXXXX";
    const int file = mkstemp(path);
    (void)state;
    assert_true(file >= 0);
    assert_int_not_equal(opens(path), 0);
    close(file);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(opens(path), ENOENT);
    for (int i = 0; i < 100; i++) assert_int_not_equal(opens("/dev/null"), 0);
    assert_null(chip); /* nothing was opened */
}

static void descriptors_are_not_kept(void **state) {
    (void)state;
    const int before = dup(STDIN_FILENO);
    close(before);
    for (int i = 0; i < 100; i++) opens("/dev/null");
    const int after = dup(STDIN_FILENO);
    close(after);
    assert_int_equal(after, before);
}

static void it_names_its_interface(void **state) {
    (void)state;
    assert_true(strcmp(gn_gpio_library.library, "libgpiod 1") == 0 ||
                strcmp(gn_gpio_library.library, "libgpiod 2") == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_there_is_told_from_what_is_no_chip),
        cmocka_unit_test(descriptors_are_not_kept),
        cmocka_unit_test(it_names_its_interface),
    };
    if (!gn_gpio_library.library) {
        puts("this build has no libgpiod");
        return 77;
    }
    return RUN(tests);
}
