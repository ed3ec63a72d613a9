/* Kinds of values of [button "NAME"]. */
#include <string.h>

#include "core/key.h"
#include "core/text.h"
#include "options/binding.h"
#include "options/kind.h"

enum { KEYS_MAX = 32 /* of one button */ };

/* Not by number: the numbers of GPIO chips change with kernel updates. */
bool gn_kind_parse_line(struct gn_kind_input *in, void *field) {
    const char *text = in->text, *slash = strrchr(text, '/');
    bool valid = strncmp(text, "gpiochip", 8) != 0 && text[strspn(text, "0123456789")];
    if (strncmp(text, "label:", 6) == 0)
        valid = slash && slash > text + 6 && slash[1] && strlen(slash + 1) < 6 &&
                !slash[1 + strspn(slash + 1, "0123456789")];
    return valid && gn_kind_keep(in, field);
}

bool gn_kind_parse_keys(struct gn_kind_input *in, void *field) {
    unsigned found[KEYS_MAX];
    char name[64];
    int count = 0;
    for (const char *at = in->text; gn_text_word(&at, name, sizeof name); count++) {
        if (count == KEYS_MAX) return false;
        found[count] = gn_key_find(name);
        if (found[count] == GN_KEY_NONE)
            return gn_fail_usage(in->err,
                                 "\"%s\" is not a key; expected names such as space, right, f1, a, "
                                 "btn_0 or key_600, a space between two",
                                 name);
        for (int i = 0; i < count; i++)
            if (found[i] == found[count])
                return gn_fail_usage(in->err, "\"%s\" is there twice", name);
    }
    return count > 0 && gn_kind_keep(in, field);
}

bool gn_kind_parse_names(struct gn_kind_input *in, void *field) {
    const char *at = in->text;
    char name[64];
    return gn_text_word(&at, name, sizeof name) && gn_text_word(&at, name, sizeof name) &&
           gn_kind_keep(in, field);
}

bool gn_kind_parse_action(struct gn_kind_input *in, void *field) {
    struct gn_binding *binding = field;
    const char *kept = NULL; /* the action points into it */
    if (!gn_kind_keep(in, &kept) || !gn_action_parse(kept, &binding->action, in->err)) return false;
    binding->bound = true;
    return true;
}

void gn_kind_print_action(const void *field, const struct gn_kind_output *to) {
    static const char *const turns[] = {
        [GN_TURN_OTHER] = "", [GN_TURN_ON] = " on", [GN_TURN_OFF] = " off"};
    const struct gn_action *action = &((const struct gn_binding *)field)->action;
    gn_text_add(to->out, to->size, "%s%s%s%s", gn_action_name(action->kind), turns[action->turn],
                action->name ? " " : "", action->name ? action->name : "");
}
