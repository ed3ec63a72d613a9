/* Options of a running kiosk: `ctl set`. A change makes a second set of settings, of all modes, and
 * swaps it in; taking it back swaps again. A kiosk runs for years, so what a change leaves behind
 * is bounded: two sets, and two places for the text of each option, take turns. */
#ifndef GN_OPTIONS_CHANGE_H
#define GN_OPTIONS_CHANGE_H

#include "options/options.h"

struct gn_changes;

/* The options must be resolved, and outlive the changes. */
struct gn_changes *gn_changes_create(struct gn_options *options);
void gn_changes_destroy(struct gn_changes *changes);

/* Sets one option in the settings of all modes, as GN_SOURCE_SET; options->all and ->settings point
 * to the new ones then. The old ones live until the next change, their texts until the next but one
 * of the same option; copy what must live longer. Options of the display and those
 * that are read only at the start cannot be set: a failure with the reason. */
bool gn_changes_set(struct gn_changes *changes, const struct gn_option_row *row, const char *text,
                    struct gn_err *err);
/* Undoes the last change; at most once for each. */
void gn_changes_undo(struct gn_changes *changes);

/* The row of a key of `ctl set`, with _ or -, with or without its section: "shadow",
 * "render.shadow", "scene.file", "scene". NULL, and a usage error that names the nearest. */
const struct gn_option_row *gn_changes_find(const char *key, struct gn_err *err);

#endif
