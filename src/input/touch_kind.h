/* What of a device's abilities makes it a touch screen, a tablet or a mouse. Pure. */
#ifndef GN_INPUT_TOUCH_KIND_H
#define GN_INPUT_TOUCH_KIND_H

#include "core/key.h"
#include "input/touch.h"

struct gn_touch_abilities { /* bits as the kernel has them: bit code % 8 of byte code / 8 */
    uint8_t keys[GN_KEY_COUNT / 8], abs[8], rel[2], props[4];
};

/* GN_TOUCH_NONE: also touchpads, drawing tablets beside a screen, joysticks, accelerometers. */
enum gn_touch_kind gn_touch_kind(const struct gn_touch_abilities *abilities);
/* A knob that turns without end: one axis of a rotary encoder, a dial, or a wheel without a
 * pointer. */
bool gn_touch_is_knob(const struct gn_touch_abilities *abilities);
/* Fingers are reported by protocol B. */
bool gn_touch_has_slots(const struct gn_touch_abilities *abilities);

#endif
