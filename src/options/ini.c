#include "options/ini.h"

#include <ini.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"

struct reader {
    const char *path, *at, *end;
    gn_ini_handler *handler;
    void *user;
    struct gn_errors *errors;
    struct gn_err *err;
    bool failed, skips; /* skips: the settings of a section that failed */
    int number;
    char where[300];
    char header[GN_INI_LINE_MAX + 1]; /* of the section, cut into its two names */
    const char *section, *name;
};

static void show_line(struct reader *r, const char *what) {
    const char *slash = strrchr(r->path, '/');
    if (r->err)
        gn_text_format(r->err->shown, sizeof r->err->shown, "Line %d of %s: %s.", r->number,
                       slash ? slash + 1 : r->path, what);
}

static bool refuse_line(struct reader *r, const char *what) {
    r->failed = true;
    gn_fail_usage(r->err, "%s: %s", r->where, what);
    show_line(r, what);
    return false;
}

/* After a success, or a failure that is only noted. */
static bool goes_on(struct reader *r) {
    if (r->failed && gn_errors_take(r->errors, r->err)) r->failed = false;
    return !r->failed;
}

static bool is_blank(char c) { return c == ' ' || c == '\t'; }

static bool is_nothing(const char *rest) {
    rest += strspn(rest, " \t");
    return *rest == '\0' || *rest == ';' || *rest == '#';
}

static bool read_header(struct reader *r, const char *line) {
    snprintf(r->header, sizeof r->header, "%s", line + 1);
    char *close = strchr(r->header, ']');
    if (!close) return refuse_line(r, "a section ends with ]");
    if (!is_nothing(close + 1)) return refuse_line(r, "nothing may follow the ] of a section");
    *close = '\0';
    char *space = strpbrk(r->header, " \t\"");
    char *quote = space ? space + strspn(space, " \t") : NULL;
    char *end = quote && *quote == '"' ? strchr(quote + 1, '"') : NULL;
    if (end && end == quote + 1) end = NULL; /* an empty name */
    if (space && (!end || end[1]))
        return refuse_line(r, "expected [section] or [section \"NAME\"]");
    if (end) *end = *space = '\0';
    r->section = r->header;
    r->name = end ? quote + 1 : NULL;
    if (strlen(r->section) > GN_INI_NAME_MAX || (r->name && strlen(r->name) > GN_INI_NAME_MAX))
        return refuse_line(r, "a name of more than 48 characters");
    struct gn_ini_line opened = {r->where, r->number, r->section, r->name, NULL, NULL};
    r->failed = !r->handler(r->user, &opened, r->err);
    return !r->failed;
}

static bool check_setting(struct reader *r, const char *line) {
    size_t length = strcspn(line, "=:");
    if (is_blank(line[0]))
        return refuse_line(
            r, "begins with a space; a setting is one line and begins at its first column");
    if (line[length] != '=') {
        r->failed = true;
        gn_fail_usage(r->err, "%s: expected KEY = VALUE or [section], not \"%.60s\"", r->where,
                      line);
        show_line(r, "expected KEY = VALUE or [section]");
        return false;
    }
    while (length > 0 && is_blank(line[length - 1])) length--;
    if (length == 0) return refuse_line(r, "expected a key before the =");
    if (length > GN_INI_NAME_MAX) return refuse_line(r, "a key of more than 48 characters");
    if (!r->section) return refuse_line(r, "a setting before the first [section]");
    return true;
}

/* Copies the next line, without the byte order mark that some editors leave. */
static bool next_line(struct reader *r, char *line) {
    const char *newline = memchr(r->at, '\n', (size_t)(r->end - r->at));
    const char *start = r->at, *stop = newline ? newline : r->end;
    r->at = newline ? newline + 1 : r->end;
    snprintf(r->where, sizeof r->where, "%.256s:%d", r->path, ++r->number);
    if (r->number == 1 && stop - start >= 3 && memcmp(start, "\xef\xbb\xbf", 3) == 0) start += 3;
    if (stop > start && stop[-1] == '\r') stop--;
    if (stop - start > GN_INI_LINE_MAX) return refuse_line(r, "a line of more than 190 characters");
    for (const char *at = start; at < stop; at++)
        if (((unsigned char)*at < 0x20 && *at != '\t') || *at == 0x7f)
            return refuse_line(r, "control characters; this is not a text file");
    memcpy(line, start, (size_t)(stop - start));
    line[stop - start] = '\0';
    return true;
}

static char *read_line(char *out, int size, void *user) {
    struct reader *r = user;
    char line[GN_INI_LINE_MAX + 1] = "";
    if (r->failed || r->at == r->end) return NULL;
    bool ok = next_line(r, line);
    if (ok && line[0] == '[') {
        ok = read_header(r, line);
        r->skips = !ok;
    } else if (ok && !r->skips && !is_nothing(line)) {
        ok = check_setting(r, line);
    }
    if (!ok && !goes_on(r)) return NULL;
    snprintf(out, (size_t)size, "%s\n", ok && !r->skips ? line : "");
    return out;
}

static int on_setting(void *user, const char *section, const char *key, const char *value) {
    struct reader *r = user;
    (void)section;
    if (r->failed) return 0;
    struct gn_ini_line line = {r->where, r->number, r->section, r->name, key, value};
    r->failed = !r->handler(r->user, &line, r->err);
    return goes_on(r);
}

bool gn_ini_parse(const char *path, const char *text, size_t size, gn_ini_handler *handler,
                  void *user, struct gn_errors *errors, struct gn_err *err) {
    struct reader r = {.path = path,
                       .at = text,
                       .end = text + size,
                       .handler = handler,
                       .user = user,
                       .errors = errors,
                       .err = err};
    int bad_line = ini_parse_stream(read_line, &r, on_setting, &r);
    if (r.failed) return false;
    if (bad_line == 0) return true;
    return gn_fail_usage(err, "%.256s:%d: expected KEY = VALUE or [section]", path, bad_line);
}
