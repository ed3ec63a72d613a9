/* INI files, strictly: one setting per line, nothing shortened, nothing guessed. inih splits the
 * lines; before that they are counted, and lines over 190 characters, names over 48, continuation
 * lines and control characters are refused. */
#ifndef GN_OPTIONS_INI_H
#define GN_OPTIONS_INI_H

#include <stdbool.h>
#include <stddef.h>

#include "core/err.h"

#define GN_INI_LINE_MAX 190
#define GN_INI_NAME_MAX 48

struct gn_ini_line {
    const char *where;   /* "kiosk.ini:12" */
    int number;          /* from 1 */
    const char *section; /* "mode" of [mode "Soft"] */
    const char *name;    /* "Soft", or NULL */
    const char *key;     /* NULL: the line opens the section */
    const char *value;
};
typedef bool gn_ini_handler(void *user, const struct gn_ini_line *line, struct gn_err *err);

/* Calls the handler for every section and every setting, in order, and stops at the first that
 * fails. With errors, which may be NULL, it takes them and goes on; the settings of a section that
 * failed are skipped. All texts live only during the call. path is for messages, which are usage
 * errors and begin with "path:line: ". */
bool gn_ini_parse(const char *path, const char *text, size_t size, gn_ini_handler *handler,
                  void *user, struct gn_errors *errors, struct gn_err *err);

#endif
