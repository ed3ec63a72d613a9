/* Shared libraries that are opened at run time. */
#ifndef GN_CORE_LIBRARY_H
#define GN_CORE_LIBRARY_H

#include "core/err.h"

/* Opens a library by its soname. NULL: no such library, with the Debian package that has it, or the
 * loader's reason (no memory, no descriptor, a damaged file). Never closed: drivers do not survive
 * it. */
void *gn_library_open(const char *name, const char *package, struct gn_err *err);

#endif
