/* The driver's cache of compiled shaders. Mesa does not report cache hits, but it writes every
 * shader that it has to compile; and it maps the cache's index, a sparse file, so that a full disk
 * ends the process by SIGBUS. */
#ifndef GN_STAGE_DRIVER_CACHE_H
#define GN_STAGE_DRIVER_CACHE_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

struct gn_driver_cache {
    uint64_t files, bytes; /* 0: no cache */
};

/* What Mesa's cache holds now: the folders mesa_shader_cache and mesa_shader_cache_db in
 * $MESA_SHADER_CACHE_DIR, else $XDG_CACHE_HOME, else $HOME/.cache. Nothing where
 * $MESA_SHADER_CACHE_DISABLE is true. The driver writes from a thread of its own: wait for it. */
struct gn_driver_cache gn_driver_cache_read(void);

/* Before the driver starts: gives the index of Mesa's cache its blocks on the disk. Where there is
 * no room for them the cache is switched off for this process ($MESA_SHADER_CACHE_DISABLE); false,
 * and err says why. Nothing where it is off already, or where its folder cannot be written. */
bool gn_driver_cache_reserve(struct gn_err *err);

/* Whether all shaders used between two readings were in the cache: it is not empty and has not
 * grown. Any other driver than Mesa counts as cold. */
bool gn_driver_cache_warm(const struct gn_driver_cache *before,
                          const struct gn_driver_cache *after);

#endif
