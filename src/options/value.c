#include "options/value.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/text.h"
#include "display/kms/card.h"
#include "frame/caps.h"
#include "scene/scene.h"
#include "shadow/technique.h"

bool gn_parse_int(const char *text, int64_t *out) {
    const char *digits = text[0] == '-' ? text + 1 : text;
    if (!digits[0] || digits[strspn(digits, "0123456789")]) return false;
    errno = 0;
    *out = strtoll(text, NULL, 10);
    return errno == 0;
}

bool gn_parse_number(const char *text, double *out) {
    char *end;
    if (!text[0] || text[strspn(text, "+-.0123456789eE")] || !strpbrk(text, "0123456789"))
        return false;
    *out = strtod(text, &end);
    return *end == '\0' && isfinite(*out);
}

typedef bool parse_fn(const struct gn_option_row *row, const char *text, void *field,
                      struct gn_arena *arena);

static bool parse_flag(const struct gn_option_row *row, const char *text, void *field,
                       struct gn_arena *arena) {
    static const struct gn_choice words[] = {{"yes", 1}, {"no", 0},  {"true", 1}, {"false", 0},
                                             {"on", 1},  {"off", 0}, {"1", 1},    {"0", 0}};
    (void)row, (void)arena;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(text, words[i].name) == 0) {
            *(bool *)field = words[i].value;
            return true;
        }
    return false;
}

static bool in_range(const struct gn_option_row *row, double value) {
    return value >= row->min && value <= row->max;
}

static bool parse_int(const struct gn_option_row *row, const char *text, void *field,
                      struct gn_arena *arena) {
    int64_t value;
    (void)arena;
    if (!gn_parse_int(text, &value) || !in_range(row, (double)value)) return false;
    *(int *)field = (int)value;
    return true;
}

static bool parse_number(const struct gn_option_row *row, const char *text, void *field,
                         struct gn_arena *arena) {
    double value;
    (void)arena;
    if (!gn_parse_number(text, &value) || !in_range(row, value)) return false;
    *(double *)field = value;
    return true;
}

static bool parse_seconds(const struct gn_option_row *row, const char *text, void *field,
                          struct gn_arena *arena) {
    double seconds;
    if (!parse_number(row, text, &seconds, arena)) return false;
    *(int64_t *)field = llround(seconds * (double)GN_NS_PER_S);
    return true;
}

/* "WxH" at the start of text; *rest is what follows. */
static bool parse_sides(const struct gn_option_row *row, const char *text, int *width, int *height,
                        const char **rest) {
    int used = 0;
    if (text[strspn(text, "0123456789")] != 'x' ||
        sscanf(text, "%6dx%6d%n", width, height, &used) != 2)
        return false;
    const char *second = strchr(text, 'x') + 1;
    *rest = text + used;
    return second[0] >= '0' && second[0] <= '9' && in_range(row, *width) && in_range(row, *height);
}

static bool parse_size(const struct gn_option_row *row, const char *text, void *field,
                       struct gn_arena *arena) {
    struct gn_size size;
    const char *rest;
    (void)arena;
    if (!parse_sides(row, text, &size.width_px, &size.height_px, &rest) || *rest) return false;
    *(struct gn_size *)field = size;
    return true;
}

static bool parse_mode(const struct gn_option_row *row, const char *text, void *field,
                       struct gn_arena *arena) {
    struct gn_display_mode mode = {0};
    const char *rest;
    (void)arena;
    if (!parse_sides(row, text, &mode.width_px, &mode.height_px, &rest)) return false;
    if (*rest &&
        (*rest != '@' || !gn_parse_number(rest + 1, &mode.hz) || mode.hz < 1 || mode.hz > 1000))
        return false;
    *(struct gn_display_mode *)field = mode;
    return true;
}

static bool parse_ev(const struct gn_option_row *row, const char *text, void *field,
                     struct gn_arena *arena) {
    if (strcmp(text, "auto") != 0) return parse_number(row, text, field, arena);
    *(double *)field = NAN;
    return true;
}

static const struct gn_choice *find_choice(const struct gn_option_row *row, const char *text) {
    const struct gn_choice *choice = row->choices;
    while (choice->name && strcmp(choice->name, text) != 0) choice++;
    return choice->name ? choice : NULL;
}

static bool parse_choice(const struct gn_option_row *row, const char *text, void *field,
                         struct gn_arena *arena) {
    const struct gn_choice *choice = find_choice(row, text);
    (void)arena;
    if (choice) *(int *)field = choice->value;
    return choice;
}

