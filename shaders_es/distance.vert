// Casters into a distance map: along the light's direction it is linear and made here, from a point it is not.
#include "lib/caster.vert.glsl"

#ifdef WITH_PERSPECTIVE
out vec3 v_from_light;
#else
out float v_code;
#endif

void main() {
    vec3 p = position_ws();
    place_caster(p);
#ifdef WITH_PERSPECTIVE
    v_from_light = p - u_pass[PASS_CODE].xyz;
#else
    v_code = dot(u_pass[PASS_CODE], vec4(p, 1.0));
#endif
}
