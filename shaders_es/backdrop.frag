// The environment (src/environment/) as the background.
#include "lib/pass.glsl"
#include "lib/srgb.glsl"
#include "lib/tone.glsl"

uniform mediump samplerCube u_environment;
in vec3 v_ray;
layout(location = 0) out vec4 o_color;

void main() {
    vec4 light = u_pass[BACKDROP_LIGHT];
    vec3 color = textureLod(u_environment, v_ray, light.y).rgb * light.x;
#ifdef WITH_TONE
    color = tone_mapped(color);
#endif
    if (ENCODE_SRGB) color = srgb_from_linear(color);
    o_color = vec4(color, 1.0);
}
