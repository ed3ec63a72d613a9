#include "options/buttons.h"

#include <string.h>

#include "core/text.h"
#include "shadow/technique.h"

#define OPTS(name)  offsetof(struct gn_button_config, opts.name)
#define ON(gesture) offsetof(struct gn_button_config, on[GN_GESTURE_##gesture])

enum { LINE, KEYS, CHORD, ACTIVE_HIGH, BIAS, CHORD_MS = 9, PRESS };

static const struct gn_choice biases[] = {
    {"pull-up", GN_BIAS_PULL_UP}, {"pull-down", GN_BIAS_PULL_DOWN}, {"none", GN_BIAS_NONE}, {0}};
/* clang-format off */
const struct gn_option_row gn_button_rows[GN_BUTTON_ROWS] = {
    [LINE] = {.name = "line", .kind = GN_KIND_LINE, .value = "NAME", .help = "the GPIO line: its name (GPIO17), or label:LABEL/OFFSET", .unique = true, .offset = OPTS(line)},
    [KEYS] = {.name = "keys", .kind = GN_KIND_KEYS, .value = "KEY..", .help = "keys of a keyboard or of gpio-keys: space, f1, btn_0", .unique = true, .offset = OPTS(keys)},
    [CHORD] = {.name = "chord", .kind = GN_KIND_NAMES, .value = "BUTTON..", .help = "other buttons, pressed together; press is their action", .offset = OPTS(chord)},
    [ACTIVE_HIGH] = {.name = "active_high", .kind = GN_KIND_FLAG, .help = "the line is high while pressed (no)", .offset = OPTS(active_high)},
    [BIAS] = {.name = "bias", .kind = GN_KIND_CHOICE, .choices = biases, .value = "pull-up|pull-down|none", .help = "bias of the line (pull-up, or pull-down with active_high)", .offset = OPTS(bias)},
    {.name = "debounce_ms", .kind = GN_KIND_MS, .min = 1, .max = 1000, .value = "MS", .help = "debounce time (20)", .offset = OPTS(debounce_ns)},
    {.name = "hold_ms", .kind = GN_KIND_MS, .min = 50, .max = 60000, .value = "MS", .help = "duration of a hold, and delay before the first repeat (800)", .offset = OPTS(hold_ns)},
    {.name = "double_ms", .kind = GN_KIND_MS, .min = 50, .max = 5000, .value = "MS", .help = "longest time between the presses of a double (350)", .offset = OPTS(double_ns)},
    {.name = "repeat_ms", .kind = GN_KIND_MS, .min = 50, .max = 60000, .value = "MS", .help = "time between repeats (200)", .offset = OPTS(repeat_ns)},
    [CHORD_MS] = {.name = "chord_ms", .kind = GN_KIND_MS, .min = 10, .max = 1000, .value = "MS", .help = "longest time between the presses of a chord (80)", .offset = OPTS(chord_ns)},
    [PRESS] = {.name = "press", .kind = GN_KIND_ACTION, .value = "ACTION", .help = "when the button is pressed", .offset = ON(PRESS)},
    {.name = "click", .kind = GN_KIND_ACTION, .value = "ACTION", .help = "when it is released before hold", .offset = ON(CLICK)},
    {.name = "double", .kind = GN_KIND_ACTION, .value = "ACTION", .help = "when it is pressed a second time", .offset = ON(DOUBLE)},
    {.name = "hold", .kind = GN_KIND_ACTION, .value = "ACTION", .help = "when it has been held for hold_ms", .offset = ON(HOLD)},
    {.name = "repeat", .kind = GN_KIND_ACTION, .value = "ACTION", .help = "on hold, then every repeat_ms while held", .offset = ON(REPEAT)},
};
/* clang-format on */
_Static_assert(sizeof(enum gn_bias) == sizeof(int), "a choice is an int");

/* ---- the whole file ------------------------------------------------------------------------ */

static const struct gn_override *find_setting(const struct gn_named_section *section, int row) {
    return gn_section_setting(section, &gn_button_rows[row]);
}

static const char *chord_of(const struct gn_named_section *section) {
    const struct gn_override *chord = find_setting(section, CHORD);
    return chord ? *(const char *const *)chord->value : NULL;
}

static bool check_chord(const struct gn_sections *all, const struct gn_named_section *section,
                        struct gn_err *err) {
    const char *at = chord_of(section), *label = at ? find_setting(section, CHORD)->label : NULL;
    char name[64];
    bool seen[GN_SECTIONS_MAX] = {false};
    while (at && gn_text_word(&at, name, sizeof name)) {
        int other = 0;
        while (other < all->count && strcmp(all->items[other].name, name) != 0) other++;
        if (other == all->count)
            return gn_fail_usage(err, "%s: there is no button \"%s\"", label, name);
        if (chord_of(&all->items[other]))
            return gn_fail_usage(err, "%s: button \"%s\" is a chord itself", label, name);
        if (seen[other]) return gn_fail_usage(err, "%s: \"%s\" is there twice", label, name);
        seen[other] = true;
    }
    return true;
}

