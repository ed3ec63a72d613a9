#include "options/command.h"

#include <stdio.h>
#include <string.h>

#include "core/text.h"

/* clang-format off */
const struct gn_ctl_row gn_ctl_rows[GN_CTL_COUNT] = {
    [GN_CTL_NEXT] = {"next", {0}, "", "go to the next mode", true},
    [GN_CTL_PREV] = {"prev", {0}, "", "go to the mode before", true},
    [GN_CTL_MODE] = {"mode", {"name"}, "NAME", "go to that mode", true},
    [GN_CTL_NEXT_SCENE] = {"next-scene", {0}, "", "show the next scene", true},
    [GN_CTL_NEXT_CAMERA] = {"next-camera", {0}, "", "look through the scene's next camera", true},
    [GN_CTL_PAUSE] = {"pause", {0}, "", "let time stand still, or go on", true},
    [GN_CTL_BLANK] = {"blank", {0}, "", "darken the screen, or light it again", true},
    [GN_CTL_INFO] = {"info", {0}, "", "show the page about this kiosk, or hide it", true},
    [GN_CTL_SET] = {"set", {"key", "value"}, "KEY VALUE",
        "change an option of [scene] or [render] until reload; stronger than modes and flags", true},
    [GN_CTL_GET] = {"get", {"key"}, "KEY", "say what an option is now", false},
    [GN_CTL_STATUS] = {"status", {0}, "", "say how the kiosk is", false},
    [GN_CTL_SCREENSHOT] = {"screenshot", {"file"}, "FILE", "write the next frame as a .png", true},
    [GN_CTL_RELOAD] = {"reload", {0}, "", "read the configuration and the scene again", true},
    [GN_CTL_QUIT] = {"quit", {0}, "", "end the kiosk", false},
};
/* clang-format on */

int gn_ctl_find(const char *name) {
    for (int i = 0; i < GN_CTL_COUNT; i++)
        if (strcmp(gn_ctl_rows[i].name, name) == 0) return i;
    return -1;
}

int gn_ctl_words(enum gn_ctl command) {
    int words = 0;
    while (words < GN_CTL_WORDS_MAX && gn_ctl_rows[command].members[words]) words++;
    return words;
}

void gn_ctl_list(char *out, size_t size) {
    size_t used = 0;
    out[0] = '\0';
    for (int i = 0; i < GN_CTL_COUNT && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s %s%s%s", i ? "," : "",
                                 gn_ctl_rows[i].name, gn_ctl_rows[i].words[0] ? " " : "",
                                 gn_ctl_rows[i].words);
}

const char *gn_ctl_nearest(const char *misspelled) {
    struct gn_text_guess guess = {0};
    for (int i = 0; i < GN_CTL_COUNT; i++) gn_text_guess(&guess, misspelled, gn_ctl_rows[i].name);
    return guess.name;
}
