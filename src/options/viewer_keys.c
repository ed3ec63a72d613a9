#include "options/viewer_keys.h"

#include <stddef.h>
#include <string.h>

#include "core/key.h"

/* clang-format off */
const struct gn_viewer_key gn_viewer_keys[] = {
    {"left button, arrows", "turn the view", "Look", GN_VIEWER_ORBIT, NULL, {GN_KEY_LEFT, GN_KEY_RIGHT, GN_KEY_UP, GN_KEY_DOWN}},
    {"right button", "move it; also the left one with shift", NULL, GN_VIEWER_NONE, NULL, {0}},
    {"wheel", "zoom", NULL, GN_VIEWER_NONE, NULL, {0}},
    {"Home", "back to the view of the camera", NULL, GN_VIEWER_NONE, NULL, {0}},
    {"1 to 9", "go to that camera", NULL, GN_VIEWER_CAMERA, NULL, {2, 3, 4, 5, 6, 7, 8, 9, 10}},
    {"e", "environment: studio, none", "Show", GN_VIEWER_ENVIRONMENT, "eE", {0}},
    {"a", "next clip of the animation", NULL, GN_VIEWER_CLIP, "aA", {0}},
    {"[, -", "half the speed", NULL, GN_VIEWER_SLOWER, "[-", {0}},
    {"], +", "twice the speed", NULL, GN_VIEWER_FASTER, "]+=", {0}},
    {"a dropped file", "is shown instead of the scene", NULL, GN_VIEWER_NONE, NULL, {0}},
    {"x, tab", "split screen: this mode left, the next one right; drag the line", "Compare", GN_VIEWER_SPLIT, "xX", {GN_KEY_TAB}},
    {"t", "ray tracing right of the line; the scene stands still", NULL, GN_VIEWER_TRUTH, "tT", {0}},
    {"h, ?, F1", "show or hide this page", "Program", GN_VIEWER_HELP, "hH?", {GN_KEY_F1}},
    {"F12, Print", "write a screenshot into the folder of the start", NULL, GN_VIEWER_SCREENSHOT, NULL, {GN_KEY_F12, 99}},
    {"r, F5", "load everything again", NULL, GN_VIEWER_RELOAD, "rR", {GN_KEY_F5}},
    {"F11", "full screen, and back", NULL, GN_VIEWER_NONE, NULL, {0}},
    {"Escape, q", "end the program", NULL, GN_VIEWER_NONE, NULL, {0}},
    {0},
};
/* clang-format on */

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
