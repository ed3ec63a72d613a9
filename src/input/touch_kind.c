#include "input/touch_kind.h"

#include <linux/input-event-codes.h>

_Static_assert(KEY_CNT / 8 == sizeof((struct gn_touch_abilities *)0)->keys, "as the kernel's");
_Static_assert(ABS_CNT / 8 == sizeof((struct gn_touch_abilities *)0)->abs, "as the kernel's");
_Static_assert(REL_CNT / 8 == sizeof((struct gn_touch_abilities *)0)->rel, "as the kernel's");
_Static_assert(INPUT_PROP_CNT / 8 == sizeof((struct gn_touch_abilities *)0)->props,
               "as the kernel's");

static bool has(const uint8_t *bits, unsigned code) { return bits[code / 8] >> code % 8 & 1; }

bool gn_touch_has_slots(const struct gn_touch_abilities *a) {
    /* a device with all axes is no touch screen */
    return has(a->abs, ABS_MT_SLOT) && !has(a->abs, ABS_MT_SLOT - 1) &&
           has(a->abs, ABS_MT_TRACKING_ID) && has(a->abs, ABS_MT_POSITION_X) &&
           has(a->abs, ABS_MT_POSITION_Y);
}

/* The rules by which udev distinguishes them; a bare board may have no udev. */
enum gn_touch_kind gn_touch_kind(const struct gn_touch_abilities *a) {
    const bool touch = has(a->keys, BTN_TOUCH), left = has(a->keys, BTN_LEFT),
               direct = has(a->props, INPUT_PROP_DIRECT),
               apart = !direct && (has(a->keys, BTN_TOOL_FINGER) || has(a->keys, BTN_TOOL_PEN) ||
                                   has(a->keys, BTN_STYLUS)),
               plane = has(a->abs, ABS_X) && has(a->abs, ABS_Y);
    if (has(a->props, INPUT_PROP_ACCELEROMETER) || apart) return GN_TOUCH_NONE;
    if (gn_touch_has_slots(a) && (touch || direct)) return GN_TOUCH_SCREEN;
    if (plane && touch && (direct || !left)) return GN_TOUCH_SCREEN;
    if (plane && left) return GN_TOUCH_TABLET;
    return has(a->rel, REL_X) && has(a->rel, REL_Y) && left ? GN_TOUCH_MOUSE : GN_TOUCH_NONE;
}

bool gn_touch_is_knob(const struct gn_touch_abilities *a) {
    const bool moves = has(a->rel, REL_X) && has(a->rel, REL_Y);
    bool any = false;
    for (size_t i = 0; i < sizeof a->rel; i++) any |= a->rel[i];
    return any && !moves && !has(a->abs, ABS_X) && !has(a->abs, ABS_MT_SLOT);
}
