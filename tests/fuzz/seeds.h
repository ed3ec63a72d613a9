/* Valid files made in memory, which between them use all that the loader knows. */
#ifndef GN_TESTS_FUZZ_SEEDS_H
#define GN_TESTS_FUZZ_SEEDS_H

#include "unit/gltf_maker.h"

enum { GN_SEED_COUNT = 11 };
struct gn_made gn_seed_make(int number);

#endif
