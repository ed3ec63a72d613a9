// Captions: a background with transmittance CAPTION_SHADE, then white weighted by the glyph's coverage, in linear light. A target
// without sRGB encoding is blended as stored: the weights are chosen so that the result is exact on black and on white, and close
// between. A fade blends the pictures with and without the caption.
#include "lib/srgb.glsl"

uniform highp sampler2D u_map_0; // the atlas
in vec2 v_texel;
flat in vec2 v_look;
layout(location = 0) out vec4 o_color;

void main() {
    float light = linear_from_srgb(vec3(CAPTION_SHADE)).r; // transmittance of the background, linear
    float shade = ENCODE_SRGB ? CAPTION_SHADE : light;
    float strength = v_look.x, added = 0.0, left = shade; // at full opacity: added light, and transmittance
    float left_before = 1.0;                              // transmittance of what was drawn before
    if (v_look.y < 0.5) {
        added = texelFetch(u_map_0, ivec2(v_texel), 0).r;
        left = shade * (1.0 - added);
        if (ENCODE_SRGB) {
            vec2 stored = srgb_from_linear(vec3(added, added + light * (1.0 - added), 0.0)).xy; // on black, on white
            added = stored.x;
            left = stored.y - stored.x;
        }
        left_before = mix(1.0, shade, strength);
    }
    o_color = vec4(vec3(strength * added), 1.0 - mix(1.0, left, strength) / left_before);
}
