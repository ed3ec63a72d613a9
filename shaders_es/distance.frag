// The distance from the light in the code of the map's encoding, whose file defines MAP_OUT and map_encode(). A directional
// light's is linear in depth.
#include "lib/pass.glsl"
#include "lib/caster.frag.glsl"

#ifdef WITH_PERSPECTIVE
in vec3 v_from_light;
#endif
layout(location = 0) out MAP_OUT o_code;

void main() {
    cut_holes();
#ifdef WITH_PERSPECTIVE
    float distance = length(v_from_light);
#else
    float distance = gl_FragCoord.z;
#endif
    o_code = map_encode(distance * u_pass[PASS_CODE].w + u_pass[PASS_CODE_ADD].x);
}
