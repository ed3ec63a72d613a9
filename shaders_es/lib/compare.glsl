// Percentage-closer filtering by hand: compare first, then weigh (Reeves, Salesin, Cook, "Rendering Antialiased Shadows with Depth
// Maps", 1987).

// Centre of the lower left one of the four texels round uv (0..1); size: width and height of the map, and their inverse.
vec2 compare_corner(vec2 uv, vec4 size) { return (floor(uv * size.xy - 0.5) + 0.5) * size.zw; }

// codes: of the texels at (0,0) (1,0) (0,1) (1,1) from that corner. 1 = all lit.
float compare_four(vec4 codes, float reference, vec2 uv, vec4 size) {
    vec4 lit = step(vec4(reference), codes);
    vec2 weight = fract(uv * size.xy - 0.5);
    vec2 row = mix(lit.xz, lit.yw, weight.x);
    return mix(row.x, row.y, weight.y);
}
