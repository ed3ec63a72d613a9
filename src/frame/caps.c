#include "frame/caps.h"

#include <string.h>

#include "core/text.h"

const char *const gn_cap_names[GN_CAP_COUNT] = {
    [GN_CAP_DEPTH_COMPARE] = "depth-compare",
    [GN_CAP_R32UI] = "r32ui",
    [GN_CAP_R16F] = "r16f",
    [GN_CAP_RGBA16F] = "rgba16f",
    [GN_CAP_SRGB] = "srgb",
    [GN_CAP_MSAA4] = "msaa4",
    [GN_CAP_RGBA16UI] = "rgba16ui",
    [GN_CAP_RG32UI] = "rg32ui",
    [GN_CAP_RGBA32UI] = "rgba32ui",
    [GN_CAP_RG16F] = "rg16f",
    [GN_CAP_TIMER] = "timer",
    [GN_CAP_DEBUG] = "debug",
};

uint32_t gn_caps_encodings(const struct gn_caps *caps) {
    uint32_t proved = 1u << GN_ENCODING_RGBA8; /* every GPU renders to RGBA8 */
    if (caps->has & 1u << GN_CAP_DEPTH_COMPARE)
        proved |= 1u << GN_ENCODING_DEPTH | 1u << GN_ENCODING_DEPTH16;
    if (caps->has & 1u << GN_CAP_R32UI) proved |= 1u << GN_ENCODING_R32UI;
    if (caps->has & 1u << GN_CAP_R16F)
        proved |= 1u << GN_ENCODING_R16F | 1u << GN_ENCODING_R16F_RAW;
    return proved;
}

enum gn_cap gn_cap_of_moments(enum gn_moments moments) {
    static const enum gn_cap caps[GN_MOMENTS_COUNT] = {
        [GN_MOMENTS_NONE] = GN_CAP_COUNT,
        [GN_MOMENTS_RG32UI] = GN_CAP_RG32UI,
        [GN_MOMENTS_RGBA16UI] = GN_CAP_RGBA16UI,
        [GN_MOMENTS_RGBA16F] = GN_CAP_RGBA16F,
        [GN_MOMENTS_RGBA16F_MIPS] = GN_CAP_RGBA16F,
        [GN_MOMENTS_RGBA32F_BITS] = GN_CAP_RGBA32UI,
        [GN_MOMENTS_RGBA32F_SHARE] = GN_CAP_RGBA32UI,
        [GN_MOMENTS_TABLE_RGBA32UI] = GN_CAP_RGBA32UI,
        [GN_MOMENTS_CONE_RG16F] = GN_CAP_RG16F,
        [GN_MOMENTS_CONE_BITS] = GN_CAP_R32UI,
        [GN_MOMENTS_CONE_BYTES] = GN_CAP_COUNT,
    };
    return caps[moments];
}

uint32_t gn_caps_moments(const struct gn_caps *caps) {
    uint32_t proved = 0;
    for (int i = GN_MOMENTS_NONE + 1; i < GN_MOMENTS_COUNT; i++) {
        const enum gn_cap cap = gn_cap_of_moments((enum gn_moments)i);
        if (cap == GN_CAP_COUNT || caps->has >> cap & 1) proved |= 1u << i;
    }
    return proved;
}

bool gn_caps_parse(const char *list, uint32_t *out, struct gn_err *err) {
    *out = 0;
    while (list && *list) {
        size_t length = strcspn(list, ",");
        int cap = 0;
        while (cap < GN_CAP_COUNT && (strlen(gn_cap_names[cap]) != length ||
                                      memcmp(gn_cap_names[cap], list, length) != 0))
            cap++;
        if (cap == GN_CAP_COUNT) {
            char names[200] = "";
            for (int i = 0; i < GN_CAP_COUNT; i++)
                gn_text_add(names, sizeof names, "%s%s", i ? ", " : "", gn_cap_names[i]);
            return gn_fail_usage(err, "unknown capability \"%.*s\"; expected %s",
                                 (int)(length < 80 ? length : 80), list, names);
        }
        *out |= 1u << cap;
        list += length + (list[length] == ',');
    }
    return true;
}
