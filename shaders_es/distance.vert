// Draws casters into a distance map.
#include "lib/caster.vert.glsl"

#ifdef WITH_PERSPECTIVE
out vec3 v_from_light;
#endif

void main() {
    vec3 p = position_ws();
    place_caster(p);
#ifdef WITH_PERSPECTIVE
    v_from_light = p - u_pass[PASS_CODE].xyz;
#endif
}
