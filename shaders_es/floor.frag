// Black, over what is behind an unseen floor. The alpha is made by filter/floor.frag.
uniform mediump sampler2D u_map_0;
in vec2 v_uv;
layout(location = 0) out mediump vec4 o_color;

void main() { o_color = vec4(0.0, 0.0, 0.0, texture(u_map_0, v_uv).r); }
