/* Devices as kernels describe them (evtest, libinput record), and what they are. */
#include "input/touch_kind.h"

#include <linux/input-event-codes.h>

#include "check.h"

enum { CODES = 12, END = -1 };
static const struct {
    const char *name;
    enum gn_touch_kind kind;
    bool slots;
    int keys[CODES], abs[CODES], rel[CODES], props[4];
} devices[] = {
    {"Goodix, FT5406 and other glass of boards",
     GN_TOUCH_SCREEN,
     true,
     {BTN_TOUCH, END},
     {ABS_X, ABS_Y, ABS_MT_SLOT, ABS_MT_TOUCH_MAJOR, ABS_MT_POSITION_X, ABS_MT_POSITION_Y,
      ABS_MT_TRACKING_ID, END},
     {END},
     {INPUT_PROP_DIRECT, END}},
    {"a USB touch screen of hid-multitouch",
     GN_TOUCH_SCREEN,
     true,
     {BTN_TOUCH, END},
     {ABS_X, ABS_Y, ABS_MT_SLOT, ABS_MT_POSITION_X, ABS_MT_POSITION_Y, ABS_MT_TRACKING_ID, END},
     {END},
     {INPUT_PROP_DIRECT, END}},
    {"ADS7846 Touchscreen, resistive",
     GN_TOUCH_SCREEN,
     false,
     {BTN_TOUCH, END},
     {ABS_X, ABS_Y, ABS_PRESSURE, END},
     {END},
     {END}},
    {"eGalax, protocol A beside one finger",
     GN_TOUCH_SCREEN,
     false,
     {BTN_TOUCH, END},
     {ABS_X, ABS_Y, ABS_MT_POSITION_X, ABS_MT_POSITION_Y, END},
     {END},
     {INPUT_PROP_DIRECT, END}},
    {"a pen display",
     GN_TOUCH_SCREEN,
     false,
     {BTN_TOUCH, BTN_TOOL_PEN, BTN_STYLUS, END},
     {ABS_X, ABS_Y, ABS_PRESSURE, END},
     {END},
     {INPUT_PROP_DIRECT, END}},
    {"SynPS/2 Synaptics TouchPad",
     GN_TOUCH_NONE,
     true,
     {BTN_LEFT, BTN_TOOL_FINGER, BTN_TOUCH, BTN_TOOL_DOUBLETAP, END},
     {ABS_X, ABS_Y, ABS_MT_SLOT, ABS_MT_POSITION_X, ABS_MT_POSITION_Y, ABS_MT_TRACKING_ID, END},
     {END},
     {INPUT_PROP_POINTER, END}},
    {"a drawing tablet beside the screen",
     GN_TOUCH_NONE,
     false,
     {BTN_TOUCH, BTN_TOOL_PEN, BTN_STYLUS, END},
     {ABS_X, ABS_Y, ABS_PRESSURE, END},
     {END},
     {INPUT_PROP_POINTER, END}},
    {"QEMU USB Tablet",
     GN_TOUCH_TABLET,
     false,
     {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, END},
     {ABS_X, ABS_Y, END},
     {REL_WHEEL, END},
     {END}},
    {"QEMU Virtio Tablet",
     GN_TOUCH_TABLET,
     false,
     {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, BTN_TOUCH, END},
     {ABS_X, ABS_Y, END},
     {REL_WHEEL, END},
     {END}},
    {"a mouse",
     GN_TOUCH_MOUSE,
     false,
     {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, BTN_SIDE, END},
     {END},
     {REL_X, REL_Y, REL_WHEEL, END},
     {END}},
    {"a keyboard with a dial",
     GN_TOUCH_NONE,
     false,
     {KEY_A, KEY_SPACE, END},
     {ABS_VOLUME, END},
     {REL_HWHEEL, END},
     {END}},
    {"a gamepad",
     GN_TOUCH_NONE,
     false,
     {BTN_SOUTH, BTN_EAST, BTN_START, END},
     {ABS_X, ABS_Y, ABS_RX, ABS_RY, ABS_HAT0X, END},
     {END},
     {END}},
    {"an accelerometer",
     GN_TOUCH_NONE,
     false,
     {BTN_LEFT, END},
     {ABS_X, ABS_Y, ABS_Z, END},
     {END},
     {INPUT_PROP_ACCELEROMETER, END}},
    {"a device that claims all axes",
     GN_TOUCH_NONE,
     false,
     {BTN_TRIGGER, END},
     {ABS_X, ABS_Y, ABS_MT_SLOT - 1, ABS_MT_SLOT, ABS_MT_POSITION_X, ABS_MT_POSITION_Y,
      ABS_MT_TRACKING_ID, END},
     {END},
     {END}},
    {"nothing", GN_TOUCH_NONE, false, {END}, {END}, {END}, {END}},
};

static void put_all(uint8_t *bits, const int *codes) {
    for (; *codes != END; codes++) bits[*codes / 8] |= (uint8_t)(1u << *codes % 8);
}

static void test_each_device_is_what_it_is(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof devices / sizeof devices[0]; i++) {
        struct gn_touch_abilities a = {0};
        put_all(a.keys, devices[i].keys);
        put_all(a.abs, devices[i].abs);
        put_all(a.rel, devices[i].rel);
        put_all(a.props, devices[i].props);
        if (gn_touch_kind(&a) != devices[i].kind || gn_touch_has_slots(&a) != devices[i].slots)
            fail_msg("%s: kind %d", devices[i].name, (int)gn_touch_kind(&a));
    }
}

static void test_a_knob_has_an_axis_and_no_plane(void **state) {
    (void)state;
    static const struct {
        const char *name;
        bool is;
        int keys[3], abs[3], rel[5];
    } rows[] = {
        {"rotary-encoder of a device tree, with its default axis",
         true,
         {END},
         {END},
         {REL_X, END}},
        {"the same, of the other axis", true, {END}, {END}, {REL_Y, END}},
        {"Griffin PowerMate, rotary@ with a button", true, {BTN_0, END}, {END}, {REL_DIAL, END}},
        {"Surface Dial", true, {BTN_0, END}, {END}, {REL_DIAL, REL_WHEEL_HI_RES, END}},
        {"a wheel alone", true, {KEY_MUTE, END}, {END}, {REL_WHEEL, REL_WHEEL_HI_RES, END}},
        {"a mouse", false, {BTN_LEFT, END}, {END}, {REL_X, REL_Y, REL_WHEEL, END}},
        {"a trackpoint without a button", false, {END}, {END}, {REL_X, REL_Y, END}},
        {"a tablet with a wheel", false, {BTN_LEFT, END}, {ABS_X, ABS_Y, END}, {REL_WHEEL, END}},
        {"a keyboard", false, {KEY_A, END}, {END}, {END}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct gn_touch_abilities a = {0};
        put_all(a.keys, rows[i].keys);
        put_all(a.abs, rows[i].abs);
        put_all(a.rel, rows[i].rel);
        if (gn_touch_is_knob(&a) != rows[i].is) fail_msg("%s", rows[i].name);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_device_is_what_it_is),
                                       cmocka_unit_test(test_a_knob_has_an_axis_and_no_plane)};
    return RUN(tests);
}
