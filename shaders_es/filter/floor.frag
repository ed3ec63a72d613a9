// What an unseen floor takes from the picture behind it: the share of its light that shadows and occlusion take. A texel of the
// mask, whose points of the lamp have hard edges, is the mean of three by three. Drawn over what is there by a weight, with
// GN_BLEND_ALPHA. map_code(): lib/map_mean.glsl.
//
// x is y times that share, and y is 1. Under a foot y is next to nothing, and the code is 0 (half a code is left where all points
// are hidden): what is read beside a foot, from mipmaps too, is the floor's outside.
#include "lib/pass.glsl"

uniform MAP_SAMPLER u_map_0;
#ifdef WITH_OCCLUSION_TEXTURE
uniform sampler2D u_texture_occlusion;
#endif
layout(location = 0) out MOMENTS_OUT o_moments;

// A step of a bright floor in 8 bits takes half of this share of its light: noise of that width hides it, in the picture's size and
// in mipmaps that halve it.
const float LEVEL = 0.025;
const float FOOT_CODE = 0.25, FOOT = 4.0 / 255.0;

void main() {
    vec2 texel = u_pass[FILTER_SIZE].zw, uv = gl_FragCoord.xy * texel;
    float code = 0.0, weight = 1e-6;
    for (int i = 0; i < 9; i++) {
        vec2 by = vec2(i % 3 - 1, i / 3 - 1);
        float one = map_code(u_map_0, uv + by * texel), counts = (2.0 - abs(by.x)) * (2.0 - abs(by.y)) * step(FOOT_CODE, one);
        code += counts * one;
        weight += counts;
    }
    vec4 to_x = u_pass[FILTER_FLOOR_X], to_z = u_pass[FILTER_FLOOR_Z];
    float hidden = clamp(1.0 - (code / weight * to_x.w + to_z.w), 0.0, 1.0);
    vec2 at = vec2(dot(to_x.xyz, vec3(uv, 1.0)), dot(to_z.xyz, vec3(uv, 1.0)));
    float closed = 0.0;
#ifdef WITH_OCCLUSION_TEXTURE
    closed = 1.0 - texture(u_texture_occlusion, at / FLOOR_OCCLUDED + 0.5).r;
#endif
    vec3 light = u_pass[FILTER_FLOOR].xyz;
    float taken = (light.x * closed + light.y * hidden) * clamp(2.0 - 2.0 * length(at), 0.0, 1.0); // none at the rim
    float noise = fract(sin(dot(floor(gl_FragCoord.xy), vec2(12.9898, 78.233))) * 43758.5453) - 0.5;
    taken += noise * min(LEVEL, taken);
    float seen = weight < 1.0 ? FOOT : 1.0;
    o_moments = vec4(vec2(taken, 1.0) * seen * light.z, 0.0, light.z);
}
