// Percentage-closer filtering by hand, for maps that no sampler compares: compare first, then weigh (Reeves, Salesin, Cook,
// "Rendering Antialiased Shadows with Depth Maps", 1987).

// Centre of the lower left one of the four texels round uv (0..1); size.y, size.z: side of the map and its inverse.
vec2 compare_corner(vec2 uv, vec4 size) { return (floor(uv * size.y - 0.5) + 0.5) * size.z; }

// codes: of the texels at (0,0) (1,0) (0,1) (1,1) from that corner. 1 = all lit.
float compare_four(vec4 codes, vec3 at, vec4 size) {
    vec4 lit = step(vec4(min(at.z, size.w)), codes);
    vec2 weight = fract(at.xy * size.y - 0.5);
    vec2 row = mix(lit.xz, lit.yw, weight.x);
    return mix(row.x, row.y, weight.y);
}
