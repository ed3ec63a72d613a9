/* The kernel's files, made by hand in a folder. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/doctor_report.h"
#include "cli/machine.h"
#include "unit/folder.h"

static char root[64];
static struct gn_machine machine;

static void put(const char *path, const char *text) {
    char full[256], command[600];
    snprintf(full, sizeof full, "%s%s", root, path);
    snprintf(command, sizeof command, "mkdir -p \"$(dirname '%s')\"", full);
    assert_int_equal(system(command), 0);
    FILE *file = fopen(full, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void put_link(const char *path, const char *target) {
    char full[256];
    put(path, "");
    snprintf(full, sizeof full, "%s%s", root, path);
    unlink(full);
    assert_int_equal(symlink(target, full), 0);
}

static int setup(void **state) {
    (void)state;
    strcpy(root, "/tmp/gnomon-machine-XXXXXX");
    return mkdtemp(root) ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    return gn_test_remove_folder(root);
}

static void test_a_bare_machine_has_nothing(void **state) {
    (void)state;
    gn_machine_read(&machine, root);
    assert_int_equal(machine.device_count, 0);
    assert_int_equal(machine.connector_count, 0);
    assert_int_equal(machine.memory_mb, 0);
    assert_string_equal(machine.model, "");
    assert_true(machine.group_count > 0);
    assert_true(machine.cpus > 0);
}

static void test_a_board_is_read(void **state) {
    (void)state;
    put("/proc/device-tree/model", "Raspberry Pi 4 Model B Rev 1.4");
    put("/etc/os-release", "NAME=x\nPRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\n");
    put("/proc/meminfo", "MemTotal:  3884632 kB\nMemAvailable: 2048000 kB\nCmaTotal: 524288 kB\n");
    gn_machine_read(&machine, root);
    assert_string_equal(machine.model, "Raspberry Pi 4 Model B Rev 1.4");
    assert_string_equal(machine.system, "Debian GNU/Linux 12 (bookworm)");
    assert_int_equal(machine.memory_mb, 3793);
    assert_int_equal(machine.free_mb, 2000);
    assert_int_equal(machine.cma_mb, 512);
}

static void test_cards_connectors_and_chips_are_found(void **state) {
    (void)state;
    put("/dev/dri/card1", "");
    put("/dev/dri/renderD128", "");
    put("/dev/gpiochip0", "");
    put_link("/sys/class/drm/card1/device/driver", "../../../../bus/platform/drivers/vc4-drm");
    put_link("/sys/bus/gpio/devices/gpiochip0", "../../../devices/soc/fe200000.gpio/gpiochip0");
    put("/sys/class/drm/card1-HDMI-A-1/status", "connected\n");
    put("/sys/class/drm/card1-HDMI-A-1/modes", "1920x1080\n1920x1080\n1280x720\n");
    gn_machine_read(&machine, root);
    assert_int_equal(machine.device_count, 3);
    assert_string_equal(machine.devices[0].path, "/dev/dri/card1");
    assert_string_equal(machine.devices[0].driver, "vc4-drm");
    assert_int_equal(machine.devices[1].kind, GN_DEVICE_RENDER);
    assert_string_equal(machine.devices[2].driver, "fe200000.gpio");
    assert_int_equal(machine.connector_count, 1);
    assert_string_equal(machine.connectors[0].name, "card1-HDMI-A-1");
    assert_string_equal(machine.connectors[0].status, "connected");
    assert_string_equal(machine.connectors[0].mode, "1920x1080");
    assert_string_equal(machine.connectors[0].modes, "1920x1080 1280x720");
    assert_string_equal(machine.connectors[0].monitor, "");
}

/* Dell's U2415, whose serial number is behind the product code; and an EDID that is cut. */
static void test_a_monitor_is_its_vendor_and_product(void **state) {
    (void)state;
    static const char edid[] =
        "\\000\\377\\377\\377\\377\\377\\377\\000\\020\\254\\272\\240\\114\\123\\105\\122";
    static const char *const folders[] = {"/sys/class/drm/card0-DP-1", "/sys/class/drm/card0-DP-2"};
    char path[128], command[400];
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/status", folders[i]);
        put(path, "connected\n");
        snprintf(command, sizeof command, "printf '%.*s' > '%s%s/edid'", i ? 40 : 99, edid, root,
                 folders[i]);
        assert_int_equal(system(command), 0);
    }
    gn_machine_read(&machine, root);
    assert_string_equal(machine.connectors[0].monitor, "DEL a0ba");
    assert_string_equal(machine.connectors[1].monitor, "");
}

