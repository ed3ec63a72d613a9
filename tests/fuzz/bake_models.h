/* Valid files for bake, made from a number: of 1e-6 to 1e6 metres, near and far, indexed or not,
 * with vertices that nothing draws, shared and sparse accessors, targets, skins, instances,
 * mirrored nodes, integers, and texture coordinates anywhere. */
#ifndef GN_TESTS_FUZZ_BAKE_MODELS_H
#define GN_TESTS_FUZZ_BAKE_MODELS_H

#include <stddef.h>

#include "unit/gltf_maker.h"

/* what: what is in it, as words. */
struct gn_made gn_bake_model(int number, char *what, size_t what_size);

#endif
