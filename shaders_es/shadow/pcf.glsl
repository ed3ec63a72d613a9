//@ names shadow_visibility
// PCF with four bilinear taps, half a texel away along both diagonals: a 3 x 3 texel tent. With a FILTER_RADIUS other than 1.5, 1 to
// 2, they are further apart or nearer.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    vec2 a = s.at.xy - (FILTER_RADIUS - 1.0) * s.size.zw;
    vec2 b = s.at.xy + (FILTER_RADIUS - 1.0) * s.size.zw;
    float lit = map_lit_linear(map, vec3(a, s.at.z), s);
    lit += map_lit_linear(map, vec3(b.x, a.y, s.at.z), s);
    lit += map_lit_linear(map, vec3(a.x, b.y, s.at.z), s);
    lit += map_lit_linear(map, vec3(b, s.at.z), s);
    return shadow_trimmed(lit, 0.25);
}
