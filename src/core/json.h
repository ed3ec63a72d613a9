/* The one way in which reports become JSON. */
#ifndef GN_CORE_JSON_H
#define GN_CORE_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "core/err.h"

/* Values, new references. What is not a finite number is null; so is a text that is NULL, and of
 * one that is not UTF-8 only "?" is left: names come out of files, drivers and the kernel. */
json_t *gn_json_make_number(double value);
json_t *gn_json_make_count(uint64_t value);
json_t *gn_json_make_text(const char *text);

/* Prints the object with that many digits, and a newline; takes the reference. That the stream
 * cannot be written is not said here: it stays to be seen in ferror(), and main() looks. False when
 * there is no object: it could not be made. */
bool gn_json_print(json_t *object, int digits, FILE *to, struct gn_err *err);

#endif
