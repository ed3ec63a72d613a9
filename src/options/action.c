#include "options/action.h"

#include <stdlib.h>
#include <string.h>

#include "core/text.h"

#define MOST_S (36525 * INT64_C(86400))

static const struct {
    const char *name, *argument;
} rows[] = {[GN_ACTION_NONE] = {"none", ""},
#define X(ID, id, name, argument, ...) [GN_ACTION_##ID] = {name, argument},
            GN_ACTIONS(X)
#undef X
};

const char *gn_action_name(enum gn_action_kind kind) { return rows[kind].name; }

void gn_action_list(char *out, size_t size) {
    out[0] = '\0';
    for (int k = GN_ACTION_NONE; k < GN_ACTION_KIND_COUNT; k++)
        gn_text_add(out, size, "%s%s%s%s", k ? ", " : "", rows[k].name,
                    rows[k].argument[0] ? " " : "", rows[k].argument);
}

bool gn_turn_parse(const char *text, enum gn_turn *out, struct gn_err *err) {
    *out = !text ? GN_TURN_OTHER : strcmp(text, "on") == 0 ? GN_TURN_ON : GN_TURN_OFF;
    return *out != GN_TURN_OFF || strcmp(text, "off") == 0 ||
           gn_fail_usage(err, "\"%.40s\" is not on or off", text);
}

bool gn_sun_step_parse(const char *text, int64_t *out_s, struct gn_err *err) {
    static const struct {
        const char *name;
        int64_t seconds;
    } units[] = {{"m", 60}, {"h", 3600}, {"d", 86400}, {"w", 7 * 86400}};
    char *end = NULL;
    const bool has_sign = (text[0] == '+' || text[0] == '-') && strlen(text) < 12,
               is_now = strcmp(text, "now") == 0;
    const long count = has_sign && text[1] >= '0' && text[1] <= '9' ? strtol(text, &end, 10) : 0;
    *out_s = 0;
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++)
        if (end && strcmp(end, units[i].name) == 0 && labs(count) <= MOST_S / units[i].seconds)
            *out_s = count * units[i].seconds;
    return *out_s != 0 || is_now ||
           gn_fail_usage(err,
                         "\"%.40s\" is no step of the sun; expected one such as +1h, -15m, +1d or "
                         "+1w, or now",
                         text);
}

bool gn_action_parse(const char *text, struct gn_action *out, struct gn_err *err) {
    const size_t word = strcspn(text, " \t");
    const char *name = text + word + strspn(text + word, " \t");
    for (int k = GN_ACTION_NONE; k < GN_ACTION_KIND_COUNT; k++) {
        if (strlen(rows[k].name) != word || strncmp(rows[k].name, text, word) != 0) continue;
        const bool takes_name = rows[k].argument[0], turns = rows[k].argument[0] == '[';
        if (turns) {
            *out = (struct gn_action){.kind = (enum gn_action_kind)k};
            return gn_turn_parse(name[0] ? name : NULL, &out->turn, err);
        }
        if (takes_name && !name[0])
            return gn_fail_usage(err, "expected \"%s %s\"", rows[k].name, rows[k].argument);
        if (!takes_name && name[0])
            return gn_fail_usage(err, "\"%s\": %s takes no argument", text, rows[k].name);
        *out = (struct gn_action){.kind = (enum gn_action_kind)k, .name = takes_name ? name : NULL};
        int64_t step_s;
        return k != GN_ACTION_SUN || gn_sun_step_parse(name, &step_s, err);
    }
    char list[240];
    gn_action_list(list, sizeof list);
    return gn_fail_usage(err, "unknown action \"%s\"; expected %s", text, list);
}
