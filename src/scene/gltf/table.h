/* A hash table of structs in an array, by a key in each. The array is its user's. */
#ifndef GN_SCENE_GLTF_TABLE_H
#define GN_SCENE_GLTF_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gn_gltf;
struct gn_hash_key;

struct gn_table {
    uint32_t *slots; /* index + 1, or 0 */
    size_t mask, stride, key_size;
    const char *keys; /* the first key */
    const struct gn_hash_key *hash_key;
};

/* For at most that many structs, until the load ends. stride, key_size and keys are set. */
bool gn_table_init(struct gn_gltf *g, struct gn_table *table, size_t most);
/* The slot of an equal key, or the empty one where it belongs. */
uint32_t *gn_table_find(const struct gn_table *table, const void *key);

#endif
