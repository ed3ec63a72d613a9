#include "core/model.h"

#include <string.h>
#include <strings.h>

const struct gn_model_row gn_model_formats[GN_MODEL_FORMAT_COUNT] = {
    [GN_MODEL_OBJ] = {"OBJ", ".obj"},     [GN_MODEL_FBX] = {"FBX", ".fbx"},
    [GN_MODEL_STL] = {"STL", ".stl"},     [GN_MODEL_PLY] = {"PLY", ".ply"},
    [GN_MODEL_DAE] = {"Collada", ".dae"},
};

enum gn_model_format gn_model_format_of(const char *path) {
    const char *dot = strrchr(path, '.');
    int i = 0;
    while (i < GN_MODEL_FORMAT_COUNT && (!dot || strcasecmp(dot, gn_model_formats[i].suffix) != 0))
        i++;
    return (enum gn_model_format)i;
}

bool gn_model_is_gltf(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".glb") == 0 || strcasecmp(dot, ".gltf") == 0);
}
