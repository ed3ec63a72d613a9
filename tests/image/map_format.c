#include "image/map_format.h"

#include <string.h>

#include "shadow/moments.h"

void find_encoding(const char *name, enum gn_encoding *out) {
    if (strcmp(name, "auto") == 0) *out = GN_ENCODING_AUTO;
    for (int i = 0; i < GN_ENCODING_MASK; i++)
        if (strcmp(name, gn_encodings[i].name) == 0) *out = (enum gn_encoding)i;
}

void find_moments(const char *name, enum gn_moments *out) {
    for (int i = GN_MOMENTS_NONE + 1; i < GN_MOMENTS_COUNT; i++)
        if (strcmp(name, gn_moments[i].name) == 0) *out = (enum gn_moments)i;
}
