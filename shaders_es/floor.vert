// The part of an unseen floor that has shadows: a rectangle of its plane.
#include "lib/pass.glsl"

out vec2 v_uv;

void main() {
    int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2; // two triangles: 0 1 2, 1 2 3
    vec4 shown = u_pass[FLOOR_SHOWN];
    v_uv = vec2(corner % 2 == 0 ? shown.x : shown.z, corner / 2 == 0 ? shown.y : shown.w);
    gl_Position = u_pass[FLOOR_PLACE] + u_pass[FLOOR_PLACE + 1] * v_uv.x + u_pass[FLOOR_PLACE + 2] * v_uv.y;
}
