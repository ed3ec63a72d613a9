#include "cli/json_print.h"

bool gn_json_print(json_t *object, int digits, FILE *to, struct gn_err *err) {
    bool ok = object &&
              json_dumpf(object, to, JSON_INDENT(2) | JSON_REAL_PRECISION((size_t)digits)) == 0 &&
              fputc('\n', to) != EOF;
    json_decref(object);
    return ok || (object && ferror(to)) || gn_fail(err, "the report cannot be made");
}
