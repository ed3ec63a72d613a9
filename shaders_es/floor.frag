// Black, over what is behind an unseen floor. The alpha, and its weight, are made by filter/floor.frag.
uniform mediump sampler2D u_map_0;
in vec2 v_uv;
layout(location = 0) out mediump vec4 o_color;

void main() {
    mediump vec2 taken = texture(u_map_0, v_uv).rg;
    o_color = vec4(0.0, 0.0, 0.0, taken.x / taken.y);
}
