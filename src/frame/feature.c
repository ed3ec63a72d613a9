#include "frame/feature.h"

const struct gn_feature_row gn_features[GN_FEATURE_COUNT] = {
#define GN_X(NAME, name, printed, ...) {#NAME "_TEXTURE", printed},
    GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
#define GN_X(NAME, name, ...) {#NAME "_UV1", #name "-uv1"},
        GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
#define GN_X(NAME, name, ...) {"VERTEX_" #NAME, "vertex-" #name},
            GN_FEATURE_ATTRIBUTES(GN_X)
#undef GN_X
#define GN_X(NAME, printed, ...) {#NAME, printed},
                GN_FEATURES(GN_X)
#undef GN_X
};
