// Rectangle of a caption, in whole pixels, in front of the picture.
#include "lib/pass.glsl"
#include "lib/vertex.glsl"

out vec2 v_texel;      // position in the atlas, texels
flat out vec2 v_look;  // x: opacity of the caption, 0..1; y: 1 background, 0 glyph

void main() {
    int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2; // two triangles: 0 1 2, 1 2 3
    vec2 inside = vec2(corner % 2, corner / 2) * a_base_color.zw, turn = u_pass[CAPTION_PX].zw;
    vec2 at = (a_base_color.xy + inside) * u_pass[CAPTION_PX].xy - 1.0;
    at.y = -at.y; // row 0 is the top
    v_texel = a_surface.xy + inside;
    v_look = a_surface.zw;
    gl_Position = vec4(turn.x * at.x + turn.y * at.y, turn.x * at.y - turn.y * at.x, -1.0, 1.0);
}
