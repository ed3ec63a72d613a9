/* A keyboard that a script types on: lines "down NUMBER", "up NUMBER" or "tap NUMBER" on stdin,
 * with Linux's numbers of keys; at their end it is pulled out. */
#include <fcntl.h>
#include <linux/uinput.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int send_event(int fd, int type, int code, int value) {
    const struct input_event event = {
        .type = (unsigned short)type, .code = (unsigned short)code, .value = value};
    return write(fd, &event, sizeof event) == sizeof event ? 0 : -1;
}

static int send_key(int fd, int key, int down) {
    return send_event(fd, EV_KEY, key, down) || send_event(fd, EV_SYN, SYN_REPORT, 0);
}

static int plug_in(int fd) {
    struct uinput_setup setup = {.id = {.bustype = BUS_USB, .vendor = 1, .product = 1}};
    snprintf(setup.name, sizeof setup.name, "a keyboard of the test");
    int error = fd < 0 || ioctl(fd, UI_SET_EVBIT, EV_KEY);
    for (int key = 1; key < 128 && !error; key++) error = ioctl(fd, UI_SET_KEYBIT, key);
    return error || ioctl(fd, UI_DEV_SETUP, &setup) || ioctl(fd, UI_DEV_CREATE);
}

int main(void) {
    const int fd = open("/dev/uinput", O_WRONLY | O_CLOEXEC);
    char word[8];
    int key, error = plug_in(fd);
    while (!error && scanf("%7s %d", word, &key) == 2) {
        if (strcmp(word, "up") != 0) error = send_key(fd, key, 1);
        if (strcmp(word, "down") != 0) error = error || send_key(fd, key, 0);
    }
    if (error) perror("keyboard");
    return error ? 1 : 0;
}
