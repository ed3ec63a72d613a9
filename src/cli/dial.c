/* gnomon dial: a sundial for a place, as a scene or as a pattern for cutting. */
#include "dial/dial.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"

/* Degrees from -180 to 180: how far the place is from the meridian of its clock. */
static double wrapped_deg(double degrees) { return remainder(degrees, 360); }

static bool check_settings(const struct gn_settings *s, bool *is_svg, struct gn_err *err) {
    const char *out = s->run.out, *dot = out ? strrchr(out, '.') : NULL;
    if (!gn_settings_given(s, run.dial.latitude_deg))
        return gn_fail_usage(err, "dial needs --latitude DEG, positive to the north");
    if (!out) return gn_fail_usage(err, "dial needs -o FILE.glb or -o FILE.svg");
    *is_svg = dot && strcmp(dot, ".svg") == 0;
    if (!*is_svg && !(dot && strcmp(dot, ".glb") == 0))
        return gn_fail_usage(err, "-o %s: dial writes .glb or .svg files: name it so", out);
    if (gn_settings_given(s, run.dial.longitude_deg) != gn_settings_given(s, run.dial.meridian_deg))
        return gn_fail_usage(err, "--longitude and --meridian go together: hours by the clock of a "
                                  "time zone; without both, hours of the sun at the place");
    if (gn_settings_given(s, run.dial.wall_deg) && s->run.dial.kind != GN_DIAL_VERTICAL)
        return gn_fail_usage(err, "--declination is of a wall: add --kind vertical");
    return true;
}

/* The model's sun: mid-morning of a summer's day in that hemisphere, or when a wall is lit. */
static void set_sun(struct gn_dial_opts *opts) {
    const double north = opts->latitude_deg < 0 ? -1 : 1;
    opts->sun_deg = 14 * north;
    opts->sun_hour_deg = 36;
    if (opts->kind == GN_DIAL_VERTICAL) {
        const bool faces_pole = north * cos(opts->wall_deg * M_PI / 180) < 0;
        const double side = sin(opts->wall_deg * M_PI / 180) < 0 ? -1 : 1;
        opts->sun_deg = north * (faces_pole ? 21 : -6);
        opts->sun_hour_deg = side * (faces_pole ? 100 : 24);
    }
}

static bool write_dial(const struct gn_dial *dial, bool is_svg, const char *path,
                       struct gn_err *err) {
    struct gn_bytes bytes = {0};
    (is_svg ? gn_dial_svg : gn_dial_model)(dial, &bytes);
    const bool done = gn_file_write(path, bytes.data, bytes.size, err);
    gn_bytes_finish(&bytes);
    return done;
}

bool gn_cli_dial(const struct gn_options *options, struct gn_warnings *warnings,
                 struct gn_err *err) {
    const struct gn_settings *s = options->settings;
    struct gn_dial_opts opts = {.kind = (enum gn_dial_kind)s->run.dial.kind,
                                .latitude_deg = s->run.dial.latitude_deg,
                                .wall_deg = s->run.dial.wall_deg,
                                .size_m = s->run.dial.width_m};
    struct gn_dial dial = {0};
    bool is_svg = false;
    (void)warnings;
    if (!check_settings(s, &is_svg, err)) return false;
    if (gn_settings_given(s, run.dial.longitude_deg))
        opts.shift_deg = wrapped_deg(s->run.dial.longitude_deg - s->run.dial.meridian_deg);
    if (!gn_settings_given(s, run.dial.wall_deg) && opts.latitude_deg < 0) opts.wall_deg = 180;
    set_sun(&opts);
    const bool done =
        gn_dial_build(&dial, &opts, err) && write_dial(&dial, is_svg, s->run.out, err);
    gn_dial_finish(&dial);
    return done;
}
