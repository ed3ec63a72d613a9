// Captions: a ground that lets CAPTION_SHADE of the picture through, then white as far as a glyph covers the pixel, in linear
// light. A target that does not encode is blended as it is stored: there the weights are such that it comes out the same on
// black and on white, and nearly so between.
#include "lib/pass.glsl"
#include "lib/srgb.glsl"

uniform highp sampler2D u_map_0; // the atlas
in vec2 v_texel;
flat in vec2 v_look;
layout(location = 0) out vec4 o_color;

void main() {
    float light = linear_from_srgb(vec3(CAPTION_SHADE)).r; // what the ground leaves of white
    vec2 white; // x: what is added, y: what is left of the ground under it
    if (v_look.y > 0.5) white = vec2(0.0, ENCODE_SRGB ? CAPTION_SHADE : light);
    else {
        float coverage = texelFetch(u_map_0, ivec2(v_texel), 0).r;
        white = vec2(coverage, 1.0 - coverage);
        if (ENCODE_SRGB) {
            vec2 stored = srgb_from_linear(vec3(coverage, coverage + light * (1.0 - coverage), 0.0)).xy;
            white = vec2(stored.x, (stored.y - stored.x) / CAPTION_SHADE);
        }
    }
    o_color = v_look.x * vec4(vec3(white.x), 1.0 - white.y);
}
