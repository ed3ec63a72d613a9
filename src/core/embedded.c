#include "core/embedded.h"

#include <string.h>

const struct gn_embedded *gn_embedded_find(const char *name) {
    for (const struct gn_embedded *e = gn_embedded_table; e->name; e++)
        if (strcmp(e->name, name) == 0) return e;
    return NULL;
}
