/* The commands, one file each. Each prints its result to stdout; false with err filled is a
 * failure. */
#ifndef GN_CLI_COMMANDS_H
#define GN_CLI_COMMANDS_H

#include "core/warn.h"
#include "options/options.h"

typedef bool gn_cli_command(const struct gn_options *options, struct gn_warnings *warnings,
                            struct gn_err *err);

#define GN_COMMAND(ID, id, ...) gn_cli_command gn_cli_##id;
#include "options/command_rows.h"
#undef GN_COMMAND
gn_cli_command gn_cli_check; /* `show --check FILE` */

/* Shows it in a window or, without a desktop, full screen, if --backend allows it. *shown is false
 * where there is neither. */
bool gn_cli_show_here(const struct gn_options *options, bool *shown, struct gn_warnings *warnings,
                      struct gn_err *err);

/* Whether this machine has what the settings ask for, of each mode: into the list of errors; what a
 * kiosk waits for is a warning. */
void gn_cli_check_here(const struct gn_options *options, struct gn_errors *errors,
                       struct gn_warnings *warnings);

#endif
