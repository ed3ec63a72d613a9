#include "core/err.h"

#include <stdarg.h>
#include <string.h>

#include "core/text.h"

static void set_error(struct gn_err *err, enum gn_exit status, const char *format, va_list args) {
    if (!err) return;
    gn_text_vformat(err->text, sizeof err->text, format, args);
    err->shown[0] = '\0';
    err->status = status;
}

bool gn_fail(struct gn_err *err, const char *format, ...) {
    va_list args;
    va_start(args, format);
    set_error(err, GN_EXIT_RUNTIME, format, args);
    va_end(args);
    return false;
}

bool gn_fail_usage(struct gn_err *err, const char *format, ...) {
    va_list args;
    va_start(args, format);
    set_error(err, GN_EXIT_USAGE, format, args);
    va_end(args);
    return false;
}

bool gn_fail_prefix(struct gn_err *err, const char *format, ...) {
    if (!err) return false;
    struct gn_err prefix;
    va_list args;
    va_start(args, format);
    gn_text_vformat(prefix.text, sizeof prefix.text, format, args);
    va_end(args);
    char said[sizeof err->text];
    memcpy(said, err->text, sizeof said);
    gn_text_format(err->text, sizeof err->text, "%s: %s", prefix.text, said);
    return false;
}

bool gn_errors_take(struct gn_errors *errors, struct gn_err *err) {
    if (!errors) return false;
    int i = 0;
    while (i < errors->count && strcmp(errors->items[i].text, err->text) != 0) i++;
    if (i == GN_ERRORS_MAX)
        errors->dropped++;
    else if (i == errors->count)
        errors->items[errors->count++] = *err;
    *err = (struct gn_err){0};
    return true;
}
