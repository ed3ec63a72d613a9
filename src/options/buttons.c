#include "options/buttons.h"

#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "core/key.h"
#include "core/text.h"
#include "options/value.h"
#include "shadow/technique.h"

#define NS_PER_MS  (GN_NS_PER_S / 1000)
#define WORDS_MAX  32 /* of keys or of a chord */
#define TIME(name) offsetof(struct gn_button_opts, name)

enum { LINE, KEYS, CHORD, ACTIVE_HIGH, BIAS, DEBOUNCE_MS, HOLD_MS, DOUBLE_MS, REPEAT_MS, CHORD_MS };
enum { PRESS = CHORD_MS + 1, CLICK, DOUBLE, HOLD, REPEAT };
_Static_assert(REPEAT + 1 == GN_BUTTON_KEY_COUNT, "a row per key");

typedef bool set_fn(struct gn_config_buttons *config, int key, const char *text, const char *label,
                    struct gn_err *err);
static set_fn set_line, set_keys, set_chord, set_active_high, set_bias, set_ms, set_action;

/* clang-format off */
static const struct {
    struct gn_button_key_row row;
    set_fn *set;
    size_t offset; /* of the time in struct gn_button_opts */
    int least_ms, most_ms;
    enum gn_gesture gesture; /* of an action */
} keys[GN_BUTTON_KEY_COUNT] = {
    [LINE] = {.row = {"line", "NAME", "the GPIO line: its name (GPIO17), or label:LABEL/OFFSET"}, .set = set_line},
    [KEYS] = {.row = {"keys", "KEY..", "keys of a keyboard or of gpio-keys: space, f1, btn_0"}, .set = set_keys},
    [CHORD] = {.row = {"chord", "BUTTON..", "other buttons, pressed together; press is their action"}, .set = set_chord},
    [ACTIVE_HIGH] = {.row = {"active_high", "yes|no", "the line is high while pressed (no)"}, .set = set_active_high},
    [BIAS] = {.row = {"bias", "pull-up|pull-down|none", "bias of the line (pull-up, or pull-down with active_high)"}, .set = set_bias},
    [DEBOUNCE_MS] = {.row = {"debounce_ms", "MS", "debounce time (20)"}, .set = set_ms, .offset = TIME(debounce_ns), .least_ms = 1, .most_ms = 1000},
    [HOLD_MS] = {.row = {"hold_ms", "MS", "duration of a hold, and delay before the first repeat (800)"}, .set = set_ms, .offset = TIME(hold_ns), .least_ms = 50, .most_ms = 60000},
    [DOUBLE_MS] = {.row = {"double_ms", "MS", "longest time between the presses of a double (350)"}, .set = set_ms, .offset = TIME(double_ns), .least_ms = 50, .most_ms = 5000},
    [REPEAT_MS] = {.row = {"repeat_ms", "MS", "time between repeats (200)"}, .set = set_ms, .offset = TIME(repeat_ns), .least_ms = 50, .most_ms = 60000},
    [CHORD_MS] = {.row = {"chord_ms", "MS", "longest time between the presses of a chord (80)"}, .set = set_ms, .offset = TIME(chord_ns), .least_ms = 10, .most_ms = 1000},
    [PRESS] = {.row = {"press", "ACTION", "when the button is pressed"}, .set = set_action, .gesture = GN_GESTURE_PRESS},
    [CLICK] = {.row = {"click", "ACTION", "when it is released before hold"}, .set = set_action, .gesture = GN_GESTURE_CLICK},
    [DOUBLE] = {.row = {"double", "ACTION", "when it is pressed a second time"}, .set = set_action, .gesture = GN_GESTURE_DOUBLE},
    [HOLD] = {.row = {"hold", "ACTION", "when it has been held for hold_ms"}, .set = set_action, .gesture = GN_GESTURE_HOLD},
    [REPEAT] = {.row = {"repeat", "ACTION", "on hold, then every repeat_ms while held"}, .set = set_action, .gesture = GN_GESTURE_REPEAT},
};
/* clang-format on */

const struct gn_button_key_row *gn_button_key(int index) { return &keys[index].row; }

/* ---- words --------------------------------------------------------------------------------- */

struct words { /* separated by spaces; they point into the text */
    int count;
    struct {
        const char *at;
        size_t length;
    } items[WORDS_MAX];
};

static bool split_words(const char *text, struct words *words) {
    *words = (struct words){0};
    for (text += strspn(text, " \t"); *text; text += strspn(text, " \t")) {
        if (words->count == WORDS_MAX) return false;
        const size_t length = strcspn(text, " \t");
        words->items[words->count].at = text;
        words->items[words->count++].length = length;
        text += length;
    }
    return words->count > 0;
}

