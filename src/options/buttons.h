/* [button "NAME"] of the configuration file: the source of a button and its actions. */
#ifndef GN_OPTIONS_BUTTONS_H
#define GN_OPTIONS_BUTTONS_H

#include "options/section.h"

enum { GN_BUTTON_ROWS = 15 };
extern const struct gn_option_row gn_button_rows[GN_BUTTON_ROWS]; /* of struct gn_button_config */

/* As take() of struct gn_section_row. Checks for modes and buttons that do not exist, and buttons
 * without a source or an action. */
bool gn_buttons_take(struct gn_options *options, const struct gn_sections *sections, bool checks,
                     struct gn_err *err);

#endif
