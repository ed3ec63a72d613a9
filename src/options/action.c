#include "options/action.h"

#include <stdio.h>
#include <string.h>

static const char *const names[GN_ACTION_KIND_COUNT] = {
    [GN_ACTION_NONE] = "none",
    [GN_ACTION_NEXT] = "next",
    [GN_ACTION_PREV] = "prev",
    [GN_ACTION_MODE] = "mode",
    [GN_ACTION_NEXT_SCENE] = "next-scene",
    [GN_ACTION_NEXT_CAMERA] = "next-camera",
    [GN_ACTION_PAUSE] = "pause",
    [GN_ACTION_BLANK] = "blank",
    [GN_ACTION_INFO] = "info",
};

const char *gn_action_name(enum gn_action_kind kind) { return names[kind]; }

static bool fail_unknown(const char *text, const char *label, struct gn_err *err) {
    char list[160] = "";
    size_t used = 0;
    for (int k = GN_ACTION_NONE; k < GN_ACTION_KIND_COUNT; k++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s%s", used ? ", " : "",
                                 names[k], k == GN_ACTION_MODE ? " NAME" : "");
    return gn_fail_usage(err, "%s: \"%s\" is no action; expected %s", label, text, list);
}

bool gn_action_parse(const char *text, const char *label, struct gn_action *out,
                     struct gn_err *err) {
    const size_t word = strcspn(text, " \t");
    const char *name = text + word + strspn(text + word, " \t");
    for (int k = GN_ACTION_NONE; k < GN_ACTION_KIND_COUNT; k++) {
        if (strlen(names[k]) != word || strncmp(names[k], text, word) != 0) continue;
        const bool takes_name = k == GN_ACTION_MODE;
        if (takes_name && !name[0])
            return gn_fail_usage(err, "%s: which mode? expected \"mode NAME\"", label);
        if (!takes_name && name[0])
            return gn_fail_usage(err, "%s: \"%s\": nothing follows %s", label, text, names[k]);
        *out = (struct gn_action){(enum gn_action_kind)k, takes_name ? name : NULL};
        return true;
    }
    return fail_unknown(text, label, err);
}