static void copy_word(const struct words *words, int i, char *out, size_t size) {
    const size_t length = words->items[i].length;
    snprintf(out, size, "%.*s", (int)(length < size ? length : size - 1), words->items[i].at);
}

/* ---- one key at a time --------------------------------------------------------------------- */

static struct gn_button_config *last_button(const struct gn_config_buttons *config) {
    return &config->buttons->items[config->buttons->count - 1];
}

static bool keep_text(const struct gn_config_buttons *config, const char *text, const char **out,
                      const char *label, struct gn_err *err) {
    *out = gn_arena_strdup(config->arena, text);
    return *out || gn_fail(err, "%s: no memory left", label);
}

static bool fail_value(const char *label, const char *text, const char *expected,
                       struct gn_err *err) {
    return gn_fail_usage(err, "%s: \"%.80s\" is not %s", label, text, expected);
}

/* The message names the button that has the line or key. */
static bool fail_taken(const struct gn_config_buttons *config, int button, int key,
                       const char *what, const char *label, struct gn_err *err) {
    return gn_fail_usage(err, "%s: \"%s\" is button \"%s\"'s already, in line %d", label, what,
                         config->buttons->items[button].opts.name, config->lines[button].keys[key]);
}

static bool set_line(struct gn_config_buttons *config, int key, const char *text, const char *label,
                     struct gn_err *err) {
    const char *slash = strrchr(text, '/');
    (void)key;
    /* not by number: the numbers of GPIO chips change with kernel updates */
    bool valid = strncmp(text, "gpiochip", 8) != 0 && text[strspn(text, "0123456789")];
    if (strncmp(text, "label:", 6) == 0)
        valid = slash && slash > text + 6 && slash[1] && strlen(slash + 1) < 6 &&
                !slash[1 + strspn(slash + 1, "0123456789")];
    if (!valid)
        return fail_value(label, text,
                          "a line's name such as GPIO17, or label:LABEL/OFFSET such as "
                          "label:pinctrl-rp1/17 (the numbers of chips change)",
                          err);
    for (int b = 0; b < config->buttons->count - 1; b++) {
        const char *other = config->buttons->items[b].opts.line;
        if (other && strcmp(other, text) == 0) return fail_taken(config, b, LINE, text, label, err);
    }
    return keep_text(config, text, &last_button(config)->opts.line, label, err);
}

static bool has_key(const char *text, unsigned key) {
    struct words words;
    char name[64];
    if (!text || !split_words(text, &words)) return false;
    for (int i = 0; i < words.count; i++) {
        copy_word(&words, i, name, sizeof name);
        if (gn_key_find(name) == key) return true;
    }
    return false;
}

static bool set_keys(struct gn_config_buttons *config, int key, const char *text, const char *label,
                     struct gn_err *err) {
    struct words words;
    char name[64];
    unsigned found[WORDS_MAX];
    (void)key;
    if (!split_words(text, &words))
        return fail_value(label, text, "one to 32 names of keys, a space between two", err);
    for (int i = 0; i < words.count; i++) {
        copy_word(&words, i, name, sizeof name);
        found[i] = gn_key_find(name);
        if (found[i] == GN_KEY_NONE)
            return fail_value(
                label, name,
                "a key; expected names such as space, right, f1, a, btn_0 or key_600, a space "
                "between two",
                err);
        for (int j = 0; j < i; j++)
            if (found[j] == found[i])
                return gn_fail_usage(err, "%s: \"%s\" is there twice", label, name);
        for (int b = 0; b < config->buttons->count - 1; b++)
            if (has_key(config->buttons->items[b].opts.keys, found[i]))
                return fail_taken(config, b, KEYS, name, label, err);
    }
    return keep_text(config, text, &last_button(config)->opts.keys, label, err);
}

static bool set_chord(struct gn_config_buttons *config, int key, const char *text,
                      const char *label, struct gn_err *err) {
    struct words words;
    (void)key;
    if (!split_words(text, &words) || words.count < 2)
        return fail_value(label, text, "two or more names of other buttons, a space between two",
                          err);
    return keep_text(config, text, &last_button(config)->opts.chord, label, err);
}

static bool set_active_high(struct gn_config_buttons *config, int key, const char *text,
                            const char *label, struct gn_err *err) {
    static const struct gn_option_row flag = {.kind = GN_KIND_FLAG};
    (void)key;
    return gn_value_parse(&flag, text, &last_button(config)->opts.active_high, config->arena, label,
                          err);
}

