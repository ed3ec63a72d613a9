/* Model formats that gnomon-import converts to .glb. */
#ifndef GN_CORE_MODEL_H
#define GN_CORE_MODEL_H

#include <stdbool.h>

enum gn_model_format {
    GN_MODEL_OBJ,
    GN_MODEL_FBX,
    GN_MODEL_STL,
    GN_MODEL_PLY,
    GN_MODEL_DAE,
    GN_MODEL_FORMAT_COUNT
};

struct gn_model_row {
    const char *name;   /* as printed: "Collada" */
    const char *suffix; /* ".dae" */
};
extern const struct gn_model_row gn_model_formats[GN_MODEL_FORMAT_COUNT];

/* By the suffix of the name, ignoring case; GN_MODEL_FORMAT_COUNT: unknown. */
enum gn_model_format gn_model_format_of(const char *path);

/* By the suffix: .glb or .gltf, which gnomon reads itself. */
bool gn_model_is_gltf(const char *path);

#endif
