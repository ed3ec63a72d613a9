#include "options/value.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/key.h"
#include "core/text.h"
#include "display/kms/card.h"
#include "frame/caps.h"
#include "options/binding.h"
#include "options/kind.h"
#include "scene/scene.h"
#include "shadow/technique.h"

static const int64_t NS_PER_MS = GN_NS_PER_S / 1000;

bool gn_parse_int(const char *text, int64_t *out) {
    const char *digits = text[0] == '-' ? text + 1 : text;
    if (!digits[0] || digits[strspn(digits, "0123456789")]) return false;
    errno = 0;
    *out = strtoll(text, NULL, 10);
    return errno == 0;
}

static bool is_in_range(const struct gn_option_row *row, double value) {
    return value >= row->min && value <= row->max;
}

/* ---- flags and numbers --------------------------------------------------------------------- */

static bool parse_flag(struct gn_kind_input *in, void *field) {
    static const struct gn_choice words[] = {{"yes", 1}, {"no", 0},  {"true", 1}, {"false", 0},
                                             {"on", 1},  {"off", 0}, {"1", 1},    {"0", 0}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(in->text, words[i].name) == 0) {
            *(bool *)field = words[i].value;
            return true;
        }
    return false;
}

static void print_flag(const void *field, const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%s", *(const bool *)field ? "yes" : "no");
}

static bool parse_whole(const struct gn_kind_input *in, int64_t *out) {
    return gn_parse_int(in->text, out) && is_in_range(in->row, (double)*out);
}

static bool parse_int(struct gn_kind_input *in, void *field) {
    int64_t whole;
    if (!parse_whole(in, &whole)) return false;
    *(int *)field = (int)whole;
    return true;
}

static void print_int(const void *field, const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%d", *(const int *)field);
}

static bool parse_ms(struct gn_kind_input *in, void *field) {
    int64_t whole;
    if (!parse_whole(in, &whole)) return false;
    *(int64_t *)field = whole * NS_PER_MS;
    return true;
}

static void print_ms(const void *field, const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%lld", (long long)(*(const int64_t *)field / NS_PER_MS));
}

static bool parse_number(struct gn_kind_input *in, void *field) {
    return gn_kind_parse_number(in->row, in->text, field);
}

/* "auto" is NAN, "none" INFINITY. */
static bool parse_ev(struct gn_kind_input *in, void *field) {
    if (strcmp(in->text, "auto") != 0) return parse_number(in, field);
    *(double *)field = NAN;
    return true;
}

static bool parse_level(struct gn_kind_input *in, void *field) {
    if (strcmp(in->text, "none") != 0) return parse_ev(in, field);
    *(double *)field = INFINITY;
    return true;
}

static bool parse_share(struct gn_kind_input *in, void *field) {
    if (strcmp(in->text, "full") == 0) return *(double *)field = 0, true;
    return parse_ev(in, field);
}

static void print_number(const void *field, const struct gn_kind_output *to) {
    const double number = *(const double *)field;
    if (isfinite(number))
        gn_text_add(to->out, to->size, "%.9g", number);
    else
        gn_text_add(to->out, to->size, "%s", isnan(number) ? "auto" : "none");
}

static void print_share(const void *field, const struct gn_kind_output *to) {
    if (*(const double *)field == 0)
        gn_text_add(to->out, to->size, "full");
    else
        print_number(field, to);
}

static bool parse_seconds(struct gn_kind_input *in, void *field) {
    double number;
    if (!parse_number(in, &number)) return false;
    *(int64_t *)field = llround(number * (double)GN_NS_PER_S);
    return true;
}

static void print_seconds(const void *field, const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%.12g", (double)*(const int64_t *)field / (double)GN_NS_PER_S);
}

/* "WxH" at the start of the text; NULL, or what follows. */
static const char *parse_sides(const struct gn_kind_input *in, struct gn_size *sides) {
    const char *text = in->text;
    int used = 0;
    if (text[strspn(text, "0123456789")] != 'x' ||
        sscanf(text, "%6dx%6d%n", &sides->width_px, &sides->height_px, &used) != 2)
        return NULL;
    const char *second = strchr(text, 'x') + 1;
    const bool fits = second[0] >= '0' && second[0] <= '9' &&
                      is_in_range(in->row, sides->width_px) &&
                      is_in_range(in->row, sides->height_px);
    return fits ? text + used : NULL;
}

