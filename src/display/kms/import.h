/* Buffers of a GPU that is not the card's own: a card shows what it has a handle of. */
#ifndef GN_DISPLAY_KMS_IMPORT_H
#define GN_DISPLAY_KMS_IMPORT_H

#include <stdbool.h>
#include <stdint.h>

enum { GN_IMPORTS_MAX = 8 }; /* more buffers than any surface has */

struct gn_import {
    const void *key; /* NULL: an empty place */
    int count;
    uint32_t handles[4]; /* of its planes, ours to close */
};
struct gn_imports {
    int card; /* an open descriptor, the caller's */
    struct gn_import all[GN_IMPORTS_MAX];
};

/* The handles of a buffer, which is told by its key: found, or made of its planes' DMA-BUFs, which
 * `export` opens and this closes. NULL and errno on failure. */
const struct gn_import *gn_import_get(struct gn_imports *imports, void *key, int plane_count,
                                      int (*export)(void *context, void *key, int plane),
                                      void *context);
/* All buffers are gone. */
void gn_import_drop(struct gn_imports *imports);

#endif
