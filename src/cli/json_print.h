/* The one way in which reports become JSON. */
#ifndef GN_CLI_JSON_PRINT_H
#define GN_CLI_JSON_PRINT_H

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

#include "core/err.h"

/* Prints the object with that many digits, and a newline; takes the reference. That the stream
 * cannot be written is not said here: it stays to be seen in ferror(), and main() looks. False when
 * there is no object: it could not be made. */
bool gn_json_print(json_t *object, int digits, FILE *to, struct gn_err *err);

#endif
