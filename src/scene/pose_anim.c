/* The value of an animation channel at a time: glTF 2.0, appendix C. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <string.h>

/* Spherical interpolation of quaternions of any length, along the shorter way; in doubles, since a
 * cosine of floats is 1 for all angles under 3e-4. */
static void turn(const float *from, const float *to, double share, float *out) {
    double dot = 0, from_2 = 0, to_2 = 0;
    for (int i = 0; i < 4; i++) {
        dot += (double)from[i] * (double)to[i];
        from_2 += (double)from[i] * (double)from[i];
        to_2 += (double)to[i] * (double)to[i];
    }
    const double from_scale = from_2 > 0 ? 1 / sqrt(from_2) : 1,
                 to_scale = to_2 > 0 ? 1 / sqrt(to_2) : 1;
    const double cosine = fmin(fabs(dot) * from_scale * to_scale, 1), angle = acos(cosine);
    const double sine = sin(angle), side = dot < 0 ? -1 : 1;
    const double of_from = sine > 1e-6 ? sin((1 - share) * angle) / sine : 1 - share,
                 of_to = sine > 1e-6 ? sin(share * angle) / sine : share;
    for (int i = 0; i < 4; i++)
        out[i] = (float)(of_from * from_scale * (double)from[i] +
                         side * of_to * to_scale * (double)to[i]);
}

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
        if (!cubic && rotates) turn(a, b, (time_s - start_s) / dt_s, out);
    }
    if (rotates) glm_quat_normalize(out);
}

/* Records overlap nowhere, so a channel of another thing, whose node is 0, has not that of node 0.
 */
bool gn_channel_hides(const struct gn_scene *scene, const struct gn_channel *channel) {
    return channel->path == GN_ANIM_RECORD &&
           scene->nodes[channel->node].record == channel->record + 1;
}
