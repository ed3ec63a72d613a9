#include "kiosk/show.h"

#include "cli/commands.h"

bool gn_cli_show(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    return gn_show_run(options, NULL, warnings, err);
}
