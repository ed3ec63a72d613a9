// A slide in the beam of a spot: a projective texture (Segal, Korobkin, van Widenfelt, Foran, Haeberli, "Fast Shadows and Lighting
// Effects Using Texture Mapping", 1992).
#include "lib/flat_constants.glsl"

#define SLIDE(index, what) u_pass[PASS_SLIDES + (index)*SLIDE_SIZE + (what)]

// What a slide leaves of the light that goes to p, world space; 0..1, linear. film: light that misses the slide goes on, else it
// is stopped, and so for what lies between the light and the slide. Its alpha is the film's opacity: clear film is white.
//
// uv is divided by no depth less than the slide's own: so it has no jump and no end, behind the light either, and its differences
// from pixel to pixel may choose the level. The frame's edge lies inwards over one pixel: outside there is exactly nothing.
vec3 slide_light(const int index, const bool film, mediump sampler2D slide, vec3 p) {
    vec4 u = SLIDE(index, SLIDE_U), v = SLIDE(index, SLIDE_V), w = SLIDE(index, SLIDE_W), place = SLIDE(index, SLIDE_PLACE);
    float depth = dot(w.xyz, p) + w.w;
    vec2 uv = vec2(dot(u.xyz, p) + u.w, dot(v.xyz, p) + v.w) / max(depth, place.z);
    vec2 pixel = max(max(abs(dFdx(uv)), abs(dFdy(uv))), vec2(1e-6));
    vec2 texels = pixel * place.xy;
    mediump vec4 color = textureLod(slide, uv, log2(max(max(texels.x, texels.y), 1.0)));
    vec2 covered = clamp((0.5 - abs(uv - 0.5)) / pixel, 0.0, 1.0);
    float inside = depth > place.z ? covered.x * covered.y : 0.0;
    return film ? mix(vec3(1.0), color.rgb, color.a * inside) : mix(vec3(1.0), color.rgb, color.a) * inside;
}

#define SLIDE_OF(slot, index, film, slide) if (light == slot) return slide_light(index, film, slide, p);

// What the slide of a light of this pass leaves of its light at p; 1 without one. Takes derivatives: not behind a branch.
vec3 slide_of(const int light, vec3 p) {
    EACH_SLIDE(SLIDE_OF)
    return vec3(1.0);
}
