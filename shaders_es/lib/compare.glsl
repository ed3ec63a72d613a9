// Percentage-closer filtering in the shader: compares, then filters (Reeves, Salesin, Cook, "Rendering Antialiased Shadows with
// Depth Maps", 1987).

// Centre of the lower left of the four texels around uv (0..1); size: width and height of the map in texels, and their inverse.
vec2 compare_corner(vec2 uv, vec4 size) { return (floor(uv * size.xy - 0.5) + 0.5) * size.zw; }

// Bilinear visibility, 1 = lit. codes: of the texels at (0,0) (1,0) (0,1) (1,1) from compare_corner().
float compare_four(vec4 codes, float reference, vec2 uv, vec4 size) {
    vec4 lit = step(vec4(reference), codes);
    vec2 weight = fract(uv * size.xy - 0.5);
    vec2 row = mix(lit.xz, lit.yw, weight.x);
    return mix(row.x, row.y, weight.y);
}
