#include "options/command.h"

#include <string.h>

#include "core/text.h"

const struct gn_ctl_row gn_ctl_rows[GN_CTL_COUNT] = {
#define X(ID, id, name, argument, help, ...)                                                       \
    [GN_CTL_##ID] = {name, argument, GN_CTL_CHANGES, help, {__VA_ARGS__}},
    GN_ACTIONS(X)
#undef X
#define X(ID, id, name, arguments, flags, help, ...)                                               \
    [GN_CTL_##ID] = {name, arguments, flags, help, {__VA_ARGS__}},
        GN_REQUESTS(X)
#undef X
};

enum gn_action_kind gn_ctl_action(enum gn_ctl command) {
    static const enum gn_action_kind actions[GN_CTL_COUNT] = {
#define X(ID, ...) [GN_CTL_##ID] = GN_ACTION_##ID,
        GN_ACTIONS(X)
#undef X
    };
    return actions[command];
}

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

int gn_ctl_words_least(enum gn_ctl command) {
    return gn_ctl_rows[command].words[0] == '[' ? 0 : gn_ctl_words(command);
}

void gn_ctl_list(char *out, size_t size) {
    out[0] = '\0';
    for (int i = 0; i < GN_CTL_COUNT; i++)
        gn_text_add(out, size, "%s %s%s%s", i ? "," : "", gn_ctl_rows[i].name,
                    gn_ctl_rows[i].words[0] ? " " : "", gn_ctl_rows[i].words);
}

const char *gn_ctl_nearest(const char *misspelled) {
    struct gn_text_guess guess = {0};
    for (int i = 0; i < GN_CTL_COUNT; i++) gn_text_guess(&guess, misspelled, gn_ctl_rows[i].name);
    return guess.name;
}
