/* Looks at a copy as a kiosk would, in a child process that may crash or hang. */
#ifndef GN_CLI_TAKE_CHECK_H
#define GN_CLI_TAKE_CHECK_H

#include "core/warn.h"
#include "options/options.h"

/* What is wrong with it, and what only stops nothing. */
struct gn_take_findings {
    struct gn_errors errors;
    struct gn_warnings warnings;
};
/* folder: the copy's, without links; in the texts it is called "gnomon". False: it cannot be shown,
 * and there is an error at least. */
bool gn_take_check(const struct gn_options *options, const char *folder,
                   struct gn_take_findings *out);

#endif
