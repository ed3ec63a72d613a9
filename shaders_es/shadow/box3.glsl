//@ names shadow_visibility
// PCF with equal weights: the mean of 3 x 3 taps of 2 x 2 texels, a box three texels wide, in four fetches. Along one axis, with the
// point a fraction f past a texel's centre, the texels -1..2 have the weights 1-f, 1, 1, f; each pair is one linear fetch (as in
// pcf3.glsl), of weight 2-f and 1+f.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    vec2 p = s.at.xy * s.size.xy - 0.5;
    vec2 base = floor(p);
    vec2 f = p - base;
    vec2 weight_a = 2.0 - f;
    vec2 weight_b = 1.0 + f;
    vec2 a = (base - 0.5 + 1.0 / weight_a) * s.size.zw;
    vec2 b = (base + 1.5 + f / weight_b) * s.size.zw;
    float below = weight_a.x * map_lit_linear(map, vec3(a, s.at.z), s) +
                  weight_b.x * map_lit_linear(map, vec3(b.x, a.y, s.at.z), s);
    float above = weight_a.x * map_lit_linear(map, vec3(a.x, b.y, s.at.z), s) +
                  weight_b.x * map_lit_linear(map, vec3(b, s.at.z), s);
    return shadow_trimmed(weight_a.y * below + weight_b.y * above, 1.0 / 9.0);
}
