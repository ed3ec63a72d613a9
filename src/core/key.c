#include "core/key.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* By code; those without a number in brackets have the code after that of the one before. */
/* clang-format off */
static const char *const names[GN_KEY_COUNT] = {
    [1] = "esc", "1", "2", "3", "4", "5", "6", "7", "8", "9", "0", "minus", "equal", "backspace",
    "tab", "q", "w", "e", "r", "t", "y", "u", "i", "o", "p", "leftbrace", "rightbrace", "enter",
    "leftctrl", "a", "s", "d", "f", "g", "h", "j", "k", "l", "semicolon", "apostrophe", "grave",
    "leftshift", "backslash", "z", "x", "c", "v", "b", "n", "m", "comma", "dot", "slash",
    "rightshift", "kpasterisk", "leftalt", "space", "capslock", "f1", "f2", "f3", "f4", "f5", "f6",
    "f7", "f8", "f9", "f10", [71] = "kp7", "kp8", "kp9", "kpminus", "kp4", "kp5", "kp6", "kpplus",
    "kp1", "kp2", "kp3", "kp0", "kpdot", [87] = "f11", "f12", [96] = "kpenter", "rightctrl",
    "kpslash", [100] = "rightalt", [102] = "home", "up", "pageup", "left", "right", "end", "down",
    "pagedown", "insert", "delete", [113] = "mute", "volumedown", "volumeup", "power",
    [119] = "pause", [128] = "stop", [139] = "menu", [142] = "sleep", "wakeup", [148] = "prog1",
    "prog2", [158] = "back", "forward", [163] = "nextsong", "playpause", "previoussong", "stopcd",
    [172] = "homepage", [183] = "f13", "f14", "f15", "f16", "f17", "f18", "f19", "f20", "f21",
    "f22", "f23", "f24", [202] = "prog3", "prog4", [207] = "play", [248] = "micmute",
    [256] = "btn_0", "btn_1", "btn_2", "btn_3", "btn_4", "btn_5", "btn_6", "btn_7", "btn_8",
    "btn_9", [272] = "btn_left", "btn_right", "btn_middle", [288] = "btn_trigger",
    [304] = "btn_south", "btn_east", [307] = "btn_north", "btn_west", [352] = "ok", "select",
    [358] = "info", [398] = "red", "green", "yellow", "blue", "channelup", "channeldown",
    [407] = "next", "restart", "slow", [412] = "previous", [GN_KEY_KNOB_LEFT] = "knob_left",
    "knob_right", [GN_KEY_TAP] = "tap",
};
/* clang-format on */

const char *gn_key_name(unsigned key, char *buffer, size_t size) {
    if (key < GN_KEY_COUNT && names[key]) return names[key];
    snprintf(buffer, size, "key_%u", key);
    return buffer;
}

unsigned gn_key_find(const char *name) {
    for (unsigned key = 0; key < GN_KEY_COUNT; key++)
        if (names[key] && strcasecmp(names[key], name) == 0) return key;
    if (strncasecmp(name, "key_", 4) != 0) return GN_KEY_NONE;
    if (name[4] < '0' || name[4] > '9')
        return gn_key_find(name + 4); /* KEY_SPACE, as Linux has it */
    char *end;
    unsigned long number = strtoul(name + 4, &end, 10);
    return *end == '\0' && number < GN_KEY_COUNT ? (unsigned)number : GN_KEY_NONE;
}
