// What is known about a pixel beside its colour, as the bits of floats: xyz the value, w unused.
#include "lib/surface.glsl"
#include "lib/light.glsl"
#include "lib/shadow_point.glsl"

layout(location = 0) out uvec4 o_bits;

// Of the triangle itself, towards the viewer; unit.
vec3 geometric_normal() {
    vec3 n = normalize(cross(dFdx(v_position), dFdy(v_position)));
    return dot(n, surface_to_eye()) < 0.0 ? -n : n;
}

// Only what the geometry and the filter say: 1 outside the cone and the range; a casting surface that the light reaches only
// from its other side blocks itself.
#define SEE_SHADOWED_LIGHT(slot, type, radial, visibility, map) \
    { \
        light_sample l = light_at(slot, type, v_position); \
        vec3 at = type == LIGHT_DIRECTIONAL ? v_shadow[slot] \
                                            : shadow_point_spot(slot, radial, v_position, surface_normal(), l.to_light); \
        float filtered = visibility(map, at, SHADOW(slot, SHADOW_MAP_SIZE)); \
        bool blocks_itself = v_emissive.w > 0.5 && dot(facing, l.to_light) <= 0.0; \
        if (l.cone > 0.0 && l.in_range) seen = blocks_itself ? 0.0 : filtered; \
    }

void main() {
    vec3 facing = geometric_normal(); // derivatives before any branch
    surface_base();
    vec3 value = vec3(0.0);
    if (AOV == AOV_VISIBILITY) {
        float seen = 1.0;
        EACH_SHADOWED_LIGHT(SEE_SHADOWED_LIGHT)
        value = vec3(seen);
    } else if (AOV == AOV_DISTANCE) {
        value = vec3(length(v_position - u_pass[PASS_EXPOSURE].yzw));
    } else {
        value = surface_normal();
    }
    o_bits = floatBitsToUint(vec4(value, 1.0));
}
