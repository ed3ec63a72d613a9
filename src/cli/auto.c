/* Bare `gnomon [SCENE]`: a window where there is a desktop; without, full screen where nobody else
 * has the screen; else the picture is written here, and its place printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "core/stop.h"
#include "display/display.h"
#include "kiosk/show.h"

static bool has_desktop(void) { return getenv("WAYLAND_DISPLAY") || getenv("DISPLAY"); }

static bool is(const char *backend, const char *name) { return strcmp(backend, name) == 0; }

/* False: there is none to be had, and err says why only if it was asked for by name. */
static bool shows_window(const struct gn_options *options, bool *ok, struct gn_warnings *warnings,
                         struct gn_err *err) {
    const char *backend = options->settings->display.backend;
    const bool forced = is(backend, "window");
    struct gn_show_place place = {.backend = "window"};
    struct gn_err why = {0};
    if (!forced && (!is(backend, "auto") || !has_desktop())) return false;
    *ok = gn_show_run(options, &place, warnings, &why);
    const bool shown = *ok || forced || place.opened;
    if (shown)
        *err = why;
    else if (options->settings->run.verbose)
        gn_warn(warnings, "no window: %s", why.text);
    return shown;
}

static bool goes_to_screen(const char *backend) {
    if (is(backend, "kms")) return true;
    return is(backend, "auto") && !has_desktop() && gn_display_is_free("kms");
}

bool gn_cli_auto(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    bool ok;
    if (shows_window(options, &ok, warnings, err)) return ok;
    if (goes_to_screen(options->settings->display.backend))
        return gn_cli_show(options, warnings, err);
    struct gn_settings settings = *options->settings;
    struct gn_options here = *options;
    settings.run.out = "gnomon.png";
    here.settings = &settings;
    if (!gn_cli_render(&here, warnings, err)) return false;
    if (gn_stop_asked()) return true;
    char *path = realpath(settings.run.out, NULL);
    printf("%s\n", path ? path : settings.run.out);
    free(path);
    return true;
}
