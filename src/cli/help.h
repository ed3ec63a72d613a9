/* --help, from the tables of commands and options. The manuals (board/host/man.c) share its texts.
 */
#ifndef GN_CLI_HELP_H
#define GN_CLI_HELP_H

#include <stdio.h>

#include "options/options.h"

/* --help: of one command, or of all (GN_COMMAND_AUTO). At most 100 columns. all: every option;
 * else, where there are many, those that are used most. */
void gn_help_print(FILE *to, enum gn_command command, bool all);

/* What an option does, its choices and its default: "antialiasing: 0, 2, 4 (default 0 samples)". */
void gn_help_phrase(const struct gn_option_row *row, char *out, size_t size);

struct gn_help_entry {
    const char *name, *meaning;
};
extern const struct gn_help_entry gn_help_exits[]; /* ends with a NULL name */
/* Keys and lines of a button that there is without a configuration: "space, right, n; GPIO17", and
 * the name of its action. False: there are no more. */
bool gn_help_default_button(int index, char *keys, size_t size, const char **action);

#endif
