/* What names a machine or its user leaves texts; what does not, stays. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/redact.h"
#include "unit/folder.h"

static struct gn_redact redact;

static const char *redacted(const char *text) {
    static char out[512];
    gn_redact_text(&redact, text, out, sizeof out);
    return out;
}

static int setup(void **state) {
    (void)state;
    redact = (struct gn_redact){0};
    gn_redact_add(&redact, "eva");
    gn_redact_add(&redact, "Hall-Nine");
    return 0;
}

static void test_names_go_as_words_and_long_ones_anywhere(void **state) {
    (void)state;
    assert_string_equal(redacted("eva may not open it"), "(name) may not open it");
    assert_string_equal(redacted("6.1.0-EVA+ (eva@x)"), "6.1.0-(name)+ ((name)@x)");
    assert_string_equal(redacted("evaluated, medieval"), "evaluated, medieval");
    assert_string_equal(redacted("6.1.0hall-nine2"), "6.1.0(name)2");
    assert_string_equal(redacted("\xc3\xa4"
                                 "eva"),
                        "\xc3\xa4"
                        "eva"); /* a letter before it */
    assert_string_equal(redacted(""), "");
}

static void test_names_that_systems_give_stay(void **state) {
    (void)state;
    static const char *const names[] = {"pi",   "debian", "Raspberry", "raspberrypi",
                                        "root", "x",      ""};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) gn_redact_add(&redact, names[i]);
    gn_redact_add(&redact, NULL);
    assert_int_equal(redact.count, 2);
    assert_string_equal(redacted("Raspberry Pi 4 Model B Rev 1.4"),
                        "Raspberry Pi 4 Model B Rev 1.4");
    assert_string_equal(redacted("Debian GNU/Linux 12 (bookworm)"),
                        "Debian GNU/Linux 12 (bookworm)");
}

static void test_paths_go_but_for_numbered_devices(void **state) {
    (void)state;
    assert_string_equal(redacted("/home/eva/x.glb: cannot read"), "(path): cannot read");
    assert_string_equal(redacted("see ~/x and (/srv/a.glb)."), "see (path) and ((path)).");
    assert_string_equal(redacted("../mueller/x.glb, ./y ..."), "(path), (path) ...");
    assert_string_equal(redacted("/dev/dri/card0: Permission denied"), "card0: Permission denied");
    assert_string_equal(redacted("/dev/gpiochip0, /dev/input/event3"), "gpiochip0, event3");
    assert_string_equal(redacted("/dev/disk/by-id/usb-S3RIAL"), "(path)");
    assert_string_equal(redacted("X11/Wayland / none"), "X11/Wayland / none");
}

static void test_addresses_go_and_versions_stay(void **state) {
    (void)state;
    assert_string_equal(redacted("192.168.7.31: refused, fe80::1 too."),
                        "(address): refused, (address) too.");
    assert_string_equal(redacted("dc:a6:32:01:02:03"), "(address)");
    assert_string_equal(redacted("display 192.168.1.5:0"), "display (address):0");
    static const char *const versions[] = {"OpenGL ES 3.2 Mesa 22.3.6",
                                           "6.1.0-18-arm64",
                                           "5.15.153.1-microsoft-standard",
                                           "llvmpipe (LLVM 15.0.6, 256 bits)",
                                           "fe200000.gpio",
                                           "V3D 4.2.14.0x",
                                           "12:30:45"};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++)
        assert_string_equal(redacted(versions[i]), versions[i]);
}

static void test_what_does_not_fit_is_cut_and_control_characters_go(void **state) {
    (void)state;
    char out[8];
    gn_redact_text(&redact, "eva eva eva eva", out, sizeof out);
    assert_string_equal(out, "(name) ");
    assert_string_equal(redacted("a\x1b[2J\nb"), "a [2J b");
}

static void put(const char *root, const char *path, const char *text) {
    char command[400];
    snprintf(command, sizeof command,
             "mkdir -p \"$(dirname '%s%s')\" && printf '%%s\\n' '%s' > '%s%s'", root, path, text,
             root, path);
    assert_int_equal(system(command), 0);
}

static void test_the_machine_is_asked_for_its_names(void **state) {
    (void)state;
    char root[] = "/tmp/gnomon-redact-XXXXXX";
    assert_non_null(mkdtemp(root));
    put(root, "/etc/hostname", "foyer-west.museum.example");
    put(root, "/etc/machine-id", "0123456789abcdef0123456789abcdef");
    put(root, "/proc/device-tree/serial-number", "10000000deadbeef");
    put(root, "/sys/class/dmi/id/board_serial", "BRD77123");
    put(root, "/sys/class/net/eth0/address", "dc:a6:32:aa:bb:cc");
    put(root, "/sys/class/dmi/id/chassis_serial", "None");
    put(root, "/sys/class/dmi/id/product_serial", "SN 4711  ");
    setenv("SUDO_USER", "wilhelmine", 1);
    setenv("DISPLAY", "gallery:0", 1);
    gn_redact_read(&redact, root);
    assert_string_equal(redacted("foyer-west 10000000deadbeef BRD77123 wilhelmine"),
                        "(name) (name) (name) (name)");
    assert_string_equal(redacted("0123456789ABCDEF0123456789abcdef dc:a6:32:aa:bb:cc"),
                        "(name) (address)");
    assert_string_equal(redacted("none, SN 4711."), "none, (name).");
    assert_string_equal(redacted("gallery:1 or 0"), "(name):1 or 0");
    setenv("DISPLAY", ":0", 1);
    gn_redact_read(&redact, root);
    assert_string_equal(redacted("screen :0"), "screen :0");
    unsetenv("DISPLAY");
    unsetenv("SUDO_USER");
    assert_int_equal(gn_test_remove_folder(root), 0);
}

#define TEST(name) cmocka_unit_test_setup(name, setup)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_names_go_as_words_and_long_ones_anywhere),
        TEST(test_names_that_systems_give_stay),
        TEST(test_paths_go_but_for_numbered_devices),
        TEST(test_addresses_go_and_versions_stay),
        TEST(test_what_does_not_fit_is_cut_and_control_characters_go),
        TEST(test_the_machine_is_asked_for_its_names),
    };
    return RUN(tests);
}
