// Directional lights with cascades: the map is an atlas of 2 x 2 tiles, each for a range of view depth. All cascades use one
// depth encoding (moments excepted) but different texel sizes.

#define CASCADE(slot, i) u_pass[PASS_CASCADES + (slot)*CASCADES_SIZE + (i)]

struct shadow_cascade {
    vec2 axis;      // axis of the light, texels from the centre of the tile
    float texel;    // size of a texel, metres
    float nearest;  // penumbra depth of the nearest caster
    float span;     // moments: range of penumbra depth, from `nearest`, that codes 0..1 cover
    vec2 tile;      // column and row in the atlas
    vec2 beside;    // factors on the x and y derivatives of the visibility that shadow_mixed() adds
};

float shadow_cascade_share(float distance_m, float per_m) {
    return clamp(distance_m * per_m + (1.0 - 1.0 / CASCADE_FADE), 0.0, 1.0); // per_m 0: no next cascade
}

// The cascade at the fragment's view depth, which is the clip coordinate w. With `shared`, cascades fade in the zone in front of
// each split: of two pixels in a row the left one samples the nearer cascade and the right one the farther, and shadow_mixed()
// blends both results.
shadow_cascade shadow_cascade_of(const int slot, const bool shared) {
    vec4 c = CASCADE(slot, 0);
    float far = 1.0 / gl_FragCoord.w;
    vec4 zones = CASCADE(slot, CASCADES_ZONES);
    float share = shadow_cascade_share(far, zones.x) + shadow_cascade_share(far, zones.y) + shadow_cascade_share(far, zones.z);
    float number = shared && fract(0.5 * gl_FragCoord.x) > 0.5 ? ceil(share) : floor(share);
    vec4 spans = CASCADE(slot, CASCADES_SPANS);
    float span = number > 2.5 ? spans.w : number > 1.5 ? spans.z : number > 0.5 ? spans.y : spans.x;
    if (number > 0.5) c = CASCADE(slot, 1);
    if (number > 1.5) c = CASCADE(slot, 2);
    if (number > 2.5) c = CASCADE(slot, 3);
    float row = step(1.5, number);
    return shadow_cascade(c.xy, c.CASCADE_TEXEL, c.CASCADE_NEAREST, span, vec2(number - 2.0 * row, row), vec2(share - number, 0.0));
}

// uv and code. Points that the tile does not cover are lit: the result is outside of the map, with a code nearer than any caster.
vec3 shadow_cascade_at(const int slot, shadow_cascade c, vec3 p, vec3 n, vec3 l, float spread) {
    vec3 at = (shadow_matrix(slot) * vec4(p + shadow_push(slot, n, l, dot(n, l), c.texel, spread), 1.0)).xyz;
    vec4 size = SHADOW(slot, SHADOW_MAP_SIZE);
    vec2 texels = at.xy / c.texel + c.axis;
    bool held = max(abs(texels.x), abs(texels.y)) < SHADOW(slot, SHADOW_CODE).CODE_HELD;
    return held ? vec3((texels + (c.tile + 0.5) * (0.5 * size.x)) * size.zw, at.z) : vec3(-1.0, -1.0, -1.0e9);
}

// As shadow_slope_directional(), whose uv are in metres with cascades.
vec2 shadow_cascade_slope(const int slot, shadow_cascade c, vec3 face, vec3 l) {
    return shadow_slope_directional(slot, face, l) * (c.texel * SHADOW(slot, SHADOW_MAP_SIZE).xy);
}
