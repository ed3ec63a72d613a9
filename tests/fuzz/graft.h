/* Makes something seen of a glTF file that has one faulty object and no scene: what nothing uses is
 * used by a triangle, as far as the file lets it. */
#ifndef GN_TESTS_FUZZ_GRAFT_H
#define GN_TESTS_FUZZ_GRAFT_H

#include "unit/gltf_maker.h"

/* A graft of the bytes of a .gltf or .glb: a container's lengths stay as wrong as they are. data
 * NULL where its JSON cannot be read: such a file is tried as it is. free() data. */
struct gn_made gn_graft(const void *data, size_t size);

#endif
