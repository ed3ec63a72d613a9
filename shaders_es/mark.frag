// Light gizmo: the light's colour with a dark outline, to be visible on any background.
#include "lib/srgb.glsl"

flat in vec4 v_hue;
flat in float v_half;
in vec3 v_local;
flat in float v_fades;
flat in float v_disc;
layout(location = 0) out vec4 o_color;

void main() {
    float away = v_disc > 0.5 ? length(v_local.xy) : abs(v_local.x);
    float inner = clamp(v_half + 0.5 - away, 0.0, 1.0);
    float outer = clamp(v_half + MARK_HALO - away, 0.0, 1.0);
    vec3 color = ENCODE_SRGB ? srgb_from_linear(v_hue.rgb) : v_hue.rgb;
    float strength = v_hue.a * (1.0 - v_fades * v_local.z);
    o_color = strength * vec4(color * inner, mix(0.6 * outer, 1.0, inner));
}
