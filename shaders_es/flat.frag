// Planar shadows in the stencil: casters between light and plane. Writes no colour.
#include "lib/pass.glsl"
#include "lib/caster.frag.glsl"

centroid in float v_height;

void main() {
    cut_holes();
    vec4 heights = u_pass[FLAT_HEIGHTS];
    if (v_height < heights.x || v_height > heights.y) discard;
}
