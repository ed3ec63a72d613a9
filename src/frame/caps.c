#include "frame/caps.h"

const char *const gn_cap_names[GN_CAP_COUNT] = {
    [GN_CAP_DEPTH_COMPARE] = "depth-compare",
    [GN_CAP_R32UI] = "r32ui",
    [GN_CAP_R16F] = "r16f",
    [GN_CAP_RGBA16F] = "rgba16f",
    [GN_CAP_SRGB] = "srgb",
    [GN_CAP_MSAA4] = "msaa4",
    [GN_CAP_TIMER] = "timer",
    [GN_CAP_DEBUG] = "debug",
};

uint32_t gn_caps_encodings(const struct gn_caps *caps) {
    uint32_t proved = 1u << GN_ENCODING_RGBA8; /* RGBA8 is what every picture is drawn to */
    if (caps->has & 1u << GN_CAP_DEPTH_COMPARE) proved |= 1u << GN_ENCODING_DEPTH;
    if (caps->has & 1u << GN_CAP_R32UI) proved |= 1u << GN_ENCODING_R32UI;
    if (caps->has & 1u << GN_CAP_R16F)
        proved |= 1u << GN_ENCODING_R16F | 1u << GN_ENCODING_R16F_RAW;
    return proved;
}
