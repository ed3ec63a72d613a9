/* Files in a folder for caches, named by the content that they were made of: what takes long to
 * make is made once. */
#ifndef GN_STAGE_KEPT_H
#define GN_STAGE_KEPT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/file.h"

enum { GN_KEPT_PATH = 4096 };

struct gn_kept_kind {
    const char *prefix, *suffix; /* of the names */
    int files_max;               /* of the kind; the oldest goes */
    size_t bytes_max;            /* of the data of a file; more is not kept */
};

/* Where what is made of a content is kept, of hash and size, both part of the name: in
 * $CACHE_DIRECTORY, else gnomon in $XDG_CACHE_HOME or in .cache of $HOME. False: nowhere. */
bool gn_kept_path(const struct gn_kept_kind *kind, uint64_t hash, size_t size,
                  char out[GN_KEPT_PATH]);
/* Makes the folder where it is missing. Fails silently: what cannot be kept is made again. The file
 * has a hash behind the data. */
void gn_kept_write(const struct gn_kept_kind *kind, const char *path, const void *data,
                   size_t size);
/* False: there is none, or it is damaged. */
bool gn_kept_read(const struct gn_kept_kind *kind, const char *path, struct gn_bytes *out);

#endif
