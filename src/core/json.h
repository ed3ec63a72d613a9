/* JSON reports. */
#ifndef GN_CORE_JSON_H
#define GN_CORE_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "core/err.h"

/* Values, new references. NaN, infinity and NULL become null; text that is not UTF-8 becomes "?":
 * names come from files, drivers and the kernel. */
json_t *gn_json_make_number(double value);
json_t *gn_json_make_count(uint64_t value);
json_t *gn_json_make_text(const char *text);

/* Prints the object with that many digits, and a newline; takes the reference. What would move a
 * terminal's cursor is escaped (gn_text_print). False if
 * object is NULL (it could not be made). A write error is left in ferror(), which main() checks. */
bool gn_json_print(json_t *object, int digits, FILE *to, struct gn_err *err);

#endif
