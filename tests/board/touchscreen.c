/* A touch screen that a script works on, of 200 x 150 mm: lines "tap X Y", "drag X Y TO_X TO_Y",
 * "hold X Y TO_X TO_Y" (the finger stays down) or "lift" on stdin, in thousandths of the panel; at
 * their end it is pulled out. */
#include <fcntl.h>
#include <linux/uinput.h>
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

static int put_finger(int fd, int x, int y) {
    return send_event(fd, EV_ABS, ABS_MT_POSITION_X, x) ||
           send_event(fd, EV_ABS, ABS_MT_POSITION_Y, y);
}

static int touch(int fd, int x, int y) {
    static int id;
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
    return send_event(fd, EV_ABS, ABS_MT_TRACKING_ID, -1) || send_event(fd, EV_KEY, BTN_TOUCH, 0) ||
           report(fd);
}

static int set_axis(int fd, int code, int max, int per_mm) {
    const struct uinput_abs_setup axis = {.code = (unsigned short)code,
                                          .absinfo = {.maximum = max, .resolution = per_mm}};
    return ioctl(fd, UI_ABS_SETUP, &axis);
}

static int plug_in(int fd) {
    struct uinput_setup setup = {.id = {.bustype = BUS_USB, .vendor = 1, .product = 2}};
    snprintf(setup.name, sizeof setup.name, "a touch screen of the test");
    return fd < 0 || ioctl(fd, UI_SET_EVBIT, EV_KEY) || ioctl(fd, UI_SET_KEYBIT, BTN_TOUCH) ||
           ioctl(fd, UI_SET_EVBIT, EV_ABS) || ioctl(fd, UI_SET_PROPBIT, INPUT_PROP_DIRECT) ||
           set_axis(fd, ABS_MT_SLOT, 9, 0) || set_axis(fd, ABS_MT_TRACKING_ID, 65535, 0) ||
           set_axis(fd, ABS_MT_POSITION_X, 1000, 5) || set_axis(fd, ABS_MT_POSITION_Y, 1000, 7) ||
           ioctl(fd, UI_DEV_SETUP, &setup) || ioctl(fd, UI_DEV_CREATE);
}

int main(void) {
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
