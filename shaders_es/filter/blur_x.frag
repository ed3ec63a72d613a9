// Box blur, 1 of 2: converts codes to moments and averages them along a row, within the tile. The ends of the box may cut texels.
// Codes are clamped to the range of the moments, since exponential moments would overflow. map_code() comes from lib/map_*.glsl of
// the light's encoding, moments_of() from moments/ of its technique, moments_store() from lib/moments_*.glsl.
#include "lib/pass.glsl"

uniform MAP_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_moments;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), ends = ivec2(u_pass[FILTER_RECT].xz);
    vec4 blur = u_pass[FILTER_BLUR];
    vec2 texel = u_pass[FILTER_SIZE].zw;
    vec2 code = u_pass[FILTER_CODE].xy;
    int most = int(blur.y);
    MOMENTS sum = MOMENTS(0.0);
    for (int i = -most; i <= most; i++) {
        vec2 from = vec2(clamp(at.x + i, ends.x, ends.y), at.y) + 0.5;
        sum += moments_of(clamp(code.y + code.x * map_code(u_map_0, from * texel), 0.0, 1.0)) * min(blur.x + 0.5 - abs(float(i)), 1.0);
    }
    o_moments = moments_store(sum * blur.z);
}
