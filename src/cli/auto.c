/* Bare `gnomon [SCENE]`: this version has neither window nor KMS, so it writes the picture here and
 * says where. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/commands.h"
#include "cli/stop.h"

bool gn_cli_auto(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    struct gn_options here = *options;
    here.out = "gnomon.png";
    if (!gn_cli_render(&here, warnings, err)) return false;
    if (gn_stop_asked()) return true;
    char *path = realpath(here.out, NULL);
    printf("%s\n", path ? path : here.out);
    free(path);
    return true;
}