static bool set_bias(struct gn_config_buttons *config, int key, const char *text, const char *label,
                     struct gn_err *err) {
    static const struct gn_choice choices[] = {{"pull-up", GN_BIAS_PULL_UP},
                                               {"pull-down", GN_BIAS_PULL_DOWN},
                                               {"none", GN_BIAS_NONE},
                                               {0}};
    static const struct gn_option_row row = {.kind = GN_KIND_CHOICE, .choices = choices};
    int bias;
    (void)key;
    if (!gn_value_parse(&row, text, &bias, config->arena, label, err)) return false;
    last_button(config)->opts.bias = (enum gn_bias)bias;
    return true;
}

static bool set_ms(struct gn_config_buttons *config, int key, const char *text, const char *label,
                   struct gn_err *err) {
    const struct gn_option_row row = {
        .kind = GN_KIND_INT, .min = keys[key].least_ms, .max = keys[key].most_ms};
    int ms;
    if (!gn_value_parse(&row, text, &ms, config->arena, label, err)) return false;
    const int64_t ns = ms * NS_PER_MS;
    memcpy((char *)&last_button(config)->opts + keys[key].offset, &ns, sizeof ns);
    return true;
}

static bool set_action(struct gn_config_buttons *config, int key, const char *text,
                       const char *label, struct gn_err *err) {
    struct gn_binding *on = &last_button(config)->on[keys[key].gesture];
    const char *kept;
    if (!keep_text(config, text, &kept, label, err) ||
        !gn_action_parse(kept, label, &on->action, err))
        return false;
    on->bound = true;
    return true;
}

/* ---- the section --------------------------------------------------------------------------- */

bool gn_config_button_open(struct gn_config_buttons *config, const struct gn_ini_line *line,
                           struct gn_err *err) {
    struct gn_buttons *buttons = config->buttons;
    if (!line->name)
        return gn_fail_usage(err, "%s: a button has a name: [button \"NAME\"]", line->where);
    if (line->name[strcspn(line->name, " \t")])
        return gn_fail_usage(err, "%s: button \"%s\": a button's name has no spaces", line->where,
                             line->name);
    for (int i = 0; i < buttons->count; i++)
        if (strcmp(buttons->items[i].opts.name, line->name) == 0)
            return gn_fail_usage(err, "%s: button \"%s\" is there already, in line %d", line->where,
                                 line->name, config->lines[i].section);
    if (buttons->count == GN_BUTTONS_MAX)
        return gn_fail_usage(err, "%s: more than %d buttons", line->where, GN_BUTTONS_MAX);
    config->lines[buttons->count].section = line->number;
    buttons->items[buttons->count++] = (struct gn_button_config){0};
    return keep_text(config, line->name, &last_button(config)->opts.name, line->where, err);
}

bool gn_config_button_set(struct gn_config_buttons *config, const struct gn_ini_line *line,
                          struct gn_err *err) {
    int key = 0;
    while (key < GN_BUTTON_KEY_COUNT && strcmp(keys[key].row.name, line->key) != 0) key++;
    if (key == GN_BUTTON_KEY_COUNT) {
        char list[200] = "";
        size_t used = 0;
        struct gn_text_guess guess = {0};
        for (int i = 0; i < GN_BUTTON_KEY_COUNT; i++) {
            gn_text_guess(&guess, line->key, keys[i].row.name);
            used += (size_t)snprintf(list + used, sizeof list - used, "%s %s", used ? "," : "",
                                     keys[i].row.name);
        }
        if (guess.name)
            return gn_fail_usage(err, "%s: unknown key \"%s\" in [button]; expected %s",
                                 line->where, line->key, guess.name);
        return gn_fail_usage(err, "%s: unknown key \"%s\"; keys of [button]:%s", line->where,
                             line->key, list);
    }
    int *seen = &config->lines[config->buttons->count - 1].keys[key];
    if (*seen)
        return gn_fail_usage(err, "%s: %s is set already, in line %d", line->where, line->key,
                             *seen);
    char label[400];
    snprintf(label, sizeof label, "%s: %s", line->where, line->key);
    if (!keys[key].set(config, key, line->value, label, err)) return false;
    *seen = line->number;
    return true;
}

/* ---- the whole file ------------------------------------------------------------------------ */

struct check {
    const struct gn_config_buttons *config;
    const struct gn_options *options;
    const char *path;
    struct gn_err *err;
};

static bool check_chord(const struct check *c, int button) {
    const struct gn_buttons *buttons = c->config->buttons;
    const int line = c->config->lines[button].keys[CHORD];
    struct words words;
    char name[64];
    bool seen[GN_BUTTONS_MAX] = {false};
    split_words(buttons->items[button].opts.chord, &words);
    for (int i = 0; i < words.count; i++) {
        copy_word(&words, i, name, sizeof name);
        int other = 0;
        while (other < buttons->count && strcmp(buttons->items[other].opts.name, name) != 0)
            other++;
        if (other == buttons->count)
            return gn_fail_usage(c->err, "%s:%d: chord: there is no button \"%s\"", c->path, line,
                                 name);
        if (buttons->items[other].opts.chord)
            return gn_fail_usage(c->err, "%s:%d: chord: button \"%s\" is a chord itself", c->path,
                                 line, name);
        if (seen[other])
            return gn_fail_usage(c->err, "%s:%d: chord: \"%s\" is there twice", c->path, line,
                                 name);
        seen[other] = true;
    }
    return true;
}