static bool parse_size(struct gn_kind_input *in, void *field) {
    struct gn_size sides;
    const char *rest = parse_sides(in, &sides);
    if (!rest || *rest) return false;
    *(struct gn_size *)field = sides;
    return true;
}

static void print_size(const void *field, const struct gn_kind_output *to) {
    const struct gn_size *sides = field;
    gn_text_add(to->out, to->size, "%dx%d", sides->width_px, sides->height_px);
}

static bool parse_mode(struct gn_kind_input *in, void *field) {
    struct gn_size sides;
    double hz = 0;
    const char *rest = parse_sides(in, &sides);
    if (!rest) return false;
    if (*rest && (*rest != '@' || !gn_kind_read_number(rest + 1, &hz) || hz < 1 || hz > 1000))
        return false;
    *(struct gn_display_mode *)field =
        (struct gn_display_mode){sides.width_px, sides.height_px, hz};
    return true;
}

static void print_mode(const void *field, const struct gn_kind_output *to) {
    const struct gn_display_mode *mode = field;
    if (mode->width_px)
        gn_text_add(to->out, to->size, mode->hz > 0 ? "%dx%d@%.6g" : "%dx%d", mode->width_px,
                    mode->height_px, mode->hz);
}

/* ---- one of some words --------------------------------------------------------------------- */

const char *gn_value_word(const struct gn_option_row *row, int index) {
    if (row->kind == GN_KIND_TECHNIQUES)
        return index <= GN_TECHNIQUE_TRUTH ? gn_techniques[index].name : NULL;
    return row->choices ? row->choices[index].name : NULL;
}

static const struct gn_choice *find_choice(const struct gn_kind_input *in) {
    const struct gn_choice *choice = in->row->choices;
    while (choice->name && strcmp(choice->name, in->text) != 0) choice++;
    return choice->name ? choice : NULL;
}

static bool parse_choice(struct gn_kind_input *in, void *field) {
    const struct gn_choice *choice = find_choice(in);
    if (choice) *(int *)field = choice->value;
    return choice;
}

static void print_choice(const void *field, const struct gn_kind_output *to) {
    const struct gn_choice *choice = to->row->choices;
    while (choice->name && choice->value != *(const int *)field) choice++;
    gn_text_add(to->out, to->size, "%s", choice->name ? choice->name : "");
}

static bool parse_color(struct gn_kind_input *in, void *field) {
    const char *text = in->text;
    const bool is_code = text[0] == '#' && strlen(text) == 7 &&
                         !text[1 + strspn(text + 1, "0123456789abcdefABCDEF")];
    if (!is_code) return parse_choice(in, field);
    *(int *)field = (int)strtol(text + 1, NULL, 16);
    return true;
}

static void print_color(const void *field, const struct gn_kind_output *to) {
    const int color = *(const int *)field;
    if (color < 0)
        print_choice(field, to);
    else
        gn_text_add(to->out, to->size, "#%06x", (unsigned)color);
}

static bool parse_word(struct gn_kind_input *in, void *field) {
    const struct gn_choice *choice = find_choice(in);
    if (choice) *(const char **)field = choice->name;
    return choice;
}

/* ---- texts --------------------------------------------------------------------------------- */

static bool parse_text(struct gn_kind_input *in, void *field) {
    return in->text[0] && gn_kind_keep(in, field);
}

static void print_text(const void *field, const struct gn_kind_output *to) {
    const char *text = *(const char *const *)field;
    gn_text_add(to->out, to->size, "%s", text ? text : "");
}

static bool parse_modeline(struct gn_kind_input *in, void *field) {
    drmModeModeInfo unused;
    if (in->text[0] && !gn_kms_modeline_parse(in->text, &unused))
        return gn_fail_usage(in->err,
                             "\"%.80s\" is no mode: MHz, four rising widths, four rising heights "
                             "and flags, as the program cvt prints them after the name",
                             in->text);
    return parse_text(in, field);
}

