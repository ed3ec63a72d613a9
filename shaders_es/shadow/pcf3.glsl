//@ names shadow_visibility
// PCF, [1 2 1] x [1 2 1] taps of 2 x 2 texels, in four fetches instead of nine. Along one axis, with the point a fraction f past
// a texel's centre, the taps at -1, 0, 1 give the texels -1..2 the weights 1-f, 2-f, 1+f, f; a linear fetch between two texels
// returns their weighted sum: the left pair has weight 3-2f and is at (2-f)/(3-2f) past texel -1, the right pair has 1+2f at
// f/(1+2f) past 1.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    vec2 p = s.at.xy * s.size.xy - 0.5;
    vec2 base = floor(p);
    vec2 f = p - base;
    vec2 weight_a = 3.0 - 2.0 * f;
    vec2 weight_b = 1.0 + 2.0 * f;
    vec2 a = (base - 0.5 + (2.0 - f) / weight_a) * s.size.zw;
    vec2 b = (base + 1.5 + f / weight_b) * s.size.zw;
    float below = weight_a.x * map_lit_linear(map, vec3(a, s.at.z), s) +
                  weight_b.x * map_lit_linear(map, vec3(b.x, a.y, s.at.z), s);
    float above = weight_a.x * map_lit_linear(map, vec3(a.x, b.y, s.at.z), s) +
                  weight_b.x * map_lit_linear(map, vec3(b, s.at.z), s);
    return shadow_trimmed(weight_a.y * below + weight_b.y * above, 1.0 / 16.0);
}
