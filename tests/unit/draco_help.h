/* A file of one mesh that is compressed by Draco. */
#ifndef GN_TESTS_DRACO_HELP_H
#define GN_TESTS_DRACO_HELP_H

#include "unit/gltf_maker.h"

/* Into a maker that is initialised. required: names the extension there, too. */
void gn_maker_draco(struct gn_maker *maker, bool required);

#endif
