/* 64-bit hashes: a quick one for change detection (shadow maps, program keys), and a keyed one for
 * tables whose keys come from a file. */
#ifndef GN_CORE_HASH_H
#define GN_CORE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define GN_HASH_INIT UINT64_C(0x9e3779b97f4a7c15)

/* Chainable: h = gn_hash(h, a, sizeof a); h = gn_hash(h, b, sizeof b). Any size; 8 bytes a step. */
uint64_t gn_hash(uint64_t h, const void *data, size_t size);

/* A secret of this process, so that no file can be made whose keys collide under it. */
struct gn_hash_key {
    uint64_t word[2];
};
struct gn_hash_key gn_hash_key_make(void);
uint64_t gn_hash_keyed(const struct gn_hash_key *key, const void *data, size_t size);

#endif
