// Writes the encoded distance from the light. The file of the encoding (lib/map_*.glsl) defines MAP_OUT and map_encode(). For a
// directional light the distance is the depth, which is linear.
#include "lib/pass.glsl"
#include "lib/caster.frag.glsl"

#ifdef WITH_PERSPECTIVE
in vec3 v_from_light;
#endif
#ifdef WITH_MIDDLE
#include "lib/middle.glsl"
uniform MAP_SAMPLER u_map_0;
#endif
layout(location = 0) out MAP_OUT o_code;

void main() {
    cut_holes();
#ifdef WITH_PERSPECTIVE
    float distance = length(v_from_light);
#else
    float distance = gl_FragCoord.z;
#endif
    float code = distance * u_pass[PASS_CODE].w + u_pass[PASS_CODE_ADD].x;
#ifdef WITH_MIDDLE
    code = middle_code(code, map_code(u_map_0, gl_FragCoord.xy / vec2(textureSize(u_map_0, 0))));
#endif
    o_code = map_encode(code);
}
