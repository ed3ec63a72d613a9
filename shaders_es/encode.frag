// The last pass: makes a picture of bytes of the linear one. Encodes it as sRGB for GPUs without sRGB render targets, and maps the
// tone of pictures that lights were added to, since a sum cannot be mapped part by part. Such a picture is drawn over nothing, and
// its alpha is what covers the background, which has no tone. A transparent picture keeps its alpha and gets straight colours: those
// before they were multiplied by it, so that their tone and their code are those of the surface.
#include "lib/pass.glsl"
#include "lib/srgb.glsl"
#include "lib/tone.glsl"

uniform highp sampler2D u_map_0;
layout(location = 0) out vec4 o_color;

void main() {
    vec4 drawn = texelFetch(u_map_0, ivec2(gl_FragCoord.xy), 0);
    vec3 color = drawn.rgb;
#ifdef WITH_TRANSMISSION
    drawn.a = max(drawn.a, min(max(max(color.r, color.g), color.b), 1.0)); // bright reflections on glass: no straight colour is over 1
#endif
#if defined(WITH_TONE) || defined(WITH_TRANSPARENT)
    color = min(color / max(drawn.a, 0.0001), 60000.0); // infinite half floats
#endif
#ifdef WITH_TONE
    color = tone_mapped(color);
    if (!TRANSPARENT) color = mix(u_pass[ENCODE_BACKGROUND].rgb, color, drawn.a);
#endif
    if (ENCODE_SRGB) color = srgb_from_linear(color);
    o_color = vec4(color, TRANSPARENT ? drawn.a : 1.0);
}
