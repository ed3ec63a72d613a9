#include "frame/feature.h"

const struct gn_feature_row gn_features[GN_FEATURE_COUNT] = {
#define GN_X(NAME, name, printed, ...) {GN_BIT_##NAME##_TEXTURE, #NAME "_TEXTURE", printed},
    GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
#define GN_X(NAME, name, ...) {GN_BIT_##NAME##_UV1, #NAME "_UV1", #name "-uv1"},
        GN_TEXTURE_SLOTS(GN_X)
#undef GN_X
#define GN_X(NAME, name, ...) {GN_BIT_VERTEX_##NAME, "VERTEX_" #NAME, "vertex-" #name},
            GN_FEATURE_ATTRIBUTES(GN_X)
#undef GN_X
#define GN_X(NAME, printed, ...) {GN_BIT_##NAME, #NAME, printed},
                GN_FEATURES(GN_X)
#undef GN_X
};

uint64_t gn_features_all(void) {
    uint64_t all = 0;
    for (int i = 0; i < GN_FEATURE_COUNT; i++) all |= UINT64_C(1) << gn_features[i].bit;
    return all;
}
