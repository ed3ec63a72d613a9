#include "core/warn.h"

#include <stdarg.h>
#include <string.h>

#include "core/terminal.h"
#include "core/text.h"

void gn_warn(struct gn_warnings *warnings, const char *format, ...) {
    if (!warnings) return;
    char text[sizeof warnings->text[0]];
    va_list args;
    va_start(args, format);
    gn_text_vformat(text, sizeof text, format, args);
    va_end(args);
    for (int i = 0; i < warnings->count; i++)
        if (strcmp(warnings->text[i], text) == 0) return;
    if (warnings->count == GN_WARN_MAX && warnings->printed > 0) {
        warnings->count--;
        warnings->printed--;
        memmove(warnings->text[0], warnings->text[1],
                (size_t)warnings->count * sizeof warnings->text[0]);
    }
    if (warnings->count == GN_WARN_MAX)
        warnings->dropped++;
    else
        memcpy(warnings->text[warnings->count++], text, sizeof text);
}

void gn_warn_flush(struct gn_warnings *warnings, FILE *to) {
    while (warnings->printed < warnings->count)
        fprintf(to, "%sgnomon: warning:%s %s\n", gn_terminal_tint(to, GN_TINT_YELLOW),
                gn_terminal_tint(to, GN_TINT_NONE), warnings->text[warnings->printed++]);
}

void gn_warn_print(struct gn_warnings *warnings, FILE *to) {
    gn_warn_flush(warnings, to);
    if (warnings->dropped) fprintf(to, "gnomon: warning: and %d more\n", warnings->dropped);
}
