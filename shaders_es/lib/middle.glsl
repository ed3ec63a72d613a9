// Midpoint shadow maps (Woo, "The Shadow Depth Map Revisited", Graphics Gems III, 1992): the map holds what lies half-way between the
// first and the second depth as the light sees them, here the front and the back face of closed bodies.
#include "lib/pass.glsl"

// first: code of the front face; second: of the nearest back face there, the far end if there is none (at a silhouette, by rounding).
float middle_code(float first, float second) { return second < u_pass[PASS_CODE_ADD].y ? 0.5 * (first + second) : first; }

// The same of window depths of a perspective: a + b / depth, where a is the value at infinity.
float middle_depth(float first, float second) {
    vec2 w = u_pass[PASS_CODE_ADD].z - vec2(first, second);
    return second < u_pass[PASS_CODE_ADD].y ? u_pass[PASS_CODE_ADD].z - 2.0 * w.x * w.y / (w.x + w.y) : first;
}
