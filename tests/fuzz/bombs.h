/* Small files whose numbers are large: scenes that are valid glTF, or nearly so, and ask for as
 * much memory or work as a file of their size can. */
#ifndef GN_TESTS_FUZZ_BOMBS_H
#define GN_TESTS_FUZZ_BOMBS_H

#include "unit/gltf_maker.h"

/* The same bytes for the same number. kinds: what it is made of, for messages. */
struct gn_made gn_bomb_make(uint64_t number, char *kinds, size_t size);

#endif
