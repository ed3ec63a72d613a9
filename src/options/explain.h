/* What a screen in a public place says of a wrong line of kiosk.ini. */
#ifndef GN_OPTIONS_EXPLAIN_H
#define GN_OPTIONS_EXPLAIN_H

#include "core/err.h"
#include "options/ini.h"
#include "options/section.h"

/* Fills err->shown: line, file, what is wrong, and at most three suggestions, the nearest first.
 * section: that the line is in; NULL: none is open. Values that are paths and names of techniques
 * are left out. */
void gn_config_explain(const struct gn_ini_line *line, const struct gn_section_row *section,
                       struct gn_err *err);

#endif
