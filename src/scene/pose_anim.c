/* The value of an animation channel at a time: glTF 2.0, appendix C. */
#include "scene/private.h"

#include <string.h>

void gn_channel_sample(const struct gn_channel *channel, double time_s, float *out) {
    const int n = (int)channel->components;
    const bool rotates = channel->path == GN_ANIM_ROTATION;
    bool cubic = channel->interpolation == GN_ANIM_CUBIC;
    size_t stride = (size_t)n * (cubic ? 3 : 1);
    uint32_t k = 0; /* the last key at or before time_s, or the first */
    for (uint32_t end = channel->key_count; end - k > 1;) {
        uint32_t middle = k + (end - k) / 2;
        if ((double)channel->times_s[middle] <= time_s)
            k = middle;
        else
            end = middle;
    }
    const float *key = channel->values + k * stride;
    double start_s = (double)channel->times_s[k];
    if (k + 1 == channel->key_count || time_s <= start_s || channel->interpolation == GN_ANIM_STEP)
        memcpy(out, key + (cubic ? n : 0), (size_t)n * sizeof *out);
    else {
        double dt_s = (double)channel->times_s[k + 1] - start_s; /* not 0: time_s lies between */
        float u = (float)((time_s - start_s) / dt_s), u2 = u * u, u3 = u2 * u, dt = (float)dt_s;
        const float *a = key, *b = key + stride;
        /* whole keys of a cubic: in-tangent, value, out-tangent */
        for (int i = 0; cubic && i < n; i++)
            out[i] = (2 * u3 - 3 * u2 + 1) * a[n + i] + dt * (u3 - 2 * u2 + u) * a[2 * n + i] +
                     (3 * u2 - 2 * u3) * b[n + i] + dt * (u3 - u2) * b[i];
        for (int i = 0; !cubic && !rotates && i < n; i++) out[i] = a[i] + (b[i] - a[i]) * u;
        if (!cubic && rotates) {
            versor from, to;
            memcpy(from, a, sizeof from);
            memcpy(to, b, sizeof to);
            glm_quat_normalize(from);
            glm_quat_normalize(to);
            glm_quat_slerp(from, to, u, out);
        }
    }
    if (rotates) glm_quat_normalize(out);
}