static void test_a_pc_is_named_by_dmi(void **state) {
    (void)state;
    put("/sys/class/dmi/id/sys_vendor", "LENOVO\n");
    put("/sys/class/dmi/id/product_name", "20W0\n");
    put("/proc/cpuinfo", "processor\t: 0\nmodel name\t: AMD Ryzen 5\nflags\t: fpu\n");
    gn_machine_read(&machine, root);
    assert_string_equal(machine.model, "LENOVO 20W0");
    assert_string_equal(machine.cpu, "AMD Ryzen 5");
}

/* ---- what doctor makes of it ---- */

static struct gn_doctor_report report;

static bool has_problem(const char *what, const char *cure) {
    for (uint32_t i = 0; i < report.problems.count; i++)
        if (strstr(report.problems.items[i].what, what) &&
            strstr(report.problems.items[i].cure, cure))
            return true;
    return false;
}

static void test_a_missing_group_is_the_cure(void **state) {
    (void)state;
    report = (struct gn_doctor_report){.chosen = -1};
    struct gn_machine *m = &report.machine;
    strcpy(m->user, "pi");
    strcpy(m->groups[m->group_count++], "pi");
    m->device_count = 2;
    m->devices[0] = (struct gn_device){
        .kind = GN_DEVICE_CARD, .path = "/dev/dri/card0", .group = "video", .group_may = true};
    m->devices[1] = (struct gn_device){
        .kind = GN_DEVICE_GPIO, .path = "/dev/gpiochip0", .group = "root", .readable = true};
    gn_doctor_diagnose(&report);
    assert_true(has_problem("pi may not open /dev/dri/card0", "usermod -aG video pi"));
    assert_true(has_problem("pi may not write /dev/gpiochip0", "GROUP=\"gpio\""));
}

static void test_a_backend_brings_its_cure(void **state) {
    (void)state;
    report = (struct gn_doctor_report){.chosen = -1, .backend_count = 2};
    report.backends[0] = (struct gn_doctor_backend){
        .name = "egl", .built = true, .why = "libEGL.so.1 is missing; install libegl1"};
    report.backends[1] = (struct gn_doctor_backend){.name = "kms", .is_console = true};
    gn_doctor_diagnose(&report);
    assert_true(has_problem("backend egl: libEGL.so.1 is missing", "install libegl1"));
    assert_false(has_problem("kms", ""));
    assert_true(has_problem("no display card", "vc4-kms-v3d"));
}

static void test_the_cpu_is_not_taken_for_a_gpu(void **state) {
    (void)state;
    report = (struct gn_doctor_report){.backend_count = 1};
    report.backends[0] = (struct gn_doctor_backend){.name = "egl", .built = true, .opens = true};
    report.backends[0].caps.software = true;
    strcpy(report.backends[0].caps.renderer, "llvmpipe");
    gn_doctor_diagnose(&report);
    assert_true(has_problem("the CPU draws (llvmpipe)", "OpenGL ES 3"));
    assert_true(has_problem("no map format but rgba8", "driver"));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_a_bare_machine_has_nothing),
        TEST(test_a_board_is_read),
        TEST(test_cards_connectors_and_chips_are_found),
        TEST(test_a_monitor_is_its_vendor_and_product),
        TEST(test_a_pc_is_named_by_dmi),
        cmocka_unit_test(test_a_missing_group_is_the_cure),
        cmocka_unit_test(test_a_backend_brings_its_cure),
        cmocka_unit_test(test_the_cpu_is_not_taken_for_a_gpu),
    };
    return RUN(tests);
}