static bool parse_word(const struct gn_option_row *row, const char *text, void *field,
                       struct gn_arena *arena) {
    const struct gn_choice *choice = find_choice(row, text);
    (void)arena;
    if (choice) *(const char **)field = choice->name;
    return choice;
}

static bool parse_text(const struct gn_option_row *row, const char *text, void *field,
                       struct gn_arena *arena) {
    (void)row;
    if (!text[0]) return false;
    const char *copy = gn_arena_strdup(arena, text);
    *(const char **)field = copy;
    return copy;
}

static int find_technique(const char *name, size_t length) {
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++)
        if (strlen(gn_techniques[i].name) == length &&
            memcmp(gn_techniques[i].name, name, length) == 0)
            return i;
    return -1;
}

/* Of more names than there are techniques one is there twice, which check_techniques() finds. */
static bool parse_techniques(const struct gn_option_row *row, const char *text, void *field,
                             struct gn_arena *arena) {
    struct gn_technique_list list = {0};
    (void)row, (void)arena;
    for (const char *at = text;; at++) {
        const size_t length = strcspn(at, ",");
        const int found = find_technique(at, length);
        if (found < 0) return false;
        if (list.count <= GN_TECHNIQUE_COUNT) list.items[list.count++] = (uint8_t)found;
        at += length;
        if (!*at) break;
    }
    *(struct gn_technique_list *)field = list;
    return true;
}

static bool parse_scenes(const struct gn_option_row *row, const char *text, void *field,
                         struct gn_arena *arena) {
    struct gn_scene_list *list = field;
    if (list->count == GN_SCENES_MAX) return false;
    if (!parse_text(row, text, &list->paths[list->count], arena)) return false;
    list->count++;
    return true;
}

static bool parse_limit(const struct gn_option_row *row, const char *text, void *field,
                        struct gn_arena *arena) {
    struct gn_limits *limits = field;
    const char *equals = strchr(text, '=');
    int64_t value;
    if (limits->count == GN_LIMITS_MAX || !equals || equals == text) return false;
    if (!gn_parse_int(equals + 1, &value) || !in_range(row, (double)value)) return false;
    char *name = gn_arena_strdup(arena, text);
    if (!name) return false;
    name[equals - text] = '\0';
    limits->items[limits->count++] = (struct gn_limit){name, value};
    return true;
}

typedef void expected_fn(const struct gn_option_row *row, char *out, size_t size);

static void expect_flag(const struct gn_option_row *row, char *out, size_t size) {
    (void)row;
    snprintf(out, size, "yes or no");
}

static void expect_int(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "a whole number from %.0f to %.0f", row->min, row->max);
}

static void expect_number(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "a number from %.9g to %.9g", row->min, row->max);
}

static void expect_size(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "a size WxH, each side from %.0f to %.0f", row->min, row->max);
}

static void expect_mode(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "WxH or WxH@HZ, each side from %.0f to %.0f", row->min, row->max);
}

static void expect_ev(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "auto or a number from %.0f to %.0f", row->min, row->max);
}

static void expect_choice(const struct gn_option_row *row, char *out, size_t size) {
    size_t used = (size_t)snprintf(out, size, "one of");
    for (const struct gn_choice *c = row->choices; c->name && used < size; c++)
        used += (size_t)snprintf(out + used, size - used, "%s %s", c == row->choices ? "" : ",",
                                 c->name);
}

static void expect_techniques(const struct gn_option_row *row, char *out, size_t size) {
    size_t used = (size_t)snprintf(out, size, "one of");
    (void)row;
    for (int i = 0; i < GN_TECHNIQUE_COUNT && used < size; i++)
        used +=
            (size_t)snprintf(out + used, size - used, "%s %s", i ? "," : "", gn_techniques[i].name);
}

static void expect_text(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "%s (it is empty)", row->value);
}

static void expect_scenes(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "%s (it is empty, or they are more than %d)", row->value, GN_SCENES_MAX);
}

static void expect_limit(const struct gn_option_row *row, char *out, size_t size) {
    snprintf(out, size, "NAME=VALUE with a whole number from %.0f to %.0f, at most %d times",
             row->min, row->max, GN_LIMITS_MAX);
}

/* Names that another room knows, which also says which there are. */
typedef bool check_fn(const void *field, struct gn_err *err);

static bool check_limit(const void *field, struct gn_err *err) {
    const struct gn_limits *limits = field;
    const struct gn_limit *last = &limits->items[limits->count - 1];
    struct gn_scene_limits unused = {0};
    return gn_scene_limits_set(&unused, last->name, (uint64_t)last->value, err);
}

