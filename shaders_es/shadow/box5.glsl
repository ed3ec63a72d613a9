//@ names shadow_visibility
// PCF with equal weights: the mean of 5 x 5 taps of 2 x 2 texels, a box five texels wide, in nine fetches instead of 25. Along one
// axis the texels -2..3 have the weights 1-f, 1, 1, 1, 1, f; each pair is one linear fetch (as in pcf3.glsl), of weight 2-f, 2 and
// 1+f.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    vec2 p = s.at.xy * s.size.xy - 0.5;
    vec2 base = floor(p);
    vec2 f = p - base;
    vec2 weight_a = 2.0 - f;
    vec2 weight_c = 1.0 + f;
    vec2 a = (base - 1.5 + 1.0 / weight_a) * s.size.zw;
    vec2 b = (base + 1.0) * s.size.zw;
    vec2 c = (base + 2.5 + f / weight_c) * s.size.zw;
    float lit = weight_a.y * (weight_a.x * map_lit_linear(map, vec3(a, s.at.z), s) +
                              2.0 * map_lit_linear(map, vec3(b.x, a.y, s.at.z), s) +
                              weight_c.x * map_lit_linear(map, vec3(c.x, a.y, s.at.z), s));
    lit += 2.0 * (weight_a.x * map_lit_linear(map, vec3(a.x, b.y, s.at.z), s) +
                  2.0 * map_lit_linear(map, vec3(b, s.at.z), s) +
                  weight_c.x * map_lit_linear(map, vec3(c.x, b.y, s.at.z), s));
    lit += weight_c.y * (weight_a.x * map_lit_linear(map, vec3(a.x, c.y, s.at.z), s) +
                         2.0 * map_lit_linear(map, vec3(b.x, c.y, s.at.z), s) +
                         weight_c.x * map_lit_linear(map, vec3(c, s.at.z), s));
    return shadow_trimmed(lit, 1.0 / 25.0);
}
