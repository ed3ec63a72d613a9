/* The command line: flags, the command, the scene; then the INI file, then the mode. */
#ifndef GN_OPTIONS_ARGS_H
#define GN_OPTIONS_ARGS_H

#include "core/warn.h"
#include "options/options.h"

/* Fills options, which gn_options_finish() must finish also after a failure. Flags and scene may
 * stand in any order, "--" ends the flags. `show` and the bare command look for a configuration
 * file, the others read the one that -c names. With --help or
 * --version no file is read and nothing else is checked. */
bool gn_args_parse(struct gn_options *options, int argc, char *const *argv,
                   struct gn_warnings *warnings, struct gn_err *err);

#endif
