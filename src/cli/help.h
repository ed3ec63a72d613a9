/* What people read about the options, out of the one table. */
#ifndef GN_CLI_HELP_H
#define GN_CLI_HELP_H

#include <stdio.h>

#include "options/options.h"

/* --help: of one command, or of all (GN_COMMAND_AUTO). At most 100 columns. */
void gn_help_print(FILE *to, enum gn_command command);
/* The man page gnomon(1), in roff. */
void gn_help_print_man(FILE *to, const char *version);

#endif
