// Panel of a shadow map: near is dark, far is white, in a thin frame of the light's colour. The grey is already sRGB-encoded, as
// `--aov map` writes it. map_code() comes from the file of the map's encoding (lib/map_*.glsl).
#include "lib/pass.glsl"
#include "lib/srgb.glsl"

uniform MAP_SAMPLER u_map_0;
in vec2 v_uv;
layout(location = 0) out vec4 o_color;

void main() {
    vec4 grey = u_pass[PANEL_GREY], frame = u_pass[PANEL_FRAME];
    float code = map_code(u_map_0, v_uv);
    float seen = pow(clamp(code * grey.x + grey.y, 0.0, 1.0), grey.z);
    vec2 inside = min(v_uv, 1.0 - v_uv) * u_pass[PANEL_PX].xy;
    float depth = min(inside.x, inside.y);
    bool on_frame = depth < frame.w;
    if (depth < frame.w + 1.0) seen = 0.0; // a dark line separates a white frame from a white map
    if (ENCODE_SRGB) o_color = vec4(on_frame ? srgb_from_linear(frame.rgb) : vec3(seen), 1.0);
    else o_color = vec4(on_frame ? frame.rgb : linear_from_srgb(vec3(seen)), 1.0);
}