static bool parse_caps(struct gn_kind_input *in, void *field) {
    uint32_t unused;
    return gn_caps_parse(in->text, &unused, in->err) && parse_text(in, field);
}

/* ---- lists --------------------------------------------------------------------------------- */

static bool find_technique(const char *name, size_t length, enum gn_technique *found) {
    const char *truth = gn_techniques[GN_TECHNIQUE_TRUTH].name;
    *found = GN_TECHNIQUE_TRUTH;
    if (length == strlen(truth) && memcmp(name, truth, length) == 0) return true;
    return gn_technique_find(name, length, found);
}

static bool parse_techniques(struct gn_kind_input *in, void *field) {
    struct gn_technique_list list = {0};
    enum gn_technique found, twice = GN_TECHNIQUE_ALL;
    for (const char *at = in->text;; at++) {
        const size_t length = strcspn(at, ",");
        if (!find_technique(at, length, &found)) {
            snprintf(in->wrong, GN_KIND_WRONG, "%.*s", (int)length, at);
            return false;
        }
        bool is_there = false;
        for (int i = 0; i < list.count; i++) is_there |= list.items[i] == found;
        if (is_there && twice == GN_TECHNIQUE_ALL) twice = found;
        if (!is_there) list.items[list.count++] = (uint8_t)found;
        at += length;
        if (!*at) break;
    }
    if (twice != GN_TECHNIQUE_ALL)
        return gn_fail_usage(in->err, "%s is there twice", gn_techniques[twice].name);
    *(struct gn_technique_list *)field = list;
    return true;
}

static void print_techniques(const void *field, const struct gn_kind_output *to) {
    const struct gn_technique_list *list = field;
    for (int i = 0; i < list->count; i++)
        gn_text_add(to->out, to->size, "%s%s", i ? "," : "", gn_techniques[list->items[i]].name);
}

static bool parse_scenes(struct gn_kind_input *in, void *field) {
    struct gn_scene_list *list = field;
    if (list->count == GN_SCENES_MAX || !parse_text(in, &list->paths[list->count])) return false;
    list->count++;
    return true;
}

static void print_scenes(const void *field, const struct gn_kind_output *to) {
    const struct gn_scene_list *list = field;
    for (int i = 0; i < list->count; i++)
        gn_text_add(to->out, to->size, "%s%s", i ? " " : "", list->paths[i]);
}

static bool parse_limit(struct gn_kind_input *in, void *field) {
    struct gn_limits *limits = field;
    const char *equals = strchr(in->text, '=');
    int64_t value;
    if (!equals || equals == in->text) return false;
    if (!gn_parse_int(equals + 1, &value) || !is_in_range(in->row, (double)value)) return false;
    char *name = gn_arena_strdup(in->arena, in->text);
    if (!name) return gn_fail(in->err, "no memory left");
    name[equals - in->text] = '\0';
    if (!gn_scene_limits_set(&limits->all, name, (uint64_t)value, in->err)) return false;
    int at = 0; /* a name is there once */
    while (at < limits->count && strcmp(limits->items[at].name, name) != 0) at++;
    if (at == GN_LIMITS_MAX) return false;
    limits->items[at] = (struct gn_limit){name, value};
    if (at == limits->count) limits->count++;
    return true;
}

static void print_limits(const void *field, const struct gn_kind_output *to) {
    const struct gn_limits *limits = field;
    for (int i = 0; i < limits->count; i++)
        gn_text_add(to->out, to->size, "%s%s=%lld", i ? " " : "", limits->items[i].name,
                    (long long)limits->items[i].value);
}

static bool parse_hours(struct gn_kind_input *in, void *field) {
    return gn_schedule_parse(in->text, in->row->fallback, field);
}

static void print_hours(const void *field, const struct gn_kind_output *to) {
    gn_schedule_text(field, to->row->fallback, to->out, to->size);
}

/* ---- the table ----------------------------------------------------------------------------- */

