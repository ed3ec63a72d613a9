#include "options/binding.h"

#include "core/key.h"
#include "core/text.h"

static const struct gn_button_config defaults[] = {
    {.opts =
         {.name = "next", .line = "GPIO17", .keys = "space right pagedown n tap", .optional = true},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_NEXT}}},
    {.opts =
         {.name = "prev", .line = "GPIO27", .keys = "backspace left pageup p", .optional = true},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_PREV}}},
    {.opts = {.name = "camera", .keys = "c"},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_NEXT_CAMERA}}},
    {.opts = {.name = "scene", .keys = "s"},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_NEXT_SCENE}}},
    {.opts = {.name = "pause", .keys = "pause k"},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_PAUSE}}},
    {.opts = {.name = "blank", .keys = "b"},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_BLANK}}},
    {.opts = {.name = "info", .keys = "i"},
     .on[GN_GESTURE_PRESS] = {true, {.kind = GN_ACTION_INFO}}},
};
enum { DEFAULTS = sizeof defaults / sizeof defaults[0] };
_Static_assert(DEFAULTS <= GN_BUTTONS_MAX, "an input takes so many");

void gn_buttons_defaults(struct gn_buttons *out) {
    *out = (struct gn_buttons){.count = DEFAULTS};
    for (int i = 0; i < DEFAULTS; i++) out->items[i] = defaults[i];
}

int gn_buttons_opts(const struct gn_buttons *buttons, struct gn_button_opts *out) {
    for (int i = 0; i < buttons->count; i++) {
        out[i] = buttons->items[i].opts;
        out[i].gestures = 0;
        for (int g = 0; g < GN_GESTURE_COUNT; g++)
            if (buttons->items[i].on[g].bound) out[i].gestures |= 1u << g;
    }
    return buttons->count;
}

bool gn_buttons_have_key(const struct gn_buttons *buttons, unsigned key) {
    for (int i = 0; i < buttons->count; i++) {
        char name[64];
        for (const char *at = buttons->items[i].opts.keys;
             at && gn_text_word(&at, name, sizeof name);)
            if (gn_key_find(name) == key) return true;
    }
    return false;
}

bool gn_buttons_name_mode(const struct gn_buttons *buttons) {
    for (int i = 0; i < buttons->count; i++)
        for (int g = 0; g < GN_GESTURE_COUNT; g++) {
            const struct gn_binding *on = &buttons->items[i].on[g];
            if (on->bound && on->action.kind == GN_ACTION_MODE) return true;
        }
    return false;
}

struct gn_action gn_buttons_action(const struct gn_buttons *buttons,
                                   const struct gn_gesture_event *event) {
    static const struct gn_action nothing;
    if (event->button < 0 || event->button >= buttons->count) return nothing;
    const struct gn_binding *on = &buttons->items[event->button].on[event->gesture];
    return on->bound ? on->action : nothing;
}
