// Captions: a ground that lets CAPTION_SHADE of the picture through, then white as far as a glyph covers the pixel, in linear
// light. A target that does not encode is blended as it is stored: there the weights are such that it comes out the same on
// black and on white, and nearly so between. A fade is a mixture of the picture with that and without.
#include "lib/srgb.glsl"

uniform highp sampler2D u_map_0; // the atlas
in vec2 v_texel;
flat in vec2 v_look;
layout(location = 0) out vec4 o_color;

void main() {
    float light = linear_from_srgb(vec3(CAPTION_SHADE)).r; // what the ground leaves of white
    float shade = ENCODE_SRGB ? CAPTION_SHADE : light;
    float strength = v_look.x, added = 0.0, left = shade; // in full: what is added, what is left of the picture
    float left_before = 1.0;                              // of the picture, when this is drawn
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
