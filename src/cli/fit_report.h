/* What gnomon fit has chosen: as sentences, as JSON, and as a kiosk.ini. */
#ifndef GN_CLI_FIT_REPORT_H
#define GN_CLI_FIT_REPORT_H

#include <stdio.h>

#include "cli/fit.h"
#include "core/arena.h"
#include "cost/gpu.h"
#include "options/settings.h"

struct gn_fitting {
    const struct gn_settings *given; /* by flags */
    struct gn_settings best;         /* with the best picture, where no flag says otherwise */
    const struct gn_cost_gpu *gpu;
    struct gn_fit_step steps[GN_FIT_STEPS_MAX];
    struct gn_fit search;
};

/* The settings of the best picture less those steps, but those of one light. */
void gn_fit_settings(const struct gn_fitting *fitting, gn_fit_set taken, struct gn_settings *out,
                     struct gn_arena *arena);

/* Whether their one technique has samples. */
bool gn_fit_has_taps(const struct gn_settings *settings);

/* Whether a kiosk.ini may be written there: not over another one, which somebody may have written
 * by hand. NULL: none is. */
bool gn_fit_may_write(const char *path, struct gn_err *err);
/* The settings as a kiosk.ini, which the program's own reader has taken; free() it. Paths in it are
 * seen from the folder of --out, if they are in that, else absolute. NULL: it cannot be written. */
char *gn_fit_write(const struct gn_fitting *fitting, const struct gn_settings *chosen,
                   struct gn_err *err);
/* With --json {gpu, board, width_px, height_px, frames_per_second, goal_ms, best_ms, ms, met,
 * steps [{option, value, light|null, loses, saves_ms}], ini}. */
bool gn_fit_print(const struct gn_fitting *fitting, const char *ini, FILE *to, struct gn_err *err);

#endif
