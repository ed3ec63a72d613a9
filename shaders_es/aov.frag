// Arbitrary output variables (visibility, distance, normal, occlusion) of a pixel, as the bits of floats: xyz the value, w unused.
#include "lib/surface.glsl"
#include "lib/light.glsl"
#include "lib/shadow_place.glsl"
#include "lib/occlusion.glsl"

#ifdef WITH_TRANSPARENT // into a mean: the value itself
layout(location = 0) out vec4 o_value;
#else
layout(location = 0) out uvec4 o_bits;
#endif

// Visibility from geometry and filter alone: 1 outside of cone and range; a caster whose visible side faces away from the light
// blocks itself, with FACED any. See lit.frag for the arguments.
#define SEE_SHADOWED_LIGHT(slot, type, radial, visibility, map) \
    { \
        light_sample l = light_at(slot, type, v_position); \
        shadow_place place = \
            shadow_place_of(slot, type, radial, v_shadow[slot], v_position, surface_normal(), face, l); \
        float filtered = shadow_mixed(slot, place, visibility(map, place)); \
        bool blocks_itself = (FACED || v_emissive.w > 0.5) && dot(face, l.to_light) <= 0.0; \
        if (l.cone > 0.0 && l.in_range) seen = blocks_itself ? 0.0 : filtered; \
    }

void main() {
    vec3 face = surface_face_normal(); // derivatives before any branch
    vec3 value = vec3(0.0);
    if (AOV == AOV_VISIBILITY) {
        float seen = 1.0;
        EACH_SHADOWED_LIGHT(SEE_SHADOWED_LIGHT)
        value = vec3(seen);
    } else if (AOV == AOV_DISTANCE) {
        value = vec3(length(v_position - u_pass[PASS_EXPOSURE].yzw));
    } else if (AOV == AOV_NORMAL) {
        value = surface_normal();
    } else {
        value = vec3(1.0);
#ifdef WITH_OCCLUDED
        value = vec3(min(occlusion_at(surface_normal()), 1.0));
#endif
    }
#ifdef WITH_TRANSPARENT
    o_value = vec4(value, 1.0);
#else
    o_bits = floatBitsToUint(vec4(value, 1.0));
#endif
    surface_cut(surface_base());
}
