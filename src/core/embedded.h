/* Files that travel inside the program, so that it works when copied alone. Shaders are named by
 * their path below shaders_es ("lib/light.glsl"), the default scene "sundial.glb". The bytes live
 * as long as the process; one zero byte follows the last, so text may be used as a string. */
#ifndef GN_CORE_EMBEDDED_H
#define GN_CORE_EMBEDDED_H

#include <stddef.h>

struct gn_embedded {
    const char *name;
    const unsigned char *data;
    size_t size; /* without the zero byte */
};

/* All of them, sorted by nothing in particular, ended by a row whose name is NULL. Made by the
 * build. */
extern const struct gn_embedded gn_embedded_table[];

/* NULL if there is none of that name. */
const struct gn_embedded *gn_embedded_find(const char *name);

#endif
