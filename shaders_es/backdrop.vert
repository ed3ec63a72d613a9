// One triangle that covers the picture, at the far end of depth.
#include "lib/pass.glsl"

out vec3 v_ray;

void main() {
    vec2 ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_ray = u_pass[BACKDROP_RAYS].xyz + u_pass[BACKDROP_RAYS + 1].xyz * ndc.x + u_pass[BACKDROP_RAYS + 2].xyz * ndc.y;
    gl_Position = vec4(ndc, 1.0, 1.0);
}
