#include "options/viewer_keys.h"

#include <stddef.h>
#include <string.h>

#include "core/key.h"

const struct gn_viewer_key gn_viewer_keys[] = {
    {"h, ?, F1", "show or hide this page", GN_VIEWER_HELP, "hH?", {GN_KEY_F1}},
    {"left button, arrows",
     "turn the view",
     GN_VIEWER_ORBIT,
     NULL,
     {GN_KEY_LEFT, GN_KEY_RIGHT, GN_KEY_UP, GN_KEY_DOWN}},
    {"right button, shift", "move it", GN_VIEWER_NONE, NULL, {0}},
    {"wheel", "zoom", GN_VIEWER_NONE, NULL, {0}},
    {"Home", "reset the view to that of the camera", GN_VIEWER_NONE, NULL, {0}},
    {"1 to 9", "camera of that number", GN_VIEWER_CAMERA, NULL, {2, 3, 4, 5, 6, 7, 8, 9, 10}},
    {"x, tab",
     "split screen: this mode left of a line to drag, the next one right",
     GN_VIEWER_SPLIT,
     "xX",
     {GN_KEY_TAB}},
    {"t", "ray-traced truth right of the line; the scene stands", GN_VIEWER_TRUTH, "tT", {0}},
    {"e", "environment: studio, none", GN_VIEWER_ENVIRONMENT, "eE", {0}},
    {"a", "next clip of the animation", GN_VIEWER_CLIP, "aA", {0}},
    {"[, -", "half the speed", GN_VIEWER_SLOWER, "[-", {0}},
    {"], +", "twice the speed", GN_VIEWER_FASTER, "]+=", {0}},
    {"F12, Print", "write a screenshot here", GN_VIEWER_SCREENSHOT, NULL, {GN_KEY_F12, 99}},
    {"r, F5", "load everything again", GN_VIEWER_RELOAD, "rR", {GN_KEY_F5}},
    {"a dropped file", "is shown in place of the scene", GN_VIEWER_NONE, NULL, {0}},
    {"F11", "full screen, and back", GN_VIEWER_NONE, NULL, {0}},
    {"Escape, q", "end the program", GN_VIEWER_NONE, NULL, {0}},
    {0},
};

const struct gn_viewer_key *gn_viewer_key_find(unsigned key, int *place) {
    for (const struct gn_viewer_key *row = gn_viewer_keys; row->name && key; row++)
        for (int i = 0; i < GN_VIEWER_KEYS_MAX && row->keys[i]; i++)
            if (row->keys[i] == key) {
                *place = i;
                return row;
            }
    return NULL;
}

const struct gn_viewer_key *gn_viewer_letter_find(char letter) {
    for (const struct gn_viewer_key *row = gn_viewer_keys; row->name && letter; row++)
        if (row->letters && strchr(row->letters, letter)) return row;
    return NULL;
}
