/* Buffers of another GPU imported into the card as GEM handles. */
#ifndef GN_DISPLAY_KMS_IMPORT_H
#define GN_DISPLAY_KMS_IMPORT_H

#include <stdbool.h>
#include <stdint.h>

enum { GN_IMPORTS_MAX = 8 }; /* more buffers than any surface has */

struct gn_import {
    const void *key; /* NULL: unused entry */
    int count;
    uint32_t handles[4]; /* one per plane; closed by gn_import_drop() */
};
struct gn_imports {
    int card; /* borrowed descriptor */
    struct gn_import all[GN_IMPORTS_MAX];
};

/* Returns the handles of the buffer with this key, importing its planes' DMA-BUFs if new; `export`
 * opens them and this closes them. NULL and errno on failure. */
const struct gn_import *gn_import_get(struct gn_imports *imports, void *key, int plane_count,
                                      int (*export)(void *context, void *key, int plane),
                                      void *context);
/* Closes all handles. */
void gn_import_drop(struct gn_imports *imports);

#endif
