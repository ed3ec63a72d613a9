// Passes the most-read constants as flat varyings (WITH_FLAT_CONSTANTS). A software driver loads and broadcasts a uniform for
// every few pixels (llvmpipe: about 0.3 ms per float and frame at 1280x720), while a flat varying costs it nothing; on a GPU it
// is the reverse. Fragment shaders include this file first.
#ifdef WITH_FLAT_CONSTANTS
#define PASS(i) pass_constant(i)
#endif
#include "lib/pass.glsl"

#ifdef WITH_FLAT_CONSTANTS
flat in vec4 v_constant[7]; // in the order of pass_constant()

vec4 pass_constant(const int i) {
    if (i == PASS_SKY) return v_constant[0];
    if (i == PASS_GROUND) return v_constant[1];
    if (i == PASS_EYE) return v_constant[2];
    if (i == PASS_LIGHTS + LIGHT_COLOR) return v_constant[3];
    if (i == PASS_LIGHTS + LIGHT_PLACE) return v_constant[4];
    if (i == PASS_SHADOWS + SHADOW_MAP_SIZE) return v_constant[5];
    if (i == PASS_SHADOWS + SHADOW_CODE) return v_constant[6];
    return u_pass[i];
}
#endif
