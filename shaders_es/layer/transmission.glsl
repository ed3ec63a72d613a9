// KHR_materials_transmission of a thin wall: of what is not reflected, the share that is not diffuse shows what is behind, in the base
// colour; straight, whatever the roughness. Reflections stay whole.
#include "lib/shade.glsl"

void transmission_begin(vec3 smooth_normal, inout surface s) {
    float clear = surface_transmission();
    s.through = min(s.diffuse, 1.0) * clear * (1.0 - environment_share(s.f0, s.roughness, dot(s.normal, s.to_eye)));
    s.diffuse *= 1.0 - clear;
}

void transmission_ambient(surface s) {}

void transmission_light(surface s, light_sample l, float seen) {}

void transmission_end(surface s, inout vec3 color) {}
