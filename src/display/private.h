/* The rows of the table of displays, one a file. */
#ifndef GN_DISPLAY_PRIVATE_H
#define GN_DISPLAY_PRIVATE_H

#include "display/display.h"

extern const struct gn_display_ops gn_display_surfaceless; /* surfaceless.c */
extern const struct gn_display_ops gn_display_osmesa;      /* osmesa.c, or osmesa_none.c */

#endif
