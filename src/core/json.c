#include "core/json.h"

#include <math.h>

json_t *gn_json_make_number(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *gn_json_make_count(uint64_t value) { return json_integer((json_int_t)value); }

json_t *gn_json_make_text(const char *text) {
    json_t *string = text ? json_string(text) : json_null();
    return string ? string : json_string("?");
}

bool gn_json_print(json_t *object, int digits, FILE *to, struct gn_err *err) {
    bool ok = object &&
              json_dumpf(object, to, JSON_INDENT(2) | JSON_REAL_PRECISION((size_t)digits)) == 0 &&
              fputc('\n', to) != EOF;
    json_decref(object);
    return ok || (object && ferror(to)) || gn_fail(err, "cannot make the JSON report");
}
