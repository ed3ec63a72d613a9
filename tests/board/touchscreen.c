/* A touch screen that a script works on, of 200 x 143 mm: lines "tap X Y", "drag X Y TO_X TO_Y",
 * "hold X Y TO_X TO_Y" (the finger stays down) or "lift" on stdin, in thousandths of the panel; at
 * their end it is pulled out. With the argument "mouse" a mouse, whose drags are as many counts
 * with its left button down, and taps clicks. */
#include <fcntl.h>
#include <linux/uinput.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { STEPS = 10, STEP_US = 20000 };

static int send_event(int fd, int type, int code, int value) {
    const struct input_event event = {
        .type = (unsigned short)type, .code = (unsigned short)code, .value = value};
    return write(fd, &event, sizeof event) == sizeof event ? 0 : -1;
}

static int report(int fd) {
    const int error = send_event(fd, EV_SYN, SYN_REPORT, 0);
    usleep(STEP_US);
    return error;
}

static bool is_mouse;

static int put_finger(int fd, int x, int y) {
    static int last_x, last_y;
    const int by_x = x - last_x, by_y = y - last_y;
    last_x = x;
    last_y = y;
    if (is_mouse) return send_event(fd, EV_REL, REL_X, by_x) || send_event(fd, EV_REL, REL_Y, by_y);
    return send_event(fd, EV_ABS, ABS_MT_POSITION_X, x) ||
           send_event(fd, EV_ABS, ABS_MT_POSITION_Y, y);
}

static int touch(int fd, int x, int y) {
    static int id;
    if (is_mouse) /* it goes there, and then the button goes down */
        return put_finger(fd, x, y) || report(fd) || send_event(fd, EV_KEY, BTN_LEFT, 1) ||
               report(fd);
    return send_event(fd, EV_ABS, ABS_MT_SLOT, 0) ||
           send_event(fd, EV_ABS, ABS_MT_TRACKING_ID, ++id) || put_finger(fd, x, y) ||
           send_event(fd, EV_KEY, BTN_TOUCH, 1) || report(fd);
}

static int slide(int fd, int x, int y, int to_x, int to_y) {
    int error = 0;
    for (int i = 1; i <= STEPS && !error; i++)
        error =
            put_finger(fd, x + (to_x - x) * i / STEPS, y + (to_y - y) * i / STEPS) || report(fd);
    return error;
}

static int lift(int fd) {
    if (is_mouse) return send_event(fd, EV_KEY, BTN_LEFT, 0) || report(fd);
    return send_event(fd, EV_ABS, ABS_MT_TRACKING_ID, -1) || send_event(fd, EV_KEY, BTN_TOUCH, 0) ||
           report(fd);
}

static int set_axis(int fd, int code, int max, int per_mm) {
    const struct uinput_abs_setup axis = {.code = (unsigned short)code,
                                          .absinfo = {.maximum = max, .resolution = per_mm}};
    return ioctl(fd, UI_ABS_SETUP, &axis);
}

static int make_mouse(int fd) {
    return ioctl(fd, UI_SET_KEYBIT, BTN_LEFT) || ioctl(fd, UI_SET_KEYBIT, BTN_RIGHT) ||
           ioctl(fd, UI_SET_EVBIT, EV_REL) || ioctl(fd, UI_SET_RELBIT, REL_X) ||
           ioctl(fd, UI_SET_RELBIT, REL_Y);
}

static int make_glass(int fd) {
    return ioctl(fd, UI_SET_KEYBIT, BTN_TOUCH) || ioctl(fd, UI_SET_EVBIT, EV_ABS) ||
           ioctl(fd, UI_SET_PROPBIT, INPUT_PROP_DIRECT) || set_axis(fd, ABS_MT_SLOT, 9, 0) ||
           set_axis(fd, ABS_MT_TRACKING_ID, 65535, 0) || set_axis(fd, ABS_MT_POSITION_X, 1000, 5) ||
           set_axis(fd, ABS_MT_POSITION_Y, 1000, 7);
}

static int plug_in(int fd) {
    struct uinput_setup setup = {.id = {.bustype = BUS_USB, .vendor = 1, .product = 2}};
    snprintf(setup.name, sizeof setup.name, "a %s of the test",
             is_mouse ? "mouse" : "touch screen");
    return fd < 0 || ioctl(fd, UI_SET_EVBIT, EV_KEY) ||
           (is_mouse ? make_mouse(fd) : make_glass(fd)) || ioctl(fd, UI_DEV_SETUP, &setup) ||
           ioctl(fd, UI_DEV_CREATE);
}

int main(int argc, char *argv[]) {
    is_mouse = argc > 1 && strcmp(argv[1], "mouse") == 0;
    const int fd = open("/dev/uinput", O_WRONLY | O_CLOEXEC);
    char word[8];
    int x, y, to_x, to_y, error = plug_in(fd);
    while (!error && scanf("%7s", word) == 1) {
        if (strcmp(word, "lift") == 0) {
            error = lift(fd);
        } else if (strcmp(word, "tap") == 0 && scanf("%d %d", &x, &y) == 2) {
            error = touch(fd, x, y) || lift(fd);
        } else if (scanf("%d %d %d %d", &x, &y, &to_x, &to_y) == 4) {
            error = touch(fd, x, y) || slide(fd, x, y, to_x, to_y);
            if (strcmp(word, "drag") == 0) error = error || lift(fd);
        }
    }
    if (error) perror("touchscreen");
    return error ? 1 : 0;
}
