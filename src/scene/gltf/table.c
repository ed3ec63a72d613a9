#include "scene/gltf/table.h"

#include <string.h>

#include "core/hash.h"
#include "scene/private.h"

bool gn_table_init(struct gn_gltf *g, struct gn_table *table, size_t most) {
    size_t size = 16;
    while (size < 2 * most) size *= 2;
    table->mask = size - 1;
    table->hash_key = &g->hash_key;
    GN_NEW(g, &g->memory.load, table->slots, size);
    return table->slots != NULL;
}

uint32_t *gn_table_find(const struct gn_table *table, const void *key) {
    size_t at = (size_t)gn_hash_keyed(table->hash_key, key, table->key_size) & table->mask;
    for (;; at = (at + 1) & table->mask) {
        uint32_t slot = table->slots[at];
        if (slot == 0 ||
            memcmp(table->keys + (slot - 1) * table->stride, key, table->key_size) == 0)
            return &table->slots[at];
    }
}
