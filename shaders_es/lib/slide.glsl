// Slide (gobo) in the beam of a spot light: a projective texture (Segal, Korobkin, van Widenfelt, Foran, Haeberli, "Fast Shadows
// and Lighting Effects Using Texture Mapping", 1992).
#include "lib/flat_constants.glsl"

#define SLIDE(index, what) u_pass[PASS_SLIDES + (index)*SLIDE_SIZE + (what)]

// Transmittance of the slide for light towards p (world space): 0..1, linear. Outside of the slide, and between light and slide,
// it is 1 for film and 0 otherwise; if it ends, beyond its far plane, too. Alpha is the opacity of the colour: transparent is white.
//
// The divisor of uv is at least the depth of the slide, so uv is continuous and finite even behind the light, and its derivatives
// may select the mipmap level. The edge is antialiased inwards over one pixel: outside the slide has exactly no effect.
vec3 slide_light(const int index, const bool film, const bool ends, mediump sampler2D slide, vec3 p) {
    vec4 u = SLIDE(index, SLIDE_U), v = SLIDE(index, SLIDE_V), w = SLIDE(index, SLIDE_W), place = SLIDE(index, SLIDE_PLACE);
    float depth = dot(w.xyz, p) + w.w;
    vec2 uv = vec2(dot(u.xyz, p) + u.w, dot(v.xyz, p) + v.w) / max(depth, place.z);
    vec2 pixel = max(max(abs(dFdx(uv)), abs(dFdy(uv))), vec2(1e-6));
    vec2 texels = pixel * place.xy;
    mediump vec4 color = textureLod(slide, uv, log2(max(max(texels.x, texels.y), 1.0)));
    vec2 covered = clamp((0.5 - abs(uv - 0.5)) / pixel, 0.0, 1.0);
    float inside = depth > place.z && (!ends || depth < place.w) ? covered.x * covered.y : 0.0;
    return film ? mix(vec3(1.0), color.rgb, color.a * inside) : mix(vec3(1.0), color.rgb, color.a) * inside;
}

#define SLIDE_OF(slot, index, film, ends, slide) if (light == slot) return slide_light(index, film, ends, slide, p);

// Transmittance of the slide of light number `light` of the pass towards p; 1 without a slide. Takes derivatives: not behind a
// branch. EACH_SLIDE: src/gl/compose.c.
vec3 slide_of(const int light, vec3 p) {
    EACH_SLIDE(SLIDE_OF)
    return vec3(1.0);
}
