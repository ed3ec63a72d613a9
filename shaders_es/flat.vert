// Casters as they fall on the plane, as the eye sees them: PASS_CLIP leads there. Where they fall is marked whatever its depth.
#include "lib/caster.vert.glsl"

centroid out float v_height; // over the plane, metres

void main() {
    vec3 p = position_ws();
    place_caster(p);
    gl_Position.z = 0.0;
    v_height = dot(u_pass[FLAT_PLANE], vec4(p, 1.0));
}