static bool check_techniques(const void *field, struct gn_err *err) {
    const struct gn_technique_list *list = field;
    for (int i = 0; i < list->count; i++)
        for (int k = 0; k < i; k++)
            if (list->items[i] == list->items[k])
                return gn_fail_usage(err, "%s is there twice", gn_techniques[list->items[i]].name);
    return true;
}

static bool check_caps(const void *field, struct gn_err *err) {
    uint32_t unused;
    return gn_caps_parse(*(const char *const *)field, &unused, err);
}

static bool check_modeline(const void *field, struct gn_err *err) {
    const char *line = *(const char *const *)field;
    drmModeModeInfo unused;
    return gn_kms_modeline_parse(line, &unused) ||
           gn_fail_usage(
               err,
               "\"%.80s\" is no mode: MHz, four rising widths, four rising heights and flags, "
               "as the program cvt prints them after the name",
               line);
}

/* ---- back to words -------------------------------------------------------------------------- */

typedef void text_fn(const struct gn_option_row *row, const void *field, char *out, size_t size);

static void text_of_flag(const struct gn_option_row *row, const void *field, char *out,
                         size_t size) {
    (void)row;
    snprintf(out, size, "%s", *(const bool *)field ? "yes" : "no");
}

static void text_of_int(const struct gn_option_row *row, const void *field, char *out,
                        size_t size) {
    (void)row;
    snprintf(out, size, "%d", *(const int *)field);
}

static void text_of_number(const struct gn_option_row *row, const void *field, char *out,
                           size_t size) {
    (void)row;
    snprintf(out, size, "%.9g", *(const double *)field);
}

static void text_of_seconds(const struct gn_option_row *row, const void *field, char *out,
                            size_t size) {
    (void)row;
    snprintf(out, size, "%.12g", (double)*(const int64_t *)field / (double)GN_NS_PER_S);
}

static void text_of_size(const struct gn_option_row *row, const void *field, char *out,
                         size_t size) {
    const struct gn_size *value = field;
    (void)row;
    snprintf(out, size, "%dx%d", value->width_px, value->height_px);
}

static void text_of_mode(const struct gn_option_row *row, const void *field, char *out,
                         size_t size) {
    const struct gn_display_mode *m = field;
    (void)row;
    out[0] = '\0';
    if (m->width_px)
        snprintf(out, size, m->hz > 0 ? "%dx%d@%.6g" : "%dx%d", m->width_px, m->height_px, m->hz);
}

static void text_of_ev(const struct gn_option_row *row, const void *field, char *out, size_t size) {
    if (isnan(*(const double *)field))
        snprintf(out, size, "auto");
    else
        text_of_number(row, field, out, size);
}

static void text_of_choice(const struct gn_option_row *row, const void *field, char *out,
                           size_t size) {
    const struct gn_choice *c = row->choices;
    while (c->name && c->value != *(const int *)field) c++;
    snprintf(out, size, "%s", c->name ? c->name : "");
}

static void text_of_text(const struct gn_option_row *row, const void *field, char *out,
                         size_t size) {
    const char *text = *(const char *const *)field;
    (void)row;
    snprintf(out, size, "%s", text ? text : "");
}

static void text_of_techniques(const struct gn_option_row *row, const void *field, char *out,
                               size_t size) {
    const struct gn_technique_list *list = field;
    size_t used = 0;
    (void)row;
    out[0] = '\0';
    for (int i = 0; i < list->count && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? "," : "",
                                 gn_techniques[list->items[i]].name);
}

static void text_of_scenes(const struct gn_option_row *row, const void *field, char *out,
                           size_t size) {
    const struct gn_scene_list *list = field;
    size_t used = 0;
    (void)row;
    out[0] = '\0';
    for (int i = 0; i < list->count && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? " " : "", list->paths[i]);
}

static void text_of_limits(const struct gn_option_row *row, const void *field, char *out,
                           size_t size) {
    const struct gn_limits *limits = field;
    size_t used = 0;
    (void)row;
    out[0] = '\0';
    for (int i = 0; i < limits->count && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s=%lld", i ? " " : "",
                                 limits->items[i].name, (long long)limits->items[i].value);
}