static void expect_words(const struct gn_kind_output *to) {
    const char *word;
    gn_text_add(to->out, to->size, "%sone of", to->row->kind == GN_KIND_COLOR ? "#rrggbb or " : "");
    for (int i = 0; (word = gn_value_word(to->row, i)); i++)
        if (to->row->kind != GN_KIND_TECHNIQUES || i != GN_TECHNIQUE_TRUTH)
            gn_text_add(to->out, to->size, "%s %s", i ? "," : "", word);
}

static void expect_text(const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%s (empty)", to->row->value);
}

static void expect_scenes(const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%s (empty, or more than %d of them)", to->row->value,
                GN_SCENES_MAX);
}

static void expect_hours(const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size, "%s, or hours as mon-fri 08:00-20:00, sat 10:00-18:00",
                to->row->fallback);
}

static void expect_limit(const struct gn_kind_output *to) {
    gn_text_add(to->out, to->size,
                "NAME=VALUE with a whole number from %.0f to %.0f, at most %d times", to->row->min,
                to->row->max, GN_LIMITS_MAX);
}

#define TEXT(parse) sizeof(const char *), true, parse, print_text

/* A row makes a kind of value. */
static const struct kind {
    size_t size;
    bool is_text; /* the field is a const char * */
    /* False without a message: the text is not what is expected. */
    bool (*parse)(struct gn_kind_input *in, void *field);
    void (*print)(const void *field, const struct gn_kind_output *to);
    const char *expected; /* a format of min and max; NULL: expect() prints it */
    void (*expect)(const struct gn_kind_output *to);
} kinds[] = {
    /* clang-format off */
    [GN_KIND_FLAG] = {sizeof(bool), false, parse_flag, print_flag, .expected = "yes or no"},
    [GN_KIND_INT] = {sizeof(int), false, parse_int, print_int, .expected = "a whole number from %.0f to %.0f"},
    [GN_KIND_NUMBER] = {sizeof(double), false, parse_number, print_number, .expected = "a number from %.9g to %.9g"},
    [GN_KIND_SECONDS] = {sizeof(int64_t), false, parse_seconds, print_seconds, .expected = "a number from %.9g to %.9g"},
    [GN_KIND_MS] = {sizeof(int64_t), false, parse_ms, print_ms, .expected = "a whole number from %.0f to %.0f"},
    [GN_KIND_SIZE] = {sizeof(struct gn_size), false, parse_size, print_size, .expected = "a size WxH, each side from %.0f to %.0f"},
    [GN_KIND_MODE] = {sizeof(struct gn_display_mode), false, parse_mode, print_mode, .expected = "WxH or WxH@HZ, each side from %.0f to %.0f"},
    [GN_KIND_EV] = {sizeof(double), false, parse_ev, print_number, .expected = "auto or a number from %.9g to %.9g"},
    [GN_KIND_LEVEL] = {sizeof(double), false, parse_level, print_number, .expected = "auto, none or a number from %.0f to %.0f"},
    [GN_KIND_SHARE] = {sizeof(double), false, parse_share, print_share, .expected = "auto, full or a number from %.0f to %.0f"},
    [GN_KIND_POINT] = {3 * sizeof(double), false, gn_kind_parse_point, gn_kind_print_point, .expected = "auto or three numbers X,Y,Z"},
    [GN_KIND_PLACE] = {2 * sizeof(double), false, gn_kind_parse_place, gn_kind_print_place, .expected = "auto or LAT,LON: degrees north from -90 to 90, and east from -180 to 180"},
    [GN_KIND_DATE] = {TEXT(gn_kind_parse_date), .expected = "now, a date 1900-01-01 to 2100-12-31, or one with a time: 2026-12-21T09:30, with Z or +01:00 behind it another zone than time_zone's"},
    [GN_KIND_CHOICE] = {sizeof(int), false, parse_choice, print_choice, .expect = expect_words},
    [GN_KIND_COLOR] = {sizeof(int), false, parse_color, print_color, .expect = expect_words},
    [GN_KIND_WORD] = {TEXT(parse_word), .expect = expect_words},
    [GN_KIND_TECHNIQUES] = {sizeof(struct gn_technique_list), false, parse_techniques, print_techniques, .expect = expect_words},
    [GN_KIND_TEXT] = {TEXT(parse_text), .expect = expect_text},
    [GN_KIND_MODELINE] = {TEXT(parse_modeline), .expect = expect_text},
    [GN_KIND_PATH] = {TEXT(parse_text), .expect = expect_text},
    [GN_KIND_CAPS] = {TEXT(parse_caps), .expect = expect_text},
    [GN_KIND_SCENES] = {sizeof(struct gn_scene_list), false, parse_scenes, print_scenes, .expect = expect_scenes},
    [GN_KIND_LIMIT] = {sizeof(struct gn_limits), false, parse_limit, print_limits, .expect = expect_limit},
    [GN_KIND_HOURS] = {sizeof(struct gn_schedule), false, parse_hours, print_hours, .expect = expect_hours},
    [GN_KIND_LINE] = {TEXT(gn_kind_parse_line), .expected = "a line's name such as GPIO17, or label:LABEL/OFFSET such as label:pinctrl-rp1/17 (the numbers of chips change)"},
    [GN_KIND_KEYS] = {TEXT(gn_kind_parse_keys), .expected = "one to 32 names of keys, a space between two"},
    [GN_KIND_NAMES] = {TEXT(gn_kind_parse_names), .expected = "two or more names of other buttons, a space between two"},
    [GN_KIND_ACTION] = {sizeof(struct gn_binding), false, gn_kind_parse_action, gn_kind_print_action, .expected = "an action"},
    /* clang-format on */
};
_Static_assert(sizeof kinds / sizeof kinds[0] == GN_KIND_COUNT, "a row per kind");

