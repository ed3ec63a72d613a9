// Unshadowed light from a directional, point or spot light, per fragment, in linear space.

#define LIGHT(slot, what) PASS(PASS_LIGHTS + (slot)*LIGHT_SIZE + (what))

struct light_sample {
    vec3 to_light; // unit
    vec3 color;    // illuminance over pi of a surface that faces the light, lux, after exposure
    float cone;    // spot: 0 outside the outer angle, 1 inside the inner one; else 1
    bool in_range;
    float distance_m; // of a light with a place
};

// type: LIGHT_DIRECTIONAL, LIGHT_POINT or LIGHT_SPOT. p: world space. Inverse-square falloff with the range window of
// KHR_lights_punctual; the cone is a smoothstep of the cosine.
light_sample light_at(const int slot, const int type, vec3 p) {
    vec3 color = LIGHT(slot, LIGHT_COLOR).rgb;
    vec4 place = LIGHT(slot, LIGHT_PLACE);
    if (type == LIGHT_DIRECTIONAL) return light_sample(place.xyz, color, 1.0, true, 0.0);
    vec3 v = place.xyz - p;
    float d2 = max(dot(v, v), 1e-8);
    float inverse = inversesqrt(d2);
    vec3 l = v * inverse;
    float window = 1.0;
    if (LIGHT_RANGED[slot]) {
        float x = d2 * place.w * place.w;
        window = clamp(1.0 - x * x, 0.0, 1.0);
    }
    float cone = 1.0;
    if (type == LIGHT_SPOT) {
        vec4 axis = LIGHT(slot, LIGHT_AXIS);
        float t = clamp((dot(-l, axis.xyz) - axis.w) * u_pass[PASS_CONES + slot / 4][slot % 4], 0.0, 1.0);
        cone = t * t * (3.0 - 2.0 * t);
    }
    return light_sample(l, color * (window / d2) * cone, cone, window > 0.0, d2 * inverse);
}