static const struct {
    size_t size;
    parse_fn *parse;
    expected_fn *expected;
    text_fn *text;
} kinds[] = {
    [GN_KIND_FLAG] = {sizeof(bool), parse_flag, expect_flag, text_of_flag},
    [GN_KIND_INT] = {sizeof(int), parse_int, expect_int, text_of_int},
    [GN_KIND_NUMBER] = {sizeof(double), parse_number, expect_number, text_of_number},
    [GN_KIND_SECONDS] = {sizeof(int64_t), parse_seconds, expect_number, text_of_seconds},
    [GN_KIND_SIZE] = {sizeof(struct gn_size), parse_size, expect_size, text_of_size},
    [GN_KIND_MODE] = {sizeof(struct gn_display_mode), parse_mode, expect_mode, text_of_mode},
    [GN_KIND_EV] = {sizeof(double), parse_ev, expect_ev, text_of_ev},
    [GN_KIND_CHOICE] = {sizeof(int), parse_choice, expect_choice, text_of_choice},
    [GN_KIND_WORD] = {sizeof(const char *), parse_word, expect_choice, text_of_text},
    [GN_KIND_TECHNIQUES] = {sizeof(struct gn_technique_list), parse_techniques, expect_techniques,
                            text_of_techniques},
    [GN_KIND_TEXT] = {sizeof(const char *), parse_text, expect_text, text_of_text},
    [GN_KIND_MODELINE] = {sizeof(const char *), parse_text, expect_text, text_of_text},
    [GN_KIND_PATH] = {sizeof(const char *), parse_text, expect_text, text_of_text},
    [GN_KIND_SCENES] = {sizeof(struct gn_scene_list), parse_scenes, expect_scenes, text_of_scenes},
    [GN_KIND_LIMIT] = {sizeof(struct gn_limits), parse_limit, expect_limit, text_of_limits},
    [GN_KIND_CAPS] = {sizeof(const char *), parse_text, expect_text, text_of_text},
};
_Static_assert(sizeof kinds / sizeof kinds[0] == GN_KIND_COUNT, "a row per kind");
_Static_assert(sizeof(struct gn_limits) >= sizeof(struct gn_technique_list) &&
                   sizeof(struct gn_limits) >= sizeof(struct gn_scene_list) &&
                   sizeof(struct gn_limits) >= sizeof(struct gn_display_mode),
               "room for a value of any kind is that for limits");

static check_fn *const checks[GN_KIND_COUNT] = {
    /* or NULL */
    [GN_KIND_TECHNIQUES] = check_techniques,
    [GN_KIND_LIMIT] = check_limit,
    [GN_KIND_CAPS] = check_caps,
    [GN_KIND_MODELINE] = check_modeline,
};

size_t gn_value_size(enum gn_option_kind kind) { return kinds[kind].size; }

void gn_value_expected(const struct gn_option_row *row, char *out, size_t size) {
    kinds[row->kind].expected(row, out, size);
}

bool gn_value_same(const struct gn_option_row *row, const void *a, const void *b) {
    if (kinds[row->kind].text != text_of_text) return memcmp(a, b, kinds[row->kind].size) == 0;
    const char *x = *(const char *const *)a, *y = *(const char *const *)b;
    return x == y || (x && y && strcmp(x, y) == 0);
}

void gn_value_text(const struct gn_option_row *row, const void *field, char *out, size_t size) {
    kinds[row->kind].text(row, field, out, size);
}

/* What a wrong name of a list of choices or techniques was meant to be, or NULL. */
static const char *guess_value(const struct gn_option_row *row, const char *text) {
    struct gn_text_guess guess = {0};
    char word[32];
    for (const struct gn_choice *c = row->choices; c && c->name; c++)
        gn_text_guess(&guess, text, c->name);
    while (row->kind == GN_KIND_TECHNIQUES && find_technique(text, strcspn(text, ",")) >= 0 &&
           strchr(text, ','))
        text = strchr(text, ',') + 1;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(text, ","), text);
    for (int i = 0; row->kind == GN_KIND_TECHNIQUES && i < GN_TECHNIQUE_COUNT; i++)
        gn_text_guess(&guess, word, gn_techniques[i].name);
    return guess.name;
}

bool gn_value_parse(const struct gn_option_row *row, const char *text, void *field,
                    struct gn_arena *arena, const char *label, struct gn_err *err) {
    char expected[160];
    check_fn *check = checks[row->kind];
    if (kinds[row->kind].parse(row, text, field, arena))
        return !check || check(field, err) || gn_fail_prefix(err, "%s", label);
    const char *near = guess_value(row, text);
    gn_value_expected(row, expected, sizeof expected);
    return gn_fail_usage(err, "%s: \"%.80s\" is not %s%s%s%s", label, text, expected,
                         near ? "; did you mean " : "", near ? near : "", near ? "?" : "");
}
