#include "input/script.h"

#include <string.h>

enum { SECONDS_MAX = 1000000, DIGITS = 9 };

struct text { /* rest of a line */
    const char *at, *end;
};

static struct text next_word(struct text *line) {
    while (line->at < line->end && (*line->at == ' ' || *line->at == '\t')) line->at++;
    struct text word = {.at = line->at, .end = line->at};
    while (word.end < line->end && *word.end != ' ' && *word.end != '\t') word.end++;
    line->at = word.end;
    return word;
}

/* Decimal seconds to nanoseconds; -1: not a time. */
static int64_t parse_time_ns(struct text word) {
    int64_t seconds = 0, ns = 0;
    int digits = 0, decimals = 0;
    const char *at = word.at;
    for (; at < word.end && *at >= '0' && *at <= '9'; at++, digits++)
        if ((seconds = 10 * seconds + (*at - '0')) > SECONDS_MAX) return -1;
    if (at < word.end && *at == '.')
        for (at++; at < word.end && *at >= '0' && *at <= '9'; at++, digits++)
            if (decimals < DIGITS) ns = 10 * ns + (*at - '0'), decimals++;
    for (; decimals < DIGITS; decimals++) ns *= 10;
    return digits && at == word.end ? seconds * INT64_C(1000000000) + ns : -1;
}

static bool parse_line(struct text line, struct gn_arena *arena, struct gn_script_line *out,
                       struct gn_err *err) {
    static const char *const words[] = {
        [GN_SCRIPT_DOWN] = "down", [GN_SCRIPT_UP] = "up", [GN_SCRIPT_CLICK] = "click"};
    out->time_ns = parse_time_ns(next_word(&line));
    if (out->time_ns < 0)
        return gn_fail_usage(err, "missing time; expected for example: 0.5 click next");
    const struct text what = next_word(&line);
    const size_t what_length = (size_t)(what.end - what.at);
    int i = 0;
    while (i < 3 &&
           (strlen(words[i]) != what_length || memcmp(what.at, words[i], what_length) != 0))
        i++;
    if (i == 3) return gn_fail_usage(err, "unknown action; expected down, up or click");
    out->what = (enum gn_script_what)i;
    const char *begin = next_word(&line).at; /* names may have spaces */
    const char *end = line.end;
    while (end > begin && (end[-1] == ' ' || end[-1] == '\t')) end--;
    const size_t length = (size_t)(end - begin);
    if (!length || length > 63 || memchr(begin, 0, length))
        return gn_fail_usage(err, "missing button or key; expected for example: 0.5 click next");
    char *name = gn_arena_alloc(arena, length + 1, 1);
    if (!name) return gn_fail(err, "out of memory for the lines");
    memcpy(name, begin, length);
    out->name = name;
    return true;
}

bool gn_script_parse(const char *text, size_t size, const char *path, struct gn_arena *arena,
                     struct gn_script *out, struct gn_err *err) {
    size_t most = 1;
    for (const char *at = text; size && (at = memchr(at, '\n', size - (size_t)(at - text))); at++)
        most++;
    struct gn_script_line *lines = gn_arena_alloc(arena, most, sizeof *lines);
    *out = (struct gn_script){.lines = lines};
    if (!lines) return gn_fail(err, "%s: out of memory for its lines", path);
    int number = 0;
    for (const char *at = text, *end = text + size; at < end; number++) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        struct text line = {.at = at, .end = newline ? newline : end};
        at = newline ? newline + 1 : end;
        if (line.end > line.at && line.end[-1] == '\r') line.end--;
        struct text rest = line;
        const struct text word = next_word(&rest);
        if (word.at == word.end || *word.at == '#') continue;
        struct gn_script_line *to = &lines[out->count];
        to->number = number + 1;
        if (!parse_line(line, arena, to, err))
            return gn_fail_prefix(err, "%s:%d", path, number + 1);
        if (out->count && to->time_ns < to[-1].time_ns)
            return gn_fail_usage(err, "%s:%d: time is earlier than that of the line before", path,
                                 number + 1);
        out->count++;
    }
    return true;
}
