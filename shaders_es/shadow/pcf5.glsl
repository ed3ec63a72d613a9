//@ names shadow_visibility
// PCF, [1 3 4 3 1] squared taps of 2 x 2 texels, in nine fetches instead of 25. Along one axis the texels -2..3 have the weights
// 1-f, 3-2f, 4-f, 3+f, 1+2f, f; each pair is one linear fetch (as in pcf3.glsl), of weight 4-3f, 7 and 1+3f.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    vec2 p = s.at.xy * s.size.xy - 0.5;
    vec2 base = floor(p);
    vec2 f = p - base;
    vec2 weight_a = 4.0 - 3.0 * f;
    vec2 weight_c = 1.0 + 3.0 * f;
    vec2 a = (base - 1.5 + (3.0 - 2.0 * f) / weight_a) * s.size.zw;
    vec2 b = (base + 0.5 + (3.0 + f) / 7.0) * s.size.zw;
    vec2 c = (base + 2.5 + f / weight_c) * s.size.zw;
    float lit = weight_a.y * (weight_a.x * map_lit_linear(map, vec3(a, s.at.z), s) +
                              7.0 * map_lit_linear(map, vec3(b.x, a.y, s.at.z), s) +
                              weight_c.x * map_lit_linear(map, vec3(c.x, a.y, s.at.z), s));
    lit += 7.0 * (weight_a.x * map_lit_linear(map, vec3(a.x, b.y, s.at.z), s) +
                  7.0 * map_lit_linear(map, vec3(b, s.at.z), s) +
                  weight_c.x * map_lit_linear(map, vec3(c.x, b.y, s.at.z), s));
    lit += weight_c.y * (weight_a.x * map_lit_linear(map, vec3(a.x, c.y, s.at.z), s) +
                         7.0 * map_lit_linear(map, vec3(b.x, c.y, s.at.z), s) +
                         weight_c.x * map_lit_linear(map, vec3(c, s.at.z), s));
    return shadow_trimmed(lit, 1.0 / 144.0);
}