/* A chord has neither line nor keys, and one gesture; active_high and bias need a line. */
static bool check_place(const struct gn_named_section *section, struct gn_err *err) {
    const bool has_line = find_setting(section, LINE), is_chord = find_setting(section, CHORD);
    for (const struct gn_override *o = section->first; o; o = o->next) {
        const ptrdiff_t row = o->row - gn_button_rows;
        const bool of_line = row == ACTIVE_HIGH || row == BIAS, of_chord = row == CHORD_MS;
        if (is_chord && !of_line && !of_chord && row != CHORD && row != PRESS)
            return gn_fail_usage(err, "%s: a chord has none; it knows chord, press and chord_ms",
                                 o->label);
        if (of_line && !has_line)
            return gn_fail_usage(err, "%s: only a button with a line has one", o->label);
        if (of_chord && !is_chord) return gn_fail_usage(err, "%s: only a chord has one", o->label);
    }
    return has_line || is_chord || find_setting(section, KEYS) ||
           gn_fail_usage(err, "%s: button \"%s\" has no source: set line, keys or chord",
                         section->label, section->name);
}

static bool is_in_chord(const struct gn_sections *all, const char *name) {
    char member[64];
    for (int i = 0; i < all->count; i++)
        for (const char *at = chord_of(&all->items[i]);
             at && gn_text_word(&at, member, sizeof member);)
            if (strcmp(member, name) == 0) return true;
    return false;
}

static bool has_mode(const struct gn_options *options, const char *name) {
    enum gn_technique unused; /* techniques are the modes of a file without any */
    bool found = !options->mode_count && gn_technique_find(name, strlen(name), &unused);
    for (int i = 0; i < options->mode_count; i++)
        found |= strcmp(options->modes[i].name, name) == 0;
    return found;
}

static bool check_modes(const struct gn_options *options, const struct gn_named_section *section,
                        struct gn_err *err) {
    for (const struct gn_override *o = section->first; o; o = o->next) {
        if (o->row->kind != GN_KIND_ACTION) continue;
        const struct gn_action *action = &((const struct gn_binding *)o->value)->action;
        if (action->kind != GN_ACTION_MODE || has_mode(options, action->name)) continue;
        char names[300];
        gn_options_list_modes(options, names, sizeof names);
        return gn_fail_usage(err, "%s: no mode \"%s\"; expected%s", o->label, action->name,
                             options->mode_count ? names
                                                 : " a technique, since the file has no modes");
    }
    return true;
}

static bool check_actions(const struct gn_sections *all, const struct gn_named_section *section,
                          struct gn_err *err) {
    bool does_something = is_in_chord(all, section->name);
    for (const struct gn_override *o = section->first; o; o = o->next)
        does_something |= o->row->kind == GN_KIND_ACTION;
    return does_something ||
           gn_fail_usage(err,
                         "%s: button \"%s\" has no action: set press, click, double, hold or "
                         "repeat",
                         section->label, section->name);
}

/* Leaves those that can be used; says: the others' errors are noted. Without one, others may be of
 * no use, either. One that goes to a mode that is not there does nothing when it is pressed. */
static bool keep_valid(struct gn_options *options, struct gn_sections *kept, bool says,
                       struct gn_err *err) {
    bool valid[GN_SECTIONS_MAX];
    const int count = kept->count;
    for (int i = 0; i < count; i++) {
        const struct gn_named_section *section = &kept->items[i];
        struct gn_err why = {0};
        valid[i] = check_place(section, &why) && check_actions(kept, section, &why) &&
                   check_chord(kept, section, &why);
        if (!says || (valid[i] && check_modes(options, section, &why))) continue;
        gn_text_format(why.shown, sizeof why.shown, "Line %d: the button \"%s\" cannot be used.",
                       section->line, section->name);
        if (gn_errors_take(options->errors, &why)) continue;
        *err = why;
        return false;
    }
    kept->count = 0;
    for (int i = 0; i < count; i++)
        if (valid[i]) kept->items[kept->count++] = kept->items[i];
    return kept->count == count || keep_valid(options, kept, false, err);
}

bool gn_buttons_take(struct gn_options *options, const struct gn_sections *sections, bool checks,
                     struct gn_err *err) {
    struct gn_sections kept = *sections;
    if (!keep_valid(options, &kept, checks, err)) return false;
    if (kept.count == 0) return true;
    struct gn_buttons *buttons = gn_arena_alloc(&options->arena, 1, sizeof *buttons);
    if (!buttons) return gn_fail(err, "%s: no memory left", sections->items[0].label);
    for (; buttons->count < kept.count; buttons->count++) {
        const struct gn_named_section *section = &kept.items[buttons->count];
        struct gn_button_config *button = &buttons->items[buttons->count];
        button->opts.name = section->name;
        gn_section_fill(section, button);
        if (button->opts.chord) { /* its action is under press */
            button->on[GN_GESTURE_CHORD] = button->on[GN_GESTURE_PRESS];
            button->on[GN_GESTURE_PRESS] = (struct gn_binding){0};
        }
        if (button->opts.active_high && !find_setting(section, BIAS))
            button->opts.bias = GN_BIAS_PULL_DOWN;
    }
    options->buttons = buttons;
    return true;
}
