/* The text console under the screen, by a VT of our own behind ioctl(): what it is left as, however
 * the program ends. */
#include "check.h"

#include <errno.h>
#include <linux/kd.h>
#include <linux/vt.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "display/kms/console.h"

static struct {
    bool is_there, refuses_keyboard;
    int mode;
    long keyboard;
    struct vt_mode switches;
} vt;

/* In front of the C library's. As in the kernel (drivers/tty/vt/vt_ioctl.c), modes are values, and
 * what is read goes to where the argument points. */
int ioctl(int fd, unsigned long request, ...) {
    va_list args;
    va_start(args, request);
    void *argument = va_arg(args, void *);
    va_end(args);
    const bool of_vt = request >> 8 == 'K' || request >> 8 == 'V';
    if (!of_vt) return (int)syscall(SYS_ioctl, fd, request, argument);
    if (!vt.is_there) return errno = ENOTTY, -1;
    switch (request) {
    case KDGETMODE: *(int *)argument = vt.mode; return 0;
    case KDSETMODE: vt.mode = (int)(intptr_t)argument; return 0;
    case KDGKBMODE: *(int *)argument = (int)vt.keyboard; return 0;
    case KDSKBMODE:
        if (vt.refuses_keyboard) return errno = EPERM, -1;
        vt.keyboard = (long)(intptr_t)argument;
        return 0;
    case VT_GETMODE: *(struct vt_mode *)argument = vt.switches; return 0;
    case VT_SETMODE: vt.switches = *(struct vt_mode *)argument; return 0;
    case VT_RELDISP: return 0;
    default: return errno = EINVAL, -1;
    }
}

static struct gn_loop *loop;
static struct gn_console console;

static int setup(void **state) {
    struct gn_err err;
    (void)state;
    memset(&vt, 0, sizeof vt);
    vt.is_there = true;
    vt.mode = KD_TEXT;
    vt.keyboard = K_XLATE;
    loop = gn_loop_open(&err);
    return loop ? 0 : -1;
}

static int teardown(void **state) {
    (void)state;
    gn_loop_close(loop);
    return 0;
}

static void test_an_open_console_keeps_its_keyboard(void **state) {
    (void)state;
    gn_console_open(&console, loop, false);
    assert_int_equal(vt.mode, KD_GRAPHICS);
    assert_int_equal(vt.keyboard, K_XLATE);
    assert_false(console.locks_keys);
    gn_console_close(&console);
    assert_int_equal(vt.mode, KD_TEXT);
    assert_int_equal(vt.keyboard, K_XLATE);
    assert_int_equal(vt.switches.mode, VT_AUTO);
}

static void test_a_locked_one_has_none_until_it_is_closed(void **state) {
    (void)state;
    gn_console_open(&console, loop, true);
    assert_int_equal(vt.keyboard, K_OFF);
    assert_true(console.locks_keys);
    gn_console_let_go(&console); /* root's chvt: the mode is the VT's own, and stays */
    assert_int_equal(vt.keyboard, K_OFF);
    gn_console_close(&console);
    assert_int_equal(vt.keyboard, K_XLATE);
    assert_int_equal(vt.mode, KD_TEXT);
}

static void test_what_a_killed_one_left_off_comes_back(void **state) {
    (void)state;
    for (int locked = 0; locked < 2; locked++) {
        vt.keyboard = K_OFF;
        vt.mode = KD_GRAPHICS;
        gn_console_open(&console, loop, locked);
        assert_int_equal(vt.keyboard, locked ? K_OFF : K_UNICODE);
        gn_console_close(&console);
        assert_int_equal(vt.keyboard, K_UNICODE);
        assert_int_equal(vt.mode, KD_TEXT);
    }
}

static void test_without_a_console_or_a_right_nothing_is_locked(void **state) {
    (void)state;
    vt.refuses_keyboard = true;
    gn_console_open(&console, loop, true);
    assert_false(console.locks_keys);
    assert_int_equal(vt.mode, KD_GRAPHICS);
    gn_console_close(&console);
    assert_int_equal(vt.keyboard, K_XLATE);
    vt.is_there = false;
    gn_console_open(&console, loop, true);
    assert_int_equal(console.tty, -1);
    assert_false(console.locks_keys);
    gn_console_close(&console);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_an_open_console_keeps_its_keyboard),
        TEST(test_a_locked_one_has_none_until_it_is_closed),
        TEST(test_what_a_killed_one_left_off_comes_back),
        TEST(test_without_a_console_or_a_right_nothing_is_locked),
    };
    return RUN(tests);
}
