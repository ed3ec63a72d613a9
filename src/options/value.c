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

static bool in_range(const struct gn_option_row *row, double value) {
    return value >= row->min && value <= row->max;
}

static bool parse_flag(const char *text, bool *field) {
    static const struct gn_choice words[] = {{"yes", 1}, {"no", 0},  {"true", 1}, {"false", 0},
                                             {"on", 1},  {"off", 0}, {"1", 1},    {"0", 0}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(text, words[i].name) == 0) {
            *field = words[i].value;
            return true;
        }
    return false;
}

static bool parse_number(const struct gn_option_row *row, const char *text, double *field) {
    double value;
    if (!gn_parse_number(text, &value) || !in_range(row, value)) return false;
    *field = value;
    return true;
}

static bool parse_point(const struct gn_option_row *row, const char *text, double *field) {
    char part[32];
    double point[3] = {NAN, NAN, NAN};
    for (int k = 0; k < 3 && strcmp(text, "auto") != 0; k++) {
        const size_t length = strcspn(text, ",");
        if (length >= sizeof part || (text[length] == ',') != (k < 2)) return false;
        snprintf(part, sizeof part, "%.*s", (int)length, text);
        if (!parse_number(row, part, &point[k])) return false;
        text += length + (k < 2);
    }
    memcpy(field, point, sizeof point);
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

static const struct gn_choice *find_choice(const struct gn_option_row *row, const char *text) {
    const struct gn_choice *choice = row->choices;
    while (choice->name && strcmp(choice->name, text) != 0) choice++;
    return choice->name ? choice : NULL;
}

static bool parse_color(const struct gn_option_row *row, const char *text, int *field) {
    const struct gn_choice *choice = find_choice(row, text);
    const bool is_code = text[0] == '#' && strlen(text) == 7 &&
                         !text[1 + strspn(text + 1, "0123456789abcdefABCDEF")];
    if (choice) *field = choice->value;
    if (is_code) *field = (int)strtol(text + 1, NULL, 16);
    return choice || is_code;
}

static bool parse_text(const char *text, const char **field, struct gn_arena *arena) {
    if (!text[0]) return false;
    *field = gn_arena_strdup(arena, text);
    return *field;
}

static bool find_technique(const char *name, size_t length, enum gn_technique *found) {
    const char *truth = gn_techniques[GN_TECHNIQUE_TRUTH].name;
    *found = GN_TECHNIQUE_TRUTH;
    if (length == strlen(truth) && memcmp(name, truth, length) == 0) return true;
    return gn_technique_find(name, length, found);
}

/* Names past the array's end are dropped: then one is there twice, which check_value() reports. */
static bool parse_techniques(const char *text, struct gn_technique_list *field) {
    struct gn_technique_list list = {0};
    for (const char *at = text;; at++) {
        const size_t length = strcspn(at, ",");
        enum gn_technique found;
        if (!find_technique(at, length, &found)) return false;
        if (list.count <= GN_TECHNIQUE_COUNT) list.items[list.count++] = (uint8_t)found;
        at += length;
        if (!*at) break;
    }
    *field = list;
    return true;
}

static bool parse_limit(const struct gn_option_row *row, const char *text, struct gn_limits *limits,
                        struct gn_arena *arena) {
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

static bool parse_value(const struct gn_option_row *row, const char *text, void *field,
                        struct gn_arena *arena) {
    int64_t whole;
    double number;
    struct gn_display_mode mode = {0};
    const struct gn_choice *choice;
    const char *rest;
    switch (row->kind) {
    case GN_KIND_FLAG: return parse_flag(text, field);
    case GN_KIND_INT:
        if (!gn_parse_int(text, &whole) || !in_range(row, (double)whole)) return false;
        *(int *)field = (int)whole;
        return true;
    case GN_KIND_NUMBER: return parse_number(row, text, field);
    case GN_KIND_SECONDS:
        if (!parse_number(row, text, &number)) return false;
        *(int64_t *)field = llround(number * (double)GN_NS_PER_S);
        return true;
    case GN_KIND_SIZE:
        if (!parse_sides(row, text, &mode.width_px, &mode.height_px, &rest) || *rest) return false;
        *(struct gn_size *)field = (struct gn_size){mode.width_px, mode.height_px};
        return true;
    case GN_KIND_MODE:
        if (!parse_sides(row, text, &mode.width_px, &mode.height_px, &rest)) return false;
        if (*rest &&
            (*rest != '@' || !gn_parse_number(rest + 1, &mode.hz) || mode.hz < 1 || mode.hz > 1000))
            return false;
        *(struct gn_display_mode *)field = mode;
        return true;
    case GN_KIND_POINT: return parse_point(row, text, field);
    case GN_KIND_EV:
        if (strcmp(text, "auto") != 0) return parse_number(row, text, field);
        *(double *)field = NAN;
        return true;
    case GN_KIND_LEVEL:
        if (strcmp(text, "auto") != 0 && strcmp(text, "none") != 0)
            return parse_number(row, text, field);
        *(double *)field = text[0] == 'a' ? NAN : INFINITY;
        return true;
    case GN_KIND_CHOICE:
        choice = find_choice(row, text);
        if (choice) *(int *)field = choice->value;
        return choice;
    case GN_KIND_COLOR: return parse_color(row, text, field);
    case GN_KIND_WORD:
        choice = find_choice(row, text);
        if (choice) *(const char **)field = choice->name;
        return choice;
    case GN_KIND_TECHNIQUES: return parse_techniques(text, field);
    case GN_KIND_TEXT:
    case GN_KIND_MODELINE:
    case GN_KIND_PATH:
    case GN_KIND_CAPS: return parse_text(text, field, arena);
    case GN_KIND_SCENES: {
        struct gn_scene_list *list = field;
        if (list->count == GN_SCENES_MAX || !parse_text(text, &list->paths[list->count], arena))
            return false;
        list->count++;
        return true;
    }
    case GN_KIND_LIMIT: return parse_limit(row, text, field, arena);
    case GN_KIND_HOURS: return gn_schedule_parse(text, row->fallback, field);
    case GN_KIND_COUNT: break;
    }
    return false;
}

/* Asks the room that knows such names; its failure lists them. */
static bool check_value(const struct gn_option_row *row, const void *field, struct gn_err *err) {
    if (row->kind == GN_KIND_TECHNIQUES) {
        const struct gn_technique_list *list = field;
        for (int i = 0; i < list->count; i++)
            for (int k = 0; k < i; k++)
                if (list->items[i] == list->items[k])
                    return gn_fail_usage(err, "%s is there twice",
                                         gn_techniques[list->items[i]].name);
    } else if (row->kind == GN_KIND_LIMIT) {
        const struct gn_limits *limits = field;
        const struct gn_limit *last = &limits->items[limits->count - 1];
        struct gn_scene_limits unused = {0};
        return gn_scene_limits_set(&unused, last->name, (uint64_t)last->value, err);
    } else if (row->kind == GN_KIND_CAPS) {
        uint32_t unused;
        return gn_caps_parse(*(const char *const *)field, &unused, err);
    } else if (row->kind == GN_KIND_MODELINE) {
        const char *line = *(const char *const *)field;
        drmModeModeInfo unused;
        return gn_kms_modeline_parse(line, &unused) ||
               gn_fail_usage(
                   err,
                   "\"%.80s\" is no mode: MHz, four rising widths, four rising heights and flags, "
                   "as the program cvt prints them after the name",
                   line);
    }
    return true;
}

static const struct {
    size_t size;
    bool is_text; /* the field is a const char * */
} kinds[] = {
    [GN_KIND_FLAG] = {sizeof(bool), false},
    [GN_KIND_INT] = {sizeof(int), false},
    [GN_KIND_NUMBER] = {sizeof(double), false},
    [GN_KIND_SECONDS] = {sizeof(int64_t), false},
    [GN_KIND_SIZE] = {sizeof(struct gn_size), false},
    [GN_KIND_MODE] = {sizeof(struct gn_display_mode), false},
    [GN_KIND_EV] = {sizeof(double), false},
    [GN_KIND_POINT] = {3 * sizeof(double), false},
    [GN_KIND_LEVEL] = {sizeof(double), false},
    [GN_KIND_CHOICE] = {sizeof(int), false},
    [GN_KIND_COLOR] = {sizeof(int), false},
    [GN_KIND_WORD] = {sizeof(const char *), true},
    [GN_KIND_TECHNIQUES] = {sizeof(struct gn_technique_list), false},
    [GN_KIND_TEXT] = {sizeof(const char *), true},
    [GN_KIND_MODELINE] = {sizeof(const char *), true},
    [GN_KIND_PATH] = {sizeof(const char *), true},
    [GN_KIND_SCENES] = {sizeof(struct gn_scene_list), false},
    [GN_KIND_LIMIT] = {sizeof(struct gn_limits), false},
    [GN_KIND_HOURS] = {sizeof(struct gn_schedule), false},
    [GN_KIND_CAPS] = {sizeof(const char *), true},
};
_Static_assert(sizeof kinds / sizeof kinds[0] == GN_KIND_COUNT, "a row per kind");

size_t gn_value_size(enum gn_option_kind kind) { return kinds[kind].size; }

bool gn_value_same(const struct gn_option_row *row, const void *a, const void *b) {
    if (!kinds[row->kind].is_text) return memcmp(a, b, kinds[row->kind].size) == 0;
    const char *x = *(const char *const *)a, *y = *(const char *const *)b;
    return x == y || (x && y && strcmp(x, y) == 0);
}

/* ---- as text ------------------------------------------------------------------------------- */

void gn_value_expected(const struct gn_option_row *row, char *out, size_t size) {
    const double min = row->min, max = row->max;
    size_t used;
    switch (row->kind) {
    case GN_KIND_FLAG: snprintf(out, size, "yes or no"); break;
    case GN_KIND_INT: snprintf(out, size, "a whole number from %.0f to %.0f", min, max); break;
    case GN_KIND_NUMBER:
    case GN_KIND_SECONDS: snprintf(out, size, "a number from %.9g to %.9g", min, max); break;
    case GN_KIND_SIZE:
        snprintf(out, size, "a size WxH, each side from %.0f to %.0f", min, max);
        break;
    case GN_KIND_MODE:
        snprintf(out, size, "WxH or WxH@HZ, each side from %.0f to %.0f", min, max);
        break;
    case GN_KIND_POINT: snprintf(out, size, "auto or three numbers X,Y,Z"); break;
    case GN_KIND_EV: snprintf(out, size, "auto or a number from %.0f to %.0f", min, max); break;
    case GN_KIND_LEVEL:
        snprintf(out, size, "auto, none or a number from %.0f to %.0f", min, max);
        break;
    case GN_KIND_CHOICE:
    case GN_KIND_COLOR:
    case GN_KIND_WORD:
        used = (size_t)snprintf(out, size, "%s",
                                row->kind == GN_KIND_COLOR ? "#rrggbb or one of" : "one of");
        for (const struct gn_choice *c = row->choices; c->name && used < size; c++)
            used += (size_t)snprintf(out + used, size - used, "%s %s", c == row->choices ? "" : ",",
                                     c->name);
        break;
    case GN_KIND_TECHNIQUES:
        used = (size_t)snprintf(out, size, "one of");
        for (int i = 0; i < GN_TECHNIQUE_COUNT && used < size; i++)
            used += (size_t)snprintf(out + used, size - used, "%s %s", i ? "," : "",
                                     gn_techniques[i].name);
        break;
    case GN_KIND_TEXT:
    case GN_KIND_MODELINE:
    case GN_KIND_PATH:
    case GN_KIND_CAPS: snprintf(out, size, "%s (empty)", row->value); break;
    case GN_KIND_SCENES:
        snprintf(out, size, "%s (empty, or more than %d of them)", row->value, GN_SCENES_MAX);
        break;
    case GN_KIND_HOURS:
        snprintf(out, size, "%s, or hours as mon-fri 08:00-20:00, sat 10:00-18:00", row->fallback);
        break;
    case GN_KIND_LIMIT:
        snprintf(out, size, "NAME=VALUE with a whole number from %.0f to %.0f, at most %d times",
                 min, max, GN_LIMITS_MAX);
        break;
    case GN_KIND_COUNT: break;
    }
}

/* The items of a list, joined. */
static void list_text(const struct gn_option_row *row, const void *field, char *out, size_t size) {
    const struct gn_technique_list *techniques = field;
    const struct gn_scene_list *scenes = field;
    const struct gn_limits *limits = field;
    size_t used = 0;
    out[0] = '\0';
    if (row->kind == GN_KIND_TECHNIQUES)
        for (int i = 0; i < techniques->count && used < size; i++)
            used += (size_t)snprintf(out + used, size - used, "%s%s", i ? "," : "",
                                     gn_techniques[techniques->items[i]].name);
    else if (row->kind == GN_KIND_SCENES)
        for (int i = 0; i < scenes->count && used < size; i++)
            used +=
                (size_t)snprintf(out + used, size - used, "%s%s", i ? " " : "", scenes->paths[i]);
    else
        for (int i = 0; i < limits->count && used < size; i++)
            used += (size_t)snprintf(out + used, size - used, "%s%s=%lld", i ? " " : "",
                                     limits->items[i].name, (long long)limits->items[i].value);
}

void gn_value_text(const struct gn_option_row *row, const void *field, char *out, size_t size) {
    const struct gn_display_mode *mode = field;
    const struct gn_size *sides = field;
    const struct gn_choice *choice = row->choices;
    const double *point = field;
    const char *text;
    switch (row->kind) {
    case GN_KIND_POINT:
        if (isnan(point[0]))
            snprintf(out, size, "auto");
        else
            snprintf(out, size, "%.9g,%.9g,%.9g", point[0], point[1], point[2]);
        break;
    case GN_KIND_HOURS: gn_schedule_text(field, row->fallback, out, size); break;
    case GN_KIND_FLAG: snprintf(out, size, "%s", *(const bool *)field ? "yes" : "no"); break;
    case GN_KIND_INT: snprintf(out, size, "%d", *(const int *)field); break;
    case GN_KIND_NUMBER: snprintf(out, size, "%.9g", *(const double *)field); break;
    case GN_KIND_SECONDS:
        snprintf(out, size, "%.12g", (double)*(const int64_t *)field / (double)GN_NS_PER_S);
        break;
    case GN_KIND_SIZE: snprintf(out, size, "%dx%d", sides->width_px, sides->height_px); break;
    case GN_KIND_MODE:
        out[0] = '\0';
        if (mode->width_px)
            snprintf(out, size, mode->hz > 0 ? "%dx%d@%.6g" : "%dx%d", mode->width_px,
                     mode->height_px, mode->hz);
        break;
    case GN_KIND_EV:
    case GN_KIND_LEVEL:
        if (isnan(*(const double *)field))
            snprintf(out, size, "auto");
        else if (isinf(*(const double *)field))
            snprintf(out, size, "none");
        else
            snprintf(out, size, "%.9g", *(const double *)field);
        break;
    case GN_KIND_COLOR:
    case GN_KIND_CHOICE:
        if (row->kind == GN_KIND_COLOR && *(const int *)field >= 0) {
            snprintf(out, size, "#%06x", (unsigned)*(const int *)field);
            break;
        }
        while (choice->name && choice->value != *(const int *)field) choice++;
        snprintf(out, size, "%s", choice->name ? choice->name : "");
        break;
    case GN_KIND_TECHNIQUES:
    case GN_KIND_SCENES:
    case GN_KIND_LIMIT: list_text(row, field, out, size); break;
    case GN_KIND_WORD:
    case GN_KIND_TEXT:
    case GN_KIND_MODELINE:
    case GN_KIND_PATH:
    case GN_KIND_CAPS:
        text = *(const char *const *)field;
        snprintf(out, size, "%s", text ? text : "");
        break;
    case GN_KIND_COUNT: break;
    }
}

/* ---- text to value, with its message ------------------------------------------------------- */

bool gn_value_parse(const struct gn_option_row *row, const char *text, void *field,
                    struct gn_arena *arena, const char *label, struct gn_err *err) {
    if (parse_value(row, text, field, arena))
        return check_value(row, field, err) || gn_fail_prefix(err, "%s", label);
    struct gn_text_guess guess = {0};
    for (const struct gn_choice *c = row->choices; c && c->name; c++)
        gn_text_guess(&guess, text, c->name);
    if (row->kind == GN_KIND_TECHNIQUES) { /* the first wrong name of the list */
        const char *at = text;
        enum gn_technique known;
        char word[32];
        while (find_technique(at, strcspn(at, ","), &known) && strchr(at, ','))
            at = strchr(at, ',') + 1;
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at, ","), at);
        for (int i = 0; i < GN_TECHNIQUE_ALL; i++)
            gn_text_guess(&guess, word, gn_techniques[i].name);
    }
    char expected[160];
    gn_value_expected(row, expected, sizeof expected);
    return gn_fail_usage(err, "%s: \"%.80s\" is not %s%s%s%s", label, text, expected,
                         guess.name ? "; did you mean " : "", guess.name ? guess.name : "",
                         guess.name ? "?" : "");
}