size_t gn_value_size(enum gn_option_kind kind) { return kinds[kind].size; }

bool gn_value_same(const struct gn_option_row *row, const void *a, const void *b) {
    if (!kinds[row->kind].is_text) return memcmp(a, b, kinds[row->kind].size) == 0;
    const char *x = *(const char *const *)a, *y = *(const char *const *)b;
    return x == y || (x && y && strcmp(x, y) == 0);
}

static bool has_key(const char *names, unsigned key) {
    char name[64];
    while (gn_text_word(&names, name, sizeof name))
        if (gn_key_find(name) == key) return true;
    return false;
}

bool gn_value_shared(const struct gn_option_row *row, const void *a, const void *b, char *out,
                     size_t size) {
    if (row->kind == GN_KIND_KEYS) {
        const char *at = *(const char *const *)a, *others = *(const char *const *)b;
        while (gn_text_word(&at, out, size))
            if (has_key(others, gn_key_find(out))) return true;
        return false;
    }
    gn_value_text(row, a, out, size);
    return gn_value_same(row, a, b);
}

void gn_value_text(const struct gn_option_row *row, const void *field, char *out, size_t size) {
    out[0] = '\0';
    kinds[row->kind].print(field, &(struct gn_kind_output){row, out, size});
}

/* "a whole number from 16 to 16384" */
static void print_expected(const struct gn_option_row *row, char *out, size_t size) {
    const struct kind *kind = &kinds[row->kind];
    out[0] = '\0';
    if (kind->expected)
        snprintf(out, size, kind->expected, row->min, row->max);
    else
        kind->expect(&(struct gn_kind_output){row, out, size});
}

bool gn_value_parse(const struct gn_option_row *row, const char *text, void *field,
                    struct gn_arena *arena, const char *label, struct gn_err *err) {
    struct gn_err why = {0};
    char wrong[GN_KIND_WRONG] = "", expected[160];
    struct gn_kind_input in = {
        .row = row, .text = text, .arena = arena, .err = &why, .wrong = wrong};
    if (kinds[row->kind].parse(&in, field)) return true;
    if (why.text[0]) {
        if (err) *err = why;
        return gn_fail_prefix(err, "%s", label);
    }
    struct gn_text_guess guess = {0};
    const char *word;
    for (int i = 0; (word = gn_value_word(row, i)); i++)
        gn_text_guess(&guess, row->choices ? text : wrong, word);
    print_expected(row, expected, sizeof expected);
    return gn_fail_usage(err, "%s: \"%.80s\" is not %s%s%s%s", label, text, expected,
                         guess.name ? "; did you mean " : "", guess.name ? guess.name : "",
                         guess.name ? "?" : "");
}
