// Planar shadows in the stencil: PASS_CLIP projects casters onto the plane, then into the camera's clip space. The stencil is
// written whatever the depth.
#include "lib/caster.vert.glsl"

centroid out float v_height; // above the plane, metres

void main() {
    vec3 p = position_ws();
    place_caster(p);
    gl_Position.z = 0.0;
    v_height = dot(u_pass[FLAT_PLANE], vec4(p, 1.0));
}
