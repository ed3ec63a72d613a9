#include <unistd.h>

#include "display/kms/uevent.h"
#include "unit/check.h"

#define MESSAGE(text) text, sizeof(text) /* with its last zero byte, as the kernel sends it */

static void test_what_is_about_displays(void **state) {
    (void)state;
    assert_true(gn_uevent_is_drm(MESSAGE("change@/devices/pci0/drm/card0\0ACTION=change\0"
                                         "SUBSYSTEM=drm\0HOTPLUG=1\0CONNECTOR=31")));
    assert_true(gn_uevent_is_drm(MESSAGE("add@/devices/x\0ACTION=add\0SUBSYSTEM=drm")));
    assert_false(gn_uevent_is_drm(MESSAGE("add@/devices/drm\0ACTION=add\0SUBSYSTEM=usb")));
    assert_false(gn_uevent_is_drm(MESSAGE("add@/devices/x\0SUBSYSTEM=drm_dp_aux_dev")));
    assert_false(gn_uevent_is_drm(MESSAGE("add@/devices/x\0XSUBSYSTEM=drm")));
}

static void test_cut_messages(void **state) {
    (void)state;
    static const char text[] = "change@/x\0SUBSYSTEM=drm";
    for (size_t size = 0; size < sizeof text - 1; size++)
        assert_false(gn_uevent_is_drm(text, size));
    assert_true(gn_uevent_is_drm(text, sizeof text - 1));
}

static void test_a_quiet_socket(void **state) {
    (void)state;
    const int fd = gn_uevent_open();
    if (fd < 0) skip();
    gn_uevent_read(fd); /* returns, whatever there was */
    close(fd);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_about_displays),
        cmocka_unit_test(test_cut_messages),
        cmocka_unit_test(test_a_quiet_socket),
    };
    return RUN(tests);
}
