/* Bare `gnomon [SCENE]`: full screen where there is no desktop and a screen that nobody else has;
 * else the picture is written here, and its place printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/stop.h"
#include "display/display.h"

static bool has_desktop(void) { return getenv("WAYLAND_DISPLAY") || getenv("DISPLAY"); }

static bool goes_to_screen(const struct gn_options *options) {
    if (strcmp(options->backend, "kms") == 0) return true;
    return strcmp(options->backend, "auto") == 0 && !has_desktop() && gn_display_is_free("kms");
}

bool gn_cli_auto(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    if (goes_to_screen(options)) return gn_cli_show(options, warnings, err);
    struct gn_options here = *options;
    here.out = "gnomon.png";
    if (!gn_cli_render(&here, warnings, err)) return false;
    if (gn_stop_asked()) return true;
    char *path = realpath(here.out, NULL);
    printf("%s\n", path ? path : here.out);
    free(path);
    return true;
}