/* A chord has neither line nor keys, and one gesture; active_high and bias need a line. */
static bool check_place(const struct check *c, int button) {
    const int *lines = c->config->lines[button].keys;
    const struct gn_button_opts *o = &c->config->buttons->items[button].opts;
    static const int not_of_chord[] = {LINE,      KEYS,  DEBOUNCE_MS, HOLD_MS, DOUBLE_MS,
                                       REPEAT_MS, CLICK, DOUBLE,      HOLD,    REPEAT};
    for (size_t i = 0; o->chord && i < sizeof not_of_chord / sizeof not_of_chord[0]; i++)
        if (lines[not_of_chord[i]])
            return gn_fail_usage(c->err,
                                 "%s:%d: %s: a chord has none; it knows chord, press and "
                                 "chord_ms",
                                 c->path, lines[not_of_chord[i]], keys[not_of_chord[i]].row.name);
    for (int key = ACTIVE_HIGH; !o->line && key <= BIAS; key++)
        if (lines[key])
            return gn_fail_usage(c->err, "%s:%d: %s: only a button with a line has one", c->path,
                                 lines[key], keys[key].row.name);
    if (!o->chord && lines[CHORD_MS])
        return gn_fail_usage(c->err, "%s:%d: chord_ms: only a chord has one", c->path,
                             lines[CHORD_MS]);
    return o->line || o->keys || o->chord ||
           gn_fail_usage(c->err, "%s:%d: button \"%s\" has no source: set line, keys or chord",
                         c->path, c->config->lines[button].section, o->name);
}

static bool is_in_chord(const struct gn_buttons *buttons, const char *name) {
    struct words words;
    char member[64];
    for (int i = 0; i < buttons->count; i++) {
        if (!buttons->items[i].opts.chord || !split_words(buttons->items[i].opts.chord, &words))
            continue;
        for (int w = 0; w < words.count; w++) {
            copy_word(&words, w, member, sizeof member);
            if (strcmp(member, name) == 0) return true;
        }
    }
    return false;
}

static bool check_actions(const struct check *c, int button) {
    const struct gn_button_config *config = &c->config->buttons->items[button];
    const struct gn_options *o = c->options;
    const int *lines = c->config->lines[button].keys;
    bool does_something = is_in_chord(c->config->buttons, config->opts.name);
    for (int key = PRESS; key <= REPEAT; key++) {
        const struct gn_binding *on = &config->on[keys[key].gesture];
        does_something |= on->bound;
        if (!on->bound || on->action.kind != GN_ACTION_MODE) continue;
        enum gn_technique unused; /* techniques are the modes of a file without any */
        bool found =
            !o->mode_count && gn_technique_find(on->action.name, strlen(on->action.name), &unused);
        for (int i = 0; i < o->mode_count; i++)
            found |= strcmp(o->modes[i].name, on->action.name) == 0;
        if (found) continue;
        char names[300];
        gn_options_list_modes(o, names, sizeof names);
        return gn_fail_usage(c->err, "%s:%d: %s: no mode \"%s\"; expected%s", c->path, lines[key],
                             keys[key].row.name, on->action.name,
                             o->mode_count ? names : " a technique, since the file has no modes");
    }
    return does_something ||
           gn_fail_usage(c->err,
                         "%s:%d: button \"%s\" has no action: set press, click, double, hold "
                         "or repeat",
                         c->path, c->config->lines[button].section, config->opts.name);
}

bool gn_config_button_check(const struct gn_config_buttons *config,
                            const struct gn_options *options, const char *path,
                            struct gn_err *err) {
    const struct check check = {config, options, path, err};
    for (int b = 0; b < config->buttons->count; b++)
        if (!check_place(&check, b) || !check_actions(&check, b) ||
            (config->buttons->items[b].opts.chord && !check_chord(&check, b)))
            return false;
    for (int b = 0; b < config->buttons->count; b++) {
        struct gn_button_config *button = &config->buttons->items[b];
        if (button->opts.chord) { /* its action is under press */
            button->on[GN_GESTURE_CHORD] = button->on[GN_GESTURE_PRESS];
            button->on[GN_GESTURE_PRESS] = (struct gn_binding){0};
        }
        if (button->opts.active_high && !config->lines[b].keys[BIAS])
            button->opts.bias = GN_BIAS_PULL_DOWN;
    }
    return true;
}
