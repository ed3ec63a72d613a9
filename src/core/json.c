#include "core/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"

json_t *gn_json_make_number(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *gn_json_make_count(uint64_t value) { return json_integer((json_int_t)value); }

json_t *gn_json_make_text(const char *text) {
    json_t *string = text ? json_string(text) : json_null();
    return string ? string : json_string("?");
}

/* Control characters are in strings alone, where their escapes mean the same. */
bool gn_json_print(json_t *object, int digits, FILE *to, struct gn_err *err) {
    const size_t flags = JSON_INDENT(2) | JSON_REAL_PRECISION((size_t)digits);
    char *text = object ? json_dumps(object, flags) : NULL;
    json_decref(object);
    if (!text) return gn_fail(err, "cannot make the JSON report");
    for (char *line = text, *end; line; line = end) {
        end = strchr(line, '\n');
        if (end) *end++ = 0;
        gn_text_print(line, to);
        putc('\n', to);
    }
    free(text);
    return true;
}
