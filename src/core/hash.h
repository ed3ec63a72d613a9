/* A 64-bit hash for change detection (shadow maps, program keys). Not for hostile input. */
#ifndef GN_CORE_HASH_H
#define GN_CORE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define GN_HASH_INIT UINT64_C(0x9e3779b97f4a7c15)

/* Chainable: h = gn_hash(h, a, sizeof a); h = gn_hash(h, b, sizeof b). Any size; 8 bytes a step. */
uint64_t gn_hash(uint64_t h, const void *data, size_t size);

#endif
