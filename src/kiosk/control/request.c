#include "kiosk/control/request.h"

#include <stdio.h>
#include <string.h>

/* jansson allows a depth of 2048; a request needs 1. */
static bool is_deep(const char *line, size_t length) {
    int depth = 0;
    bool in_text = false;
    for (size_t i = 0; i < length; i++) {
        if (in_text && line[i] == '\\')
            i++;
        else if (line[i] == '"')
            in_text = !in_text;
        else if (!in_text && (line[i] == '{' || line[i] == '['))
            depth++;
        else if (!in_text && (line[i] == '}' || line[i] == ']'))
            depth--;
        if (depth > GN_REQUEST_DEPTH_MAX) return true;
    }
    return false;
}

/* A member as a string; NULL: missing, or of another type. */
static const char *word_of(const json_t *value, bool any, char *number, size_t size) {
    if (json_is_string(value)) return json_string_value(value);
    if (!any) return NULL;
    if (json_is_boolean(value)) return json_is_true(value) ? "yes" : "no";
    if (json_is_integer(value))
        snprintf(number, size, "%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        snprintf(number, size, "%.17g", json_real_value(value));
    return json_is_number(value) ? number : NULL;
}

static bool read_members(json_t *root, struct gn_request *out, struct gn_err *err) {
    const char *name = json_string_value(json_object_get(root, "cmd")), *key;
    if (!name) return gn_fail_usage(err, "expected {\"cmd\":\"..\"} with a string");
    const int command = gn_ctl_find(name);
    if (command < 0) {
        char list[400];
        const char *nearest = gn_ctl_nearest(name);
        if (nearest)
            return gn_fail_usage(err, "unknown command \"%.60s\"; did you mean %s?", name, nearest);
        gn_ctl_list(list, sizeof list);
        return gn_fail_usage(err, "unknown command \"%.60s\"; expected one of%s", name, list);
    }
    out->command = (enum gn_ctl)command;

    /* check that all members are known */
    const struct gn_ctl_row *row = &gn_ctl_rows[command];
    json_t *value;
    json_object_foreach(root, key, value) {
        bool known = strcmp(key, "cmd") == 0;
        for (int i = 0; i < GN_CTL_WORDS_MAX && row->members[i]; i++)
            known |= strcmp(key, row->members[i]) == 0;
        if (!known) return gn_fail_usage(err, "%s: unknown member \"%.60s\"", row->name, key);
    }

    /* check that none is missing that must be there, and copy each as a word */
    size_t used = 0;
    for (int i = 0; i < GN_CTL_WORDS_MAX && row->members[i]; i++) {
        char number[40];
        const bool any = strcmp(row->members[i], "value") == 0;
        if (i >= gn_ctl_words_least(out->command) && !json_object_get(root, row->members[i])) break;
        const char *word =
            word_of(json_object_get(root, row->members[i]), any, number, sizeof number);
        if (!word)
            return gn_fail_usage(err, "%s: expected a string as \"%s\"%s", row->name,
                                 row->members[i], any ? ", or a number, true or false" : "");
        const size_t size = strlen(word) + 1;
        if (used + size > sizeof out->text)
            return gn_fail_usage(err, "%s: \"%s\" is too long", row->name, row->members[i]);
        memcpy(out->text + used, word, size);
        out->words[i] = out->text + used;
        used += size;
    }
    return true;
}

bool gn_request_parse(const char *line, size_t length, struct gn_request *out, struct gn_err *err) {
    json_error_t why;
    out->fd = -1;
    for (int i = 0; i < GN_CTL_WORDS_MAX; i++) out->words[i] = NULL;
    if (length > GN_REQUEST_LINE_MAX)
        return gn_fail_usage(err, "request is longer than %d bytes", GN_REQUEST_LINE_MAX);
    if (is_deep(line, length))
        return gn_fail_usage(err, "brackets nested deeper than %d", GN_REQUEST_DEPTH_MAX);
    json_t *root = json_loadb(line, length, JSON_REJECT_DUPLICATES, &why);
    if (!root) return gn_fail_usage(err, "not JSON: column %d: %s", why.column, why.text);
    bool ok = json_is_object(root) || gn_fail_usage(err, "expected an object: {\"cmd\":\"..\"}");
    ok = ok && read_members(root, out, err);
    json_decref(root);
    return ok;
}

json_t *gn_reply_text(const char *text) {
    char plain[1024];
    json_t *string = json_string(text);
    if (string) return string;
    snprintf(plain, sizeof plain, "%s", text);
    for (char *c = plain; *c; c++)
        if (*c & 0x80) *c = '?';
    return json_string(plain);
}

json_t *gn_reply_failure(const struct gn_err *err) {
    return json_pack("{s:b, s:o, s:i}", "ok", 0, "error", gn_reply_text(err->text), "status",
                     err->status == GN_EXIT_USAGE ? GN_EXIT_USAGE : GN_EXIT_RUNTIME);
}
