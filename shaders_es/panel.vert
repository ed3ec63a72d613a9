// Panel: a rectangle in front of the picture.
#include "lib/pass.glsl"

out vec2 v_uv;

void main() {
    int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2; // two triangles: 0 1 2, 1 2 3
    v_uv = vec2(corner % 2, corner / 2);
    vec2 at = mix(u_pass[PANEL_RECT].xy, u_pass[PANEL_RECT].zw, v_uv), turn = u_pass[PANEL_PX].zw;
    gl_Position = vec4(turn.x * at.x + turn.y * at.y, turn.x * at.y - turn.y * at.x, -1.0, 1.0);
}
