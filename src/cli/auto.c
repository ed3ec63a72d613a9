/* Bare `gnomon [SCENE]`: a window on a desktop; without one, full screen if no other program has
 * the screen; else the picture is written into the working directory, and its path printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "core/stop.h"
#include "display/display.h"
#include "kiosk/show.h"

static bool has_desktop(void) { return getenv("WAYLAND_DISPLAY") || getenv("DISPLAY"); }

static bool is_backend(const char *backend, const char *name) { return strcmp(backend, name) == 0; }

bool gn_cli_show_here(const struct gn_options *options, bool *shown, struct gn_warnings *warnings,
                      struct gn_err *err) {
    const char *backend = options->settings->display.backend;
    const bool forced = is_backend(backend, "window"), automatic = is_backend(backend, "auto");
    *shown = true;
    if (forced || (automatic && has_desktop())) {
        struct gn_show_place place = {.backend = "window"};
        struct gn_err why = {0};
        const bool ok = gn_show_run(options, &place, warnings, &why);
        if (ok || forced || place.opened) {
            *err = why;
            return ok;
        }
        gn_warn(warnings, "no window: %s", why.text);
    }
    if (is_backend(backend, "kms") || (automatic && !has_desktop() && gn_display_is_free("kms")))
        return gn_cli_show(options, warnings, err);
    *shown = false;
    return true;
}

bool gn_cli_auto(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    bool shown;
    if (!gn_cli_show_here(options, &shown, warnings, err)) return false;
    if (shown) return true;
    struct gn_settings settings = *options->settings;
    struct gn_options here = *options;
    settings.run.out = "gnomon.png";
    gn_stop_end_process();
    here.settings = &settings;
    if (!gn_cli_render(&here, warnings, err)) return false;
    char *path = realpath(settings.run.out, NULL);
    printf("%s\n", path ? path : settings.run.out);
    free(path);
    return true;
}
